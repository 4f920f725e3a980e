//! Shapes made from generated meshes, and eyes that look at them.

use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::{Mesh, weld};
use npr_vector::mesh_lines::contour::Eye;
use std::collections::BTreeMap;

/// A mesh as a shape, its corners welded.
pub fn shape_from(mesh: &Mesh) -> HalfEdgeMesh {
    shape_of(mesh.positions(), mesh.triangles())
}

/// Triangles as a shape; of edges with two faces that run opposite ways the half-edges are paired.
pub fn shape_of(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> HalfEdgeMesh {
    let welded = weld(positions, 0.0);
    let corners = |triangle: &[u32; 3]| welded.corners(*triangle);
    let is_sound = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    let faces: Vec<_> = triangles.iter().map(corners).filter(is_sound).collect();
    let mut shape = HalfEdgeMesh {
        positions: welded
            .first
            .iter()
            .map(|v| positions[*v as usize])
            .collect(),
        face_surfaces: vec![0; faces.len()],
        twins: vec![NONE; 3 * faces.len()],
        edge_of: vec![0; 3 * faces.len()],
        edge_starts: vec![0],
        surfaces: vec![Surface::default()],
        faces,
        ..HalfEdgeMesh::default()
    };
    give_edges(&mut shape);
    shape.sanity_check();
    shape
}

fn give_edges(shape: &mut HalfEdgeMesh) {
    let mut sides: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for half_edge in 0..shape.twins.len() as u32 {
        let [a, b] = shape.ends_of_half_edge(half_edge);
        let edge = sides.entry([a.min(b), a.max(b)]).or_default();
        match shape.runs_up(half_edge) {
            true => edge.insert(0, half_edge),
            false => edge.push(half_edge),
        }
    }
    for (edge, (ends, sides)) in sides.iter().enumerate() {
        let up = sides.iter().filter(|side| shape.runs_up(**side)).count();
        let traits = match (sides.len(), up) {
            (1, _) => EdgeFlags::BOUNDARY,
            (2, 1) => EdgeFlags::NONE,
            (2, _) => EdgeFlags::FLIPPED,
            _ => EdgeFlags::NON_MANIFOLD,
        };
        if traits == EdgeFlags::NONE {
            shape.twins[sides[0] as usize] = sides[1];
            shape.twins[sides[1] as usize] = sides[0];
        }
        for side in sides {
            shape.edge_of[*side as usize] = edge as u32;
        }
        shape.edge_sides.extend(sides);
        shape.edge_ends.push(*ends);
        shape.edge_starts.push(shape.edge_sides.len() as u32);
        shape.edge_traits.push(traits);
        shape.dihedral_cos.push(1.0);
    }
}

/// Eyes around a shape of size 1, times a scale: oblique, edge-on to planes of the axes, near, and in parallel view.
pub fn eyes(scale: f32) -> [Eye; 6] {
    let places = [
        [2.1, 1.7, 3.4, 1.0],
        [3.0, 0.0, 0.0, 1.0],
        [0.5, 0.5, 4.0, 1.0],
        [1.05, 0.3, -0.2, 1.0],
        [0.3, -0.5, 0.8, 0.0],
        [0.0, 1.0, 0.0, 0.0],
    ];
    places.map(|[x, y, z, w]| {
        let scale = f64::from(if w == 0.0 { 1.0 } else { scale });
        let place: [f64; 3] = [x, y, z].map(|v: f64| v * scale);
        Eye::new([place[0], place[1], place[2], w], 4.0 * scale as f32)
    })
}
