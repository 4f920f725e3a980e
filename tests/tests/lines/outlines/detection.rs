//! Which lines are found, and on which buffers.

use super::fixture::{
    SIZE, corner_camera, cube_before_plane, cube_creases, cube_drawing, cube_front_silhouette,
    cube_other_silhouette, cube_wanted, detecting, front_camera, parts_scene, with,
};
use npr_core::camera::Camera;
use npr_core::math::{cos, sin};
use npr_mesh::Mesh;
use npr_mesh::testing::{mapped, plane};
use npr_scene::{Node, Scene};
use npr_tests::{Ink, Wanted, draw_from, lines};

/// Half the mask's thickness and the steps of its pixels.
const MASK_REACH: f32 = 2.0;

const ALL_TESTS: [&str; 5] = [
    "detect.depth.on",
    "detect.normal.on",
    "detect.object.on",
    "detect.material.on",
    "line.kinds.intersection",
];

/// The part of a plane larger than the frame between two x, at height `z`, tilted about the y axis by `angle`.
fn strip(x: [f32; 2], z: f32, angle: f32) -> Mesh {
    mapped(&plane(1, 1), |[u, v, _]| {
        let along = x[0] + (x[1] - x[0]) * u;
        [along * cos(angle), 4.0 * v - 2.0, z + along * sin(angle)]
    })
}

/// Two strips that share an edge, folded by `angle` each.
fn folded(angle: f32) -> Mesh {
    mapped(&plane(2, 1), |[u, v, _]| {
        let along = 6.0 * u - 3.0;
        [along * cos(angle), 4.0 * v - 2.0, -along.abs() * sin(angle)]
    })
}

/// Two objects of one material.
fn two_objects(left: Mesh, right: Mesh) -> Scene {
    let mut scene = parts_scene(&[(left, 0)]);
    scene.meshes.extend(parts_scene(&[(right, 0)]).meshes);
    scene.nodes.push(Node {
        mesh: Some(1),
        ..Node::default()
    });
    scene
}

/// A scene for each test of [`ALL_TESTS`] with one line that this test alone can find.
fn scenes_of_one_line() -> [Scene; 5] {
    let (left, right) = ([-3.0, 0.02], [0.02, 3.0]);
    [
        parts_scene(&[
            (strip(left, 0.0, 0.0), 0),
            (strip([-3.0, 3.0], -1.0, 0.0), 0),
        ]),
        parts_scene(&[(folded(0.4), 0)]),
        two_objects(strip(left, 0.0, 0.0), strip(right, 0.0, 0.0)),
        parts_scene(&[(strip(left, 0.0, 0.0), 0), (strip(right, 0.0, 0.0), 1)]),
        parts_scene(&[
            (strip([-3.0, 3.0], 0.0, 0.2), 0),
            (strip([-3.0, 3.0], 0.0, -0.2), 0),
        ]),
    ]
}

fn mask_of(scene: &Scene, tests: &[&str]) -> Ink {
    let style = detecting("filter", tests);
    Ink::of(&draw_from(scene, &style, &front_camera(), [120, 120]).frame)
}

#[test]
fn each_buffer_finds_its_own_line_and_can_be_switched_off() {
    for (test, scene) in ALL_TESTS.into_iter().zip(scenes_of_one_line()) {
        let others: Vec<&str> = ALL_TESTS
            .into_iter()
            .filter(|other| *other != test)
            .collect();
        assert!(mask_of(&scene, &[test]).count() >= 120, "{test} alone");
        assert_eq!(mask_of(&scene, &others).count(), 0, "all but {test}");
    }
}

#[test]
fn the_mask_alone_is_uniform() {
    let filter = lines("filter");
    let drawing = cube_drawing(&filter);
    let (ink, wanted) = (Ink::of(&drawing.frame), cube_wanted(&drawing.view));
    assert!(ink.farthest_from(&wanted) <= MASK_REACH);
    for [a, b] in wanted.segments() {
        let middle: [f32; 2] = std::array::from_fn(|i| (a[i] + b[i]) * 0.5);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let normal = [(a[1] - b[1]) / length, (b[0] - a[0]) / length];
        let width = (-2..=2).map(|k| {
            ink.run(
                [0, 1].map(|i| middle[i] + normal[i] * k as f32 * 0.5),
                normal,
            )
        });
        let width = width.fold(0.0, f32::max);
        assert!((1.5..=3.5).contains(&width), "{width} px at {middle:?}");
    }
    // No setting of width reaches the mask.
    let wide = with(
        filter,
        &["line.width.base=12px", "line.width.source=curvature"],
    );
    assert_eq!(cube_drawing(&wide).frame.rgba, drawing.frame.rgba);
}

#[test]
fn depth_alone_misses_the_front_creases() {
    let drawing = cube_drawing(&detecting("filter", &["detect.depth.on"]));
    let (ink, view) = (Ink::of(&drawing.frame), &drawing.view);
    let silhouette = cube_front_silhouette(view).and(cube_other_silhouette(view));
    assert_eq!(ink.share_of(&silhouette, MASK_REACH), 1.0);
    assert!(ink.share_of(&cube_creases(view), MASK_REACH) < 0.1);
}

#[test]
fn normals_alone_miss_boundary_pixels() {
    let drawing = cube_drawing(&detecting("filter", &["detect.normal.on"]));
    let (ink, view) = (Ink::of(&drawing.frame), &drawing.view);
    let found = cube_creases(view).and(cube_other_silhouette(view));
    assert!(ink.share_of(&found, MASK_REACH) > 0.99);
    assert!(ink.share_of(&cube_front_silhouette(view), MASK_REACH) < 0.1);
}

#[test]
fn the_union_is_the_wanted_drawing() {
    for method in ["filter", "okuya", "shape"] {
        let style = detecting(method, &["detect.depth.on", "detect.normal.on"]);
        let drawing = cube_drawing(&style);
        let (ink, wanted) = (Ink::of(&drawing.frame), cube_wanted(&drawing.view));
        assert_eq!(ink.share_of(&wanted, 1.5), 1.0, "{method} leaves gaps");
        let apart = ink.farthest_from(&wanted);
        assert!(apart <= MASK_REACH + 0.25, "{method} inks {apart} px away");
    }
}

#[test]
fn each_buffer_has_its_own_threshold() {
    let fold = parts_scene(&[(folded(0.52), 0)]);
    let step = parts_scene(&[
        (strip([-3.0, 0.0], 0.0, 0.0), 0),
        (strip([-3.0, 3.0], -0.1, 0.0), 0),
    ]);
    let found = |scene: &Scene, test: &str, setting: &str| {
        let style = with(detecting("filter", &[test]), &[setting]);
        Ink::of(&draw_from(scene, &style, &front_camera(), [120, 120]).frame).count() > 0
    };
    // The faces meet at 1.04 rad, 60 degrees; the step is 0.05 of the frame's height.
    assert!(found(
        &fold,
        "detect.normal.on",
        "detect.normal.threshold_deg=55"
    ));
    assert!(!found(
        &fold,
        "detect.normal.on",
        "detect.normal.threshold_deg=65"
    ));
    assert!(found(
        &step,
        "detect.depth.on",
        "detect.depth.threshold=0.04"
    ));
    assert!(!found(
        &step,
        "detect.depth.on",
        "detect.depth.threshold=0.06"
    ));
}

#[test]
fn creases_can_be_switched_off() {
    // All three faces are seen well, so that nothing but the setting keeps their creases away.
    let camera = Camera {
        eye: [4.0, 4.0, 4.0],
        ..corner_camera()
    };
    let style = with(lines("shape"), &["line.kinds.crease=false"]);
    let drawing = draw_from(&cube_before_plane(), &style, &camera, SIZE);
    let (ink, view) = (Ink::of(&drawing.frame), &drawing.view);
    assert!(ink.count() > 300);
    let left = ink.share_of(&cube_creases(view), 1.5);
    assert!(left < 0.1, "{left} of the creases are drawn");
}

/// A face that ends in a strip seen almost from the side, 0.9 pixels wide and 50 deep in a frame of 200, turned in the
/// picture by `angle`; with the four sides of both together.
fn bent_away(angle: f32) -> (Mesh, Wanted) {
    let turned = |x: f32, y: f32| {
        [
            x * cos(angle) - y * sin(angle),
            x * sin(angle) + y * cos(angle),
        ]
    };
    let mesh = mapped(&plane(2, 1), |[u, v, _]| {
        let [x, z] = match u {
            u if u < 0.25 => [-0.6, 0.0],
            u if u < 0.75 => [0.3, -0.1],
            _ => [0.309, -0.6],
        };
        let [x, y] = turned(x, 1.2 * v - 0.6);
        [x, y, z]
    });
    let corners = [[-0.6, -0.6], [0.309, -0.6], [0.309, 0.6], [-0.6, 0.6]];
    let corners = corners.map(|[x, y]| {
        let [x, y] = turned(x, y);
        [(x + 1.0) * 100.0, (1.0 - y) * 100.0]
    });
    let sides = (0..4).map(|i| [corners[i], corners[(i + 1) % 4]]);
    (mesh, Wanted::new(sides.collect()))
}

#[test]
fn a_rim_that_bends_away_has_no_specks() {
    // As wide as a mask pixel or two: what is drawn beside the outline does not lie under it.
    let settings = ["line.width.base=1.5px", "line.kinds.crease=false"];
    let style = with(lines("shape"), &settings);
    for step in 0..24 {
        let (mesh, wanted) = bent_away(0.065 * step as f32);
        let frame = draw_from(
            &parts_scene(&[(mesh, 0)]),
            &style,
            &front_camera(),
            [200, 200],
        )
        .frame;
        let ink = Ink::of(&frame);
        assert!(ink.share_of(&wanted, 1.5) > 0.99, "step {step}");
        let apart = ink.farthest_from(&wanted);
        assert!(
            apart < 1.25,
            "step {step}: ink {apart} px beside the outline"
        );
    }
}
