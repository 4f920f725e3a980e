//! How time grows with the number of triangles.

use npr_benches::lines::scaling::exponent;
use npr_benches::lines::subjects::{benchmark_camera, knot, scene_of};
use npr_benches::machine;
use npr_benches::solid::bumpy_ball;
use npr_benches::table::Table;
use npr_benches::timing::{Times, elapsed_ms};
use npr_render::{LineModel, LineModelOptions};
use npr_scene::Scene;

use crate::Outcome;
use crate::arguments::Arguments;
use crate::way::{RUNS, Way, ways};

/// Triangles of the meshes.
const SIZES: [u32; 5] = [10_000, 31_622, 100_000, 316_226, 1_000_000];

/// A name, and scenes of about as many triangles as are asked for.
type Maker = (&'static str, fn(u32) -> Scene);

/// Measures how time grows with the number of triangles.
pub fn scaling(arguments: &Arguments) -> Outcome<()> {
    let sizes = &SIZES[..if arguments.quick { 2 } else { SIZES.len() }];
    let head = sizes
        .iter()
        .map(|size| format!("{size} triangles"))
        .chain(["grows as (n log n) to the".to_owned()]);
    let mut table = Table::new(std::iter::once("ms".to_owned()).chain(head));

    // Time meshes of a ball and of a knot, from small to large.
    let way = &ways()[0];
    let makers: [Maker; 2] = [
        ("bumpy ball", |size| bumpy_ball(size as usize / 2 * 2)),
        ("knot", |size| scene_of(knot(size))),
    ];
    for (name, scene_of_size) in makers {
        let mut rows = [const { Vec::new() }; 3];
        for size in sizes {
            let scene = scene_of_size(*size);
            let count = scene.triangle_count() as f64;
            for (row, times) in rows.iter_mut().zip(renderers(&scene, way)?) {
                row.push((count, times));
            }
        }

        // Fit the power by which each stage grows.
        for (renderer, row) in ["prepare", "first view", "next view"].iter().zip(&rows) {
            let medians: Vec<(f64, f64)> = row
                .iter()
                .map(|(count, times)| (*count, times.least))
                .collect();
            let fit = exponent(&medians).map_or_else(String::new, |power| format!("{power:.2}"));
            table.add(
                format!("{name}, {renderer}"),
                row.iter().map(|(_, times)| times.to_string()).chain([fit]),
            );
        }
    }

    // Print how they were timed.
    println!(
        "## How time grows\n\n{}, {} runs, median and, in brackets, the least, which the power is fitted to. Load \
         average {}.\n\n{table}",
        way.name,
        RUNS,
        machine::load()
    );
    Ok(())
}

/// Times of preparing a model, of its first drawing, and of one more.
fn renderers(scene: &Scene, way: &Way) -> Outcome<[Times; 3]> {
    let mut runs = [const { Vec::new() }; 3];
    for _ in 0..RUNS {
        let mut model = None;
        runs[0].push(elapsed_ms(|| {
            model = Some(LineModel::new(scene, &LineModelOptions::default()))
        }));
        let Some(model) = model.transpose()? else {
            continue;
        };
        for run in &mut runs[1..] {
            let mut drawing = None;
            run.push(elapsed_ms(|| {
                drawing = Some(way.draw(&model, &benchmark_camera()))
            }));
            drawing.transpose()?;
        }
    }
    Ok(runs.map(Times::of))
}
