//! Layers that are shown in place of the picture.

use crate::workplace::Workplace;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Two triangles in objects of their own, the right one farther away.
const PAIR: &[u8] = b"o Left\nv -2 0 0\nv -0.5 0 0\nv -2 2 0\nf 1 2 3\n\
    o Right\nv 0.5 0 -3\nv 2 0 -3\nv 2 2 -3\nf 4 5 6\n";

const LAYERS: [&str; 7] = [
    "line",
    "depth",
    "line-depth",
    "normal",
    "object",
    "stroke",
    "uv",
];

/// The colours of a layer's picture, the most frequent first.
fn colors(layer: &str) -> Vec<[u8; 3]> {
    let place = Workplace::new();
    place.put("pair.obj", PAIR);
    let view = ["--size", "96x64", "--eye", "0,1,9", "--target", "0,1,0"];
    let shown = ["render", "pair.obj", "--debug-layer", layer];
    let style = ["--set", "line.width.base=4px", "--quiet"];
    let outcome = place.npr(&[&shown[..], &view, &style].concat());
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
