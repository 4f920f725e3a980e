//! The same pictures of smoke from both engines, by either kind of particles and in every look.

use npr_gpu::processor::Processor;
use npr_render::{Model, RendererOptions, Smoke};
use npr_smoke::Source;
use npr_stylesheet::Style;
use npr_tests::{Object, SmokeFilm, boxed, device, draw_with, orbit_camera, scene_of};

const LOOKS: [&str; 6] = [
    "smoke-cel-2",
    "smoke-cel-3",
    "smoke-ink",
    "smoke-comic",
    "cloud",
    "explosion",
];

/// What makes a look the published one, or that of billboards.
const METHODS: [&[&str]; 3] = [
    &[],
    &[
        "smoke.particles=published",
        "smoke.line.method=published",
        "smoke.layer_blend=0",
        "smoke.sigma=3px",
        "smoke.wrap=0",
    ],
    &["smoke.method=billboards"],
];

/// Smoke before and behind a box, under two lights that throw shadows: at most 1 pixel in 500 differs by more than 2
/// of 255.
#[test]
fn smoke_looks_alike_on_both_engines() {
    let Some(device) = device() else {
        return;
    };
    let film = SmokeFilm::new(Source::Plume, [15, 15, 20], 36);
    let model = Model::new(&scene_of(&[Object::new(
        "Box",
        boxed([-0.3, 0.2, -0.05], [0.3, 0.5, 0.05]),
    )]))
    .unwrap();
    for look in LOOKS {
        for settings in METHODS {
            let mut style = Style::preset(look).unwrap();
            let light = "light.extra=[{kind='point',position=[1.5,1,1],intensity=0.4,shadow=true}]";
            for setting in settings.iter().chain(&["light.shadow=true", light]) {
                style.set(setting).unwrap();
            }
            let smoke: Smoke = film.last(&style);
            let options = RendererOptions {
                smoke: Some(smoke),
                ..RendererOptions::new([256, 256])
            };
            let camera = orbit_camera(20.0);
            let here = draw_with(&Processor, &model, &style, &camera, &options);
            let there = draw_with(device, &model, &style, &camera, &options);
            let pairs = here.rgba.chunks(4).zip(there.rgba.chunks(4));
            let apart = pairs
                .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 2))
                .count();
            println!("{look} {settings:?}: {apart} pixels differ");
            assert!(
                apart * 500 < 256 * 256,
                "{look} {settings:?}: {apart} pixels differ"
            );
        }
    }
}
