//! Times lines of a mesh for the comparison with other programs and prints one line of JSON.
//!
//! `whole` is what programs do that keep nothing: mesh in, visible strokes out. `prepare` and `view` are its parts
//! where the model is kept and the camera moves. Reading the file is outside the clock.

use std::error::Error;
use std::path::Path;

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::subjects::{SIZE, benchmark_camera};
use npr_benches::memory;
use npr_benches::timing::{Times, elapsed_ms};
use npr_core::camera::Camera;
use npr_core::crease::CreaseFrom;
use npr_render::{LineModel, LineModelOptions, LineOptions, LineSource};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::{Style, WidthSource};
use npr_vector::stroke::Drawing;
use serde_json::{Value, json};

/// Runs that are not counted: memory and threads come into being.
const WARM_UP: usize = 2;

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (file, runs) = match &words[..] {
        [file] => (file, 9),
        [file, runs] => (file, runs.parse()?),
        _ => return Err("usage: lines_race MESH.obj [RUNS]".into()),
    };
    let scene = load(Path::new(file), &LoadOptions::default())?;
    println!("PEER {}", race(&scene, file, runs)?);
    Ok(())
}

fn race(scene: &Scene, file: &str, runs: usize) -> Outcome<Value> {
    let mut times = [const { Vec::new() }; 3];
    let mut drawing = Drawing::default();
    for run in 0..WARM_UP + runs {
        let mut model = None;
        let prepare =
            elapsed_ms(|| model = Some(LineModel::new(scene, &LineModelOptions::default())));
        let Some(model) = model.transpose()? else {
            continue;
        };
        let (first, _) = timed_draw(&model, &benchmark_camera())?;
        // A camera that moves a little: nothing of the view before may be kept.
        let camera = moved(run);
        let (view, drawn) = timed_draw(&model, &camera)?;
        if run >= WARM_UP {
            let taken = [prepare + first, prepare, view];
            times
                .iter_mut()
                .zip(taken)
                .for_each(|(times, ms)| times.push(ms));
        }
        drawing = drawn;
    }
    let [whole, prepare, view] = times.map(|times| {
        let (runs, times) = (times.len(), Times::of(times));
        json!({ "median_ms": rounded(times.median), "min_ms": rounded(times.least), "runs": runs })
    });
    let mesh = Path::new(file)
        .file_name()
        .unwrap_or_default()
        .to_string_lossy();
    Ok(json!({
        "peer": "npr",
        "mesh": mesh,
        "triangles": scene.triangle_count(),
        "threads": rayon::current_num_threads(),
        "whole": whole,
        "prepare": prepare,
        "view": view,
        "strokes": drawing.strokes.len(),
        "points": drawing.strokes.iter().map(|stroke| stroke.points.len()).sum::<usize>(),
        "peak_rss_mb": memory::peak_bytes().map(|bytes| bytes / 1_000_000),
    }))
}

fn timed_draw(model: &LineModel, camera: &Camera) -> Outcome<(f64, Drawing)> {
    let wanted = Wanted::default();
    let options = LineOptions {
        kinds: wanted.kinds.iter().copied().collect(),
        crease: wanted.crease as f32,
        crease_from: CreaseFrom::Faces,
        method: LineSource::Edges,
        smooth: false,
        ..LineOptions::new(SIZE)
    };
    // Line Art's lines have one width; swelling with curvature, and making room between lines, would be more work than
    // it does.
    let mut style = Style::default();
    style.line.width.source = WidthSource::Constant;
    style.line.width.room = 0.0;
    let mut drawing = None;
    let ms = elapsed_ms(|| drawing = Some(model.draw(camera, &style, &options)));
    Ok((ms, drawing.transpose()?.unwrap_or_default()))
}

/// The benchmark's camera, moved aside by a thousandth of its distance for every run.
fn moved(run: usize) -> Camera {
    let camera = benchmark_camera();
    let [x, y, z] = camera.eye;
    Camera {
        eye: [x + 0.0035 * run as f32, y, z],
        ..camera
    }
}

fn rounded(ms: f64) -> f64 {
    (ms * 1e3).round() / 1e3
}
