//! Lines that follow motion: strokes are drawn out towards where their surface was, and are wider or thinner where it
//! is fast.

use super::model::LineModel;
use super::welded::Posables;
use crate::motion_lines::Seen;
use crate::movement::Movement;
use glam::{DVec3, Vec2, Vec3};
use npr_core::camera::Camera;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_stylesheet::Style;
use npr_vector::project::Projector;
use npr_vector::stroke::{Kind, Stroke, StrokePoint};
use rayon::prelude::*;

/// Farthest that a point lags behind, as a share of the picture's height: what would lag farther leapt, and stays.
const FARTHEST_SHARE: f64 = 0.5;

/// Way in the picture at which widths have swelled by all that a style says, as a share of the picture's height.
const FULL_SHARE: f64 = 0.1;

/// How far along a stroke it comes to lag, as a share of the picture's height.
const EASE_SHARE: f64 = 0.02;

/// How far beside a line nothing may move on the side that it lags to, in cells.
const BESIDE_CELLS: [f64; 2] = [3.0, 8.0];

impl LineModel {
    /// Lets strokes swell with their speed and lag behind what moves, as far as a style says so, in a picture of `size`
    /// pixels.
    pub(super) fn smear(
        &self,
        strokes: &mut [Stroke],
        (movement, projector): (&Movement, &Projector),
        (camera, style, size): (&Camera, &Style, [u32; 2]),
    ) {
        let of_shape = (&self.shape, &self.posables);
        let Some(smear) = Smear::new(of_shape, movement, style, size[1]) else {
            return;
        };
        if style.motion.swell != 0.0 {
            smear.swell(strokes, projector, style.motion.swell.into());
        }
        if style.motion.smear <= 0.0 {
            return;
        }
        let is_moving = movement.is_moving();
        let view = camera.view(size, movement.bounds());
        let seen = Seen::new((movement, &is_moving), style, &view, size);
        smear.apply(strokes, projector, &seen);
    }
}

/// How strokes of a shape lag behind.
struct Smear<'a> {
    shape: &'a HalfEdgeMesh,
    /// From every vertex to where it was one shutter before, in the world.
    back: Vec<Vec3>,
    /// How many of these ways lines lag behind.
    ways: f64,
    /// Normals of the vertices, of any length.
    normals: Vec<Vec3>,
    /// Height of the picture.
    height_px: f64,
}

impl<'a> Smear<'a> {
    /// That of a shape in a style and a picture so many pixels high; none where nothing lags behind, or the movement is
    /// that of another shape. O(vertices + faces).
    pub fn new(
        (shape, posables): (&'a HalfEdgeMesh, &Posables),
        movement: &Movement,
        style: &Style,
        height_px: u32,
    ) -> Option<Self> {
        // Find where the vertices were; those of cards stay.
        let motion = &style.motion;
        let before = movement.places_before(motion.shutter);
        let count: usize = posables.vertex_counts.iter().sum();
        if (motion.smear <= 0.0 && motion.swell == 0.0) || before.len() != count {
            return None;
        }
        let mut back = vec![Vec3::ZERO; shape.positions.len()];
        let mut first = 0;
        for (mesh, count) in posables.meshes.iter().zip(&posables.vertex_counts) {
            for (vertex, stored) in mesh.vertices() {
                let stored = first + stored as usize;
                let [from, to] = [movement.now()[stored], before[stored]].map(Vec3::from);
                back[vertex] = to - from;
            }
            first += count;
        }

        // See where the surface is turned.
        let mut normals = vec![Vec3::ZERO; shape.positions.len()];
        for corners in &shape.faces {
            let [a, b, c] = corners.map(|v| Vec3::from(shape.positions[v as usize]));
            let across = (b - a).cross(c - a);
            for corner in corners {
                normals[*corner as usize] += across;
            }
        }
        Some(Self {
            shape,
            back,
            ways: motion.smear.into(),
            normals,
            height_px: f64::from(height_px),
        })
    }

    /// Lets contours and boundaries lag behind in a picture, where what moves ends on the side that it came from:
    /// wholly where the surface is turned that way, less the more it is turned aside, and not at all where it leads.
    /// Lines within what moves stay, and so do those that would lag into it. What strokes lie on, their depths and
    /// places in the world stay. O(points), parallel.
    pub fn apply(&self, strokes: &mut [Stroke], projector: &Projector, seen: &Seen<'_>) {
        let ends = |kind: Kind| matches!(kind, Kind::Contour | Kind::Boundary);
        let lagging = strokes.par_iter_mut().filter(|stroke| ends(stroke.kind));
        lagging.for_each(|stroke| {
            let lags: Vec<[f64; 2]> = stroke
                .points
                .iter()
                .map(|point| self.lag(point, projector).unwrap_or_default())
                .collect();
            let is_free = stroke.points.iter().zip(&lags);
            let is_free: Vec<f64> = is_free
                .map(|(point, lag)| f64::from(u8::from(leaves_free(point, *lag, seen))))
                .collect();
            let shares = smoothed(stroke, &is_free, EASE_SHARE * self.height_px);
            for ((point, lag), share) in stroke.points.iter_mut().zip(lags).zip(shares) {
                for (at, lag) in point.position.iter_mut().zip(lag) {
                    *at += lag * share;
                }
            }
        });
    }

    /// Scales the widths of points by how far they came in the picture: all of `swell` from [`FULL_SHARE`] on.
    /// O(points), parallel.
    pub fn swell(&self, strokes: &mut [Stroke], projector: &Projector, swell: f64) {
        strokes.par_iter_mut().for_each(|stroke| {
            for point in &mut stroke.points {
                let way_px = self.way(point, projector).unwrap_or(0.0);
                let share = (way_px / (FULL_SHARE * self.height_px)).min(1.0);
                point.width *= (1.0 + swell * share).max(0.0);
            }
        });
    }

    /// How far a point came in the picture within one shutter, in pixels.
    fn way(&self, point: &StrokePoint, projector: &Projector) -> Option<f64> {
        if point.location.is_nowhere() {
            return None;
        }
        let world = Vec3::from(point.world).as_dvec3();
        let before = world + self.mean(&self.back, point);
        if projector.depth(before) <= projector.near() {
            return None;
        }
        let [from, to] = [world, before].map(|world| projector.project(world));
        let way = (to[0] - from[0]).hypot(to[1] - from[1]);
        way.is_finite().then_some(way)
    }

    /// What vertices have, at the place of a point on its surface.
    fn mean(&self, of: &[Vec3], point: &StrokePoint) -> DVec3 {
        let world = Vec3::from(point.world).as_dvec3();
        let (vertices, shares) = point.location.place(self.shape, world);
        let sum = vertices.iter().zip(shares);
        sum.fold(DVec3::ZERO, |sum, (v, share)| {
            sum + of[*v as usize].as_dvec3() * share
        })
    }

    /// How far a point may lag behind in the picture, in pixels, whatever is there.
    fn lag(&self, point: &StrokePoint, projector: &Projector) -> Option<[f64; 2]> {
        // Find the way back of its place on the surface, and how much of it counts.
        if point.location.is_nowhere() {
            return None;
        }
        let world = Vec3::from(point.world).as_dvec3();
        let back = self.mean(&self.back, point) * self.ways;
        let turned = self
            .mean(&self.normals, point)
            .try_normalize()?
            .dot(back.try_normalize()?);
        let share = 0.5 * (1.0 + turned);

        // Follow it in the picture.
        let behind = world + back * share * share;
        if projector.depth(behind) <= projector.near() {
            return None;
        }
        let [from, to] = [world, behind].map(|world| projector.project(world));
        let lag = [0, 1].map(|i| to[i] - from[i]);
        let farthest = FARTHEST_SHARE * self.height_px;
        let is_leap = lag.iter().any(|v| !v.is_finite() || v.abs() > farthest);
        (!is_leap).then_some(lag)
    }
}

/// Whether nothing that moves is beside a point on the side that it lags to, nor where it would come to.
fn leaves_free(point: &StrokePoint, [dx, dy]: [f64; 2], seen: &Seen<'_>) -> bool {
    let length = (dx * dx + dy * dy).sqrt();
    let cell = f64::from(seen.step_px());
    let [x, y] = point.position;
    let is_free = |far: f64| {
        let place = [x + dx / length * far, y + dy / length * far];
        let cell = seen.cell(Vec2::from(place.map(|v| v as f32)));
        cell.is_some_and(|cell| !seen.is_mover(cell))
    };
    let beside = BESIDE_CELLS.map(|cells| cells * cell);
    length > 0.0 && beside.into_iter().chain([length]).all(is_free)
}

/// Numbers of the points of a stroke, each the mean of those up to `reach_px` before and behind it.
fn smoothed(stroke: &Stroke, values: &[f64], reach_px: f64) -> Vec<f64> {
    // Go round a closed stroke three times, and take the second.
    let count = values.len();
    let laps = if stroke.closed { 3 } else { 1 };
    let places = || (0..laps * count).map(|i| stroke.points[i % count].position);
    let mut along = vec![0.0];
    let steps = places().zip(places().skip(1));
    for ([x, y], [next_x, next_y]) in steps {
        along.push(along[along.len() - 1] + (next_x - x).hypot(next_y - y));
    }

    // Slide a window along it.
    let (mut first, mut last, mut sum) = (0, 0, 0.0);
    let mut means = Vec::with_capacity(along.len());
    for at in &along {
        while last < along.len() && along[last] <= at + reach_px {
            sum += values[last % count];
            last += 1;
        }
        while along[first] < at - reach_px {
            sum -= values[first % count];
            first += 1;
        }
        means.push(sum / (last - first) as f64);
    }
    means[laps / 2 * count..][..count].to_vec()
}
