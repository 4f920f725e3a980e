//! The same on a device.

use super::{camera_at, draw_all, odd_cameras, styles, torture};
use npr_mesh::testing::cube;
use npr_tests::{Object, scene_of};

#[test]
fn the_device_draws_bad_geometry_too() {
    let Some(device) = npr_tests::device() else {
        return;
    };
    for (name, mesh) in torture() {
        let scene = scene_of(&[Object::new(name, mesh)]);
        let camera = camera_at([0.5, 1.0, 2.5], [0.0; 3]);
        assert_eq!(
            draw_all(device, &scene, &camera).len(),
            styles().len(),
            "{name}"
        );
    }
    let scene = scene_of(&[Object::new("Box", cube())]);
    for camera in odd_cameras() {
        assert_eq!(
            draw_all(device, &scene, &camera).len(),
            styles().len(),
            "{camera:?}"
        );
    }
}
