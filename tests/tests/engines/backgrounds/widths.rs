//! Widths that swell and colours that mind the background, together: neither changes the other.

use super::fixture::{draw, engines, picture, pixel, styled};
use npr_gpu::engine::Engine;
use npr_mesh::testing::icosphere;
use npr_render::{Frame, Picture};
use npr_tests::{Object, lines, placed, scene_of};

const SIZE: [u32; 2] = [240, 160];

/// A wall on which a black line can be told from a lighter one, dark on the left and bright on the right.
fn wall() -> Picture {
    picture(SIZE, |x, _| if x < 120 { [48; 3] } else { [225; 3] })
}

/// Swelling lines of some pixels around a long ball: tight bends at its ends, long runs above and below.
fn drawn(engine: &dyn Engine, source: &str, method: &str) -> Frame {
    let ball = placed(&icosphere(5), [1.7, 0.7, 0.7], [0.0; 3]);
    let scene = scene_of(&[Object::new("Ball", ball)]);
    let (source, method) = (
        format!("line.width.source={source}"),
        format!("line.background.method={method}"),
    );
    let settings = [
        "background=wall.png",
        "shade.paper=#808080",
        "line.width.base=24px",
        "line.width.min=0",
        "line.width.max=1",
        "line.width.gain=0.1",
        "line.background.lightness=0.4",
        source.as_str(),
        method.as_str(),
    ];
    let style = styled(lines("shape"), &settings, "");
    draw(engine, &scene, &style, SIZE, Some(&wall()))
}

/// Pixels along a row or column that show neither the ball nor the wall, in a row with the most of them.
fn run(frame: &Frame, places: impl Iterator<Item = [u32; 2]>) -> Vec<[u8; 4]> {
    let plain: [[u8; 3]; 3] = [[128; 3], [48; 3], [225; 3]];
    let is_line = |[r, g, b, _]: &[u8; 4]| {
        let own = [*r, *g, *b];
        !plain
            .iter()
            .any(|plain| (0..3).all(|i| plain[i].abs_diff(own[i]) < 3))
    };
    places
        .map(|[x, y]| pixel(frame, x, y))
        .filter(is_line)
        .collect()
}

/// The line at the left tip, at the right one, and above and below the middle of either half.
fn lines_at(frame: &Frame) -> [Vec<[u8; 4]>; 4] {
    let row = |x: std::ops::Range<u32>| run(frame, x.map(|x| [x, 80]));
    let column = |x: u32| run(frame, (20..80).map(move |y| [x, y]));
    [row(10..60), row(180..230), column(90), column(150)]
}

/// The colour that most of a line's pixels have.
fn color(line: &[[u8; 4]]) -> [u8; 4] {
    let most = line
        .iter()
        .max_by_key(|own| line.iter().filter(|other| other == own).count());
    *most.expect("a line")
}

#[test]
fn widths_stay_where_colors_change_and_colors_where_widths_do() {
    for (name, engine) in engines() {
        let swelling = lines_at(&drawn(engine, "curvature", "contrast"));
        let plain = lines_at(&drawn(engine, "curvature", "off"));
        let even = lines_at(&drawn(engine, "constant", "contrast"));
        // Widths swell at the tips, some pixels wide, and are the same in either colour.
        for i in 0..4 {
            let [with, without] = [&swelling, &plain].map(|lines| lines[i].len());
            assert!(
                with.abs_diff(without) <= 1,
                "{name}, {i}: {with} px, {without} without the rule"
            );
        }
        let [left, right, top, other] = [0, 1, 2, 3].map(|i| swelling[i].len());
        assert!(
            left >= 6 && right >= 6 && top >= 3 && other >= 3,
            "{name}: {left} {right} {top} {other}"
        );
        assert!(
            5 * left >= 7 * top && 5 * right >= 7 * other,
            "{name}: {left} {right} {top} {other}"
        );
        assert!(
            even[2].len() >= 2 * top,
            "{name}: without swelling {} px",
            even[2].len()
        );
        // Colours lift before the dark half alone, and are the same in any width.
        for (i, is_dark) in [true, false, true, false].into_iter().enumerate() {
            let [with, without] = [&swelling, &even].map(|lines| color(&lines[i]));
            assert!(
                (0..3).all(|k| with[k].abs_diff(without[k]) <= 4),
                "{name}, {i}: {with:?}, {without:?}"
            );
            assert_eq!(with[0] > 100, is_dark, "{name}, {i}: {with:?}");
            assert_eq!(color(&plain[i])[0], 0, "{name}, {i}");
        }
    }
}
