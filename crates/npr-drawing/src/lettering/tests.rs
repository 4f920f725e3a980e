use super::testing::{CAP_HEIGHT, KERN, SIDE, block_font};
use super::*;
use crate::artwork::{ArtworkOptions, Paths};
use crate::drawing::{paint_over, rasterise};
use crate::svg::write_svg;
use kurbo::{ParamCurve, PathSeg, Rect, Shape, Vec2};
use npr_vector::stroke::Drawing;
use proptest::prelude::*;

fn font() -> Font {
    Font::new(block_font()).expect("a sound font")
}

fn set(text: &str, setting: Setting) -> BezPath {
    set_words(&font(), text, &setting)
        .expect("sound words")
        .outline
}

/// Font units in cap heights.
fn caps(units: i16) -> f64 {
    f64::from(units) / f64::from(CAP_HEIGHT)
}

fn is_about(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6
}

fn near(a: Rect, b: Rect) -> bool {
    let sides = |r: Rect| [r.x0, r.y0, r.x1, r.y1];
    sides(a).iter().zip(sides(b)).all(|(a, b)| is_about(*a, b))
}

#[test]
fn a_letter_by_hand() {
    let bar = set("I", Setting::default()).bounding_box();
    assert!(
        near(bar, Rect::new(-caps(100), -0.5, caps(100), 0.5)),
        "{bar:?}"
    );
}

#[test]
fn kerning_and_spacing_move_letters() {
    let width = |text: &str, spacing| {
        let setting = Setting {
            spacing,
            ..Setting::default()
        };
        set(text, setting).bounding_box().width()
    };
    assert!(is_about(width("VO", 0.0), caps(2 * 600 + 2 * SIDE - KERN)));
    assert!(is_about(width("OV", 0.0), caps(2 * 600 + 2 * SIDE)));
    assert!(is_about(width("OVO", 0.5) - width("OVO", 0.0), 1.0));
}

#[test]
fn lines_are_centred_below_one_another() {
    let setting = Setting {
        line_step: 2.0,
        ..Setting::default()
    };
    let both = set("I\r\nOO", setting).bounding_box();
    assert!(
        near(both, Rect::new(-caps(650), -1.5, caps(650), 1.5)),
        "{both:?}"
    );
}

#[test]
fn missing_letters_are_told_once_and_leave_a_gap() {
    let words = set_words(&font(), "xIxžI\u{7}", &Setting::default()).expect("words");
    assert_eq!(words.missing, ['x', 'ž']);
    let bars = words
        .outline
        .elements()
        .iter()
        .filter(|e| matches!(e, PathEl::MoveTo(_)));
    assert_eq!(bars.count(), 2);
}

#[test]
fn blanks_and_nothing_have_no_outline() {
    for text in ["", " ", "\n\n", "\u{0}\t"] {
        let words = set_words(
            &font(),
            text,
            &Setting {
                bend: 1.0,
                ..Setting::default()
            },
        );
        assert_eq!(words, Ok(Words::default()), "{text:?}");
    }
}

#[test]
fn files_hold_words_in_a_layer_on_top() {
    let words = set_words(&font(), "HI", &Setting::default()).expect("words");
    let band = Band {
        color: [255, 0, 0, 255],
        width_px: 4.0,
    };
    let lettered = Lettered {
        text: "H<I>".into(),
        marks: words.marks([50.0, 40.0], 20.0, [0, 0, 255, 255], &[band]),
    };
    let drawing = Drawing {
        size: [100, 80],
        ..Drawing::default()
    };
    let options = |paths| ArtworkOptions {
        paths,
        lettering: vec![lettered.clone()],
        ..ArtworkOptions::default()
    };
    let svg = |paths| String::from_utf8(write_svg(&drawing, &options(paths))).expect("text");

    let text = svg(Paths::Outline);
    assert!(
        text.contains("inkscape:label=\"lettering\"")
            && text.contains("inkscape:label=\"H&lt;I&gt;\""),
        "{text}"
    );
    assert_eq!(text.matches("<path").count(), 2);
    assert!(
        text.contains("stroke=\"#ff0000\" stroke-width=\"8\"") && text.contains("fill=\"#0000ff\""),
        "{text}"
    );
    let pen = svg(Paths::Centreline);
    assert!(
        pen.contains("stroke-width=\"1\"") && !pen.contains("#0000ff"),
        "{pen}"
    );

    // A picture of the drawing is what painting over an empty one gives.
    let mut over = vec![0; 100 * 80 * 4];
    paint_over(&lettered.marks, &mut over, drawing.size);
    let drawn = rasterise(&drawing, &options(Paths::Outline));
    assert!(over.iter().zip(&drawn).all(|(a, b)| a.abs_diff(*b) <= 1));
    assert!(over.iter().any(|byte| *byte > 0));
}

#[test]
fn long_texts_are_refused() {
    let text = "I".repeat(TEXT_MAX + 1);
    let count = TEXT_MAX + 1;
    assert_eq!(
        set_words(&font(), &text, &Setting::default()),
        Err(LetteringError::TooLong { count })
    );
}

#[test]
fn absurd_grids_are_refused() {
    let mut bytes = block_font();
    let head = bytes
        .windows(4)
        .position(|w| w == [0x5f, 0x0f, 0x3c, 0xf5])
        .expect("head");
    for units in [0_u16, 1, 15, 16385, u16::MAX] {
        bytes[head + 6..head + 8].copy_from_slice(&units.to_be_bytes());
        assert_eq!(
            Font::new(bytes.clone()),
            Err(LetteringError::Units { units })
        );
    }
}

#[test]
fn a_turn_is_counter_clockwise() {
    let quarter = Setting {
        turn: 0.5 * std::f64::consts::PI,
        ..Setting::default()
    };
    let upright = set("OI", Setting::default());
    let expected = upright.elements()[0].end_point().expect("a place");
    let turned = set("OI", quarter).elements()[0]
        .end_point()
        .expect("a place");
    // What was left is below: y runs down.
    assert!((turned - kurbo::Point::new(expected.y, -expected.x)).hypot() < 1e-9);
}

#[test]
fn bands_lie_outermost_first_under_the_letters() {
    let words = set_words(&font(), "I", &Setting::default()).expect("words");
    let band = |width_px, red| Band {
        color: [red, 0, 0, 255],
        width_px,
    };
    let bands = [band(3.0, 1), band(0.0, 2), band(2.0, 3)];
    let found = words.marks([20.0, 30.0], 14.0, [9; 4], &bands);
    let paints: Vec<_> = found
        .iter()
        .map(|mark| (mark.paint, mark.color[0]))
        .collect();
    assert_eq!(
        paints,
        [
            (Paint::Line(10.0), 3),
            (Paint::Line(6.0), 1),
            (Paint::Ink, 9)
        ]
    );
    assert!(near(
        found[2].path.bounding_box(),
        Rect::new(18.0, 23.0, 22.0, 37.0)
    ));
    for (middle, height) in [
        ([f64::NAN, 0.0], 1.0),
        ([0.0; 2], f64::INFINITY),
        ([0.0; 2], 0.0),
    ] {
        assert!(words.marks(middle, height, [9; 4], &[]).is_empty());
    }
}

/// Setting, as wild as a caller may have it.
fn settings() -> impl Strategy<Value = Setting> {
    let value = || prop_oneof![8 => -1.0..1.0_f64, 1 => Just(f64::NAN), 1 => Just(-1e300), 1 => Just(f64::INFINITY)];
    [value(), value(), value(), value(), value(), value()].prop_map(
        |[bend, slant, spread, spacing, line_step, turn]| Setting {
            bend,
            slant,
            spread,
            spacing,
            line_step,
            turn,
        },
    )
}

/// The feet of a row of bars, each side of which was cut into pieces of a quarter: 17 points a piece.
fn feet(bars: usize, path: &BezPath) -> Vec<Vec<kurbo::Point>> {
    // The font draws a bar from its lower left corner: up, across, down, and back along the foot; the sides are 1 and
    // 2 / 7 long.
    let pieces: Vec<PathSeg> = path.segments().collect();
    let [per_bar, per_foot] = [12, 2];
    assert_eq!(pieces.len(), per_bar * bars);
    let foot = |bar: &[PathSeg]| bar[per_bar - per_foot..].to_vec();
    let points = |piece: PathSeg| (0..=16).map(|i| piece.eval(f64::from(i) / 16.0)).collect();
    pieces.chunks(per_bar).flat_map(foot).map(points).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn lines_keep_clear_unless_they_are_to_overlap(
        reaches in prop::collection::vec([0.0..1.5_f64, 0.0..1.0_f64], 1..6), line_step in 0.5..3.0_f64,
    ) {
        let line = |[rise, hang]: &[f64; 2]| Line {
            outline: Rect::new(0.0, -rise, 1.0, *hang).to_path(1e-3),
            width: 1.0,
        };
        let lines: Vec<Line> = reaches.iter().map(line).collect();
        let baselines = baselines_of(&lines, line_step);
        prop_assert!(is_about(baselines[0] + baselines[lines.len() - 1], 1.0));
        for (pair, reach) in baselines.windows(2).zip(reaches.windows(2)) {
            let step = pair[1] - pair[0];
            let met = reach[0][1] + reach[1][0];
            let wanted = if line_step < 1.0 { line_step } else { line_step.max(met + CLEAR) };
            prop_assert!(is_about(step, wanted));
        }
    }

    #[test]
    fn outlines_are_finite_and_closed(text in "[HIOQV x\u{301}\nא\u{627}]{0,12}", setting in settings()) {
        let words = set_words(&font(), &text, &setting).expect("sound words");
        let mut open = false;
        for element in words.outline.elements() {
            match element {
                PathEl::MoveTo(_) => {
                    prop_assert!(!open, "a subpath is not closed");
                    open = true;
                }
                PathEl::ClosePath => open = false,
                _ => prop_assert!(open, "a curve without a start"),
            }
        }
        prop_assert!(!open);
        let bounds = words.outline.bounding_box();
        prop_assert!(bounds.is_finite() && bounds.width() < 1e3 && bounds.height() < 1e3, "{bounds:?}");
    }

    #[test]
    fn without_bend_and_spread_letters_only_lean(text in "[HIOQV]{1,8}", slant in -1.0..1.0_f64) {
        let upright = set(&text, Setting::default());
        let leaning = set(&text, Setting { slant, ..Setting::default() });
        prop_assert_eq!(upright.elements().len(), leaning.elements().len());
        for (a, b) in upright.segments().zip(leaning.segments()) {
            for t in [0.0, 0.3, 1.0] {
                let (a, b) = (a.eval(t), b.eval(t));
                prop_assert!((b - (a - Vec2::new(slant * a.y, 0.0))).hypot() < 1e-9);
            }
        }
    }

    #[test]
    fn an_arc_keeps_lengths_along_the_baseline(count in 1_usize..12, bend in -1.0..1.0_f64) {
        prop_assume!(bend.abs() > 0.01);
        let bars = set(&"I".repeat(count), Setting { bend, ..Setting::default() });
        let feet = feet(count, &bars);
        let step = |pair: &[kurbo::Point]| pair[0].distance(pair[1]);
        let length: f64 = feet.iter().flat_map(|foot| foot.windows(2).map(step)).sum();
        let expected = count as f64 * caps(200);
        prop_assert!((length - expected).abs() < 1e-3 * expected, "{length} {expected}");

        // The circle through the baseline's middle that is symmetric: its centre is as far from every foot.
        let points: Vec<_> = feet.concat();
        let [outer, inner] = [f64::max as fn(f64, f64) -> f64, f64::min].map(|pick| {
            points.iter().map(|p| p.x.abs()).reduce(pick).expect("points")
        });
        let at = |x: f64| points.iter().find(|p| p.x.abs() == x).expect("a point");
        let (far, near) = (at(outer), at(inner));
        let rise = far.y - near.y;
        let centre = (far.to_vec2().hypot2() - near.to_vec2().hypot2()) / (2.0 * rise);
        let radius = |p: &kurbo::Point| p.x.hypot(p.y - centre);
        prop_assert!(rise * bend > 0.0, "bends the wrong way");
        prop_assert!(points.iter().all(|p| (radius(p) - radius(far)).abs() < 1e-3 * radius(far)));
    }

    #[test]
    fn bending_by_almost_nothing_moves_almost_nothing(text in "[HIOQV]{1,8}", bend in -1e-4..1e-4_f64) {
        let straight = set(&text, Setting::default()).bounding_box();
        let bent = set(&text, Setting { bend, ..Setting::default() }).bounding_box();
        let apart = [straight.x0 - bent.x0, straight.y0 - bent.y0, straight.x1 - bent.x1, straight.y1 - bent.y1];
        prop_assert!(apart.iter().all(|d| d.abs() < 5e-3), "{apart:?}");
    }

    #[test]
    fn letters_grow_as_asked(count in 2_usize..10, spread in -0.8..0.8_f64) {
        let path = set(&"I".repeat(count), Setting { spread, ..Setting::default() });
        let pieces: Vec<_> = path.segments().collect();
        let heights: Vec<f64> = pieces.chunks(pieces.len() / count).map(|bar| {
            bar.iter().map(|s| s.bounding_box()).reduce(|a, b| a.union(b)).expect("a bar").height()
        }).collect();
        prop_assert!(heights.windows(2).all(|pair| (pair[1] - pair[0]) * spread >= -1e-9), "{heights:?}");
        let last = if spread > 0.0 { heights[count - 1] } else { heights[0] };
        prop_assert!(is_about(last, 1.0 + spread.abs()), "{last}");
    }

    #[test]
    fn broken_fonts_never_panic(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..24),
        length in any::<prop::sample::Index>(), truncated in prop::bool::weighted(0.2),
    ) {
        let mut bytes = block_font();
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if truncated {
            let length = length.index(bytes.len());
            bytes.truncate(length);
        }
        if let Ok(font) = Font::new(bytes) {
            let words = set_words(&font, "HIO QV\nxV", &Setting { bend: 0.4, spread: 0.3, ..Setting::default() });
            if let Ok(words) = words {
                prop_assert!(words.outline.is_finite());
            }
        }
    }
}
