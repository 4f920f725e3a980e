//! Counts the edges that a drawing of a cylinder would show whatever the view.

use npr_mesh::testing::cylinder;
use npr_mesh::{EdgeFlags, unique_edges, weld};

fn main() {
    let mesh = cylinder(24, 3);
    let (positions, triangles) = (mesh.positions(), mesh.triangles());
    let welded = weld(positions, 0.0);
    let edges = unique_edges(positions, triangles, &welded, &[]);

    let crease_cos = npr_core::math::cos(40.0_f32.to_radians());
    let creases = edges
        .iter()
        .filter(|edge| edge.dihedral_cos < crease_cos)
        .count();
    let borders = edges
        .iter()
        .filter(|edge| edge.flags.contains(EdgeFlags::BOUNDARY))
        .count();
    println!(
        "{} edges: {creases} creases, {borders} borders",
        edges.len()
    );
}
