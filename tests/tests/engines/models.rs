//! The same pictures from both engines: 99.8 % of pixels within 2 of 255, and no 8x8 block beyond 6 of 255.

use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, Model, Picture, RendererOptions, Subject};
use npr_scene::Scene;
use npr_stylesheet::Style;
use npr_tests::{Agreement, asset, device, draw_of, draw_with, models, models_camera, samples};
use std::path::PathBuf;

/// Pictures of which single blocks may differ, and why; pixels must agree all the same. Which of them do depends on the
/// device.
const TIES: [(&str, &str); 1] = [(
    "debug_robot_vrm1.vrm",
    "its boxes share faces, so rounding decides which of two objects is in front",
)];

/// Draws a model in a style on both engines and prints how far they agree; nothing without a device.
fn agreement(what: &str, model: &Model, style: &Style, size: [u32; 2]) -> Option<Agreement> {
    agreement_with(what, model, style, &RendererOptions::new(size))
}

/// The same with the strokes that a style asks for.
fn agreement_of(what: &str, scene: &Scene, style: &Style, size: [u32; 2]) -> Option<Agreement> {
    let subject = Subject::new(scene, style).unwrap();
    let camera = models_camera(&subject.model, size);
    let options = RendererOptions::new(size);
    compared(what, |engine| {
        draw_of(engine, &subject, style, &camera, &options)
    })
}

fn agreement_with(
    what: &str,
    model: &Model,
    style: &Style,
    options: &RendererOptions,
) -> Option<Agreement> {
    let camera = models_camera(model, options.size);
    compared(what, |engine| {
        draw_with(engine, model, style, &camera, options)
    })
}

/// Compares what both engines draw, and prints how far they agree; nothing without a device.
fn compared(what: &str, draw: impl Fn(&dyn Engine) -> Frame) -> Option<Agreement> {
    let device = device()?;
    let agreement = Agreement::between(&draw(&Processor), &draw(device), 2);
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

/// Draws files on both engines: the samples in every preset, the others in `most` of them, each in other ones.
fn check_files(files: impl Iterator<Item = PathBuf>, presets: &[&str], most: usize) {
    let preset = |name: &&str| ((*name).to_owned(), Style::preset(name).unwrap());
    let styles: Vec<(String, Style)> = presets.iter().map(preset).collect();
    let samples = samples().into_iter().map(|path| (path, 0, styles.len()));
    let others = (0..).zip(files);
    let others = others.map(|(number, path)| (path, most * number, most));
    let pictures = samples.chain(others).flat_map(|(path, first, count)| {
        let scene = npr_scene::load(&path, &npr_scene::LoadOptions::default()).unwrap();
        let file = path.file_name().unwrap().to_string_lossy().into_owned();
        let of_style = |(name, style): &(String, Style)| {
            let what = format!("{file} {name}");
            let agreement = agreement_of(&what, &scene, style, [320, 180]);
            (what, agreement)
        };
        let styles = styles.iter().cycle().skip(first % styles.len());
        styles.take(count).map(of_style).collect::<Vec<_>>()
    });
    check(pictures);
}

#[test]
fn models_look_alike_in_the_everyday_presets() {
    check_files(models().into_iter(), &["toon", "ink"], 1);
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

fn figures() -> impl Iterator<Item = PathBuf> {
    models().into_iter().filter(|path| {
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        FIGURES.contains(&file.as_ref())
    })
}

/// Looks that draw their lines with brushes.
const BRUSHED: [&str; 9] = [
    "inked",
    "manga",
    "brush",
    "ink-wash",
    "sketch",
    "pencil-outline",
    "charcoal",
    "chalkboard",
    "blueprint",
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
    // Six figures in three looks each: every look has two of them.
    check_files(figures(), &COMIC_LOOKS, 3);
}

#[test]
fn figures_look_alike_with_brushes() {
    check_files(figures(), &BRUSHED, 3);
}

#[test]
fn samples_look_alike_in_every_method() {
    let names = ["teapot_box_plane.glb", "still_life.glb"];
    let presets = ["technical", "okuya", "filter", "hull", "filter-hull"];
    let methods = ["strokes", "shape", "edges", "angle"];
    let with_method = methods.map(|method| (method, npr_tests::lines(method)));
    let pictures = names.into_iter().flat_map(|name| {
        let scene = asset(name);
        let preset = presets.map(|preset| (preset, Style::preset(preset).unwrap()));
        let styles = preset.into_iter().chain(with_method.clone());
        styles.map(move |(look, style)| {
            let what = format!("{name} {look}");
            let agreement = agreement_of(&what, &scene, &style, [480, 270]);
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

/// A ramp of hard and soft tones and a sheet of crosses, as pictures.
fn tone_pictures() -> RendererOptions {
    let ramp = (0..256u32).flat_map(|x| {
        let tone = if x < 80 { 30 } else { x as u8 };
        [tone, tone, tone.max(60), 255]
    });
    let sheet = (0..32 * 32u32).flat_map(|i| {
        let dark = i % 32 < 6 || i / 32 < 6;
        [if dark { 10 } else { 240 }; 4]
    });
    let picture = |size, rgba| Picture { size, rgba };
    RendererOptions {
        pictures: [
            ("ramp.png".to_owned(), picture([256, 1], ramp.collect())),
            ("sheet.png".to_owned(), picture([32, 32], sheet.collect())),
        ]
        .into(),
        ..RendererOptions::new([480, 270])
    }
}

#[test]
fn pictures_and_directions_of_tones_look_alike() {
    let looks: [(&str, &[&str]); 8] = [
        (
            "speed lines",
            &["rule=[{ motion = { trail = [3.0, 1.0, 0.0] } }]"],
        ),
        (
            "a part that shines",
            &[
                "light.intensity=0.4",
                "rule=[{ match = { object = \"*eapot*\" }, beam = { light = 0.7 } }]",
                "ink.tone=ink+hatch",
            ],
        ),
        (
            "half way to plain shading",
            &[
                "ink.tone=ink+hatch",
                "blend.amount=0.5",
                "highlight.back.on=true",
            ],
        ),
        ("ramp from a picture", &["shade.ramp_image=ramp.png"]),
        (
            "soft ramp from a picture under ink",
            &[
                "shade.ramp_image=ramp.png",
                "shade.softness=0.1",
                "ink.tone=ink+hatch",
            ],
        ),
        (
            "hatch from a picture",
            &["ink.tone=ink+hatch", "ink.hatch.image=sheet.png"],
        ),
        (
            "hatch from a picture on the screen, along the light",
            &[
                "ink.tone=hatch",
                "ink.hatch.image=sheet.png",
                "ink.mapping=screen",
                "ink.follow=light",
            ],
        ),
        (
            "strokes on surfaces along the light, in a shadow",
            &[
                "ink.tone=ink+hatch",
                "ink.follow=light",
                "light.shadow=true",
            ],
        ),
    ];
    let model = Model::new(&asset("still_life.glb")).unwrap();
    let pictures = looks.into_iter().map(|(what, settings)| {
        let mut style = Style::preset("toon").unwrap();
        for setting in settings {
            style.set(setting).unwrap();
        }
        let agreement = agreement_with(what, &model, &style, &tone_pictures());
        (what.to_owned(), agreement)
    });
    check(pictures);
}

/// Frames that go on from one another, as lines before a background do.
#[test]
fn films_agree() {
    let Some(device) = device() else { return };
    let model = Model::new(&asset("still_life.glb")).unwrap();
    let size = [480, 270];
    let mut style = Style::preset("night").unwrap();
    for setting in [
        "background=grey.png",
        "line.background.start=rim",
        "line.background.subjects=object",
    ] {
        style.set(setting).unwrap();
    }
    let grey = |i: u32| {
        let level = (i % size[0] / 2) as u8 ^ (i / size[0] / 24 % 2 * 40) as u8;
        [level, level, level, 255]
    };
    let options = RendererOptions {
        background_image: Some(Picture {
            size,
            rgba: (0..size[0] * size[1]).flat_map(grey).collect(),
        }),
        ..RendererOptions::new(size)
    };
    let mut camera = models_camera(&model, size);
    let engines: [&dyn Engine; 2] = [&Processor, device];
    let mut renderers =
        engines.map(|engine| npr_render::Renderer::new(engine, &model, &style, &options).unwrap());
    let mut first = None;
    for frame in 0..8 {
        let [one, two] = renderers
            .each_mut()
            .map(|renderer| renderer.draw(&camera).unwrap());
        let agreement = Agreement::between(&one, &two, 2);
        assert!(agreement.holds(), "frame {frame}: {agreement}");
        camera.eye[0] += 0.02;
        let first = first.get_or_insert(one.rgba.clone());
        assert!(frame == 0 || *first != one.rgba, "the camera moves");
    }
}
