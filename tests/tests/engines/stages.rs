//! Stages of frames on both engines: surfaces held against styles that ask for no more, lines against the edges of a
//! box, and the mask against objects.

use super::layers::{camera, corner, engines};
use glam::Vec3;
use npr_core::camera::Camera;
use npr_core::outline::Outline;
use npr_gpu::engine::Engine;
use npr_render::{Drawing, Frame, Kind, LineStage, RendererOptions, Subject, SurfaceStage};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Object, boxed, draw_of, scene_of};
use std::collections::{BTreeMap, BTreeSet};

const SIZE: [u32; 2] = [150, 110];

/// Hatched, with highlights and lines, and a change.
fn style(keys: &[&str]) -> Style {
    let mut style = Style::preset("comic-modern").unwrap();
    let own = [
        "light.direction=[0.0, 0.96, 0.28]",
        "ink.dark_at=0.3",
        "ink.light_at=0.9",
        "ink.faces=1.0",
    ];
    own.iter()
        .chain(keys)
        .for_each(|key| style.set(key).unwrap());
    style
}

fn drawn(engine: &dyn Engine, style: &Style, options: &RendererOptions) -> Frame {
    let subject = Subject::new(&corner(), style).unwrap();
    draw_of(engine, &subject, style, &camera(), options)
}

/// The surfaces of a frame at a stage.
fn stage(engine: &dyn Engine, surfaces: SurfaceStage) -> Frame {
    let options = RendererOptions {
        layers: true,
        stages: true,
        surfaces,
        ..RendererOptions::new(SIZE)
    };
    drawn(engine, &style(&[]), &options)
}

fn surfaces_of(frame: &Frame) -> Vec<u8> {
    let surfaces = frame.stages.iter().map(|pixel| pixel.surface);
    surfaces.flatten().collect()
}

/// Each stage is bit for bit the picture of a style that stops there, and none is another.
#[test]
fn surfaces_at_a_stage_are_those_of_styles_without_the_rest() {
    const DRY: [&str; 1] = ["ink.tone=none"];
    const MATT: [&str; 2] = ["highlight.edge=none", "line.method=none"];
    let white = [
        "shade.mode=paper",
        "shade.paper=#ffffff",
        "shade.ramp=[{ at = 0.0, light = 1.0 }]",
    ];
    let cases = [
        (SurfaceStage::Whole, vec!["line.method=none"]),
        (SurfaceStage::Tones, [&DRY[..], &MATT].concat()),
        (
            SurfaceStage::Base,
            [&DRY[..], &MATT, &["shade.mode=flat"]].concat(),
        ),
        (SurfaceStage::Ink, [&MATT[..], &white].concat()),
    ];
    for engine in engines() {
        let mut seen = BTreeSet::new();
        for (surfaces, keys) in &cases {
            let found = surfaces_of(&stage(engine, *surfaces));
            let plain = drawn(engine, &style(keys), &RendererOptions::new(SIZE));
            assert!(found == plain.rgba, "{surfaces:?}");
            assert!(seen.insert(found), "{surfaces:?} is another stage");
        }
    }
}

/// Light is grey by the angle between normal and light, whatever the colours and ramps.
#[test]
fn light_is_that_of_the_normals() {
    let [right, up, back] = camera().axes().map(Vec3::from);
    let light = (0.96 * up + 0.28 * back).normalize();
    assert!(right.dot(light).abs() < 1e-6);
    for engine in engines() {
        let frame = stage(engine, SurfaceStage::Light);
        // Look within objects, where normals turn by less than what the bound below stands for.
        let inside = |at: usize| {
            let normal = Vec3::from(frame.layers[at].normal);
            let around = [at - 1, at + 1, at - 150, at + 150].map(|at| &frame.layers[at]);
            around.iter().all(|pixel| {
                pixel.object == frame.layers[at].object
                    && Vec3::from(pixel.normal).distance(normal) < 0.06
            })
        };
        let mut shown = BTreeSet::new();
        for at in 150..frame.layers.len() - 150 {
            let pixel = &frame.layers[at];
            if ![1, 2].contains(&pixel.object) || !inside(at) {
                continue;
            }
            let want = 127.5 * (1.0 + Vec3::from(pixel.normal).dot(light));
            let surface = frame.stages[at].surface;
            for byte in &surface[..3] {
                let off = f32::from(*byte) - want;
                assert!(off.abs() < 4.0, "{at}: {pixel:?} {want}");
            }
            shown.insert(surface[0] / 32);
        }
        assert!(shown.len() >= 3, "{shown:?}");
    }
}

/// A box with its 12 edges, and a camera that sees 9 of them.
fn block() -> (Scene, [Vec3; 2]) {
    let (low, high) = ([-0.8, -0.9, -0.6], [1.0, 0.7, 0.5]);
    let scene = scene_of(&[Object::new("Block", boxed(low, high))]);
    (scene, [low, high].map(Vec3::from))
}

/// Lengths of the edges of that box in the picture: of those that a camera sees, and of all.
fn lengths([low, high]: [Vec3; 2], camera: &Camera) -> [f64; 2] {
    let view = camera.view(SIZE, (low.to_array(), high.to_array()));
    let px = |point: Vec3| {
        let clip = npr_core::surface::apply_point(&view.clip_from_world, point.to_array());
        let [x, y] = [clip[0] / clip[3], clip[1] / clip[3]];
        let size = SIZE.map(|side| f64::from(side) * 0.5);
        [f64::from(x) * size[0], f64::from(y) * size[1]]
    };
    let corner = |bits: usize| Vec3::from([0, 1, 2].map(|k| [low[k], high[k]][bits >> k & 1]));
    let mut sums = [0.0; 2];
    for (axis, from) in (0..3).flat_map(|axis| (0..8).map(move |bits| (axis, bits))) {
        if from >> axis & 1 == 1 {
            continue;
        }
        let [a, b] = [from, from | 1 << axis].map(|bits| px(corner(bits)));
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        // An edge is seen where one of its two faces looks at the eye.
        let is_seen = (0..3).filter(|other| *other != axis).any(|k| {
            let eye = Vec3::from(camera.eye);
            match from >> k & 1 {
                0 => eye[k] < low[k],
                _ => eye[k] > high[k],
            }
        });
        sums[1] += length;
        sums[0] += if is_seen { length } else { 0.0 };
    }
    sums
}

fn length_of(drawings: &[Drawing], is_wanted: impl Fn(u32) -> bool) -> f64 {
    let strokes = drawings.iter().flat_map(|drawing| &drawing.strokes);
    let wanted = strokes.filter(|stroke| is_wanted(stroke.occluders));
    wanted.map(|stroke| stroke.length()).sum()
}

/// A box: 12 edges are found, 9 of them seen, and pieces become fewer strokes of the same length.
#[test]
fn lines_at_a_stage_are_the_edges_of_a_box() {
    let (scene, corners) = block();
    let style = Style::default();
    let subject = Subject::new(&scene, &style).unwrap();
    let camera = camera();
    let [seen, all] = lengths(corners, &camera);
    for engine in engines() {
        let options = RendererOptions::new(SIZE);
        let mut renderer = subject.renderer(engine, &style, &options).unwrap();
        let mut at = |stage| renderer.lines_at(&camera, stage).unwrap();
        let [found, pieces, joined] = [
            at(LineStage::Found),
            at(LineStage::Seen),
            at(LineStage::Joined),
        ];
        let is_near = |a: f64, b: f64| (a - b).abs() < 0.01 * b;
        assert!(is_near(length_of(&found, |_| true), all));
        assert!(is_near(length_of(&found, |more| more == 0), seen));
        assert!(is_near(length_of(&pieces, |_| true), seen));
        let joined_px = length_of(&joined, |_| true);
        // Smoothing rounds the corners of the outline a little.
        let range = 0.95 * seen..=seen;
        assert!(range.contains(&joined_px), "{joined_px} of {seen}");
        assert_eq!(length_of(&pieces, |more| more > 0), 0.0);
        let [pieces, joined] = [pieces, joined].map(|of| of[0].strokes.len());
        assert!(joined < pieces, "{joined} of {pieces}");
    }
}

/// Of a box contours show at its outline, creases within; its six triangles in front; the mask finds its border where
/// it lies before nothing.
#[test]
fn pixels_know_their_triangle_kind_and_mask() {
    let (scene, _) = block();
    for engine in engines() {
        let draw = |method: &str| {
            let mut style = Style::default();
            style.set(&format!("line.method={method}")).unwrap();
            style.set("antialias.samples=1").unwrap();
            style.set("line.width.base=2px").unwrap();
            let subject = Subject::new(&scene, &style).unwrap();
            let options = RendererOptions {
                layers: true,
                stages: true,
                ..RendererOptions::new(SIZE)
            };
            draw_of(engine, &subject, &style, &camera(), &options)
        };
        let is_block = |frame: &Frame, at: usize| frame.layers[at].object == 1;
        let beside = |at: usize, reach: usize| {
            let width = SIZE[0] as usize;
            let rows = (0..=2 * reach).map(move |row| at + row * width - reach * width);
            rows.flat_map(move |row| row - reach..=row + reach)
        };
        let middle = 4 * SIZE[0] as usize..(SIZE[0] * SIZE[1]) as usize - 4 * SIZE[0] as usize;

        // Look at strokes.
        let frame = draw("strokes");
        let both = frame.layers.iter().zip(&frame.stages);
        let shown = both.filter(|(pixel, _)| pixel.object == 1);
        let triangles: BTreeSet<u32> = shown.clone().map(|(_, stage)| stage.triangle).collect();
        assert_eq!((triangles.len(), triangles.contains(&0)), (6, false));
        assert!(shown.clone().all(|(_, stage)| stage.material == 1));
        let mut counts = BTreeMap::new();
        for at in middle.clone() {
            let kind = frame.stages[at].kind;
            assert_eq!(kind.is_some(), frame.layers[at].stroke != 0);
            if let Some(kind) = kind {
                *counts.entry(kind).or_insert(0) += 1;
                let is_border = beside(at, 3).any(|near| !is_block(&frame, near));
                assert!(kind == Kind::Crease || is_border, "{kind:?} at {at}");
            }
        }
        assert_eq!(counts.len(), 2, "{counts:?}");
        assert!(counts[&Kind::Contour] > 100 && counts[&Kind::Crease] > 50);
        assert!(frame.stages.iter().all(|pixel| pixel.mask == 0));

        // Look at the mask.
        let frame = draw("shape");
        let mut count = 0;
        for at in middle {
            let found = frame.stages[at].mask & Outline::OBJECT_ID != 0;
            let changes = |reach| {
                beside(at, reach).any(|near| is_block(&frame, near) != is_block(&frame, at))
            };
            assert!(!found || changes(2), "{at}");
            count += u32::from(found);
        }
        assert!(count > 200, "{count}");
        let normals = frame
            .stages
            .iter()
            .filter(|pixel| pixel.mask & Outline::NORMAL != 0);
        assert!(normals.count() > 50);
    }
}
