//! Segments joined into lines.

use super::cut::{End, Segment};
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Length, as a fraction of the longer of the two mesh edges, up to which a piece at the end of a line is dropped.
///
/// A place on an edge is rounded to 2^-24 of it; shorter pieces have no direction.
const NOTHING: f64 = 4e-7;

/// A future node, and the face beside the piece that follows it.
#[derive(Debug, Clone, Copy)]
struct Stop {
    end: End,
    face: u32,
}

/// Joins segments where exactly two meet; lines end where one or more than two do.
///
/// Segments must be sorted. Open lines come first, each from its end in the earliest segment, then closed ones.
pub(super) fn link(shape: &HalfEdgeMesh, segments: &[Segment]) -> CurveGraph {
    let mates = mates(segments);
    let mut seen = vec![false; segments.len()];
    let mut graph = CurveGraph::default();
    for half in 0..mates.len() as u32 {
        if mates[half as usize] == NONE && !seen[half as usize / 2] {
            let (stops, _) = walk(segments, &mates, &mut seen, half);
            push_open(shape, &mut graph, &stops);
        }
    }
    for segment in 0..segments.len() {
        if !seen[segment] {
            let (stops, last) = walk(segments, &mates, &mut seen, 2 * segment as u32);
            debug_assert_ne!(last, NONE, "what is left are loops");
            push_closed(shape, &mut graph, &stops[..stops.len() - 1]);
        }
    }
    graph
}

/// For both ends of all segments, numbered `2 segment + end`: the end of the one other segment that continues there.
fn mates(segments: &[Segment]) -> Vec<u32> {
    let halves = 0..2 * segments.len() as u32;
    let key = |half: u32| segments[half as usize / 2].ends[half as usize % 2].key;
    let mut sorted: Vec<([u32; 2], u32)> = halves.map(|half| (key(half), half)).collect();
    sorted.sort_unstable();
    let mut mates = vec![NONE; sorted.len()];
    for group in sorted.chunk_by(|a, b| a.0 == b.0) {
        if let [(_, a), (_, b)] = *group {
            mates[a as usize] = b;
            mates[b as usize] = a;
        }
    }
    mates
}

/// All stops of a line from one of its ends on, and the mate of the last.
fn walk(segments: &[Segment], mates: &[u32], seen: &mut [bool], from: u32) -> (Vec<Stop>, u32) {
    let stop = |half: u32| {
        let segment = &segments[half as usize / 2];
        Stop {
            end: segment.ends[half as usize % 2],
            face: segment.faces[0],
        }
    };

    // Stop at the near end of every segment, then go on with its mate.
    let mut stops = Vec::new();
    let mut half = from;
    loop {
        seen[half as usize / 2] = true;
        stops.push(stop(half));
        let mate = mates[half as usize ^ 1];
        if mate == NONE || seen[mate as usize / 2] {
            stops.push(stop(half ^ 1));
            return (stops, mate);
        }
        half = mate;
    }
}

/// Whether the piece between two stops is too short to have a direction.
fn is_point(shape: &HalfEdgeMesh, a: &Stop, b: &Stop) -> bool {
    let ends = [a, b].map(|stop| {
        let [low, high] = shape.ends(stop.end.edge);
        [low, high].map(|v| shape.positions[v as usize].map(f64::from))
    });
    let length = |[p, q]: [[f64; 3]; 2]| {
        let squares = (0..3).map(|i| (q[i] - p[i]) * (q[i] - p[i]));
        squares.sum::<f64>().sqrt()
    };
    let place = |[p, q]: [[f64; 3]; 2], t: f32| -> [f64; 3] {
        std::array::from_fn(|i| p[i] + (q[i] - p[i]) * f64::from(t))
    };
    let places = [place(ends[0], a.end.t), place(ends[1], b.end.t)];
    length(places) <= NOTHING * length(ends[0]).max(length(ends[1]))
}

fn push_open(shape: &HalfEdgeMesh, graph: &mut CurveGraph, stops: &[Stop]) {
    let long = |pair: &[Stop]| !is_point(shape, &pair[0], &pair[1]);
    let (Some(first), Some(last)) = (
        stops.windows(2).position(long),
        stops.windows(2).rposition(long),
    ) else {
        return;
    };
    push(graph, &stops[first..last + 2], false);
}

fn push_closed(shape: &HalfEdgeMesh, graph: &mut CurveGraph, stops: &[Stop]) {
    if stops
        .windows(2)
        .any(|pair| !is_point(shape, &pair[0], &pair[1]))
    {
        push(graph, stops, true);
    }
}

fn push(graph: &mut CurveGraph, stops: &[Stop], closed: bool) {
    let base = graph.nodes.len() as u32;
    let last = base + stops.len() as u32 - 1;
    let (before, after) = if closed { (last, base) } else { (NONE, NONE) };
    for (index, stop) in (base..).zip(stops) {
        graph.nodes.push(CurveNode {
            edge: stop.end.edge,
            t: stop.end.t,
            next: if index == last { after } else { index + 1 },
            prev: if index == base { before } else { index - 1 },
            flags: KindSet::INTERSECTION,
            face: stop.face,
        });
    }
}
