//! Measures comic pictures and prints the tables kept in `benches/results/comic.md`; with `prices [ENGINE [SIZE]
//! [PRESET..]]` only the times, with `gallery FOLDER [PRESET..]` sheets of the presets instead.
//!
//! Run by `cargo xtask measure comic` and `cargo xtask gallery`. A measuring program, not a test: it fails only where
//! loading or drawing fails.

use std::error::Error;
use std::path::Path;

use glam::DVec3;
use npr_benches::comic::motion::{Change, Inked};
use npr_benches::comic::{gallery, price};
use npr_benches::lines::soup::Soup;
use npr_benches::lines::subjects::{scene_of, shared_models};
use npr_benches::orbit::turned;
use npr_benches::subject::{Subject, bunny_path};
use npr_benches::table::Table;
use npr_benches::timing::median;
use npr_benches::{device, machine};
use npr_core::camera::{Camera, DEFAULT_FOV_DEG};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{Model, Renderer, RendererOptions};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::Style;

/// Frames of an orbit, a degree apart.
const FRAMES: u32 = 90;

/// Every so many frames the shift of strokes is measured.
const SHIFTS_EVERY: u32 = 6;

const ORBIT_SIZE: [u32; 2] = [800, 450];

const FULL_HD: [u32; 2] = [1920, 1080];

/// Frames behind every time.
const RUNS: usize = 9;

/// Plain tones, then what is compared with them.
const PRICED: [&str; 7] = [
    "toon",
    "comic-silver",
    "crosshatch",
    "screentone",
    "stipple",
    "pencil",
    "comic-modern",
];

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.as_slice() {
        [] => report(),
        [word, choice @ ..] if word == "prices" => prices(choice),
        [word, folder, presets @ ..] if word == "gallery" => {
            gallery::write(Path::new(folder), presets)
        }
        _ => Err(
            "usage: comic > benches/results/comic.md, comic prices [processor|device [WIDTHxHEIGHT] [PRESET..]], or \
             comic gallery FOLDER [PRESET..]".into(),
        ),
    }
}

fn report() -> Outcome<()> {
    println!("# Comic pictures\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!("- load average at the start: {}\n", machine::load());
    motion()?;
    prices(&[])
}

/// How still strokes lie while the camera goes round.
fn motion() -> Outcome<()> {
    println!("## Strokes while the camera goes round\n");
    println!(
        "{FRAMES} frames {}x{}, a degree apart, light fixed to the model, strokes 8 pixels apart. Ink is carried from \
         frame to frame by the surface's own points. Shift: how far squares of 24 pixels then have to move to match, \
         across strokes, the vertex of a parabola through whole pixels. Flips: pixels that go from ink to paper or \
         back, by more than half a pixel.\n",
        ORBIT_SIZE[0], ORBIT_SIZE[1]
    );
    let mut table = Table::new([
        "model",
        "mapping",
        "surface moves, px a degree",
        "median shift against it, px",
        "19 of 20 within",
        "flips a degree",
    ]);
    for (name, scene) in orbited()? {
        let soup = Soup::of_scene(&scene);
        let model = Model::new(&scene)?;
        for mapping in ["surface", "screen"] {
            let change = orbit(&model, &soup, mapping)?;
            let share = change.flips as f64 / change.pixels.max(1) as f64;
            let cells = [
                mapping.to_owned(),
                format!("{:.2}", median(change.moves)),
                format!("{:.2}", median(change.shifts.clone())),
                format!("{:.2}", within(change.shifts, 0.95)),
                format!("{:.2} %", 100.0 * share),
            ];
            eprintln!("{name}: {}", cells.join(", "));
            table.add(&*name, cells);
        }
    }
    println!("{table}");
    Ok(())
}

/// A sphere, and the shared models that are there.
fn orbited() -> Outcome<Vec<(String, Scene)>> {
    let ball = icosphere(5);
    let ball = (ball.positions().to_vec(), ball.triangles().to_vec());
    let mut scenes = vec![("sphere".to_owned(), scene_of(ball))];
    for name in ["shader_ball", "stanford_bunny"] {
        let path = shared_models().join(format!("{name}.glb"));
        if path.is_file() {
            scenes.push((name.to_owned(), load(&path, &LoadOptions::default())?));
        } else {
            eprintln!("left out: there is no {}", path.display());
        }
    }
    Ok(scenes)
}

/// What changes in an orbit, all frames together.
fn orbit(model: &Model, soup: &Soup, mapping: &str) -> Outcome<Change> {
    let style = strokes_alone(mapping)?;
    let mut renderer = Renderer::new(&Processor, model, &style, &RendererOptions::new(ORBIT_SIZE))?;
    let mut sum = Change::default();
    let mut before: Option<Inked> = None;
    for frame in 0..=FRAMES {
        let camera = orbiting(model, soup, frame as f32);
        let inked = Inked::new(&renderer.draw(&camera)?, soup, &camera);
        if let Some(before) = before {
            let change = before.change_to(&inked, frame % SHIFTS_EVERY == 1);
            sum.pixels += change.pixels;
            sum.flips += change.flips;
            sum.moves.extend(change.moves);
            sum.shifts.extend(change.shifts);
        }
        before = Some(inked);
    }
    Ok(sum)
}

/// Parallel strokes in black on white, without lines, lit from one side of the model.
fn strokes_alone(mapping: &str) -> Outcome<Style> {
    let mut style = Style::preset("crosshatch")?;
    let settings = [
        &format!("ink.mapping={mapping}"),
        "ink.hatch.pattern=parallel",
        "ink.hatch.spacing=8px",
        "ink.color=#000000",
        "shade.paper=#ffffff",
        "background=#ffffff",
        "light.space=world",
        "line.method=none",
    ];
    for setting in settings {
        style.set(setting)?;
    }
    Ok(style)
}

/// The camera that frames a model, turned about the upright axis through its middle by some degrees.
fn orbiting(model: &Model, soup: &Soup, degrees: f32) -> Camera {
    let aspect = ORBIT_SIZE[0] as f32 / ORBIT_SIZE[1] as f32;
    let camera = model.framing(aspect, DEFAULT_FOV_DEG.to_radians());
    let (middle, _): (DVec3, f64) = soup.ball();
    turned(camera, middle.as_vec3(), degrees)
}

/// The value that a share of the values does not exceed; 0 of none.
fn within(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1);
    let at = (share * last as f64).round() as usize;
    values.get(at).copied().unwrap_or_default()
}

/// What ink and hatching cost on both engines, or what some presets cost on one.
fn prices(choice: &[String]) -> Outcome<()> {
    let Some(path) = bunny_path() else {
        return Ok(());
    };
    let subject = Subject::from_file(&path)?;
    let (engine, size, named) = match choice {
        [] => (None, None, choice),
        [engine] => (Some(engine.as_str()), None, &[][..]),
        [engine, second, rest @ ..] => match size_of(second) {
            Some(size) => (Some(engine.as_str()), Some(size), rest),
            None => (Some(engine.as_str()), None, &choice[1..]),
        },
    };
    let size = size.unwrap_or(FULL_HD);
    let mut presets = PRICED.to_vec();
    if !named.is_empty() {
        presets.truncate(1);
        presets.extend(named.iter().map(String::as_str));
    }
    println!("## What ink and hatching cost\n");
    println!(
        "The bunny at {}x{}: medians of {RUNS} frames drawn by turns and, in brackets, the least, in ms. Preparing is \
         done once and holds tiles and charts. Work is what all threads of the process did in a frame: unlike the \
         time it hardly hangs on what else the machine does. Published: 8 % more than plain shading.\n",
        size[0], size[1]
    );
    if engine != Some("device") {
        prices_on(&Processor, &subject, size, &presets)?;
    }
    if engine != Some("processor")
        && let Some(device) = device::open()
    {
        prices_on(&*device, &subject, size, &presets)?;
    }
    Ok(())
}

/// Width and height from a text as `1920x1080`.
fn size_of(text: &str) -> Option<[u32; 2]> {
    let (width, height) = text.split_once('x')?;
    Some([width.parse().ok()?, height.parse().ok()?])
}

/// The table of an engine; the first preset is what the others are compared with.
fn prices_on(
    engine: &dyn Engine,
    subject: &Subject,
    size: [u32; 2],
    presets: &[&str],
) -> Outcome<()> {
    let styles = presets.iter().map(|name| Style::preset(name));
    let styles = styles.collect::<Result<Vec<_>, _>>()?;
    println!(
        "### {}, load average {}\n",
        engine.describe(),
        machine::load()
    );
    let prices = price::prices(engine, subject, &styles, size, RUNS)?;
    let mut table = Table::new([
        "preset",
        "frame",
        "by toon, medians",
        "least",
        "work of all threads",
        "by toon, medians",
        "least",
        "last pass",
        "prepare",
    ]);
    let Some(plain) = prices.first() else {
        return Ok(());
    };
    for (name, price) in presets.iter().zip(&prices) {
        let cells = [
            price.frame.to_string(),
            format!("{:.2}", price.frame.median / plain.frame.median),
            format!("{:.2}", price.frame.least / plain.frame.least),
            price.work.to_string(),
            format!("{:.2}", price.work.median / plain.work.median),
            format!("{:.2}", price.work.least / plain.work.least),
            price.compose.to_string(),
            format!("{:.0}", price.prepare_ms),
        ];
        table.add(*name, cells);
    }
    println!("{table}");
    Ok(())
}
