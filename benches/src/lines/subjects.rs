//! What is drawn for the measures: models of the shared folder, meshes that other programs drew, shapes made on the
//! spot.

use std::path::{Path, PathBuf};

use glam::DVec3;
use npr_core::camera::{Camera, Projection};
use npr_scene::{LoadOptions, Mesh, Node, Part, Scene, SceneError, load};

use super::analytic::{Triangles, tube_mesh};
use super::soup::Soup;

/// Frame of all measures.
pub const SIZE: [u32; 2] = [1920, 1080];

/// Vertical field of view in degrees.
const FOV_DEG: f32 = 35.0;

/// Distance of the eye in radii of the model.
const AWAY: f64 = 3.5;

/// From where the three views look. The first is the one that other programs were measured with.
const DIRECTIONS: [[f64; 3]; 3] = [[0.6, 0.45, 1.0], [-1.0, 0.2, 0.35], [0.35, 0.8, -0.9]];

/// Models of the shared folder.
pub const MODELS: [&str; 8] = [
    "stanford_bunny.glb",
    "nefertiti_70k.glb",
    "shader_ball.glb",
    "human_body.glb",
    "cad_feature_plate.glb",
    "cycloidal_drive.glb",
    "flight_helmet.glb",
    "suzanne.glb",
];

/// Meshes of the comparison with other programs, centred and within a unit ball.
pub const PEER_MESHES: [&str; 11] = [
    "suzanne_1k.obj",
    "cad_part.obj",
    "towers_1728.obj",
    "ico_20k.obj",
    "suzanne_63k.obj",
    "ico_80k.obj",
    "bumpy_80k.obj",
    "knot_100k.obj",
    "suzanne_252k.obj",
    "ico_320k.obj",
    "bumpy_320k.obj",
];

/// A model and from where to look at it.
#[derive(Debug, Clone)]
pub struct LineSubject {
    /// Name of its file without the extension.
    pub name: String,
    /// As loaded.
    pub scene: Scene,
    /// As the reference sees it.
    pub soup: Soup,
    /// The views.
    pub cameras: Vec<Camera>,
}

impl LineSubject {
    /// Loads a model; `unit` where it lies in the unit ball around the origin, so that cameras are the same for all.
    ///
    /// # Errors
    ///
    /// Whatever loading says.
    pub fn load(path: &Path, unit: bool) -> Result<Self, SceneError> {
        let scene = load(path, &LoadOptions::default())?;
        let soup = Soup::of_scene(&scene);
        let (middle, radius) = if unit {
            (DVec3::ZERO, 1.0)
        } else {
            soup.ball()
        };
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        Ok(Self {
            name: name.into_owned(),
            cameras: DIRECTIONS
                .map(|direction| camera(middle, radius, direction))
                .to_vec(),
            scene,
            soup,
        })
    }
}

/// A camera that sees a ball whole.
fn camera(middle: DVec3, radius: f64, direction: [f64; 3]) -> Camera {
    let eye = middle + DVec3::from(direction).normalize() * (AWAY * radius);
    Camera {
        eye: eye.as_vec3().to_array(),
        target: middle.as_vec3().to_array(),
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective {
            fov_y: FOV_DEG.to_radians(),
        },
    }
}

/// Eight views around a subject, from three radii and 15 degrees above.
pub fn pilot_cameras(subject: &LineSubject) -> Vec<Camera> {
    let (middle, radius) = subject.soup.ball();
    let up = 15f64.to_radians();

    // Look at the middle from the side and a little above.
    let view = |turn: f64| {
        let direction = [
            libm::cos(up) * libm::sin(turn),
            libm::sin(up),
            libm::cos(up) * libm::cos(turn),
        ];
        let eye = middle + DVec3::from(direction) * (3.0 * radius);
        Camera {
            eye: eye.as_vec3().to_array(),
            projection: Projection::Perspective {
                fov_y: 45f32.to_radians(),
            },
            ..camera(middle, radius, direction)
        }
    };

    // Go round in eight steps.
    (0..8)
        .map(|step| view(f64::from(step) * 45f64.to_radians()))
        .collect()
}

/// The view that other programs were measured with, of a shape within the unit ball.
pub fn benchmark_camera() -> Camera {
    camera(DVec3::ZERO, 1.0, DIRECTIONS[0])
}

/// The folder of shared models, where it lies beside the project.
pub fn shared_models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/assets/models")
}

/// A scene of one mesh.
pub fn scene_of((positions, triangles): Triangles) -> Scene {
    let part = Part {
        positions,
        triangles,
        ..Part::default()
    };
    let mesh = Mesh {
        parts: vec![part],
        ..Mesh::default()
    };
    let node = Node {
        mesh: Some(0),
        ..Node::default()
    };
    Scene {
        nodes: vec![node],
        meshes: vec![mesh],
        ..Scene::default()
    }
}

/// A tube knotted around a ring, of about `triangle_count` triangles, within the unit ball.
pub fn knot(triangle_count: u32) -> Triangles {
    let around = libm::sqrt(f64::from(triangle_count) / 40.0).max(3.0) as u32;
    tube_mesh(20 * around, around, |u, v| {
        let spine = |t: f64| {
            let reach = 0.55 + 0.22 * libm::cos(3.0 * t);
            DVec3::new(
                reach * libm::cos(2.0 * t),
                reach * libm::sin(2.0 * t),
                0.3 * libm::sin(3.0 * t),
            )
        };
        let along = (spine(u + 1e-4) - spine(u - 1e-4)).normalize();
        let side = along.cross(DVec3::Z).normalize();
        let out = side * libm::cos(v) + side.cross(along) * libm::sin(v);
        spine(u) + out * 0.12
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_knot_is_closed_and_fits_the_unit_ball() {
        let (positions, triangles) = knot(5000);
        let soup = Soup::of_mesh(&positions, &triangles);
        let edges = soup.edges();
        assert!(edges.iter().all(|edge| edge.sides.len() == 2));
        assert_eq!(soup.positions.len() + soup.faces.len(), edges.len());
        assert!((4000..6000).contains(&soup.faces.len()));
        assert!(soup.positions.iter().all(|p| p.length() < 1.0));
        let volume: f64 = (0..soup.faces.len())
            .map(|face| soup.corners(face))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        assert!(volume > 0.0, "wound counter-clockwise seen from outside");
    }
}
