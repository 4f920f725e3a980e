//! Puts runs together from the spans of chains, which are cut where visibility, kind or surface changes.

use crate::mesh_lines::corner::start_at_head;
use crate::mesh_lines::graph::CurveGraph;
use crate::mesh_lines::line::Line;
use crate::mesh_lines::run::{Beyond, Run, RunPoint, base_id, distance, number};
use crate::mesh_lines::visibility::Span;
use crate::project::Projector;
use crate::rank::hash_key;
use crate::surface_location::SurfaceLocation;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Gaps in a line up to this length are closed, in pixels: nobody sees them, and each would cost a stroke.
const GAP_PX: f64 = 0.75;

/// Length over which the direction of a line is taken where something begins to hide it, in pixels.
const DIRECTION_PX: f64 = 6.0;

/// How many times as long as straight across a way behind something may be: a line that turns back there comes out as
/// another one.
const DETOUR_MOST: f64 = 2.0;

/// Bits of the number of a hidden way below those of its chain, and below those of its graph.
const NUMBER_BITS: [u32; 2] = [24, 56];

/// One span of a chain.
#[derive(Debug, Clone, Copy)]
struct Item<'a> {
    node: u32,
    line: &'a Line,
    span: Span,
    /// Whether it starts where the item before ends.
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

    /// Its start and its end in the picture.
    fn ends(&self) -> [[f64; 2]; 2] {
        [self.span.from, self.span.to].map(|share| self.line.piece.place_at(share))
    }
}

/// The runs of all chains of a graph, the hidden ones only where wanted; `lines` holds the line after each node.
///
/// `graph_number` tells the graphs of a view apart. Whether hidden ones are wanted changes nothing of the others.
/// O(spans), in parallel.
pub fn runs(
    shape: &HalfEdgeMesh,
    projector: &Projector,
    (graph, graph_number): (&CurveGraph, u64),
    (lines, hidden): (&[Option<Line>], bool),
) -> Vec<Run> {
    let maker = Maker {
        shape,
        projector,
        graph,
        graph_number,
        lines,
        hidden,
    };
    let chains = graph.chains().into_par_iter().with_min_len(8);
    let mut found: Vec<Run> = chains.flat_map_iter(|chain| maker.runs(chain)).collect();

    // Tell apart runs on one edge, and leave out what has too few points.
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
    let mut items: Vec<Item<'a>> = Vec::with_capacity(chain.len());
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

/// Shows hidden stretches too short to see, and hides visible ones where hidden lines continue around them.
fn close_gaps(items: &mut [Item<'_>]) {
    let mut from = 0;
    while from < items.len() {
        // Take the stretch that goes on without a change.
        let mut to = from + 1;
        while to < items.len() && items[to].continues(&items[to - 1]) {
            to += 1;
        }

        // Show it where it is hidden, too short to see, and enclosed by visible ones.
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

/// Where both ends of each part of a chain go on behind something to another part; parts are ranges of items, which
/// wrap around the end of the list, and the last goes on as the first where the chain is a loop.
///
/// A line goes on behind something if it keeps its direction where it is hidden, which it does not at a cusp, if it
/// comes out as what it was, and if it does not turn back there. `first_number` is the number of the first way.
fn ways_behind(
    items: &[Item<'_>],
    parts: &[[usize; 2]],
    (is_loop, first_number): (bool, u64),
) -> Vec<[Option<Beyond>; 2]> {
    let count = parts.len();
    let item = |index: usize| &items[index % items.len()];
    let mut found = vec![[None; 2]; count];
    for (number, [from, to]) in parts.iter().enumerate() {
        if item(*from).is_hidden() {
            continue;
        }

        // Follow what is hidden to the next part that is seen.
        let most = if is_loop { number + count } else { count };
        let seen = (number + 1..most).find(|next| !item(parts[next % count][0]).is_hidden());
        let Some(next) = seen else {
            continue;
        };
        let hidden: Vec<&Item<'_>> = (number + 1..next)
            .flat_map(|part| parts[part % count][0]..parts[part % count][1])
            .map(item)
            .collect();
        let (last, [next_from, next_to]) = (item(to - 1), parts[next % count]);
        let first = item(next_from);
        let is_whole = first.follows && hidden.iter().all(|item| item.follows);
        let is_alike = first.line.kind == last.line.kind && first.line.surface == last.line.surface;
        if hidden.is_empty() || !is_whole || !is_alike {
            continue;
        }

        // Look whether it keeps its direction and does not turn back.
        let before = way(((*from)..*to).rev().map(item), 1);
        let after = way((next_from..next_to).map(item), 0);
        let behind = [
            way(hidden.iter().copied(), 0),
            way(hidden.iter().rev().copied(), 1),
        ];
        let keeps = |out: [f64; 2], on: [f64; 2]| out[0] * on[0] + out[1] * on[1] < 0.0;
        let length_px: f64 = hidden.iter().map(|item| item.length()).sum();
        let across = distance(last.ends()[1], first.ends()[0]);
        if keeps(before, behind[0]) && keeps(after, behind[1]) && length_px <= DETOUR_MOST * across
        {
            let beyond = Beyond {
                number: first_number + number as u64,
                length_px,
            };
            found[number][1] = Some(beyond);
            found[next % count][0] = Some(beyond);
        }
    }
    found
}

/// The way into items from the near end of the first, as far as directions are taken; `near` is 0 where that is its
/// start and 1 where it is its end.
fn way<'a>(items: impl Iterator<Item = &'a Item<'a>>, near: usize) -> [f64; 2] {
    let mut from = None;
    let mut to = [0.0; 2];
    let mut length = 0.0;
    for item in items {
        let ends = item.ends();
        from.get_or_insert(ends[near]);
        to = ends[1 - near];
        length += item.length();
        if length >= DIRECTION_PX {
            break;
        }
    }
    from.map_or([0.0; 2], |from| [0, 1].map(|i| to[i] - from[i]))
}

/// Makes runs of the chains of a graph.
struct Maker<'a> {
    shape: &'a HalfEdgeMesh,
    projector: &'a Projector,
    graph: &'a CurveGraph,
    graph_number: u64,
    /// The line after each node.
    lines: &'a [Option<Line>],
    /// Whether hidden runs are made.
    hidden: bool,
}

impl Maker<'_> {
    /// The runs of a chain, in their order along it.
    fn runs(&self, mut chain: Vec<u32>) -> Vec<Run> {
        // Start loops where the mesh says, not where the list does.
        if self.graph.is_loop(&chain) {
            start_at_anchor(self.graph, &mut chain);
        }
        let (mut items, is_loop) = items(self.graph, self.lines, &chain);
        close_gaps(&mut items);
        let breaks = breaks(&items, is_loop);
        let is_made = |item: &Item<'_>| self.hidden || !item.is_hidden();

        // A loop that nothing interrupts becomes a closed run.
        let Some(first_break) = breaks.first() else {
            let whole = items.first().filter(|first| is_made(first));
            let whole = whole.map(|_| {
                let mut run = self.run(&items, true);
                start_at_head(&mut run);
                run
            });
            return whole.into_iter().collect();
        };

        // Else every part between two breaks becomes an open one, which may go on behind something.
        let ends = breaks.iter().skip(1).copied();
        let ends = ends.chain([first_break + items.len()]);
        let parts = breaks.iter().zip(ends).map(|(from, to)| [*from, to]);
        let parts: Vec<[usize; 2]> = parts.collect();
        let [of_chain, of_graph] = NUMBER_BITS;
        let number = self.graph_number << of_graph | u64::from(chain[0]) << of_chain;
        let beyond = ways_behind(&items, &parts, (is_loop, number));
        // One line may be nearly all there is.
        let parts = parts.into_par_iter().zip(beyond).with_min_len(16);
        parts
            .filter(|([from, _], _)| is_made(&items[*from]))
            .map(|([from, to], beyond)| {
                let part: Vec<Item<'_>> = (from..to).map(|k| items[k % items.len()]).collect();
                Run {
                    beyond,
                    ..self.run(&part, false)
                }
            })
            .collect()
    }

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
            cut: [(&items[0], 0.0), (&items[items.len() - 1], 1.0)].map(|end| self.ends_card(end)),
            beyond: [None; 2],
            part: None,
            weight: 1.0,
            points,
        }
    }

    /// Whether the start or the end of an item is the root or the tip of a card: nothing is joined there.
    fn ends_card(&self, (item, end): (&Item<'_>, f64)) -> bool {
        if self.shape.cards.is_empty() {
            return false;
        }
        let (piece, span) = (&item.line.piece, &item.span);
        let [at, bound] = match end {
            0.0 => [span.from, piece.range[0]],
            _ => [span.to, piece.range[1]],
        };
        let node = &self.graph.nodes[item.node as usize];
        let [low, high] = self.shape.ends(node.edge);
        let is_low = (node.t < 0.5) == (end == 0.0);
        at == end && bound == end && self.shape.cards.is_end(if is_low { low } else { high })
    }

    /// A mesh edge to hang an identity on: the one with the least hash, which most small changes leave in the run.
    fn anchor(&self, item: &Item<'_>) -> (u32, u64) {
        let edge = self.graph.nodes[item.node as usize].edge;
        (hash_key(edge), base_id(edge, item.line.kind))
    }

    /// The edge or face that the piece of an item lies on.
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
        // Find the point in the world.
        let piece = &item.line.piece;
        let node = &self.graph.nodes[item.node as usize];
        let other = &self.graph.nodes[node.next as usize];
        let world = piece.world_at(self.projector, share);
        let [from, to] = piece.range;
        let along = from + (to - from) * self.projector.world_share(share, piece.depth);

        // Name it by the nearer mesh edge.
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
