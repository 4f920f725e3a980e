//! Agreement of smooth contours with the outline of the polygons.
//!
//! Fills, shadows and hidden-line removal all see polygons, whose outline interpolated contours leave by up to an
//! edge's length. Two things bring them together, both judged in the picture:
//!
//! - Where front by interpolated normals and front by planes differ, faces form patches, bounded by a smooth and a
//!   polygonal line. A patch whose visible polygonal line is not within tolerance of a smooth one is made flat
//!   ([`PolygonOutline::flat_faces`]): there the line changes to mesh edges, at the very points where both cross.
//! - A smooth line lies as often on a face turned away as on one turned to the eye, so sights to it tell nothing.
//!   What is seen of it is taken from the polygon's contour beside it ([`PolygonOutline::spans`]), which sights
//!   decide exactly.

use super::normals::CornerNormals;
use super::patches::Patches;
use super::segment_grid::{Nearest, SegmentGrid};
use super::signs::{Crossing, FlatFaces, Signs};
use super::{runs_along_edge, zero_set};
use crate::mesh_lines::graph::{CurveGraph, CurveNode};
use crate::mesh_lines::visibility::{Piece, Span};
use crate::project::Projector;
use glam::DVec3;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;

/// Distance of samples along lines, in pixels.
const STEP_PX: f64 = 1.5;

/// Gaps in what is seen of a line up to this length are closed, and lone specks up to it dropped, in pixels.
const SETTLE_PX: f64 = 4.0;

/// Factor on the distance in the world between a line and the nearest contour beside it, up to which other contours
/// count too.
const NEARLY_NEAREST: f64 = 2.0;

/// Lines farther apart in the world than this many sides of the faces they lie on, or pixels, are different lines of
/// the surface that only happen to meet in the picture.
const REACH_SIDES: f64 = 4.0;

/// See [`REACH_SIDES`]; depth changes fast where the surface turns away, so there are many pixels to a step.
const REACH_PIXELS: f64 = 32.0;

/// A part of a contour of the polygons that is hidden by the same surfaces all along.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenContour {
    /// Its mesh edge.
    pub edge: u32,
    /// The face beside it that is turned to the eye.
    pub face: u32,
    /// Ends in the picture, in pixels.
    pub places: [[f64; 2]; 2],
    /// Ends in the world.
    pub world: [DVec3; 2],
    /// Number of surfaces in front.
    pub occluders: u32,
}

impl SeenContour {
    /// The parts of the piece that starts at a node of [`crate::mesh_lines::contour::contours`].
    pub fn of_piece(
        projector: &Projector,
        node: &CurveNode,
        piece: &Piece,
        spans: &[Span],
    ) -> impl Iterator<Item = Self> {
        spans.iter().map(move |span| Self {
            edge: node.edge,
            face: node.face,
            places: [span.from, span.to].map(|share| piece.place_at(share)),
            world: [span.from, span.to].map(|share| piece.world_at(projector, share)),
            occluders: span.occluders,
        })
    }

    fn length(&self) -> f64 {
        let [a, b] = self.places;
        ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
    }

    fn world_at(&self, projector: &Projector, share: f64) -> DVec3 {
        let depths = self.world.map(|p| projector.depth(p));
        self.world[0].lerp(self.world[1], projector.world_share(share, depths))
    }
}

/// The contours of the polygons in one view, and what is needed to compare smooth contours with them.
#[derive(Debug)]
pub struct PolygonOutline<'a> {
    shape: &'a HalfEdgeMesh,
    normals: &'a CornerNormals,
    projector: &'a Projector,
    size: [u32; 2],
    front: &'a [u8],
    contours: &'a [SeenContour],
    /// Edge, face and number of every contour, ascending.
    by_edge: Vec<[u32; 3]>,
    grid: SegmentGrid,
    tolerance_px: f64,
}

impl<'a> PolygonOutline<'a> {
    /// Sorts the contours into a grid over the picture of `size` pixels.
    ///
    /// `front` is from [`crate::mesh_lines::contour::facing`]; `contours` lists the parts of convex contours, in any
    /// order. `tolerance_px` is how far a smooth line may lie from the polygon's: 1 follows the polygons closely, 2.5
    /// is as smooth as the outline's judges allow.
    pub fn new(
        (shape, normals): (&'a HalfEdgeMesh, &'a CornerNormals),
        (projector, size): (&'a Projector, [u32; 2]),
        front: &'a [u8],
        contours: &'a [SeenContour],
        tolerance_px: f64,
    ) -> Self {
        let segments = contours.iter().map(|contour| contour.places).collect();
        let keyed =
            |(number, contour): (usize, &SeenContour)| [contour.edge, contour.face, number as u32];
        let mut by_edge: Vec<[u32; 3]> = contours.iter().enumerate().map(keyed).collect();
        by_edge.par_sort_unstable();
        Self {
            shape,
            normals,
            projector,
            size,
            front,
            contours,
            by_edge,
            grid: SegmentGrid::new(segments, 8.0),
            tolerance_px,
        }
    }

    /// The faces that must be flat for [`zero_set`] to pass within tolerance of all visible contours.
    ///
    /// Starts from the smooth contours and makes patches flat until nothing is missed, except for less than two
    /// pixels a patch. As patches are never made smooth again, this ends, at the latest with the contours of the
    /// polygons. O(faces + contours) a round; two or three rounds are usual.
    pub fn flat_faces(&self) -> FlatFaces {
        let eye = self.projector.eye();
        let none = FlatFaces::NONE;
        let smooth = Signs::new(self.shape, self.normals, &none, eye);
        let mut patches = Patches::new(&smooth, self.front);
        let mut flat = FlatFaces::NONE;
        loop {
            let graph = zero_set(self.shape, self.normals, eye, &flat);
            let missed = self.missed(&smooth, &graph);
            if !patches.choose(&missed) {
                return flat;
            }
            flat = FlatFaces::new(self.front, |face| patches.is_chosen(face));
        }
    }

    /// The spans of every piece of a graph from [`zero_set`], in shares of the piece's image; empty for pieces outside
    /// the picture.
    ///
    /// Pieces along an edge that is a contour of the polygons take over its spans. Samples of others take the least
    /// number of occluders of the contours beside them within tolerance that are nearest in the world; where there is
    /// none, the smooth contour is none of the polygons and counts as hidden once. Gaps and specks of up to four pixels
    /// are settled along the line, except on edges, where sights have decided: hidden parts of a fringe would lie
    /// double beside the line that hides them.
    pub fn spans(&self, graph: &CurveGraph, pieces: &[Option<Piece>]) -> Vec<Vec<Span>> {
        let mut sampled: Vec<Sampled> = (0..graph.nodes.len())
            .into_par_iter()
            .with_min_len(64)
            .map(|node| match &pieces[node] {
                Some(piece) => self.sampled(graph, node as u32, piece),
                None => Sampled::default(),
            })
            .collect();
        for chain in graph.chains() {
            settle_chain(&chain, &mut sampled);
        }
        sampled
            .iter()
            .map(|piece| spans_of(&piece.occluders))
            .collect()
    }

    fn sampled(&self, graph: &CurveGraph, node: u32, piece: &Piece) -> Sampled {
        // Find the contours of the same edge and face, where the piece runs along the edge.
        let CurveNode { edge, face, .. } = graph.nodes[node as usize];
        let first = self
            .by_edge
            .partition_point(|key| [key[0], key[1]] < [edge, face]);
        let count = self.by_edge[first..]
            .iter()
            .take_while(|key| key[..2] == [edge, face])
            .count();
        let own = match runs_along_edge(graph, node) {
            true => &self.by_edge[first..first + count],
            false => &[],
        };

        // Ask them, or else the contours beside the piece, what hides it at each sample.
        let samples = sample_count(piece.length());
        let sample = |i: usize| {
            let share = (i as f64 + 0.5) / samples as f64;
            let world = piece.world_at(self.projector, share);
            match own {
                [] => self.occluders_beside(face, piece.place_at(share), world),
                own => self.occluders_on(own, world),
            }
        };
        Sampled {
            step_px: piece.length() / samples as f64,
            is_known: !own.is_empty(),
            occluders: (0..samples).map(sample).collect(),
        }
    }

    /// Number of occluders of the nearest of some parts of one edge.
    fn occluders_on(&self, own: &[[u32; 3]], world: DVec3) -> u32 {
        let parts = own.iter().map(|key| &self.contours[key[2] as usize]);
        let distance = |contour: &SeenContour| {
            let [a, b] = contour.world;
            world.distance(a) + world.distance(b) - a.distance(b)
        };
        parts
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .map_or(1, |contour| contour.occluders)
    }

    /// Least occluders of the contours beside a place that belong to the same line of the surface.
    fn occluders_beside(&self, face: u32, place: [f64; 2], world: DVec3) -> u32 {
        let mut found: Vec<(f64, u32)> = Vec::new();
        let mut ends: Vec<(f64, u32)> = Vec::new();
        self.grid.visit_near(place, self.tolerance_px, |near| {
            let contour = &self.contours[near.segment as usize];
            let other = contour.world_at(self.projector, near.share);
            if self.belong([face, contour.face], [world, other]) {
                let is_beside = near.share > 0.0 && near.share < 1.0;
                let list = if is_beside { &mut found } else { &mut ends };
                list.push((world.distance(other), contour.occluders));
            }
        });
        // A contour that has ended before the place tells nothing about it, unless the line turns here and all have.
        if found.is_empty() {
            found = ends;
        }
        let nearest = found
            .iter()
            .fold(f64::MAX, |least, (distance, _)| least.min(*distance));
        let pixel = 1.0 / self.projector.pixels_per_unit(self.projector.depth(world));
        let counted = |(distance, _): &&(f64, u32)| *distance <= NEARLY_NEAREST * nearest + pixel;
        let occluders = found
            .iter()
            .filter(counted)
            .map(|(_, occluders)| *occluders);
        occluders.min().unwrap_or(1)
    }

    /// Whether points on two faces may belong to one line of the surface.
    fn belong(&self, faces: [u32; 2], points: [DVec3; 2]) -> bool {
        let sides: f64 = faces.map(|face| self.longest_side(face)).into_iter().sum();
        let depth = self.projector.depth(points[0]);
        let pixel = 1.0 / self.projector.pixels_per_unit(depth);
        points[0].distance(points[1]) <= REACH_SIDES * sides + REACH_PIXELS * pixel
    }

    fn longest_side(&self, face: u32) -> f64 {
        let corners = self.shape.faces[face as usize].map(|v| self.shape.point(v));
        (0..3)
            .map(|i| corners[i].distance(corners[(i + 1) % 3]))
            .fold(0.0, f64::max)
    }

    /// Faces whose patches hide a visible contour from the lines of a graph, each with the missed length in pixels.
    fn missed(&self, smooth: &Signs<'_>, graph: &CurveGraph) -> Vec<(u32, f64)> {
        let drawn = self.drawn(graph);
        let grid = SegmentGrid::new(drawn.iter().map(|(_, piece)| piece.place).collect(), 8.0);
        let missed_of = |contour: &SeenContour| {
            let count = sample_count(contour.length());
            let step_px = contour.length() / count as f64;
            (0..count)
                .map(|i| (i as f64 + 0.5) / count as f64)
                .filter(|share| !self.covers(&grid, &drawn, contour, *share))
                .flat_map(|share| self.patch_faces(smooth, contour, share))
                .filter_map(|face| face.map(|face| (face, step_px)))
                .collect::<Vec<_>>()
        };
        self.contours
            .par_iter()
            .with_min_len(64)
            .filter(|contour| contour.occluders == 0)
            .flat_map_iter(missed_of)
            .collect()
    }

    /// The pieces that may be seen, each with its face.
    fn drawn(&self, graph: &CurveGraph) -> Vec<(u32, Piece)> {
        (0..graph.nodes.len() as u32)
            .into_par_iter()
            .with_min_len(64)
            .filter_map(|index| {
                let node = &graph.nodes[index as usize];
                if node.next == NONE || EdgeFlags::CONCAVE.is_in(node.flags) {
                    return None;
                }
                let [a, b] = [index, node.next].map(|n| DVec3::from(graph.position(self.shape, n)));
                Some((node.face, Piece::new(self.projector, self.size, a, b)?))
            })
            .collect()
    }

    fn covers(
        &self,
        grid: &SegmentGrid,
        drawn: &[(u32, Piece)],
        contour: &SeenContour,
        share: f64,
    ) -> bool {
        let place = [0, 1]
            .map(|i| contour.places[0][i] + (contour.places[1][i] - contour.places[0][i]) * share);
        let world = contour.world_at(self.projector, share);
        let near: Option<Nearest> = grid.nearest(place, self.tolerance_px, |segment, at| {
            let (face, piece) = &drawn[segment as usize];
            let other = piece.world_at(self.projector, at);
            self.belong([*face, contour.face], [world, other])
        });
        near.is_some()
    }

    /// The faces beside a contour that are front by interpolated normals and back by their planes, or the reverse.
    fn patch_faces(
        &self,
        smooth: &Signs<'_>,
        contour: &SeenContour,
        share: f64,
    ) -> [Option<u32>; 2] {
        let [low, high] = self.shape.ends(contour.edge).map(|v| self.shape.point(v));
        let along = (contour.world_at(self.projector, share) - low).dot(high - low);
        let t = (along / (high - low).length_squared()) as f32;
        let own = (0..3)
            .map(|i| 3 * contour.face + i)
            .find(|side| self.shape.edge_of[*side as usize] == contour.edge);
        let twin = own.map_or(NONE, |side| self.shape.twins[side as usize]);
        [own, Some(twin)].map(|side| {
            let side = side.filter(|side| *side != NONE)?;
            let at = Crossing { t, half_edge: NONE };
            let differs = smooth.front_at(side, at) != (self.front[side as usize / 3] != 0);
            differs.then_some(side / 3)
        })
    }
}

fn sample_count(length_px: f64) -> usize {
    ((length_px / STEP_PX).ceil() as usize).clamp(1, 1 << 14)
}

/// The occluders of a piece, at equal distances along it.
#[derive(Debug, Clone, Default, PartialEq)]
struct Sampled {
    step_px: f64,
    /// Whether sights have decided them, rather than the contours beside the piece.
    is_known: bool,
    occluders: Vec<u32>,
}

/// Closes gaps and drops specks along a chain of sampled pieces; what sights decided stays.
fn settle_chain(chain: &[u32], sampled: &mut [Sampled]) {
    let (mut hidden, mut lengths) = (Vec::new(), Vec::new());
    for node in chain {
        let piece = &sampled[*node as usize];
        hidden.extend(piece.occluders.iter().map(|count| *count > 0));
        lengths.extend(piece.occluders.iter().map(|_| piece.step_px));
    }
    settle_runs(&mut hidden, &lengths, SETTLE_PX);
    let mut settled = hidden.into_iter();
    for node in chain {
        let piece = &mut sampled[*node as usize];
        for count in &mut piece.occluders {
            let is_hidden = settled.next().unwrap_or(false);
            if !piece.is_known {
                *count = if is_hidden { (*count).max(1) } else { 0 };
            }
        }
    }
}

fn spans_of(counts: &[u32]) -> Vec<Span> {
    let mut from = 0;
    let share = |sample: usize| sample as f64 / counts.len() as f64;
    counts
        .chunk_by(|a, b| a == b)
        .map(|run| {
            from += run.len();
            Span {
                from: share(from - run.len()),
                to: share(from),
                occluders: run[0],
            }
        })
        .collect()
}

/// Closes hidden gaps in a line shorter than `least`, then hides visible specks shorter than that between hidden parts.
///
/// `hidden` and `lengths` hold one entry per sample of one line; its ends stay as they are. O(samples).
pub(super) fn settle_runs(hidden: &mut [bool], lengths: &[f64], least: f64) {
    for turns in [true, false] {
        let mut from = 0;
        while from < hidden.len() {
            let same = hidden[from..]
                .iter()
                .take_while(|h| **h == hidden[from])
                .count();
            let to = from + same;
            let length: f64 = lengths[from..to].iter().sum();
            let inner = from > 0 && to < hidden.len();
            if inner && hidden[from] == turns && length < least {
                hidden[from..to].fill(!turns);
            }
            from = to;
        }
    }
}

#[cfg(test)]
mod tests;
