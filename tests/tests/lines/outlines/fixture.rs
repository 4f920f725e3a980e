//! Scenes and styles that several tests draw.

use npr_core::camera::{Camera, Projection};
use npr_core::window::View;
use npr_mesh::testing::plane;
use npr_scene::{Material, Node, Part, Scene};
use npr_stylesheet::Style;
use npr_tests::{Drawing, Object, Wanted, boxed, draw_from, lines, placed, scene_of};

/// A frame of 16:9.
pub const SIZE: [u32; 2] = [640, 360];

/// A style with some settings changed.
pub fn with(mut style: Style, settings: &[&str]) -> Style {
    for setting in settings {
        style.set(setting).unwrap();
    }
    style
}

/// Lines drawn by a method, with everything that detects switched off except `tests`.
pub fn detecting(method: &str, tests: &[&str]) -> Style {
    let all = [
        "detect.depth.on",
        "detect.normal.on",
        "detect.object.on",
        "detect.material.on",
        "line.kinds.intersection",
    ];
    let settings = all.map(|test| format!("{test}={}", tests.contains(&test)));
    with(lines(method), &settings.each_ref().map(String::as_str))
}

/// A camera that looks along -z at the square from -1 to 1; nothing gets smaller with distance.
pub fn front_camera() -> Camera {
    Camera {
        eye: [0.0, 0.0, 10.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 2.0 },
    }
}

/// A scene of meshes seen by [`front_camera`], in a square frame.
pub fn front(objects: &[Object], style: &Style) -> Drawing {
    draw_from(&scene_of(objects), style, &front_camera(), [200, 200])
}

/// The cube before a plane that fills the frame [Okuya 2016, figure 3].
pub fn cube_before_plane() -> Scene {
    let wall = placed(&plane(1, 1), [80.0, 80.0, 1.0], [-40.0, -40.0, -4.0]);
    scene_of(&[
        Object::new("Cube", boxed([-1.0; 3], [1.0; 3])),
        Object::new("Wall", wall),
    ])
}

/// Sees three faces of the cube.
pub fn corner_camera() -> Camera {
    Camera {
        eye: [2.6, 2.2, 6.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    }
}

/// The cube before the plane in a style.
pub fn cube_drawing(style: &Style) -> Drawing {
    draw_from(&cube_before_plane(), style, &corner_camera(), SIZE)
}

/// Edges of the cube between points given by signs.
fn cube_edges(view: &View, edges: &[[[i8; 3]; 2]]) -> Wanted {
    let corners = edges
        .iter()
        .map(|ends| ends.map(|signs| signs.map(f32::from)));
    Wanted::seen(view, &corners.collect::<Vec<_>>())
}

/// The three edges of the cube between faces that are both seen.
pub fn cube_creases(view: &View) -> Wanted {
    cube_edges(
        view,
        &[
            [[1, 1, 1], [-1, 1, 1]],
            [[1, 1, 1], [1, -1, 1]],
            [[1, 1, 1], [1, 1, -1]],
        ],
    )
}

/// The cube's silhouette around its front face, which is parallel to the plane behind.
pub fn cube_front_silhouette(view: &View) -> Wanted {
    cube_edges(
        view,
        &[[[-1, 1, 1], [-1, -1, 1]], [[-1, -1, 1], [1, -1, 1]]],
    )
}

/// The cube's silhouette around its top and side.
pub fn cube_other_silhouette(view: &View) -> Wanted {
    cube_edges(
        view,
        &[
            [[-1, 1, 1], [-1, 1, -1]],
            [[-1, 1, -1], [1, 1, -1]],
            [[1, 1, -1], [1, -1, -1]],
            [[1, -1, -1], [1, -1, 1]],
        ],
    )
}

/// All nine edges of the cube that are seen.
pub fn cube_wanted(view: &View) -> Wanted {
    cube_creases(view)
        .and(cube_front_silhouette(view))
        .and(cube_other_silhouette(view))
}

/// One node with parts that name the materials beside them, seen by [`front_camera`].
pub fn parts_scene(parts: &[(npr_mesh::Mesh, u32)]) -> Scene {
    let part = |(mesh, material): &(npr_mesh::Mesh, u32)| Part {
        positions: mesh.positions().to_vec(),
        triangles: mesh.triangles().to_vec(),
        material: Some(*material),
        ..Part::default()
    };
    Scene {
        nodes: vec![Node {
            mesh: Some(0),
            ..Node::default()
        }],
        meshes: vec![npr_scene::Mesh {
            parts: parts.iter().map(part).collect(),
            ..npr_scene::Mesh::default()
        }],
        materials: vec![Material::default(); 2],
        ..Scene::default()
    }
}
