//! The published drawing, on triangles whose picture is known.

use super::fixture::{front, with};
use npr_core::camera::{Camera, Projection};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::{Edge, EdgeRole, GPixel, Part, PosedVertex, Triangle};
use npr_core::outline::Outline;
use npr_core::window::Window;
use npr_mesh::Mesh;
use npr_mesh::testing::{mapped, plane};
use npr_stylesheet::Style;
use npr_tests::{Ink, Object, Wanted, lines};

const CORNERS: [[f32; 3]; 3] = [[-0.6, -0.5, 0.0], [0.6, -0.5, 0.0], [0.0, 0.6, 0.0]];

/// Edges of the triangle by corner.
const EDGES: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

fn triangle() -> Object {
    Object::new(
        "Triangle",
        Mesh::new(CORNERS.to_vec(), vec![[0, 1, 2]]).unwrap(),
    )
}

/// The published method with lines 16 pixels wide.
fn thick() -> Style {
    with(lines("okuya"), &["line.width.base=16px"])
}

/// Where a point of the front view lies in its frame of 200 pixels.
fn px([x, y, _]: [f32; 3]) -> [f32; 2] {
    [(x + 1.0) * 100.0, (1.0 - y) * 100.0]
}

/// A point of an edge, and its unit normal.
fn point_of(edge: [usize; 2], t: f32) -> ([f32; 2], [f32; 2]) {
    let [a, b] = edge.map(|corner| px(CORNERS[corner]));
    let length = (b[0] - a[0]).hypot(b[1] - a[1]);
    let along = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
    let point = std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t);
    (point, [-along[1], along[0]])
}

#[test]
fn back_faces_draw_nothing() {
    // A double-sided sheet fills the mask from behind, and no edge of it is drawn.
    let sheet = mapped(&plane(2, 2), |[u, v, _]| [0.5 - u, v - 0.5, 0.0]);
    let sheet = [Object::new("Sheet", sheet).double_sided()];
    assert!(Ink::of(&front(&sheet, &lines("filter")).frame).count() > 300);
    assert_eq!(Ink::of(&front(&sheet, &thick()).frame).count(), 0);
}

#[test]
fn width_runs_linearly_from_twice_t0_to_twice_t1() {
    let widths = [4.0, 16.0, 16.0];
    let settings = [
        "line.width.base=10px",
        "line.width.min=0.4",
        "line.width.max=1.6",
        "line.width.source=vertex-color",
    ];
    let style = with(lines("okuya"), &settings);
    let ink = Ink::of(&front(&[triangle().painted(&[0.0, 1.0, 1.0])], &style).frame);
    for edge in EDGES {
        for t in [0.2, 0.35, 0.5, 0.65, 0.8] {
            // Runs around the point even out the steps of the pixels.
            let runs = (-4..=4).map(|k| {
                let (point, normal) = point_of(edge, t + 0.01 * k as f32);
                ink.run(point, normal)
            });
            let have = runs.sum::<f32>() / 9.0;
            let want = widths[edge[0]] * (1.0 - t) + widths[edge[1]] * t;
            assert!(
                (have - want).abs() <= 0.75,
                "edge {edge:?} at {t}: {have} px, not {want}"
            );
        }
    }
}

#[test]
fn ink_lies_as_far_to_either_side_of_the_edge() {
    let ink = Ink::of(&front(&[triangle()], &thick()).frame);
    for edge in EDGES {
        let (point, normal) = point_of(edge, 0.5);
        for side in [-1.0, 1.0] {
            let at = |away: f32| [0, 1].map(|i| (point[i] + normal[i] * away * side) as i32);
            let [inside, outside] = [at(6.5), at(9.5)];
            assert!(ink.at(inside[0], inside[1]) && !ink.at(outside[0], outside[1]));
        }
    }
}

#[test]
fn quads_end_square_at_the_end_points() {
    // Five pixels beyond the left corner, straight away from both of its edges.
    let corner = px(CORNERS[0]);
    let beyond = [corner[0] - 4.3, corner[1] + 2.6].map(|v| v as i32);
    let inked =
        |style: &Style| Ink::of(&front(&[triangle()], style).frame).at(beyond[0], beyond[1]);
    assert!(!inked(&thick()));
    assert!(
        inked(&with(lines("shape"), &["line.width.base=16px"])),
        "ours ends round"
    );
}

#[test]
fn only_references_on_the_mask_are_inked() {
    // The diagonal of a flat sheet has no mask under it; its border has.
    let sheet = mapped(&plane(1, 1), |[u, v, _]| {
        [1.2 * u - 0.6, 1.2 * v - 0.6, 0.0]
    });
    let ink = Ink::of(&front(&[Object::new("Sheet", sheet)], &thick()).frame);
    let corner = |x: f32, y: f32| px([x, y, 0.0]);
    let corners = [
        corner(-0.6, -0.6),
        corner(0.6, -0.6),
        corner(0.6, 0.6),
        corner(-0.6, 0.6),
    ];
    let border = Wanted::new((0..4).map(|i| [corners[i], corners[(i + 1) % 4]]).collect());
    assert!(
        ink.farthest_from(&border) < 8.0 + 2.5,
        "half the width and the mask's own"
    );
    // A pixel far off the mask is inked, because the mask is looked up at the edge.
    assert!(ink.at(100, 40 - 6) && ink.at(100, 40 + 6));
}

#[test]
fn ink_has_the_color_that_the_style_gives() {
    let style = with(thick(), &["line.color=#1040c0", "shade.mode=flat"]);
    let red = triangle().colored([1.0, 0.0, 0.0]);
    let frame = front(&[red], &style).frame;
    let pixel = |x: usize, y: usize| &frame.rgba[(y * 200 + x) * 4..][..4];
    assert_eq!(pixel(100, 150), [0x10, 0x40, 0xc0, 255]);
    assert_eq!(pixel(100, 110), [255, 0, 0, 255]);
}

/// A folded pair of triangles in clip space, and its five unique edges.
fn pair() -> ([PosedVertex; 4], [Triangle; 2], [Edge; 5]) {
    let vertex = |x: f32, y: f32, half_width: f32| PosedVertex {
        clip: [x, y, 0.5, 1.0],
        depth: 10.0,
        half_width,
        ..PosedVertex::default()
    };
    let posed = [
        vertex(-0.5, -0.6, 2.0),
        vertex(0.4, -0.5, 6.0),
        vertex(0.5, 0.6, 3.0),
        vertex(-0.6, 0.4, 5.0),
    ];
    let triangles = [[0, 1, 2], [0, 2, 3]].map(|corners| Triangle { corners, part: 0 });
    let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 0]].map(|ends| Edge {
        ends,
        faces: [0, 1],
        ..Edge::default()
    });
    (posed, triangles, edges)
}

/// The published ribbons of edges over a mask that is set everywhere.
fn ribbons(edges: &[Edge]) -> Vec<u32> {
    let size = [120, 120];
    let (posed, ..) = pair();
    let camera = Camera {
        eye: [0.0, 0.0, 10.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 2.0 },
    };
    let window = Window::over([120.0; 2], [0.0; 2], [120.0; 2], size);
    let drawing = npr_vector::screen::ribbon::Drawing {
        view: &camera.view(size, ([-1.0; 3], [1.0; 3])),
        window: &window,
        mask_window: &window,
        outline: &Outline {
            flags: Outline::PUBLISHED,
            ..Outline::default()
        },
        posed: &posed,
        parts: &[Part {
            line_color: [0.0, 0.0, 0.0, 1.0],
            ..Part::default()
        }],
        gbuffer: &[GPixel::EMPTY; 120 * 120],
        mask: &[Outline::NORMAL; 120 * 120],
        tints: &[],
    };
    let (mut layer, mut keys) = (vec![0; 120 * 120], vec![0; 120 * 120]);
    let role = EdgeRole {
        kinds: EdgeFlags::FACING.0,
        part: 0,
    };
    let roles = vec![role; edges.len()];
    npr_vector::screen::ribbon::draw(&drawing, edges, &roles, &mut layer, &mut keys);
    layer
}

#[test]
fn a_shared_edge_drawn_once_gives_the_picture_of_both_triangles() {
    let (_, triangles, unique) = pair();
    let per_triangle: Vec<Edge> = triangles
        .iter()
        .flat_map(|triangle| (0..3).map(|i| [triangle.corners[i], triangle.corners[(i + 1) % 3]]))
        .map(|ends| Edge { ends, ..unique[0] })
        .collect();
    assert_eq!(per_triangle.len(), unique.len() + 1);
    let once = ribbons(&unique);
    assert!(once.iter().filter(|texel| **texel >> 24 == 255).count() > 1000);
    let apart = once
        .iter()
        .zip(ribbons(&per_triangle))
        .map(|(a, b)| (a >> 24).abs_diff(b >> 24))
        .max();
    assert!(
        apart <= Some(1),
        "rounding of the edge turned round: {apart:?}"
    );
}
