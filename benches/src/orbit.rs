//! Cameras on their way round a subject.

use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::math::{cos, sin};

/// A camera turned about the upright axis through a place by some degrees, counter-clockwise seen from above.
pub fn turned(camera: Camera, middle: Vec3, degrees: f32) -> Camera {
    let (s, c) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
    let turned = |point: [f32; 3]| {
        let p = Vec3::from(point) - middle;
        (Vec3::new(c * p.x + s * p.z, p.y, c * p.z - s * p.x) + middle).to_array()
    };
    Camera {
        eye: turned(camera.eye),
        target: turned(camera.target),
        ..camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::Projection;

    #[test]
    fn a_quarter_turn_leads_from_the_front_to_the_side() {
        let front = Camera {
            eye: [1.0, 2.0, 5.0],
            target: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Parallel { height: 1.0 },
        };
        let side = turned(front, Vec3::new(1.0, 0.0, 0.0), 90.0);
        let off = Vec3::from(side.eye) - Vec3::new(6.0, 2.0, 0.0);
        assert!(off.length() < 1e-5 && side.target == front.target);
    }
}
