//! Lines that hang on the shape alone: boundaries, creases, material borders and marked edges.
//!
//! They are found and linked once a shape; a view only leaves some of them out ([`kind_in_view`]).

use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use crate::mesh_lines::rounded::{rounded_edges, rounding_normals};
use crate::mesh_lines::zero_set::CornerNormals;
use glam::DVec3;
use npr_core::crease::{CreaseFrom, Creases};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::line_kind::{KIND_NUMBER_BITS, Kind, KindSet};
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// How straight two edges must run on for a line to pass a point where more than two meet: cosine of the bend.
const STRAIGHT_COS: f64 = 0.5;

/// The same where a crease goes on along edges that fold less.
const GO_ON_COS: f64 = 0.7;

/// Most edges that fold less and may end in the open, after a crease.
const OPEN_COUNT: usize = 2;

/// Least length of each of them, in lengths of the edge that it goes on from: edges of coarse meshes are as long.
const OPEN_SHARE: f64 = 0.5;

/// All feature lines of a shape, linked along equal kinds of one object.
///
/// At a point where two edges of a kind meet the line goes on; where more meet, through the straightest pairs. Where a
/// crease would end alone it goes on along edges that fold by the lower angle, as long as they run on within 45 degrees
/// and if they lead to another feature: the hysteresis of [Canny 1986] along lines of a mesh. Differs: of what would
/// end in the open only rows of at most two edges are drawn, each at least half as long as the one that they go on
/// from. Ridges of coarse meshes fold more on one piece than on the next; on fine meshes such rows are noise. Edges
/// between faces that are wound against each other are in the graph without a kind: in some views they are contours.
/// O(edges + features log features).
pub fn features(shape: &HalfEdgeMesh, creases: impl Into<Creases>) -> CurveGraph {
    let creases = creases.into();
    let normals = rounding_normals(shape, creases);
    features_by(shape, creases, normals.as_ref())
}

/// The same, with rounded edges where normals of the same creases are given.
pub(crate) fn features_by(
    shape: &HalfEdgeMesh,
    creases: Creases,
    normals: Option<&CornerNormals>,
) -> CurveGraph {
    let mut candidates: Vec<(u32, u32)> = (0..shape.edge_count() as u32)
        .into_par_iter()
        .with_min_len(8192)
        .filter_map(|edge| static_flags(shape, edge, creases).map(|flags| (edge, flags)))
        .collect();
    if let Some(normals) = normals {
        let is_feature = |edge: &u32| static_flags(shape, *edge, creases).is_some();
        let rounded = rounded_edges(shape, normals, creases);
        let rounded = rounded.into_iter().filter(|edge| !is_feature(edge));
        candidates.extend(rounded.map(|edge| (edge, KindSet::CREASE)));
    }
    let mates = mates(shape, &candidates);
    if creases.weak_cos <= creases.cos {
        return chain(shape, &candidates, &mates);
    }
    let (candidates, mates) = go_on(shape, creases, candidates, mates);
    chain(shape, &candidates, &mates)
}

/// The candidates and mates, with those of edges along which creases go on.
fn go_on(
    shape: &HalfEdgeMesh,
    creases: Creases,
    mut candidates: Vec<(u32, u32)>,
    mut mates: Vec<u32>,
) -> (Vec<(u32, u32)>, Vec<u32>) {
    // Take the edges that fold less.
    let strong_count = candidates.len();
    let folds_less = |edge: &u32| {
        shape.fold_cos(*edge, creases.from) < creases.weak_cos
            && static_flags(shape, *edge, creases).is_none()
    };
    let weak: Vec<(u32, u32)> = (0..shape.edge_count() as u32)
        .into_par_iter()
        .with_min_len(8192)
        .filter(folds_less)
        .map(|edge| (edge, KindSet::CREASE))
        .collect();
    candidates.extend(weak);
    mates.resize(2 * candidates.len(), NONE);

    // Pair them where a crease would end, and with each other where no feature is.
    let mut meetings: Vec<(u32, u32, u32)> = (0..2 * candidates.len() as u32)
        .map(|end| {
            let (edge, flags) = candidates[end as usize / 2];
            let vertex = shape.ends(edge)[end as usize % 2];
            (vertex, group_of(shape, edge, flags), end)
        })
        .collect();
    meetings.par_sort_unstable();
    for at_vertex in meetings.chunk_by(|a, b| a.0 == b.0) {
        let strong = |meeting: &&(u32, u32, u32)| (meeting.2 as usize) < 2 * strong_count;
        if at_vertex.iter().filter(strong).count() <= 1 {
            for meeting in at_vertex.chunk_by(|a, b| a.1 == b.1) {
                pair_straightest(shape, &candidates, meeting, GO_ON_COS, &mut mates);
            }
        }
    }

    // Keep those along which a crease comes to another feature, and short rows of long edges.
    let length_of = |candidate: usize| {
        let [a, b] = shape.ends(candidates[candidate].0);
        shape.point(a).distance(shape.point(b))
    };
    let vertex_of = |end: u32| shape.ends(candidates[end as usize / 2].0)[end as usize % 2];
    let mut has_feature = vec![false; shape.positions.len()];
    for end in 0..2 * strong_count as u32 {
        has_feature[vertex_of(end) as usize] = true;
    }
    let mut is_kept = vec![false; candidates.len()];
    is_kept[..strong_count].fill(true);
    for start in 0..2 * strong_count {
        let mut way = Vec::new();
        let mut next = mates[start];
        let mut is_there = false;
        while next != NONE && !is_there && !is_kept[next as usize / 2] {
            way.push(next as usize / 2);
            is_there = has_feature[vertex_of(next ^ 1) as usize];
            next = mates[next as usize ^ 1];
        }
        let long = OPEN_SHARE * length_of(start / 2);
        let is_coarse =
            || way.len() <= OPEN_COUNT && way.iter().all(|candidate| length_of(*candidate) >= long);
        if is_there || is_coarse() {
            way.into_iter()
                .for_each(|candidate| is_kept[candidate] = true);
        }
    }
    for end in 0..mates.len() {
        let mate = mates[end];
        if mate != NONE && !(is_kept[end / 2] && is_kept[mate as usize / 2]) {
            mates[end] = NONE;
        }
    }
    retain(&candidates, &mates, &is_kept)
}

/// The candidates that are kept, with their mates, which are kept too.
fn retain(
    candidates: &[(u32, u32)],
    mates: &[u32],
    is_kept: &[bool],
) -> (Vec<(u32, u32)>, Vec<u32>) {
    let mut count = 0;
    let places: Vec<u32> = is_kept
        .iter()
        .map(|is_kept| {
            count += u32::from(*is_kept);
            count.wrapping_sub(1)
        })
        .collect();
    let moved = |mate: u32| match mate {
        NONE => NONE,
        mate => 2 * places[mate as usize / 2] + mate % 2,
    };
    let kept = || (0..candidates.len()).filter(|k| is_kept[*k]);
    let ends = kept().flat_map(|k| [2 * k, 2 * k + 1]);
    (
        kept().map(|k| candidates[k]).collect(),
        ends.map(|end| moved(mates[end])).collect(),
    )
}

/// Whether an edge folds enough to be a crease.
pub(crate) fn folds(shape: &HalfEdgeMesh, edge: u32, creases: Creases) -> bool {
    let is_hard =
        creases.from == CreaseFrom::Normals && shape.dihedral_cos[edge as usize] < creases.hard_cos;
    is_hard || shape.fold_cos(edge, creases.from) < creases.cos
}

/// The flags that an edge has in every view; `None` where it is no line in any.
pub(crate) fn static_flags(shape: &HalfEdgeMesh, edge: u32, creases: Creases) -> Option<u32> {
    let traits = shape.edge_traits[edge as usize];
    let bends = folds(shape, edge, creases);
    let is_crease = bends || traits.contains(EdgeFlags::NON_MANIFOLD);
    // Flags that make an edge a line have the bits of its kinds.
    let flags = traits.0 & KindSet::BITS | if is_crease { KindSet::CREASE } else { 0 };
    (flags != 0 || traits.contains(EdgeFlags::FLIPPED)).then_some(flags)
}

/// The kinds that a feature edge has in a view: none where it is a contour that is drawn already.
pub fn kind_in_view(
    shape: &HalfEdgeMesh,
    front: &[u8],
    edge: u32,
    flags: u32,
    contours_are_drawn: bool,
) -> u32 {
    let traits = shape.edge_traits[edge as usize];
    if traits.intersects(EdgeFlags::BOUNDARY | EdgeFlags::NON_MANIFOLD) {
        return flags;
    }
    let [a, b] = [0, 1].map(|i| front[shape.sides(edge)[i] as usize / 3] != 0);
    let is_contour = (a != b) != (traits.contains(EdgeFlags::FLIPPED));
    match (is_contour, traits.contains(EdgeFlags::FLIPPED)) {
        (true, true) => flags | KindSet::CONTOUR,
        (true, false) if contours_are_drawn => 0,
        (true, false) => flags,
        (false, _) => flags,
    }
}

/// The end that continues each end, or [`NONE`]; `2 k` is the lower end of candidate `k`, `2 k + 1` the upper.
fn mates(shape: &HalfEdgeMesh, candidates: &[(u32, u32)]) -> Vec<u32> {
    // Bring the ends together that meet in a vertex.
    let mut meetings: Vec<(u32, u32, u32)> = candidates
        .iter()
        .enumerate()
        .flat_map(|(k, (edge, flags))| {
            let group = group_of(shape, *edge, *flags);
            let [low, high] = shape.ends(*edge);
            [(low, group, 2 * k as u32), (high, group, 2 * k as u32 + 1)]
        })
        .collect();
    meetings.par_sort_unstable();

    // Pair two, and of more those that go on straightest.
    let mut mates = vec![NONE; 2 * candidates.len()];
    for meeting in meetings.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        match meeting {
            [_] => {}
            [(.., a), (.., b)] => pair(&mut mates, *a, *b),
            _ => pair_straightest(shape, candidates, meeting, STRAIGHT_COS, &mut mates),
        }
    }
    mates
}

/// The object and first kind of an edge: lines do not pass from one to another.
fn group_of(shape: &HalfEdgeMesh, edge: u32, flags: u32) -> u32 {
    let face = shape.sides(edge)[0] / 3;
    let object = shape.surfaces[shape.face_surfaces[face as usize] as usize].object;
    let first_kind = Kind::first_of(flags).map_or(Kind::ALL.len(), |kind| kind as usize);
    object << KIND_NUMBER_BITS | first_kind as u32
}

pub(crate) fn pair(mates: &mut [u32], a: u32, b: u32) {
    mates[a as usize] = b;
    mates[b as usize] = a;
}

fn pair_straightest(
    shape: &HalfEdgeMesh,
    candidates: &[(u32, u32)],
    meeting: &[(u32, u32, u32)],
    least_cos: f64,
    mates: &mut [u32],
) {
    // A fan of thousands would cost its square; no drawing needs its lines to pass through.
    if meeting.len() > 64 {
        return;
    }
    let away: Vec<DVec3> = meeting
        .iter()
        .map(|(.., end)| direction(shape, candidates, *end))
        .collect();
    let mut pairs = Vec::new();
    for i in 0..meeting.len() {
        for j in i + 1..meeting.len() {
            let bend = -away[i].dot(away[j]);
            if bend > least_cos {
                pairs.push((bend, i, j));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    for (_, i, j) in pairs {
        let (a, b) = (meeting[i].2, meeting[j].2);
        if mates[a as usize] == NONE && mates[b as usize] == NONE {
            pair(mates, a, b);
        }
    }
}

/// Unit direction from an end of a candidate along its edge.
fn direction(shape: &HalfEdgeMesh, candidates: &[(u32, u32)], end: u32) -> DVec3 {
    let [low, high] = shape.ends(candidates[end as usize / 2].0);
    let along = (shape.point(high) - shape.point(low)).normalize_or_zero();
    if end.is_multiple_of(2) { along } else { -along }
}

/// Walks along the mates: open lines first, then closed ones, each from its first candidate.
pub(crate) fn chain(shape: &HalfEdgeMesh, candidates: &[(u32, u32)], mates: &[u32]) -> CurveGraph {
    let mut graph = CurveGraph::default();
    let mut used = vec![false; candidates.len()];
    let open_ends = (0..mates.len() as u32).filter(|end| mates[*end as usize] == NONE);
    for start in open_ends.chain((0..mates.len() as u32).step_by(2)) {
        if !used[start as usize / 2] {
            walk(shape, candidates, mates, start, &mut used, &mut graph.nodes);
        }
    }
    graph
}

fn walk(
    shape: &HalfEdgeMesh,
    candidates: &[(u32, u32)],
    mates: &[u32],
    start: u32,
    used: &mut [bool],
    nodes: &mut Vec<CurveNode>,
) {
    let first = nodes.len() as u32;
    let mut end = start;
    loop {
        // Add the start of this edge.
        used[end as usize / 2] = true;
        nodes.push(node_at(shape, candidates, end, nodes.len() as u32));

        // End the line where no edge goes on.
        let far = end ^ 1;
        let mate = mates[far as usize];
        if mate == NONE {
            let tail = CurveNode {
                flags: 0,
                ..node_at(shape, candidates, far, nodes.len() as u32)
            };
            nodes.push(CurveNode { next: NONE, ..tail });
            break;
        }

        // Close it where it comes back to its start.
        if used[mate as usize / 2] {
            let last = nodes.len() as u32 - 1;
            nodes[last as usize].next = first;
            nodes[first as usize].prev = last;
            return;
        }
        end = mate;
    }
    nodes[first as usize].prev = NONE;
}

/// The node at an end of a candidate, linked to its neighbours in the list.
fn node_at(shape: &HalfEdgeMesh, candidates: &[(u32, u32)], end: u32, index: u32) -> CurveNode {
    let (edge, flags) = candidates[end as usize / 2];
    CurveNode {
        edge,
        t: (end % 2) as f32,
        next: index + 1,
        prev: index.wrapping_sub(1),
        flags,
        face: shape.sides(edge).first().map_or(NONE, |side| side / 3),
    }
}
