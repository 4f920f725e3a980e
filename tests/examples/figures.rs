//! Figures of Okuya et al. 2016 rebuilt from our scenes: `cargo run -p npr-tests --example figures -- docs/figures`.

use npr_render::Frame;
use npr_stylesheet::Style;
use npr_tests::{asset, beside, cropped, draw, reduced, write_png};
use std::path::Path;

const TEAPOT: &str = "teapot_box_plane.glb";

/// Frame in which masks and lines have their published sizes; a seventh of it fits two to a row.
const FULL: [u32; 2] = [1904, 1064];

/// A style from a preset with some settings changed.
fn style(preset: &str, settings: &[&str]) -> Style {
    let mut style = Style::preset(preset).expect("a preset");
    for setting in settings {
        style.set(setting).expect("a valid setting");
    }
    style
}

/// The published mask alone, from some of its tests.
fn mask(depth: bool, normal: bool) -> Style {
    style(
        "filter",
        &[
            "line.kinds.intersection=false",
            "detect.depth.threshold=0.02",
            &format!("detect.depth.on={depth}"),
            &format!("detect.normal.on={normal}"),
        ],
    )
}

/// The shaded cube, the lines wanted, and those found in depth, in normals and in both.
fn detection() -> Frame {
    let scene = asset("cube_plane.glb");
    let shaded = style("toon", &["line.method=none"]);
    let wanted = style("technical", &["line.width.base=6"]);
    let styles = [
        shaded,
        wanted,
        mask(true, false),
        mask(false, true),
        mask(true, true),
    ];
    beside(
        &styles.map(|style| reduced(&draw(&scene, &style, [624, 351]), 3)),
        3,
    )
}

/// The published method on one triangle of the cube: its edges as quads, and the same where the mask shows them.
fn quads() -> Frame {
    let scene = asset("cube_plane.glb");
    let settings = [
        "line.width.base=30",
        "line.width.source=constant",
        "antialias.samples=1",
    ];
    let everywhere = style(
        "okuya",
        &[
            &settings[..],
            &["detect.normal.threshold_deg=0", "detect.depth.threshold=0"],
        ]
        .concat(),
    );
    let styles = [everywhere, mask(true, true), style("okuya", &settings)];
    beside(
        &styles.map(|style| reduced(&draw(&scene, &style, [832, 468]), 4)),
        3,
    )
}

/// Filter, hull, their union and the published method; then ours, which also inks where shapes meet.
fn methods() -> [Vec<Frame>; 2] {
    let scene = asset(TEAPOT);
    let settings = [
        "line.width.base=10",
        "line.width.min=0.2",
        "line.width.max=2",
    ];
    let ours = [
        &settings[..],
        &[
            "line.method=shape",
            "detect.plane_depth=true",
            "detect.object.on=true",
        ],
    ]
    .concat();
    let styles = [
        style("filter", &settings),
        style("hull", &settings),
        style("filter-hull", &settings),
        style("okuya", &settings),
        style("okuya", &ours),
    ];
    let frames = styles.map(|style| draw(&scene, &style, [1248, 702]));
    let whole = frames.each_ref().map(|frame| reduced(frame, 6));
    let near = frames.map(|frame| cropped(&frame, [700, 220], [208, 150]));
    [whole.to_vec(), near.to_vec()]
}

/// Masks at 1, 1.5, 3 and 6 frame pixels a texel, with what is drawn through them; then two drawings enlarged.
fn mask_scales() -> [Frame; 2] {
    let scene = asset(TEAPOT);
    let scaled = |preset: &str, scale: &str| {
        let scale = format!("detect.scale={scale}");
        draw(
            &scene,
            &style(
                preset,
                &[
                    "line.width.base=8",
                    "detect.rescale_thresholds=true",
                    &scale,
                ],
            ),
            FULL,
        )
    };
    let scales = ["1", "1.5", "3", "6"];
    let rows = scales
        .iter()
        .flat_map(|scale| ["filter", "okuya"].map(|preset| reduced(&scaled(preset, scale), 7)));
    let noise = ["3", "6"].map(|scale| cropped(&scaled("okuya", scale), [960, 330], [316, 240]));
    [beside(&rows.collect::<Vec<_>>(), 2), beside(&noise, 2)]
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("usage: figures FOLDER")?;
    let [whole, near] = methods();
    let [scales, noise] = mask_scales();
    let figures = [
        ("okuya_3_to_5_detection", detection()),
        ("okuya_6_quads", quads()),
        ("okuya_11_methods", beside(&whole, 3)),
        ("okuya_11_enlarged", beside(&near, 3)),
        ("okuya_15_mask_scales", scales),
        ("okuya_16_noise", noise),
    ];
    for (name, frame) in figures {
        write_png(&Path::new(&folder).join(format!("{name}.png")), &frame)?;
    }
    Ok(())
}
