//! Lines from a picture of the surfaces, and lines painted in textures.

use crate::scenes::{SIZE, add, camera_at, even_style, scene_of};
use npr_core::camera::Camera;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{cube, icosphere, mapped, torus};
use npr_render::{
    Drawing, Kind, KindSet, LineModel, LineModelOptions, LineOptions, LineRenderer, LineSource,
    PaintedLines,
};
use npr_scene::{Image, Material, Mesh, Node, Part, Scene, TextureTransform, TextureUse, Wrap};
use npr_stylesheet::Style;
use npr_vector::stroke::{Stroke, StrokePoint};

fn model_of(scene: &Scene, painted: bool) -> LineModel {
    let options = LineModelOptions {
        painted,
        ..LineModelOptions::default()
    };
    LineModel::for_style(scene, &Style::default(), &options, None).expect("small")
}

fn drawn(model: &LineModel, camera: &Camera, options: &LineOptions) -> Drawing {
    let style = even_style("2px");
    model.draw(camera, &style, options).expect("drawn")
}

fn with(method: LineSource) -> LineOptions {
    LineOptions {
        method,
        ..LineOptions::new(SIZE)
    }
}

fn length(drawing: &Drawing) -> f64 {
    drawing.strokes.iter().map(|stroke| stroke.length()).sum()
}

/// A cube that cuts through a ball, and a ring behind them.
fn group() -> Scene {
    let mut scene = scene_of(&cube());
    let moved = |mesh: &npr_mesh::Mesh, by: [f32; 3]| {
        mapped(mesh, move |[x, y, z]| [x + by[0], y + by[1], z + by[2]])
    };
    add(&mut scene, "ball", &moved(&icosphere(4), [0.9, 0.4, 0.2]));
    add(
        &mut scene,
        "ring",
        &moved(&torus(96, 32, 1.6, 0.35), [-0.8, 0.3, -2.0]),
    );
    scene
}

/// A wall with a picture on it: white, a dark cross of two lines, and a dark square.
fn painted_wall() -> Scene {
    let side = 256;
    let is_dark = |x: u32, y: u32| {
        let cross = (60..66).contains(&y) || (90..96).contains(&x);
        cross || (150..210).contains(&x) && (150..210).contains(&y)
    };
    let pixel = |i: u32| {
        if is_dark(i % side, i / side) {
            [20, 20, 30, 255]
        } else {
            [240, 235, 220, 255]
        }
    };
    Scene {
        images: vec![Image {
            name: "drawing".to_owned(),
            width: side,
            height: side,
            rgba: (0..side * side).flat_map(pixel).collect(),
        }],
        materials: vec![Material {
            base_color_texture: Some(TextureUse {
                image: 0,
                uv_set: 0,
                wrap: [Wrap::Clamp; 2],
                transform: TextureTransform::default(),
            }),
            ..Material::default()
        }],
        meshes: vec![Mesh {
            parts: vec![Part {
                positions: vec![
                    [-2.0, -2.0, 0.0],
                    [2.0, -2.0, 0.0],
                    [2.0, 2.0, 0.0],
                    [-2.0, 2.0, 0.0],
                ],
                triangles: vec![[0, 1, 2], [0, 2, 3]],
                uvs: Some(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]]),
                material: Some(0),
                ..Part::default()
            }],
            ..Mesh::default()
        }],
        nodes: vec![Node {
            name: "wall".to_owned(),
            mesh: Some(0),
            ..Node::default()
        }],
        ..Scene::default()
    }
}

#[test]
fn lines_of_pictures_are_those_of_the_mesh_each_once() {
    let model = model_of(&group(), false);
    let camera = camera_at([2.0, 2.5, 7.0]);
    let [image, edges] =
        [LineSource::Image, LineSource::Edges].map(|method| drawn(&model, &camera, &with(method)));
    let (of_image, of_edges) = (length(&image), length(&edges));
    assert!(
        (of_image / of_edges - 1.0).abs() < 0.05,
        "{of_image} and {of_edges} px"
    );
    for kind in [Kind::Contour, Kind::Crease, Kind::Intersection] {
        assert!(
            image.strokes.iter().any(|stroke| stroke.kind == kind),
            "{kind:?}"
        );
    }
    // Every point lies on a line of the mesh.
    let places = || {
        edges.strokes.iter().flat_map(|stroke| {
            let closing = stroke
                .points
                .last()
                .zip(stroke.points.first())
                .filter(|_| stroke.closed);
            stroke
                .points
                .windows(2)
                .map(|pair| (&pair[0], &pair[1]))
                .chain(closing)
        })
    };
    let off = |p: [f64; 2]| {
        let distance = places().map(|(a, b)| {
            let (a, b) = (a.position, b.position);
            let along = [b[0] - a[0], b[1] - a[1]];
            let t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1])
                / (along[0].powi(2) + along[1].powi(2)).max(1e-12);
            let t = t.clamp(0.0, 1.0);
            (p[0] - a[0] - t * along[0]).hypot(p[1] - a[1] - t * along[1])
        });
        distance.fold(f64::INFINITY, f64::min)
    };
    let points: Vec<[f64; 2]> = image
        .strokes
        .iter()
        .flat_map(|stroke| &stroke.points)
        .map(|point| point.position)
        .collect();
    let near = points.iter().filter(|point| off(**point) < 1.5).count();
    assert!(near * 50 >= points.len() * 49, "{near} of {}", points.len());
}

#[test]
fn kinds_and_parts_without_lines_are_left_out() {
    let model = model_of(&group(), false);
    let camera = camera_at([2.0, 2.5, 7.0]);
    let options = LineOptions {
        kinds: [Kind::Crease].into_iter().collect::<KindSet>(),
        ..with(LineSource::Image)
    };
    let drawing = drawn(&model, &camera, &options);
    assert!(!drawing.strokes.is_empty());
    assert!(
        drawing
            .strokes
            .iter()
            .all(|stroke| stroke.kind == Kind::Crease)
    );
    let style = Style::from_toml("[[rule]]\nmatch.object = 'ball'\nline.on = false", &|_| {
        Err(String::new())
    });
    let drawing = model
        .draw(&camera, &style.expect("a style"), &with(LineSource::Image))
        .expect("drawn");
    let of_ball = drawing
        .strokes
        .iter()
        .filter(|stroke| drawing.surfaces[stroke.surface as usize].object == "ball");
    assert!(of_ball.count() == 0 && !drawing.strokes.is_empty());
}

#[test]
fn engines_and_threads_give_the_same() {
    let model = model_of(&painted_wall(), true);
    let camera = camera_at([1.0, 0.5, 6.0]);
    let options = LineOptions {
        painted: Some(PaintedLines::Dark),
        ..with(LineSource::Image)
    };
    let alone = drawn(&model, &camera, &options);
    let staged = LineRenderer::new(&Processor, &model).draw(&camera, &even_style("2px"), &options);
    assert_eq!(staged.expect("drawn"), alone);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    assert_eq!(pool.install(|| drawn(&model, &camera, &options)), alone);
}

#[test]
fn lines_painted_in_a_texture_become_marked_strokes_of_the_style() {
    let camera = camera_at([0.0, 0.0, 6.0]);
    for method in [LineSource::Edges, LineSource::Surface, LineSource::Image] {
        let options = LineOptions {
            painted: Some(PaintedLines::Dark),
            ..with(method)
        };
        let drawing = drawn(&model_of(&painted_wall(), true), &camera, &options);
        let painted: Vec<_> = drawing
            .strokes
            .iter()
            .filter(|stroke| stroke.kind == Kind::Marked)
            .collect();
        assert_eq!(painted.len(), 2, "{method:?}");
        for stroke in painted {
            // Both lines go from edge to edge along an axis, but for round ends of 2 pixels; 45.6 pixels are a unit.
            let [dx, dy] = [0, 1].map(|i| {
                let along = stroke.points.iter().map(|point| point.world[i]);
                along.clone().fold(f32::MIN, f32::max) - along.fold(f32::MAX, f32::min)
            });
            assert!(
                dx.max(dy) > 4.0 - 10.0 / 45.6 && dx.min(dy) < 0.04,
                "{dx} {dy}"
            );
            assert!(
                stroke
                    .points
                    .iter()
                    .all(|point| (point.width - 2.0).abs() < 1e-4)
            );
            assert!(
                stroke
                    .points
                    .iter()
                    .all(|point| (point.depth - 6.0).abs() < 0.01)
            );
        }
        // Nothing else of the drawing changes, and nobody has painted lines who does not ask.
        let rest = drawing
            .strokes
            .iter()
            .filter(|stroke| stroke.kind != Kind::Marked)
            .cloned();
        let plain = drawn(&model_of(&painted_wall(), false), &camera, &with(method));
        assert_eq!(rest.collect::<Vec<_>>(), plain.strokes);
    }
}

/// A wall that is white on the left, with a dark line and two dark ones near each other, and on the right black with
/// the same in white.
fn two_tones() -> Scene {
    let mut scene = painted_wall();
    let side = scene.images[0].width;
    let is_light = |x: u32, y: u32| {
        let on_line = (60..65).contains(&y) || (180..184).contains(&y) || (188..192).contains(&y);
        let inside = (8..120).contains(&(x % 128));
        (x < 128) != (on_line && inside)
    };
    let pixel = |i: u32| match is_light(i % side, i / side) {
        true => [240, 235, 220, 255],
        false => [20, 20, 30, 255],
    };
    scene.images[0].rgba = (0..side * side).flat_map(pixel).collect();
    scene
}

#[test]
fn light_lines_on_dark_paint_are_found_when_asked_for() {
    let camera = camera_at([0.0, 0.0, 6.0]);
    let model = model_of(&two_tones(), true);
    // Heights of all marked strokes on each side, in rows of the texture.
    let rows = |painted| {
        let options = LineOptions {
            painted: Some(painted),
            kinds: KindSet::from_iter([Kind::Marked]),
            ..LineOptions::new([640, 400])
        };
        let drawing = drawn(&model, &camera, &options);
        let ids: std::collections::BTreeSet<u64> = drawing.strokes.iter().map(|s| s.id).collect();
        assert_eq!(ids.len(), drawing.strokes.len(), "{painted:?}");
        let mut rows = [Vec::new(), Vec::new()];
        for stroke in drawing
            .strokes
            .iter()
            .filter(|stroke| stroke.length() > 100.0)
        {
            let middle = stroke.points[stroke.points.len() / 2].world;
            rows[usize::from(middle[0] > 0.0)].push(((2.0 - middle[1]) * 64.0).round() as u32);
        }
        rows.iter_mut().for_each(|rows| rows.sort_unstable());
        rows
    };
    let near = |found: &[u32], wanted: &[u32]| {
        let pairs = found.iter().zip(wanted);
        found.len() == wanted.len() && pairs.into_iter().all(|(a, b)| a.abs_diff(*b) <= 1)
    };
    let (lines, gap): (&[u32], &[u32]) = (&[62, 182, 190], &[186]);
    let [on_white, on_black] = rows(PaintedLines::Dark);
    assert!(
        near(&on_white, lines) && near(&on_black, gap),
        "{on_white:?} {on_black:?}"
    );
    let [on_white, on_black] = rows(PaintedLines::Light);
    assert!(
        near(&on_white, gap) && near(&on_black, lines),
        "{on_white:?} {on_black:?}"
    );
    // Of both, gaps between lines are none.
    let [on_white, on_black] = rows(PaintedLines::Both);
    assert!(
        near(&on_white, lines) && near(&on_black, lines),
        "{on_white:?} {on_black:?}"
    );
}

/// The camera turns by 0.3 degrees a step.
#[test]
fn strokes_stay_while_the_camera_turns() {
    for mesh in [torus(96, 48, 1.4, 0.5), icosphere(4)] {
        let model = model_of(&scene_of(&mesh), false);
        let views = (0..25).map(|step| {
            let angle = 0.4 + 0.005 * f64::from(step);
            let [x, z] = [
                npr_core::math::sin_f64(angle),
                npr_core::math::cos_f64(angle),
            ]
            .map(|v| 7.0 * v as f32);
            drawn(&model, &camera_at([x, 2.5, z]), &with(LineSource::Image))
        });
        let views: Vec<Drawing> = views.collect();
        for pair in views.windows(2) {
            assert_eq!(pair[0].strokes.len(), pair[1].strokes.len());
            let change = length(&pair[1]) / length(&pair[0]) - 1.0;
            assert!(change.abs() < 0.005, "{change}");
        }
    }
}

/// Share of the strokes of views that the view after has none for: of the same kind, surface and length, with ends as
/// near as a small turn of the camera moves them.
fn changed(views: &[Drawing]) -> f64 {
    let near = |a: &StrokePoint, b: &StrokePoint| {
        let [dx, dy] = [0, 1].map(|i| a.position[i] - b.position[i]);
        dx.hypot(dy) < 6.0
    };
    let are_same = |a: &Stroke, b: &Stroke| {
        let [long, short] = [a.length().max(b.length()), a.length().min(b.length())];
        let of_one_line = (a.kind, a.surface, a.closed) == (b.kind, b.surface, b.closed);
        let [[from, to], [start, end]] =
            [a, b].map(|s| [&s.points[0], &s.points[s.points.len() - 1]]);
        let have_ends = near(from, start) && near(to, end) || near(from, end) && near(to, start);
        of_one_line && long - short < 6.0 + 0.05 * long && (a.closed || have_ends)
    };
    let (mut lost, mut all) = (0, 0);
    for pair in views.windows(2) {
        let gone = |a: &&Stroke| !pair[1].strokes.iter().any(|b| are_same(a, b));
        lost += pair[0].strokes.iter().filter(gone).count();
        all += pair[0].strokes.len();
    }
    lost as f64 / all as f64
}

/// Outlines, creases and intersections of three objects meet in a dozen places, at most of which some line ends.
#[test]
fn strokes_stay_where_lines_meet() {
    let model = model_of(&group(), false);
    for scale in [1, 2] {
        let size = SIZE.map(|side| scale * side);
        let views: Vec<Drawing> = (0..25)
            .map(|step| {
                let angle = 0.4 + 0.005 * f64::from(step);
                let [x, z] = [
                    npr_core::math::sin_f64(angle),
                    npr_core::math::cos_f64(angle),
                ]
                .map(|v| 7.0 * v as f32);
                let options = LineOptions {
                    size,
                    ..with(LineSource::Image)
                };
                drawn(&model, &camera_at([x, 2.5, z]), &options)
            })
            .collect();
        let changed = changed(&views);
        assert!(changed < 0.04, "{changed} at {size:?}");
        assert!(
            views
                .iter()
                .all(|view| (6..10).contains(&view.strokes.len()))
        );
    }
}

/// A vase with a picture around it.
fn painted_vase(is_dark: impl Fn(f32, f32) -> bool) -> Scene {
    let (around, up) = (96u32, 48u32);
    let corner = |i: u32| {
        let (u, v) = (
            (i % (around + 1)) as f32 / around as f32,
            (i / (around + 1)) as f32 / up as f32,
        );
        let radius = 0.55 + 0.35 * npr_core::math::sin(std::f32::consts::PI * (1.1 * v + 0.1));
        let turn = std::f32::consts::TAU * (u - 0.5);
        let place = [
            radius * npr_core::math::sin(turn),
            2.0 * v - 1.0,
            radius * npr_core::math::cos(turn),
        ];
        (place, [u, 1.0 - v])
    };
    let corners = (around + 1) * (up + 1);
    let (positions, uvs) = (0..corners).map(corner).unzip();
    let quads = (0..up).flat_map(|row| (0..around).map(move |column| row * (around + 1) + column));
    let triangles = quads.flat_map(|a| {
        let (b, c, d) = (a + 1, a + around + 1, a + around + 2);
        [[a, b, d], [a, d, c]]
    });
    painted(positions, uvs, triangles.collect(), is_dark)
}

/// A board that lies before the eye, with a picture on it.
fn painted_board(is_dark: impl Fn(f32, f32) -> bool) -> Scene {
    let positions = vec![
        [-1.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [1.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
    ];
    let uvs = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    painted(positions, uvs, vec![[0, 2, 1], [0, 3, 2]], is_dark)
}

/// A mesh whose picture is dark blue where `is_dark` says so of texture coordinates, else cream.
fn painted(
    positions: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    triangles: Vec<[u32; 3]>,
    is_dark: impl Fn(f32, f32) -> bool,
) -> Scene {
    let mut scene = painted_wall();
    let side = 512;
    let pixel = |i: u32| {
        let [u, v] = [i % side, i / side].map(|at| (at as f32 + 0.5) / side as f32);
        if is_dark(u, v) {
            [30, 40, 110, 255]
        } else {
            [235, 230, 215, 255]
        }
    };
    scene.images[0] = Image {
        name: "paint".to_owned(),
        width: side,
        height: side,
        rgba: (0..side * side).flat_map(pixel).collect(),
    };
    let part = &mut scene.meshes[0].parts[0];
    (part.positions, part.uvs, part.triangles) = (positions, Some(uvs), triangles);
    scene
}

/// Painted strokes in a picture of 640 x 400 pixels.
fn painted_strokes(scene: &Scene, eye: [f32; 3], tone: PaintedLines) -> Vec<Stroke> {
    let options = LineOptions {
        painted: Some(tone),
        ..LineOptions::new([640, 400])
    };
    let drawing = drawn(&model_of(scene, true), &camera_at(eye), &options);
    let strokes = drawing.strokes.into_iter();
    strokes
        .filter(|stroke| stroke.kind == Kind::Marked)
        .collect()
}

/// How far a place of the picture is from the loop around (u, v), in half widths of that; below 1 it is painted.
fn off_loop(u: f32, v: f32, at: [f32; 2], radii: [f32; 2]) -> f32 {
    let away = ((u - at[0]) / radii[0]).hypot((v - at[1]) / radii[1]);
    (away - 1.0).abs() / 0.07
}

#[test]
fn loops_painted_on_a_vase_become_closed_strokes() {
    let loops = [([0.5, 0.38], [0.07, 0.09]), ([0.5, 0.62], [0.06, 0.06])];
    let is_painted = |u: f32, v: f32| {
        loops
            .iter()
            .any(|(at, radii)| off_loop(u, v, *at, *radii) < 1.0)
    };
    for eye in [[0.0, 0.0, 4.0], [0.8, 0.6, 4.0]] {
        let strokes = painted_strokes(&painted_vase(is_painted), eye, PaintedLines::Dark);
        assert_eq!(strokes.len(), 2, "from {eye:?}");
        assert!(
            strokes
                .iter()
                .all(|stroke| stroke.closed && stroke.length() > 100.0)
        );
    }
}

#[test]
fn bands_around_a_vase_are_strokes_and_the_chequer_between_them_none() {
    let is_band = |v: f32| (0.385..0.395).contains(&v) || (0.625..0.635).contains(&v);
    let is_cell = |u: f32, v: f32| {
        // Three rows of cells that are as wide as high where the vase is widest.
        (10.0..13.0).contains(&(22.0 * v)) && ((u * 64.0) as u32 + (v * 22.0) as u32) % 2 == 1
    };
    let vase = painted_vase(|u, v| is_band(v) || is_cell(u, v));
    for eye in [[0.0, 1.0, 4.0], [1.5, 1.5, 3.6]] {
        let dark = painted_strokes(&vase, eye, PaintedLines::Dark);
        assert_eq!(dark.len(), 2, "from {eye:?}");
        assert!(dark.iter().all(|stroke| stroke.length() > 200.0));
        let both = painted_strokes(&vase, eye, PaintedLines::Both);
        let (bands, others): (Vec<_>, Vec<_>) = both.iter().partition(|s| s.length() > 200.0);
        assert_eq!(bands.len(), 2, "from {eye:?}");
        // Of some fifty light cells two that touch beside the rim may look like a line.
        assert!(others.len() <= 1, "from {eye:?}: {}", others.len());
    }
}

#[test]
fn a_chequer_board_has_no_painted_lines() {
    for cells in [6.0, 12.0, 24.0] {
        let board = painted_board(|u, v| ((u * cells) as u32 + (v * cells) as u32) % 2 == 1);
        for eye in [[0.5, 3.5, 1.0], [1.5, 2.5, 2.0], [0.0, 2.0, 3.0]] {
            for tone in [PaintedLines::Dark, PaintedLines::Light, PaintedLines::Both] {
                let strokes = painted_strokes(&board, eye, tone);
                assert_eq!(strokes.len(), 0, "{cells} cells, {tone:?}, from {eye:?}");
            }
        }
    }
}
