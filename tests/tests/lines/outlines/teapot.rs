//! The teapot on a box before a plane [Okuya 2016, figures 10 and 11].

use super::fixture::detecting;
use npr_core::window::View;
use npr_render::Model;
use npr_scene::{Node, Part, Scene};
use npr_tests::{Ink, Wanted, asset, draw, lines, models_camera};

const FRAME: [u32; 2] = [960, 540];

fn scene() -> Scene {
    asset("teapot_box_plane.glb")
}

fn view(scene: &Scene) -> View {
    let model = Model::new(scene).unwrap();
    models_camera(&model, FRAME).view(FRAME, model.bounds())
}

/// The node and the only part of an object.
fn object<'a>(scene: &'a Scene, name: &str) -> (&'a Node, &'a Part) {
    scene
        .drawn_parts()
        .find(|(node, _)| node.name == name)
        .unwrap()
}

/// Edges of the box that its three seen faces have, as the camera sees them.
fn box_edges(scene: &Scene) -> Wanted {
    let (node, part) = object(scene, "Box");
    let corners = scene.positions_world(node, part);
    let (low, high) = extent(&part.positions);
    let corner = |at: [usize; 3]| {
        let local: [f32; 3] = std::array::from_fn(|i| [low, high][at[i]][i]);
        let nearest = |p: &&[f32; 3]| (0..3).all(|i| (p[i] - local[i]).abs() < 1e-4);
        let index = part.positions.iter().position(|p| nearest(&p)).unwrap();
        corners[index]
    };
    let edges = [
        [[0, 0, 1], [1, 0, 1]],
        [[0, 0, 1], [0, 1, 1]],
        [[1, 0, 1], [1, 1, 1]],
        [[0, 1, 1], [1, 1, 1]],
        [[1, 0, 1], [1, 0, 0]],
        [[1, 1, 1], [1, 1, 0]],
    ];
    Wanted::seen(&view(scene), &edges.map(|ends| ends.map(corner)))
}

fn extent(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let none = ([f32::MAX; 3], [f32::MIN; 3]);
    positions.iter().fold(none, |(low, high), p| {
        (
            std::array::from_fn(|i| low[i].min(p[i])),
            std::array::from_fn(|i| high[i].max(p[i])),
        )
    })
}

/// Points on the front of the circle in which the teapot stands on the box.
fn contact(scene: &Scene) -> Wanted {
    let (node, part) = object(scene, "Teapot");
    let world = scene.positions_world(node, part);
    let lowest = extent(&world).0[1];
    let foot: Vec<[f32; 3]> = world.into_iter().filter(|p| p[1] < lowest + 1e-4).collect();
    let center = |axis: usize| foot.iter().map(|p| p[axis]).sum::<f32>() / foot.len() as f32;
    let (x, z) = (center(0), center(2));
    let radius = |p: &[f32; 3]| (p[0] - x).hypot(p[2] - z);
    let widest = foot.iter().map(radius).fold(0.0, f32::max);
    let front = foot
        .iter()
        .filter(|p| p[2] > z + 0.3 * widest && radius(p) > 0.98 * widest);
    Wanted::seen(&view(scene), &front.map(|p| [*p, *p]).collect::<Vec<_>>())
}

/// Where parts of the teapot sink into each other.
fn joints(scene: &Scene) -> Ink {
    Ink::of(&draw(
        scene,
        &detecting("filter", &["line.kinds.intersection"]),
        FRAME,
    ))
}

fn share_inked(ink: &Ink, points: impl Iterator<Item = [f32; 2]>, reach: f32) -> f32 {
    let points: Vec<[f32; 2]> = points.collect();
    assert!(points.len() > 20, "{} points", points.len());
    let found = points.iter().filter(|point| ink.is_near(**point, reach));
    found.count() as f32 / points.len() as f32
}

#[test]
fn the_mask_holds_every_line_of_the_test_scene() {
    let scene = scene();
    let mask = Ink::of(&draw(&scene, &lines("filter"), FRAME));
    let joints = joints(&scene);
    let (spout, handle) = (|p: &[f32; 2]| p[0] > 560.0, |p: &[f32; 2]| p[0] < 390.0);
    assert_eq!(
        share_inked(&mask, joints.centers().filter(spout), 0.5),
        1.0,
        "body and spout"
    );
    assert_eq!(
        share_inked(&mask, joints.centers().filter(handle), 0.5),
        1.0,
        "body and handle"
    );
    assert_eq!(mask.share_of(&box_edges(&scene), 1.5), 1.0, "box edges");
    let found = mask.share_of(&contact(&scene), 2.5);
    assert!(found > 0.95, "teapot and box: {found}");
}

#[test]
fn our_drawing_holds_every_line_of_the_test_scene() {
    let scene = scene();
    let ink = Ink::of(&draw(&scene, &lines("shape"), FRAME));
    assert!(
        share_inked(&ink, joints(&scene).centers(), 1.5) > 0.99,
        "joints"
    );
    assert_eq!(ink.share_of(&box_edges(&scene), 1.5), 1.0, "box edges");
    let found = ink.share_of(&contact(&scene), 2.5);
    assert!(found > 0.95, "teapot and box: {found}");
}

#[test]
fn the_hull_misses_the_joints_and_the_union_leaves_them_thin() {
    let scene = scene();
    let joints = joints(&scene);
    let on_spout = || {
        joints
            .centers()
            .filter(|p| p[0] > 560.0 && p[1] > 222.0 && p[1] < 270.0)
    };
    let [hull, union, ours] = ["hull", "filter+hull", "shape"].map(|method| {
        let mut style = lines(method);
        style.set("line.width.base=6px").unwrap();
        Ink::of(&draw(&scene, &style, FRAME))
    });
    assert!(share_inked(&hull, on_spout(), 0.5) < 0.1);
    let thickness = |ink: &Ink| {
        let mut widths: Vec<f32> = on_spout().map(|p| ink.thickness(p)).collect();
        widths.sort_by(f32::total_cmp);
        widths[widths.len() / 2]
    };
    let [thin, thick] = [thickness(&union), thickness(&ours)];
    assert!(
        thin <= 2.5 && thick >= 4.5,
        "{thin} px in the union, {thick} in ours"
    );
}
