//! What a reader sees: whether outlines differ from what lies behind them, and how far they are from the figure's own
//! colours.
//!
//! The outline of method `rim` is every pixel beside the figure, so its colours are read from the picture as they are.

use super::fixture::{around, draw, engines, picture, pixel, places, styled};
use npr_core::color::linear_from_byte;
use npr_gpu::engine::Engine;
use npr_mesh::testing::{cube, icosphere, torus};
use npr_render::{Frame, Picture};
use npr_scene::Scene;
use npr_style::backdrop::oklab_of_light;
use npr_stylesheet::{Background, Style};
use npr_tests::{Object, placed, scene_of};

const SIZE: [u32; 2] = [200, 150];

/// Difference of lightness that every line is to have.
const GOAL: f32 = 0.3;

/// A dark figure of several colours.
fn figure() -> Scene {
    scene_of(&[
        Object::new("Head", placed(&icosphere(4), [0.45; 3], [0.0, 0.8, 0.0]))
            .colored([0.5, 0.25, 0.15]),
        Object::new("Body", placed(&cube(), [0.4, 0.5, 0.4], [0.0, -0.1, 0.0]))
            .colored([0.01, 0.012, 0.05]),
        Object::new(
            "Ring",
            placed(&torus(48, 20, 0.9, 0.2), [1.0; 3], [0.0, -0.5, 0.1]),
        )
        .colored([0.08, 0.01, 0.01]),
    ])
}

fn backgrounds() -> [(&'static str, Picture); 4] {
    [
        ("black", picture(SIZE, |_, _| [0; 3])),
        ("night", picture(SIZE, |_, _| [24, 28, 56])),
        ("white", picture(SIZE, |_, _| [255; 3])),
        (
            "two colours",
            picture(
                SIZE,
                |x, _| if x < 100 { [8, 8, 12] } else { [230, 225, 210] },
            ),
        ),
    ]
}

fn lab([r, g, b, _]: [u8; 4]) -> [f32; 3] {
    oklab_of_light([r, g, b].map(linear_from_byte))
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3)
        .map(|i| (a[i] - b[i]) * (a[i] - b[i]))
        .sum::<f32>()
        .sqrt()
}

/// What a line is at a place of the outline.
struct Seen {
    /// How far its lightness is from that behind it.
    contrast: f32,
    /// How far its colour is from the figure's beside it.
    distance: f32,
}

/// Every place of the outline, as a method draws it.
fn seen(engine: &dyn Engine, settings: &[&str], behind: &Picture) -> Vec<Seen> {
    let base = [
        "antialias.samples=1",
        "line.method=rim",
        "background=behind.png",
    ];
    let all = [&base[..], settings].concat();
    let lined = styled(Style::preset("toon").unwrap(), &all, "");
    let mut alone = lined.without_lines();
    alone.background = Background::Transparent;
    let scene = figure();
    let drawn = draw(engine, &scene, &lined, SIZE, Some(behind));
    let alone = draw(engine, &scene, &alone, SIZE, None);
    let outline = places(SIZE).filter(|(x, y)| pixel(&alone, *x, *y)[3] == 0);
    outline
        .filter_map(|(x, y)| seen_at(&drawn, &alone, behind, [x, y]))
        .collect()
}

fn seen_at(drawn: &Frame, alone: &Frame, behind: &Picture, [x, y]: [u32; 2]) -> Option<Seen> {
    let near = around(SIZE, x, y).map(|(x, y)| pixel(alone, x, y));
    let rims: Vec<[f32; 3]> = near.filter(|own| own[3] == 255).map(lab).collect();
    if rims.is_empty() {
        return None;
    }
    let at = 4 * (y * SIZE[0] + x) as usize;
    let ground = lab(std::array::from_fn(|i| behind.rgba[at + i]));
    let line = lab(pixel(drawn, x, y));
    let nearest = rims
        .iter()
        .map(|rim| distance(line, *rim))
        .fold(9.0, f32::min);
    Some(Seen {
        contrast: (line[0] - ground[0]).abs(),
        distance: nearest,
    })
}

fn mean(values: impl Iterator<Item = f32>) -> f32 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / f32::max(count, 1.0)
}

const BLACK: &[&str] = &["line.color=black"];
const RED: &[&str] = &["line.color=red"];
const PUBLISHED: &[&str] = &[
    "line.color=black",
    "line.background.method=published",
    "line.background.intensity=4",
    "line.background.direction=brighter",
];
const OURS: &[&str] = &[
    "line.color=black",
    "line.background.method=contrast",
    "line.background.start=rim",
];

#[test]
fn contrast_rises_over_its_level_and_colors_stay_nearer_than_red() {
    for (name, engine) in engines() {
        let mut risen = 0;
        for (wall, behind) in backgrounds() {
            let [black, red, ours] =
                [BLACK, RED, OURS].map(|settings| seen(engine, settings, &behind));
            assert!(black.len() > 300 && red.len() == black.len() && ours.len() == black.len());
            let below = |seen: &Seen| seen.contrast < GOAL - 0.01;
            let was_below = black.iter().zip(&ours).filter(|(black, _)| below(black));
            let still = was_below.clone().filter(|(_, ours)| below(ours)).count();
            risen += was_below.clone().count() - still;
            // Where two walls meet, a line turns over a few pixels.
            assert!(
                still * 50 <= ours.len(),
                "{wall} on the {name}: {still} of {} stay below",
                was_below.count()
            );
            let [of_red, of_ours] = [&red, &ours].map(|seen| mean(seen.iter().map(|s| s.distance)));
            assert!(
                of_ours < of_red,
                "{wall} on the {name}: {of_ours}, red {of_red}"
            );
        }
        assert!(risen > 700, "{risen} places rose on the {name}");
    }
}

/// What the publication claims of its own method before one colour and two, where it changes a line: seen better than
/// black, less odd than red.
#[test]
fn the_published_method_raises_contrast_where_it_acts() {
    for (name, engine) in engines() {
        for (wall, behind) in backgrounds()
            .into_iter()
            .filter(|(wall, _)| *wall != "white")
        {
            let [black, red, published] =
                [BLACK, RED, PUBLISHED].map(|settings| seen(engine, settings, &behind));
            let changed = |i: &usize| (black[*i].distance - published[*i].distance).abs() > 1e-3;
            let places: Vec<usize> = (0..black.len()).filter(changed).collect();
            assert!(
                places.len() > 100,
                "{wall} on the {name}: {} places",
                places.len()
            );
            let of = |seen: &[Seen], what: fn(&Seen) -> f32| {
                mean(places.iter().map(|i| what(&seen[*i])))
            };
            let contrast = |seen: &Seen| seen.contrast;
            let distance = |seen: &Seen| seen.distance;
            let rise = of(&published, contrast) / of(&black, contrast).max(1e-3);
            assert!(rise > 1.2, "{wall} on the {name}: contrast times {rise}");
            let [of_red, own] = [of(&red, distance), of(&published, distance)];
            assert!(own < of_red, "{wall} on the {name}: {own}, red {of_red}");
        }
    }
}
