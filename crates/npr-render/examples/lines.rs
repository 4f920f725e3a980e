//! Draws the lines of a file: `cargo run --release --example lines -- model.glb out.svg [preset]`.

use npr_drawing::svg::{SvgOptions, write_svg};
use npr_render::{Kind, LineModel, LineModelOptions, LineOptions};
use npr_scene::{Limits, LoadOptions};
use npr_stylesheet::Style;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output, more @ ..] = arguments.as_slice() else {
        return Err("usage: lines MODEL OUT.svg [PRESET]".into());
    };
    let style = Style::preset(more.first().map_or("technical", String::as_str))?;

    // Lines need no textures.
    let limits = Limits {
        decode_images: false,
        ..Limits::default()
    };
    let start = Instant::now();
    let options = LoadOptions {
        limits,
        ..LoadOptions::default()
    };
    let scene = npr_scene::load(input.as_ref(), &options)?;
    eprintln!("loaded in {:?}", start.elapsed());
    let start = Instant::now();
    let model = LineModel::new(&scene, &LineModelOptions::default())?;
    eprintln!(
        "{} triangles prepared in {:?}",
        model.triangle_count(),
        start.elapsed()
    );

    let size = [1920, 1080];
    let camera = model.framing(16.0 / 9.0, 0.7);
    let options = LineOptions::of_style(&style, size);
    // The first view also prepares creases and intersections.
    model.draw(&camera, &style, &options)?;
    let start = Instant::now();
    let drawing = model.draw(&camera, &style, &options)?;
    eprintln!("a new view in {:?}", start.elapsed());

    for kind in Kind::ALL {
        let strokes = drawing.strokes.iter().filter(|stroke| stroke.kind == kind);
        let lengths: Vec<f64> = strokes.map(|stroke| stroke.length()).collect();
        let total: f64 = lengths.iter().sum();
        eprintln!(
            "{:14}{:6} strokes, {total:9.0} px",
            kind.name(),
            lengths.len()
        );
    }
    let svg = write_svg(&drawing, &SvgOptions::default());
    let mut file = tempfile::NamedTempFile::new_in(".")?;
    std::io::Write::write_all(&mut file, &svg)?;
    file.persist(output)?;
    Ok(())
}
