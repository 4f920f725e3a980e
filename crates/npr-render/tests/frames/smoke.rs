//! Whole pictures of smoke: what Hoshino 2004 promise of them, alone and among surfaces.
//!
//! Set `NPR_SMOKE_PICTURES` to a folder to look at them.

use npr_core::camera::{Camera, Projection};
use npr_core::math::{cos, mix_bits, sin};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, Model, Picture, RenderError, Renderer, RendererOptions, Smoke, Sphere};
use npr_scene::{Mesh, Node, Part, Scene};
use npr_stylesheet::Style;

const SIZE: [u32; 2] = [256, 256];

fn share(i: u32, k: u32) -> f32 {
    (mix_bits(mix_bits(i) ^ k.wrapping_mul(0x9e37_79b9)) >> 8) as f32 / (1 << 24) as f32
}

/// Puffs arranged as a plume: small and hot at its foot, wide at its top.
fn plume(count: u32) -> Smoke {
    let puff = |i: u32| {
        let height = share(i, 1);
        let spread = 0.15 + 0.6 * height;
        let (angle, out) = (
            share(i, 2) * std::f32::consts::TAU,
            share(i, 3).sqrt() * spread,
        );
        let sway = 0.25 * sin(height * 4.0);
        let radius =
            (0.08 + 0.24 * height) * (0.5 + 0.8 * share(i, 4)) * (1.0 - 0.4 * out / spread);
        let center = [cos(angle) * out + sway, height * 3.0, sin(angle) * out];
        Sphere {
            heat: (1.1 - height * 1.1).clamp(0.0, 1.0),
            ..Sphere::new(center, radius)
        }
    };
    Smoke {
        spheres: (0..count).map(puff).collect(),
        space: Some(([-1.2, -0.3, -1.2], [1.2, 3.6, 1.2])),
    }
}

/// A camera that looks at the plume from an angle in degrees.
fn camera(angle_deg: f32) -> Camera {
    let angle = angle_deg.to_radians();
    Camera {
        eye: [8.0 * sin(angle), 2.2, 8.0 * cos(angle)],
        target: [0.1, 1.65, 0.0],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.5 },
    }
}

fn style(text: &str) -> Style {
    Style::from_toml(text, &|name| Err(format!("no {name}"))).unwrap()
}

fn empty() -> Model {
    Model::new(&Scene::default()).unwrap()
}

/// A square that faces +z, `half` to each side of the axis, at a depth.
fn wall(half: f32, middle: [f32; 2], z: f32) -> Model {
    let corner = |x: f32, y: f32| [middle[0] + x * half, middle[1] + y * half, z];
    let mut scene = Scene::default();
    let part = Part {
        positions: vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Part::default()
    };
    scene.meshes.push(Mesh {
        name: String::new(),
        parts: vec![part],
    });
    scene.nodes.push(Node {
        mesh: Some(0),
        ..Node::default()
    });
    Model::new(&scene).unwrap()
}

fn draw_on(
    engine: &dyn Engine,
    model: &Model,
    smoke: &Smoke,
    style: &Style,
    camera: &Camera,
    size: [u32; 2],
) -> Frame {
    let options = RendererOptions {
        smoke: Some(smoke.clone()),
        ..RendererOptions::new(size)
    };
    let mut renderer = Renderer::new(engine, model, style, &options).unwrap();
    renderer.draw(camera).unwrap()
}

fn draw(smoke: &Smoke, style: &Style, camera: &Camera) -> Frame {
    draw_on(&Processor, &empty(), smoke, style, camera, SIZE)
}

fn at(frame: &Frame, x: u32, y: u32) -> [u8; 3] {
    let start = ((y * frame.size[0] + x) * 4) as usize;
    [
        frame.rgba[start],
        frame.rgba[start + 1],
        frame.rgba[start + 2],
    ]
}

fn keep(name: &str, frame: &Frame) {
    if let Ok(folder) = std::env::var("NPR_SMOKE_PICTURES") {
        let path = std::path::Path::new(&folder).join(format!("{name}.png"));
        image::save_buffer(
            path,
            &frame.rgba,
            frame.size[0],
            frame.size[1],
            image::ColorType::Rgba8,
        )
        .unwrap();
    }
}

/// Share of pixels that differ by more than a little.
fn changed(a: &Frame, b: &Frame) -> f32 {
    let pairs = a.rgba.chunks(4).zip(b.rgba.chunks(4));
    let differ = pairs
        .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 24))
        .count();
    differ as f32 / (a.size[0] * a.size[1]) as f32
}

const PLAIN: &str = "line.method = 'none'\n[smoke]\nline.method = 'off'\n";

/// One-pixel steps between two tones in a picture without lines: how much outline of puffs its tones show.
fn edges(frame: &Frame) -> usize {
    let [width, height] = frame.size;
    let all = (0..height).flat_map(|y| (0..width - 1).map(move |x| (x, y)));
    all.filter(|(x, y)| at(frame, *x, *y)[0].abs_diff(at(frame, x + 1, *y)[0]) > 40)
        .count()
}

#[test]
fn without_smoothing_every_sphere_shows_and_with_it_the_smoke_is_one_body() {
    let smoke = plume(300);
    let rough = draw(&smoke, &style(&format!("{PLAIN}sigma = 0")), &camera(0.0));
    let calm = draw(&smoke, &style(&format!("{PLAIN}sigma = 20")), &camera(0.0));
    keep("sigma-0", &rough);
    keep("sigma-20", &calm);
    let (rough, calm) = (edges(&rough), edges(&calm));
    assert!(
        calm * 3 < rough * 2,
        "{calm} steps of tone instead of {rough}"
    );
}

#[test]
fn near_and_far_puffs_do_not_blend() {
    // Two puffs, one before the other, the far one in the light of its own.
    let puffs = vec![
        Sphere {
            heat: 0.0,
            ..Sphere::new([-0.5, 1.6, 1.5], 0.8)
        },
        Sphere {
            heat: 1.0,
            ..Sphere::new([0.5, 1.6, -1.5], 0.8)
        },
    ];
    let smoke = Smoke {
        space: Some(([-2.0, 0.0, -2.0], [2.0, 3.2, 2.0])),
        ..Smoke::new(puffs)
    };
    let ramp = "heat = 1\nshadow = false\nlayers = LAYERS\nsoftness = 0.5\nsigma = 60\n\
                ramp = [{ at = 0.0, color = '#000' }, { at = 0.5, color = '#fff' }]";
    let near = |layers: &str| {
        let text = format!("{PLAIN}{}", ramp.replace("LAYERS", layers));
        let frame = draw(&smoke, &style(&text), &camera(0.0));
        (0..SIZE[0])
            .map(|x| at(&frame, x, 128)[0])
            .filter(|v| (20..235).contains(v))
            .count()
    };
    let (one, many) = (near("1"), near("4"));
    assert!(one >= 10, "in one layer they run into each other: {one}");
    assert!(many <= 4, "in layers of their own they do not: {many}");
}

#[test]
fn tones_follow_the_light() {
    let smoke = plume(200);
    let lit_part = |x: f32, low: u32, high: u32| {
        let text = format!("light.direction = [{x}, 0.2, 0.3]\n{PLAIN}");
        let frame = draw(&smoke, &style(&text), &camera(0.0));
        let row = (low..high).flat_map(|x| (40..220).map(move |y| (x, y)));
        row.filter(|(x, y)| at(&frame, *x, *y)[0] == 0x9f).count()
    };
    let (left_dark, right_dark) = (lit_part(1.0, 0, 132), lit_part(1.0, 132, 256));
    assert!(
        left_dark > 2 * right_dark,
        "light from the right: {left_dark}, {right_dark}"
    );
    let (left_dark, right_dark) = (lit_part(-1.0, 0, 132), lit_part(-1.0, 132, 256));
    assert!(
        right_dark > 2 * left_dark,
        "light from the left: {left_dark}, {right_dark}"
    );
}

#[test]
fn a_small_turn_of_the_camera_changes_few_tones() {
    let smoke = plume(600);
    let turned = |text: &str| {
        let style = style(&format!("light.space = 'world'\n{PLAIN}{text}"));
        let orbit: Vec<Frame> = (0..4)
            .map(|i| draw(&smoke, &style, &camera(i as f32)))
            .collect();
        orbit
            .windows(2)
            .map(|pair| changed(&pair[0], &pair[1]))
            .sum::<f32>()
            / 3.0
    };
    let drawn = turned("sigma = 14");
    println!("tones that change per degree: {drawn}");
    assert!(drawn < 0.02, "{drawn} of all pixels change");
}

#[test]
fn smoke_hides_what_is_behind_and_surfaces_hide_smoke() {
    let smoke = Smoke::new(vec![Sphere::new([0.1, 1.65, 0.0], 0.8)]);
    let style = style(&format!(
        "{PLAIN}ambient = 1\n[shade]\nmode = 'paper'\npaper = '#f00'\nramp = [{{ at = 0.0, light = 1.0 }}]"
    ));
    let center = |z: f32| {
        let model = wall(0.4, [0.1, 1.65], z);
        let frame = draw_on(&Processor, &model, &smoke, &style, &camera(0.0), SIZE);
        at(&frame, 128, 128)
    };
    assert_eq!(center(2.0), [255, 0, 0], "the wall stands before the smoke");
    assert_eq!(center(-2.0), [0xf8, 0xf8, 0xfb], "and behind it");
    assert_eq!(center(0.0), [0xf8, 0xf8, 0xfb], "and within it");
}

#[test]
fn lines_of_things_in_front_stay_and_those_behind_are_hidden() {
    let smoke = Smoke::new(vec![Sphere::new([0.1, 1.65, 0.0], 0.9)]);
    let text = "line.color = '#00f'\nline.width.base = 24\nline.width.source = 'constant'\n[smoke]\nline.method \
        = 'off'\n[shade]\nmode = 'flat'";
    let blue = |z: f32| {
        let model = wall(0.35, [0.1, 1.65], z);
        let frame = draw_on(&Processor, &model, &smoke, &style(text), &camera(0.0), SIZE);
        frame
            .rgba
            .chunks(4)
            .filter(|p| p[2] > 180 && p[0] < 60)
            .count()
    };
    assert!(blue(1.5) > 100, "{}", blue(1.5));
    assert_eq!(blue(-1.5), 0);
}

#[test]
fn smoke_throws_its_shadow_on_a_wall() {
    let smoke = Smoke::new(vec![Sphere::new([0.1, 2.4, 1.5], 0.5)]);
    let model = wall(1.4, [0.1, 1.65], -0.5);
    let dark = |casts: bool| {
        let text = format!(
            "light.shadow = true\nlight.direction = [0, 0.5, 1]\nlight.space = 'world'\n{PLAIN}casts = {casts}"
        );
        let frame = draw_on(
            &Processor,
            &model,
            &smoke,
            &style(&text),
            &camera(0.0),
            SIZE,
        );
        keep(if casts { "casts" } else { "casts-not" }, &frame);
        frame.rgba.chunks(4).filter(|p| p[0] < 200).count()
    };
    let (with, without) = (dark(true), dark(false));
    assert!(
        with > without + 300,
        "{with} dark pixels instead of {without}"
    );
}

/// Dark pixels of a puff before the camera, under lights and a ramp of two tones.
fn dark_pixels(model: &Model, smoke: &Smoke, text: &str, name: &str) -> usize {
    let tones = "sigma = 0\nwrap = 1\nambient = 0\nramp = [{ at = 0.0, color = '#600' }, { at = 0.2, color = '#ffe' }]";
    let text = format!("line.method = 'none'\n{text}\n[smoke]\nline.method = 'off'\n{tones}");
    let frame = draw_on(&Processor, model, smoke, &style(&text), &camera(0.0), SIZE);
    keep(name, &frame);
    frame
        .rgba
        .chunks(4)
        .filter(|p| p[0] == 0x66 && p[1] == 0)
        .count()
}

#[test]
fn surfaces_throw_their_shadow_on_smoke() {
    let smoke = Smoke::new(vec![Sphere::new([0.1, 1.65, -1.0], 0.9)]);
    let sun = "light.direction = [0, 0.8, 1]\nlight.space = 'world'\nlight.shadow_at = 0.1";
    // A board above the view from the camera, right in the way of the light.
    let board = wall(0.5, [0.1, 3.0], 0.7);
    let dark = |shadow: bool, board: &Model| {
        let text = format!("{sun}\nlight.shadow = {shadow}");
        dark_pixels(board, &smoke, &text, "board-on-smoke")
    };
    let (without, with) = (dark(false, &board), dark(true, &board));
    assert!(
        with > without + 800,
        "{with} dark pixels, {without} without shadows"
    );
    assert!(
        dark(true, &wall(0.5, [0.1, 1.65], -4.0)) < without + 50,
        "behind the smoke"
    );
}

#[test]
fn a_lamp_throws_shadows_of_smoke_on_smoke_from_outside_and_within() {
    let large = Sphere::new([0.1, 1.65, -1.0], 0.9);
    let lamp = |z: f32| {
        format!(
            "light.intensity = 0\nlight.shadow_at = 0.1\n[[light.extra]]\nkind = 'point'\nposition = [0.1, \
             1.65, {z}]\nshadow = true"
        )
    };
    let dark = |z: f32, puffs: &[Sphere]| {
        let smoke = Smoke::new(puffs.to_vec());
        dark_pixels(&empty(), &smoke, &lamp(z), "lamp-on-smoke")
    };
    // A puff beside the axis throws its shadow on the large one: seen from the camera it covers little of it.
    let small = Sphere::new([0.35, 1.65, 0.6], 0.12);
    let alone = dark(3.0, &[large]);
    let shaded = dark(3.0, &[large, small]);
    assert!(shaded > alone + 60, "{shaded} dark pixels, {alone} alone");
    // The lamp amid the smoke: the puff between it and the large one, then the lamp between the two.
    let before = Sphere::new([0.1, 1.65, 2.2], 0.1);
    let (alone, shaded) = (
        dark(0.9, &[large, before]),
        dark(0.9, &[large, before, small]),
    );
    assert!(shaded > alone + 60, "{shaded} dark pixels, {alone} alone");
    let (alone, behind) = (dark(0.2, &[large]), dark(0.2, &[large, small]));
    assert!(
        behind < alone + 200,
        "{behind} dark pixels, {alone} without a puff behind the lamp"
    );
}

#[test]
fn every_light_throws_a_shadow_of_its_own() {
    let large = Sphere::new([0.1, 1.65, -1.0], 0.9);
    let small = Sphere::new([0.1, 1.65, 0.9], 0.1);
    let light = |x: f32| {
        format!(
            "[[light.extra]]\nkind = 'distant'\nintensity = 0.4\nshadow = true\ndirection = [{x}, 0, 1]\n"
        )
    };
    let lamp = "[[light.extra]]\nkind = 'point'\nintensity = 0.4\nshadow = true\nposition = [0.1, 2.4, 2.2]\n";
    let tones = "sigma = 0\nwrap = 1\nambient = 0\nline.method = 'off'\n\
                 ramp = [{ at = 0.0, color = '#600' }, { at = 0.9, color = '#ffe' }]";
    let dark = "line.method = 'none'\nlight.intensity = 0\nlight.shadow_at = 0";
    let text = [
        dark,
        "\n",
        &light(0.3),
        &light(-0.3),
        lamp,
        "[smoke]\n",
        tones,
    ]
    .concat();
    // Dark pixels to the left, to the right and below the puff.
    let dark = |puffs: &[Sphere]| {
        let frame = draw(&Smoke::new(puffs.to_vec()), &style(&text), &camera(0.0));
        keep("many-lights", &frame);
        [
            (100..117, 105..145),
            (139..156, 105..145),
            (116..140, 145..180),
        ]
        .map(|(xs, ys)| {
            let all = xs.flat_map(|x| ys.clone().map(move |y| (x, y)));
            all.filter(|(x, y)| at(&frame, *x, *y)[1] == 0).count()
        })
    };
    let (without, with) = (dark(&[large]), dark(&[large, small]));
    println!("{without:?} {with:?}");
    assert!(
        (0..3).all(|i| with[i] > without[i] + 20),
        "{without:?} {with:?}"
    );
}

#[test]
fn nothing_and_hostile_smoke_are_drawn_as_nothing() {
    let blank = draw(&Smoke::default(), &style(""), &camera(0.0));
    assert!(blank.rgba.iter().all(|byte| *byte == 255));
    let hostile = [f32::NAN, f32::INFINITY, -1.0, 0.0].map(|r| Sphere::new([0.0; 3], r));
    let frame = draw(&Smoke::new(hostile.to_vec()), &style(""), &camera(0.0));
    assert!(frame.rgba.iter().all(|byte| *byte == 255));
    let far = Smoke::new(vec![
        Sphere::new([1e30, 0.0, f32::MAX], 1e20),
        Sphere::new([f32::NAN; 3], 1.0),
    ]);
    draw(&far, &style(""), &camera(0.0));
}

#[test]
fn a_renderer_takes_as_many_spheres_as_it_was_made_for() {
    let (model, style) = (empty(), style(""));
    let options = RendererOptions {
        smoke: Some(plume(3)),
        ..RendererOptions::new([32, 32])
    };
    let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
    assert!(renderer.set_smoke(&plume(2)).is_ok());
    let refused = renderer.set_smoke(&plume(4)).unwrap_err();
    assert_eq!(
        refused,
        RenderError::TooMany {
            what: "spheres",
            limit: 3
        }
    );
    let mut bare =
        Renderer::new(&Processor, &model, &style, &RendererOptions::new([32, 32])).unwrap();
    assert!(bare.set_smoke(&plume(1)).is_err());
}

#[test]
fn both_looks_of_a_blend_have_the_smoke_of_the_moment() {
    let (model, mut style) = (empty(), style(""));
    for key in ["blend.with=technical", "blend.amount=0.5"] {
        style.set(key).unwrap();
    }
    let made_for = |count| {
        let options = RendererOptions {
            smoke: Some(plume(count)),
            ..RendererOptions::new([64, 64])
        };
        Renderer::new(&Processor, &model, &style, &options).unwrap()
    };
    let mut renderer = made_for(40);
    renderer.draw(&camera(0.0)).unwrap();
    renderer.set_smoke(&plume(4)).unwrap();
    let drawn = renderer.draw(&camera(0.0)).unwrap();
    let wanted = made_for(4).draw(&camera(0.0)).unwrap();
    assert!(drawn.rgba == wanted.rgba);
    assert!(drawn.rgba != made_for(40).draw(&camera(0.0)).unwrap().rgba);
}

#[test]
fn pictures_are_the_same_for_any_number_of_threads_and_nearly_in_tiles() {
    let (smoke, style, model) = (plume(200), style("smoke.sigma = 9"), empty());
    let size = [200, 301];
    let drawn = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| draw_on(&Processor, &model, &smoke, &style, &camera(3.0), size))
    };
    let one = drawn(1);
    assert_eq!(one.rgba, drawn(3).rgba);
    let options = RendererOptions {
        smoke: Some(smoke.clone()),
        tile_pixels: 20_000,
        ..RendererOptions::new(size)
    };
    let tiled = Renderer::new(&Processor, &model, &style, &options)
        .unwrap()
        .draw(&camera(3.0))
        .unwrap();
    let apart = changed(&one, &tiled);
    assert!(apart < 0.01, "{apart} of all pixels differ in tiles");
}

const LOOKS: [&str; 6] = [
    "smoke-cel-2",
    "smoke-cel-3",
    "smoke-ink",
    "smoke-comic",
    "cloud",
    "explosion",
];

/// Pictures to look at; only where they are asked for.
#[test]
fn plumes_to_look_at() {
    if std::env::var("NPR_SMOKE_PICTURES").is_err() {
        return;
    }
    for look in LOOKS {
        let style = Style::preset(look).unwrap();
        for (count, size) in [(200, [512, 512]), (2000, [1920, 1080])] {
            let options = RendererOptions {
                smoke: Some(plume(count)),
                ..RendererOptions::new(size)
            };
            let model = empty();
            let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
            renderer.draw(&camera(0.0)).unwrap();
            let frame = renderer.draw(&camera(0.0)).unwrap();
            let times: Vec<String> = frame
                .times
                .iter()
                .map(|t| format!("{} {:.1?}", t.name, t.time))
                .collect();
            println!("{look} {count}: {}", times.join(", "));
            keep(&format!("{look}-{count}"), &frame);
        }
    }
    let published =
        style("[smoke]\nline.method = 'published'\nlayer_blend = 0\nsigma = '3px'\nwrap = 0");
    keep("published", &draw(&plume(150), &published, &camera(0.0)));
    keep(
        "billboards",
        &draw(
            &plume(150),
            &style("smoke.method = 'billboards'"),
            &camera(0.0),
        ),
    );
}

/// A picture of as many pixels as there are tones.
fn strip(tones: &[[u8; 3]]) -> Picture {
    Picture {
        size: [tones.len() as u32, 1],
        rgba: tones
            .iter()
            .flat_map(|[r, g, b]| [*r, *g, *b, 255])
            .collect(),
    }
}

/// The ramp alone, without lines: as many tones as the picture has pixels, and those of the same stops where they are
/// few.
#[test]
fn a_picture_gives_the_tones() {
    let smoke = Smoke::new(vec![Sphere::new([0.1, 1.65, 0.0], 1.2)]);
    let common = "background = 'blue'\nsmoke.line.method = 'off'\nsmoke.sigma = '0px'\nsmoke.shadow = false\n\
        antialias.samples = 1\n\
                  smoke.light = [1, 0, 0]\nsmoke.ambient = 0.0\nsmoke.wrap = 1.0\n";
    let with = |tones: &[[u8; 3]]| {
        let style = style(&format!("{common}smoke.ramp_image = 'tones.png'"));
        let options = RendererOptions {
            smoke: Some(smoke.clone()),
            pictures: [("tones.png".to_owned(), strip(tones))].into(),
            ..RendererOptions::new(SIZE)
        };
        let model = empty();
        let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
        renderer.draw(&camera(0.0)).unwrap()
    };
    let greys: Vec<[u8; 3]> = (0..12).map(|i| [20 * i; 3]).collect();
    let frame = with(&greys);
    let row: Vec<[u8; 3]> = (0..SIZE[0]).map(|x| at(&frame, x, 128)).collect();
    let mut seen: Vec<u8> = row.iter().filter(|c| c[0] == c[2]).map(|c| c[0]).collect();
    seen.dedup();
    let steps = seen.iter().filter(|grey| **grey % 20 == 0).count();
    assert!(
        seen.is_sorted() && steps == 12,
        "light from the right gives every tone in turn: {seen:?}"
    );
    let few = with(&[[200, 30, 30], [250, 250, 60]]);
    let stops = "smoke.ramp = [{ at = 0, color = '#c81e1e' }, { at = 0.5, color = '#fafa3c' }]";
    let plain = draw(&smoke, &style(&format!("{common}{stops}")), &camera(0.0));
    assert!(changed(&few, &plain) < 0.005, "{}", changed(&few, &plain));
}

#[test]
fn a_picture_that_is_missing_is_told() {
    let style = style("smoke.ramp_image = 'tones.png'");
    let options = RendererOptions {
        smoke: Some(plume(3)),
        ..RendererOptions::new(SIZE)
    };
    let model = empty();
    let refused = Renderer::new(&Processor, &model, &style, &options)
        .err()
        .unwrap();
    assert!(
        refused.to_string().contains("smoke.ramp_image"),
        "{refused}"
    );
}

/// The comic look: paper in the light, strokes in the shade, ink in the dark; and strokes that stay where they are.
#[test]
fn smoke_is_inked_and_hatched() {
    let text = "background = 'white'\nsmoke.line.method = 'off'\nsmoke.ramp = [{ at = 0, color = 'white' }]\n\
        smoke.ambient = 0.0\n\
                smoke.light = [1, 0.3, 0.3]\nsmoke.ink = { tone = 'ink+hatch', dark_at = 0.1, light_at = 0.8 }";
    let smoke = Smoke::new(vec![Sphere::new([0.1, 1.65, 0.0], 1.2)]);
    let frame = draw(&smoke, &style(text), &camera(0.0));
    keep("hatched-ball", &frame);
    let changes = |columns: std::ops::Range<u32>| {
        let dark = |x: u32, y: u32| at(&frame, x, y)[0] < 128;
        let flips = |x: u32| (60..190).filter(|y| dark(x, *y) != dark(x, y + 1)).count();
        columns.map(flips).sum::<usize>()
    };
    let is_dark = |x: u32| at(&frame, x, 128)[0] < 60;
    assert!(!is_dark(200), "light is paper");
    assert!(is_dark(52), "the dark is ink");
    assert!(
        changes(80..130) > 100,
        "strokes between: {}",
        changes(80..130)
    );
    // A camera that slides sideways takes the sheet along: the picture moves, nothing else.
    let moved = |shift: f32| {
        let mut camera = camera(0.0);
        camera.projection = Projection::Parallel { height: 4.0 };
        camera.eye = [camera.eye[0] + shift, 1.65, camera.eye[2]];
        camera.target = [camera.target[0] + shift, 1.65, camera.target[2]];
        draw(&smoke, &style(text), &camera)
    };
    let (still, slid) = (moved(0.0), moved(-4.0 * 20.0 / 256.0));
    let differ = (30..220u32)
        .flat_map(|y| (0..230u32).map(move |x| (x, y)))
        .filter(|(x, y)| at(&still, *x, *y)[0].abs_diff(at(&slid, x + 20, *y)[0]) > 40)
        .count();
    assert!(differ < 190 * 230 / 200, "{differ} pixels");
}
