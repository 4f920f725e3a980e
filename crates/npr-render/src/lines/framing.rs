//! Views of a whole line model.

use super::LineModel;
use crate::smoke::Smoke;
use glam::Vec3;
use npr_core::camera::{Camera, swept};

impl LineModel {
    /// A view of the whole model from three quarters above, for a frame of width / height `aspect`; `fov_y` is in
    /// radians.
    ///
    /// The same as [`Model::framing_with`](crate::Model::framing_with) gives for the scene with its smoke.
    pub fn framing(&self, aspect: f32, fov_y: f32) -> Camera {
        Camera::framing_points(self.places(), aspect, fov_y)
    }

    /// Places all over the scene with its smoke, for framing it.
    pub fn places(&self) -> impl Iterator<Item = [f32; 3]> {
        let smoke = self.smoke.iter().flat_map(Smoke::reach);
        let smoke = smoke.map(|point| point.to_array());
        self.points.iter().copied().chain(smoke)
    }

    /// A view from three quarters above that all of it stays within while the camera turns about an axis through
    /// `pivot`. `fov_y` is in radians. O(points).
    pub fn framing_around(
        &self,
        [pivot, axis]: [[f32; 3]; 2],
        (aspect, fov_y): (f32, f32),
    ) -> Camera {
        let points: Vec<Vec3> = self.places().map(Vec3::from).collect();
        let swept = swept(points.iter().copied(), pivot, axis);
        Camera::framing_points(swept.into_iter(), aspect, fov_y)
    }
}
