//! Pictures of smoke from the built-in simulation, large enough to show what the publication promises of them.
//!
//! Set `NPR_SMOKE_PICTURES` to a folder to look at them.

use npr_gpu::processor::Processor;
use npr_render::{Frame, Model, Picture, Renderer, RendererOptions, Sphere};
use npr_scene::Scene;
use npr_smoke::{Source, Volume};
use npr_stylesheet::{Facts, Occasion, Output, Stated, Style};
use npr_tests::{SmokeFilm, draw_smoke, front_camera, orbit_camera, write_png};

/// The grid of the publication.
const PAPER: [u32; 3] = [15, 15, 20];

/// The picture of the publication.
const SIZE: [u32; 2] = [512, 512];

fn style(settings: &[&str]) -> Style {
    let mut style = Style::preset("smoke-cel-2").unwrap();
    for setting in settings {
        style.set(setting).unwrap();
    }
    style
}

fn keep(name: &str, frame: &Frame) {
    if let Ok(folder) = std::env::var("NPR_SMOKE_PICTURES") {
        write_png(
            &std::path::Path::new(&folder).join(format!("{name}.png")),
            frame,
        )
        .unwrap();
    }
}

/// A black shape on white.
struct Mask {
    size: [u32; 2],
    inside: Vec<bool>,
}

/// What an outline is like, over all its pixels.
#[derive(Debug)]
struct Outline {
    /// Share of them with little of the shape around: the tips of corners.
    corners: f32,
    /// Share of them that run straight across or straight down.
    along_axes: f32,
    /// How many there are.
    count: usize,
}

/// How far around a pixel the outline is looked at, a third of a voxel.
const AROUND_PX: i32 = 7;

impl Mask {
    fn new(size: [u32; 2], is_inside: impl Fn(u32, u32) -> bool) -> Self {
        let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        Self {
            size,
            inside: places.map(|(x, y)| is_inside(x, y)).collect(),
        }
    }

    fn at(&self, x: i32, y: i32) -> bool {
        let [width, height] = self.size.map(|side| side as i32);
        (0..width).contains(&x) && (0..height).contains(&y) && self.inside[(y * width + x) as usize]
    }

    fn area(&self) -> usize {
        self.inside.iter().filter(|inside| **inside).count()
    }

    /// How much of both the two have in common.
    fn overlap(&self, other: &Self) -> f32 {
        let pairs = || self.inside.iter().zip(&other.inside);
        let both = pairs().filter(|(a, b)| **a && **b).count();
        both as f32 / pairs().filter(|(a, b)| **a || **b).count() as f32
    }

    /// Looks at the shape in a disc round every pixel of the outline: a straight edge fills half of it and a right
    /// angle a quarter; its middle lies across the outline.
    fn outline(&self) -> Outline {
        let [width, height] = self.size.map(|side| side as i32);
        let (mut count, mut corners, mut along_axes) = (0, 0, 0);
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let is_beside = [(1, 0), (-1, 0), (0, 1), (0, -1)]
                .iter()
                .any(|(dx, dy)| !self.at(x + dx, y + dy));
            if !self.at(x, y) || !is_beside {
                continue;
            }
            let span = -AROUND_PX..=AROUND_PX;
            let disc = span
                .clone()
                .flat_map(|dy| span.clone().map(move |dx| (dx, dy)));
            let disc: Vec<(i32, i32)> = disc
                .filter(|(dx, dy)| dx * dx + dy * dy <= AROUND_PX * AROUND_PX)
                .collect();
            let shape: Vec<&(i32, i32)> = disc
                .iter()
                .filter(|(dx, dy)| self.at(x + dx, y + dy))
                .collect();
            let middle = shape
                .iter()
                .fold([0, 0], |sum, (dx, dy)| [sum[0] + dx, sum[1] + dy]);
            // The sine of 10 degrees.
            let [across, down] = middle.map(|v| v.abs() as f32);
            let is_along = across.min(down) < 0.1736 * (across * across + down * down).sqrt();
            count += 1;
            corners += usize::from((shape.len() as f32) < 0.36 * disc.len() as f32);
            along_axes += usize::from(is_along);
        }
        Outline {
            corners: corners as f32 / count as f32,
            along_axes: along_axes as f32 / count as f32,
            count,
        }
    }
}

/// The voxels of a volume above a density, seen along z through [`front_camera`] of this height.
fn voxels(volume: &Volume, threshold: f32, height: f32) -> Mask {
    let [width, depth, tall] = volume.size();
    let is_dense = |x: u32, y: u32, z: u32| {
        volume.density()[(x + width * (y + depth * z)) as usize] > threshold
    };
    Mask::new(SIZE, |x, y| {
        let unit_px = SIZE[1] as f32 / height;
        let world = [
            (x as f32 + 0.5 - 256.0) / unit_px,
            0.5 - (y as f32 + 0.5 - 256.0) / unit_px,
        ];
        // The built-in smoke's x is the world's, its z the world's y.
        let index = volume
            .index_from_world([world[0], world[1], 0.0].into())
            .round();
        let (i, k) = (index.x, index.z);
        let is_in_box = i >= 0.0 && k >= 0.0 && i < width as f32 && k < tall as f32;
        is_in_box && (0..depth).any(|j| is_dense(i as u32, j, k as u32))
    })
}

/// Pixels that are not the white of the paper.
fn shape(frame: &Frame) -> Mask {
    Mask::new(frame.size, |x, y| {
        let at = 4 * (y * frame.size[0] + x) as usize;
        frame.rgba[at..at + 3].iter().any(|byte| *byte < 128)
    })
}

/// The last frame of a film as a black shape on white paper, seen from the front.
fn drawn_black(film: &SmokeFilm, settings: &[&str], height: f32) -> Frame {
    let plain = [
        "smoke.line.method=off",
        "smoke.ramp=[{at=0,color='black'}]",
        "background=white",
    ];
    let black = style(&[settings, &plain].concat());
    let camera = front_camera(0.5, height);
    draw_smoke(&Processor, &film.last(&black), &black, &camera, SIZE)
}

/// The publication's own grid has twenty voxels from floor to ceiling. Its smoke is drawn round all the same: the
/// outline has no corners and no preferred direction, where the voxels it was made from are stairs.
#[test]
fn coarse_voxels_have_a_soft_round_outline() {
    let height = 1.15;
    let film = SmokeFilm::new(Source::Plume, PAPER, 40);
    let stairs = voxels(&film.volumes[39], 0.1, height);
    let of_stairs = stairs.outline();
    println!("voxels {of_stairs:?}");
    assert!(
        of_stairs.corners > 0.03 && of_stairs.along_axes > 0.7,
        "{of_stairs:?}"
    );
    for particles in ["cover", "published"] {
        let particles = format!("smoke.particles={particles}");
        let frame = drawn_black(&film, &[&particles], height);
        keep(&format!("outline-{particles}"), &frame);
        let drawn = shape(&frame);
        let outline = drawn.outline();
        println!(
            "{particles} {outline:?}, {} of the voxels' {}",
            drawn.overlap(&stairs),
            stairs.area()
        );
        assert!(outline.count > 600, "{outline:?}");
        assert!(
            outline.corners < of_stairs.corners / 3.0,
            "{particles}: {outline:?}"
        );
        // Of a circle's outline two ninths run within ten degrees of an axis.
        assert!(outline.along_axes < 0.35, "{particles}: {outline:?}");
    }
}

/// Ours is no rounder than the smoke is: what it covers is what the voxels cover.
#[test]
fn round_outlines_keep_the_shape_of_the_smoke() {
    let height = 1.15;
    let film = SmokeFilm::new(Source::Plume, PAPER, 40);
    let frame = drawn_black(&film, &[], height);
    let overlap = shape(&frame).overlap(&voxels(&film.volumes[39], 0.1, height));
    assert!(overlap > 0.8, "{overlap}");
}

/// Places where two pixels by two, or more, change at once by more than a third of black to white.
///
/// The camera moves by so little that an edge crawls by half a pixel at most, and changes no two beside each other.
fn pops(before: &Frame, after: &Frame) -> usize {
    let [width, height] = before.size;
    let changes = |x: u32, y: u32| {
        let at = 4 * (y * width + x) as usize;
        (0..3).any(|i| before.rgba[at + i].abs_diff(after.rgba[at + i]) > 85)
    };
    let places = (0..height - 1).flat_map(|y| (0..width - 1).map(move |x| (x, y)));
    let pops = |(x, y): &(u32, u32)| {
        [(0, 0), (1, 0), (0, 1), (1, 1)]
            .iter()
            .all(|(dx, dy)| changes(x + dx, y + dy))
    };
    places.filter(pops).count()
}

/// What pops while a camera goes round still smoke in steps of a quarter of a degree.
fn pops_on_the_way(film: &SmokeFilm, settings: &[&str], steps: u32) -> usize {
    let style = style(settings);
    let smoke = film.last(&style);
    let options = RendererOptions {
        smoke: Some(smoke),
        ..RendererOptions::new([384, 384])
    };
    let model = Model::new(&Scene::default()).unwrap();
    let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
    let frames: Vec<Frame> = (0..=steps)
        .map(|i| renderer.draw(&orbit_camera(i as f32 * 0.25)).unwrap())
        .collect();
    frames.windows(2).map(|pair| pops(&pair[0], &pair[1])).sum()
}

/// Black and white under a black line, so that all that pops counts.
const BOLD: [&str; 4] = [
    "light.space=world",
    "smoke.ramp=[{at=0,color='black'},{at=0.45,color='white'}]",
    "smoke.line.color=black",
    "background=white",
];

#[test]
fn a_camera_moves_round_smoke_and_nothing_pops() {
    let film = SmokeFilm::new(Source::Plume, [30, 30, 60], 48);
    let of = |more: &[&str]| pops_on_the_way(&film, &[&BOLD[..], more].concat(), 40);
    let ours = of(&[]);
    let layers = of(&["smoke.layer_blend=0"]);
    println!("pops: ours {ours}, without layers that blend {layers}");
    assert!(ours < 20, "{ours} in 40 steps");
    assert!(
        ours * 3 < layers,
        "{ours} against {layers} with layers that do not blend"
    );
}

/// The look that a billboard has is that of the publication it comes from; keys that shape spheres alone cannot act
/// on it, as the command says. The same for each other choice that makes keys idle.
#[test]
fn keys_that_are_said_to_do_nothing_do_nothing_and_others_do() {
    let film = SmokeFilm::new(Source::Plume, PAPER, 24);
    let changed = [
        ("smoke.puffs.detail", "5"),
        ("smoke.puffs.scale", "0.7"),
        ("smoke.puffs.ease", "0.9"),
        ("smoke.puffs.placement", "random"),
        ("smoke.puffs.still", "0.2"),
        ("smoke.puffs.count", "9"),
        ("smoke.puffs.threshold", "0.5"),
        ("smoke.wrap", "1"),
        ("smoke.ambient", "0.6"),
        ("smoke.shadow", "false"),
        ("smoke.light", "[-1,0,0]"),
        ("smoke.sigma", "2px"),
        ("smoke.layers", "9"),
        ("smoke.layer_depth", "0.02"),
        ("smoke.layer_blend", "0"),
        ("smoke.line.width", "9"),
        ("smoke.line.inner", "0"),
        ("smoke.line.jump", "2"),
        ("smoke.line.swell", "1"),
        ("smoke.line.weight", "2"),
        ("smoke.line.color", "red"),
    ];
    let common = ["light.shadow=true", "smoke.line.weight=20"];
    let occasion = Occasion {
        output: Output::Frame,
        scene: Facts::ALL,
    };
    let styles: [&[&str]; 5] = [
        &[],
        &["smoke.method=billboards"],
        &["smoke.particles=published", "smoke.line.method=published"],
        &["smoke.line.method=off"],
        &["smoke.method=billboards", "smoke.line.method=off"],
    ];
    for settings in styles {
        let settings = [&common[..], settings].concat();
        let usual = style(&settings);
        let mut stated = Stated::default();
        stated.set_all(&settings).expect("legal settings");
        let drawn = |style: &Style| {
            let smoke = film.last(style);
            draw_smoke(&Processor, &smoke, style, &orbit_camera(20.0), [192, 192]).rgba
        };
        let picture = drawn(&usual);
        for (key, value) in changed {
            let assignment = format!("{key}={value}");
            let other = drawn(&style(&[&settings[..], &[&assignment]].concat()));
            let reason = stated.idle_reason(key, &occasion);
            assert_eq!(
                picture == other,
                reason.is_some(),
                "{assignment} with {settings:?}: {reason:?}"
            );
        }
    }
}

/// Settings of spheres are settings of pictures: each particle of the publication is drawn with its own box's radius,
/// and ours at their own pace.
#[test]
fn published_particles_are_drawn_as_many_as_asked_for() {
    let film = SmokeFilm::new(Source::Puff, PAPER, 16);
    let spheres = |settings: &[&str]| film.last(&style(settings)).spheres;
    let published = spheres(&["smoke.particles=published", "smoke.puffs.count=37"]);
    assert_eq!(published.len(), 37);
    let radii = |spheres: &[Sphere]| {
        spheres
            .iter()
            .map(|s| s.radius)
            .fold((f32::MAX, 0.0f32), |(a, b), r| (a.min(r), b.max(r)))
    };
    let (least, most) = radii(&published);
    assert!(
        least > 0.0 && least < 0.3 * most,
        "lone particles are small: {least} beside {most}"
    );
    let ours = spheres(&["smoke.puffs.count=37"]);
    assert!(ours.len() <= 37 && ours != published);
}

/// The picture behind shows where no smoke is, as it is, and through smoke that is thin.
#[test]
fn a_picture_stands_behind_the_smoke() {
    let film = SmokeFilm::new(Source::Plume, PAPER, 40);
    let size = [160, 120];
    let painted = |x: u32, y: u32| [(x * 255 / 159) as u8, (y * 255 / 119) as u8, 40, 255];
    let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    let picture = Picture {
        size,
        rgba: places.clone().flat_map(|(x, y)| painted(x, y)).collect(),
    };
    let drawn = |settings: &[&str], picture: Option<Picture>| {
        let mut style = style(&[&["antialias.samples=1"], settings].concat());
        if picture.is_some() {
            style.set("background=painting.png").unwrap();
        }
        let options = RendererOptions {
            smoke: Some(film.last(&style)),
            background_image: picture,
            ..RendererOptions::new(size)
        };
        let model = Model::new(&Scene::default()).unwrap();
        let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
        renderer.draw(&orbit_camera(0.0)).unwrap()
    };
    let alone = drawn(&["background=transparent"], None);
    let before = drawn(&[], Some(picture.clone()));
    let thin = drawn(&["smoke.opacity=0.5"], Some(picture));
    keep("smoke-before-painting", &before);
    let (mut clear, mut covered, mut through) = (0, 0, 0);
    for ((x, y), i) in places.zip((0..).step_by(4)) {
        let at = |frame: &Frame| [frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]];
        let painted: [u8; 3] = std::array::from_fn(|i| painted(x, y)[i]);
        let is_near = |a: [u8; 3], b: [u8; 3]| (0..3).all(|i| a[i].abs_diff(b[i]) <= 1);
        match alone.rgba[i + 3] {
            0 => {
                clear += 1;
                assert!(
                    is_near(at(&before), painted),
                    "beside smoke: {:?}, not {painted:?}",
                    at(&before)
                );
            }
            255 => {
                covered += 1;
                assert!(
                    is_near(at(&before), at(&alone)),
                    "smoke hides what is behind"
                );
                through +=
                    usize::from(!is_near(at(&thin), painted) && !is_near(at(&thin), at(&alone)));
            }
            _ => {}
        }
    }
    assert!(clear > 5000 && covered > 1500, "{clear} and {covered}");
    assert!(
        through * 10 > covered * 9,
        "{through} of {covered} are a mixture"
    );
}

/// Clouds are the same method on other data, in paler paint: a bank wider than tall, sunlit heads over a shaded
/// belly, no line.
#[test]
fn a_cloud_is_wide_and_bright_above_and_has_no_lines() {
    let height = 1.15;
    let cloud = SmokeFilm::new(Source::Cloud, [48, 30, 24], 24);
    let style = Style::preset("cloud").unwrap();
    let frame = draw_smoke(
        &Processor,
        &cloud.last(&style),
        &style,
        &front_camera(0.25, height),
        SIZE,
    );
    keep("cloud", &frame);
    let sky = [0x6a, 0xa7, 0xe0];
    let at = |x: u32, y: u32| {
        let i = 4 * (y * SIZE[0] + x) as usize;
        [frame.rgba[i], frame.rgba[i + 1], frame.rgba[i + 2]]
    };
    // Columns of the picture with the highest and the lowest row of the cloud.
    let column = |x: u32| {
        let mut rows = (0..SIZE[1]).filter(|y| at(x, *y) != sky);
        let top = rows.next()?;
        Some([x, top, rows.next_back().unwrap_or(top)])
    };
    let columns: Vec<[u32; 3]> = (0..SIZE[0]).filter_map(column).collect();
    // Its middle, without the thin ends.
    let middle = &columns[columns.len() / 5..columns.len() * 4 / 5];
    let tall = middle
        .iter()
        .map(|column| column[2] - column[1])
        .max()
        .unwrap();
    assert!(
        columns.len() as u32 > tall * 2,
        "{} wide, {tall} tall",
        columns.len()
    );
    // Light from above: the belly is darker than the heads, and no line is drawn.
    let brightness = |part: u32| {
        let tones = middle
            .iter()
            .map(|[x, top, base]| u32::from(at(*x, top + (base - top) * part / 5)[0]));
        tones.sum::<u32>() as f32 / middle.len() as f32
    };
    let (heads, belly) = (brightness(1), brightness(4));
    println!("heads {heads}, belly {belly}");
    assert!(heads > belly + 20.0, "heads {heads}, belly {belly}");
    let darkest = frame.rgba.chunks(4).map(|p| p[0]).min().unwrap();
    assert!(darkest >= sky[0], "no line: {darkest}");
}

/// A painting: two colours mixed by hills of paint, drawn out into strokes from left to right.
fn painting(size: [u32; 2], [low, high]: [[f32; 3]; 2]) -> Picture {
    let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x as f32, y as f32]));
    let rgba = places.flat_map(|[x, y]| {
        let share = npr_core::grain::paper_height([0.3 * x, y], 0.12);
        let [r, g, b] = [0, 1, 2].map(|i| (low[i] + share * (high[i] - low[i])) as u8);
        [r, g, b, 255]
    });
    Picture {
        size,
        rgba: rgba.collect(),
    }
}

/// Brightness of a pixel, 0 to 255.
fn brightness(frame: &Frame, at: usize) -> f32 {
    let [r, g, b] = [0, 1, 2].map(|i| f32::from(frame.rgba[4 * at + i]));
    0.3 * r + 0.59 * g + 0.11 * b
}

/// Share of neighbours within smoke that are of one colour.
fn flatness(frame: &Frame, alone: &Frame) -> f32 {
    let is_smoke = |at: usize| alone.rgba[4 * at + 3] == 255;
    let color = |at: usize| &frame.rgba[4 * at..4 * at + 3];
    let pixels = (0..alone.rgba.len() / 4 - 1).filter(|at| is_smoke(*at) && is_smoke(at + 1));
    let within: Vec<usize> = pixels.collect();
    let flat = within.iter().filter(|at| color(**at) == color(**at + 1));
    flat.count() as f32 / within.len() as f32
}

/// Least difference of brightness that is a clear step: an eighth of all.
const CLEAR_STEP: f32 = 32.0;

/// Share of the edge of smoke at which the picture has a clear step within four pixels.
fn readable_edge(frame: &Frame, alone: &Frame) -> f32 {
    let [width, height] = frame.size.map(|side| side as i32);
    let alpha = |x: i32, y: i32| alone.rgba[4 * (y * width + x) as usize + 3];
    let inner = (4..height - 4).flat_map(|y| (4..width - 4).map(move |x| (x, y)));
    let is_edge = |(x, y): &(i32, i32)| {
        let around = [(1, 0), (-1, 0), (0, 1), (0, -1)];
        alpha(*x, *y) > 0 && around.iter().any(|(dx, dy)| alpha(x + dx, y + dy) == 0)
    };
    let is_clear = |(x, y): &&(i32, i32)| {
        let around = (-4..=4).flat_map(|dy| (-4..=4).map(move |dx| (x + dx, y + dy)));
        let [least, most] = around.fold([255.0_f32, 0.0], |[least, most], (x, y)| {
            let own = brightness(frame, (y * width + x) as usize);
            [least.min(own), most.max(own)]
        });
        most - least >= CLEAR_STEP
    };
    let edge: Vec<(i32, i32)> = inner.filter(is_edge).collect();
    edge.iter().filter(is_clear).count() as f32 / edge.len() as f32
}

/// Smoke is calmer than the painting that it stands before, stays the same before each, and its edge can be read even
/// where both are as bright: the line does that.
#[test]
fn smoke_sits_before_paintings() {
    let film = SmokeFilm::new(Source::Plume, PAPER, 40);
    let size = [640, 480];
    let model = Model::new(&Scene::default()).unwrap();
    let paintings = [
        ("snow", [[212.0, 216.0, 228.0], [255.0; 3]]),
        ("night", [[16.0, 20.0, 34.0], [62.0, 70.0, 96.0]]),
        ("dusk", [[150.0, 84.0, 92.0], [250.0, 186.0, 120.0]]),
    ];
    for preset in ["smoke-cel-2", "smoke-cel-3"] {
        let drawn = |settings: &[&str], picture: Option<Picture>| {
            let mut style = Style::preset(preset).unwrap();
            let behind = match picture {
                Some(_) => "background=painting.png",
                None => "background=transparent",
            };
            for setting in [behind].iter().chain(settings) {
                style.set(setting).unwrap();
            }
            let options = RendererOptions {
                smoke: Some(film.last(&style)),
                background_image: picture,
                ..RendererOptions::new(size)
            };
            let mut renderer = Renderer::new(&Processor, &model, &style, &options).unwrap();
            renderer.draw(&orbit_camera(0.0)).unwrap()
        };
        let alone = drawn(&[], None);
        for (name, colors) in paintings {
            // Compare it with the painting, and with itself before nothing.
            let picture = painting(size, colors);
            let behind = Frame {
                rgba: picture.rgba.clone(),
                ..alone.clone()
            };
            let before = drawn(&[], Some(picture.clone()));
            keep(&format!("{preset}-before-{name}"), &before);
            let [own, painted] = [&before, &behind].map(|frame| flatness(frame, &alone));
            assert!(
                own > 0.75 && painted < 0.5,
                "{preset}, {name}: {own} beside {painted}"
            );
            for (own, alone) in before.rgba.chunks_exact(4).zip(alone.rgba.chunks_exact(4)) {
                let is_as_alone = own.iter().zip(alone).all(|(a, b)| a.abs_diff(*b) <= 1);
                assert!(
                    alone[3] < 255 || is_as_alone,
                    "{preset}, {name}: {own:?} for {alone:?}"
                );
            }

            // Read its edge.
            let readable = readable_edge(&before, &alone);
            assert!(readable > 0.98, "{preset}, {name}: {readable}");
            if name == "snow" {
                let bare = drawn(&["smoke.line.width=0"], Some(picture));
                let readable = readable_edge(&bare, &alone);
                assert!(readable < 0.9, "{preset}: without a line {readable}");
            }
        }
    }
}
