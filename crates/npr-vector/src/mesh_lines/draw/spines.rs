//! The lines of a view before it is known what hides them, for [`sampled`](crate::sampled) pictures.

use super::paint::{broken_up, painted};
use super::view::{Toll, View};
use super::{Prepared, StrokeLook, ViewStrokes};
use crate::mesh_lines::bvh::{Sight, hides_alone};
use crate::mesh_lines::contour::EdgeContours;
use crate::mesh_lines::corner::split;
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use crate::mesh_lines::line::Line;
use crate::mesh_lines::line_settings::LineSettings;
use crate::mesh_lines::merge::{TOUCHING_PX, merge_ends};
use crate::mesh_lines::relabel_intersections::relabel_intersections;
use crate::mesh_lines::run::Run;
use crate::mesh_lines::run_assembly::runs;
use crate::mesh_lines::smooth::smooth;
use crate::mesh_lines::visibility::{Piece, Span};
use crate::project::Projector;
use npr_core::budget::OverBudget;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Greatest distance of points, in pixels, within which a line in the world and in the picture go alike.
const STEP_PX: f64 = 8.0;

/// How far before the line of a card the samples lie that are tested, in widths of the card: tubes that are twice as
/// thick one way as the other reach two thirds of their width from their middle.
const BEFORE_CARD: f64 = 0.7;

/// Most faces around a corner that are looked at.
const LARGEST_FAN: usize = 32;

/// The lines of a view, seen or hidden, as strokes whose visibility is still to be decided.
///
/// Left out is what the mesh itself tells: contours along valleys, and contours that a face at one of their corners
/// hides. What is beside a longer line stays, since that one may be hidden. O(faces + lines log lines), in parallel,
/// with the same result for any number of threads.
///
/// # Errors
///
/// [`OverBudget`] where what is found would take more than the settings' limit.
pub fn spines(
    shape: &HalfEdgeMesh,
    prepared: &Prepared,
    projector: &Projector,
    settings: &LineSettings,
    contours: &EdgeContours,
    look: &StrokeLook<'_>,
) -> Result<ViewStrokes, OverBudget> {
    let view = View {
        shape,
        prepared,
        projector,
        settings,
        front: &contours.front,
        covered: Vec::new(),
    };

    // Take all lines that the mesh does not hide by itself.
    let mut toll = Toll::new(settings);
    let graphs = [
        &contours.graph,
        &prepared.features,
        &prepared.polylines,
        &prepared.crossings.graph,
    ];
    let mut found = Vec::new();
    for (graph, number) in graphs.into_iter().zip(0..) {
        let lines = view.open_lines(graph, &mut toll)?;
        found.extend(runs(shape, projector, (graph, number), (&lines, false)));
    }
    if !shape.cards.is_empty() {
        let runs = found.iter_mut();
        runs.for_each(|run| draw_before_card(run, shape, projector));
    }

    // Join those that touch, cut them at corners, and smooth them; samples lie on straight ways in the world between
    // points.
    let lens = projector.lens();
    if settings.smooth {
        found = merge_ends(relabel_intersections(found), TOUCHING_PX);
    }
    if let Some(least_turn) = settings.split {
        found = split(found, least_turn);
    }
    match settings.smooth {
        true => smooth(&mut found, lens),
        false => found = broken_up(found, STEP_PX, lens),
    }
    Ok(ViewStrokes {
        strokes: painted(found, shape, look, lens),
        left_out: 0,
    })
}

/// Moves the line of a card, where it is one, towards the eye: in front of a card that bends or bulges over its own
/// line. Its image stays.
fn draw_before_card(run: &mut Run, shape: &HalfEdgeMesh, projector: &Projector) {
    for point in &mut run.points {
        if shape.polyline_of(point.edge).is_none() {
            continue;
        }
        let [low, high] = shape
            .ends(point.edge)
            .map(|vertex| shape.cards.point(vertex));
        let (Some(low), Some(high)) = (low, high) else {
            continue;
        };
        let width = low.width + f64::from(point.t) * (high.width - low.width);
        let way = projector.sight_start(point.world) - point.world;
        // Never as far as the eye.
        let step = (BEFORE_CARD * width).min(0.5 * way.length());
        point.world += way.normalize_or_zero() * step;
        point.depth = projector.depth(point.world);
    }
}

impl View<'_> {
    /// The line after every node of a graph, with one span; `None` where nothing is drawn.
    fn open_lines(
        &self,
        graph: &CurveGraph,
        toll: &mut Toll,
    ) -> Result<Vec<Option<Line>>, OverBudget> {
        let count = graph.nodes.len();
        let of_node = size_of::<Option<Line>>() + size_of::<Span>();
        toll.budget.take("lines of a view", count, of_node)?;
        let wanted = self.settings.kinds | KindSet::MARKED;
        let nodes = graph.nodes.par_iter().with_min_len(256);
        let lines = nodes.map(|node| {
            let kind = self.drawn_kind(node, wanted)?;
            let (piece, _) = self.piece_after(graph, node)?;
            let span = Span {
                from: 0.0,
                to: 1.0,
                occluders: u32::from(self.is_behind_fan(node, &piece)),
            };
            Some(self.line_of(node, kind, piece, vec![span]))
        });
        Ok(lines.collect())
    }

    /// Whether a face at one of its corners hides the middle of a contour's piece.
    fn is_behind_fan(&self, node: &CurveNode, piece: &Piece) -> bool {
        if node.flags & KindSet::CONTOUR == 0 || !node.is_along_edge() {
            return false;
        }
        let middle = piece.world_at(self.projector, 0.5);
        let sight = Sight {
            eye: self.projector.sight_start(middle).to_array(),
            point: middle.to_array(),
            touch: 0.0,
        };
        let sides = self.shape.sides(node.edge);
        let is_own = |face: u32| sides.iter().any(|side| side / 3 == face);
        let mut fans = sides.iter().flat_map(|side| fan(self.shape, *side));
        fans.any(|face| !is_own(face) && hides_alone(self.shape, face, &sight))
    }
}

/// The faces around the head of a half-edge, from the next one on, up to a boundary.
fn fan(shape: &HalfEdgeMesh, half_edge: u32) -> impl Iterator<Item = u32> {
    let turned = move |side: u32| {
        let twin = shape.twins[HalfEdgeMesh::following(side) as usize];
        (twin != NONE && twin != half_edge).then_some(twin)
    };
    let sides = std::iter::successors(turned(half_edge), move |side| turned(*side));
    sides.take(LARGEST_FAN).map(|side| side / 3)
}
