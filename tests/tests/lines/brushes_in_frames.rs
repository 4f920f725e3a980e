//! Strokes drawn with brushes and pressed by curves, in frames.

use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_mesh::Mesh;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Picture, RenderError, RendererOptions, Subject};
use npr_scene::Scene;
use npr_style::brush::Tip;
use npr_stylesheet::Style;
use npr_tests::Agreement;
use npr_tests::comic::{SIZE, front};
use npr_tests::{Ink, Object, device, lines, placed, scene_of};

pub fn scene() -> Scene {
    scene_of(&[
        Object::new("Left", placed(&icosphere(4), [0.6; 3], [-0.7, 0.0, 0.0])),
        Object::new("Right", placed(&icosphere(4), [0.6; 3], [0.4, 0.0, -1.0])),
    ])
}

/// Thick strokes, with settings.
fn thick(settings: &[&str]) -> Style {
    let mut style = lines("strokes");
    for setting in ["line.width.base=9px"].iter().chain(settings) {
        style.set(setting).unwrap();
    }
    style
}

/// Two meshes as one.
fn joined(one: &Mesh, other: &Mesh) -> Mesh {
    let positions = [one.positions(), other.positions()].concat();
    let first = one.positions().len() as u32;
    let moved = other.triangles().iter();
    let moved = moved.map(|corners| corners.map(|corner| corner + first));
    let triangles = one.triangles().iter().copied().chain(moved).collect();
    Mesh::new(positions, triangles).unwrap()
}

fn drawn_of(
    scene: &Scene,
    engine: &dyn Engine,
    style: &Style,
    options: &RendererOptions,
) -> Result<Frame, RenderError> {
    let subject = Subject::new(scene, style)?;
    subject.renderer(engine, style, options)?.draw(&front())
}

fn drawn_by(
    engine: &dyn Engine,
    style: &Style,
    options: &RendererOptions,
) -> Result<Frame, RenderError> {
    drawn_of(&scene(), engine, style, options)
}

fn drawn(settings: &[&str]) -> Frame {
    drawn_by(&Processor, &thick(settings), &RendererOptions::new(SIZE)).unwrap()
}

/// How dark every pixel is, 0..1.
fn ink(frame: &Frame) -> Vec<f64> {
    let pixels = frame.rgba.chunks(4);
    pixels
        .map(|pixel| 1.0 - f64::from(pixel[1]) / 255.0)
        .collect()
}

/// Brushes leave ink out; none puts any where a pen has none. Each leaves something else.
#[test]
fn brushes_leave_out_ink_of_the_pen() {
    let pen = ink(&drawn(&[]));
    let total: f64 = pen.iter().sum();
    let mut seen = Vec::new();
    for tip in Tip::ALL.into_iter().filter(|tip| *tip != Tip::Pen) {
        let name = serde_name(tip);
        let frame = drawn(&[&format!("line.brush.tip={name}")]);
        let inked = ink(&frame);
        let strayed = inked
            .iter()
            .zip(&pen)
            .filter(|(brush, pen)| *brush - *pen > 1.5 / 255.0);
        assert_eq!(strayed.count(), 0, "{name}");
        let share = inked.iter().sum::<f64>() / total;
        assert!((0.1..0.995).contains(&share), "{name}: {share}");
        assert!(seen.iter().all(|other| *other != frame.rgba), "{name}");
        seen.push(frame.rgba);
    }
}

fn serde_name(tip: Tip) -> String {
    let table = toml::Table::try_from(std::collections::BTreeMap::from([("tip", tip)])).unwrap();
    table["tip"].as_str().unwrap().to_owned()
}

#[test]
fn engines_draw_the_same_brushes_in_tiles_or_whole() {
    let looks = [
        ("dry-brush", "length"),
        ("pencil", "once"),
        ("airbrush", "stamps"),
        ("sketch", "length"),
        ("charcoal", "stamps"),
    ];
    for (tip, mapping) in looks {
        let style = thick(&[
            &format!("line.brush.tip={tip}"),
            &format!("line.brush.mapping={mapping}"),
            "line.brush.stamp.scatter=0.4",
            "line.width.taper.end=60px",
        ]);
        let options = RendererOptions::new(SIZE);
        let whole = drawn_by(&Processor, &style, &options).unwrap();
        let in_tiles = RendererOptions {
            tile_pixels: 60 * 60,
            ..options.clone()
        };
        let in_tiles = drawn_by(&Processor, &style, &in_tiles).unwrap();
        assert!(
            whole.rgba == in_tiles.rgba,
            "{tip}: the paper lies still under tiles"
        );
        if let Some(device) = device() {
            let there = drawn_by(device, &style, &options).unwrap();
            let agreement = Agreement::between(&whole, &there, 2);
            assert!(agreement.holds(), "{tip}: {agreement}");
        }
    }
}

/// Stamps farther apart than they are long lie alone; scattered ones lie beside the line.
#[test]
fn stamps_lie_alone_or_beside_the_line() {
    let blob: Vec<u8> = (0..16 * 16)
        .flat_map(|i| {
            let [x, y] = [i % 16, i / 16].map(|v| v as f32 - 7.5);
            [255, 255, 255, if x * x + y * y < 49.0 { 255 } else { 0 }]
        })
        .collect();
    let with = |settings: &[&str]| {
        let mut options = RendererOptions::new(SIZE);
        let picture = Picture {
            size: [16, 16],
            rgba: blob.clone(),
        };
        options.pictures.insert("blob.png".to_owned(), picture);
        let fixed = [
            "line.brush.image=blob.png",
            "line.brush.mapping=stamps",
            "line.brush.dry=0.0",
        ];
        let style = thick(&[&fixed, settings].concat());
        Ink::of_strokes(&drawn_by(&Processor, &style, &options).unwrap())
    };
    let apart = [
        "line.brush.stamp.spacing=2.0",
        "line.brush.stamp.jitter=0.0",
    ];
    let beads = with(&apart).components();
    let pen = Ink::of_strokes(&drawn(&[]));
    // Outlines of 2 pi 58 px and about 2/3 of 2 pi 41, a bead every 18 px.
    assert!((20..45).contains(&beads.len()), "{} beads", beads.len());
    let scattered = with(&[&apart[..], &["line.brush.stamp.scatter=3.0"]].concat());
    assert!(scattered.without(&pen.grown(3)).count() > 100);
    assert!(scattered.without(&pen.grown(33)).count() == 0);
}

#[test]
fn a_picture_is_a_brush() {
    // Bands across the stroke: ink in the first half of every image, none in the other.
    let banded: Vec<u8> = (0..32 * 16)
        .flat_map(|i| [255, 255, 255, if i % 32 < 16 { 255 } else { 0 }])
        .collect();
    let with = |size: [u32; 2], rgba: &[u8]| {
        let mut options = RendererOptions::new(SIZE);
        let picture = Picture {
            size,
            rgba: rgba.to_vec(),
        };
        options.pictures.insert("bands.png".to_owned(), picture);
        let settings = [
            "line.brush.image=bands.png",
            "line.brush.grain=0.0",
            "line.brush.stretch=2.0",
        ];
        drawn_by(&Processor, &thick(&settings), &options)
    };
    let pen: f64 = ink(&drawn(&[])).iter().sum();
    let banded: f64 = ink(&with([32, 16], &banded).unwrap()).iter().sum();
    assert!((banded / pen - 0.5).abs() < 0.05, "{banded} of {pen}");

    // What is none is refused, by the key that names it.
    let error = with([0, 0], &[]).unwrap_err().to_string();
    assert!(error.starts_with("line.brush.image: "), "{error}");
    let missing = drawn_by(
        &Processor,
        &thick(&["line.brush.image=gone.png"]),
        &RendererOptions::new(SIZE),
    );
    assert!(
        matches!(missing, Err(RenderError::MissingPicture { key, .. }) if key == "line.brush.image")
    );
}

#[test]
fn a_rule_gives_a_part_its_brush() {
    let mut style = thick(&[]);
    let rule = "[[rule]]\nmatch.object = 'Right'\nline.brush.tip = 'chalk'";
    style.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    let options = RendererOptions::new(SIZE);
    let mixed = ink(&drawn_by(&Processor, &style, &options).unwrap());
    let [pen, chalk] = ["pen", "chalk"].map(|tip| ink(&drawn(&[&format!("line.brush.tip={tip}")])));
    // The left ball ends at 150, and the outline of the right one begins behind it.
    let differ = |mixed: &[f64], other: &[f64], columns: std::ops::Range<usize>| {
        let slots = (0..mixed.len()).filter(|slot| columns.contains(&(slot % SIZE[0] as usize)));
        slots
            .filter(|slot| (mixed[*slot] - other[*slot]).abs() > 0.01)
            .count()
    };
    let (left, right) = (0..135, 165..SIZE[0] as usize);
    let differs = |other: &[f64], columns| differ(&mixed, other, columns);
    assert_eq!(
        differs(&pen, left.clone()),
        0,
        "the left ball keeps its pen"
    );
    assert_eq!(
        differs(&chalk, right.clone()),
        0,
        "the right ball has chalk"
    );
    assert!(differs(&chalk, left.clone()) > 200 && differs(&pen, right.clone()) > 200);

    // An object in two pieces, of which one lies within the other, has one brush, and no other object takes it.
    let hidden = placed(&icosphere(2), [0.1; 3], [-0.7, 0.0, 0.0]);
    let ball = placed(&icosphere(4), [0.6; 3], [-0.7, 0.0, 0.0]);
    let other = placed(&icosphere(4), [0.6; 3], [0.4, 0.0, -1.0]);
    let both = Object::new("Left", joined(&ball, &hidden));
    let pieces = scene_of(&[both, Object::new("Right", other)]);
    let of_pieces = ink(&drawn_of(&pieces, &Processor, &style, &options).unwrap());
    assert_eq!(differ(&of_pieces, &pen, left), 0);
    assert!(differ(&of_pieces, &pen, right) > 200);
}

/// Dry brushes leave more out where they are drier, coarse paper has larger spots, and an image once over a stroke is
/// another picture than one by its length.
#[test]
fn keys_of_brushes_act() {
    let total = |settings: &[&str]| -> f64 { ink(&drawn(settings)).iter().sum() };
    let dry = |dry: &str| total(&["line.brush.tip=dry-brush", &format!("line.brush.dry={dry}")]);
    assert!(dry("0.0") > dry("1.2") && dry("1.2") > dry("1.9"));
    // How often ink begins or ends along rows, beyond the edges of the strokes.
    let steps = |settings: &[&str]| {
        let inked = ink(&drawn(settings));
        let steps = inked
            .windows(2)
            .filter(|pair| (pair[0] > 0.5) != (pair[1] > 0.5));
        steps.count()
    };
    let spots =
        |size: &str| steps(&["line.brush.tip=chalk", &format!("paper.size={size}")]) - steps(&[]);
    assert!(spots("2px") > 2 * spots("9px"));
    let mapped = |mapping: &str| {
        drawn(&[
            "line.brush.tip=dry-brush",
            &format!("line.brush.mapping={mapping}"),
        ])
        .rgba
    };
    assert!(mapped("once") != mapped("length"));
}

/// Far lines are thinner where the style says so, and open strokes are pressed along themselves; rings are not.
#[test]
fn widths_follow_curves_over_depth_and_along_strokes() {
    let plain = ink(&drawn(&[]));
    let share = |settings: &[&str], columns: std::ops::Range<usize>| {
        let inked = ink(&drawn(settings));
        let within = |slot: &usize| columns.contains(&(slot % SIZE[0] as usize));
        let sum =
            |ink: &[f64]| -> f64 { (0..ink.len()).filter(within).map(|slot| ink[slot]).sum() };
        sum(&inked) / sum(&plain)
    };
    let (left, right) = (0..135, 165..SIZE[0] as usize);
    let far = ["line.width.depth.curve=[{ at = 0.0, factor = 1.0 }, { at = 1.0, factor = 0.2 }]"];
    let [near_share, far_share] = [&left, &right].map(|columns| share(&far, columns.clone()));
    assert!(
        far_share < near_share - 0.15 && near_share < 0.95,
        "{near_share} {far_share}"
    );
    // The left ball is a ring; the outline of the right one ends at it, twice.
    let light = ["line.width.pressure=[{ at = 0.0, factor = 0.25 }, { at = 1.0, factor = 0.25 }]"];
    assert!((share(&light, left) - 1.0).abs() < 1e-9);
    let pressed = share(&light, right);
    assert!((pressed - 0.25).abs() < 0.02, "{pressed}");
}
