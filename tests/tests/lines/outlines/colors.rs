//! What lies over the colour of lines in frames.

use super::fixture::{front, front_camera, parts_scene, with};
use npr_mesh::testing::icosphere;
use npr_render::Frame;
use npr_tests::{Object, boxed, draw_from, lines, placed};
use std::collections::BTreeMap;

/// Methods that draw a box, but for `strokes` and `potrace`, whose strokes are tested by themselves, and `rim`, which
/// takes its colours from the surface.
const METHODS: [&str; 6] = ["shape", "okuya", "edges", "filter", "hull", "filter+hull"];

/// The colour that most pixels of lines between two columns have, with how many lines' pixels there are.
fn ink(frame: &Frame, columns: std::ops::Range<u32>) -> ([u8; 3], usize) {
    let pixels = frame.rgba.as_chunks::<4>().0.iter().enumerate();
    let mut counts: BTreeMap<[u8; 3], usize> = BTreeMap::new();
    for (i, [r, g, b, _]) in pixels {
        if columns.contains(&(i as u32 % frame.size[0])) && *g < 128 {
            *counts.entry([*r, *g, *b]).or_default() += 1;
        }
    }
    let most = counts.iter().max_by_key(|(_, count)| **count);
    let color = most.map_or([255; 3], |(color, _)| *color);
    (color, counts.values().sum())
}

#[test]
fn a_tint_lies_over_all_lines() {
    // Half of red over black: 0.5 of its light is 188.
    let tint = ["line.paint.tint=#ff000080"];
    for method in METHODS.into_iter().chain(["angle"]) {
        let ball = || Object::new("Ball", placed(&icosphere(4), [0.7; 3], [0.0; 3]));
        let [plain, tinted] = [&[][..], &tint].map(|settings| {
            let drawing = front(&[ball()], &with(lines(method), settings));
            ink(&drawing.frame, 0..200)
        });
        assert_eq!(plain.0, [0; 3], "{method}");
        let ([r, g, b], count) = tinted;
        assert!(
            r.abs_diff(188) <= 2 && g <= 2 && b <= 2 && count > 400,
            "{method}: {count} px of {:?}",
            [r, g, b]
        );
    }
}

/// A box near the camera keeps its black lines; those of one far from it are red.
#[test]
fn depth_changes_lines() {
    let ramp =
        "line.paint.depth.ramp=[{ at = 0.2, color = '#f000' }, { at = 0.8, color = '#f00' }]";
    let at = |x: f32, z: f32| boxed([x - 0.3, -0.3, z - 0.05], [x + 0.3, 0.3, z + 0.05]);
    let scene = parts_scene(&[(at(-0.5, 1.0), 0), (at(0.5, -1.0), 1)]);
    for method in METHODS {
        let style = with(lines(method), &[ramp]);
        let frame = draw_from(&scene, &style, &front_camera(), [200, 200]).frame;
        let [near, far] = [0..100, 100..200].map(|columns| ink(&frame, columns));
        assert!(near.1 > 200 && far.1 > 200, "{method}: {near:?} {far:?}");
        assert_eq!(near.0, [0; 3], "{method}, near");
        assert_eq!(far.0, [255, 0, 0], "{method}, far");
    }
}
