//! A figure whose hair keeps its line while its clothes adapt; its fringe is painted as they are, and goes with them.
//!
//! Set `NPR_ID_PICTURES` to a folder to look at it.

use super::fixture::{cut, frames, style};
use npr_core::camera::{Camera, Projection};
use npr_render::{Frame, Model, Picture, RendererOptions};
use npr_scene::Scene;
use npr_tests::models;
use std::collections::BTreeMap;

const SIZE: [u32; 2] = [360, 480];

/// Where in the figure's palette its skin lies, as parts of its width; hair and clothes have the columns beside it.
const SKIN: std::ops::Range<f32> = 0.33..0.67;

fn figure() -> Option<Scene> {
    let path = models()
        .into_iter()
        .find(|path| path.ends_with("godette_vrm1.vrm"))?;
    Some(npr_scene::load(&path, &npr_scene::LoadOptions::default()).unwrap())
}

/// Skin in one colour, everything else in another: drawn as the palette of the figure is laid out.
fn id_map(other: [u8; 3]) -> Picture {
    let texel = |i: u32| match SKIN.contains(&((i % 128) as f32 / 128.0)) {
        true => [255, 200, 160, 255],
        false => [other[0], other[1], other[2], 255],
    };
    Picture {
        size: [128; 2],
        rgba: (0..128 * 128).flat_map(texel).collect(),
    }
}

const LOOK: &str = r##"
    background = "#101828"
    line = { color = "#000000", width.base = "4px", background.scope = "all" }
    [[id_map]]
    image = "face.png"
    material = "Face"
    ids = [{ name = "hair", color = "#00ff00" }, { name = "skin", color = "#ffc8a0" }]
    [[id_map]]
    image = "body.png"
    material = "Body"
    ids = [{ name = "clothes", color = "#0000ff" }, { name = "skin", color = "#ffc8a0" }]
"##;

const ADAPT: &str = "[[rule]]\nmatch.id = 'clothes'\nline.background.method = 'contrast'";

fn keep(name: &str, frame: &Frame) {
    if let Ok(folder) = std::env::var("NPR_ID_PICTURES") {
        let path = std::path::Path::new(&folder).join(format!("{name}.png"));
        npr_tests::write_png(&path, frame).unwrap();
    }
}

#[test]
fn hair_keeps_its_line_while_clothes_adapt() {
    let Some(scene) = figure() else { return };
    let pictures = BTreeMap::from([
        ("face.png".to_owned(), id_map([0, 255, 0])),
        ("body.png".to_owned(), id_map([0, 0, 255])),
    ]);
    let scene = cut(scene, &style(LOOK), &pictures);
    let model = Model::new(&scene).unwrap();
    let (low, high) = model.bounds();
    let camera = Camera {
        eye: [0.6, 0.9, 4.0],
        target: [0.0, (low[1] + high[1]) * 0.5, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.42 },
    };
    let options = RendererOptions::new(SIZE);
    let drawn = |rules: &str, what: &str| {
        let style = style(&format!("{LOOK}{rules}"));
        let frames = frames(&scene, &style, &options, &camera);
        keep(what, &frames[0]);
        frames
    };
    let plain = drawn("", "plain");
    let adapted = drawn(ADAPT, "adapted");
    let regions = drawn(&regions_in_colors(), "regions").remove(0);
    let near_clothes = grown(&regions, |[r, _, b, _]| r < 90 && b > 180);
    let near_hair = grown(&regions, |[r, g, b, _]| r < 90 && g > 140 && b < 90);
    for (before, after) in plain.iter().zip(&adapted) {
        let is_light = |rgba: &[u8; 4]| rgba[..3].iter().map(|v| u32::from(*v)).sum::<u32>();
        let pairs = before
            .rgba
            .as_chunks::<4>()
            .0
            .iter()
            .zip(after.rgba.as_chunks::<4>().0);
        let (mut of_clothes, mut of_hair, mut all_of_hair) = (0, 0, 0);
        for (i, (a, b)) in pairs.enumerate() {
            if a != b {
                assert!(is_light(b) >= is_light(a), "lines only grow lighter");
            }
            let is_line = *a == [0, 0, 0, 255];
            let beside_hair = is_line && near_hair[i] && !near_clothes[i];
            of_clothes += usize::from(a != b && near_clothes[i]);
            of_hair += usize::from(a != b && beside_hair);
            all_of_hair += usize::from(beside_hair);
        }
        assert!(of_clothes > 2000, "clothes adapt: {of_clothes}");
        // Earrings go with the clothes, and are lines all over.
        let keeps = all_of_hair > 1000 && of_hair * 200 < all_of_hair;
        assert!(
            keeps,
            "hair keeps its line: {of_hair} of {all_of_hair} pixels"
        );
    }
}

/// Which pixels lie within the reach of a line of those of a colour.
fn grown(frame: &Frame, is_it: impl Fn([u8; 4]) -> bool) -> Vec<bool> {
    const REACH: u32 = 6;
    let pixels = frame.rgba.as_chunks::<4>().0;
    let near = |i: usize| {
        let [x, y] = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
        let rows = y.saturating_sub(REACH)..(y + REACH + 1).min(SIZE[1]);
        let columns = x.saturating_sub(REACH)..(x + REACH + 1).min(SIZE[0]);
        rows.into_iter().any(|y| {
            let mut row = columns.clone();
            row.any(|x| is_it(pixels[(y * SIZE[0] + x) as usize]))
        })
    };
    (0..pixels.len()).map(near).collect()
}

/// Each region in a colour of its own, to look at.
fn regions_in_colors() -> String {
    ["hair:#30c030", "skin:#ffc8a0", "clothes:#3060ff"]
        .map(|pair| {
            let (id, color) = pair.split_once(':').unwrap();
            format!("[[rule]]\nmatch.id = '{id}'\nshade.color = '{color}'\n")
        })
        .concat()
}
