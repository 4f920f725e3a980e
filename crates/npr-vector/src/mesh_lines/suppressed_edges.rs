//! Edges that need no line of their own, since a smooth contour shows them.

use crate::mesh_lines::graph::CurveGraph;
use crate::mesh_lines::line::Line;
use crate::mesh_lines::line_settings::OUTLINE_TOLERANCE_PX;
use crate::mesh_lines::run::distance;
use crate::mesh_lines::visibility::Piece;
use crate::mesh_lines::zero_set::{SegmentGrid, runs_along_edge};

/// Cosine of the largest angle at which an edge counts as running beside a contour.
const BESIDE_COS: f64 = 0.9;

/// Largest difference in depth between an edge and the contour beside it, as a share of the depth.
const DEPTH_SHARE: f64 = 0.01;

/// Places along an edge at which it is compared with contours; the majority decides.
const PLACES: [f64; 3] = [0.2, 0.5, 0.8];

/// Edges of which smooth contours show at least half, ascending.
pub(crate) fn suppressed_edges(graph: &CurveGraph, lines: &[Option<Line>]) -> Vec<u32> {
    let along = |(index, line): (usize, &Option<Line>)| {
        let node = &graph.nodes[index];
        let shown = line.is_some() && runs_along_edge(graph, index as u32);
        let next = graph.nodes.get(node.next as usize).filter(|_| shown)?;
        let end = match next.edge == node.edge {
            true => next.t,
            // The piece runs to the end of its edge where it does not stop on it: the farther one, for what is left
            // is short.
            false if node.t < 0.5 => 1.0,
            false => 0.0,
        };
        Some((node.edge, (end - node.t).abs()))
    };
    let mut parts: Vec<(u32, f32)> = lines.iter().enumerate().filter_map(along).collect();
    parts.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    parts
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|parts| parts.iter().map(|part| part.1).sum::<f32>() >= 0.5)
        .map(|parts| parts[0].0)
        .collect()
}

/// Those of `edges`, given with their pieces, beside which a visible contour runs within the tolerance of smooth
/// contours.
///
/// O(lines + edges) where contours do not crowd.
pub(crate) fn edges_beside(
    lines: &[Option<Line>],
    edges: impl Iterator<Item = (u32, Piece)>,
) -> Vec<u32> {
    // Sort what is seen of contours into a grid.
    let seen: Vec<Piece> = lines.iter().flatten().flat_map(seen_parts).collect();
    let grid = SegmentGrid::new(seen.iter().map(|part| part.place).collect(), 8.0);

    // Compare an edge with it at a few places, by distance, depth and direction.
    let is_beside = |piece: &Piece| {
        let near = |share: &f64| {
            let depth = piece.depth[0] + (piece.depth[1] - piece.depth[0]) * share;
            let fits = |segment: u32, at: f64| {
                let [from, to] = seen[segment as usize].depth;
                let apart = (from + (to - from) * at - depth).abs();
                apart <= DEPTH_SHARE * depth.abs() && are_parallel(piece, &seen[segment as usize])
            };
            let place = piece.place_at(*share);
            grid.nearest(place, OUTLINE_TOLERANCE_PX, fits).is_some()
        };
        2 * PLACES.iter().filter(|share| near(share)).count() > PLACES.len()
    };
    edges
        .filter(|(_, piece)| is_beside(piece))
        .map(|(edge, _)| edge)
        .collect()
}

/// The parts of a line that nothing hides; depths of their ends lie between those of the piece.
fn seen_parts(line: &Line) -> impl Iterator<Item = Piece> {
    let [near, far] = line.piece.depth;
    let seen = line.spans.iter().filter(|span| span.occluders == 0);
    seen.map(move |span| Piece {
        place: [span.from, span.to].map(|share| line.piece.place_at(share)),
        depth: [span.from, span.to].map(|share| near + (far - near) * share),
        ..line.piece
    })
}

fn are_parallel(a: &Piece, b: &Piece) -> bool {
    let along = |piece: &Piece| [0, 1].map(|i| piece.place[1][i] - piece.place[0][i]);
    let (along_a, along_b) = (along(a), along(b));
    let lengths = distance(along_a, [0.0; 2]) * distance(along_b, [0.0; 2]);
    (along_a[0] * along_b[0] + along_a[1] * along_b[1]).abs() >= BESIDE_COS * lengths
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::visibility::Span;
    use crate::stroke::Kind;
    use glam::DVec3;
    use proptest::prelude::*;

    fn piece(from: [f64; 2], angle: f64, length: f64, depth: f64) -> Piece {
        let to = [
            from[0] + length * angle.cos(),
            from[1] + length * angle.sin(),
        ];
        Piece {
            world: [DVec3::ZERO; 2],
            place: [from, to],
            depth: [depth; 2],
            range: [0.0, 1.0],
        }
    }

    fn line(piece: Piece, occluders: u32) -> Option<Line> {
        let span = Span {
            from: 0.0,
            to: 1.0,
            occluders,
        };
        Some(Line {
            kind: Kind::Contour,
            surface: 0,
            piece,
            spans: vec![span],
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// An edge beside a longer seen contour at its depth is covered; not a hidden, a crossing, a farther or a
        /// deeper one.
        #[test]
        fn what_runs_beside_a_seen_contour_is_covered(
            angle in 0.0_f64..6.3, length in 3.0_f64..40.0, off in -1.9_f64..1.9,
        ) {
            let start = [100.0 - 5.0 * angle.cos(), 100.0 - 5.0 * angle.sin()];
            let contour = line(piece(start, angle, length + 10.0, 1.0), 0);
            let edge = |off: f64, turn: f64, depth: f64| {
                let from = [100.0 - off * angle.sin(), 100.0 + off * angle.cos()];
                [(7, piece(from, angle + turn, length, depth))].into_iter()
            };
            prop_assert_eq!(edges_beside(std::slice::from_ref(&contour), edge(off, 0.0, 1.0)), [7]);
            prop_assert!(edges_beside(std::slice::from_ref(&contour), edge(off, 0.7, 1.0)).is_empty());
            prop_assert!(edges_beside(std::slice::from_ref(&contour), edge(off.signum() * 2.1, 0.0, 1.0)).is_empty());
            prop_assert!(edges_beside(std::slice::from_ref(&contour), edge(off, 0.0, 1.02)).is_empty());
            let hidden = contour.map(|contour| Line {
                spans: vec![Span { occluders: 1, ..contour.spans[0] }],
                ..contour
            });
            prop_assert!(edges_beside(&[hidden, None], edge(off, 0.0, 1.0)).is_empty());
        }
    }
}
