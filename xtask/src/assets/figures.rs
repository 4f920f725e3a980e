//! The small scenes on which single properties are shown.

use glam::Vec3;

use super::prism::cuboid;
use super::scene::{Scene, View};
use super::shape::{Paint, Shape};
use super::teapot::teapot;
use super::turned::ball;

/// Light from the upper left, over the viewer's shoulder.
const OVER_THE_SHOULDER: Vec3 = Vec3::new(0.5, -0.9, -0.75);

/// A cube before a plane: depth alone misses the cube's front creases [Okuya 2016, figs 3-5].
pub fn cube_plane() -> Scene {
    let mut scene = Scene::new(
        view([18.0, 19.0, 30.0], [0.0, 4.6, 0.0], 30.0),
        OVER_THE_SHOULDER,
    );
    let red = scene.material("Cube", 0xd9694f);
    let grey = scene.material("Backdrop", 0xd8dce0);
    scene.stand("Cube", cuboid(10.0, 10.0, 10.0, red), [0.0, 0.0, 0.0], 0.0);
    scene.stand(
        "Backdrop",
        cuboid(120.0, 100.0, 1.0, grey),
        [-20.0, -60.0, -14.0],
        0.0,
    );
    scene
}

/// A teapot on a box before a plane [Okuya 2016, fig. 10].
pub fn teapot_box_plane() -> Scene {
    let view = view([16.0, 26.0, 58.0], [0.4, 9.0, 0.0], 30.0);
    let mut scene = Scene::new(view, OVER_THE_SHOULDER);
    let glaze = scene.material("Glaze", 0x4f9a94);
    let wood = scene.material("Wood", 0xc98f57);
    let wall = scene.material("Wall", 0xe4e0d4);
    scene.stand("Teapot", teapot(glaze), [0.0, 6.5, 0.0], 14.0);
    scene.stand("Box", cuboid(28.0, 6.5, 19.0, wood), [0.0, 0.0, 0.0], -14.0);
    scene.stand(
        "Backdrop",
        cuboid(130.0, 90.0, 1.0, wall),
        [-6.0, -40.0, -26.0],
        0.0,
    );
    scene
}

/// A near and a far ball of one size, for tones that keep their grain [Suzuki 2004, fig. 3.14].
pub fn two_balls() -> Scene {
    let mut scene = Scene::new(
        view([0.0, 14.0, 34.0], [2.5, 5.0, -10.0], 32.0),
        OVER_THE_SHOULDER,
    );
    let near = scene.material("Near", 0xe0803f);
    let far = scene.material("Far", 0x4a86b8);
    scene.stand("NearBall", sphere_on_ground(near), [-6.5, 0.0, 0.0], 0.0);
    scene.stand("FarBall", sphere_on_ground(far), [16.0, 0.0, -52.0], 0.0);
    scene
}

/// A floor that runs far back, a board with a panel that stands out by a fifth of a millimetre, and a ball of few
/// faces: no threshold of an image filter suits all three.
pub fn steps() -> Scene {
    let mut scene = Scene::new(
        view([0.0, 15.0, 46.0], [0.0, 8.5, 0.0], 32.0),
        OVER_THE_SHOULDER,
    );
    let ground = scene.material("Ground", 0xd8dce0);
    let board = scene.material("Board", 0xc98f57);
    let glaze = scene.material("Glaze", 0x4f9a94);
    scene.stand(
        "Floor",
        cuboid(600.0, 1.0, 1200.0, ground),
        [0.0, -1.0, -540.0],
        0.0,
    );
    let panel = cuboid(8.0, 10.0, 1.0, board).warp(|p| p + Vec3::new(0.0, 3.0, 0.52));
    scene.stand(
        "Board",
        cuboid(13.0, 16.0, 2.0, board).join(panel),
        [-9.0, 0.0, 0.0],
        0.0,
    );
    let round = ball(6.0, 24, glaze).warp(|p| p + Vec3::Y * 6.0);
    scene.stand("Ball", round, [9.0, 0.0, 0.0], 0.0);
    scene
}

/// A ball of 6 cm radius that touches y = 0.
fn sphere_on_ground(paint: Paint) -> Shape {
    ball(6.0, 64, paint).warp(|p| p + Vec3::Y * 6.0)
}

/// A 16:9 view from `eye` to `target` with a vertical field of view of `degrees`.
fn view(eye: [f32; 3], target: [f32; 3], degrees: f32) -> View {
    View {
        eye: Vec3::from(eye),
        target: Vec3::from(target),
        fov: degrees.to_radians(),
        aspect: 16.0 / 9.0,
    }
}
