//! Smooth directions on a surface along which hatch strokes may run.
//!
//! A stroke has no head and no tail, so the direction at a point is a line in the tangent plane: an angle that
//! means the same after half a turn [Knöppel et al. 2013]. Curvature says where lines should run on limbs and folds
//! and nothing on flats and balls; averaging fills those from around.

pub(crate) mod complex;
pub(crate) mod hierarchy;
pub(crate) mod nodes;

use std::collections::BTreeMap;

use glam::Vec3;
use npr_core::geometry::Triangle;
use rayon::prelude::*;

use crate::curvature::{Curvature, curvature};
use crate::smoothing::vertex_areas;
use complex::Complex;
use hierarchy::{Level, View};
use nodes::Nodes;

/// What strokes on a part follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Guide {
    /// The shape.
    Curvature {
        /// Whether strokes run the way in which the surface bends most, so that they wrap round limbs; else they run
        /// along limbs.
        across: bool,
    },
    /// A direction in the space of the positions, laid on the surface; its length and sign mean nothing.
    Along([f32; 3]),
    /// The directions at the vertices, laid on the surface; lengths and signs mean nothing, and one of no length says
    /// nothing.
    Painted,
    /// The directions at the vertices where they say any, and elsewhere the shape, across limbs.
    PaintedOrAcross,
}

/// How the strokes of one part run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartGuide {
    /// What they follow.
    pub guide: Guide,
    /// Angle in radians by which they turn away from it, counter-clockwise seen from the front.
    pub angle: f32,
}

impl Default for PartGuide {
    /// Strokes that wrap round limbs.
    fn default() -> Self {
        Self {
            guide: Guide::Curvature { across: true },
            angle: 0.0,
        }
    }
}

/// Weight of the directions that flats take where nothing else says any, against 1 for a guide.
///
/// So small that it decides only what would be left to chance.
const IDLE: f32 = 1e-4;

/// Weight of painted directions, against 1 for a guide: they are meant as they are, and even out over a third of the
/// distance.
const PAINTED: f32 = 8.0;

/// How strongly each axis of space attracts idle directions: upright ones first, where there is a choice.
const IDLE_AXES: [f32; 3] = [0.5, 1.0, 0.25];

/// One unit tangent per node along which strokes run; its sign means nothing.
///
/// Positions count in units of `reach`: guided places smooth each other out over about that distance.
/// O(rounds * nodes).
pub(crate) fn directions(
    nodes: &Nodes,
    guide_of_part: impl Fn(u32) -> PartGuide + Sync,
    painted: &Painted<'_>,
    reach: f32,
    rounds: u32,
) -> Vec<Vec3> {
    let frames: Vec<Frame> = nodes.normals.par_iter().map(|&n| Frame::new(n)).collect();
    let painted = painted.lines(nodes, &frames);
    let pulls = pulls(nodes, &frames, guide_of_part, &painted, reach);
    let lines = Level::new(nodes, pulls, |node, other| {
        frames[node].view(&frames[other])
    });
    let lines = lines.solve(rounds);
    let direction = |(frame, &[line]): (&Frame, &[Complex; 1])| frame.along(line);
    frames.par_iter().zip(&lines).map(direction).collect()
}

/// Directions at the vertices of a surface.
pub(crate) struct Painted<'a> {
    /// The triangles that nodes are made from.
    pub(crate) triangles: &'a [Triangle],
    /// One for every vertex; empty where there are none.
    pub(crate) directions: &'a [[f32; 3]],
}

impl Painted<'_> {
    /// The mean at every node of what the vertices of its corners say, as lines: opposite directions agree.
    fn lines(&self, nodes: &Nodes, frames: &[Frame]) -> Vec<Complex> {
        if self.directions.is_empty() {
            return Vec::new();
        }
        let mut sums = vec![(Complex::default(), 0.0f32); nodes.count()];
        for (&face, corners) in nodes.faces.iter().zip(&nodes.corners) {
            let vertices = self.triangles[face as usize].corners;
            for (&node, vertex) in corners.iter().zip(vertices) {
                let (sum, count) = &mut sums[node as usize];
                *sum = sum.plus(laid(
                    &frames[node as usize],
                    self.directions[vertex as usize],
                ));
                *count += 1.0;
            }
        }
        sums.into_iter()
            .map(|(sum, count)| sum.scaled(PAINTED / count.max(1.0)))
            .collect()
    }
}

/// Two tangents and the normal of a node.
struct Frame {
    u: Vec3,
    v: Vec3,
    normal: Vec3,
}

impl Frame {
    fn new(normal: Vec3) -> Self {
        let (u, v) = normal.any_orthonormal_pair();
        Self { u, v, normal }
    }

    /// A tangent as a complex number in which opposite ones agree: angles doubled, and so is the length squared.
    fn line(&self, tangent: Vec3) -> Complex {
        let in_plane = Complex {
            re: tangent.dot(self.u),
            im: tangent.dot(self.v),
        };
        in_plane.times(in_plane)
    }

    /// The unit tangent of a line of length 1.
    fn along(&self, line: Complex) -> Vec3 {
        let Complex { re, im } = line.half_angle();
        self.u * re + self.v * im
    }

    /// How lines of a node with frame `other` look from here.
    fn view(&self, other: &Self) -> View<1> {
        let turned = turned(other.u, other.normal, self.normal);
        View {
            flips: false,
            turns: [self.line(turned).unit().unwrap_or(Complex::ONE)],
        }
    }
}

/// A tangent after the shortest turn that takes the unit vector `from` to the unit vector `to`.
pub(crate) fn turned(tangent: Vec3, from: Vec3, to: Vec3) -> Vec3 {
    let scale = 1.0 + from.dot(to);
    // Opposite normals have no shortest turn; the tangent already lies in the right plane.
    if scale > 1e-4 {
        tangent - (from + to) * (to.dot(tangent) / scale)
    } else {
        tangent
    }
}

/// What each node's guide says; the length is its weight against neighbours.
///
/// Minimises the squared change of the field plus its squared distance from the guide over `reach` squared:
/// links of weight 1 count every change about sqrt(3) times on a regular mesh.
fn pulls(
    nodes: &Nodes,
    frames: &[Frame],
    guide_of_part: impl Fn(u32) -> PartGuide + Sync,
    painted: &[Complex],
    reach: f32,
) -> Vec<[Complex; 1]> {
    // Measure bends, and their mean over every part.
    let weld = nodes.apart();
    let normals: Vec<[f32; 3]> = nodes.normals.iter().map(Vec3::to_array).collect();
    let bends = curvature(&nodes.positions, &nodes.corners, &weld, &normals);
    let areas = vertex_areas(&nodes.positions, &nodes.corners, &weld);
    let mean_bends = mean_bends(nodes, &bends, &areas);

    // Ask the part's guide for a direction at every node.
    let said_at = |node: usize| painted.get(node).copied().unwrap_or_default();
    let bent_at = |node: usize, across: bool| {
        let mean = mean_bends.get(&nodes.parts[node]);
        let mean = mean.copied().unwrap_or_default();
        bent(&frames[node], &bends[node], mean, across)
    };
    let pull = |node: usize| {
        let (frame, part) = (&frames[node], nodes.parts[node]);
        let PartGuide { guide, angle } = guide_of_part(part);
        let said = match guide {
            Guide::Along(direction) => laid(frame, direction),
            Guide::Painted => said_at(node),
            Guide::PaintedOrAcross if said_at(node) != Complex::default() => said_at(node),
            Guide::PaintedOrAcross => bent_at(node, true),
            Guide::Curvature { across } => bent_at(node, across),
        };

        // Weigh it by the area around the node, and turn it by the part's angle.
        let weight = (1.732 * areas[node] / (reach * reach)).clamp(1e-6, 100.0);
        let turn = Complex::of_turns(angle / std::f32::consts::PI);
        [said.plus(idle(frame)).times(turn).scaled(weight)]
    };
    (0..nodes.count()).into_par_iter().map(pull).collect()
}

/// The line that a direction in space draws on the surface, shorter the steeper it meets it.
fn laid(frame: &Frame, direction: [f32; 3]) -> Complex {
    let direction = Vec3::from_array(direction).try_normalize();
    frame.line(direction.unwrap_or_default())
}

/// A principal direction, as long as it is sure: 0 on balls, saddles and flats, up to 1 on limbs.
///
/// `mean` is the curvature that is usual on the part.
fn bent(frame: &Frame, bend: &Curvature, mean: f64, across: bool) -> Complex {
    let [max, min] = [bend.max, bend.min].map(|k| f64::from(k).abs());
    let excess = (max - min).abs();
    let sure = excess / (excess + mean);
    let weight = if sure.is_finite() {
        4.0 * sure * sure
    } else {
        0.0
    };
    let along_max = (max >= min) == across;
    let line = frame
        .line(Vec3::from_array(bend.direction))
        .scaled(weight as f32);
    // A quarter turn of the tangent is half a turn of the line.
    if along_max { line } else { line.scaled(-1.0) }
}

/// A line that hardly weighs and depends on the normal alone.
fn idle(frame: &Frame) -> Complex {
    let axes = IDLE_AXES.iter().zip(Vec3::AXES);
    let sum = axes.fold(Complex::default(), |sum, (&weight, axis)| {
        sum.plus(frame.line(axis).scaled(weight))
    });
    sum.scaled(IDLE)
}

/// The mean over each part's area of both curvatures' sizes.
fn mean_bends(nodes: &Nodes, bends: &[Curvature], areas: &[f32]) -> BTreeMap<u32, f64> {
    let mut sums: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    for ((part, bend), &area) in nodes.parts.iter().zip(bends).zip(areas) {
        let size = f64::from(bend.max).abs() + f64::from(bend.min).abs();
        let sum = sums.entry(*part).or_default();
        sum[0] += f64::from(area) * size;
        sum[1] += f64::from(area);
    }
    let mean = |[sum, area]: [f64; 2]| if area > 0.0 { sum / area } else { 0.0 };
    sums.into_iter()
        .map(|(part, sum)| (part, mean(sum)))
        .collect()
}
