//! Places of lines that are found again after the surface or the camera has moved.

use crate::project::Projector;
use crate::surface_location::SurfaceLocation;
use glam::DVec3;
use npr_mesh::half_edge::HalfEdgeMesh;

/// A place in a picture, by the point of the surface that it shows: 28 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Anchor {
    /// What of the shape it lies on.
    location: SurfaceLocation,
    /// How much each vertex of that counts; of what lies on no shape, the place in the world.
    at: [f32; 3],
    /// How far beside that it was drawn, in pixels: lines are smoothed.
    beside_px: [f32; 2],
}

impl Anchor {
    /// The anchor of a place in the picture, in pixels, and in the world.
    pub fn new(
        (place, world): ([f64; 2], DVec3),
        location: SurfaceLocation,
        shape: &HalfEdgeMesh,
        projector: &Projector,
    ) -> Self {
        let (at, world) = match location.is_nowhere() {
            true => (world.to_array(), world),
            false => {
                let (vertices, shares) = location.place(shape, world);
                let parts = (0..3).map(|i| shape.point(vertices[i]) * shares[i]);
                (shares, parts.sum())
            }
        };
        let shown = match projector.depth(world) < projector.near() {
            true => place,
            false => projector.project(world),
        };
        Self {
            location,
            at: at.map(|v| v as f32),
            beside_px: [0, 1].map(|i| (place[i] - shown[i]) as f32),
        }
    }

    /// Where its point of the shape lies in the world.
    fn world(&self, shape: &HalfEdgeMesh) -> DVec3 {
        let at = self.at.map(f64::from);
        if self.location.is_nowhere() {
            return DVec3::from(at);
        }
        let vertices = self.location.vertices(shape);
        let parts = (0..3).map(|i| shape.point(vertices[i]) * at[i]);
        parts.sum()
    }

    /// Where it shows in a view of the shape as it is posed now, in pixels; none where it lies behind the eye.
    pub fn place(&self, shape: &HalfEdgeMesh, projector: &Projector) -> Option<[f64; 2]> {
        let world = self.world(shape);
        if projector.depth(world) < projector.near() {
            return None;
        }
        let place = projector.project(world);
        Some([0, 1].map(|i| place[i] + f64::from(self.beside_px[i])))
    }
}
