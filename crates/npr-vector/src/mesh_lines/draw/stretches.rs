//! How many surfaces lie in front of lines, counted along them.
//!
//! Along a line, the surfaces in front change only where it crosses the image of an outline before it, where it goes
//! through a face, and at vertices, by the faces around them [Appel 1967]. Most of these changes are known in number:
//! an outline's faces begin or end there, and so do the faces of a vertex that cover the line before it or after it. A
//! stretch is a part of a line with known changes alone. One sight decides for all of it, and in long ones a second
//! must agree; else, as rounding may cause, each of its spans is looked at by itself.

#[cfg(test)]
mod tests;

use super::prepared::WIDEST_FAN;
use super::view::{Draft, View};
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use crate::mesh_lines::line::Line;
use crate::mesh_lines::visibility::{Change, Memory, Seen};
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_core::interrupt::{Interrupt, Interrupted};
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Sine of the angle within which a face is taken to touch a line, or to be seen edge-on.
const ANGLE: f64 = 1e-9;

/// Spans of a stretch from which on a second sight must agree with the first.
const WITNESSED: usize = 6;

/// A span of a stretch.
#[derive(Debug, Clone, Copy)]
struct Member {
    /// The node that its line starts at.
    node: u32,
    /// Which of the line's spans.
    span: u32,
    /// Surfaces in front, beyond those of the stretch's first span.
    more: i32,
}

impl Member {
    /// The span that it is.
    fn at(self) -> [u32; 2] {
        [self.node, self.span]
    }
}

/// Bytes for each node of a graph whose lines are looked at, beside their spans.
pub(super) const BYTES_PER_NODE: usize = size_of::<Option<Line>>()
    + size_of::<Option<Draft>>()
    + size_of::<Member>()
    + size_of::<Found>();

/// The lines of a graph with what is seen of them; crowded ones have no spans yet. O(spans), and a sight for each
/// stretch.
pub(super) fn looked_at(
    view: &View<'_>,
    graph: &CurveGraph,
    seen: &Seen<'_>,
    (drafts, interrupt): (&[Option<Draft>], &Interrupt),
) -> Result<Vec<Option<Line>>, Interrupted> {
    // Count the changes at vertices.
    let changes: Vec<Change> = graph
        .nodes
        .par_iter()
        .with_min_len(256)
        .zip(drafts)
        .map(|(node, draft)| {
            let draft = draft.as_ref().filter(|draft| draft.is_plain[0])?;
            let last = drafts.get(node.prev as usize)?.as_ref();
            last.filter(|last| last.is_plain[1] && !last.is_crowded && !draft.is_crowded)?;
            view.change_at(&graph.nodes[node.prev as usize], node)
        })
        .collect();

    // Look at each stretch.
    let (members, starts) = stretches(graph, drafts, &changes);
    let looks = Looks {
        view,
        graph,
        seen,
        drafts,
    };
    let found: Vec<Found> = starts
        .par_windows(2)
        .with_min_len(8)
        .map_init(Memory::default, |memory, ends| {
            interrupt.check()?;
            Ok(looks.at(&members[ends[0]..ends[1]], memory))
        })
        .collect::<Result<_, Interrupted>>()?;

    // Put what was seen in the order of the lines.
    let mut count = 0;
    let firsts: Vec<usize> = drafts
        .iter()
        .map(|draft| {
            let first = count;
            count += draft.as_ref().map_or(0, Draft::span_count);
            first
        })
        .collect();
    let mut occluders = vec![0_u32; count];
    for (ends, found) in starts.windows(2).zip(found) {
        for (index, member) in members[ends[0]..ends[1]].iter().enumerate() {
            let at = firsts[member.node as usize] + member.span as usize;
            occluders[at] = match &found {
                Found::Counted(first) => first
                    .saturating_add_signed(member.more)
                    .min(seen.count_limit),
                Found::Each(each) => each[index],
            };
        }
    }
    let lines = (graph.nodes.par_iter().zip(drafts))
        .with_min_len(2048)
        .zip(firsts)
        .map(|((node, draft), first)| {
            let draft = draft.as_ref()?;
            let occluders = &occluders[first..first + draft.span_count()];
            Some(view.line_of(node, draft.kind, draft.piece, draft.spans(occluders)))
        })
        .collect();
    Ok(lines)
}

/// All spans, stretch by stretch, and where each stretch starts, with the end of the last.
fn stretches(
    graph: &CurveGraph,
    drafts: &[Option<Draft>],
    changes: &[Change],
) -> (Vec<Member>, Vec<usize>) {
    let (mut members, mut starts) = (Vec::with_capacity(drafts.len()), Vec::new());
    let mut is_taken = vec![false; drafts.len()];
    let mut start = |node: u32, span: u32, is_taken: &mut [bool]| {
        starts.push(members.len());
        let mut member = Member {
            node,
            span,
            more: 0,
        };
        loop {
            members.push(member);
            is_taken[member.node as usize] |= member.span == 0;
            let Some(next) = following(graph, drafts, changes, member) else {
                return;
            };
            if next.span == 0 && is_taken[next.node as usize] {
                return;
            }
            member = next;
        }
    };

    // Start at every span before which the change is not known.
    for (node, draft) in drafts.iter().enumerate() {
        let Some(draft) = draft.as_ref().filter(|draft| !draft.is_crowded) else {
            continue;
        };
        if changes[node].is_none() {
            start(node as u32, 0, &mut is_taken);
        }
        for (index, cut) in draft.cuts.iter().enumerate() {
            if cut.change.is_none() {
                start(node as u32, index as u32 + 1, &mut is_taken);
            }
        }
    }

    // What is left are loops along which all changes are known.
    for node in 0..drafts.len() {
        if changes[node].is_some() && !is_taken[node] {
            start(node as u32, 0, &mut is_taken);
        }
    }
    starts.push(members.len());
    (members, starts)
}

/// The span after another, where the change to it is known.
fn following(
    graph: &CurveGraph,
    drafts: &[Option<Draft>],
    changes: &[Change],
    at: Member,
) -> Option<Member> {
    let draft = drafts[at.node as usize].as_ref()?;
    if let Some(cut) = draft.cuts.get(at.span as usize) {
        return Some(Member {
            span: at.span + 1,
            more: at.more + i32::from(cut.change?),
            ..at
        });
    }
    let next = graph.nodes[at.node as usize].next;
    Some(Member {
        node: next,
        span: 0,
        more: at.more + i32::from((*changes.get(next as usize)?)?),
    })
}

/// What was seen of a stretch.
enum Found {
    /// Surfaces in front of its first span.
    Counted(u32),
    /// Surfaces in front of each span, up to the limit.
    Each(Vec<u32>),
}

/// Sights to the spans of a graph's lines.
struct Looks<'a> {
    view: &'a View<'a>,
    graph: &'a CurveGraph,
    seen: &'a Seen<'a>,
    drafts: &'a [Option<Draft>],
}

impl Looks<'_> {
    fn at(&self, members: &[Member], memory: &mut Memory) -> Found {
        let limit = self.seen.count_limit;
        if members.len() > 1
            && let Some(first) = self.counted(members, memory)
        {
            return Found::Counted(first);
        }
        let each = members
            .iter()
            .map(|member| self.occluders(*member, limit, memory));
        Found::Each(each.collect())
    }

    /// Surfaces in front of the first span of a stretch, where two sights agree and nothing contradicts them; if all
    /// spans are hidden and hidden is all that matters, as few as hide them all.
    fn counted(&self, members: &[Member], memory: &mut Memory) -> Option<u32> {
        // Look at the longest of the spans with the fewest surfaces in front.
        let least = members.iter().map(|member| member.more).min()?;
        let only_hidden = self.seen.count_limit == 1;
        let limit = if only_hidden { 1 } else { MOST };
        let of_least = members.iter().filter(|member| member.more == least);
        let one = self.longest(of_least)?;
        let count = self.occluders(one, limit, memory);
        let first = i32::try_from(count).ok()? - least;

        // Look at the longest one elsewhere, which should be as the count says.
        let mut agree = only_hidden || count < MOST;
        if members.len() >= WITNESSED {
            let (before, after) = members.split_at(members.len() / 2);
            let is_before = before.iter().any(|member| member.at() == one.at());
            let half = if is_before { after } else { before };
            let other = self.longest(half.iter())?;
            let expected = u32::try_from(first + other.more).ok()?.min(limit);
            agree &= expected == self.occluders(other, limit, memory);
        }
        agree.then(|| u32::try_from(first).ok()).flatten()
    }

    fn longest<'m>(&self, members: impl Iterator<Item = &'m Member>) -> Option<Member> {
        let length = |member: &Member| {
            let draft = self.drafts[member.node as usize].as_ref();
            draft.map_or(0.0, |draft| draft.length_of(member.span as usize))
        };
        let longest = members.max_by(|a, b| length(a).total_cmp(&length(b)));
        longest.copied()
    }

    /// Number of surfaces in front of a span, up to a limit.
    fn occluders(&self, member: Member, limit: u32, memory: &mut Memory) -> u32 {
        let node = &self.graph.nodes[member.node as usize];
        let draft = self.drafts[member.node as usize].as_ref();
        let Some((draft, other)) = draft.zip(self.graph.nodes.get(node.next as usize)) else {
            return 0;
        };
        let ends = draft.ends_of(member.span as usize);
        let seen = Seen {
            count_limit: limit,
            ..*self.seen
        };
        let around = self.view.surroundings(node, other);
        seen.occluders(&draft.piece, ends, &around, &mut memory.last)
    }
}

/// More surfaces than any sight is counted through.
const MOST: u32 = 4096;

impl View<'_> {
    /// By how many surfaces the line after a vertex has more in front than the line before it, by the faces around the
    /// vertex; they cover the ends of both or not. Unknown where that is too close to tell, or for fans that are open.
    fn change_at(&self, before: &CurveNode, after: &CurveNode) -> Change {
        // Find the vertex, and the ways from it.
        let shape = self.shape;
        let is_edge =
            |node: &CurveNode| node.is_along_edge() && shape.polyline_of(node.edge).is_none();
        if !is_edge(before) || !is_edge(after) {
            return None;
        }
        let [low, high] = shape.ends(after.edge);
        let (vertex, next) = if after.t == 0.0 {
            (low, high)
        } else {
            (high, low)
        };
        let ends = shape.ends(before.edge);
        let last = ends.into_iter().find(|end| *end != vertex)?;
        let point = shape.point(vertex);
        if !ends.contains(&vertex) || self.projector.depth(point) <= self.projector.near() {
            return None;
        }
        let way = point - self.projector.sight_start(point);
        let way = way.normalize_or_zero();
        let arms = [last, next].map(|end| (end, shape.point(end) - point));

        // Count the faces around it that cover each.
        let mut sides = shape.sides(after.edge).iter().copied();
        let first = sides.find(|side| shape.ends_of_half_edge(*side)[0] == vertex)?;
        let mut more = 0_i16;
        let mut count = 0;
        let spoke_to = |end: u32| (end, Spoke::new(way, shape.point(end) - point));
        let first_spoke = spoke_to(shape.ends_of_half_edge(first)[1]);
        for is_forth in [true, false] {
            // Half-edges from the vertex on the way forth, to it on the way back.
            let mut half_edge = if is_forth {
                first
            } else {
                shape.twins[first as usize]
            };
            let mut spoke = first_spoke;
            while half_edge != NONE {
                let next = spoke_to(shape.opposite(half_edge));
                for (step, (end, arm)) in [-1, 1].into_iter().zip(arms) {
                    if end != spoke.0 && end != next.0 && covers([&spoke.1, &next.1], arm)? {
                        more += step;
                    }
                }
                count += 1;
                if count > WIDEST_FAN {
                    return None;
                }
                let mut into = HalfEdgeMesh::following(half_edge);
                if is_forth {
                    into = HalfEdgeMesh::following(into);
                }
                half_edge = shape.twins[into as usize];
                if half_edge == first {
                    return (self.prepared.fans[vertex as usize] == count).then_some(more);
                }
                spoke = next;
            }
        }
        (self.prepared.fans[vertex as usize] == count).then_some(more)
    }
}

/// A side of a face, from a vertex.
#[derive(Clone, Copy)]
struct Spoke {
    arm: DVec3,
    length: f64,
    /// Normal of the plane through the eye and the side.
    across: DVec3,
}

impl Spoke {
    fn new(way: DVec3, arm: DVec3) -> Self {
        Self {
            arm,
            length: arm.length(),
            across: way.cross(arm),
        }
    }
}

/// Whether a face with two sides from a vertex covers the start of a line from it; none where that is too close to
/// tell.
fn covers([a, b]: [&Spoke; 2], arm: DVec3) -> Option<bool> {
    // See whether the line's image starts between the images of the sides.
    let area = a.across.dot(b.arm);
    let reach = ANGLE * arm.length();
    let sign = area.signum();
    let (from_a, to_b) = (sign * a.across.dot(arm), -sign * b.across.dot(arm));
    let is_thin = area.abs() <= ANGLE * a.length * b.length;
    if !is_thin && (from_a < -reach * a.length || to_b < -reach * b.length) {
        return Some(false);
    }
    if is_thin || from_a < reach * a.length || to_b < reach * b.length {
        return None;
    }

    // See whether it lies behind the face.
    let normal = a.arm.cross(b.arm);
    let behind = sign * normal.dot(arm);
    let reach = reach * normal.length();
    (behind.abs() > reach).then_some(behind > 0.0)
}
