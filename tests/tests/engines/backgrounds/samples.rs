//! The published method at one and at four samples a pixel.

use super::fixture::{HEIGHT, around, draw, engines, picture, pixel, places, styled};
use npr_core::math;
use npr_mesh::testing::{icosphere, mapped, plane, torus};
use npr_scene::Scene;
use npr_style::backdrop::published;
use npr_stylesheet::{Background, Style};
use npr_tests::{Object, lines, placed, scene_of};

const SIZE: [u32; 2] = [120, 90];

/// Half a side of the square, in world units, and the angle by which it is turned.
const HALF: f32 = 0.9;
const TURN: f32 = 0.35;

/// A flat square, turned in the plane of the picture.
fn square() -> Scene {
    let (sin, cos) = (math::sin(TURN), math::cos(TURN));
    let turned = mapped(&plane(1, 1), |[x, y, _]| {
        let [x, y] = [x, y].map(|v| (2.0 * v - 1.0) * HALF);
        [x * cos - y * sin, x * sin + y * cos, 0.0]
    });
    scene_of(&[Object::new("Square", turned)])
}

/// How many of a pixel's samples show the square; none where one of them lies too near its edge to tell.
fn covered(x: u32, y: u32, across: u32) -> Option<u32> {
    let px_per_unit = SIZE[1] as f32 / HEIGHT;
    let mut count = 0;
    for i in 0..across * across {
        let at = |pixel: u32, step: u32| pixel as f32 + (step as f32 + 0.5) / across as f32;
        let [px, py] = [at(x, i % across), at(y, i / across)];
        let [u, v] =
            [px - 0.5 * SIZE[0] as f32, 0.5 * SIZE[1] as f32 - py].map(|v| v / px_per_unit);
        let (sin, cos) = (math::sin(TURN), math::cos(TURN));
        let inside = HALF - (u * cos + v * sin).abs().max((v * cos - u * sin).abs());
        if inside.abs() < 1e-4 {
            return None;
        }
        count += u32::from(inside > 0.0);
    }
    Some(count)
}

fn style(method: &str, samples: &str, paper: &str, background: &str) -> Style {
    let set = [
        format!("antialias.samples={samples}"),
        format!("shade.paper={paper}"),
        format!("background={background}"),
        "line.background.method=published".to_owned(),
        "line.background.intensity=2".to_owned(),
        "highlight.edge=none".to_owned(),
    ];
    styled(lines(method), &set.each_ref().map(String::as_str), "")
}

/// The oracle knows where the square ends, and that blends of square and background are neither.
#[test]
fn the_outline_of_a_turned_square_is_what_its_geometry_says() {
    // Paper, background, and the line between them: by 60 of 255 they are alike, by 110 they are not.
    let cases = [
        ("#3c3c3c", "#000000", 120),
        ("#6e6e6e", "#000000", 0),
        ("#c8c8c8", "#ffffff", 100),
        ("#919191", "#ffffff", 0),
    ];
    let scene = square();
    for (name, engine) in engines() {
        for (samples, across) in [("1", 1), ("4", 2)] {
            for (paper, background, line) in cases {
                let style = style("rim", samples, paper, background);
                let frame = draw(engine, &scene, &style, SIZE, None);
                let mut count = 0;
                for (x, y) in places(SIZE) {
                    let near: Option<Vec<u32>> = around(SIZE, x, y)
                        .map(|(x, y)| covered(x, y, across))
                        .collect();
                    let (Some(near), Some(here)) = (near, covered(x, y, across)) else {
                        continue;
                    };
                    let whole = across * across;
                    let is_outline = here < whole && near.contains(&whole);
                    let [got, ..] = pixel(&frame, x, y);
                    let what = format!(
                        "{name}, {samples} samples, {paper} on {background}: {got} at {x}, {y}"
                    );
                    if is_outline {
                        count += 1;
                        assert_eq!(got, line, "{what}");
                    } else if here == 0 || here == whole {
                        let byte = |text: &str| u8::from_str_radix(&text[1..3], 16).unwrap();
                        assert_eq!(
                            got,
                            byte(if here == 0 { background } else { paper }),
                            "{what}"
                        );
                    }
                }
                assert!(count > 190, "{count} pixels of outline");
            }
        }
    }
}

/// Blends of square and background are alike the square, the background is not: no line of any method may change.
#[test]
fn no_line_changes_where_the_background_is_unlike() {
    let ball = scene_of(&[Object::new("Ball", icosphere(4))]);
    for (name, engine) in engines() {
        for method in [
            "shape", "okuya", "filter", "edges", "hull", "angle", "rim", "strokes",
        ] {
            let published = style(method, "4", "#6e6e6e", "#000000");
            let off = styled(published.clone(), &["line.background.method=off"], "");
            let [on, off] = [published, off].map(|style| draw(engine, &ball, &style, SIZE, None));
            let changed = on.rgba.iter().zip(&off.rgba).filter(|(a, b)| a != b);
            assert_eq!(changed.count(), 0, "{method} on the {name}");
        }
    }
}

/// At one sample a pixel a frame is what the publication makes of two pictures: the figure alone, and what lies
/// behind.
#[test]
fn a_frame_is_what_the_publication_makes_of_two_pictures() {
    let scene = scene_of(&[
        Object::new("Ring", torus(48, 24, 0.8, 0.3)).colored([0.1, 0.02, 0.05]),
        Object::new("Ball", placed(&icosphere(4), [0.3; 3], [0.1, 0.1, 0.0]))
            .colored([0.5, 0.4, 0.1]),
    ]);
    let behind = picture(SIZE, |x, y| match (x < 60, y % 16 < 8) {
        (true, _) => [30, 10, 20],
        (_, true) => [90, 60, 60],
        (_, false) => [200, 190, 90],
    });
    let settings = [
        "antialias.samples=1",
        "line.method=rim",
        "line.color=black",
        "line.background.method=published",
        "line.background.likeness.rgb=0.3",
        "light.direction=[0.5,0.4,0.7]",
        "background=behind.png",
    ];
    let lined = styled(Style::preset("toon").unwrap(), &settings, "");
    let mut alone = lined.without_lines();
    alone.background = Background::Transparent;
    for (name, engine) in engines() {
        let figure = draw(engine, &scene, &alone, SIZE, None);
        let colors = |rgba: &[u8]| -> Vec<[f32; 4]> {
            let pixels = rgba.chunks_exact(4);
            pixels
                .map(|pixel| std::array::from_fn(|i| f32::from(pixel[i]) / 255.0))
                .collect()
        };
        let rule = lined.line.background.rule();
        let black = [0.0, 0.0, 0.0, 1.0];
        let (want, count) = published::draw(
            SIZE,
            &colors(&figure.rgba),
            &colors(&behind.rgba),
            black,
            &rule,
        )
        .unwrap();
        let got = draw(engine, &scene, &lined, SIZE, Some(&behind));
        let changed = want
            .iter()
            .zip(colors(&behind.rgba))
            .filter(|(a, b)| **a != *b);
        assert!(
            count > 300 && changed.count() > count,
            "{count} pixels of outline"
        );
        for (i, (got, want)) in colors(&got.rgba).iter().zip(&want).enumerate() {
            let apart = (0..4).map(|k| (got[k] - want[k]).abs()).fold(0.0, f32::max);
            assert!(
                apart < 2.5 / 255.0,
                "{name}: {got:?}, not {want:?}, at {}, {}",
                i % 120,
                i / 120
            );
        }
    }
}
