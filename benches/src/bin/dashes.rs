//! Counts dashes in line pictures of a few models and prints the tables kept in `benches/results/dashes.md`; with
//! `--preset NAME` those of another preset, with `--set KEY=VALUE` those of a style changed so.
//!
//! Run by `cargo xtask measure dashes`. A measuring program, not a test: it fails only where loading or drawing fails.

use std::error::Error;

use npr_benches::comic::gallery::MODELS;
use npr_benches::dashes::{InkPicture, LEAST_AREA_PX, LEAST_EXTENT_PX};
use npr_benches::lines::subjects::{SIZE, shared_models};
use npr_benches::machine;
use npr_benches::table::Table;
use npr_core::camera::DEFAULT_FOV_DEG;
use npr_gpu::processor::Processor;
use npr_render::{LineOptions, RendererOptions, Subject};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::Style;
use npr_vector::stroke::Stroke;

/// What is measured where nobody asks for another preset.
const PRESET: &str = "ink";

/// The method that is compared, and the one that it is compared with.
const METHODS: [&str; 2] = ["strokes", "shape"];

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The dashes of a picture.
struct Count {
    dashes: usize,
    length_px: f64,
    /// Strokes shorter than a dash, of all strokes; of methods without strokes none.
    short: usize,
    strokes: usize,
}

impl Count {
    /// Dashes on 1000 pixels of line.
    fn rate(&self) -> f64 {
        1000.0 * self.dashes as f64 / self.length_px.max(1.0)
    }
}

fn main() -> Outcome<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let (preset, settings) = match words.as_slice() {
        ["--preset", preset, rest @ ..] => (*preset, rest),
        rest => (PRESET, rest),
    };
    let mut style = Style::preset(preset)?;
    for setting in settings.chunks(2) {
        let ["--set", setting] = setting else {
            return Err("usage: dashes [--preset NAME] [--set KEY=VALUE]..".into());
        };
        style.set(setting)?;
    }
    report(preset, &style)
}

/// Prints the table of a style.
fn report(preset: &str, style: &Style) -> Outcome<()> {
    println!("# Dashes\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}\n", machine::code());
    println!(
        "Lines of preset {preset}@{} at {}x{}, by method `{}` and, for comparison, `{}`. Ink is what lines cover by \
         more than half of a pixel. A dash is a piece of it, joined by sides and corners, below {LEAST_AREA_PX} square \
         pixels or {LEAST_EXTENT_PX} pixels of extent. The length of line is half of the way around the ink, by \
         Cauchy and Crofton. Short strokes are below {LEAST_EXTENT_PX} pixels long; most of them join others, and are \
         no dashes.\n",
        style.version, SIZE[0], SIZE[1], METHODS[0], METHODS[1]
    );
    let mut table = Table::new([
        "model",
        "line, 1000 px",
        "dashes",
        "on 1000 px",
        "short strokes",
        "line of shape",
        "dashes of shape",
        "on 1000 px",
        "ratio",
    ]);
    for path in MODELS.map(|name| shared_models().join(name)) {
        if !path.is_file() {
            eprintln!("left out: there is no {}", path.display());
            continue;
        }
        let scene = load(&path, &LoadOptions::default())?;
        let [ours, shape] = [
            count(&scene, style, METHODS[0])?,
            count(&scene, style, METHODS[1])?,
        ];
        let ratio = match shape.dashes {
            0 if ours.dashes == 0 => "none in both".to_owned(),
            0 => "none in shape".to_owned(),
            _ => format!("{:.2}", ours.rate() / shape.rate()),
        };
        let cells = [
            format!("{:.1}", ours.length_px / 1000.0),
            ours.dashes.to_string(),
            format!("{:.2}", ours.rate()),
            format!("{} of {}", ours.short, ours.strokes),
            format!("{:.1}", shape.length_px / 1000.0),
            shape.dashes.to_string(),
            format!("{:.2}", shape.rate()),
            ratio,
        ];
        table.add(
            path.file_stem().unwrap_or_default().to_string_lossy(),
            cells,
        );
    }
    println!("{table}");
    Ok(())
}

/// Draws a scene by a method and counts.
fn count(scene: &Scene, style: &Style, method: &str) -> Outcome<Count> {
    // Draw the frame with its layers.
    let mut style = style.clone();
    style.set(&format!("line.method={method}"))?;
    let subject = Subject::new(scene, &style)?;
    let aspect = SIZE[0] as f32 / SIZE[1] as f32;
    let camera = subject.model.framing(aspect, DEFAULT_FOV_DEG.to_radians());
    let options = RendererOptions {
        layers: true,
        ..RendererOptions::new(SIZE)
    };
    let frame = subject
        .renderer(&Processor, &style, &options)?
        .draw(&camera)?;
    let ink = InkPicture::new(SIZE, frame.layers.iter().map(|pixel| pixel.line[3]));

    // Draw the same lines as curves, and look at their lengths.
    let strokes = match &subject.lines {
        Some(lines) => {
            let options = LineOptions::of_style(&style, SIZE);
            lines.draw(&camera, &style, &options)?.strokes
        }
        None => Vec::new(),
    };
    let is_short = |stroke: &&Stroke| stroke.length() < LEAST_EXTENT_PX;
    Ok(Count {
        dashes: ink.pieces().iter().filter(|piece| piece.is_dash()).count(),
        length_px: ink.length(),
        short: strokes.iter().filter(is_short).count(),
        strokes: strokes.len(),
    })
}
