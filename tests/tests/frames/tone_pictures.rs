//! Ramps and hatches from pictures, on the processor.

use super::comic_look::ball;
use npr_core::color::linear_from_srgb;
use npr_gpu::processor::Processor;
use npr_mesh::testing::{Random, icosphere};
use npr_render::{Frame, Model, Picture, RenderError, Renderer, RendererOptions};
use npr_scene::Scene;
use npr_stylesheet::{Stop, Style};
use npr_tests::comic::{SIZE, direction, draw, front, pixel, style, wall};
use npr_tests::{Agreement, Ink, Object, draw_from, draw_with, scene_of};
use std::collections::BTreeSet;

fn options(name: &str, size: [u32; 2], rgba: Vec<u8>) -> RendererOptions {
    RendererOptions {
        pictures: [(name.to_owned(), Picture { size, rgba })].into(),
        ..RendererOptions::new(SIZE)
    }
}

fn greys(bytes: &[u8]) -> Vec<u8> {
    bytes
        .iter()
        .flat_map(|byte| [*byte, *byte, *byte, 255])
        .collect()
}

fn draw_pictured(scene: &Scene, style: &Style, options: &RendererOptions) -> Frame {
    let model = Model::new(scene).unwrap();
    draw_with(&Processor, &model, style, &front(), options)
}

/// What [`Stage::new`] says of a style with pictures.
fn refusal(settings: &[&str], options: &RendererOptions) -> RenderError {
    let model = Model::new(&ball()).unwrap();
    let refused = Renderer::new(&Processor, &model, &style(settings), options);
    refused.err().unwrap()
}

const BYTES: [u8; 4] = [20, 90, 160, 255];

/// Stops that mean the same as a row of pixels.
fn stops() -> Vec<Stop> {
    let stop = |(i, byte): (usize, &u8)| {
        Stop::plain(i as f32 / 4.0, linear_from_srgb(f32::from(*byte) / 255.0))
    };
    BYTES.iter().enumerate().map(stop).collect()
}

#[test]
fn a_picture_of_four_pixels_draws_like_four_stops() {
    for softness in ["0", "0.2"] {
        let softness = format!("shade.softness={softness}");
        let mut stopped = style(&[&softness]);
        stopped.shade.ramp = stops();
        let pictured = style(&[&softness, "shade.ramp_image=r.png"]);
        let picture = options("r.png", [4, 1], greys(&BYTES));
        let one = draw_from(&ball(), &stopped, &front(), SIZE).frame;
        let two = draw_pictured(&ball(), &pictured, &picture);
        let agreement = Agreement::between(&one, &two, 1);
        assert!(agreement.within == 1.0, "{softness}: {agreement}");
    }
}

#[test]
fn a_part_may_have_its_own_picture_or_none() {
    let mut pictured = style(&["shade.ramp_image=r.png"]);
    let rule = "[[rule]]\nshade.ramp = [{ at = 0, light = 1 }]";
    pictured.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    let picture = options("r.png", [1, 1], greys(&[0]));
    let frame = draw_pictured(&ball(), &pictured, &picture);
    assert_eq!(pixel(&frame, 160, 120), [255; 3]);
    pictured.rule.clear();
    let frame = draw_pictured(&ball(), &pictured, &picture);
    assert_eq!(pixel(&frame, 160, 120), [0; 3]);
}

#[test]
fn pictures_that_are_missing_or_unfit_are_named_by_their_key() {
    let ramp = ["shade.ramp_image=r.png"];
    let none = RendererOptions::new(SIZE);
    assert_eq!(
        refusal(&ramp, &none).to_string(),
        "shade.ramp_image: the picture 'r.png' was not given"
    );
    let upright = options("r.png", [1, 2], vec![0; 8]);
    assert_eq!(
        refusal(&ramp, &upright).to_string(),
        "shade.ramp_image: a ramp runs from left to right in a picture 1 to 4096 pixels wide and not higher \
         than wide, not 1 x 2"
    );
    let hatch = ["ink.tone=hatch", "ink.hatch.image=h.png"];
    let empty = options("h.png", [0, 3], Vec::new());
    assert_eq!(
        refusal(&hatch, &empty).to_string(),
        "ink.hatch.image: a hatch picture has 1 to 4096 pixels per side, not 0 x 3"
    );
}

/// Upright bars, 8 of 16 pixels a period.
fn bars() -> RendererOptions {
    let row: Vec<u8> = (0..64).map(|x| if x % 16 < 8 { 0 } else { 255 }).collect();
    options("h.png", [64, 64], greys(&row.repeat(64)))
}

#[test]
fn strokes_are_drawn_with_a_picture_in_every_mapping() {
    let scene = scene_of(&[Object::new("Wall", wall(1.5, 0.0))]);
    let of = |mapping: &str| {
        let mapping = format!("ink.mapping={mapping}");
        let settings = [
            "ink.tone=hatch",
            "ink.hatch.image=h.png",
            "light.direction=[0,0.9,0.1]",
            "ink.direction=[0,1,0]",
            "ink.hatch.spacing=8px",
            &mapping,
        ];
        let frame = draw_pictured(&scene, &style(&settings), &bars());
        let middle = (80..240).flat_map(|x| (60..180).map(move |y| (x, y)));
        let dark = middle
            .filter(|(x, y)| pixel(&frame, *x, *y)[0] < 100)
            .count();
        (direction(&frame, 80..240, 60..180), dark)
    };
    for mapping in ["screen", "surface"] {
        let ([across, _], dark) = of(mapping);
        // On surfaces the picture is laid over its own half turn, which keeps upright bars upright.
        assert!(across > 0.6, "{mapping}: {across}");
        assert!((2_000..17_000).contains(&dark), "{mapping}: {dark}");
    }
    // Without coordinates the wall takes the surface, and says so.
    let model = Model::new(&scene).unwrap();
    let settings = ["ink.tone=hatch", "ink.hatch.image=h.png", "ink.mapping=uv"];
    let frame = draw_with(&Processor, &model, &style(&settings), &front(), &bars());
    assert!(frame.notices[0].ends_with("they have no UV coordinates"));
}

#[test]
fn a_pattern_in_a_rule_takes_the_place_of_the_picture() {
    let settings = ["ink.tone=hatch", "ink.mapping=screen"];
    let plain = draw(&ball(), &settings);
    let mut pictured = style(&[settings[0], settings[1], "ink.hatch.image=h.png"]);
    let rule = "[[rule]]\nink.hatch.pattern = 'parallel'";
    pictured.rule = Style::from_toml(rule, &|_| Err(String::new()))
        .unwrap()
        .rule;
    let frame = draw_pictured(&ball(), &pictured, &bars());
    assert_eq!(frame.rgba, plain.rgba);
}

/// Pieces of equal colour that lie together in a picture.
fn patches(frame: &Frame) -> usize {
    patches_of(frame, frame)
}

/// The same for the colours of another picture.
fn patches_of(frame: &Frame, other: &Frame) -> usize {
    let colors: BTreeSet<&[u8]> = other.rgba.chunks_exact(4).collect();
    let pieces = |color: &[u8]| Ink::of_color(frame, color).components().len();
    colors.into_iter().map(pieces).sum()
}

#[test]
fn the_grain_of_a_scan_does_not_show_in_the_edges_of_tones() {
    // Without lines and grey edges, each patch is a tone, the background, or a speck of grain.
    let scene = scanned_ball();
    let drawn = |calm: &str| {
        let settings = ["line.method=none", "antialias.samples=1", calm];
        patches(&draw_from(&scene, &toon(&settings), &front(), SIZE).frame)
    };
    let [grainy, calm] = ["shade.calm=0", "shade.calm=0.1"].map(drawn);
    assert!(grainy > 4 * calm, "{grainy} {calm}");
}

#[test]
fn tones_have_no_pieces_narrower_than_the_least() {
    // Grain makes many; with the key they are gone, and what is left is what a calm surface shows.
    let scene = scanned_ball();
    let drawn = |least: &str| {
        let settings = [
            "line.method=none",
            "antialias.samples=1",
            "shade.calm=0",
            least,
        ];
        draw_from(&scene, &toon(&settings), &front(), SIZE).frame
    };
    let [grainy, some, even] =
        ["shade.least=0", "shade.least='1px'", "shade.least='4px'"].map(drawn);
    let counts = [&grainy, &some, &even].map(|frame| patches_of(frame, &grainy));
    assert!(counts[0] > counts[1] && counts[1] > counts[2], "{counts:?}");

    // The masses stay: few pixels have another colour.
    let agreement = Agreement::between(&grainy, &even, 2);
    assert!(agreement.within > 0.9, "{agreement}");
}

/// The preset `toon` with settings.
fn toon(settings: &[&str]) -> Style {
    let mut style = Style::preset("toon").unwrap();
    for setting in settings {
        style.set(setting).unwrap();
    }
    style
}

/// A ball whose normals are those of a scan: each a little aside.
fn scanned_ball() -> Scene {
    let mut scene = scene_of(&[Object::new("Ball", icosphere(5))]);
    let part = &mut scene.meshes[0].parts[0];
    let mut random = Random::new(20_031);
    let mut aside = || (2.0 * random.unit() - 1.0) * 0.1;
    let normals = part.positions.iter().map(|p| {
        let shaken = glam::Vec3::from(*p) + glam::Vec3::new(aside(), aside(), aside());
        shaken.normalize().to_array()
    });
    part.normals = Some(normals.collect());
    scene
}
