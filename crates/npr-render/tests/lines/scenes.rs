//! Small scenes, and drawings of them.

use npr_core::camera::{Camera, Projection};
use npr_render::{Drawing, LineModel, LineModelOptions, LineOptions};
use npr_scene::{Material, Mesh, Node, Part, Scene};
use npr_stylesheet::Style;

/// Size of all drawings here.
pub const SIZE: [u32; 2] = [320, 200];

/// A node called `name` with a mesh of its own in a material of its own, called the same.
pub fn add(scene: &mut Scene, name: &str, mesh: &npr_mesh::Mesh) {
    let part = Part {
        positions: mesh.positions().to_vec(),
        triangles: mesh.triangles().to_vec(),
        material: Some(scene.materials.len() as u32),
        ..Part::default()
    };
    scene.materials.push(Material {
        name: name.to_owned(),
        ..Material::default()
    });
    scene.nodes.push(Node {
        name: name.to_owned(),
        mesh: Some(scene.meshes.len() as u32),
        ..Node::default()
    });
    scene.meshes.push(Mesh {
        parts: vec![part],
        ..Mesh::default()
    });
}

/// A scene of one mesh called `thing`.
pub fn scene_of(mesh: &npr_mesh::Mesh) -> Scene {
    let mut scene = Scene::default();
    add(&mut scene, "thing", mesh);
    scene
}

/// A model without tolerance.
pub fn model_of(scene: &Scene) -> LineModel {
    LineModel::new(scene, &LineModelOptions::default()).expect("a small scene")
}

/// A camera at `eye` that looks at the origin.
pub fn camera_at(eye: [f32; 3]) -> Camera {
    Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.7 },
    }
}

/// A style of even lines, `base` pixels wide.
pub fn even_style(base: &str) -> Style {
    let mut style = Style::default();
    for assignment in [
        "line.width.source=constant",
        "line.width.max=1",
        &format!("line.width.base={base}"),
    ] {
        style.set(assignment).expect("a valid key");
    }
    style
}

/// All lines of a scene from an eye, unsmoothed.
pub fn drawing_from(scene: &Scene, eye: [f32; 3]) -> Drawing {
    let options = LineOptions {
        smooth: false,
        ..LineOptions::new(SIZE)
    };
    model_of(scene)
        .draw(&camera_at(eye), &even_style("2px"), &options)
        .expect("a small drawing")
}
