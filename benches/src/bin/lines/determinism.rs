//! Whether a drawing is the same in every run and for any number of threads.

use npr_benches::lines::digest::digest;
use npr_benches::lines::subjects::{benchmark_camera, knot, scene_of};
use npr_benches::solid::bumpy_ball;
use npr_benches::table::Table;
use npr_render::{LineModel, LineModelOptions};
use npr_scene::Scene;

use crate::Outcome;
use crate::arguments::Arguments;
use crate::way::{Way, ways};

/// Drawings that are compared.
const RUNS: usize = 20;

/// Threads that drawings must not depend on.
const THREADS: [usize; 4] = [1, 2, 3, 8];

/// Whether a drawing is the same in every run and for any number of threads.
pub fn determinism(arguments: &Arguments) -> Outcome<()> {
    let size = if arguments.quick { 10_000 } else { 80_000 };
    let scenes = [
        ("bumpy ball", bumpy_ball(size)),
        ("knot", scene_of(knot(size as u32))),
    ];
    let mut table = Table::new(["drawing", "digest", "runs", "threads", "equal"]);
    for (name, scene) in scenes {
        for way in ways() {
            // Draw again and again, with each number of threads.
            let mut digests = Vec::new();
            for threads in THREADS {
                let pool = rayon::ThreadPoolBuilder::new()
                    .num_threads(threads)
                    .build()?;
                for _ in 0..RUNS / THREADS.len() {
                    let drawn = pool
                        .install(|| draw_anew(&scene, &way).map_err(|error| error.to_string()))?;
                    digests.push(drawn);
                }
            }

            // Compare the digests.
            let equal = if digests.iter().all(|found| *found == digests[0]) {
                "yes"
            } else {
                "**no**"
            };
            let rest = [
                format!("{:016x}", digests[0]),
                digests.len().to_string(),
                format!("{THREADS:?}"),
                equal.to_owned(),
            ];
            table.add(format!("{name}, {}", way.name), rest);
        }
    }
    println!("## Same drawing every time\n\n{table}");
    Ok(())
}

/// Digest of a drawing of a model prepared for it.
fn draw_anew(scene: &Scene, way: &Way) -> Outcome<u64> {
    let model = LineModel::new(scene, &LineModelOptions::default())?;
    Ok(digest(&way.draw(&model, &benchmark_camera())?))
}
