use super::*;
use crate::lines::{LineModelOptions, LineOptions, LineSource};
use npr_core::camera::Camera;
use npr_scene::testing::limb;
use npr_scene::{LoadOptions, load};
use npr_stylesheet::Style;
use npr_vector::stroke::Drawing;
use std::path::Path;

const SIZE: [u32; 2] = [160, 120];

/// The lines that a camera of the whole scene sees, by a method.
fn drawn(model: &LineModel, camera: &Camera, style: &Style, method: LineSource) -> Drawing {
    let options = LineOptions {
        method,
        ..LineOptions::of_style(style, SIZE)
    };
    model.draw(camera, style, &options).expect("a drawing")
}

fn model_of(scene: &Scene, style: &Style) -> LineModel {
    LineModel::for_style(scene, style, &LineModelOptions::default(), None).expect("a model")
}

/// Asserts that a model that goes through poses draws the lines of models made of them, by every method on meshes and
/// by pixels.
fn assert_follows(name: &str, rest: &Scene, style: &Style, moments: &[(usize, f32)]) {
    let mut model = model_of(rest, style);
    let camera = model.framing(4.0 / 3.0, 0.7);
    let mut differ = 0;
    let at_rest = drawn(&model, &camera, style, LineSource::Edges);
    for (clip, time) in moments {
        let mut scene = rest.clone();
        scene
            .set_pose(&rest.pose_at(&rest.clips[*clip], *time))
            .expect("in range");
        model.set_pose(&scene).expect("the same scene");
        model.shape().sanity_check();
        let mut fresh = model_of(&scene, style);
        fresh.first_radius = Some(model.radius());
        assert!(
            fresh.shape == model.shape,
            "{name}: clip {clip} at {time} s: other shapes"
        );
        assert_eq!(
            (fresh.bounds(), fresh.cameras()),
            (model.bounds(), model.cameras())
        );
        for method in [
            LineSource::Edges,
            LineSource::Surface,
            LineSource::Image,
            LineSource::Potrace,
        ] {
            let [found, wanted] =
                [&model, &fresh].map(|model| drawn(model, &camera, style, method));
            assert!(
                found == wanted,
                "{name}: clip {clip} at {time} s, {method:?}"
            );
            differ += usize::from(method == LineSource::Edges && found != at_rest);
        }
    }
    assert!(differ > 0, "{name}: nothing moved");
    model.set_pose(rest).expect("the same scene");
    assert!(
        drawn(&model, &camera, style, LineSource::Edges) == at_rest,
        "{name} at rest"
    );
}

fn style(keys: &[&str]) -> Style {
    let mut style = Style::default();
    keys.iter().for_each(|key| style.set(key).expect("a key"));
    style
}

#[test]
fn lines_follow_a_pose_as_if_they_were_made_for_it() {
    let moments = [(0, 0.3), (0, 1.0), (1, 0.5), (0, 0.7), (1, 1.0)];
    for has_normals in [false, true] {
        let rest = limb(has_normals);
        for keys in [
            &[][..],
            &["line.width.source=curvature", "line.crease_angle_deg=20"],
        ] {
            assert_follows("limb", &rest, &style(keys), &moments);
        }
    }
}

#[test]
fn lines_of_shared_models_follow_their_clips() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/models");
    if !folder.is_dir() {
        eprintln!("skipped: the shared models are not beside this checkout");
        return;
    }
    let cases: [(&str, &[(usize, f32)]); 4] = [
        ("fox.glb", &[(1, 0.3), (2, 0.8)]),
        ("robot_animated.glb", &[(0, 1.1), (6, 0.5)]),
        ("rigged_figure.glb", &[(0, 0.6)]),
        ("animated_morph_cube.glb", &[(0, 1.0), (0, 2.5)]),
    ];
    for (name, moments) in cases {
        let rest = load(&folder.join(name), &LoadOptions::default()).expect("a model");
        assert_follows(name, &rest, &Style::default(), moments);
    }
}

#[test]
fn another_scene_is_refused_and_nothing_moves() {
    let mut model = model_of(&limb(true), &Style::default());
    let before = model.shape().clone();
    let mut other = limb(true);
    other.nodes[3].mesh = None;
    let fault = model.set_pose(&other).expect_err("another scene");
    assert_eq!(
        fault.to_string(),
        "the scene has 72 vertices, but the model was made of 76"
    );
    assert!(model.shape() == &before);
}
