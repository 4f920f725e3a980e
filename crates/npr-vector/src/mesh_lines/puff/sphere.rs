//! A sphere of smoke in the axes of the eye.

use crate::project::Projector;
use glam::DVec3;
use npr_core::smoke::{REACH, Sphere};

/// A sphere in the axes of the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Puff {
    /// Its number among the spheres given.
    pub number: u32,
    /// Middle: to the right, up, along the view axis.
    pub center: DVec3,
    /// Radius in scene units, above 0.
    pub radius: f64,
    /// The box around its image, in pixels: left, top, right, bottom.
    pub bounds: [f64; 4],
}

impl Puff {
    /// The puff of a sphere; `None` if it is not drawn.
    pub fn new(projector: &Projector, number: u32, sphere: &Sphere) -> Option<Self> {
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
    pub fn front(&self) -> f64 {
        self.center.z - self.radius
    }

    /// Distance from a point along its sight to where the sight enters the sphere, below 0 if that lies before the
    /// point; `None` where the sight misses the sphere.
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

impl Puff {
    /// Where a straight line goes through the sphere, and where its image crosses the silhouette, in shares from 0 at
    /// its start to 1 at its end.
    pub fn meetings(
        &self,
        is_perspective: bool,
        [from, to]: [DVec3; 2],
    ) -> impl Iterator<Item = f64> {
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
