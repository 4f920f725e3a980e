//! Faces without area, and the faces that lend them an orientation.

use crate::half_edge::HalfEdgeMesh;
use glam::DVec3;
use npr_core::geometry::NONE;
use rayon::prelude::*;

use crate::triangle::{Triangle, point};

/// Slivers that the search for a face with area may pass through.
///
/// Tessellators put degenerate faces side by side where a flat polygon has points along an edge; longer rows
/// are folded sheets, which have no orientation worth lending.
const MAX_HOPS: usize = 8;

/// Unit normals of all faces; zero for those without area.
pub(crate) fn normals(shape: &HalfEdgeMesh) -> Vec<DVec3> {
    shape
        .faces
        .par_iter()
        .map(|&face| {
            Triangle::new(&shape.positions, face)
                .normal()
                .unwrap_or(DVec3::ZERO)
        })
        .collect()
}

/// Faces without area, each with its stand-in or [`NONE`].
pub(crate) fn find(shape: &HalfEdgeMesh, normals: &[DVec3]) -> Vec<[u32; 2]> {
    let has_area = |face: u32| normals[face as usize] != DVec3::ZERO;
    (0..shape.faces.len() as u32)
        .into_par_iter()
        .filter(|&face| !has_area(face))
        .map(|face| [face, stand_in(shape, face, has_area)])
        .collect()
}

/// The nearest face with area across longest edges.
fn stand_in(shape: &HalfEdgeMesh, degenerate_face: u32, has_area: impl Fn(u32) -> bool) -> u32 {
    let (mut here, mut entered) = (degenerate_face, NONE);
    for _ in 0..MAX_HOPS {
        let Some(exit) = longest(shape, here, entered) else {
            return NONE;
        };
        entered = shape.twins[exit as usize];
        here = entered / 3;
        if has_area(here) {
            return here;
        }
    }
    NONE
}

/// The longest edge of a face that leads to another face, but not through `entered`; the first of equals.
fn longest(shape: &HalfEdgeMesh, face: u32, entered: u32) -> Option<u32> {
    let length = |half_edge: u32| {
        let [a, b] = shape
            .ends_of_half_edge(half_edge)
            .map(|v| point(&shape.positions, v));
        a.distance_squared(b)
    };
    (3 * face..3 * face + 3)
        .filter(|&half_edge| half_edge != entered && shape.twins[half_edge as usize] != NONE)
        .reduce(|best, other| {
            if length(other) > length(best) {
                other
            } else {
                best
            }
        })
}
