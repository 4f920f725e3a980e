//! What the ends of springs do not enter.

use super::vector::{Vector, dot, length, minus, plus, scaled};
use crate::matrix::{self, Matrix};

/// A ball, or all balls along a line, on a node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collider {
    /// The node that carries it.
    pub node: u32,
    /// Middle of the first ball, in the space of the node.
    pub from: [f32; 3],
    /// Middle of the last one.
    pub to: [f32; 3],
    /// Radius in units of the world.
    pub radius: f32,
}

/// A collider where it stands in the world.
pub(super) struct Placed {
    from: Vector,
    way: Vector,
    radius: f64,
}

impl Placed {
    pub fn new(collider: &Collider, world_from_node: &Matrix) -> Self {
        let [from, to] = [collider.from, collider.to]
            .map(|place| matrix::transform_point(world_from_node, place).map(f64::from));
        Self {
            from,
            way: minus(to, from),
            radius: f64::from(collider.radius),
        }
    }

    /// The middle that is nearest to a place.
    fn middle(&self, place: Vector) -> Vector {
        let beside = minus(place, self.from);
        let (along, whole) = (dot(self.way, beside), dot(self.way, self.way));
        let share = match whole > 0.0 {
            true => (along / whole).clamp(0.0, 1.0),
            false => 0.0,
        };
        plus(self.from, scaled(self.way, share))
    }

    /// Where a ball that lay in it comes to on a bone that swings about `head`: where it touches, on the side that it
    /// is on. None where it lies outside, or just behind the middle. Where no end of the bone is outside, it is pushed
    /// straight away from the middle, and so off its length.
    pub fn pushed(&self, end: Vector, radius: f64, head: Vector) -> Option<Vector> {
        // See how deep it lies.
        let middle = self.middle(end);
        let (way, wanted) = (minus(end, middle), self.radius + radius);
        let far = length(way);
        if far >= wanted || far == 0.0 {
            return None;
        }

        // Meet the two spheres on which it lies then.
        let (bone, axis) = (minus(end, head), minus(middle, head));
        let (long, apart) = (length(bone), length(axis));
        let ahead = (long * long + apart * apart - wanted * wanted) / (2.0 * apart);
        let beside = minus(bone, scaled(axis, dot(bone, axis) / (apart * apart)));
        let height = (long * long - ahead * ahead).sqrt();
        let touching = plus(
            scaled(axis, ahead / apart),
            scaled(beside, height / length(beside)),
        );
        match touching.iter().all(|v| v.is_finite()) {
            true => Some(plus(head, touching)),
            false => Some(plus(end, scaled(way, (wanted - far) / far))),
        }
    }
}
