//! The same creases in frames and in drawings.

use crate::scenes::{SIZE, camera_at, even_style};
use npr_core::crease::CreaseFrom;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{cylinder, unindexed};
use npr_render::{
    Kind, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource, Model, Renderer,
    RendererOptions,
};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_stylesheet::Style;

/// A pillar of eight sides that a file shades as round: smooth around, broken at its rims.
fn pillar(has_normals: bool) -> Scene {
    let mesh = unindexed(&cylinder(8, 1));
    let flat = npr_mesh::testing::flat_normals(mesh.positions(), mesh.triangles()).into_flattened();
    let normal = |([x, y, _], flat): (&[f32; 3], [f32; 3])| {
        let length = x.hypot(*y);
        if flat[2].abs() > 0.5 {
            flat
        } else {
            [x / length, y / length, 0.0]
        }
    };
    let normals = mesh.positions().iter().zip(flat).map(normal).collect();
    Scene {
        meshes: vec![Mesh {
            parts: vec![Part {
                positions: mesh.positions().to_vec(),
                triangles: mesh.triangles().to_vec(),
                normals: has_normals.then_some(normals),
                ..Part::default()
            }],
            ..Mesh::default()
        }],
        nodes: vec![Node {
            name: "pillar".to_owned(),
            mesh: Some(0),
            ..Node::default()
        }],
        ..Scene::default()
    }
}

/// Length of creases that a drawing shows inside the outline.
fn drawn(scene: &Scene, style: &Style, method: LineSource) -> f64 {
    let model = LineModel::new(scene, &LineModelOptions::default()).expect("small");
    let options = LineOptions {
        method,
        ..LineOptions::of_style(style, SIZE)
    };
    let drawing = model
        .draw(&camera_at([6.0, 0.4, 0.0]), style, &options)
        .expect("drawn");
    let creases = drawing
        .strokes
        .iter()
        .filter(|stroke| stroke.kind == Kind::Crease);
    creases.map(|stroke| stroke.length()).sum()
}

/// Ink of a frame in the middle of the pillar, away from its rims and its outline.
fn ink_inside(scene: &Scene, style: &Style) -> usize {
    let model = Model::new(scene).expect("small");
    let lines = LineModel::for_style(scene, style, &LineModelOptions::default(), None);
    let lines = lines.expect("small");
    let options = RendererOptions::new(SIZE);
    let of_model = (&model, LineRenderer::new(&Processor, &lines));
    let mut renderer =
        Renderer::with_lines(&Processor, of_model, style, &options).expect("prepared");
    let frame = renderer.draw(&camera_at([6.0, 0.4, 0.0])).expect("drawn");
    let [width, height] = SIZE.map(|side| side as usize);
    let middle = (0..width * height)
        .filter(|i| (i % width).abs_diff(width / 2) < 24 && (i / width).abs_diff(height / 2) < 20);
    middle.filter(|i| frame.rgba[4 * i] < 100).count()
}

fn style(method: &str, from: &str) -> Style {
    let mut style = even_style("2px");
    for assignment in [
        format!("line.method={method}"),
        format!("line.crease_from={from}"),
        "line.color=\"#000000\"".to_owned(),
        "shade.mode=paper".to_owned(),
        "shade.paper=\"#ffffff\"".to_owned(),
        "shade.ramp=[{ at = 0.0, light = 1.0 }]".to_owned(),
    ] {
        style.set(&assignment).expect(&assignment);
    }
    style
}

#[test]
fn smooth_shading_has_no_folds_by_any_method() {
    let pillar = pillar(true);
    for method in [
        LineSource::Edges,
        LineSource::Surface,
        LineSource::Potrace,
        LineSource::Image,
    ] {
        let by_normals = drawn(&pillar, &style("shape", "normals"), method);
        let by_faces = drawn(&pillar, &style("shape", "faces"), method);
        assert!(
            by_faces > by_normals + 60.0,
            "{method:?}: {by_faces} and {by_normals} px"
        );
    }
    for method in ["shape", "strokes", "potrace", "filter"] {
        assert_eq!(
            ink_inside(&pillar, &style(method, "normals")),
            0,
            "{method}"
        );
        assert!(
            ink_inside(&pillar, &style(method, "faces")) > 20,
            "{method}"
        );
    }
}

#[test]
fn without_normals_every_fold_over_the_angle_is_drawn() {
    let pillar = pillar(false);
    for from in ["normals", "faces"] {
        assert!(
            drawn(&pillar, &style("shape", from), LineSource::Edges) > 60.0,
            "{from}"
        );
        for method in ["shape", "strokes"] {
            assert!(
                ink_inside(&pillar, &style(method, from)) > 20,
                "{method} {from}"
            );
        }
    }
    assert_eq!(LineOptions::new(SIZE).crease_from, CreaseFrom::Normals);
}
