//! Lines of the file itself, without faces: the polylines of a shape, linked.
//!
//! They are marked lines, for somebody placed them by hand. A polyline lies on no face that the shape knows of, so what
//! it touches is found by distance ([`touch`]) and never hides it.

use crate::mesh_lines::feature::{chain, pair};
use crate::mesh_lines::graph::CurveGraph;
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Distance from a face within which a polyline counts as lying on it, as a share of the diagonal of the whole shape: a
/// tenth of a pixel where that fills a picture of a thousand.
///
/// Files round positions, and lines drawn on curved surfaces dip under their facets. A larger distance would let lines
/// on the back of thin walls through.
pub const TOUCH_SHARE: f64 = 1e-4;

/// All polylines of a shape, linked where exactly two of them meet; where more do, lines end.
///
/// Open lines come first, then closed ones, each from its first polyline. O(n log n).
pub fn polylines(shape: &HalfEdgeMesh) -> CurveGraph {
    let candidates: Vec<(u32, u32)> = shape
        .polyline_edges()
        .map(|edge| (edge, KindSet::MARKED))
        .collect();
    // End 2 k is the lower one of polyline k.
    let mut meetings: Vec<(u32, u32)> = candidates
        .iter()
        .zip(0..)
        .flat_map(|((edge, _), k)| {
            let [low, high] = shape.ends(*edge);
            [(low, 2 * k), (high, 2 * k + 1)]
        })
        .collect();
    meetings.par_sort_unstable();
    let mut mates = vec![NONE; meetings.len()];
    for meeting in meetings.chunk_by(|a, b| a.0 == b.0) {
        if let [(_, a), (_, b)] = *meeting {
            pair(&mut mates, a, b);
        }
    }
    chain(shape, &candidates, &mates)
}

/// How near to a face of the shape a polyline may lie without being hidden by it; 0 where there are no polylines.
pub fn touch(shape: &HalfEdgeMesh) -> f64 {
    if shape.polylines.is_empty() {
        return 0.0;
    }
    let points = 0..shape.positions.len() as u32;
    let (low, high) = points.map(|v| shape.point(v)).fold(
        (DVec3::INFINITY, DVec3::NEG_INFINITY),
        |(low, high), point| (low.min(point), high.max(point)),
    );
    TOUCH_SHARE * (high - low).length()
}
