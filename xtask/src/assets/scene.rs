//! What a sample file holds: painted objects, a view and a light.

use glam::{Mat3, Vec3};
use npr_core::color;

use super::shape::{Paint, Shape};

/// A surface colour with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// The name that styles may match.
    pub name: &'static str,
    /// Base colour as linear light.
    pub color: [f32; 3],
    /// Its backs are seen too, as of open strips.
    pub double_sided: bool,
}

/// A named shape and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// The name of node and mesh.
    pub name: &'static str,
    /// The triangles, in centimetres about the object's own origin.
    pub shape: Shape,
    /// Turn of the node.
    pub turn: Mat3,
    /// Place of the node, in centimetres.
    pub place: Vec3,
}

/// A perspective camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Place of the camera, in centimetres.
    pub eye: Vec3,
    /// The point in the middle of the picture, in centimetres.
    pub target: Vec3,
    /// Vertical field of view in radians.
    pub fov: f32,
    /// Width over height.
    pub aspect: f32,
}

/// Everything in one sample file.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Surface colours, by [`Paint`].
    pub materials: Vec<Material>,
    /// The objects, in the order they are written.
    pub objects: Vec<Object>,
    /// The camera.
    pub view: View,
    /// The direction in which the sun shines.
    pub sunlight: Vec3,
}

impl Scene {
    /// A scene without objects.
    pub fn new(view: View, sunlight: Vec3) -> Self {
        Self {
            materials: Vec::new(),
            objects: Vec::new(),
            view,
            sunlight,
        }
    }

    /// Adds a material of an sRGB colour written as `0xRRGGBB`.
    pub fn material(&mut self, name: &'static str, srgb: u32) -> Paint {
        let [_, r, g, b] = srgb.to_be_bytes().map(|byte| f32::from(byte) / 255.0);
        // Four digits say more than eight bits did, and keep the file readable.
        let color = [r, g, b].map(|v| (color::linear_from_srgb(v) * 1e4).round() / 1e4);
        self.materials.push(Material {
            name,
            color,
            double_sided: false,
        });
        Paint(self.materials.len() - 1)
    }

    /// The same for faces that are seen from both sides.
    pub fn double_sided_material(&mut self, name: &'static str, srgb: u32) -> Paint {
        let paint = self.material(name, srgb);
        self.materials[paint.0].double_sided = true;
        paint
    }

    /// Adds an object at `place`, turned about the y axis by `degrees`.
    pub fn stand(&mut self, name: &'static str, shape: Shape, place: [f32; 3], degrees: f32) {
        self.add(
            name,
            shape,
            place,
            Mat3::from_rotation_y(degrees.to_radians()),
        );
    }

    /// Adds an object at `place` with any turn.
    pub fn add(&mut self, name: &'static str, shape: Shape, place: [f32; 3], turn: Mat3) {
        self.objects.push(Object {
            name,
            shape,
            turn,
            place: Vec3::from(place),
        });
    }
}

/// The turn that makes a node's -z look along `direction` with +y as near up as may be.
pub fn looking_along(direction: Vec3) -> Mat3 {
    let back = -direction.normalize();
    let right = Vec3::Y.cross(back).normalize_or(Vec3::X);
    Mat3::from_cols(right, back.cross(right), back)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_looks_where_it_is_told() {
        let direction = Vec3::new(1.0, -2.0, 0.5).normalize();
        let turn = looking_along(direction);
        assert!((turn * Vec3::NEG_Z).distance(direction) < 1e-6);
        assert!((turn * Vec3::X).y.abs() < 1e-6, "the horizon stays level");
    }
}
