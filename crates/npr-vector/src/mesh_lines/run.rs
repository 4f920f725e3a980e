//! Runs: what is seen of a chain, cut where visibility, kind or surface changes.

use crate::mesh_lines::corner::start_at_head;
use crate::mesh_lines::graph::CurveGraph;
use crate::mesh_lines::visibility::{Piece, Span};
use crate::project::Projector;
use crate::rank::hash_key;
use crate::stroke::Kind;
use crate::surface_location::SurfaceLocation;
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Gaps in a line up to this length are closed, in pixels: nobody sees them, and each would cost a stroke.
const GAP_PX: f64 = 0.75;

/// The piece of line after a node, as drawn in a view.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// What it is drawn as.
    pub kind: Kind,
    /// Surface that it lies on.
    pub surface: u32,
    /// Where it lies.
    pub piece: Piece,
    /// What is seen of it; gaps between them are left out.
    pub spans: Vec<Span>,
}

/// A point of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunPoint {
    /// Place in the picture, in pixels.
    pub place: [f64; 2],
    /// Distance from the eye along the view axis.
    pub depth: f64,
    /// Place in the world.
    pub world: DVec3,
    /// The mesh edge it lies on or near: its identity, not where it is.
    pub edge: u32,
    /// Where on that edge, from its lower vertex.
    pub t: f32,
    /// What the line lies on from here to the next point.
    pub location: SurfaceLocation,
    /// Whether the line changes what it lies on between here and the next point, where two lines were joined across a
    /// gap or where places on two edges follow each other. What is between both in the world lies on neither, so all
    /// places of the first half are those of this point there, and those of the second half those of the next.
    pub leaps: bool,
}

/// A connected part of a line with one kind, surface and visibility.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Stays with the run from frame to frame.
    pub id: u64,
    /// What it is drawn as.
    pub kind: Kind,
    /// Surface that it lies on.
    pub surface: u32,
    /// Object that it lies on.
    pub object: u32,
    /// Least number of surfaces in front of it.
    pub occluders: u32,
    /// The last point runs on to the first.
    pub closed: bool,
    /// Its first and last point are where it was cut at a corner: nothing goes on there.
    pub cut: [bool; 2],
    /// Factor on its width.
    pub weight: f64,
    /// At least two points.
    pub points: Vec<RunPoint>,
}

impl Run {
    /// The same run without points.
    pub(crate) fn clone_empty(&self) -> Self {
        Self {
            points: Vec::new(),
            ..*self
        }
    }

    /// Whether both may be parts of one line: of one kind, object and surface, and both seen or both hidden.
    pub(crate) fn may_join(&self, other: &Self) -> bool {
        self.kind == other.kind && self.surface == other.surface && self.is_beside(other)
    }

    /// Whether both are of one object, and both seen or both hidden.
    pub(crate) fn is_beside(&self, other: &Self) -> bool {
        self.object == other.object && (self.occluders > 0) == (other.occluders > 0)
    }

    /// The same line, travelled the other way.
    pub(crate) fn reverse(&mut self) {
        // What lay after a point now lies before it; what comes after a leap stays on what it lay on.
        let after: Vec<(SurfaceLocation, bool)> =
            self.points.iter().map(|p| (p.location, p.leaps)).collect();
        self.points.reverse();
        self.cut.reverse();
        let count = self.points.len();
        for (i, point) in self.points.iter_mut().enumerate() {
            let (location, leaps) = after[(2 * count - 2 - i) % count];
            let is_end = !self.closed && i + 1 == count;
            point.leaps = leaps && !is_end;
            if !leaps && !is_end {
                point.location = location;
            }
        }
    }

    /// What the line lies on at a point of a number: at an open end on what it has come along.
    pub(crate) fn location_at(&self, index: usize) -> SurfaceLocation {
        location_at(&self.points, self.closed, index)
    }

    /// Length in the picture, in pixels.
    pub fn length(&self) -> f64 {
        let open: f64 = self
            .points
            .windows(2)
            .map(|p| distance(p[0].place, p[1].place))
            .sum();
        let (first, last) = (&self.points[0], &self.points[self.points.len() - 1]);
        if self.closed {
            open + distance(last.place, first.place)
        } else {
            open
        }
    }
}

/// Distance of two places, in pixels.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
}

/// One span of a chain.
#[derive(Debug, Clone, Copy)]
struct Item<'a> {
    node: u32,
    line: &'a Line,
    span: Span,
    /// It starts where the item before ends.
    follows: bool,
}

impl Item<'_> {
    fn is_hidden(&self) -> bool {
        self.span.occluders > 0
    }

    fn continues(&self, before: &Self) -> bool {
        self.follows
            && self.is_hidden() == before.is_hidden()
            && self.line.kind == before.line.kind
            && self.line.surface == before.line.surface
    }

    fn length(&self) -> f64 {
        self.line.piece.length() * (self.span.to - self.span.from)
    }
}

/// The runs of all chains of a graph; `lines` holds what is drawn after each node.
pub fn runs(
    shape: &HalfEdgeMesh,
    projector: &Projector,
    graph: &CurveGraph,
    lines: &[Option<Line>],
) -> Vec<Run> {
    let mut found = Vec::new();
    for mut chain in graph.chains() {
        if graph.is_loop(&chain) {
            start_at_anchor(graph, &mut chain);
        }
        let (mut items, is_loop) = items(graph, lines, &chain);
        close_gaps(&mut items);
        let breaks: Vec<usize> = breaks(&items, is_loop);
        let maker = Maker {
            shape,
            projector,
            graph,
        };
        if breaks.is_empty() && !items.is_empty() {
            let mut run = maker.run(&items, true);
            start_at_head(&mut run);
            found.push(run);
            continue;
        }
        for (i, from) in breaks.iter().enumerate() {
            let to = breaks
                .get(i + 1)
                .copied()
                .unwrap_or(breaks[0] + items.len());
            let part: Vec<Item<'_>> = (*from..to).map(|k| items[k % items.len()]).collect();
            found.push(maker.run(&part, false));
        }
    }
    number(&mut found);
    found.retain(|run| run.points.len() >= if run.closed { 3 } else { 2 });
    found
}

/// Turns a loop so that it starts at the node on the mesh edge with the least hash, as [`crate::rank`] does; never at
/// the first in the list, whose place means nothing.
fn start_at_anchor(graph: &CurveGraph, chain: &mut [u32]) {
    let anchor = |index: usize| {
        let node = &graph.nodes[chain[index] as usize];
        (hash_key(node.edge), node.t.to_bits())
    };
    let head = (0..chain.len()).min_by_key(|index| anchor(*index));
    chain.rotate_left(head.unwrap_or(0));
}

/// The spans of a chain, and whether the last may run on to the first.
fn items<'a>(
    graph: &CurveGraph,
    lines: &'a [Option<Line>],
    chain: &[u32],
) -> (Vec<Item<'a>>, bool) {
    let mut items: Vec<Item<'a>> = Vec::new();
    let mut open = false;
    for node in chain {
        let Some(line) = &lines[*node as usize] else {
            open = false;
            continue;
        };
        let whole_start = line.piece.range[0] == 0.0;
        for (i, span) in line.spans.iter().enumerate() {
            // Where paper is black already there is no span.
            let follows = match i.checked_sub(1) {
                Some(before) => line.spans[before].to == span.from,
                None => open && whole_start && span.from == 0.0,
            };
            items.push(Item {
                node: *node,
                line,
                span: *span,
                follows,
            });
        }
        open = line.piece.range[1] == 1.0 && line.spans.last().is_some_and(|span| span.to == 1.0);
    }
    let first = chain[0];
    let is_loop = graph.is_loop(chain) && open;
    if let (Some(item), Some(line)) = (items.first_mut(), &lines[first as usize]) {
        let is_whole = line.piece.range[0] == 0.0 && item.span.from == 0.0;
        item.follows = is_loop && is_whole && item.node == first;
    }
    (items, is_loop)
}

/// Makes hidden stretches too short to see visible, and visible ones hidden where hidden lines go on around them.
fn close_gaps(items: &mut [Item<'_>]) {
    let mut from = 0;
    while from < items.len() {
        let mut to = from + 1;
        while to < items.len() && items[to].continues(&items[to - 1]) {
            to += 1;
        }
        let length: f64 = items[from..to].iter().map(Item::length).sum();
        let enclosed = from > 0
            && to < items.len()
            && items[from].is_hidden()
            && items[from].follows
            && items[to].follows
            && !items[from - 1].is_hidden()
            && !items[to].is_hidden();
        if enclosed && length < GAP_PX {
            items[from..to]
                .iter_mut()
                .for_each(|item| item.span.occluders = 0);
        }
        from = to;
    }
}

/// Where runs begin; empty for a closed one.
fn breaks(items: &[Item<'_>], is_loop: bool) -> Vec<usize> {
    (0..items.len())
        .filter(|i| match i.checked_sub(1) {
            Some(before) => !items[*i].continues(&items[before]),
            None => !(is_loop && items[0].continues(&items[items.len() - 1])),
        })
        .collect()
}

/// Makes runs from items.
struct Maker<'a> {
    shape: &'a HalfEdgeMesh,
    projector: &'a Projector,
    graph: &'a CurveGraph,
}

impl Maker<'_> {
    fn run(&self, items: &[Item<'_>], closed: bool) -> Run {
        let first = items[0].line;
        let mut points = vec![self.point(&items[0], items[0].span.from)];
        for (item, next) in items
            .iter()
            .zip(items.iter().skip(1).chain([&items[items.len() - 1]]))
        {
            let mut point = self.point(item, item.span.to);
            point.location = self.location(next);
            let last = points.len() - 1;
            match point.place == points[last].place {
                true => points[last].location = point.location,
                false => points.push(point),
            }
        }
        // The last point of a closed run is its first.
        if closed && points.len() > 1 {
            points.pop();
        }
        Run {
            id: items
                .iter()
                .map(|item| self.anchor(item))
                .min()
                .map_or(0, |(_, id)| id),
            kind: first.kind,
            surface: first.surface,
            object: self.shape.surfaces[first.surface as usize].object,
            occluders: items
                .iter()
                .map(|item| item.span.occluders)
                .min()
                .unwrap_or(0),
            closed,
            cut: [false; 2],
            weight: 1.0,
            points,
        }
    }

    /// A mesh edge to hang an identity on: the one with the least hash, which most small changes leave in the run.
    fn anchor(&self, item: &Item<'_>) -> (u32, u64) {
        let edge = self.graph.nodes[item.node as usize].edge;
        (hash_key(edge), base_id(edge, item.line.kind))
    }

    /// What the piece of an item lies on.
    fn location(&self, item: &Item<'_>) -> SurfaceLocation {
        let node = &self.graph.nodes[item.node as usize];
        let other = &self.graph.nodes[node.next as usize];
        let is_along = node.is_along_edge() || node.edge == other.edge;
        SurfaceLocation {
            edge: node.edge,
            face: if is_along { NONE } else { node.face },
        }
    }

    fn point(&self, item: &Item<'_>, share: f64) -> RunPoint {
        let piece = &item.line.piece;
        let node = &self.graph.nodes[item.node as usize];
        let other = &self.graph.nodes[node.next as usize];
        let world = piece.world_at(self.projector, share);
        let [from, to] = piece.range;
        let along = from + (to - from) * self.projector.world_share(share, piece.depth);
        let (edge, t) = if node.is_along_edge() {
            (
                node.edge,
                if node.t < 0.5 {
                    along as f32
                } else {
                    1.0 - along as f32
                },
            )
        } else if along < 0.5 {
            (node.edge, node.t)
        } else {
            (other.edge, other.t)
        };
        RunPoint {
            place: piece.place_at(share),
            depth: self.projector.depth(world),
            world,
            edge,
            t: t.clamp(0.0, 1.0),
            location: self.location(item),
            leaps: false,
        }
    }
}

/// What a line lies on at one of its points: at an open end, and after no leap, on what it has come along.
pub(crate) fn location_at(points: &[RunPoint], closed: bool, index: usize) -> SurfaceLocation {
    let is_end = !closed && index + 1 == points.len();
    let before = &points[index - usize::from(is_end && index > 0)];
    if before.leaps {
        points[index].location
    } else {
        before.location
    }
}

/// Identity of the first run of a kind that hangs on an edge; the runs on one edge are told apart by eight bits below
/// it.
pub(crate) fn base_id(edge: u32, kind: Kind) -> u64 {
    u64::from(edge) << 3 | kind as u64
}

/// Tells apart runs that hang on the same edge, in the order in which they lie along it.
pub(crate) fn number(runs: &mut [Run]) {
    let mut order: Vec<usize> = (0..runs.len()).collect();
    order.sort_by(|a, b| {
        let along = |i: usize| (runs[i].id, runs[i].occluders > 0);
        along(*a).cmp(&along(*b)).then(a.cmp(b))
    });
    let mut last = None;
    let mut ordinal = 0;
    for index in order {
        let id = runs[index].id;
        ordinal = if last == Some(id) { ordinal + 1 } else { 0 };
        last = Some(id);
        runs[index].id = id << 8 | ordinal;
    }
}

/// Runs for tests of what follows.
#[cfg(test)]
pub(crate) mod testing {
    use super::*;

    /// An open contour through places of the picture, all at depth 1.
    pub fn run_along(id: u64, places: &[[f64; 2]]) -> Run {
        let point = |place: &[f64; 2]| RunPoint {
            place: *place,
            depth: 1.0,
            world: DVec3::new(place[0], place[1], 0.0),
            edge: 0,
            t: 0.0,
            location: SurfaceLocation::along(0),
            leaps: false,
        };
        Run {
            id,
            kind: Kind::Contour,
            surface: 0,
            object: 0,
            occluders: 0,
            closed: false,
            cut: [false; 2],
            weight: 1.0,
            points: places.iter().map(point).collect(),
        }
    }
    /// A closed contour around a circle about (200, 200).
    pub fn ring(id: u64, radius: f64, count: usize) -> Run {
        let step = std::f64::consts::TAU / count as f64;
        let place = |i: usize| {
            let a = i as f64 * step;
            [200.0 + radius * a.cos(), 200.0 + radius * a.sin()]
        };
        let places: Vec<[f64; 2]> = (0..count).map(place).collect();
        Run {
            closed: true,
            ..run_along(id, &places)
        }
    }

    /// An open contour from a place in a direction, with points 1.5 px apart.
    pub fn straight(id: u64, from: [f64; 2], angle: f64, length: f64) -> Run {
        let count = (length / 1.5).ceil().max(1.0);
        let place = |i: u32| {
            let at = length * f64::from(i) / count;
            [from[0] + at * angle.cos(), from[1] + at * angle.sin()]
        };
        run_along(id, &(0..=count as u32).map(place).collect::<Vec<_>>())
    }
}

#[cfg(test)]
mod tests {
    use super::testing::{ring, run_along};
    use super::*;

    /// For every piece its two ends, the lesser first, with what it lies on.
    fn located(run: &Run) -> Vec<([u64; 2], SurfaceLocation)> {
        let count = run.points.len();
        let pieces = if run.closed { count } else { count - 1 };
        let mut found: Vec<([u64; 2], SurfaceLocation)> = (0..pieces)
            .map(|i| {
                let mut ends = [i, (i + 1) % count].map(|k| run.points[k].place[0].to_bits());
                ends.sort_unstable();
                (ends, run.location_at(i))
            })
            .collect();
        found.sort_unstable_by_key(|(ends, _)| *ends);
        found
    }

    #[test]
    fn pieces_keep_their_locations_when_a_run_is_turned_round() {
        let open = run_along(0, &[0.0, 3.0, 7.0, 8.0, 11.0].map(|x| [x, 0.0]));
        for mut run in [open, ring(0, 30.0, 7)] {
            for (edge, point) in (0..).zip(&mut run.points) {
                point.location = SurfaceLocation::along(edge);
            }
            let before = located(&run);
            run.reverse();
            assert_eq!(located(&run), before);
            let last = run.points.len() - 1;
            if !run.closed {
                assert_eq!(run.location_at(last), run.location_at(last - 1));
            }
            run.reverse();
            assert_eq!(located(&run), before);
        }
    }
}
