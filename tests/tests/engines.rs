//! The same pictures from both engines: 99.8 % of pixels within 2 of 255, and no 8x8 block beyond 6 of 255.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_gpu::processor::Processor;
use npr_render::Model;
use npr_style::Style;
use npr_tests::{Agreement, asset, device, draw_on, models, models_camera, samples};
use std::path::PathBuf;

/// Pictures of which single blocks may differ, and why; pixels must agree all the same. Which of them do depends on the
/// device.
const TIES: [(&str, &str); 1] = [(
    "debug_robot_vrm1.vrm",
    "its boxes share faces, so rounding decides which of two objects is in front",
)];

/// Draws a model in a style on both engines and prints how far they agree; nothing without a device.
fn agreement(what: &str, model: &Model, style: &Style, size: [u32; 2]) -> Option<Agreement> {
    let device = device()?;
    let camera = models_camera(model, size);
    let one = draw_on(&Processor, model, style, &camera, size);
    let two = draw_on(device, model, style, &camera, size);
    let agreement = Agreement::between(&one, &two, 2);
    println!("{what:45} {agreement}");
    Some(agreement)
}

/// Names what does not agree, after everything was drawn.
fn check(agreements: impl Iterator<Item = (String, Option<Agreement>)>) {
    let judged = agreements.filter_map(|(what, agreement)| Some((what, agreement?)));
    let failed: Vec<String> = judged
        .filter(|(what, agreement)| {
            let tie = TIES.iter().any(|(picture, _)| what.starts_with(picture));
            !(agreement.holds() || tie && agreement.within >= 0.998)
        })
        .map(|(what, agreement)| format!("{what}: {agreement}"))
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Draws files in presets on both engines.
fn check_files(files: impl Iterator<Item = PathBuf>, presets: &[&str]) {
    let preset = |name: &&str| ((*name).to_owned(), Style::preset(name).unwrap());
    let styles: Vec<(String, Style)> = presets.iter().map(preset).collect();
    let pictures = files.flat_map(|path| {
        let scene = npr_scene::load(&path, &npr_scene::LoadOptions::default()).unwrap();
        let model = Model::new(&scene).unwrap();
        let file = path.file_name().unwrap().to_string_lossy().into_owned();
        let of_style = |(name, style): &(String, Style)| {
            let what = format!("{file} {name}");
            let agreement = agreement(&what, &model, style, [480, 270]);
            (what, agreement)
        };
        styles.iter().map(of_style).collect::<Vec<_>>()
    });
    check(pictures);
}

#[test]
fn models_look_alike_in_the_everyday_presets() {
    check_files(samples().into_iter().chain(models()), &["toon", "ink"]);
}

/// Figures that the looks of comics are judged by, where the shared models are there.
const FIGURES: [&str; 6] = [
    "flight_helmet.glb",
    "godette_vrm1.vrm",
    "robot_animated.glb",
    "shader_ball.glb",
    "human_body.glb",
    "nefertiti_70k.glb",
];

const COMIC_LOOKS: [&str; 9] = [
    "comic-silver",
    "comic-light",
    "comic-modern",
    "crosshatch",
    "stipple",
    "pencil",
    "screentone",
    "cel-2",
    "cel-3",
];

#[test]
fn figures_look_alike_in_the_looks_of_comics() {
    let figures = models().into_iter().filter(|path| {
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        FIGURES.contains(&file.as_ref())
    });
    check_files(samples().into_iter().chain(figures), &COMIC_LOOKS);
}

#[test]
fn samples_look_alike_in_every_method() {
    let names = ["teapot_box_plane.glb", "still_life.glb"];
    let presets = ["technical", "okuya", "filter", "hull", "filter-hull"];
    let methods = ["shape", "edges", "angle"];
    let with_method = methods.map(|method| (method, npr_tests::lines(method)));
    let pictures = names.into_iter().flat_map(|name| {
        let model = Model::new(&asset(name)).unwrap();
        let preset = presets.map(|preset| (preset, Style::preset(preset).unwrap()));
        let styles = preset.into_iter().chain(with_method.clone());
        styles.map(move |(look, style)| {
            let what = format!("{name} {look}");
            let agreement = agreement(&what, &model, &style, [480, 270]);
            (what, agreement)
        })
    });
    check(pictures);
}

#[test]
fn samples_look_alike_at_other_sizes_and_mask_scales() {
    let model = Model::new(&asset("teapot_box_plane.glb")).unwrap();
    let sizes = [
        ([1280, 720], "1"),
        ([333, 501], "1.5"),
        ([641, 361], "3"),
        ([480, 270], "6"),
        ([7, 5], "1"),
        ([1, 1], "2"),
    ];
    let pictures = sizes.into_iter().map(|(size, scale)| {
        let mut style = Style::preset("ink").unwrap();
        style.set(&format!("detect.scale={scale}")).unwrap();
        let what = format!("{size:?} pixels, mask scale {scale}");
        let agreement = agreement(&what, &model, &style, size);
        (what, agreement)
    });
    check(pictures);
}
