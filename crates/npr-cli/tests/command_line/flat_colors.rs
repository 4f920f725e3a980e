//! Technical illustrations: lines over one flat colour for each object and material, without shade.

use crate::workplace::Workplace;
use std::collections::BTreeMap;
use std::io::Cursor;

/// A sheet in each of three materials side by side; the last has a texture, white on its left half and black on its
/// right.
const SHEETS: &str = "mtllib sheets.mtl\n\
    o Left\nv -3 0 0\nv -1 0 0\nv -1 2 0\nv -3 2 0\nusemtl Red\nf 1 2 3 4\n\
    o Middle\nv -1 0 -1\nv 1 0 -1\nv 1 2 -1\nv -1 2 -1\nusemtl Blue\nf 5 6 7 8\n\
    o Right\nv 1 0 0\nv 3 0 0\nv 3 2 0\nv 1 2 0\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl Paper\nf 9/1 10/2 11/3 12/4\n";

const MATERIALS: &str = "newmtl Red\nKd 1 0 0\nnewmtl Blue\nKd 0 0 1\n\
    newmtl Paper\nKd 1 1 1\nmap_Kd paper.png\n";

fn sheets() -> Workplace {
    let place = Workplace::new();
    place.put("sheets.obj", SHEETS.as_bytes());
    place.put("sheets.mtl", MATERIALS.as_bytes());
    let half = |x: u32, _| image::Rgb(if x < 32 { [255_u8; 3] } else { [0; 3] });
    let mut png = Cursor::new(Vec::new());
    let picture = image::RgbImage::from_fn(64, 64, half);
    picture
        .write_to(&mut png, image::ImageFormat::Png)
        .expect("a picture");
    place.put("paper.png", png.get_ref());
    place
}

const VIEW: [&str; 9] = [
    "--size",
    "192x96",
    "--eye",
    "0,1,9",
    "--target",
    "0,1,0",
    "--style",
    "technical",
    "--quiet",
];

const FLAT: [&str; 2] = ["--set", "shade.mode=flat"];

/// Light falls from the side, so that any shade would show.
#[test]
fn frames_have_one_colour_for_each_material_and_lines() {
    let place = sheets();
    let side = [
        "--set",
        "light.direction=[1.0, 0.1, 0.1]",
        "--set",
        "line.width.base=2px",
        "--set",
        "shade.ramp=[{ at = 0.0, light = 0.3 }, { at = 0.9, light = 1.0 }]",
    ];
    let drawn = [&["render", "sheets.obj"][..], &VIEW, &FLAT, &side].concat();
    place.npr(&drawn).assert_silent_success();
    let picture = image::load_from_memory(&place.get("sheets.png"));
    let mut counts = BTreeMap::new();
    for pixel in picture.expect("a picture").to_rgb8().pixels() {
        *counts.entry(pixel.0).or_insert(0) += 1;
    }
    let is_large = |(_, count): &(&[u8; 3], &i32)| **count > 500;
    let large: Vec<[u8; 3]> = counts
        .iter()
        .filter(is_large)
        .map(|(color, _)| *color)
        .collect();
    // Paper and page are white.
    assert_eq!(large, [[0, 0, 255], [255, 0, 0], [255; 3]]);
    assert!(counts.contains_key(&[0x10, 0x14, 0x18]), "no line shows");
}

/// Half of a texture white and half black is half of the light, which is 188 of 255 in sRGB.
#[test]
fn files_have_one_colour_for_each_material_and_lines() {
    let fills = |more: &[&str]| {
        let place = sheets();
        let drawn = ["lines", "sheets.obj", "-o", "sheets.svg", "--fill"];
        place
            .npr(&[&drawn[..], &VIEW, &FLAT, more].concat())
            .assert_silent_success();
        let svg = String::from_utf8(place.get("sheets.svg")).expect("text");
        let has = |color: &str| svg.contains(&format!("\"{color}\""));
        let lines = has("#101418");
        (lines, ["#ff0000", "#0000ff", "#ffffff", "#bcbcbc"].map(has))
    };
    let (lines, [red, blue, _, grey]) = fills(&[]);
    assert!(lines && red && blue && !grey, "base colours alone");
    let (lines, [red, blue, _, grey]) = fills(&["--set", "shade.use_textures=true"]);
    assert!(lines && red && blue && grey, "the mean of the texture");
}
