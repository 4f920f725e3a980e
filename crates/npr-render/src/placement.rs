//! Where nodes and cameras stand in the world.

use glam::{Mat3, Mat4, Vec3};
use npr_core::camera::{Camera, Projection};
use npr_mesh::pose::Matrix;
use npr_scene::{Node, Scene};

/// Lowest and highest corner of a box.
pub(crate) type Bounds = ([f32; 3], [f32; 3]);

/// What every kind of model says about its scene, from its fields `bounds`, `cameras`, `parts` and `notices`.
macro_rules! accessors {
    () => {
        /// Lowest and highest corner of the posed scene, in the world; a unit box where nothing is drawn.
        pub fn bounds(&self) -> ([f32; 3], [f32; 3]) {
            self.bounds
        }

        /// Cameras of the file, with their names, in the order of its nodes.
        pub fn cameras(&self) -> &[(String, npr_core::camera::Camera)] {
            &self.cameras
        }

        /// Surfaces, in the order in which triangles and strokes name them.
        pub fn parts(&self) -> &[$crate::part_info::PartInfo] {
            &self.parts
        }

        /// What was ignored or mended, for the user.
        pub fn notices(&self) -> &[String] {
            &self.notices
        }
    };
}
pub(crate) use accessors;

/// The box around two boxes.
pub(crate) fn around(a: Bounds, b: Bounds) -> Bounds {
    (
        std::array::from_fn(|i| a.0[i].min(b.0[i])),
        std::array::from_fn(|i| a.1[i].max(b.1[i])),
    )
}

/// Radius of the sphere around a box; at least a tiny number.
pub(crate) fn radius_of((min, max): Bounds) -> f32 {
    ((Vec3::from(max) - Vec3::from(min)).length() * 0.5).max(1e-12)
}

/// Cameras of a scene, as it is posed, with their names, in the order of its nodes. O(nodes).
pub fn cameras_of(scene: &Scene) -> Vec<(String, Camera)> {
    let cameras = scene.nodes.iter().filter_map(|node| camera_of(scene, node));
    cameras.collect()
}

/// The matrices that a node's influences index: its skin's joints, or itself.
pub(crate) fn matrices_of(scene: &Scene, node: &Node) -> Vec<Matrix> {
    let Some(skin) = node.skin.and_then(|skin| scene.skins.get(skin as usize)) else {
        return vec![node.world_from_node];
    };
    let joints = skin
        .joints
        .iter()
        .zip(&skin.inverse_bind)
        .map(|(joint, inverse_bind)| {
            let world = Mat4::from_cols_array_2d(&scene.nodes[*joint as usize].world_from_node);
            (world * Mat4::from_cols_array_2d(inverse_bind)).to_cols_array_2d()
        });
    let joints: Vec<Matrix> = joints.collect();
    if joints.is_empty() {
        vec![node.world_from_node]
    } else {
        joints
    }
}

pub(crate) fn determinant_of(matrix: &Matrix) -> f32 {
    Mat3::from_mat4(Mat4::from_cols_array_2d(matrix)).determinant()
}

/// A node's camera in the world, with its name.
fn camera_of(scene: &Scene, node: &Node) -> Option<(String, Camera)> {
    let camera = scene.cameras.get(node.camera? as usize)?;

    // Place the camera, which looks against the node's z axis.
    let m = Mat4::from_cols_array_2d(&node.world_from_node);
    let eye = m.w_axis.truncate();
    let projection = match camera.projection {
        npr_scene::Projection::Perspective { yfov, .. } => Projection::Perspective { fov_y: yfov },
        npr_scene::Projection::Orthographic { ymag, .. } => {
            Projection::Parallel { height: 2.0 * ymag }
        }
    };

    // Give it the name of its node, or its own where the node has none.
    let name = if node.name.is_empty() {
        &camera.name
    } else {
        &node.name
    };
    let camera = Camera {
        eye: eye.to_array(),
        target: (eye - m.z_axis.truncate().normalize_or(Vec3::Z)).to_array(),
        up: m.y_axis.truncate().to_array(),
        projection,
    };
    Some((name.clone(), camera))
}

/// A vector in the camera's axes as one in the world.
pub(crate) fn in_world(camera: &Camera, direction: [f32; 3]) -> [f32; 3] {
    let [right, up, back] = camera.axes().map(Vec3::from);
    (right * direction[0] + up * direction[1] + back * direction[2]).to_array()
}
