//! Layers that are shown in place of the picture.

use crate::workplace::Workplace;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Two triangles in objects of their own, the right one farther away.
const PAIR: &[u8] = b"o Left\nv -2 0 0\nv -0.5 0 0\nv -2 2 0\nf 1 2 3\n\
    o Right\nv 0.5 0 -3\nv 2 0 -3\nv 2 2 -3\nf 4 5 6\n";

/// A large triangle before a small one.
const BEHIND: &[u8] = b"o Front\nv -2 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n\
    o Back\nv -0.3 0.3 -1\nv 0.3 0.3 -1\nv 0 0.8 -1\nf 4 5 6\n";

const LAYERS: [&str; 20] = [
    "triangle",
    "depth",
    "normal",
    "object",
    "material",
    "base",
    "light",
    "tones",
    "ink",
    "surfaces",
    "mask",
    "found",
    "sight",
    "pieces",
    "joined",
    "stroke",
    "kind",
    "uv",
    "line-depth",
    "line",
];

/// The colours of a layer's picture, the most frequent first.
fn colors(layer: &str) -> Vec<[u8; 3]> {
    colors_in(layer, &[])
}

/// The same in a style with further keys.
fn colors_in(layer: &str, keys: &[&str]) -> Vec<[u8; 3]> {
    colors_of(PAIR, layer, keys)
}

/// The same of another scene.
fn colors_of(scene: &[u8], layer: &str, keys: &[&str]) -> Vec<[u8; 3]> {
    let place = Workplace::new();
    place.put("pair.obj", scene);
    let view = ["--size", "96x64", "--eye", "0,1,9", "--target", "0,1,0"];
    let shown = ["render", "pair.obj", "--debug-layer", layer];
    let style = ["--set", "line.width.base=4px", "--quiet"];
    let keys = keys.iter().flat_map(|key| ["--set", key]);
    let keys: Vec<&str> = keys.collect();
    let outcome = place.npr(&[&shown[..], &view, &style, &keys].concat());
    outcome.assert_silent_success();
    let picture = image::load_from_memory(&place.get("pair.png"));
    let picture = picture.expect("a picture").to_rgb8();
    let mut counts = BTreeMap::new();
    for pixel in picture.pixels() {
        *counts.entry(pixel.0).or_insert(0) += 1;
    }
    let mut counts: Vec<_> = counts.into_iter().collect();
    counts.sort_by_key(|(_, count)| Reverse(*count));
    counts.into_iter().map(|(color, _)| color).collect()
}

#[test]
fn the_names_of_layers_are_listed() {
    let outcome = Workplace::new().npr(&["render", "--debug-layer", "list"]);
    let text = outcome.text();
    let first = text
        .lines()
        .filter_map(|line| line.split_whitespace().next());
    assert_eq!(first.collect::<Vec<_>>(), LAYERS);
}

#[test]
fn layers_show_what_they_are_about() {
    // Two objects before nothing, each of one colour.
    let objects = colors("object");
    assert_eq!((objects.len(), objects[0]), (3, [0; 3]));
    // Both face the eye, along +z; where nothing is there is no normal.
    assert_eq!(colors("normal"), [[128; 3], [128, 128, 255]]);
    // The nearer is white, the farther dark.
    assert_eq!(colors("depth"), [[0; 3], [255; 3], [26; 3]]);
    // So are their outlines, which lie in them.
    assert_eq!(colors("line-depth"), [[0; 3], [255; 3], [26; 3]]);
    // The outline of each is one stroke.
    assert_eq!(colors("stroke").len(), 3);
    // Both sides of strokes, and all of the way along them.
    let places = colors("uv");
    let [reds, greens] = [0, 1].map(|k| {
        let of_strokes = places.iter().filter(|color| color[2] == 96);
        of_strokes
            .map(|color| color[k] / 32)
            .collect::<BTreeSet<u8>>()
    });
    assert!(reds.len() == 8 && greens.len() >= 6, "{reds:?} {greens:?}");
    // Dark lines over grey.
    let lines = colors("line");
    assert_eq!(lines[0], [128; 3]);
    let is_dark = |color: &[u8; 3]| color.iter().all(|channel| *channel < 60);
    assert!(is_dark(&lines[1]), "{lines:?}");
}

/// The colours that many pixels of a picture of surfaces have, where nothing lies between them.
const SHARP: &str = "antialias.samples=1";

#[test]
fn stages_of_surfaces_show_their_share_of_the_style() {
    // Two triangles in one material.
    assert_eq!(colors_in("triangle", &[SHARP]).len(), 3);
    assert_eq!(colors_in("material", &[SHARP]).len(), 2);
    // The light comes from the eye, from behind, or from above.
    let space = "light.space=world";
    for (direction, grey) in [("0,0,1", 255), ("0,0,-1", 0), ("0,1,0", 128)] {
        let direction = format!("light.direction=[{direction}]");
        let found = colors_in("light", &[SHARP, space, &direction, "background=#ff0000"]);
        assert_eq!(found.len(), 2, "{found:?}");
        let off = i32::from(found[1][0]) - grey;
        assert!(off.abs() <= 1 && found[0] == [255, 0, 0], "{found:?}");
    }
    // A material of light 0.8 as it is, then in a tone of half of that; ink covers white, and then the tone.
    let keys = [
        SHARP,
        "background=#ff0000",
        "shade.ramp=[{ at = 0.0, light = 0.5 }]",
        "ink.tone=auto",
        "ink.color=#0000ff",
        "ink.dark_at=1.0",
        "ink.light_at=1.0",
    ];
    let of = |layer| colors_in(layer, &keys);
    let [base, tones] = [of("base"), of("tones")].map(|found| found[1]);
    assert!(tones[0] < base[0] - 30, "{base:?} {tones:?}");
    assert_eq!(of("ink")[1], [0, 0, 255]);
    assert_eq!(of("surfaces")[1], [0, 0, 255]);
}

#[test]
fn stages_of_lines_show_their_share_of_the_style() {
    // Ends of surfaces; two triangles side by side hide nothing.
    let orange = [255, 160, 0];
    for layer in ["found", "kind"] {
        assert!(colors(layer).contains(&orange), "{layer}");
    }
    let sights = colors("sight");
    let is_grey = |color: &[u8; 3]| color[0] == color[1] && color[1] == color[2];
    assert!(
        sights.contains(&[255; 3]) && sights.iter().all(is_grey),
        "{sights:?}"
    );
    // The same with the right one behind the left one.
    let behind = colors_of(BEHIND, "sight", &[]);
    assert!(behind.contains(&[255, 0, 0]), "{behind:?}");
    // Each line is one piece, and one stroke.
    let many = |layer: &str| {
        let bright = colors(layer).into_iter();
        bright
            .filter(|color| color.iter().all(|channel| *channel >= 64))
            .count()
    };
    assert!(many("pieces") >= many("joined") && many("joined") >= 2);
    // The mask holds what methods of pixels find.
    let found = colors_in("mask", &["line.method=shape"]);
    assert!(found.iter().any(|color| color[2] == 255), "{found:?}");
}

#[test]
fn empty_layers_are_told() {
    let place = Workplace::new();
    place.put("pair.obj", PAIR);
    let shown = ["render", "pair.obj", "--size", "64x64", "--debug-layer"];
    let mask = place.npr(&[&shown[..], &["mask"]].concat());
    let told = "the layer mask is of one colour: nothing of it shows in this frame";
    assert!(mask.stderr.contains(told), "{}", mask.stderr);
}

#[test]
fn a_layer_needs_a_scene_and_a_png() {
    let place = Workplace::new();
    place.put("pair.obj", PAIR);
    let layer = ["render", "--debug-layer", "depth"];
    let fault = |more: &[&str], told: &str| {
        place.npr(&[&layer, more].concat()).assert_fault(2, told);
    };
    fault(&[], "the scene is missing");
    fault(&["pair.obj", "-o", "x.exr"], "write it as .png");
    let unknown = place.npr(&["render", "pair.obj", "--debug-layer", "colour"]);
    unknown.assert_fault(2, "invalid value 'colour'");
}
