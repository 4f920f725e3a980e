//! Measures cartoon smoke and prints the tables kept in `benches/results/smoke.md`; with `times`, `growth` or `calm`
//! only that part.
//!
//! Run by `cargo xtask measure smoke`. A measuring program, not a test: it fails only where loading or drawing fails.

use std::error::Error;

use npr_benches::ledger::{Ledger, precise};
use npr_benches::machine;
use npr_benches::smoke::calm::{Change, STEP, Shown};
use npr_benches::smoke::subject::{Film, camera, drawn, plume, space_of, volume_of};
use npr_benches::subject::shared_volumes;
use npr_benches::table::Table;
use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_render::{Following, Frame, Model, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_smoke::{Distances, Puffs, Smoke, Sphere, Track, TrackSettings, Volume, covered_share};
use npr_stylesheet::Style;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The paper's grid and picture.
const PAPER_GRID: [u32; 3] = [15, 15, 20];
const PAPER_SIZE: [u32; 2] = [512, 512];

const FULL_HD: [u32; 2] = [1920, 1080];

/// Spheres of the busy case.
const MANY: u32 = 2000;

/// Frames behind every time.
const RUNS: usize = 25;

/// Frames of an orbit, a degree apart, and of a plume.
const FRAMES: u32 = 36;

/// What is held against the baseline, and the baseline itself at the end.
const CALM: [(&str, &[&str]); 6] = [
    ("smoke-cel-2", &[]),
    ("its lines alone", &["smoke.ramp=[{at=0,color='#f8f8fb'}]"]),
    ("its tones alone", &["smoke.line.method=off"]),
    (
        "published tones and lines on our spheres",
        &[
            "smoke.line.method=published",
            "smoke.layer_blend=0",
            "smoke.sigma=3px",
            "smoke.wrap=0",
        ],
    ),
    (
        "as published, particles too",
        &[
            "smoke.particles=published",
            "smoke.line.method=published",
            "smoke.layer_blend=0",
            "smoke.sigma=3px",
            "smoke.wrap=0",
        ],
    ),
    ("billboards", &["smoke.method=billboards"]),
];

fn main() -> Outcome<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words
        .iter()
        .map(String::as_str)
        .collect::<Vec<_>>()
        .as_slice()
    {
        [] => {
            head();
            times()?;
            growth()?;
            calm()
        }
        ["times"] => times(),
        ["growth"] => growth(),
        ["calm"] => calm(),
        _ => Err("usage: smoke [times|growth|calm] > benches/results/smoke.md".into()),
    }
}

fn head() {
    println!("# Cartoon smoke\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!("- load average at the start: {}\n", machine::load());
}

/// The look that is measured, with the paper's pictures of lights.
fn look(settings: &[&str]) -> Outcome<Style> {
    let mut style = Style::preset("smoke-cel-2")?;
    style.set("smoke.shadow_px=2048")?;
    style.set("light.space=world")?;
    for setting in settings {
        style.set(setting)?;
    }
    Ok(style)
}

/// A picture of smoke alone.
struct Picture<'a> {
    renderer: Renderer<'a>,
    size: [u32; 2],
}

impl<'a> Picture<'a> {
    /// For at most `count` spheres.
    fn new(model: &'a Model, style: &Style, size: [u32; 2], count: u32) -> Outcome<Self> {
        let spheres = vec![npr_render::Sphere::default(); count as usize];
        let options = RendererOptions {
            smoke: Some(npr_render::Smoke::new(spheres)),
            ..RendererOptions::new(size)
        };
        let renderer = Renderer::new(&Processor, model, style, &options)?;
        Ok(Self { renderer, size })
    }

    fn draw(&mut self, spheres: &[Sphere], volume: &Volume, camera: &Camera) -> Outcome<Frame> {
        self.renderer.set_smoke(&drawn(spheres, volume))?;
        Ok(self.renderer.draw(camera)?)
    }

    fn camera(&self, volume: &Volume, degrees: f32) -> Camera {
        camera(space_of(volume), self.size, degrees)
    }
}

fn empty() -> Outcome<Model> {
    Ok(Model::new(&Scene::default())?)
}

/// The two cases that must be fast, stage by stage.
fn times() -> Outcome<()> {
    println!("## A frame, stage by stage\n");
    println!(
        "Medians of {RUNS} frames in one process and, in brackets, the least, in ms. Work is what all threads of the \
         process did: unlike the time it hardly hangs on what else the machine does. Preset smoke-cel-2, lights see \
         the smoke in 2048 x 2048 texels. Load average {}.\n",
        machine::load()
    );
    println!("### The paper's case: 15 x 15 x 20 cells, 200 spheres at most, 512 x 512 pixels\n");
    println!("Wanted: 25 ms a frame, from the solver's step to the picture.\n");
    println!("{}", paper_case()?);
    println!("### A million voxels, {MANY} spheres, 1920 x 1080 pixels\n");
    println!("Wanted: 250 ms a frame, without reading the file.\n");
    match tall()? {
        Some(volume) => println!("{}", busy_case(&volume)?),
        None => println!("Left out: the shared volumes are not there.\n"),
    }
    Ok(())
}

fn paper_case() -> Outcome<Ledger> {
    // Let the smoke rise before the clock starts.
    let mut smoke = Smoke::new(plume(PAPER_GRID))?;
    (0..48).for_each(|_| smoke.step());
    let settings = TrackSettings::default();
    let mut track = Track::new(&smoke.volume(), settings);
    let model = empty()?;
    let mut picture = Picture::new(&model, &look(&[])?, PAPER_SIZE, settings.count)?;
    let mut ledger = Ledger::default();
    let camera = picture.camera(&smoke.volume(), 0.0);
    picture.draw(&track.spheres(), &smoke.volume(), &camera)?;
    for _ in 0..RUNS {
        let mut renderers = Ledger::default();
        let frame = ledger.time("whole frame", || -> Outcome<Frame> {
            renderers.time("solver", || smoke.step());
            let volume = renderers.time("volume", || smoke.volume());
            renderers.time("distances and spheres", || track.step(&volume));
            let spheres = track.spheres();
            renderers.time("drawing", || picture.draw(&spheres, &volume, &camera))
        })?;
        ledger.take(&renderers);
        ledger.enter_passes(&frame);
    }
    Ok(ledger)
}

fn busy_case(volume: &Volume) -> Outcome<Ledger> {
    let settings = TrackSettings {
        count: MANY,
        detail: 200,
        ..TrackSettings::default()
    };
    let mut track = Track::new(volume, settings);
    eprintln!("{} spheres", track.spheres().len());
    let model = empty()?;
    let mut picture = Picture::new(&model, &look(&[])?, FULL_HD, MANY)?;
    let mut ledger = Ledger::default();
    picture.draw(&track.spheres(), volume, &picture.camera(volume, 0.0))?;
    for run in 0..RUNS {
        let camera = picture.camera(volume, run as f32);
        let mut renderers = Ledger::default();
        let frame = ledger.time("whole frame", || -> Outcome<Frame> {
            renderers.time("distances and spheres", || track.step(volume));
            let spheres = track.spheres();
            renderers.time("drawing", || picture.draw(&spheres, volume, &camera))
        })?;
        ledger.take(&renderers);
        ledger.enter_passes(&frame);
    }
    Ok(ledger)
}

fn tall() -> Outcome<Option<Volume>> {
    let path = shared_volumes().join("smoke_tall_houdini.vdb");
    if !path.is_file() {
        return Ok(None);
    }
    Ok(Some(volume_of(&path)?))
}

/// How the stages grow with what they have to do.
fn growth() -> Outcome<()> {
    println!("## How costs grow\n");
    println!(
        "Work of all threads in ms, medians of 9 runs. Voxels and spheres: the tall smoke, coarser by whole factors.\n"
    );
    let Some(volume) = tall()? else {
        return Ok(());
    };

    // Time what follows voxels, on grids from coarse to fine.
    let mut table = Table::new(["voxels", "distances", "2000 spheres that follow"]);
    for block in [4, 3, 2, 1] {
        let volume = volume.coarsened(block);
        let mut ledger = Ledger::default();
        let settings = TrackSettings {
            count: MANY,
            detail: 1000,
            ..TrackSettings::default()
        };
        let mut track = Track::new(&volume, settings);
        for _ in 0..9 {
            ledger.time("distances", || Distances::new(&volume, settings.threshold));
            ledger.time("follow", || track.step(&volume));
        }
        let cells = ["distances", "follow"].map(|name| work_of(&ledger, name));
        table.add(volume.density().len().to_string(), cells);
    }
    println!("{table}");
    let mut table = Table::new([
        "spheres",
        "pixels",
        "sigma, px",
        "drawing",
        "`smoke` passes that smooth, time",
    ]);
    let (k, px) = (
        [200, 2000, 20_000],
        [PAPER_SIZE, [1024, 1024], FULL_HD, [3840, 2160]],
    );
    let sigmas = [0.0, 1.5, 3.0, 6.0, 14.0, 50.0, 200.0];
    let cases = k.iter().map(|k| (*k, FULL_HD, 14.0));
    let cases = cases.chain(px.iter().map(|px| (MANY, *px, 14.0)));
    let cases = cases.chain(sigmas.iter().map(|sigma| (MANY, FULL_HD, *sigma)));
    for (count, size, sigma) in cases {
        let cells = grown(&volume, count, size, sigma)?;
        table.add(count.to_string(), cells);
    }
    println!("{table}");
    Ok(())
}

fn work_of(ledger: &Ledger, name: &str) -> String {
    ledger
        .of(name)
        .map_or(String::new(), |(_, work)| precise(work))
}

/// The cells of a row of [`growth`].
fn grown(volume: &Volume, count: u32, size: [u32; 2], sigma: f32) -> Outcome<[String; 4]> {
    let settings = TrackSettings {
        count,
        detail: 200,
        ..TrackSettings::default()
    };
    let spheres = Track::new(volume, settings).spheres();
    let model = empty()?;
    let style = look(&[&format!("smoke.sigma={sigma}px")])?;
    let mut picture = Picture::new(&model, &style, size, spheres.len() as u32)?;
    let camera = picture.camera(volume, 0.0);
    let mut ledger = Ledger::default();
    picture.draw(&spheres, volume, &camera)?;
    for _ in 0..9 {
        let frame = ledger.time("drawing", || picture.draw(&spheres, volume, &camera))?;
        ledger.enter_passes(&frame);
    }
    let smoothing = ["gather_tones", "blur_rows", "blur_columns", "smooth_tones"];
    let smoothing = smoothing
        .iter()
        .filter_map(|name| ledger.of(&format!("`smoke.{name}`")));
    let smoothing: f64 = smoothing.map(|(clock, _)| clock.median).sum();
    Ok([
        format!("{}x{}", size[0], size[1]),
        sigma.to_string(),
        work_of(&ledger, "drawing"),
        format!("{smoothing:.2}"),
    ])
}

/// Tones that change without cause.
fn calm() -> Outcome<()> {
    println!("## Tones that change without cause\n");
    println!(
        "{FRAMES} steps of pictures 512 x 512 under a light fixed to the world. Every pixel's true point, on the \
         spheres that stand for the smoke, is carried to the frame before with its sphere and through that frame's \
         camera, once as paint on the sphere and once as part of its image, as outlines are; it is compared where it \
         is seen there too, and either way may explain its tone. Its tone differs where it lies more than {STEP} of \
         the way from black to white off the tone there; it jumps where nothing within a pixel comes nearer either. \
         Styles are held against the points of the spheres that they draw or stand for: ours, but for published \
         particles their own, whose births, deaths and leaps in size therefore count for nothing here and are counted \
         below. Billboards are lit by nothing: of them only lines can change.\n"
    );
    let mut table = Table::new([
        "subject",
        "style",
        "pixels compared a frame",
        "differ without cause",
        "of the billboards'",
        "jump",
        "of the billboards'",
    ]);
    if let Some(volume) = tall()? {
        let name = "camera round still smoke, a degree a frame";
        add_rows(&mut table, name, |settings| orbit(&volume, settings))?;
    }
    add_rows(&mut table, "the built-in plume, camera still", rising)?;
    println!("{table}");
    lives()
}

/// How spheres come, go and change their size, whatever is drawn of them.
fn lives() -> Outcome<()> {
    println!("### The spheres themselves\n");
    println!(
        "The same plume. A sphere comes or goes at once where it is there in one frame, larger than a tenth of the \
         largest, and not in the next. Radii: by how much a sphere changes from frame to frame, as a share of the \
         larger radius. Billboards stand where our spheres do, all of their mean size.\n"
    );
    let mut table = Table::new([
        "spheres",
        "in a frame",
        "smoke that they cover",
        "come or go at once, a frame",
        "mean change of a radius",
        "greatest",
    ]);
    for particles in ["cover", "published"] {
        let style = look(&[&format!("smoke.particles={particles}"), PLUME_COUNT])?;
        let mut film = Film::new(&style)?;
        let mut life = Life::default();
        let mut before = film.puffs.spheres();
        for _ in 0..FRAMES {
            let volume = film.step();
            let after = film.puffs.spheres();
            life.enter(&before, &after, &volume);
            before = after;
        }
        table.add(particles, life.cells());
    }
    println!("{table}");
    Ok(())
}

/// What happens to spheres over a film.
#[derive(Default)]
struct Life {
    spheres: usize,
    covered: f32,
    pops: usize,
    changes: Vec<f32>,
}

impl Life {
    fn enter(&mut self, before: &[Sphere], after: &[Sphere], volume: &Volume) {
        let distances = Distances::new(volume, TrackSettings::default().threshold);
        let largest = after.iter().map(|sphere| sphere.radius).fold(0.0, f32::max);
        let popped = |here: &[Sphere], there: &[Sphere]| {
            let seen = here.iter().filter(|sphere| sphere.radius > 0.1 * largest);
            seen.filter(|sphere| there.iter().all(|other| other.id != sphere.id))
                .count()
        };
        self.spheres += after.len();
        self.covered += covered_share(after, volume, &distances);
        self.pops += popped(before, after) + popped(after, before);
        for sphere in after {
            if let Some(was) = before.iter().find(|was| was.id == sphere.id) {
                let larger = was.radius.max(sphere.radius);
                self.changes
                    .push((was.radius - sphere.radius).abs() / larger);
            }
        }
    }

    fn cells(&self) -> [String; 5] {
        let frames = FRAMES as f32;
        let mean = self.changes.iter().sum::<f32>() / self.changes.len().max(1) as f32;
        let greatest = self.changes.iter().copied().fold(0.0, f32::max);
        [
            (self.spheres / FRAMES as usize).to_string(),
            format!("{:.0} %", 100.0 * self.covered / frames),
            format!("{:.1}", self.pops as f32 / frames),
            format!("{:.1} %", 100.0 * mean),
            format!("{:.0} %", 100.0 * greatest),
        ]
    }
}

/// Most spheres of the plume.
const PLUME_COUNT: &str = "smoke.puffs.count=300";

/// A row for every style of a subject.
fn add_rows(
    table: &mut Table,
    subject: &str,
    of: impl Fn(&[&str]) -> Outcome<Change>,
) -> Outcome<()> {
    let changes = CALM.iter().map(|(_, settings)| of(settings));
    let changes = changes.collect::<Outcome<Vec<Change>>>()?;
    let baseline = changes.last().map_or([1.0; 2], Change::shares);
    for ((style, _), change) in CALM.iter().zip(&changes) {
        let mut cells = vec![
            (*style).to_owned(),
            (change.compared / FRAMES as usize).to_string(),
        ];
        for (share, baseline) in change.shares().into_iter().zip(baseline) {
            cells.push(format!("{:.3} %", 100.0 * share));
            cells.push(format!("{:.2}", share / baseline));
        }
        eprintln!("{subject}: {}", cells.join(", "));
        table.add(subject, cells);
    }
    Ok(())
}

fn orbit(volume: &Volume, settings: &[&str]) -> Outcome<Change> {
    let style = look(&[settings, &["smoke.puffs.count=600"]].concat())?;
    let spheres = Puffs::new(volume, Following::default().settings(&style.smoke)).spheres();
    let model = empty()?;
    let mut picture = Picture::new(&model, &style, PAPER_SIZE, spheres.len() as u32)?;
    let shown = |step: u32| {
        let camera = picture.camera(volume, step as f32);
        let frame = picture.draw(&spheres, volume, &camera)?;
        Ok(Shown::new(&frame, &camera, &spheres))
    };
    sum_of_changes(shown)
}

fn rising(settings: &[&str]) -> Outcome<Change> {
    let style = look(&[settings, &[PLUME_COUNT]].concat())?;
    let mut film = Film::new(&style)?;
    let model = empty()?;
    let mut picture = Picture::new(&model, &style, PAPER_SIZE, style.smoke.puffs.count)?;
    let shown = |_| {
        let volume = film.step();
        let (spheres, camera) = (film.puffs.spheres(), picture.camera(&volume, 0.0));
        let frame = picture.draw(&spheres, &volume, &camera)?;
        Ok(Shown::new(&frame, &camera, &spheres))
    };
    sum_of_changes(shown)
}

/// All changes of a series of frames together.
fn sum_of_changes(mut shown: impl FnMut(u32) -> Outcome<Shown>) -> Outcome<Change> {
    let mut before = shown(0)?;
    let mut sum = Change::default();
    for step in 1..=FRAMES {
        let after = shown(step)?;
        sum = sum.and(after.change_since(&before));
        before = after;
    }
    Ok(sum)
}
