//! Contour, boundary and crease edges of meshes that other programs counted.

use npr_core::line_kind::KindSet;
use std::path::Path;

use npr_benches::lines::candidates::Wanted;
use npr_benches::lines::subjects::{LineSubject, benchmark_camera};
use npr_benches::table::Table;
use npr_core::crease::{CreaseFrom, Creases};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_render::{LineModel, LineModelOptions};
use npr_vector::mesh_lines::contour::{Eye, contours, facing};
use npr_vector::mesh_lines::feature::features;
use npr_vector::mesh_lines::graph::CurveGraph;

use crate::Outcome;
use crate::arguments::Arguments;

/// Contour, boundary and crease edges seen from the benchmark's eye, creases with those that are contours.
///
/// Counted with numpy in double precision by the comparison's `ref_counts.py`; no face is exactly edge-on in any.
const EXPECTED: [(&str, [usize; 3]); 11] = [
    ("suzanne_1k", [241, 42, 401]),
    ("cad_part", [1046, 0, 1916]),
    ("towers_1728", [864, 0, 1728]),
    ("ico_20k", [205, 0, 0]),
    ("suzanne_63k", [1332, 336, 2]),
    ("ico_80k", [403, 0, 0]),
    ("bumpy_80k", [4519, 0, 28]),
    ("knot_100k", [2568, 0, 0]),
    ("suzanne_252k", [2635, 672, 0]),
    ("ico_320k", [806, 0, 0]),
    ("bumpy_320k", [9047, 0, 0]),
];

/// How far off a count in single precision may be.
const MOST_OFF: usize = 3;

/// Counts edges of the meshes that other programs drew, where they are there.
pub fn edge_counts(arguments: &Arguments) -> Outcome<()> {
    let Some(folder) = &arguments.peers else {
        return Ok(());
    };
    let mut table = Table::new([
        "mesh",
        "contour edges",
        "expected",
        "boundary",
        "expected",
        "crease",
        "expected",
        "furthest off",
    ]);

    // Count the edges of every mesh beside what the other program counted.
    let mut within = 0;
    for (name, expected) in EXPECTED {
        let found = counts(&folder.join(format!("{name}.obj")))?;
        let off = (0..3)
            .map(|i| found[i].abs_diff(expected[i]))
            .max()
            .unwrap_or(0);
        within += usize::from(off <= MOST_OFF);
        let pairs = (0..3).flat_map(|i| [found[i], expected[i]]);
        table.add(name, pairs.chain([off]).map(|count| count.to_string()));
    }

    // Tell how many meshes agree.
    println!(
        "## Edges counted\n\nEvery edge of a kind, hidden or not, from the view that other programs were measured \
         with; expected: counted in double precision by another program. Bar: at most {MOST_OFF} off. {within} of {} \
         meshes reach it.\n\n{table}",
        EXPECTED.len()
    );
    Ok(())
}

/// Contour, boundary and crease edges of a mesh in the unit ball.
fn counts(path: &Path) -> Outcome<[usize; 3]> {
    let subject = LineSubject::load(path, true)?;
    let model = LineModel::new(&subject.scene, &LineModelOptions::default())?;
    let shape: &HalfEdgeMesh = model.shape();
    let [x, y, z] = benchmark_camera().eye.map(f64::from);
    // The eye is further off than any point of the unit ball.
    let eye = Eye::new([x, y, z, 1.0], x.max(y).max(z) as f32);
    let loops = contours(shape, &facing(shape, &eye), &eye);
    let lines = features(
        shape,
        Creases::over(Wanted::default().crease as f32, CreaseFrom::Faces),
    );
    Ok([
        count(&loops, KindSet::CONTOUR),
        count(&lines, KindSet::BOUNDARY),
        count(&lines, KindSet::CREASE),
    ])
}

fn count(graph: &CurveGraph, kind: u32) -> usize {
    graph
        .nodes
        .iter()
        .filter(|node| node.flags & kind != 0)
        .count()
}
