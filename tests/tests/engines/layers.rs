//! Layers for compositing, on both engines: held against geometry, against the frame that they belong to, and against
//! the strokes that were drawn.

use glam::Vec3;
use npr_core::camera::{Camera, Projection};
use npr_core::color::{SrgbEncoder, premultiplied_light};
use npr_core::math;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{icosphere, mapped, plane};
use npr_render::{
    Drawing, Frame, LayerPixel, LineOptions, LineRenderer, Model, RenderError, Renderer,
    RendererOptions, Subject,
};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Object, boxed, device, draw_of, lines, scene_of};

const SIZE: [u32; 2] = [150, 110];

/// The processor, and a device where there is one.
pub fn engines() -> impl Iterator<Item = &'static dyn Engine> {
    let engines = [
        Some(&Processor as &dyn Engine),
        device().map(|device| device as &dyn Engine),
    ];
    engines.into_iter().flatten()
}

fn with_layers() -> RendererOptions {
    RendererOptions {
        layers: true,
        ..RendererOptions::new(SIZE)
    }
}

pub fn camera() -> Camera {
    Camera {
        eye: [1.5, 2.0, 5.0],
        target: [0.2, 0.1, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    }
}

fn parallel() -> Camera {
    Camera {
        projection: Projection::Parallel { height: 3.0 },
        ..camera()
    }
}

fn style(keys: &[&str]) -> Style {
    let mut style = Style::default();
    keys.iter().for_each(|key| style.set(key).unwrap());
    style
}

fn drawn(engine: &dyn Engine, scene: &Scene, style: &Style, camera: &Camera) -> Frame {
    let subject = Subject::new(scene, style).unwrap();
    draw_of(engine, &subject, style, camera, &with_layers())
}

/// A ball of radius 1 around the origin.
fn ball() -> Object {
    Object::new("Ball", icosphere(5)).colored([0.7, 0.2, 0.1])
}

/// A ball and a box that stand in a corner of two walls, all in colours of their own.
pub fn corner() -> Scene {
    let floor = mapped(&plane(1, 1), |[x, y, _]| {
        [6.0 * x - 3.0, -1.0, 3.0 - 6.0 * y]
    });
    let block = boxed([0.8, -1.0, -0.6], [1.7, 0.7, 0.5]);
    scene_of(&[
        ball(),
        Object::new("Floor", floor).double_sided(),
        Object::new("Block", block).colored([0.1, 0.4, 0.6]),
    ])
}

/// The pixels of a frame with their column and row.
fn pixels(frame: &Frame) -> impl Iterator<Item = ([u32; 2], &LayerPixel)> {
    let width = frame.size[0];
    assert_eq!(frame.layers.len() as u32, width * frame.size[1]);
    let places = (0..).map(move |at: u32| [at % width, at / width]);
    places.zip(&frame.layers)
}

/// A ray through a place of the picture: where it starts, and its step per unit of depth.
fn ray(camera: &Camera, [x, y]: [f32; 2]) -> [Vec3; 2] {
    let [right, up, back] = camera.axes().map(Vec3::from);
    let [width, height] = SIZE.map(|side| side as f32);
    let [x, y] = [(x - 0.5 * width) / height, (0.5 * height - y) / height];
    let eye = Vec3::from(camera.eye);
    match camera.projection {
        Projection::Perspective { fov_y } => {
            let height = 2.0 * math::tan(0.5 * fov_y);
            [eye, height * (x * right + y * up) - back]
        }
        Projection::Parallel { height } => [eye + height * (x * right + y * up), -back],
    }
}

fn middle([x, y]: [u32; 2]) -> [f32; 2] {
    [x as f32 + 0.5, y as f32 + 0.5]
}

/// A tilted plane that fills the picture.
#[test]
fn a_plane_has_its_depth_and_its_normal() {
    let (normal, offset) = (Vec3::new(0.3, 0.5, 1.0).normalize(), -0.4);
    let z = |x: f32, y: f32| (offset - normal.x * x - normal.y * y) / normal.z;
    let sheet = mapped(&plane(2, 2), |[x, y, _]| {
        let [x, y] = [20.0 * x - 10.0, 20.0 * y - 10.0];
        [x, y, z(x, y)]
    });
    let scene = scene_of(&[Object::new("Sheet", sheet)]);
    for (engine, camera) in engines().flat_map(|engine| [camera(), parallel()].map(|c| (engine, c)))
    {
        let frame = drawn(engine, &scene, &style(&[]), &camera);
        let mut exact = 0;
        for (at, pixel) in pixels(&frame) {
            // The nearest and the farthest place among those where samples may lie.
            let offsets = [[-0.25, -0.25], [0.25, -0.25], [-0.25, 0.25], [0.25, 0.25]];
            let depth_at = |[dx, dy]: [f32; 2]| {
                let [x, y] = middle(at);
                let [start, step] = ray(&camera, [x + dx, y + dy]);
                (offset - normal.dot(start)) / normal.dot(step)
            };
            let depths = offsets.map(depth_at);
            let near = depths.iter().copied().fold(f32::MAX, f32::min);
            let far = depths.iter().copied().fold(0.0, f32::max);
            let room = 1e-5 * far;
            let range = near - room..=far + room;
            assert!(range.contains(&pixel.depth), "{at:?}: {pixel:?} {range:?}");
            exact += u32::from((pixel.depth - depth_at([0.0; 2])).abs() <= room);
            let turned = Vec3::from(pixel.normal).distance(normal);
            assert!(turned < 1e-4, "{at:?}: {pixel:?}");
            assert_eq!(pixel.object, 1);
        }
        // Few pixels show two triangles of the sheet.
        assert!(exact > SIZE[0] * SIZE[1] * 9 / 10, "{exact}");
    }
}

/// A place of a ball lies between the ball and the planes of its faces, and its normal points away from the middle.
#[test]
fn a_ball_has_its_depth_and_its_normals() {
    let mesh = icosphere(5);
    let corners = |face: &[u32; 3]| face.map(|v| Vec3::from(mesh.positions()[v as usize]));
    let planes = mesh.triangles().iter().map(corners);
    let inner = planes.map(|[a, b, c]| (b - a).cross(c - a).normalize().dot(a).abs());
    let inner = inner.fold(1.0, f32::min);
    let scene = scene_of(&[ball()]);
    let one_sample = style(&["antialias.samples=1", "line.method=none"]);
    for (engine, camera) in engines().flat_map(|engine| [camera(), parallel()].map(|c| (engine, c)))
    {
        let frame = drawn(engine, &scene, &one_sample, &camera);
        let mut count = 0;
        for (at, pixel) in pixels(&frame) {
            let [start, step] = ray(&camera, middle(at));
            // How near the ray passes by the middle says what it must meet.
            let beside = start.cross(step).length() / step.length();
            if beside > 1.0 {
                assert_eq!(
                    *pixel,
                    LayerPixel {
                        depth: 1e10,
                        ..LAYERS_OF_NOTHING
                    },
                    "{at:?}"
                );
            }
            if beside < inner - 1e-5 {
                let place = start + step * pixel.depth;
                let range = inner - 1e-4..=1.0 + 1e-4;
                assert!(range.contains(&place.length()), "{at:?}: {place}");
                let cos = Vec3::from(pixel.normal).dot(place.normalize());
                assert!(cos > math::cos(1f32.to_radians()), "{at:?}: {cos}");
                assert!((Vec3::from(pixel.normal).length() - 1.0).abs() < 1e-5);
                assert_eq!((pixel.object, pixel.line), (1, [0.0; 4]));
                count += 1;
            }
        }
        assert!(count > 1500, "{count}");
    }
}

const LAYERS_OF_NOTHING: LayerPixel = LayerPixel {
    line: [0.0; 4],
    depth: LayerPixel::FAR,
    normal: [0.0; 3],
    object: 0,
    stroke: 0,
    stroke_depth: LayerPixel::FAR,
    uv: [0.0; 2],
};

#[test]
fn the_back_of_a_sheet_has_the_normal_towards_the_eye() {
    // Seen from the front, its face looks away.
    let sheet = mapped(&plane(1, 1), |[x, y, _]| {
        [4.0 - 8.0 * x, 8.0 * y - 4.0, 0.0]
    });
    let scene = scene_of(&[Object::new("Sheet", sheet).double_sided()]);
    for engine in engines() {
        let frame = drawn(engine, &scene, &style(&[]), &camera());
        let is_towards = |pixel: &LayerPixel| pixel.normal[2] > 0.999;
        assert!(pixels(&frame).all(|(_, pixel)| is_towards(pixel)));
    }
}

#[test]
fn nothing_has_empty_layers() {
    for engine in engines() {
        let frame = drawn(engine, &Scene::default(), &style(&[]), &camera());
        assert!(pixels(&frame).all(|(_, pixel)| *pixel == LAYERS_OF_NOTHING));
        assert!(
            frame
                .notices
                .iter()
                .any(|notice| notice.contains("no surfaces"))
        );
    }
}

/// Objects have the numbers that the model gives their names, and the frame is the same with layers and without.
#[test]
fn objects_have_their_numbers() {
    let (scene, style) = (corner(), style(&[]));
    let subject = Subject::new(&scene, &style).unwrap();
    let names = subject.model.object_names();
    let names: Vec<(u32, &str)> = names.into_iter().collect();
    assert_eq!(names, [(1, "Ball"), (2, "Floor"), (3, "Block")]);
    for engine in engines() {
        let frame = drawn(engine, &scene, &style, &camera());
        let at = |point: [f32; 3]| {
            let view = camera().view(SIZE, subject.model.bounds());
            let clip = npr_core::surface::apply_point(&view.clip_from_world, point);
            let [x, y] = [clip[0] / clip[3], -clip[1] / clip[3]];
            let [x, y] = [
                (x + 1.0) * 0.5 * SIZE[0] as f32,
                (y + 1.0) * 0.5 * SIZE[1] as f32,
            ];
            frame.layers[(y as u32 * SIZE[0] + x as u32) as usize].object
        };
        assert_eq!(at([0.0, 0.0, 1.0]), 1);
        assert_eq!(at([-1.5, -1.0, 1.5]), 2);
        assert_eq!(at([1.3, 0.2, 0.5]), 3);
        assert_eq!(at([-2.0, 2.0, 0.0]), 0);
        let plain = draw_of(
            engine,
            &subject,
            &style,
            &camera(),
            &RendererOptions::new(SIZE),
        );
        assert!(plain.rgba == frame.rgba && plain.layers.is_empty());
    }
}

/// Both engines give a pixel the same object, but beside a border of objects, and the same depth and normal.
#[test]
fn both_engines_agree() {
    let Some(device) = device() else { return };
    let (scene, style) = (corner(), style(&[]));
    let one = drawn(&Processor, &scene, &style, &camera());
    let two = drawn(device, &scene, &style, &camera());
    let is_beside_border = |[x, y]: [u32; 2]| {
        let around = (y.max(1) - 1..(y + 2).min(SIZE[1]))
            .flat_map(|y| (x.max(1) - 1..(x + 2).min(SIZE[0])).map(move |x| [x, y]));
        let mut objects = around.map(|[x, y]| one.layers[(y * SIZE[0] + x) as usize].object);
        let first = objects.next();
        objects.any(|object| Some(object) != first)
    };
    let mut apart = 0;
    for ((at, a), (_, b)) in pixels(&one).zip(pixels(&two)) {
        if a.object != b.object {
            assert!(is_beside_border(at), "{at:?}: {a:?} {b:?}");
            apart += 1;
            continue;
        }
        let turned = Vec3::from(a.normal).distance(Vec3::from(b.normal));
        let is_alike = (a.depth - b.depth).abs() <= 1e-4 * a.depth && turned < 1e-3;
        let has_other_line = (a.stroke, a.stroke_depth) != (b.stroke, b.stroke_depth);
        apart += i32::from(!is_alike || has_other_line);
    }
    assert!(
        apart <= (SIZE[0] * SIZE[1] / 1000) as i32,
        "{apart} pixels differ"
    );
}

/// The line over the picture without lines, in linear light, as sRGB bytes.
fn composed(frame: &Frame, without_lines: &Frame) -> Vec<[u8; 3]> {
    let encoder = SrgbEncoder::new();
    let (bare, _) = without_lines.rgba.as_chunks::<4>();
    let over = |(pixel, bare): (&LayerPixel, &[u8; 4])| {
        let below = premultiplied_light(*bare);
        let light = |i: usize| pixel.line[i] + below[i] * (1.0 - pixel.line[3]);
        [0, 1, 2].map(|i| encoder.byte(light(i)) as u8)
    };
    frame.layers.iter().zip(bare).map(over).collect()
}

/// The layer of lines over the frame that a style without lines gives is the frame, for every method that has lines of
/// its own; `angle` inks the surfaces themselves.
#[test]
fn lines_over_the_picture_without_lines_are_the_frame() {
    let scene = corner();
    let methods = [
        "strokes",
        "potrace",
        "shape",
        "edges",
        "filter",
        "hull",
        "filter+hull",
        "rim",
    ];
    for (engine, method) in engines().flat_map(|engine| methods.map(|method| (engine, method))) {
        for color in ["#000000", "#3040ff", "#ffffff"] {
            let line = [
                format!("line.method={method}"),
                format!("line.color={color}"),
            ];
            let frame = drawn(engine, &scene, &style(&[&line[0], &line[1]]), &camera());
            let bare = drawn(engine, &scene, &style(&["line.method=none"]), &camera());
            assert_ne!(frame.rgba, bare.rgba, "{method} draws lines");
            let (shown, _) = frame.rgba.as_chunks::<4>();
            for (want, got) in shown.iter().zip(composed(&frame, &bare)) {
                let apart = (0..3).map(|i| want[i].abs_diff(got[i])).max();
                assert!(apart <= Some(1), "{method}, {color}: {got:?} for {want:?}");
            }
            let is_in_a_line = |pixel: &LayerPixel| pixel.line[3] > 0.5;
            assert!(
                pixels(&frame).any(|(_, pixel)| is_in_a_line(pixel)),
                "{method}"
            );
        }
    }
}

/// Before a transparent background, lines have the alpha of the frame where nothing lies behind them.
#[test]
fn lines_before_nothing_keep_their_coverage() {
    let style = style(&["background=transparent", "line.color=#c08000"]);
    for engine in engines() {
        let frame = drawn(engine, &corner(), &style, &camera());
        let (shown, _) = frame.rgba.as_chunks::<4>();
        let mut count = 0;
        for (pixel, shown) in frame.layers.iter().zip(shown) {
            if pixel.object == 0 && pixel.line[3] > 0.0 {
                let want = premultiplied_light(*shown);
                // Some samples of the pixel may show a surface behind the line.
                count += i32::from((0..4).all(|i| (pixel.line[i] - want[i]).abs() < 1e-6));
            }
        }
        assert!(count > 50, "{count}");
    }
}

/// Strokes that a camera sees, in their order.
fn strokes_of(subject: &Subject, style: &Style) -> Drawing {
    let mut renderer = LineRenderer::new(&Processor, subject.lines.as_ref().unwrap());
    let options = LineOptions::of_style(style, SIZE);
    renderer.draw(&camera(), style, &options).unwrap()
}

/// A pixel has a stroke where it has a line, and the stroke passes there.
#[test]
fn line_ids_are_of_strokes_that_pass_there() {
    let (scene, style) = (corner(), style(&[]));
    let subject = Subject::new(&scene, &style).unwrap();
    let drawing = strokes_of(&subject, &style);
    for engine in engines() {
        let frame = draw_of(engine, &subject, &style, &camera(), &with_layers());
        let mut seen = vec![0; drawing.strokes.len()];
        for (at, pixel) in pixels(&frame) {
            // A device may round away what covers hardly anything.
            let is_faint = pixel.line[3] < 2.0 / 255.0;
            let has_line = pixel.line[3] > 0.0;
            assert!(
                (pixel.stroke > 0) == has_line || is_faint,
                "{at:?}: {pixel:?}"
            );
            let Some(number) = pixel.stroke.checked_sub(1) else {
                continue;
            };
            seen[number as usize] += 1;
            let stroke = &drawing.strokes[number as usize];
            assert!(stroke.is_visible(), "{at:?}");
            let passes = distance(stroke, middle(at));
            // Half a diagonal of a pixel beyond the edge there is no ink.
            assert!(passes < 0.71, "{at:?}: {passes} px beside stroke {number}");
        }
        assert!(
            seen.iter().filter(|count| **count > 20).count() >= 6,
            "{seen:?}"
        );
    }
}

/// The outline of a sheet that leans away has, at every pixel, the depth of the place on the sheet's own edges that
/// lies nearest in the picture; nothing else has one.
#[test]
fn lines_have_the_depth_of_their_place() {
    let corners = [
        [-1.4, -0.9, 1.0],
        [1.6, -1.0, 0.4],
        [1.3, 1.2, -2.0],
        [-1.2, 0.8, -1.5],
    ];
    let corners = corners.map(Vec3::from);
    let sheet = mapped(&plane(1, 1), |[x, y, _]| {
        let [below, above] = [[0, 1], [3, 2]].map(|[a, b]| corners[a].lerp(corners[b], x));
        below.lerp(above, y).to_array()
    });
    let scene = scene_of(&[Object::new("Sheet", sheet).double_sided()]);
    let style = lines("strokes");
    for (engine, camera) in engines().flat_map(|engine| [camera(), parallel()].map(|c| (engine, c)))
    {
        // Places along the edges, in the picture and in depth.
        let subject = Subject::new(&scene, &style).unwrap();
        let view = camera.view(SIZE, subject.model.bounds());
        let [.., back] = camera.axes().map(Vec3::from);
        let place = |point: Vec3| {
            let clip = npr_core::surface::apply_point(&view.clip_from_world, point.to_array());
            let x = 0.5 + 0.5 * clip[0] / clip[3];
            let y = 0.5 - 0.5 * clip[1] / clip[3];
            let [width, height] = SIZE.map(|side| side as f32);
            let depth = (Vec3::from(camera.eye) - point).dot(back);
            ([x * width, y * height], depth)
        };
        let along = |i: usize| {
            let ends = [corners[i], corners[(i + 1) % 4]];
            (0..=2000).map(move |k| ends[0].lerp(ends[1], k as f32 / 2000.0))
        };
        let edges: Vec<_> = (0..4).flat_map(along).map(place).collect();

        let frame = draw_of(engine, &subject, &style, &camera, &with_layers());
        let mut count = 0;
        for (at, pixel) in pixels(&frame) {
            if pixel.stroke == 0 {
                assert_eq!(pixel.stroke_depth, LayerPixel::FAR, "{at:?}");
                continue;
            }
            let middle = middle(at);
            let distance = |px: &[f32; 2]| (px[0] - middle[0]).hypot(px[1] - middle[1]);
            let nearest = edges
                .iter()
                .map(|(px, _)| distance(px))
                .fold(f32::MAX, f32::min);
            // At corners, places on both edges are as near as each other.
            let near = edges.iter().filter(|(px, _)| distance(px) < nearest + 0.1);
            let (low, high) = near.fold((f32::MAX, 0.0f32), |(low, high), (_, depth)| {
                (low.min(*depth), high.max(*depth))
            });
            let range = low - 1e-3..=high + 1e-3;
            assert!(
                range.contains(&pixel.stroke_depth),
                "{at:?}: {pixel:?} {range:?}"
            );
            count += 1;
        }
        assert!(count > 500, "{count} pixels");
    }
}

/// Where lines lie before each other, the depth is that of the stroke that shows.
#[test]
fn the_depth_of_a_line_is_that_of_its_stroke() {
    let (scene, style) = (corner(), style(&["line.width.base=12px"]));
    let subject = Subject::new(&scene, &style).unwrap();
    let drawing = strokes_of(&subject, &style);
    for engine in engines() {
        let frame = draw_of(engine, &subject, &style, &camera(), &with_layers());
        for (at, pixel) in pixels(&frame).filter(|(_, pixel)| pixel.stroke > 0) {
            let points = &drawing.strokes[pixel.stroke as usize - 1].points;
            let depths = points.iter().map(|point| point.depth as f32);
            let (low, high) = depths.fold((f32::MAX, 0.0f32), |(low, high), depth| {
                (low.min(depth), high.max(depth))
            });
            let range = low - 1e-4..=high + 1e-4;
            assert!(
                range.contains(&pixel.stroke_depth),
                "{at:?}: {pixel:?} {range:?}"
            );
        }
    }
}

/// Stamps that lie beside their stroke have its depth too.
#[test]
fn stamps_have_the_depth_of_their_stroke() {
    let stamps = [
        "line.width.base=4px",
        "line.brush.tip=charcoal",
        "line.brush.mapping=stamps",
        "line.brush.stamp.size=3",
        "line.brush.stamp.scatter=2",
    ];
    let frame = drawn(&Processor, &corner(), &style(&stamps), &camera());
    let strokes = || pixels(&frame).filter(|(_, pixel)| pixel.stroke > 0);
    assert!(strokes().count() > 500);
    for (at, pixel) in strokes() {
        assert!(
            (2.0..20.0).contains(&pixel.stroke_depth),
            "{at:?}: {pixel:?}"
        );
    }
}

/// How far a place lies beside the ink of a stroke, in pixels.
fn distance(stroke: &npr_vector::stroke::Stroke, [x, y]: [f32; 2]) -> f64 {
    let place = glam::DVec2::new(f64::from(x), f64::from(y));
    let back = stroke.points.first().filter(|_| stroke.closed);
    let points: Vec<_> = stroke.points.iter().chain(back).collect();
    let beside = |pair: &[&npr_vector::stroke::StrokePoint]| {
        let [a, b] = [0, 1].map(|i| glam::DVec2::from(pair[i].position));
        let along = (place - a).dot(b - a) / (b - a).length_squared();
        let nearest = a + (b - a) * along.clamp(0.0, 1.0);
        place.distance(nearest) - 0.5 * pair[0].width.max(pair[1].width)
    };
    points.windows(2).map(beside).fold(f64::MAX, f64::min)
}

/// A frame in tiles has the layers of the whole one, up to a pixel in ten thousand as pictures do.
#[test]
fn tiles_do_not_show() {
    let (scene, style) = (corner(), style(&[]));
    let size = [410, 290];
    let subject = Subject::new(&scene, &style).unwrap();
    for engine in engines() {
        let [whole, tiled] = [4_000_000, 20_000].map(|tile_pixels| {
            let options = RendererOptions {
                tile_pixels,
                ..RendererOptions {
                    size,
                    ..with_layers()
                }
            };
            draw_of(engine, &subject, &style, &camera(), &options)
        });
        let pairs = whole.layers.iter().zip(&tiled.layers);
        let apart = pairs.filter(|(a, b)| !is_alike(a, b)).count();
        assert!(
            apart <= whole.layers.len() / 10_000,
            "{apart} pixels differ"
        );
        assert!(tiled.layers.iter().filter(|pixel| pixel.stroke > 0).count() > 1000);
    }
}

fn is_alike(a: &LayerPixel, b: &LayerPixel) -> bool {
    let line = (0..4).all(|i| (a.line[i] - b.line[i]).abs() < 0.01);
    let normal = (0..3).all(|i| (a.normal[i] - b.normal[i]).abs() < 1e-3);
    let depths = [(a.depth, b.depth), (a.stroke_depth, b.stroke_depth)];
    let depth = depths.iter().all(|(a, b)| (a - b).abs() <= 1e-4 * a);
    line && normal && depth && (a.object, a.stroke) == (b.object, b.stroke)
}

/// Layers are planned before they are allocated, and are drawn whole.
#[test]
fn layers_take_their_share_of_the_memory() {
    let model = Model::new(&corner()).unwrap();
    let plan = |layers, memory_limit| {
        let options = RendererOptions {
            layers,
            memory_limit,
            in_bands: true,
            tile_pixels: 100_000,
            ..RendererOptions::new([2000, 2000])
        };
        let renderer = Renderer::new(&Processor, &model, &lines("none"), &options);
        renderer.map(|renderer| renderer.draws_bands())
    };
    // A picture of four million pixels with layers takes more than 80 bytes for each.
    let limit = 320 << 20;
    assert_eq!(plan(false, limit), Ok(true));
    assert!(matches!(plan(true, limit), Err(RenderError::Memory(_))));
    assert_eq!(plan(true, 2 * limit), Ok(false));
}

/// What a style or a scene cannot give is said, once each.
#[test]
fn what_layers_lack_is_said() {
    let told = |keys: &[&str]| {
        let notices = drawn(&Processor, &corner(), &style(keys), &camera()).notices;
        ["method angle", "line ids number strokes", "no surfaces"].map(|text| {
            notices
                .iter()
                .filter(|notice| notice.contains(text))
                .count()
        })
    };
    assert_eq!(told(&[]), [0, 0, 0]);
    assert_eq!(told(&["line.method=none"]), [0, 0, 0]);
    assert_eq!(told(&["line.method=angle"]), [1, 0, 0]);
    assert_eq!(told(&["line.method=shape"]), [0, 1, 0]);
    assert_eq!(told(&["line.method=hull"]), [0, 1, 0]);
}
