//! The circle in which sights touch a sphere, and the arc of it that another sphere covers.

use super::sphere::Puff;
use glam::DVec3;
use npr_core::math;
use std::f64::consts::{PI, TAU};

/// The circle in which sights touch a puff, from the eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Silhouette {
    middle: DVec3,
    /// Two axes of the circle, as long as its radius: the first to the right as far as it can be, the second upwards.
    first: DVec3,
    second: DVec3,
    /// Length of the sights from the eye to the circle; in parallel view the depth of the circle.
    way: f64,
    is_perspective: bool,
}

impl Silhouette {
    pub fn new(puff: &Puff, is_perspective: bool) -> Self {
        let (center, radius) = (puff.center, puff.radius);
        if !is_perspective {
            return Self {
                middle: center,
                first: DVec3::X * radius,
                second: DVec3::Y * radius,
                way: center.z,
                is_perspective,
            };
        }
        // Sights touch the sphere in a circle a little nearer and narrower than its own.
        let distance = center.length();
        let power = (distance - radius) * (distance + radius);
        let way = power.max(0.0).sqrt();
        let axis = center / distance;
        let first = DVec3::new(axis.z, 0.0, -axis.x).normalize_or(DVec3::X);
        let second = (DVec3::Y - axis * axis.y).normalize_or(DVec3::Z);
        Self {
            middle: axis * (power / distance),
            first: first * (radius * way / distance),
            second: second * (radius * way / distance),
            way,
            is_perspective,
        }
    }

    /// The point at an angle.
    pub fn at(&self, angle: f64) -> DVec3 {
        self.middle + self.first * math::cos_f64(angle) + self.second * math::sin_f64(angle)
    }

    /// The point of the circle nearest to a point, if there is a single one.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        let out = point - self.middle;
        self.at(math::atan2_f64(out.dot(self.second), out.dot(self.first)))
    }

    /// Radius of the circle.
    pub fn radius(&self) -> f64 {
        self.first.length()
    }

    /// View depth of its nearest point.
    pub fn front(&self) -> f64 {
        let lean = (self.first.z * self.first.z + self.second.z * self.second.z).sqrt();
        self.middle.z - lean
    }

    /// The arc along which a puff hides the circle, or lies less than `room` behind it: the middle and half of the
    /// arc as angles.
    ///
    /// Whatever the room, that is where the cosine of the angle to one direction exceeds a number, because all
    /// points of the circle are equally far from the eye. `room` is measured along sights.
    pub fn covered_by(&self, puff: &Puff, room: f64) -> Option<[f64; 2]> {
        let (across, least) = match self.is_perspective {
            true => self.towards(puff, room),
            false => self.beside(puff, room)?,
        };
        let amplitude = (across[0] * across[0] + across[1] * across[1]).sqrt();
        if least < -amplitude || (least < 0.0 && amplitude == 0.0) {
            return Some([0.0, PI]);
        }
        if least >= amplitude || !amplitude.is_finite() || least.is_nan() {
            return None;
        }
        let middle = math::atan2_f64(across[1], across[0]);
        Some([middle.rem_euclid(TAU), math::acos_f64(least / amplitude)])
    }

    /// In perspective: the sphere begins before the end of a sight where the dot product d . c of the sight's unit
    /// direction and the sphere's middle exceeds a number.
    fn towards(&self, puff: &Puff, room: f64) -> ([f64; 2], f64) {
        let power = puff.center.length_squared() - puff.radius * puff.radius;
        let (end, touching) = (self.way + room, power.max(0.0).sqrt());
        let needed = if end >= touching {
            touching
        } else {
            (end * end + power) / (2.0 * end)
        };
        let across = [self.first, self.second].map(|v| v.dot(puff.center) / self.way);
        (across, needed - self.middle.dot(puff.center) / self.way)
    }

    /// In parallel view: the sight must pass the middle closely enough.
    fn beside(&self, puff: &Puff, room: f64) -> Option<([f64; 2], f64)> {
        let offset = self.middle - puff.center;
        // How far behind the end of the sight the middle lies: the sphere must bulge out as far.
        let behind = (-offset.z - room).max(0.0);
        let needed = (puff.radius - behind) * (puff.radius + behind);
        let apart = offset.x * offset.x + offset.y * offset.y;
        let across = [self.first, self.second].map(|v| -2.0 * (v.x * offset.x + v.y * offset.y));
        let radius = self.radius();
        (needed > 0.0).then_some((across, apart + radius * radius - needed))
    }
}
