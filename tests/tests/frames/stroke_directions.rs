//! Where strokes get their directions from, on the processor: vertices, objects, light.

use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Model, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_tests::comic::{SIZE, direction, draw, front, style, wall};
use npr_tests::{Object, scene_of};

/// Even, half dark: nothing but the direction of strokes counts.
const HALF_DARK: [&str; 2] = ["ink.tone=ink+hatch", "light.direction=[0,0.9,0.1]"];

fn walls() -> Scene {
    scene_of(&[Object::new("Wall", wall(1.5, 0.0))])
}

/// 1 where strokes in the middle of a picture stand upright, -1 where they lie level.
fn upright(frame: &Frame) -> f32 {
    direction(frame, 80..240, 60..180)[0]
}

fn drawn(scene: &Scene, settings: &[&str]) -> Frame {
    draw(scene, &[&HALF_DARK, settings].concat())
}

#[test]
fn strokes_follow_the_attribute_of_the_file() {
    for (painted, is_upright) in [([0.0, -3.0, 0.0], true), ([1.0, 0.0, 0.0], false)] {
        let mut scene = walls();
        let part = &mut scene.meshes[0].parts[0];
        part.directions = Some(vec![painted; part.positions.len()]);
        let frame = drawn(&scene, &["ink.follow=attribute"]);
        assert_eq!(upright(&frame) > 0.0, is_upright, "{}", upright(&frame));
        assert!(upright(&frame).abs() > 0.6, "{}", upright(&frame));
        assert!(frame.notices.is_empty(), "{:?}", frame.notices);
    }
}

#[test]
fn strokes_follow_vertex_colors() {
    for (color, is_upright) in [([0.5, 1.0, 0.5, 1.0], true), ([0.0, 0.5, 0.5, 1.0], false)] {
        let mut scene = walls();
        let part = &mut scene.meshes[0].parts[0];
        part.colors = Some(vec![color; part.positions.len()]);
        let frame = drawn(&scene, &["ink.follow=vertex-color"]);
        assert_eq!(upright(&frame) > 0.0, is_upright, "{}", upright(&frame));
        assert!(upright(&frame).abs() > 0.6, "{}", upright(&frame));
    }
}

#[test]
fn strokes_run_along_the_second_uv_coordinate() {
    for swapped in [false, true] {
        let mut scene = walls();
        let part = &mut scene.meshes[0].parts[0];
        // Along y of the picture, or along x where the axes are swapped.
        let uv = |p: &[f32; 3]| {
            if swapped { [p[1], p[0]] } else { [p[0], p[1]] }
        };
        part.uvs = Some(part.positions.iter().map(uv).collect());
        let frame = drawn(&scene, &["ink.mapping=uv"]);
        assert_eq!(upright(&frame) > 0.0, !swapped, "{}", upright(&frame));
        assert!(upright(&frame).abs() > 0.6, "{}", upright(&frame));
        assert!(frame.notices.is_empty(), "{:?}", frame.notices);
    }
}

#[test]
fn parts_that_say_nothing_are_told_of_once() {
    for follow in ["attribute", "vertex-color"] {
        let frame = drawn(&walls(), &[&format!("ink.follow={follow}")]);
        assert_eq!(
            frame.notices,
            ["hatching follows the surface of 'Wall' and others: their vertices say no directions"]
        );
        let plain = drawn(&walls(), &["ink.follow=around"]);
        assert_eq!(frame.rgba, plain.rgba);
    }
}

#[test]
fn a_direction_turns_with_its_object() {
    let mut scene = walls();
    let quarter = &mut scene.nodes[0].world_from_node;
    quarter[0] = [0.0, 1.0, 0.0, 0.0];
    quarter[1] = [-1.0, 0.0, 0.0, 0.0];
    for (space, is_upright) in [("object", true), ("world", false)] {
        let space = format!("ink.direction_space={space}");
        let frame = drawn(&scene, &["ink.direction=[1,0,0]", &space]);
        assert_eq!(upright(&frame) > 0.0, is_upright, "{}", upright(&frame));
        assert!(upright(&frame).abs() > 0.6, "{}", upright(&frame));
    }
}

#[test]
fn strokes_run_towards_the_light_on_surface_and_picture() {
    for mapping in ["surface", "screen"] {
        let mapping = format!("ink.mapping={mapping}");
        for (light, is_upright) in [("[0,0.9,0.1]", true), ("[0.9,0,0.1]", false)] {
            for space in ["world", "camera"] {
                let light = format!("light.direction={light}");
                let space = format!("light.space={space}");
                let frame = drawn(&walls(), &["ink.follow=light", &light, &space, &mapping]);
                let got = upright(&frame);
                assert_eq!(got > 0.0, is_upright, "{mapping} {light} {space}: {got}");
                assert!(got.abs() > 0.6, "{mapping} {light} {space}: {got}");
            }
        }
    }
}

#[test]
fn strokes_turn_with_a_light_on_the_camera_and_stay_with_one_in_the_scene() {
    let tilted = Camera {
        up: [1.0, 1.0, 0.0],
        ..front()
    };
    for (space, turns) in [("world", true), ("camera", false)] {
        let model = Model::new(&walls()).unwrap();
        let space = format!("light.space={space}");
        let settings = [&HALF_DARK[..], &["ink.follow=light", &space]].concat();
        let options = RendererOptions::new(SIZE);
        let mut renderer = Renderer::new(&Processor, &model, &style(&settings), &options).unwrap();
        let straight = renderer.draw(&front()).unwrap();
        let rolled = renderer.draw(&tilted).unwrap();
        let again = renderer.draw(&front()).unwrap();
        assert_eq!(straight.rgba, again.rgba, "{space}");
        assert!(upright(&straight) > 0.6, "{space}");
        // By an eighth of a turn, strokes of the scene lie askew.
        let slant = direction(&rolled, 80..240, 60..180)[1].abs();
        assert_eq!(slant > 0.6, turns, "{space}: {slant}");
    }
}

#[test]
fn strokes_point_at_a_light_nearby() {
    // A lamp above the middle of the wall: strokes fan out from it.
    let lamp = [
        "ink.tone=ink+hatch",
        "light.intensity=0",
        "ink.follow=light",
        "light.extra=[{ position=[0.0, 0.0, 1.0], intensity=0.55 }]",
    ];
    let frame = draw(&walls(), &lamp);
    let beside = |x: std::ops::Range<u32>, y: std::ops::Range<u32>| direction(&frame, x, y);
    let [above, _] = beside(140..180, 20..60);
    let [right, _] = beside(240..280, 100..140);
    assert!(above > 0.4 && right < -0.4, "{above} {right}");
}

#[test]
fn nothing_and_no_light_are_no_trouble() {
    let settings = [
        "ink.tone=ink+hatch",
        "ink.follow=light",
        "light.intensity=0",
    ];
    for scene in [
        Scene::default(),
        walls(),
        scene_of(&[Object::new("Ball", icosphere(1))]),
    ] {
        assert_eq!(draw(&scene, &settings).size, SIZE);
    }
    let mut bare = walls();
    bare.meshes[0].parts[0].triangles.clear();
    for follow in ["light", "attribute", "vertex-color"] {
        drawn(&bare, &[&format!("ink.follow={follow}")]);
    }
}
