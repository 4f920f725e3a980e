//! Counts what a frame asks of a graphics device, predicts its time on cards by their data sheets, and prints both
//! beside the time on the adapter of this machine: the tables kept in `benches/results/device_model.md`.
//!
//! `device_model [--model FILE | --ball TRIANGLES] [--preset NAME] [--size WIDTHxHEIGHT]`; unasked the skull of 400
//! thousand triangles where the folder of shared models lies beside the project, else the largest sample model, in
//! `toon` at 1920x1080, and some other frames after it. Run by `cargo xtask measure device`. Fails only where loading
//! or drawing fails.

mod growth;
mod published;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use npr_benches::card::{CARDS, GOAL};
use npr_benches::lines::subjects::shared_models;
use npr_benches::smoke::subject::{Film, camera, drawn, space_of};
use npr_benches::subject::Subject;
use npr_benches::table::Table;
use npr_benches::{device, machine};
use npr_core::camera::Camera;
use npr_gpu::cost::Cost;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Model, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_stylesheet::Style;

/// Runs behind every time.
const RUNS: usize = 5;

/// How long the best time of frames must stand before any is kept, and how long that is waited for: cards that have
/// been idle raise their clocks while they work.
const SETTLED: Duration = Duration::from_millis(400);
const MOST_WARMING: Duration = Duration::from_secs(3);

/// Milliseconds that a frame may take on the goal's card.
const GOAL_MS: f64 = 2.0;

/// Bytes that a frame may move for each of its pixels.
const GOAL_BYTES_A_PIXEL: f64 = 150.0;

/// Other frames of interest: their model, where it is a ball of so many triangles and not the usual one, preset and
/// setting, size.
const OTHERS: [(Option<usize>, &str, &str, [u32; 2]); 11] = [
    (Some(300_000), "toon", "", [1920, 1080]),
    (Some(66_400), "okuya", "antialias.samples=1", [1280, 720]),
    (Some(66_400), "okuya", "antialias.samples=1", [1920, 1080]),
    (None, "toon", "line.width.base=1", [1920, 1080]),
    (None, "toon", "line.width.base=8", [1920, 1080]),
    (None, "toon", "line.brush.tip=dry-brush", [1920, 1080]),
    (None, "brush", "", [1920, 1080]),
    (None, "plain", "", [1920, 1080]),
    (None, "comic-silver", "", [1920, 1080]),
    (None, "crosshatch", "", [1920, 1080]),
    (None, "stipple", "", [1920, 1080]),
];

/// Size of the frame of smoke.
const SMOKE_SIZE: [u32; 2] = [640, 480];

/// Settings of the frame of smoke: the paper's pictures of lights, and most spheres.
const SMOKE_SETTINGS: [&str; 3] = [
    "smoke.shadow_px=2048",
    "light.space=world",
    "smoke.puffs.count=300",
];

const USAGE: &str =
    "usage: device_model [--model FILE | --ball TRIANGLES] [--preset NAME] [--size WIDTHxHEIGHT]";

/// What is counted, said above the tables.
const RULES: &str = "\
## What is counted

Launches, workgroups, invocations and barriers are counted in the graph of the frame, with the lengths of lists and the
sizes of indirect launches as the run left them. Bytes follow a model, for no declaration says which elements an
invocation reads:

- Caches are perfect within a pass and keep nothing from pass to pass: an element costs its bytes once a pass.
- A buffer or image of as many elements as the pass works on, or a multiple, costs the share that is worked on, also
  where an invocation ends before it reads its own; in a draw, one of as many elements as the target has texels costs
  one a drawn texel.
- A list costs what is in it.
- Any other that is read costs all of its bytes, which is the most that it can cost: column \"of it at most\". Vertices
  and triangles that pixels look up are such.
- Targets are cleared by writing them once; a drawn texel reads a depth and writes all targets. What is drawn over does
  not count.
- Invocations are those of whole workgroups, or vertices and drawn texels of a draw. A pass that uses what was written
  since the last barrier has a barrier before it; \"in a group\" counts the places of its shader where a workgroup waits
  for itself.
- A predicted time is bytes by bandwidth, plus launches. Arithmetic, the set-up of triangles and what is drawn over are
  left out, and would make it longer; caches that hold a picture from pass to pass would make it shorter.
- Bandwidths are those of data sheets, of which cards reach 80 to 90 %. No sheet states what a launch costs; 5 us are
  assumed, of 3 to 10 that are usual. What calls of the API cost the processor is not part of it.
";

type Outcome<T> = Result<T, Box<dyn Error>>;

/// What is drawn.
struct Job {
    name: String,
    subject: Subject,
    preset: String,
    size: [u32; 2],
}

/// A row of the table of passes: the nodes of one pass, together.
struct Row {
    name: &'static str,
    cost: Cost,
    /// The least time of all runs; none for copies, which no pass makes.
    measured_ms: Option<f64>,
}

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let job = Job::of(&arguments)?;
    let engine = device::open_timing_passes().unwrap_or_else(|| Box::new(Processor));
    let rows = job.measure(engine.as_ref())?;
    report(&job, &engine.describe(), &rows);
    if arguments.is_empty() {
        others(&job, engine.as_ref())?;
        published::report(engine.as_ref())?;
        growth::report(engine.as_ref())?;
    }
    Ok(())
}

impl Job {
    /// The job that arguments ask for.
    fn of(arguments: &[String]) -> Outcome<Self> {
        // Read what is asked for.
        let mut model: Option<PathBuf> = None;
        let mut ball: Option<usize> = None;
        let (mut preset, mut size) = ("toon".to_owned(), [1920, 1080]);
        let (pairs, rest) = arguments.as_chunks();
        for [flag, value] in pairs {
            match flag.as_str() {
                "--model" => model = Some(value.into()),
                "--ball" => ball = Some(value.parse()?),
                "--preset" => preset.clone_from(value),
                "--size" => {
                    let (width, height) = value.split_once('x').ok_or(USAGE)?;
                    size = [width.parse()?, height.parse()?];
                }
                _ => return Err(USAGE.into()),
            }
        }
        if !rest.is_empty() || model.is_some() && ball.is_some() {
            return Err(USAGE.into());
        }

        // Load it.
        let (name, subject) = match ball {
            Some(count) => (format!("a ball of {count}"), Subject::ball(count)?),
            None => {
                let path = model.unwrap_or_else(usual_model);
                let name = path.file_name().unwrap_or_default();
                let name = name.to_string_lossy().into_owned();
                (name, Subject::from_file(&path)?)
            }
        };
        Ok(Self {
            name,
            subject,
            preset,
            size,
        })
    }

    fn pixels(&self) -> f64 {
        pixel_count(self.size)
    }

    /// What the passes of its frame ask for.
    fn measure(&self, engine: &dyn Engine) -> Outcome<Vec<Row>> {
        measure_subject(
            engine,
            &self.subject,
            &Style::preset(&self.preset)?,
            self.size,
        )
    }
}

fn pixel_count([width, height]: [u32; 2]) -> f64 {
    f64::from(width) * f64::from(height)
}

fn measure_subject(
    engine: &dyn Engine,
    subject: &Subject,
    style: &Style,
    size: [u32; 2],
) -> Outcome<Vec<Row>> {
    let options = RendererOptions::new(size);
    let mut renderer = subject.prepared.renderer(engine, style, &options)?;
    measured(&mut renderer, &subject.camera)
}

/// What the passes of a frame of smoke alone ask for: the built-in plume of 30 x 30 x 60 cells in its 24th frame.
fn measure_smoke(engine: &dyn Engine) -> Outcome<Vec<Row>> {
    // Let the smoke rise.
    let mut style = Style::preset("smoke-cel-2")?;
    for setting in SMOKE_SETTINGS {
        style.set(setting)?;
    }
    let film = Film::new(&style)?;

    // Draw it.
    let volume = film.smoke.volume();
    let options = RendererOptions {
        smoke: Some(drawn(&film.puffs.spheres(), &volume)),
        ..RendererOptions::new(SMOKE_SIZE)
    };
    let model = Model::new(&Scene::default())?;
    let mut renderer = Renderer::new(engine, &model, &style, &options)?;
    measured(&mut renderer, &camera(space_of(&volume), SMOKE_SIZE, 0.0))
}

/// The shared model whose number of triangles is next to that of the goal, or a sample model of the project.
fn usual_model() -> PathBuf {
    let shared = shared_models().join("skull_400k.glb");
    if shared.is_file() {
        return shared;
    }
    eprintln!("there is no ../shared/assets/models/skull_400k.glb; a sample model is drawn");
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/still_life.glb")
}

/// Draws a few times; gives what every pass asked for, and the least time that it took.
fn measured(renderer: &mut Renderer<'_>, camera: &Camera) -> Outcome<Vec<Row>> {
    // Draw: the first frame compiles, and a card is warm once the next ones get no faster.
    renderer.draw(camera)?;
    let start = Instant::now();
    let (mut best, mut since) = (Duration::MAX, start);
    while since.elapsed() < SETTLED && start.elapsed() < MOST_WARMING {
        let times = renderer.draw(camera)?.times;
        let sum: Duration = times.iter().map(|pass| pass.time).sum();
        if sum < best.mul_f64(0.98) {
            (best, since) = (sum, Instant::now());
        }
    }

    // Keep the least times.
    let mut least: Vec<(&str, f64)> = Vec::new();
    for _ in 0..RUNS {
        let times = renderer.draw(camera)?.times;
        let times = times
            .iter()
            .map(|pass| (pass.name, pass.time.as_secs_f64() * 1e3));
        if least.is_empty() {
            least = times.collect();
        } else {
            for ((_, least), (_, ms)) in least.iter_mut().zip(times) {
                *least = least.min(ms);
            }
        }
    }

    // Put the nodes of each pass together.
    let mut rows: Vec<Row> = Vec::new();
    for pass in renderer.pass_costs()? {
        match rows.iter_mut().find(|row| row.name == pass.name) {
            Some(row) => row.cost += pass.cost,
            None => rows.push(Row {
                name: pass.name,
                cost: pass.cost,
                measured_ms: None,
            }),
        }
    }
    for (name, ms) in least {
        if let Some(row) = rows.iter_mut().find(|row| row.name == name) {
            *row.measured_ms.get_or_insert(0.0) += ms;
        }
    }
    Ok(rows)
}

/// The sum of some passes, and of their times.
fn sum(rows: &[Row]) -> (Cost, f64) {
    let mut cost = Cost::default();
    for row in rows {
        cost += row.cost;
    }
    (cost, rows.iter().filter_map(|row| row.measured_ms).sum())
}

fn report(job: &Job, engine: &str, rows: &[Row]) {
    println!("# A frame on graphics cards, predicted\n");
    println!("Predicted, not measured: by counts of a frame and by data sheets of cards.\n");
    println!("- machine: {}", machine::description());
    println!("- adapter of the times that are measured: {engine}");
    println!("- code: {}, {} build", machine::code(), build());
    println!("- load average at the start: {}", machine::load());
    println!(
        "- scene: {}, {} triangles, `{}`, {}x{}",
        job.name,
        job.subject.triangle_count(),
        job.preset,
        job.size[0],
        job.size[1]
    );
    println!(
        "- a pass of it draws strokes; finding them, on the processor or in graphs of their own, is no part of it\n"
    );
    println!("{RULES}");

    let (frame, measured_ms) = sum(rows);
    passes(job, engine, rows, (frame, measured_ms));
    cards(engine, &frame, measured_ms);
    goals(job, &frame);
}

/// How this program was built.
fn build() -> &'static str {
    if cfg!(debug_assertions) {
        "development"
    } else {
        "release"
    }
}

/// What every pass asks for.
fn passes(job: &Job, engine: &str, rows: &[Row], (frame, measured_ms): (Cost, f64)) {
    println!("## Passes\n");
    let adapter = engine.split(" (").next().unwrap_or(engine);
    let mut table = Table::new([
        "pass".to_owned(),
        "launches".to_owned(),
        "workgroups".to_owned(),
        "invocations".to_owned(),
        "barriers".to_owned(),
        "in a group".to_owned(),
        "read, MB".to_owned(),
        "of it at most".to_owned(),
        "written, MB".to_owned(),
        "bytes a pixel".to_owned(),
        format!("predicted at {} GB/s, ms", GOAL.gigabytes_per_s),
        format!("measured on {adapter}, ms"),
    ]);
    let mut add = |name: &str, cost: &Cost, measured_ms: Option<f64>| {
        let megabytes = |bytes: u64| format!("{:.2}", bytes as f64 / 1e6);
        let cells = [
            cost.launches.to_string(),
            cost.workgroups.to_string(),
            cost.invocations.to_string(),
            cost.barriers.to_string(),
            cost.workgroup_barriers.to_string(),
            megabytes(cost.read_bytes),
            megabytes(cost.whole_bytes),
            megabytes(cost.written_bytes),
            format!("{:.1}", cost.bytes() as f64 / job.pixels()),
            format!("{:.3}", GOAL.predicted_ms(cost)),
            measured_ms.map_or_else(|| "-".to_owned(), |ms| format!("{ms:.2}")),
        ];
        table.add(name, cells);
    };
    for row in rows {
        add(row.name, &row.cost, row.measured_ms);
    }
    add("frame", &frame, Some(measured_ms));
    println!("{table}");
}

/// What the frame takes on every card, and the truth where this machine has that card.
fn cards(engine: &str, frame: &Cost, measured_ms: f64) {
    println!("## The frame, predicted\n");
    let mut table = Table::new([
        "card",
        "GB/s",
        "us a launch",
        "predicted, ms",
        "of it launches, ms",
        "measured here, ms",
    ]);
    for card in CARDS.iter().chain([&GOAL]) {
        let measured = match card.is_described_by(engine) {
            true => format!("{measured_ms:.2}"),
            false => "-".to_owned(),
        };
        let cells = [
            card.gigabytes_per_s.to_string(),
            card.launch_us.to_string(),
            format!("{:.2}", card.predicted_ms(frame)),
            format!("{:.2}", card.launches_ms(frame)),
            measured,
        ];
        table.add(card.name, cells);
    }
    println!("{table}");
}

/// Whether the goals are met by the model.
fn goals(job: &Job, frame: &Cost) {
    println!("## The goals, predicted\n");
    let [ms, best, worst] =
        [GOAL.launch_us, 3.0, 10.0].map(|us| GOAL.launching_in(us).predicted_ms(frame));
    println!(
        "- under {GOAL_MS} ms at {} GB/s, asked of 300000 triangles with strokes: predicted {ms:.2} ms ({best:.2} to \
         {worst:.2} with launches of 3 to 10 us) for {} triangles with strokes that were found before, so it {}",
        GOAL.gigabytes_per_s,
        job.subject.triangle_count(),
        verdict(ms < GOAL_MS)
    );
    let bytes = frame.bytes() as f64 / job.pixels();
    let most = frame.whole_bytes as f64 / job.pixels();
    println!(
        "- at most {GOAL_BYTES_A_PIXEL} bytes a pixel: {bytes:.0}, of which {most:.0} are an upper bound; so it {}",
        verdict(bytes <= GOAL_BYTES_A_PIXEL)
    );
}

/// What other frames ask for, a row each.
fn others(job: &Job, engine: &dyn Engine) -> Outcome<()> {
    println!("\n## Other frames, predicted\n");
    let described = engine.describe();
    let adapter = described.split(" (").next().unwrap_or(&described);
    let [older, newer, ..] = CARDS;
    let mut table = Table::new([
        "frame".to_owned(),
        "triangles".to_owned(),
        "size".to_owned(),
        "launches".to_owned(),
        "bytes a pixel".to_owned(),
        format!("predicted on {}, ms", older.name),
        format!("predicted on {}, ms", newer.name),
        format!("predicted at {} GB/s, ms", GOAL.gigabytes_per_s),
        format!("measured on {adapter}, ms"),
        "of it the slowest pass".to_owned(),
    ]);
    let mut add = |name: String, triangles: usize, size: [u32; 2], rows: &[Row]| {
        let (cost, measured_ms) = sum(rows);
        let predicted = [older, newer, GOAL].map(|card| format!("{:.2}", card.predicted_ms(&cost)));
        let mut cells = vec![
            triangles.to_string(),
            format!("{}x{}", size[0], size[1]),
            cost.launches.to_string(),
            format!("{:.0}", cost.bytes() as f64 / pixel_count(size)),
        ];
        cells.extend(predicted);
        cells.push(format!("{measured_ms:.2}"));
        cells.push(slowest(rows));
        table.add(name, cells);
    };
    for (ball, preset, setting, size) in OTHERS {
        let ball = ball.map(Subject::ball).transpose()?;
        let (of, subject) = match &ball {
            Some(ball) => ("a ball", ball),
            None => (&*job.name, &job.subject),
        };
        let mut style = Style::preset(preset)?;
        let mut look = preset.to_owned();
        if !setting.is_empty() {
            style.set(setting)?;
            look = format!("{preset}, {setting}");
        }
        let rows = measure_subject(engine, subject, &style, size)?;
        let triangles = subject.triangle_count();
        add(format!("{of}, `{look}`"), triangles, size, &rows);
    }
    let smoke = measure_smoke(engine)?;
    add("plume, `smoke-cel-2`".to_owned(), 0, SMOKE_SIZE, &smoke);
    println!("{table}");
    Ok(())
}

/// The pass that takes longest, and its milliseconds.
fn slowest(rows: &[Row]) -> String {
    let timed = rows
        .iter()
        .filter_map(|row| Some((row.name, row.measured_ms?)));
    let slowest = timed.max_by(|(_, a), (_, b)| a.total_cmp(b));
    slowest.map_or_else(|| "-".to_owned(), |(name, ms)| format!("{name}, {ms:.2}"))
}

/// Whether a goal is met, in words.
fn verdict(is_met: bool) -> &'static str {
    if is_met {
        "is met by the model for this frame"
    } else {
        "is not met by the model for this frame"
    }
}
