//! Smoke as lines see it: spheres, what they hide, and the outline that they are drawn with.
//!
//! The outline of a sphere is a circle in space, and another sphere covers one arc of it, known in closed form. What no
//! sphere covers is what a pen draws: there lies nothing behind the silhouette, or smoke far enough behind it [Hoshino
//! 2004, 3.5]. Nothing is sampled, so arcs end exactly where images of spheres cross.

mod cover;
mod grid;
mod outline;
mod silhouette;
#[cfg(test)]
mod tests;

pub use outline::{SilhouettePoint, SmokeLines};

use crate::mesh_lines::visibility::Piece;
use crate::project::Projector;
use glam::DVec3;
use grid::PuffGrid;
use npr_core::smoke::{REACH, Sphere};
use silhouette::Silhouette;
use std::collections::BTreeSet;

/// How much nearer than a point a puff must be to hide it, as a part of its radius: lines on a sphere must not break
/// into dashes.
const NEARER: f64 = 1e-6;

/// A sphere as an eye has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Puff {
    /// Its number among the spheres given.
    pub number: u32,
    /// Middle: to the right, up, along the view axis.
    pub center: DVec3,
    /// Radius in scene units, above 0.
    pub radius: f64,
    /// What encloses its image, in pixels: left, top, right, bottom.
    pub bounds: [f64; 4],
}

impl Puff {
    /// `None` for what is not drawn.
    fn new(projector: &Projector, number: u32, sphere: &Sphere) -> Option<Self> {
        let radius = f64::from(sphere.radius);
        let is_sound = |v: &f32| v.abs() < REACH;
        if !(radius > 0.0 && radius < f64::from(REACH) && sphere.center.iter().all(is_sound)) {
            return None;
        }
        let center = projector.from_eye(DVec3::from(sphere.center.map(f64::from)));
        if center.z - radius < projector.near() {
            return None;
        }
        let mut puff = Self {
            number,
            center,
            radius,
            bounds: [0.0; 4],
        };
        let [[left, right], [low, high]] = [center.x, center.y].map(|across| {
            let [near, far] = puff.reach(projector, across);
            [near.min(far), near.max(far)]
        });
        // Slopes become pixels at depth 1; in parallel view depth plays no part.
        let corner = |x: f64, y: f64| projector.project_from_eye(DVec3::new(x, y, 1.0));
        let ([left, top], [right, bottom]) = (corner(left, high), corner(right, low));
        puff.bounds = [left, top, right, bottom];
        puff.bounds.iter().all(|v| v.is_finite()).then_some(puff)
    }

    /// Where planes through the eye touch the sphere along an axis: slopes in perspective, places else.
    fn reach(&self, projector: &Projector, across: f64) -> [f64; 2] {
        if !projector.is_perspective() {
            return [across - self.radius, across + self.radius];
        }
        let (z, r) = (self.center.z, self.radius);
        let room = r * (across * across + (z - r) * (z + r)).max(0.0).sqrt();
        [-1.0, 1.0].map(|side| (across * z + side * room) / ((z - r) * (z + r)))
    }

    /// View depth of its nearest point.
    fn front(&self) -> f64 {
        self.center.z - self.radius
    }

    /// How far behind a point the sight through it enters the sphere, below 0 in front of it; `None` where it passes
    /// by.
    pub fn entry(&self, is_perspective: bool, point: DVec3) -> Option<f64> {
        let (direction, way) = match is_perspective {
            true => (point / point.length(), point.length()),
            false => (DVec3::Z, point.z),
        };
        let offset = match is_perspective {
            true => self.center,
            false => self.center - DVec3::new(point.x, point.y, 0.0),
        };
        let middle = offset.dot(direction);
        let left = self.radius * self.radius - (offset - direction * middle).length_squared();
        (left > 0.0).then(|| middle - left.sqrt() - way)
    }
}

/// The spheres of smoke in a view, sorted into a grid over the picture.
///
/// Left out are spheres that pictures do not show either: without size, with numbers that are none, behind the eye;
/// and those that the near plane cuts, as around the eye. Of equal spheres the first counts.
#[derive(Debug, Clone)]
pub struct Puffs {
    projector: Projector,
    /// Those that touch the picture and a margin, from front to back.
    puffs: Vec<Puff>,
    grid: PuffGrid,
}

impl Puffs {
    /// Sorts spheres for a view on a picture of `size` pixels. O(n log n).
    pub fn new(projector: &Projector, size: [u32; 2], spheres: &[Sphere]) -> Self {
        let mut known = BTreeSet::new();
        let mut is_first = |sphere: &Sphere| {
            let [x, y, z] = sphere.center;
            // -0 equals 0, and adding 0 makes it so.
            known.insert([x, y, z, sphere.radius].map(|v| (v + 0.0).to_bits()))
        };
        let mut puffs: Vec<Puff> = (0..)
            .zip(spheres)
            .filter(|(_, sphere)| is_first(sphere))
            .filter_map(|(number, sphere)| Puff::new(projector, number, sphere))
            .filter(|puff| grid::touches(size, puff))
            .collect();
        puffs.sort_by(|a, b| {
            let fronts = a.front().total_cmp(&b.front());
            fronts.then(a.number.cmp(&b.number))
        });
        Self {
            projector: *projector,
            grid: PuffGrid::new(size, &puffs),
            puffs,
        }
    }

    /// Whether none is in sight.
    pub fn is_empty(&self) -> bool {
        self.puffs.is_empty()
    }

    /// Whether a puff stands before a point of the world. About O(puffs in the image of the point).
    pub fn hide(&self, world: DVec3) -> bool {
        let point = self.projector.from_eye(world);
        self.around(self.projector.project_from_eye(point))
            .any(|puff| {
                let entry = puff.entry(self.projector.is_perspective(), point);
                entry.is_some_and(|entry| entry < -NEARER * puff.radius)
            })
    }

    /// View depth of the smoke at a place in the picture, in pixels; `None` where there is none.
    pub fn depth_at(&self, place: [f64; 2]) -> Option<f64> {
        let is_perspective = self.projector.is_perspective();
        let start = self.projector.near().max(1e-300);
        let point = self
            .projector
            .from_eye(self.projector.unproject(place, start));
        let entries = self.around(place).filter_map(|puff| {
            let entry = puff.entry(is_perspective, point)?;
            let stretch = if is_perspective {
                point.z / point.length()
            } else {
                1.0
            };
            Some(point.z + entry * stretch)
        });
        entries.reduce(f64::min)
    }

    /// Shares of a piece's image at which a puff may begin or end hiding it, in no order.
    ///
    /// Where the image of the piece crosses the silhouette of a puff, and where the piece goes through the sphere.
    /// O(puffs around it).
    pub fn cuts(&self, piece: &Piece) -> Vec<f64> {
        let ends = piece.world.map(|world| self.projector.from_eye(world));
        let [a, b] = piece.place;
        let corners = [
            a[0].min(b[0]),
            a[1].min(b[1]),
            a[0].max(b[0]),
            a[1].max(b[1]),
        ];
        let mut cuts = Vec::new();
        self.grid.visit(corners, |index| {
            let puff = &self.puffs[index as usize];
            let beside = |axis: usize| {
                puff.bounds[axis] > corners[axis + 2] || puff.bounds[axis + 2] < corners[axis]
            };
            if !beside(0) && !beside(1) {
                cuts.extend(puff.meetings(self.projector.is_perspective(), ends));
            }
            true
        });
        let in_image = |t: f64| self.projector.image_share(t, piece.depth);
        cuts.retain(|t| (0.0..=1.0).contains(t));
        cuts.iter_mut().for_each(|t| *t = in_image(*t));
        cuts
    }

    /// The puffs whose image may hold a place.
    fn around(&self, place: [f64; 2]) -> impl Iterator<Item = &Puff> {
        let cell = self.grid.cell_at(place).iter();
        cell.map(|index| &self.puffs[*index as usize])
    }
}

impl Puff {
    /// Where a straight line goes through the sphere, and where its image crosses the silhouette; 0 at its start, 1 at
    /// its end.
    fn meetings(&self, is_perspective: bool, [from, to]: [DVec3; 2]) -> impl Iterator<Item = f64> {
        let (square, step) = (self.radius * self.radius, to - from);
        let offset = from - self.center;
        let through = roots(
            step.length_squared(),
            offset.dot(step),
            offset.length_squared() - square,
        );
        let crossing = if is_perspective {
            // (X.c)^2 = |X|^2 (|c|^2 - r^2) for rays that touch.
            let power = self.center.length_squared() - square;
            let [p, q] = [from, step].map(|v| v.dot(self.center));
            roots(
                q * q - step.length_squared() * power,
                p * q - from.dot(step) * power,
                p * p - from.length_squared() * power,
            )
        } else {
            let (flat, beside) = (step.truncate(), offset.truncate());
            roots(
                flat.length_squared(),
                beside.dot(flat),
                beside.length_squared() - square,
            )
        };
        through.into_iter().chain(crossing).flatten()
    }

    /// The circle in which sights touch the sphere.
    pub fn silhouette(&self, is_perspective: bool) -> Silhouette {
        Silhouette::new(self, is_perspective)
    }
}

/// Where `a t^2 + 2 b t + c` is 0.
fn roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    let inside = b * b - a * c;
    if inside < 0.0 || !inside.is_finite() {
        return [None; 2];
    }
    // Adding numbers of one sign loses no digits; the other root follows from the product of both.
    let sum = -(b + inside.sqrt().copysign(b));
    [sum / a, c / sum].map(|root| Some(root).filter(|root| root.is_finite()))
}
