//! What hulls and image filters cannot draw, whatever they are set to: the scenes and figures of `docs/limits.md`.

use super::fixture::with;
use npr_core::camera::Camera;
use npr_core::window::View;
use npr_mesh::testing::unindexed;
use npr_render::Model;
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Ink, Object, Wanted, asset, boxed, draw, lines, models_camera, scene_of};

const FRAME: [u32; 2] = [640, 360];

fn camera(scene: &Scene) -> (Camera, View) {
    let model = Model::new(scene).unwrap();
    let camera = models_camera(&model, FRAME);
    (camera, camera.view(FRAME, model.bounds()))
}

/// The edges of the box from -1 to 1 between a side that the camera sees and one that it does not.
fn silhouette(scene: &Scene) -> Wanted {
    let (camera, view) = camera(scene);
    let is_seen = |axis: usize, sign: f32| camera.eye[axis] * sign > 1.0;
    let mut edges = Vec::new();
    for axis in 0..3 {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        for (at_u, at_v) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
            if is_seen(u, at_u) != is_seen(v, at_v) {
                edges.push([-1.0, 1.0].map(|at| {
                    let mut corner = [at; 3];
                    (corner[u], corner[v]) = (at_u, at_v);
                    corner
                }));
            }
        }
    }
    assert_eq!(edges.len(), 6, "a box from three quarters has six of them");
    Wanted::seen(&view, &edges)
}

/// Share of the silhouette of a box with ink beside it, and how many pieces the ink falls into.
fn outlined(scene: &Scene, method: &str) -> (f32, usize) {
    let style = with(lines(method), &["line.width.base=16px"]);
    let ink = Ink::of(&draw(scene, &style, FRAME));
    (
        ink.share_of(&silhouette(scene), 2.0),
        ink.components().len(),
    )
}

#[test]
fn a_hull_tears_between_objects_and_lines_on_shapes_do_not() {
    let scene = asset("split_box.obj");
    let (share, pieces) = outlined(&scene, "hull");
    assert!(
        share < 0.95 && pieces == 3,
        "{share} of the outline, {pieces} pieces"
    );
    for method in ["strokes", "shape"] {
        assert_eq!(outlined(&scene, method), (1.0, 1), "{method}");
    }
}

/// Vertices that a file holds once for each side are one to the hull, where they are of one object.
#[test]
fn a_hull_does_not_tear_at_split_vertices_of_one_object() {
    let split = unindexed(&boxed([-1.0; 3], [1.0; 3]));
    assert_eq!(split.positions().len(), 36, "no triangle shares a vertex");
    let scene = scene_of(&[Object::new("Box", split)]);
    assert_eq!(outlined(&scene, "hull"), (1.0, 1));
}

/// What a drawing has of the scene of steps.
#[derive(Debug)]
struct Steps {
    /// Share of the edges of the panel with a line.
    panel: f32,
    /// Share of the floor before board and ball that is inked.
    floor: f32,
    /// Share of the ball within its outline that is inked.
    ball: f32,
}

impl Steps {
    fn of(scene: &Scene, style: &Style) -> Self {
        let ink = Ink::of(&draw(scene, style, FRAME));
        let (_, view) = camera(scene);
        let px = |point: [f32; 3]| Wanted::seen(&view, &[[point; 2]]).segments()[0][0];
        let corners = [[-0.13, 0.03], [-0.05, 0.03], [-0.05, 0.13], [-0.13, 0.13]];
        let corner = |i: usize| [corners[i % 4][0], corners[i % 4][1], 0.0102];
        let edges = [0, 1, 2, 3].map(|i| [corner(i), corner(i + 1)]);

        // Look at the ball without its rim, and at the floor below all that stands on it.
        let (middle, side) = (px([0.09, 0.06, 0.0]), px([0.15, 0.06, 0.0]));
        let radius = 0.85 * (side[0] - middle[0]);
        let rows = 300.0;
        let in_ball = |p: &[f32; 2]| (p[0] - middle[0]).hypot(p[1] - middle[1]) < radius;
        let [width, height] = FRAME.map(|side| side as f32);
        let share = |count: usize, area: f32| count as f32 / area;
        Self {
            panel: ink.share_of(&Wanted::seen(&view, &edges), 1.5),
            floor: share(
                ink.centers().filter(|p| p[1] > rows).count(),
                width * (height - rows),
            ),
            ball: share(
                ink.centers().filter(in_ball).count(),
                std::f32::consts::PI * radius * radius,
            ),
        }
    }

    /// All of the panel, and hardly any ink where there is no line.
    fn is_good(&self) -> bool {
        self.panel > 0.95 && self.floor < 0.005 && self.ball < 0.005
    }
}

/// Thresholds in steps of four tenths, from less than a hundredth of that of the panel to beyond any in the scene.
fn thresholds() -> impl Iterator<Item = f32> {
    (0..32).map(|i| 1e-5 * 1.4f32.powi(i))
}

/// The table of `docs/limits.md`: whether depths are compared with planes, the threshold, and the shares.
const TABLE: [(bool, f32, f32, f32, f32); 6] = [
    (false, 0.0003, 1.0, 1.0, 1.0),
    (false, 0.0013, 0.02, 1.0, 0.63),
    (false, 0.01, 0.02, 0.0, 0.0),
    (true, 0.0003, 1.0, 0.0, 0.07),
    (true, 0.0006, 0.78, 0.0, 0.02),
    (true, 0.0013, 0.02, 0.0, 0.0),
];

#[test]
fn no_threshold_of_a_filter_suits_the_whole_picture() {
    let scene = asset("steps.glb");
    let drawn = |method: &str, planes: bool, threshold: f32| {
        let settings = [
            format!("detect.plane_depth={planes}"),
            format!("detect.depth.threshold={threshold}"),
        ];
        let style = with(lines(method), &settings.each_ref().map(String::as_str));
        Steps::of(&scene, &style)
    };
    for planes in [false, true] {
        let all: Vec<Steps> = thresholds()
            .map(|threshold| drawn("filter", planes, threshold))
            .collect();
        assert!(
            all.iter().all(|steps| !steps.is_good()),
            "{planes}: {all:#?}"
        );
        // Each place by itself has a threshold that suits it.
        assert!(all.iter().any(|steps| steps.panel > 0.95), "{all:#?}");
        assert!(
            all.iter()
                .any(|steps| steps.floor < 0.005 && steps.ball < 0.005),
            "{all:#?}"
        );
    }
    for (planes, threshold, panel, floor, ball) in TABLE {
        let steps = drawn("filter", planes, threshold);
        let apart = [steps.panel - panel, steps.floor - floor, steps.ball - ball];
        let is_as_told = apart.iter().all(|apart| apart.abs() < 0.01);
        assert!(is_as_told, "{planes} {threshold}: {steps:?}");
    }

    // Shapes have the lines that the mask shows, of edges alone, so a low threshold costs nothing.
    let [low, usual] = [3e-4, 0.012].map(|threshold| drawn("shape", true, threshold));
    assert!(low.is_good(), "{low:?}");
    assert!(usual.panel < 0.1, "{usual:?}");

    // Strokes need no threshold.
    let strokes = Steps::of(&scene, &lines("strokes"));
    assert!(strokes.is_good(), "{strokes:?}");
}
