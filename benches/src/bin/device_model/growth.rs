//! How the passes of a frame grow with triangles and pixels, measured on the adapter that is there.

use std::time::Instant;

use npr_benches::cost::{Cost as Fit, Sample};
use npr_benches::subject::Subject;
use npr_benches::table::Table;
use npr_gpu::engine::Engine;
use npr_render::RendererOptions;
use npr_stylesheet::Style;

use super::{Outcome, RUNS, Row, measured, pixel_count, sum};

/// Triangles of the balls.
const TRIANGLES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Sizes of the frames.
const SIZES: [[u32; 2]; 2] = [[1920, 1080], [3840, 2160]];

/// How they are drawn: lines are seen by passes, so that most of a frame's work is the device's.
const PRESET: &str = "toon";
const SETTING: &str = "line.visibility=sampled";

/// A frame that was measured.
struct Frame {
    triangles: usize,
    size: [u32; 2],
    rows: Vec<Row>,
    /// The least time from asking for a frame to having its pixels.
    whole_ms: f64,
}

impl Frame {
    fn measure(engine: &dyn Engine, subject: &Subject, size: [u32; 2]) -> Outcome<Self> {
        // Count and time its passes.
        let mut style = Style::preset(PRESET)?;
        style.set(SETTING)?;
        let options = RendererOptions::new(size);
        let mut renderer = subject.prepared.renderer(engine, &style, &options)?;
        let rows = measured(&mut renderer, &subject.camera)?;

        // Time it as a whole.
        let mut whole_ms = f64::INFINITY;
        for _ in 0..RUNS {
            let start = Instant::now();
            renderer.draw(&subject.camera)?;
            whole_ms = whole_ms.min(start.elapsed().as_secs_f64() * 1e3);
        }
        Ok(Self {
            triangles: subject.triangle_count(),
            size,
            rows,
            whole_ms,
        })
    }

    fn title(&self) -> String {
        format!("{} at {}x{}", self.triangles, self.size[0], self.size[1])
    }

    /// Milliseconds of one of its passes, where it has that.
    fn pass_ms(&self, name: &str) -> Option<f64> {
        let row = self.rows.iter().find(|row| row.name == name)?;
        row.measured_ms
    }

    fn sample(&self, ms: f64) -> Sample {
        Sample {
            triangles: self.triangles as f64,
            pixels: pixel_count(self.size),
            ms,
        }
    }
}

/// Measures frames of balls, and prints what they ask for, how long their passes take, and how that grows.
pub fn report(engine: &dyn Engine) -> Outcome<()> {
    // Measure.
    let mut frames = Vec::new();
    for triangles in TRIANGLES {
        let subject = Subject::ball(triangles)?;
        for size in SIZES {
            frames.push(Frame::measure(engine, &subject, size)?);
        }
    }

    // Print.
    println!("\n## Growth\n");
    println!(
        "Balls that fill the frame's height, `{PRESET}` with `{SETTING}`; each time is the least of {RUNS}, in ms. A \
         whole frame includes what the processor does for it (finding lines) and reading its pixels back.\n"
    );
    whole_frames(&frames);
    passes(&frames);
    Ok(())
}

/// What whole frames ask for and take.
fn whole_frames(frames: &[Frame]) {
    let mut table = Table::new([
        "frame",
        "launches",
        "invocations",
        "read, MB",
        "written, MB",
        "passes, ms",
        "whole, ms",
    ]);
    for frame in frames {
        let (cost, ms) = sum(&frame.rows);
        let cells = [
            cost.launches.to_string(),
            cost.invocations.to_string(),
            format!("{:.1}", cost.read_bytes as f64 / 1e6),
            format!("{:.1}", cost.written_bytes as f64 / 1e6),
            format!("{ms:.2}"),
            format!("{:.1}", frame.whole_ms),
        ];
        table.add(frame.title(), cells);
    }
    println!("{table}");
}

/// What the passes of each frame take, and how that grows.
fn passes(frames: &[Frame]) {
    println!("T in 100 000 triangles, P in millions of pixels, by least squares.\n");
    let titles = frames.iter().map(Frame::title);
    let columns = ["pass".to_owned()].into_iter().chain(titles);
    let columns = columns.chain(["ms".to_owned(), "R^2".to_owned()]);
    let mut table = Table::new(columns.collect::<Vec<_>>());

    // Name the passes of all frames once, in their order.
    let mut names: Vec<&str> = Vec::new();
    for row in frames.iter().flat_map(|frame| &frame.rows) {
        if !names.contains(&row.name) && row.measured_ms.is_some() {
            names.push(row.name);
        }
    }

    // Add their rows, and one of them all.
    let mut add = |name: &str, times: Vec<Option<f64>>| {
        let samples = frames.iter().zip(&times);
        let samples: Vec<Sample> = samples
            .filter_map(|(frame, ms)| Some(frame.sample((*ms)?)))
            .collect();
        let fit = Fit::fit_sum(&samples);
        let in_ms = |ms: &Option<f64>| ms.map_or_else(|| "-".to_owned(), |ms| format!("{ms:.3}"));
        let mut cells: Vec<String> = times.iter().map(in_ms).collect();
        cells.push(fit.map_or_else(|| "-".to_owned(), |fit| in_microseconds(&fit)));
        cells.push(fit.map_or_else(|| "-".to_owned(), |fit| format!("{:.3}", fit.r_squared)));
        table.add(name, cells);
    };
    for name in names {
        add(
            name,
            frames.iter().map(|frame| frame.pass_ms(name)).collect(),
        );
    }
    let all = frames.iter().map(|frame| Some(sum(&frame.rows).1));
    add("all passes", all.collect());
    println!("{table}");
}

/// A fit to thousandths.
fn in_microseconds(fit: &Fit) -> String {
    format!(
        "{:.3} {:+.3} T {:+.3} P",
        fit.base_ms, fit.triangles_ms, fit.pixels_ms
    )
}
