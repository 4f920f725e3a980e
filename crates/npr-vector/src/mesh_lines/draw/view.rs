//! The pieces of all lines in one view of a shape, and their visible parts.

use super::find_error::FindError;
use super::masses::leave_out_within;
use super::prepared::Prepared;
use super::stretches;
use crate::mesh_lines::bvh::NEAR_SHARE;
use crate::mesh_lines::feature::kind_in_view;
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use crate::mesh_lines::line::Line;
use crate::mesh_lines::line_settings::{LineSettings, LineSource, OUTLINE_TOLERANCE_PX};
use crate::mesh_lines::visibility::{
    Changes, Circumstances, Cut, FaceImages, Ink, Memory, Outline, OutlineGrid, Piece, Seen, Span,
    push,
};
use crate::mesh_lines::zero_set::{PolygonOutline, SeenContour, zero_set};
use crate::project::Projector;
use crate::rank::hash_key;
use crate::stroke::Kind;
use npr_core::budget::{Budget, OverBudget};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_core::interrupt::Interrupt;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use std::sync::atomic::Ordering;

/// Crowded pieces that are looked at together, before their ink is counted.
const ROUND: usize = 256;

/// Lines that a thread looks for outlines among at once.
const OUTLINES_AT_ONCE: usize = 512;

/// The memory and the ink that a view has used up.
pub(super) struct Toll {
    pub(super) budget: Budget,
    ink: Ink,
    pub(super) left_out: usize,
    /// Whether memory for boxes of faces has been taken.
    has_images: bool,
    /// Ends the work where it is raised.
    pub(super) interrupt: Interrupt,
}

impl Toll {
    pub(super) fn new(settings: &LineSettings) -> Self {
        Self {
            budget: Budget::new(settings.memory_limit),
            ink: Ink::new(settings.size),
            left_out: 0,
            has_images: false,
            interrupt: Interrupt::NEVER,
        }
    }

    fn take_spans(&mut self, count: usize) -> Result<(), OverBudget> {
        self.budget.take("parts of lines", count, size_of::<Span>())
    }
}

/// The piece of line after a node before anybody looked at it.
pub(super) struct Draft {
    /// The kind that it is drawn as.
    pub(super) kind: Kind,
    pub(super) piece: Piece,
    /// Where what is seen of it may change.
    pub(super) cuts: Vec<Cut>,
    /// For both ends, whether the changes there are those of the faces around them.
    pub(super) is_plain: [bool; 2],
    /// It crosses too many outlines to be cut.
    pub(super) is_crowded: bool,
}

impl Draft {
    /// Number of its parts; a crowded one has none.
    pub(super) fn span_count(&self) -> usize {
        match self.is_crowded {
            true => 0,
            false => self.cuts.len() + 1,
        }
    }

    /// Where a part of it starts and ends, in shares of its image.
    pub(super) fn ends_of(&self, span: usize) -> [f64; 2] {
        let before = span.checked_sub(1).and_then(|before| self.cuts.get(before));
        let after = self.cuts.get(span);
        [
            before.map_or(0.0, |cut| cut.at),
            after.map_or(1.0, |cut| cut.at),
        ]
    }

    /// Length of a part in pixels.
    pub(super) fn length_of(&self, span: usize) -> f64 {
        let [from, to] = self.ends_of(span);
        self.piece.length() * (to - from)
    }

    /// Its parts with what is in front of them; those that are alike become one.
    pub(super) fn spans(&self, occluders: &[u32]) -> Vec<Span> {
        let mut spans = Vec::with_capacity(1);
        for (index, occluders) in occluders.iter().enumerate() {
            push(&mut spans, self.ends_of(index), *occluders);
        }
        spans
    }
}

/// One view of a shape.
pub(super) struct View<'a> {
    pub(super) shape: &'a HalfEdgeMesh,
    pub(super) prepared: &'a Prepared,
    pub(super) projector: &'a Projector,
    pub(super) settings: &'a LineSettings,
    pub(super) front: &'a [u8],
    /// Edges that smooth contours run along or beside, ascending; they need no other line.
    pub(super) covered: Vec<u32>,
}

impl View<'_> {
    /// All that can begin or end hiding something: contours, boundaries, and edges of more than two faces.
    pub(super) fn outlines(
        &self,
        contours: &CurveGraph,
        budget: &mut Budget,
    ) -> Result<OutlineGrid, OverBudget> {
        // Pay for as many pieces as there can be.
        let lists = [&contours.nodes, &self.prepared.features.nodes].map(Vec::len);
        let most = lists[0] + lists[1] + self.prepared.rims.len();
        budget.take("outlines", most, size_of::<Outline>())?;

        // Take contours, features that are contours in this view, and open edges.
        let contours = self.outlines_among(&contours.nodes, |node| {
            (node.flags & KindSet::CONTOUR != 0).then_some(node.edge)
        });
        let odd = self.outlines_among(&self.prepared.features.nodes, |node| {
            let is_contour = node.next != NONE && self.kinds_of(node) & KindSet::CONTOUR != 0;
            is_contour.then_some(node.edge)
        });
        let rims = self.outlines_among(&self.prepared.rims, |edge| Some(*edge));

        // Sort them into a grid over the picture.
        let found = || contours.iter().chain(&odd).chain(&rims);
        let mut pieces = Vec::with_capacity(found().map(Vec::len).sum());
        found().for_each(|found| pieces.extend_from_slice(found));
        OutlineGrid::new(self.settings.size, pieces, budget)
    }

    /// Feature edges that are contours of the polygons in this view.
    pub(super) fn contour_features(&self) -> impl Iterator<Item = (u32, Piece)> {
        let edges = self.prepared.features.nodes.iter().map(|node| node.edge);
        edges.filter_map(|edge| {
            let sides = self.shape.sides(edge);
            let fronts = sides
                .iter()
                .filter(|side| self.front[**side as usize / 3] != 0);
            let is_contour = sides.len() == 2 && fronts.count() == 1;
            Some((edge, is_contour.then(|| self.edge_piece(edge)).flatten()?))
        })
    }

    /// The outlines on the edges of some lines, in their order.
    fn outlines_among<T: Sync>(
        &self,
        lines: &[T],
        edge_of: impl Fn(&T) -> Option<u32> + Sync,
    ) -> Vec<Vec<Outline>> {
        let among = |chunk: &[T]| {
            let mut found = Vec::with_capacity(chunk.len());
            let edges = chunk.iter().filter_map(&edge_of);
            found.extend(edges.filter_map(|edge| self.outline(edge)));
            found
        };
        lines.par_chunks(OUTLINES_AT_ONCE).map(among).collect()
    }

    fn outline(&self, edge: u32) -> Option<Outline> {
        let piece = self.edge_piece(edge)?;
        let ends = self.shape.ends(edge);
        let image = piece.image();
        Some(Outline { image, edge, ends })
    }

    fn edge_piece(&self, edge: u32) -> Option<Piece> {
        let [a, b] = self.shape.ends(edge).map(|v| self.shape.point(v));
        Piece::new(self.projector, self.settings.size, a, b)
    }

    /// The kinds of the piece after a node in this view.
    fn kinds_of(&self, node: &CurveNode) -> u32 {
        let feature = KindSet::BITS & !(KindSet::CONTOUR | KindSet::INTERSECTION);
        let in_loop = node.flags & (KindSet::CONTOUR | EdgeFlags::SEAM.0 | KindSet::INTERSECTION);
        if in_loop != 0 || self.shape.polyline_of(node.edge).is_some() {
            return node.flags & KindSet::BITS;
        }
        let flags = node.flags & feature;
        // Smooth contours follow only some of the edges that turn away.
        let has_line = match self.settings.method {
            LineSource::Surface => self.covered.binary_search(&node.edge).is_ok(),
            _ => self.settings.kinds & KindSet::CONTOUR != 0,
        };
        let flags = kind_in_view(self.shape, self.front, node.edge, flags, has_line);
        let sides = self.shape.sides(node.edge);
        let backs = sides.iter().all(|side| self.front[*side as usize / 3] == 0);
        let unseen = !self.settings.hidden && !self.prepared.may_show_backs(self.shape, node.face);
        if backs && sides.len() == 2 && unseen {
            return flags & KindSet::CONTOUR;
        }
        flags
    }

    /// The line after every node of a graph, with its visible parts; `None` where nothing is drawn.
    pub(super) fn lines(
        &self,
        graph: &CurveGraph,
        seen: &Seen<'_>,
        wanted: u32,
        toll: &mut Toll,
    ) -> Result<Vec<Option<Line>>, FindError> {
        let count = graph.nodes.len();
        if count == 0 {
            return Ok(Vec::new());
        }
        toll.budget
            .take("lines of a view", count, stretches::BYTES_PER_NODE)?;

        // Cut every piece that is not crowded, and look at what is seen of it.
        let ended = Interrupt::new();
        let drafts: Vec<Option<Draft>> = graph
            .nodes
            .par_iter()
            .with_min_len(64)
            .map(|node| {
                if toll.interrupt.is_raised() {
                    ended.raise();
                    return None;
                }
                self.draft(graph, node, seen, wanted)
            })
            .collect();
        ended.check()?;
        let mut lines = stretches::looked_at(self, graph, seen, (&drafts, &toll.interrupt))?;

        // Look at crowded pieces by the ink on the paper.
        toll.take_spans(lines.iter().flatten().map(|line| line.spans.len()).sum())?;
        self.add_crowded(graph, seen, &mut lines, toll)?;
        leave_out_within(self, &mut lines);
        Ok(lines)
    }

    /// Finds the visible parts of crowded lines, in the order of the hashes of their edges, until the paper under the
    /// others is black.
    fn add_crowded(
        &self,
        graph: &CurveGraph,
        seen: &Seen<'_>,
        lines: &mut [Option<Line>],
        toll: &mut Toll,
    ) -> Result<(), OverBudget> {
        let is_crowded = |line: &Option<Line>| line.as_ref().is_some_and(|l| l.spans.is_empty());
        let mut crowded: Vec<usize> = (0..lines.len())
            .filter(|index| is_crowded(&lines[*index]))
            .collect();
        if crowded.is_empty() {
            return Ok(());
        }

        // A few of them cross outlines in less time than it takes to sort all faces into the picture.
        let pieces = crowded.iter().filter_map(|index| lines[*index].as_ref());
        let crossings: usize = pieces
            .map(|line| seen.outlines.count_along(&line.piece))
            .sum();
        if crossings <= self.shape.faces.len() {
            let found: Vec<Option<Vec<Span>>> = crowded
                .par_iter()
                .map_init(Memory::default, |memory, index| {
                    let piece = &lines[*index].as_ref()?.piece;
                    let node = &graph.nodes[*index];
                    let other = graph.nodes.get(node.next as usize)?;
                    let of_piece = self.circumstances(node, other);
                    Some(seen.spans_between_outlines(piece, &of_piece, memory))
                })
                .collect();
            for (index, spans) in crowded.iter().zip(found) {
                if let (Some(line), Some(spans)) = (&mut lines[*index], spans) {
                    toll.take_spans(spans.len())?;
                    line.spans = spans;
                }
            }
            return Ok(());
        }

        // Else sort the faces into the picture, once a view.
        if !toll.has_images {
            let (count, bytes) = (self.shape.faces.len(), FaceImages::BYTES_PER_FACE);
            toll.budget.take("boxes of faces", count, bytes)?;
            toll.has_images = true;
            seen.prepare();
        }
        crowded.sort_unstable_by_key(|index| (hash_key(graph.nodes[*index].edge), *index));
        for round in crowded.chunks(ROUND) {
            // What is left out hangs on the rounds before alone, so on no thread.
            let found: Vec<Option<Vec<Span>>> = round
                .par_iter()
                .map_init(Memory::default, |memory, index| {
                    let piece = lines[*index].as_ref().map(|line| &line.piece)?;
                    let node = &graph.nodes[*index];
                    let other = graph.nodes.get(node.next as usize)?;
                    let black = toll.ink.black_parts(piece);
                    let is_free = black != [[0.0, 1.0]];
                    let of_piece = || self.surroundings(node, other);
                    is_free.then(|| seen.crowded_spans(piece, &of_piece(), &black, memory))
                })
                .collect();
            for (index, spans) in round.iter().zip(found) {
                let (Some(line), Some(spans)) = (&mut lines[*index], spans) else {
                    lines[*index] = None;
                    toll.left_out += 1;
                    continue;
                };
                toll.take_spans(spans.len())?;
                toll.ink.draw(&line.piece, &spans, self.settings.hidden);
                line.spans = spans;
            }
        }
        Ok(())
    }

    /// The line after a node, cut where what is seen of it may change.
    fn draft(
        &self,
        graph: &CurveGraph,
        node: &CurveNode,
        seen: &Seen<'_>,
        wanted: u32,
    ) -> Option<Draft> {
        let kind = self.drawn_kind(node, wanted)?;
        let (piece, other) = self.piece_after(graph, node)?;
        let is_crowded = seen.outlines.is_crowded(&piece);
        let is_polyline = self.shape.polyline_of(node.edge).is_some();
        let mut changes = match is_crowded {
            true => Changes::default(),
            false => {
                let is_edge = node.is_along_edge() && !is_polyline;
                let ends = is_edge.then(|| self.shape.ends(node.edge));
                seen.changes(&piece, &self.piercings(node, other), ends)
            }
        };
        // Faces that a polyline touches do not hide it, whatever outlines say.
        if is_polyline {
            let cuts = changes.cuts.iter_mut();
            cuts.for_each(|cut| cut.change = None);
        }
        Some(Draft {
            kind,
            piece,
            cuts: changes.cuts,
            is_plain: changes.is_plain,
            is_crowded,
        })
    }

    /// The kind that the piece after a node is drawn as; `None` where it is not wanted, and for concave edges whose
    /// backs nobody sees.
    pub(super) fn drawn_kind(&self, node: &CurveNode, wanted: u32) -> Option<Kind> {
        if self.is_of_card(node) {
            return None;
        }
        let kind = Kind::first_of(self.kinds_of(node) & wanted)?;
        let concave = EdgeFlags::CONCAVE.is_in(node.flags);
        (!concave || self.prepared.may_show_backs(self.shape, node.face)).then_some(kind)
    }

    /// Whether a line belongs to a card that is drawn by its centre, or is where one cuts through something.
    fn is_of_card(&self, node: &CurveNode) -> bool {
        if self.shape.cards.is_empty() || self.shape.polyline_of(node.edge).is_some() {
            return false;
        }
        let cuts = node.flags & KindSet::INTERSECTION != 0;
        let sides = self.shape.sides(node.edge);
        let others = sides.iter().map(|side| side / 3).filter(|_| cuts);
        let mut faces = others.chain([node.face]);
        faces.any(|face| face != NONE && self.shape.is_lineless(face))
    }

    /// The line after a node, on its surface.
    pub(super) fn line_of(
        &self,
        node: &CurveNode,
        kind: Kind,
        piece: Piece,
        spans: Vec<Span>,
    ) -> Line {
        let surface = match self.shape.polyline_of(node.edge) {
            Some(polyline) => self.shape.polyline_surfaces[polyline],
            None => self.shape.face_surfaces[node.face as usize],
        };
        Line {
            kind,
            surface,
            piece,
            spans,
        }
    }

    /// The piece after a node, with the node it runs to; `None` where the line ends or the piece is out of the frame.
    pub(super) fn piece_after<'g>(
        &self,
        graph: &'g CurveGraph,
        node: &CurveNode,
    ) -> Option<(Piece, &'g CurveNode)> {
        // The end of an open line names no node.
        let other = graph.nodes.get(node.next as usize)?;
        let [a, b] = [node, other].map(|node| self.shape.point_on(node.edge, node.t));
        let piece = Piece::new(self.projector, self.settings.size, a, b)?;
        Some((piece, other))
    }

    /// Where the piece between two nodes goes through faces, from its start.
    fn piercings(&self, node: &CurveNode, other: &CurveNode) -> Vec<f64> {
        if !node.is_along_edge() {
            // Where two surfaces cut each other, the line may go through a third.
            let own = self.surroundings(node, other).own_faces;
            let ends = [node, other].map(|node| self.shape.point_on(node.edge, node.t));
            let tree = &self.prepared.tree;
            return tree.piercings_between(self.shape, ends, |face| own.contains(&face));
        }
        let up = node.t < 0.5;
        let is_polyline = self.shape.polyline_of(node.edge).is_some();
        let are_known = self.prepared.has_crossings && !is_polyline;
        let mut found: Vec<f64> = Vec::new();
        if are_known {
            let known = self.prepared.crossings.of_edge(node.edge).iter();
            found.extend(known.map(|p| f64::from(if up { p.t } else { 1.0 - p.t })));
        }

        // Look for others; whether an edge goes through any face is known once somebody looked.
        let whole = self.prepared.whole.get(node.edge as usize);
        if whole.is_some_and(|is_whole| is_whole.load(Ordering::Relaxed)) {
            return found;
        }
        let [low, high] = self.shape.ends(node.edge);
        let ends = if up { [low, high] } else { [high, low] };
        let places = self.prepared.tree.piercings(self.shape, ends);
        if let (Some(whole), true) = (whole, places.is_empty()) {
            whole.store(true, Ordering::Relaxed);
        }

        // An end that touches a face pierces it for one side at most, and is wanted for both.
        let is_end = |t: &f64| t.abs() < NEAR_SHARE || (1.0 - t).abs() < NEAR_SHARE;
        found.extend(places.into_iter().filter(|t| !are_known || is_end(t)));
        found
    }

    /// The smooth contours of the view with their visible parts, where the settings ask for them.
    pub(super) fn smooth_contours(
        &self,
        contours: &CurveGraph,
        lines: &[Option<Line>],
    ) -> Option<(CurveGraph, Vec<Option<Line>>)> {
        if self.settings.method != LineSource::Surface {
            return None;
        }
        let prepared = self.prepared;
        let normals = prepared.corner_normals(self.shape);
        let convex = contours.nodes.iter().zip(lines).filter_map(|(node, line)| {
            let line = line.as_ref()?;
            (!EdgeFlags::CONCAVE.is_in(node.flags)).then_some((node, line))
        });
        let seen: Vec<SeenContour> = convex
            .flat_map(|(node, line)| {
                SeenContour::of_piece(self.projector, node, &line.piece, &line.spans)
            })
            .collect();
        let outline = PolygonOutline::new(
            (self.shape, normals),
            (self.projector, self.settings.size),
            self.front,
            &seen,
            OUTLINE_TOLERANCE_PX,
        );
        let graph = zero_set(
            self.shape,
            normals,
            self.projector.eye(),
            &outline.flat_faces(),
        );
        let pieces: Vec<Option<Piece>> = graph
            .nodes
            .iter()
            .map(|node| {
                // Its own surface hides a concave piece.
                let shows = !EdgeFlags::CONCAVE.is_in(node.flags);
                let piece = shows.then(|| self.piece_after(&graph, node)).flatten()?;
                Some(piece.0)
            })
            .collect();
        let spans = outline.spans(&graph, &pieces);
        let line = |(node, (piece, spans)): (&CurveNode, (&Option<Piece>, Vec<Span>))| {
            let piece = (*piece)?;
            let surface = self.shape.face_surfaces[node.face as usize];
            (!spans.is_empty() && !self.is_of_card(node)).then_some(Line {
                kind: Kind::Contour,
                surface,
                piece,
                spans,
            })
        };
        let lines = graph
            .nodes
            .iter()
            .zip(pieces.iter().zip(spans))
            .map(line)
            .collect();
        Some((graph, lines))
    }

    /// Faces that a piece lies in, and where it goes through other faces.
    fn circumstances(&self, node: &CurveNode, other: &CurveNode) -> Circumstances {
        Circumstances {
            piercings: self.piercings(node, other),
            ..self.surroundings(node, other)
        }
    }

    /// Faces that a piece lies in.
    pub(super) fn surroundings(&self, node: &CurveNode, other: &CurveNode) -> Circumstances {
        // Along an edge, a line lies in the faces beside it, which do not hide it.
        let beside = |edge: u32| self.shape.sides(edge).iter().map(|side| side / 3);
        if let Some(polyline) = self.shape.polyline_of(node.edge) {
            return Circumstances {
                piercings: Vec::new(),
                own_faces: self.shape.cards.faces(polyline).to_vec(),
                touch: self.prepared.touch,
            };
        }
        if node.is_along_edge() {
            return Circumstances {
                own_faces: beside(node.edge).collect(),
                ..Circumstances::default()
            };
        }

        // Across a face, it lies in that one and in those that hold both of its ends. What touches one end alone, as
        // the next side of a box does, may well hide the rest.
        let at = |end: &CurveNode| {
            let pierced = self.prepared.crossings.at(end.edge, end.t).iter();
            let faces = beside(end.edge).chain(pierced.map(|p| p.face));
            faces.collect::<Vec<u32>>()
        };
        let (here, there) = (at(node), at(other));
        // A vertex may be a corner of a face whose edges the other end has nothing to do with.
        let touches = |face: u32, end: &CurveNode, faces: &[u32]| {
            let corners = self.shape.faces[face as usize];
            let [low, high] = self.shape.ends(end.edge);
            let is_corner =
                end.t == 0.0 && corners.contains(&low) || end.t == 1.0 && corners.contains(&high);
            is_corner || faces.contains(&face)
        };
        let mut own_faces = vec![node.face];
        own_faces.extend(here.iter().filter(|face| touches(**face, other, &there)));
        own_faces.extend(there.iter().filter(|face| touches(**face, node, &here)));
        Circumstances {
            own_faces,
            ..Circumstances::default()
        }
    }
}
