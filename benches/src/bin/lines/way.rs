//! The ways that lines are drawn, and how times are taken.

use std::error::Error;

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::measures::Against;
use npr_benches::lines::report::Bar;
use npr_benches::lines::subjects::SIZE;
use npr_benches::timing::{Times, elapsed_ms};
use npr_core::camera::Camera;
use npr_core::crease::CreaseFrom;
use npr_render::{LineModel, LineOptions, LineSource};
use npr_stylesheet::Style;
use npr_vector::pixel_strokes::PublishedPath;
use npr_vector::stroke::Drawing;

use crate::Outcome;

/// Runs behind a time.
pub const RUNS: usize = 5;

/// A way of drawing, and what it must reach.
#[derive(Debug, Clone, Copy)]
pub struct Way {
    /// In words.
    pub name: &'static str,
    /// How contours are found.
    pub method: LineSource,
    /// Whether strokes are smoothed.
    pub smooth: bool,
    /// The constants of the published path.
    pub potrace: PublishedPath,
    /// What it must reach.
    pub bar: Bar,
}

/// All ways that contours are drawn.
pub fn ways() -> [Way; 5] {
    let way = |name, method, smooth, bar: (usize, f64, f64)| Way {
        name,
        method,
        smooth,
        potrace: PublishedPath::default(),
        bar: Bar {
            tolerance: bar.0,
            recall: bar.1,
            precision: bar.2,
            against: if smooth {
                Against::Drawn
            } else {
                Against::Runs
            },
        },
    };
    let (edges, surface) = (LineSource::Edges, LineSource::Surface);
    [
        way("edges, not smoothed", edges, false, (1, 0.998, 0.998)),
        way("edges, smoothed", edges, true, (2, 0.99, 0.99)),
        way("surface, not smoothed", surface, false, (2, 0.97, 0.99)),
        way("surface, smoothed", surface, true, (2, 0.97, 0.99)),
        // What an emulation of the publication reaches at worst, of contours alone.
        way(
            "potrace, as published",
            LineSource::Potrace,
            true,
            (2, 0.925, 0.98),
        ),
    ]
}

impl Way {
    fn options(&self, wanted: &Wanted) -> LineOptions {
        LineOptions {
            kinds: wanted.kinds.iter().copied().collect(),
            crease: wanted.crease as f32,
            crease_from: CreaseFrom::Faces,
            method: self.method,
            smooth: self.smooth,
            potrace: self.potrace,
            ..LineOptions::new(SIZE)
        }
    }

    /// The name with nothing in it that file names do not like.
    pub fn file_word(&self) -> String {
        self.name.replace(", ", "_").replace(' ', "_")
    }

    /// Draws the kinds that the reference knows.
    pub fn draw(&self, model: &LineModel, camera: &Camera) -> Outcome<Drawing> {
        self.draw_kinds(model, camera, &Wanted::default())
    }

    /// Draws the kinds that are wanted.
    pub fn draw_kinds(
        &self,
        model: &LineModel,
        camera: &Camera,
        wanted: &Wanted,
    ) -> Outcome<Drawing> {
        Ok(model.draw(camera, &Style::default(), &self.options(wanted))?)
    }
}

/// Times of some runs of work that may fail.
pub fn times<E: Error + 'static>(work: impl Fn() -> Result<(), E>) -> Outcome<Times> {
    let mut runs = Vec::new();
    for _ in 0..RUNS {
        let mut outcome = Ok(());
        runs.push(elapsed_ms(|| outcome = work()));
        outcome?;
    }
    Ok(Times::of(runs))
}
