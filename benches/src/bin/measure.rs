//! Measures whole frames on the processor and prints the report kept in `benches/results/frames.md`.
//!
//! `cargo run --release -p npr-benches > benches/results/frames.md`. A measuring program, not a test: it takes
//! a minute or two and fails only where drawing fails.

use std::error::Error;
use std::path::Path;
use std::process::Command;

use npr_benches::cost::{Cost, Sample};
use npr_benches::subject::{Subject, bunny_path};
use npr_benches::table::Table;
use npr_benches::timing::{Times, elapsed_ms};
use npr_benches::{machine, memory};
use npr_gpu::processor::Processor;
use npr_render::RendererOptions;
use npr_stylesheet::Style;

/// Triangles of the published table, and one number between.
const TRIANGLE_COUNTS: [usize; 4] = [960, 9_566, 33_200, 66_400];

/// Frame sizes of the published table, and one between.
const SIZES: [[u32; 2]; 4] = [[640, 360], [960, 540], [1280, 720], [1920, 1080]];

/// Frame pixels along a mask pixel in the published table.
const MASK_SCALES: [f32; 4] = [1.0, 1.5, 3.0, 6.0];

/// The largest frame.
const FULL_HD: [u32; 2] = [1920, 1080];

/// Runs behind every figure.
const RUNS: usize = 9;

/// Asks this program to draw one file, print its peak of memory, and end.
const PEAK: &str = "--peak";

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.as_slice() {
        [] => report(),
        [flag, file] if flag == PEAK => print_peak(file.as_ref()),
        _ => Err("usage: measure > benches/results/frames.md".into()),
    }
}

/// A style to measure in.
struct Look {
    name: &'static str,
    /// Why the costs of triangles and pixels add up in it, or do not.
    note: &'static str,
    style: Style,
}

impl Look {
    /// The published method, lines alone, tones under lines drawn on shapes, and what the command draws unasked.
    fn all() -> Outcome<[Self; 4]> {
        let mut published = Style::preset("okuya")?;
        published.antialias.samples = 1;
        Ok([
            Self {
                name: "okuya, 1 sample",
                note: "Every edge of a front face is drawn with width and looked up in the mask, so ink grows with \
                       both.",
                style: published,
            },
            Self {
                name: "technical@1",
                note: "Edges are chosen by kind before they are drawn, and there is one tone.",
                style: Style::preset("technical@1")?,
            },
            Self {
                name: "toon@1",
                note: "Lines are found on images and drawn on shapes. Triangles that lie in one tone are shaded once; \
                       large ones cross tones more often and are shaded by pixel.",
                style: Style::preset("toon@1")?,
            },
            Self {
                name: "toon",
                note: "The same with strokes, which are found anew in every frame.",
                style: Style::default(),
            },
        ])
    }
}

fn report() -> Outcome<()> {
    // Say what was measured, and where.
    println!("# Whole frames\n");
    println!("- machine: {}; no graphics device", machine::description());
    println!("- code: {}", machine::code());
    println!(
        "- each figure: the median of {RUNS} frames and, in brackets, the least, in ms, on the processor engine; \
         loading, welding and curvature happen before the clock starts"
    );
    println!("- load average at the start: {}\n", machine::load());

    let looks = Look::all()?;

    // Measure how costs grow with triangles and pixels.
    println!("## Triangles and pixels [Okuya 2016, table 1]\n");
    println!("A bumpy ball that fills the frame's height.\n");
    for look in &looks {
        let grid = measure_grid(look)?;
        print_fit(&grid);
    }
    let has_mask = |look: &Look| !look.style.has_curves();
    print_mask_scales(&looks.into_iter().filter(has_mask).collect::<Vec<_>>())?;
    print_bunny()?;
    println!("Load average at the end: {}.", machine::load());
    Ok(())
}

/// What is timed for one figure.
struct Cell<'a> {
    subject: &'a Subject,
    style: &'a Style,
    size: [u32; 2],
}

impl Cell<'_> {
    /// Time of the second frame of a new stage.
    fn frame_ms(&self) -> Outcome<f64> {
        let mut renderer = self
            .subject
            .warm_renderer(&Processor, self.style, self.size)?;
        let mut drawn = Ok(());
        let ms = elapsed_ms(|| drawn = renderer.draw(&self.subject.camera).map(drop));
        drawn?;
        Ok(ms)
    }
}

/// The times of every cell.
///
/// Rounds over all cells, so that a minute in which the machine is busy touches them alike.
fn times_of(what: &str, cells: &[Cell<'_>]) -> Outcome<Vec<Times>> {
    let mut times = vec![Vec::new(); cells.len()];
    for round in 0..RUNS {
        eprintln!("{what}: round {} of {RUNS}", round + 1);
        for (cell, times) in cells.iter().zip(&mut times) {
            times.push(cell.frame_ms()?);
        }
    }
    Ok(times.into_iter().map(Times::of).collect())
}

/// Times every number of triangles at every size, prints them, and gives the least: other work on the machine only
/// adds to them.
fn measure_grid(look: &Look) -> Outcome<Vec<Sample>> {
    // Make a frame for every number of triangles and every size.
    let subjects = TRIANGLE_COUNTS
        .iter()
        .map(|count| Subject::ball(*count))
        .collect::<Result<Vec<_>, _>>()?;
    let of_subject = |subject| {
        SIZES.map(|size| Cell {
            subject,
            style: &look.style,
            size,
        })
    };
    let cells: Vec<Cell> = subjects.iter().flat_map(of_subject).collect();
    let times = times_of(look.name, &cells)?;
    print_grid(look, &times);

    // Keep the least times, which costs are fitted to.
    let samples = cells.iter().zip(times);
    Ok(samples
        .map(|(cell, times)| Sample {
            triangles: cell.subject.triangle_count() as f64,
            pixels: f64::from(cell.size[0]) * f64::from(cell.size[1]),
            ms: times.least,
        })
        .collect())
}

fn print_grid(look: &Look, times: &[Times]) {
    let head = SIZES.map(|[width, height]| format!("{width}x{height}"));
    let mut table = Table::new(std::iter::once("triangles".to_owned()).chain(head));
    for (count, row) in TRIANGLE_COUNTS.iter().zip(times.chunks(SIZES.len())) {
        table.add(count.to_string(), row.iter().map(Times::to_string));
    }
    println!("### Preset {}\n\n{}\n\n{table}", look.name, look.note);
}

/// Says whether the costs of triangles and of pixels add up.
fn print_fit(samples: &[Sample]) {
    let (Some(both), Some(sum)) = (Cost::fit(samples), Cost::fit_sum(samples)) else {
        return;
    };
    println!(
        "Least squares over the least times, T in 100 000 triangles, P in millions of pixels:\n"
    );
    println!("    t = {sum}    R^2 {:.4}", sum.r_squared);
    println!("    t = {both}    R^2 {:.4}\n", both.r_squared);
    let last = samples.len() - 1;
    let steps =
        [0, last + 1 - SIZES.len()].map(|row| samples[row + SIZES.len() - 1].ms - samples[row].ms);
    println!(
        "From the smallest to the largest frame adds {:.1} ms at {} triangles and {:.1} ms at {}. \
         In the largest frame of most triangles the product makes up {:.1} % of the time.\n",
        steps[0],
        TRIANGLE_COUNTS[0],
        steps[1],
        TRIANGLE_COUNTS[3],
        100.0 * both.product_share(samples[last].triangles, samples[last].pixels)
    );
}

fn print_mask_scales(looks: &[Look]) -> Outcome<()> {
    let subject = Subject::ball(TRIANGLE_COUNTS[3])?;

    // Time every look with every size of mask pixels.
    let scaled = |scale| {
        looks
            .iter()
            .map(move |look| at_mask_scale(&look.style, scale))
    };
    let styles: Vec<Style> = MASK_SCALES.into_iter().flat_map(scaled).collect();
    let cell = |style| Cell {
        subject: &subject,
        style,
        size: FULL_HD,
    };
    let cells: Vec<Cell> = styles.iter().map(cell).collect();
    let times = times_of("mask scales", &cells)?;

    let head = ["mask", "detect.scale"]
        .into_iter()
        .chain(looks.iter().map(|look| look.name));
    let mut table = Table::new(head);
    for (scale, row) in MASK_SCALES.iter().zip(times.chunks(looks.len())) {
        let cells = std::iter::once(scale.to_string()).chain(row.iter().map(Times::to_string));
        table.add(format!("{:.0} rows", 1080.0 / scale), cells);
    }
    println!("## Size of the mask [Okuya 2016, table 2]\n");
    println!(
        "{} triangles, drawn at 1920x1080.\n\n{table}",
        TRIANGLE_COUNTS[3]
    );
    Ok(())
}

/// A style with mask pixels of `scale` frame pixels.
fn at_mask_scale(style: &Style, scale: f32) -> Style {
    let mut style = style.clone();
    style.detect.scale = scale;
    style
}

fn print_bunny() -> Outcome<()> {
    let Some(path) = bunny_path() else {
        return Ok(());
    };
    let (subject, style) = (Subject::from_file(&path)?, Style::default());
    let cell = Cell {
        subject: &subject,
        style: &style,
        size: FULL_HD,
    };

    // Time whole frames.
    let times = times_of("bunny", &[cell])?[0];
    println!("## A scanned bunny at 1920x1080, preset `toon`\n");
    println!(
        "- {} triangles, framed as the command frames it",
        subject.triangle_count()
    );
    println!("- frame: {times} ms");
    println!(
        "- most memory of a process that loads, prepares and draws it: {} MB\n",
        child_peak(&path)?
    );

    // Time the passes of one frame.
    let frame = subject
        .warm_renderer(&Processor, &style, FULL_HD)?
        .draw(&subject.camera)?;
    let mut table = Table::new(["pass", "ms in one frame"]);
    for pass in &frame.times {
        table.add(
            format!("`{}`", pass.name),
            [format!("{:.1}", pass.time.as_secs_f64() * 1e3)],
        );
    }
    println!("{table}");
    Ok(())
}

/// Peak memory of a child process that draws a file, in megabytes; `unknown` where the system does not tell.
fn child_peak(file: &Path) -> Outcome<String> {
    let output = Command::new(std::env::current_exe()?)
        .arg(PEAK)
        .arg(file)
        .output()?;
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

/// Draws a file at full HD and prints the most memory that took, in megabytes.
fn print_peak(file: &Path) -> Outcome<()> {
    let subject = Subject::from_file(file)?;
    let options = RendererOptions::new(FULL_HD);
    subject
        .prepared
        .renderer(&Processor, &Style::default(), &options)?
        .draw(&subject.camera)?;
    match memory::peak_bytes() {
        Some(bytes) => println!("{:.0}", bytes as f64 / 1e6),
        None => println!("unknown"),
    }
    Ok(())
}
