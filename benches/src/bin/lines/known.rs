//! Shapes whose outlines are known in closed form.

use npr_benches::lines::analytic::Solid;
use npr_benches::lines::measures::{Measures, measure};
use npr_benches::lines::subjects::{SIZE, benchmark_camera, scene_of};
use npr_benches::table::Table;
use npr_core::camera::Camera;
use npr_render::{LineModel, LineModelOptions};

use crate::Outcome;
use crate::arguments::Arguments;
use crate::way::ways;

/// Triangles of the meshes.
const SIZES: [u32; 4] = [1_000, 10_000, 100_000, 400_000];

/// How much further off than the benchmark's the eye is: the ring is larger than the unit ball.
const FURTHER: f32 = 1.7;

/// Measures shapes whose outline is known in closed form, as meshes from coarse to fine.
pub fn known_outlines(arguments: &Arguments) -> Outcome<()> {
    println!("## Outlines known in closed form\n");

    // Look from far enough that the whole outline is seen.
    let sizes = &SIZES[..if arguments.quick { 2 } else { SIZES.len() }];
    let camera = Camera {
        eye: benchmark_camera().eye.map(|v| FURTHER * v),
        ..benchmark_camera()
    };
    for (name, solid) in [("ball", Solid::Ball), ("ring", Solid::Ring { tube: 0.4 })] {
        // Measure every way against the outline in closed form.
        let exact = solid.reference(&camera, SIZE);
        let mut table = Table::new([
            "way and triangles",
            "recall at 1 px",
            "2 px",
            "3 px",
            "precision at 1 px",
            "2 px",
            "3 px",
            "strokes",
            "runs",
            "drawn runs",
            "bias, px",
        ]);
        for way in ways() {
            for size in sizes {
                let scene = scene_of(solid.mesh(*size));
                let model = LineModel::new(&scene, &LineModelOptions::default())?;
                let found = measure(&way.draw(&model, &camera)?, &exact);
                table.add(
                    format!("{}, {}", way.name, scene.triangle_count()),
                    cells(&found),
                );
            }
        }
        println!("### {name}\n\n{table}");
    }
    Ok(())
}

fn cells(found: &Measures) -> Vec<String> {
    let shares = found.recall.iter().chain(&found.precision);
    let shares = shares.map(|share| format!("{share:.4}"));
    let rest = [
        found.strokes.count.to_string(),
        found.runs.count.to_string(),
        found.drawn.count.to_string(),
        format!("{:+.3}", found.bias_px),
    ];
    shares.chain(rest).collect()
}
