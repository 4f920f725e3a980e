//! The drawn outline of smoke: free arcs of silhouettes, what surfaces leave of them, and their strokes.

use super::Puffs;
use super::cover::{Arc, Cover};
use super::silhouette::Silhouette;
use super::sphere::Puff;
use crate::mesh_lines::draw::{PointPaint, calmed, strokes_of};
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use crate::mesh_lines::line::Line;
use crate::mesh_lines::line_settings::LineSettings;
use crate::mesh_lines::run::{Run, RunPoint, distance};
use crate::mesh_lines::run_assembly::runs;
use crate::mesh_lines::visibility::{Circumstances, Memory, Piece, Seen};
use crate::stroke::{Kind, Stroke, StrokePoint};
use glam::DVec3;
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_core::math;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Greatest distance between a chord and its circle, in pixels.
const SAGITTA_PX: f64 = 0.02;

/// Longest chord, in pixels.
const CHORD_PX: f64 = 4.0;

/// Most chords of a circle: the largest circles in sight leave their chords by more than [`SAGITTA_PX`].
const CHORDS_MAX: f64 = 65_536.0;

/// Width under which ends of strokes are cut off, as a share of the widest place of all: they would be paler than paper
/// is rough.
const HAIR_SHARE: f64 = 0.13;

/// Length under which strokes without such ends are left out, in pixels.
const SPECK_PX: f64 = 4.0;

/// Set in ids of strokes of smoke, above all bits of those on meshes; still a whole number in every reader of JSON.
const SMOKE_ID: u64 = 1 << 50;

/// A point of a puff's silhouette, as far as the width of its line depends on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SilhouettePoint {
    /// Distance from the puff to the next smoke behind it, along the sight, in radii of the puff; infinite where there
    /// is none.
    pub jump: f64,
    /// Unit vector away from the puff in the picture, y down.
    pub outward: [f64; 2],
    /// Distance from the puff's middle in the picture, in pixels.
    pub radius_px: f64,
}

/// The smoke of a view, and how it is outlined.
#[derive(Clone, Copy)]
pub struct SmokeLines<'a> {
    /// The spheres.
    pub puffs: &'a Puffs,
    /// Whether they hide lines behind them.
    pub is_dense: bool,
    /// Whether they are outlined at all.
    pub is_outlined: bool,
    /// From which jump in depth a puff is outlined before another, in radii of the puff.
    pub jump: f64,
    /// Index of their surface among those of the drawing.
    pub surface: u32,
    /// Whole width of the line at a place of a silhouette, in pixels.
    pub width_at: &'a (dyn Fn(&SilhouettePoint) -> f64 + Sync),
}

impl std::fmt::Debug for SmokeLines<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "SmokeLines from jumps of {}", self.jump)
    }
}

impl SmokeLines<'_> {
    /// The outline as strokes of kind contour. `seen` says which surfaces hide it, and must know nothing of the smoke
    /// itself.
    ///
    /// An arc ends where another puff covers it or where what lies behind comes nearer than [`SmokeLines::jump`]:
    /// there its width is as thin as the jump says. Strokes that puffs hide are never given, not even as hidden ones:
    /// they are inside of the smoke. O(pairs of puffs whose images touch), in parallel, with the same result for any
    /// number of threads.
    pub(crate) fn strokes(&self, seen: &Seen<'_>, settings: &LineSettings) -> Vec<Stroke> {
        if !self.is_outlined || settings.kinds & KindSet::CONTOUR == 0 {
            return Vec::new();
        }
        let (graph, pieces) = self.graph(settings.size);
        let lines: Vec<Option<Line>> = pieces
            .into_par_iter()
            .with_min_len(64)
            .map_init(Memory::default, |memory, piece| {
                Some(line(seen, piece?, memory))
            })
            .collect();
        // Runs look up the object of their surface, and nothing else, on the shape.
        let smoke = HalfEdgeMesh {
            surfaces: vec![Surface::default()],
            ..HalfEdgeMesh::default()
        };
        let found = runs(
            &smoke,
            seen.projector,
            (&graph, 0),
            (&lines, settings.hidden),
        );
        let mut found = calmed(found, settings, seen.projector.lens(), None);
        for run in &mut found {
            run.id |= SMOKE_ID;
            run.surface = self.surface;
        }
        let by_number = self.puffs.by_number();
        let mut strokes = strokes_of(found, &|run: &Run, point: &RunPoint| {
            let puff = by_number.binary_search_by_key(&point.edge, |puff| puff.number);
            let puff = puff.ok().map(|index| &by_number[index]);
            let width = puff.map_or(0.0, |puff| {
                (self.width_at)(&self.puffs.silhouette_point(puff, point.world)) * run.weight
            });
            PointPaint { color: None, width }
        });
        if settings.smooth {
            let points = strokes.iter().flat_map(|stroke| &stroke.points);
            let widest = points.map(|point| point.width).fold(0.0, f64::max);
            for stroke in &mut strokes {
                trim_hairs(stroke, HAIR_SHARE * widest);
            }
            strokes.retain(|stroke| stroke.length() >= SPECK_PX);
        }
        strokes
    }

    /// The free arcs of all silhouettes as chains of chords.
    fn graph(&self, size: [u32; 2]) -> (CurveGraph, Vec<Option<Piece>>) {
        let arcs: Vec<Vec<Arc>> = (0..self.puffs.puffs.len())
            .into_par_iter()
            .map(|index| self.puffs.free_arcs(index, self.jump))
            .collect();
        let mut graph = CurveGraph::default();
        let mut pieces = Vec::new();
        for (puff, arcs) in self.puffs.puffs.iter().zip(arcs) {
            for arc in arcs {
                self.puffs
                    .add_arc(size, puff, &arc, &mut graph, &mut pieces);
            }
        }
        (graph, pieces)
    }
}

/// Cuts off the ends of an open stroke that are hardly visible; clears a stroke that is so all along.
fn trim_hairs(stroke: &mut Stroke, hair: f64) {
    let is_seen = |point: &StrokePoint| point.width >= hair;
    let Some(last) = stroke.points.iter().rposition(is_seen) else {
        stroke.points.clear();
        return;
    };
    if !stroke.closed {
        stroke.points.truncate(last + 1);
        let first = stroke.points.iter().position(is_seen).unwrap_or(0);
        stroke.points.drain(..first);
        let start = stroke.points.first().map_or(0.0, |point| point.u);
        stroke.points.iter_mut().for_each(|point| point.u -= start);
    }
}

/// The part of a chord that surfaces leave visible.
fn line(seen: &Seen<'_>, piece: Piece, memory: &mut Memory) -> Line {
    // Piercings count along the uncut chord, from which the piece was taken.
    let [from, to] = piece.range;
    let through = seen
        .tree
        .piercings_between(seen.shape, piece.world, |_| false);
    let circumstances = Circumstances {
        own_faces: Vec::new(),
        piercings: through.iter().map(|t| from + (to - from) * t).collect(),
        touch: 0.0,
    };
    Line {
        kind: Kind::Contour,
        surface: 0,
        spans: seen.spans(&piece, &circumstances, memory),
        piece,
    }
}

impl Puffs {
    fn is_perspective(&self) -> bool {
        self.projector.is_perspective()
    }

    /// The puffs in the order of their numbers.
    fn by_number(&self) -> Vec<Puff> {
        let mut puffs = self.puffs.clone();
        puffs.sort_by_key(|puff| puff.number);
        puffs
    }

    /// The arcs of a puff's silhouette with no smoke before them, and none behind up to `jump` radii.
    pub(super) fn free_arcs(&self, index: usize, jump: f64) -> Vec<Arc> {
        let own = &self.puffs[index];
        let silhouette = Silhouette::new(own, self.is_perspective());
        let room = jump * own.radius;
        let mut cover = Cover::default();
        self.grid.visit(own.bounds, |other| {
            let puff = &self.puffs[other as usize];
            if other as usize != index
                && let Some(arc) = silhouette.covered_by(puff, room)
            {
                cover.add(arc);
            }
            !cover.is_full()
        });
        cover.free()
    }

    /// Adds an arc as a chain of chords; those out of the picture have no piece.
    fn add_arc(
        &self,
        size: [u32; 2],
        puff: &Puff,
        arc: &Arc,
        graph: &mut CurveGraph,
        pieces: &mut Vec<Option<Piece>>,
    ) {
        let silhouette = Silhouette::new(puff, self.is_perspective());
        let count = self.chord_count(&silhouette, arc.to - arc.from);
        let angle = |i: usize| arc.from + (arc.to - arc.from) * i as f64 / count as f64;
        let first = graph.nodes.len() as u32;
        let node_count = if arc.is_closed { count } else { count + 1 };
        let link = |i: usize| match i % count {
            _ if i < node_count => first + i as u32,
            around if arc.is_closed => first + around as u32,
            _ => NONE,
        };
        for i in 0..node_count {
            let before = match i.checked_sub(1) {
                Some(before) => link(before),
                None if arc.is_closed => link(count - 1),
                None => NONE,
            };
            graph.nodes.push(CurveNode {
                edge: puff.number,
                // Whole numbers would stand for the ends of a mesh edge.
                t: (0.25 + 0.5 * (angle(i) / TAU).fract()) as f32,
                next: link(i + 1),
                prev: before,
                flags: KindSet::CONTOUR,
                face: NONE,
            });
            let ends = [i, i + 1].map(|i| self.projector.world_of(silhouette.at(angle(i))));
            let piece = Piece::new(&self.projector, size, ends[0], ends[1]);
            pieces.push(piece.filter(|_| i < count));
        }
    }

    /// Number of chords that an arc is cut into.
    fn chord_count(&self, silhouette: &Silhouette, turn: f64) -> usize {
        let radius_px = silhouette.radius() * self.projector.pixels_per_unit(silhouette.front());
        let bent = 2.0 * math::acos_f64((1.0 - SAGITTA_PX / radius_px).clamp(0.5, 1.0));
        let step = bent.min(CHORD_PX / radius_px);
        ((turn / step).min(CHORDS_MAX * turn / TAU).ceil()).max(3.0) as usize
    }

    /// The point of a puff's silhouette nearest to a point of the world.
    fn silhouette_point(&self, puff: &Puff, world: DVec3) -> SilhouettePoint {
        let silhouette = Silhouette::new(puff, self.is_perspective());
        let point = silhouette.nearest(self.projector.from_eye(world));
        let place = self.projector.project_from_eye(point);
        let middle = self.projector.project_from_eye(puff.center);
        let away = distance(middle, place).max(1e-300);
        let behind = self.around(place).filter_map(|other| {
            let entry = other.entry(self.is_perspective(), point)?;
            (other.number != puff.number && entry > 0.0).then_some(entry / puff.radius)
        });
        SilhouettePoint {
            jump: behind.fold(f64::INFINITY, f64::min),
            outward: [0, 1].map(|i| (place[i] - middle[i]) / away),
            radius_px: away,
        }
    }
}
