//! Preparing meshes: how fast, and whether what comes out is sound.

use npr_benches::lines::analytic::Solid;
use npr_benches::lines::subjects::{knot, scene_of};
use npr_benches::machine;
use npr_benches::solid::bumpy_ball;
use npr_benches::table::Table;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_render::{LineModel, LineModelOptions};
use npr_scene::Scene;

use crate::Outcome;
use crate::arguments::Arguments;
use crate::way::{RUNS, times};

/// Triangles of the meshes.
const SIZES: [u32; 3] = [10_000, 100_000, 400_000];

/// Times preparing from raw triangles, and checks what comes out.
pub fn preparation(arguments: &Arguments) -> Outcome<()> {
    let sizes = &SIZES[..if arguments.quick { 1 } else { SIZES.len() }];
    let mut table = Table::new([
        "mesh",
        "triangles",
        "ms",
        "million triangles / s",
        "twins that do not return",
        "V - E + F",
        "expected",
        "open, crowded, flipped edges",
    ]);

    // Prepare meshes whose Euler characteristic is known.
    for size in sizes {
        let ring = Solid::Ring { tube: 0.4 };
        let meshes = [
            ("bumpy ball", bumpy_ball(*size as usize), 2),
            ("ring", scene_of(ring.mesh(*size)), 0),
            ("knot", scene_of(knot(*size)), 0),
        ];
        for (name, scene, expected) in meshes {
            table.add(name, cells(&scene, expected)?);
        }
    }

    // Print how they were timed.
    println!(
        "## Preparing meshes\n\nMedian of {RUNS} and, in brackets, the least. Load average {}.\n\n{table}",
        machine::load()
    );
    Ok(())
}

/// `expected` is Euler's characteristic.
fn cells(scene: &Scene, expected: i64) -> Outcome<Vec<String>> {
    let options = LineModelOptions::default();
    let times = times(|| LineModel::new(scene, &options).map(drop))?;
    let model = LineModel::new(scene, &options)?;
    let count = scene.triangle_count();
    Ok(vec![
        count.to_string(),
        times.to_string(),
        format!("{:.2}", count as f64 / times.median / 1e3),
        broken_twins(model.shape()).to_string(),
        euler(model.shape()).to_string(),
        expected.to_string(),
        odd_edges(model.shape()),
    ])
}

fn broken_twins(shape: &HalfEdgeMesh) -> usize {
    let twin = |half_edge: usize| shape.twins[half_edge];
    let returns = |half_edge: &usize| {
        twin(*half_edge) == NONE || twin(twin(*half_edge) as usize) as usize == *half_edge
    };
    (0..shape.twins.len())
        .filter(|half_edge| !returns(half_edge))
        .count()
}

fn euler(shape: &HalfEdgeMesh) -> i64 {
    let mut used = vec![false; shape.positions.len()];
    shape
        .faces
        .iter()
        .flatten()
        .for_each(|v| used[*v as usize] = true);
    let vertices = used.iter().filter(|used| **used).count();
    vertices as i64 - shape.edge_count() as i64 + shape.faces.len() as i64
}

fn odd_edges(shape: &HalfEdgeMesh) -> String {
    let traits = shape.edge_traits.iter();
    let count = |flag| {
        traits
            .clone()
            .filter(|traits| traits.contains(flag))
            .count()
    };
    format!(
        "{}, {}, {}",
        count(EdgeFlags::BOUNDARY),
        count(EdgeFlags::NON_MANIFOLD),
        count(EdgeFlags::FLIPPED)
    )
}
