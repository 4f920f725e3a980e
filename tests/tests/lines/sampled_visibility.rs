//! Visibility sampled on a G-buffer against exact visibility, on whole models.

mod chain;
mod picture;

use chain::{Chain, chains};
use npr_core::crease::CreaseFrom;
use npr_core::window::Window;
use npr_render::{LineModel, LineModelOptions, LineOptions};
use npr_scene::{LoadOptions, load};
use npr_stylesheet::Style;
use npr_tests::{models, samples};
use npr_vector::mesh_lines::sample::{
    Spine, Surroundings, place_samples, sample_visibility, visible_samples,
};
use picture::gbuffer;
use std::path::{Path, PathBuf};

const SIZE: [u32; 2] = [960, 540];

/// Samples to both sides that are averaged.
const RADIUS: u32 = 2;

/// Models that are measured, with the least share of samples that must be judged as exactly; those that are not
/// beside the checkout are left out.
const LEAST: [(&str, f64); 9] = [
    ("cube_plane.glb", 0.99),
    ("still_life.glb", 0.97),
    ("teapot_box_plane.glb", 0.96),
    ("two_balls.glb", 0.99),
    ("stanford_bunny.glb", 0.9),
    ("flight_helmet.glb", 0.965),
    ("utah_teapot.glb", 0.98),
    ("suzanne.glb", 0.97),
    ("cad_tray.glb", 0.98),
];

/// How many samples were judged, and how.
#[derive(Debug, Default, Clone, Copy)]
struct Score {
    samples: usize,
    /// Samples that are judged as exactly, each by itself.
    alone: usize,
    /// The same along lines.
    filtered: usize,
    /// Hidden samples that are shown.
    shown: usize,
    /// Visible runs of lines: exact, and sampled.
    runs: [usize; 2],
}

impl Score {
    fn add(&mut self, exact: &[bool], shares: &[f32], seen: &[u32]) {
        let seen: Vec<bool> = seen.iter().map(|seen| *seen != 0).collect();
        let alike = |(a, b): &(&bool, bool)| **a == *b;
        self.samples += exact.len();
        let alone = shares.iter().map(|share| *share >= 0.5);
        self.alone += exact.iter().zip(alone).filter(alike).count();
        let filtered = || exact.iter().zip(seen.iter().copied());
        self.filtered += filtered().filter(alike).count();
        self.shown += filtered().filter(|(exact, seen)| !**exact && *seen).count();
        let runs = |visible: &[bool]| visible.chunk_by(|a, b| a == b).filter(|run| run[0]).count();
        self.runs[0] += runs(exact);
        self.runs[1] += runs(&seen);
    }

    fn share(&self, count: usize) -> f64 {
        count as f64 / self.samples.max(1) as f64
    }

    fn reported(&self) -> String {
        let [alone, filtered, shown] =
            [self.alone, self.filtered, self.shown].map(|n| self.share(n));
        let [exact, sampled] = self.runs;
        format!(
            "{:6} samples, agree {filtered:.4} (alone {alone:.4}), wrongly shown {shown:.4}, runs {exact} exact \
             {sampled} sampled",
            self.samples
        )
    }
}

fn score(path: &Path) -> Score {
    let scene = load(path, &LoadOptions::default()).unwrap();
    let model = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
    let camera = match model.cameras() {
        [(_, camera), ..] => *camera,
        [] => model.framing(SIZE[0] as f32 / SIZE[1] as f32, 0.7),
    };
    // All folds: the more lines there are, the more there is to judge.
    let options = LineOptions {
        crease_from: CreaseFrom::Faces,
        hidden: true,
        smooth: false,
        ..LineOptions::new(SIZE)
    };
    let drawing = model.draw(&camera, &Style::default(), &options).unwrap();
    let view = camera.view(SIZE, model.bounds());
    let window = Window::over(view.frame_px, [0.0; 2], view.frame_px, SIZE);
    let on = Surroundings {
        view: &view,
        window: &window,
        gbuffer: &gbuffer(model.shape(), &camera, &view, &window),
    };
    judge(&on, &chains(&drawing))
}

/// Samples chains in a frame, and compares what is seen with what is known.
fn judge(on: &Surroundings<'_>, chains: &[Chain<'_>]) -> Score {
    let spines: Vec<Spine> = chains.iter().map(Chain::spine).collect();
    let placed = place_samples(on.view, &spines);
    let mut shares = vec![0.0; placed.samples.len()];
    sample_visibility(on, &placed.samples, &mut shares);
    let seen = visible_samples(RADIUS, &placed.samples, &placed.line_starts, &shares);
    let mut score = Score::default();
    for (line, chain) in placed.line_starts.windows(2).zip(chains) {
        let range = line[0] as usize..line[1] as usize;
        let exact = chain.visible_at(range.len());
        score.add(&exact, &shares[range.clone()], &seen[range]);
    }
    score
}

/// Measured at 960 x 540: 0.904 of the bunny's samples, whose short lines lie close behind others, and 0.966 and more
/// of every other model's; of the still life's 0.979, in 316 visible runs, as many as there are.
#[test]
fn samples_agree_with_exact_visibility() {
    let found: Vec<PathBuf> = samples().into_iter().chain(models()).collect();
    let mut failed = Vec::new();
    for (name, least) in LEAST {
        let Some(path) = found.iter().find(|path| path.ends_with(name)) else {
            continue;
        };
        let score = score(path);
        let reported = format!("{name:22} {}", score.reported());
        println!("{reported}");
        if score.samples == 0 || score.share(score.filtered) < least {
            failed.push(reported);
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
