//! Which edges are drawn.

use crate::mesh_lines::contour::steps::Viewer;
use crate::mesh_lines::contour::{Eye, contours, facing};
use crate::pixel_strokes::edge::{Facing, drawn_edges, mark_edges};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{icosphere, plane, random_soup, random_winding, shape_of, torus};
use proptest::prelude::*;

/// Cosine of the crease angle, 40 degrees.
const CREASE: f32 = 0.766;

fn marks(shape: &HalfEdgeMesh, eye: &Eye, wanted: u32, is_convex_only: bool) -> Vec<u32> {
    let edges = drawn_edges(shape, CREASE, &[]);
    let front: Vec<u32> = facing(shape, eye).iter().map(|f| u32::from(*f)).collect();
    let on = Facing {
        viewer: &Viewer::from(eye),
        wanted,
        is_convex_only,
        positions: shape.positions.as_flattened(),
        front: &front,
    };
    let (mut flags, mut marks) = (vec![0; edges.len()], vec![0; edges.len()]);
    mark_edges(&on, &edges, &mut flags, &mut marks);
    assert!(
        flags
            .iter()
            .zip(&marks)
            .all(|(flag, mark)| *flag == u32::from(*mark != 0))
    );
    marks
}

fn eye() -> impl Strategy<Value = Eye> {
    prop::array::uniform3(-5.0..5.0f64).prop_map(|[x, y, z]| Eye::new([x, y, z, 1.0], 8.0))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// On meshes wound alike, contours are those of the loops along edges, in their direction.
    #[test]
    fn contours_are_those_of_loops(which in 0u32..3, eye in eye(), is_convex_only: bool) {
        let shape = shape_of(&match which { 0 => icosphere(1), 1 => torus(9, 7, 1.0, 0.4), _ => plane(3, 4) });
        let found = marks(&shape, &eye, KindSet::CONTOUR, is_convex_only);
        let front = facing(&shape, &eye);
        let mut expected = vec![0; shape.edge_count()];
        for node in &contours(&shape, &front, &eye).nodes {
            let is_valley = is_convex_only && EdgeFlags::CONCAVE.is_in(node.flags);
            if node.flags & KindSet::CONTOUR != 0 && !is_valley {
                let first = shape.sides(node.edge)[0];
                let runs_first = first / 3 == node.face;
                expected[node.edge as usize] = KindSet::CONTOUR | if runs_first { 0 } else { EdgeFlags::REVERSED.0 };
            }
        }
        prop_assert_eq!(found, expected);
    }

    /// Whatever the mesh: each edge has at most one kind, one that is wanted and that it has.
    #[test]
    fn kinds_are_wanted_and_there(seed: u64, which in 0u32..2, eye in eye(), wanted in 0u32..64) {
        let shape = shape_of(&match which { 0 => random_soup(20, seed), _ => random_winding(&icosphere(1), seed) });
        let edges = drawn_edges(&shape, CREASE, &[]);
        for (edge, mark) in edges.iter().zip(marks(&shape, &eye, wanted, false)) {
            let kind = mark & KindSet::BITS;
            prop_assert!(kind.count_ones() <= 1 && kind & !wanted == 0);
            prop_assert!(kind & !(edge.bits | KindSet::CONTOUR) == 0);
            if edge.across == NONE && wanted & KindSet::BOUNDARY != 0 {
                prop_assert_eq!(kind, KindSet::BOUNDARY);
            }
        }
    }
}

#[test]
fn surfaces_without_lines_have_none() {
    let shape = shape_of(&icosphere(1));
    let edges = drawn_edges(&shape, CREASE, &[false]);
    assert!(edges.iter().all(|edge| edge.face == NONE));
}
