//! Where thick lines bend, and what edges leave beside a line.

use super::fixture::{front, with};
use npr_core::math::{cos, sin};
use npr_mesh::Mesh;
use npr_mesh::testing::icosphere;
use npr_render::Model;
use npr_tests::{Ink, Object, Wanted, crossing_boxes, draw_from, lines, models_camera, placed};

/// A flat polygon with alternating radii, and its outline in the front view's frame of 200 pixels.
fn star(points: u32, radii: [f32; 2]) -> (Object, Vec<[f32; 2]>) {
    let corner = |i: u32| {
        let angle = std::f32::consts::TAU * i as f32 / points as f32;
        let radius = radii[i as usize % 2];
        [radius * cos(angle), radius * sin(angle), 0.0]
    };
    let mut positions: Vec<[f32; 3]> = (0..points).map(corner).collect();
    let outline = positions
        .iter()
        .map(|[x, y, _]| [(x + 1.0) * 100.0, (1.0 - y) * 100.0]);
    let outline = outline.collect();
    positions.push([0.0; 3]);
    let triangles = (0..points).map(|i| [i, (i + 1) % points, points]).collect();
    (
        Object::new("Star", Mesh::new(positions, triangles).unwrap()),
        outline,
    )
}

/// Number of pixels within `reach` of any corner, or of the outline, that hold no ink.
fn notches(ink: &Ink, outline: &[[f32; 2]], reach: f32) -> usize {
    let ends = |i: usize| [outline[i], outline[(i + 1) % outline.len()]];
    let wanted = Wanted::new((0..outline.len()).map(ends).collect());
    let pixels = (0..200).flat_map(|y| (0..200).map(move |x| (x, y)));
    let near = pixels.filter(|(x, y)| wanted.distance([*x as f32 + 0.5, *y as f32 + 0.5]) < reach);
    near.filter(|(x, y)| !ink.at(*x, *y)).count()
}

#[test]
fn thick_bends_have_no_notches() {
    for (points, radii) in [
        (10, [0.8, 0.45]),
        (5, [0.7, 0.7]),
        (3, [0.7, 0.7]),
        (32, [0.7, 0.7]),
    ] {
        let (object, outline) = star(points, radii);
        let notches = |method: &str| {
            let style = with(lines(method), &["line.width.base=20px"]);
            notches(
                &Ink::of(&front(std::slice::from_ref(&object), &style).frame),
                &outline,
                9.0,
            )
        };
        assert_eq!(notches("shape"), 0, "{points} corners");
        assert!(
            points > 10 || notches("okuya") > 20,
            "square ends leave notches at {points} corners"
        );
    }
}

#[test]
fn width_changes_smoothly_over_a_bend() {
    let (object, outline) = star(32, [0.7, 0.7]);
    // Wide on the right, narrow on the left.
    let reds: Vec<f32> = (0..33)
        .map(|i| {
            if i == 32 {
                0.0
            } else {
                0.5 + 0.5 * cos(std::f32::consts::TAU * i as f32 / 32.0)
            }
        })
        .collect();
    let settings = [
        "line.width.base=10px",
        "line.width.min=0.4",
        "line.width.max=2",
        "line.width.source=vertex-color",
    ];
    let ink = Ink::of(&front(&[object.painted(&reds)], &with(lines("shape"), &settings)).frame);
    let widths: Vec<f32> = outline
        .iter()
        .map(|corner| ink.thickness(*corner))
        .collect();
    assert!(widths[0] > 18.0 && widths[16] < 6.0, "{widths:?}");
    for pair in widths.windows(2) {
        assert!((pair[0] - pair[1]).abs() < 4.0, "{widths:?}");
    }
}

#[test]
fn interior_edges_leave_no_stubs_beside_the_line() {
    let ball = Object::new("Ball", placed(&icosphere(4), [0.7; 3], [0.0; 3]));
    let circle: Vec<[f32; 2]> = (0..=180)
        .map(|i| i as f32 * std::f32::consts::TAU / 180.0)
        .map(|angle| [100.0 + 70.0 * cos(angle), 100.0 + 70.0 * sin(angle)])
        .collect();
    let circle = Wanted::new(circle.windows(2).map(|ends| [ends[0], ends[1]]).collect());
    for scale in ["1", "3", "5"] {
        let farthest = |method: &str| {
            let style = with(
                lines(method),
                &["line.width.base=4px", &format!("detect.scale={scale}")],
            );
            Ink::of(&front(std::slice::from_ref(&ball), &style).frame).farthest_from(&circle)
        };
        let (ours, published) = (farthest("shape"), farthest("okuya"));
        assert!(ours <= 2.0 + 2.5, "{ours} px at mask scale {scale}");
        assert!(
            published > ours + 1.0,
            "{published} px as published at mask scale {scale}"
        );
    }
}

#[test]
fn lines_where_pieces_meet_are_unbroken() {
    let scene = crossing_boxes();
    let model = Model::new(&scene).unwrap();
    for size in [[640, 400], [320, 200], [1000, 700]] {
        let camera = models_camera(&model, size);
        let drawing = draw_from(&scene, &lines("shape"), &camera, size);
        // Where the upright box's side meets the front and the top of the other, without their ends.
        let meetings = [
            [[0.4, -0.27, 0.3], [0.4, 0.27, 0.3]],
            [[0.4, 0.3, -0.15], [0.4, 0.3, 0.25]],
        ];
        let wanted = Wanted::seen(&drawing.view, &meetings);
        let share = Ink::of(&drawing.frame).share_of(&wanted, 1.5);
        assert!(share > 0.97, "{share} of the lines at {size:?}");
    }
}
