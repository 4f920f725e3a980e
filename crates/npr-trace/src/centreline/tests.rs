mod crossings;
mod hostile;
mod skeleton;

use super::network::Network;
use super::*;
use glam::DVec2;
use proptest::prelude::*;

/// Any small bitmap: from nearly white to nearly black, single pixels or blocks of them.
fn bitmaps() -> impl Strategy<Value = Bitmap> {
    (1u32..90, 1u32..24, 0u8..=100, 1u32..5, any::<u32>()).prop_map(
        |(width, height, percent, block, seed)| {
            paint(width, height, |x, y| {
                let place = (x / block) << 16 | (y / block);
                let number = npr_core::math::mix_bits(place ^ npr_core::math::mix_bits(seed));
                number % 100 < u32::from(percent)
            })
        },
    )
}

fn paint(width: u32, height: u32, is_ink: impl Fn(u32, u32) -> bool) -> Bitmap {
    let mut bitmap = Bitmap::new(width, height).expect("small");
    for (x, y) in (0..width * height).map(|i| (i % width, i / width)) {
        bitmap.set(x, y, is_ink(x, y));
    }
    bitmap
}

/// Ink where a pixel's middle lies within half a width of one of the lines.
fn drawn(size: u32, lines: &[[DVec2; 2]], width: f64) -> Bitmap {
    paint(size, size, |x, y| {
        let p = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        lines.iter().any(|line| distance_to(p, line) <= 0.5 * width)
    })
}

fn distance_to(p: DVec2, [a, b]: &[DVec2; 2]) -> f64 {
    let along = *b - *a;
    let t = ((p - *a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    p.distance(*a + along * t)
}

fn pixels(bitmap: &Bitmap) -> impl Iterator<Item = (i64, i64)> {
    let [width, height] = [bitmap.width(), bitmap.height()].map(i64::from);
    (0..width * height).map(move |i| (i % width, i / width))
}

/// Pieces of one colour, by flooding: ink by sides and corners, white by sides, with the white outside the picture.
fn pieces(bitmap: &Bitmap, ink: bool) -> Vec<Vec<(i64, i64)>> {
    let [width, height] = [bitmap.width(), bitmap.height()].map(i64::from);
    let mut left: std::collections::BTreeSet<(i64, i64)> = (-1..=width)
        .flat_map(|x| (-1..=height).map(move |y| (x, y)))
        .filter(|(x, y)| bitmap.is_ink(*x, *y) == ink)
        .collect();
    let mut found = Vec::new();
    while let Some(seed) = left.pop_first() {
        let (mut piece, mut at) = (vec![seed], 0);
        while at < piece.len() {
            let (x, y) = piece[at];
            at += 1;
            for (dx, dy) in [
                (1, 0),
                (-1, 0),
                (0, 1),
                (0, -1),
                (1, 1),
                (1, -1),
                (-1, 1),
                (-1, -1),
            ] {
                if (ink || dx == 0 || dy == 0) && left.remove(&(x + dx, y + dy)) {
                    piece.push((x + dx, y + dy));
                }
            }
        }
        found.push(piece);
    }
    found
}

/// Whether the ink and the white of nine pixels stay as many pieces when the one in the middle turns white.
fn is_simple(bitmap: &Bitmap, (x, y): (i64, i64)) -> bool {
    let mut nine = paint(3, 3, |i, j| {
        bitmap.is_ink(x + i64::from(i) - 1, y + i64::from(j) - 1)
    });
    let count = |nine: &Bitmap| (pieces(nine, true).len(), pieces_inside(nine));
    let before = count(&nine);
    nine.set(1, 1, false);
    before == count(&nine)
}

/// Pieces of white of nine pixels, by sides, that reach a side of the middle.
fn pieces_inside(nine: &Bitmap) -> usize {
    let ring = [
        (1, 0),
        (2, 0),
        (2, 1),
        (2, 2),
        (1, 2),
        (0, 2),
        (0, 1),
        (0, 0),
    ];
    if nine.is_ink(1, 1) {
        // Runs of white around the middle that hold one of its sides.
        let white: Vec<bool> = ring.iter().map(|(x, y)| !nine.is_ink(*x, *y)).collect();
        let sides = [0, 2, 4, 6].into_iter().filter(|k| white[*k]);
        let joined = [0, 2, 4, 6]
            .into_iter()
            .filter(|k| white[*k] && white[*k + 1] && white[(*k + 2) % 8]);
        let (sides, joined) = (sides.count(), joined.count());
        return sides.saturating_sub(joined).max(usize::from(sides > 0));
    }
    1
}

fn neighbours(bitmap: &Bitmap, (x, y): (i64, i64)) -> usize {
    let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy)));
    around
        .filter(|(dx, dy)| (*dx, *dy) != (0, 0) && bitmap.is_ink(x + dx, y + dy))
        .count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn thinning_keeps_pieces_and_holes(bitmap in bitmaps()) {
        let thinned = thin(&bitmap);
        prop_assert!(pixels(&bitmap).all(|(x, y)| bitmap.is_ink(x, y) || !thinned.is_ink(x, y)));
        // Every piece of ink keeps one piece, and every hole grows to one hole.
        let (before, after) = (pieces(&bitmap, true), pieces(&thinned, true));
        prop_assert_eq!(before.len(), after.len());
        for piece in before {
            prop_assert!(piece.iter().any(|(x, y)| thinned.is_ink(*x, *y)));
        }
        let (before, after) = (pieces(&bitmap, false), pieces(&thinned, false));
        prop_assert_eq!(before.len(), after.len());
    }

    #[test]
    fn nothing_more_can_be_thinned(bitmap in bitmaps()) {
        let thinned = thin(&bitmap);
        for pixel in pixels(&thinned).filter(|(x, y)| thinned.is_ink(*x, *y)) {
            let is_end = neighbours(&thinned, pixel) < 2;
            prop_assert!(is_end || !is_simple(&thinned, pixel), "{:?}", pixel);
        }
        prop_assert_eq!(&thin(&thinned), &thinned);
    }

    #[test]
    fn distances_are_those_to_the_nearest_white(bitmap in bitmaps()) {
        let [width, height] = [bitmap.width(), bitmap.height()].map(i64::from);
        let white: Vec<(i64, i64)> = (-1..=width)
            .flat_map(|x| (-1..=height).map(move |y| (x, y)))
            .filter(|(x, y)| !bitmap.is_ink(*x, *y))
            .collect();
        for (x, y) in pixels(&bitmap) {
            let nearest = white.iter().map(|(i, j)| (x - i).pow(2) + (y - j).pow(2)).min();
            prop_assert_eq!(Some(distance2(&bitmap, x as u32, y as u32) as i64), nearest, "{} {}", x, y);
        }
    }

    #[test]
    fn any_bitmap_gives_sound_strokes(bitmap in bitmaps(), turd_size in 0u64..6, spur in 0.0..2.0f64) {
        let options = CentrelineOptions { turd_size, spur, ..CentrelineOptions::default() };
        let found = centrelines(&bitmap, &options);
        let [width, height] = [bitmap.width(), bitmap.height()].map(f64::from);
        for stroke in &found.strokes {
            prop_assert!(stroke.points.len() >= 2);
            for point in &stroke.points {
                let [x, y] = point.place;
                prop_assert!((-2.0..width + 2.0).contains(&x) && (-2.0..height + 2.0).contains(&y), "{:?}", point);
                prop_assert!((1.0..2.0 * (width + height)).contains(&point.width), "{:?}", point);
            }
        }
        // Every piece of ink that is no speck has a stroke on it or beside it.
        let ink = despeckle(&bitmap, turd_size);
        for piece in pieces(&ink, true) {
            let near = |p: &CentrePoint| piece.iter().any(|(x, y)| {
                DVec2::from(p.place).distance(DVec2::new(*x as f64 + 0.5, *y as f64 + 0.5)) < 2.5
            });
            prop_assert!(found.strokes.iter().any(|stroke| stroke.points.iter().any(near)));
        }
    }

    #[test]
    fn a_line_is_found_where_it_was_drawn(
        angle in 0.0..3.2f64, width in 1.5..9.0f64, dx in 0.0..1.0f64, dy in 0.0..1.0f64,
    ) {
        let middle = DVec2::new(60.0 + dx, 60.0 + dy);
        let reach = DVec2::from_angle(angle) * 45.0;
        let line = [middle - reach, middle + reach];
        let found = centrelines(&drawn(120, &[line], width), &CentrelineOptions::default());
        prop_assert_eq!(found.strokes.len(), 1);
        let stroke = &found.strokes[0];
        // Of the ink the end of a cap is known to a pixel, and so is the width that is taken off for it.
        let beyond = 1.3;
        let further = reach.normalize() * beyond;
        let lengthened = [line[0] - further, line[1] + further];
        for point in &stroke.points {
            // The middle of a column of pixels lies up to half a pixel aside. Where it steps to the next column once,
            // the parabola of least squares overshoots the step by 0.374 of it at its end, and its slope by 1.97 over
            // half its window of 64 places, on which the tip is led on by half a width.
            let place = DVec2::from(point.place);
            let is_tip = line.iter().any(|end| place.distance(*end) <= 0.5 * width + 1.0);
            let slope = 1.97 / 32.0 + 1.0 / 45.0;
            let aside = 0.5 + 0.375 + if is_tip { slope * 0.5 * width } else { 0.0 };
            prop_assert!(distance_to(place, &lengthened) < aside, "{:?}", point);
            // Rows and columns of pixels cut off up to half a pixel on either side.
            prop_assert!((point.width - width).abs() < 1.0, "{:?}", point);
        }
        // Ends reach as far as drawn, and no further.
        let ends = [&stroke.points[0], &stroke.points[stroke.points.len() - 1]];
        for end in line {
            let nearest = ends.iter().map(|p| DVec2::from(p.place).distance(end)).fold(f64::INFINITY, f64::min);
            prop_assert!(nearest < beyond, "{} from {:?}: {:?}", nearest, end, ends);
        }
    }
}

#[test]
fn specks_and_pinholes_go() {
    // A bar of ink with a hole of one pixel, and a speck beside it.
    let bitmap = paint(20, 9, |x, y| {
        let in_bar = (2..14).contains(&x) && (2..7).contains(&y);
        in_bar && (x, y) != (7, 4) || (x, y) == (17, 4)
    });
    let clean = despeckle(&bitmap, 1);
    assert!(clean.is_ink(7, 4) && !clean.is_ink(17, 4));
    assert_eq!(despeckle(&bitmap, 0), bitmap);
    let all = paint(20, 9, |_, _| true);
    assert_eq!(despeckle(&all, 180), paint(20, 9, |_, _| false));
}

#[test]
fn a_rectangle_keeps_its_corners() {
    for width in [1, 3, 4] {
        let frame = |v: u32, low: u32, high: u32| (low..high).contains(&v);
        let bitmap = paint(60, 60, |x, y| {
            let outer = frame(x, 10, 50) && frame(y, 10, 50);
            outer && !(frame(x, 10 + width, 50 - width) && frame(y, 10 + width, 50 - width))
        });
        let found = centrelines(&bitmap, &CentrelineOptions::default());
        assert_eq!(found.strokes.len(), 1);
        let stroke = &found.strokes[0];
        assert!(stroke.closed);
        let half = 0.5 * f64::from(width);
        let [low, high] = [10.0 + half, 50.0 - half];
        for corner in [[low, low], [low, high], [high, low], [high, high]] {
            let nearest = |p: &CentrePoint| DVec2::from(p.place).distance(corner.into());
            let nearest = stroke
                .points
                .iter()
                .map(nearest)
                .fold(f64::INFINITY, f64::min);
            assert!(nearest < 0.4, "{width}: {corner:?} is {nearest} away");
        }
        for point in &stroke.points {
            let [x, y] = point.place;
            let off = [x - low, x - high, y - low, y - high].map(f64::abs);
            assert!(
                off.into_iter().fold(f64::INFINITY, f64::min) < 0.4,
                "{width}: {point:?}"
            );
            assert!((point.width - f64::from(width)).abs() < 0.3, "{point:?}");
        }
    }
}

#[test]
fn a_stair_of_a_flat_line_becomes_straight() {
    let bitmap = paint(300, 30, |x, y| {
        (5..295).contains(&x) && y == 10 + (x + 15) / 40
    });
    let found = centrelines(&bitmap, &CentrelineOptions::default());
    assert_eq!(found.strokes.len(), 1);
    for point in &found.strokes[0].points {
        let [x, y] = point.place;
        assert!((y - (10.5 + (x - 4.5) / 40.0)).abs() < 0.45, "{point:?}");
    }
}

#[test]
fn dots_and_bad_sizes() {
    let options = CentrelineOptions {
        turd_size: 0,
        ..CentrelineOptions::default()
    };
    for (width, height) in [(0, 0), (0, 5), (1, 1), (64, 1), (1, 64), (65, 3)] {
        assert_eq!(
            centrelines(&paint(width, height, |_, _| false), &options).strokes,
            []
        );
    }
    let dot = centrelines(&paint(1, 1, |_, _| true), &options);
    assert_eq!((dot.strokes.len(), dot.end_count()), (1, 0));
    assert!((dot.strokes[0].points[0].width - 1.0).abs() < 1e-9);
    let disc = drawn(40, &[[DVec2::splat(20.0), DVec2::splat(20.1)]], 9.0);
    let disc = centrelines(&disc, &options);
    assert_eq!(disc.strokes.len(), 1);
    assert!(
        (disc.strokes[0].points[0].width - 9.0).abs() < 0.8,
        "{:?}",
        disc.strokes
    );
}

#[test]
fn links_turn_as_far_as_allowed() {
    // A fork: 60 degrees from one arm to either other.
    let middle = DVec2::splat(50.0);
    let arms = [0.0f64, 120.0, 240.0].map(|angle| {
        [
            middle,
            middle + DVec2::from_angle(angle.to_radians()) * 40.0,
        ]
    });
    let bitmap = drawn(100, &arms, 3.0);
    let count = |link_turn| {
        let options = CentrelineOptions {
            link_turn,
            ..CentrelineOptions::default()
        };
        centrelines(&bitmap, &options).strokes.len()
    };
    assert_eq!((count(0.8), count(1.3)), (3, 2));
}

#[test]
fn networks_are_linked_both_ways() {
    let lines = [
        [DVec2::new(5.0, 5.0), DVec2::new(60.0, 50.0)],
        [DVec2::new(5.0, 40.0), DVec2::new(60.0, 12.0)],
    ];
    let ink = drawn(64, &lines, 4.0);
    let network = Network::of(&thin(&ink), &ink);
    for (number, branch) in (0..).zip(&network.branches) {
        for node in branch.ends {
            assert!(network.nodes[node as usize].branches.contains(&number));
        }
        for pair in branch.pixels.windows(2) {
            assert!(network.place(pair[0]).distance(network.place(pair[1])) < 1.5);
        }
    }
}

#[test]
fn a_drawn_line_is_followed_once() {
    // A ring and a line, each of which has two edges in the bitmap.
    let bitmap = paint(90, 60, |x, y| {
        let [dx, dy] = [f64::from(x) - 30.0, f64::from(y) - 30.0];
        let ring = (18.0..22.0).contains(&dx.hypot(dy));
        ring || (65..69).contains(&x) && (5..55).contains(&y)
    });
    let found = centrelines(&bitmap, &CentrelineOptions::default());
    let mut loops: Vec<bool> = found.strokes.iter().map(|stroke| stroke.closed).collect();
    loops.sort_unstable();
    assert_eq!(loops, [false, true]);
    for stroke in &found.strokes {
        for pair in stroke.points.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|point| DVec2::from(point.place));
            assert!(a.distance(b) < 3.0, "{a:?} {b:?}");
        }
    }
}

#[test]
fn loops_between_junctions_that_are_joined_stay() {
    // Two rings of wide ink that touch: both junctions lie in one disc of ink, and both rings run from one to the
    // other.
    let rows = [
        "###...############################",
        "###...############################",
        "###...############################",
        "############......################",
        "############......################",
        "############......################",
        "###...############################",
        "###...############################",
        "###...############################",
        "############...###################",
        "############...###################",
    ];
    let bitmap = paint(34, 11, |x, y| {
        rows[y as usize].as_bytes()[x as usize] == b'#'
    });
    let options = CentrelineOptions {
        turd_size: 0,
        spur: 1.76,
        ..CentrelineOptions::default()
    };
    let found = centrelines(&bitmap, &options);
    assert_eq!((found.strokes.len(), found.junctions.len()), (2, 1));
    for far in [DVec2::new(2.0, 9.0), DVec2::new(21.0, 6.0)] {
        let mut points = found.strokes.iter().flat_map(|stroke| &stroke.points);
        assert!(
            points.any(|point| DVec2::from(point.place).distance(far) < 1.5),
            "{far}"
        );
    }
}

#[test]
fn a_thin_line_that_steps_stays_straight() {
    // On each step one pixel of the skeleton lies at the side of three of ink; the last one of the line does too.
    let middle = DVec2::new(60.668_072_305_958_22, 60.293_924_604_336_98);
    let along = DVec2::from_angle(1.4394860359040584);
    let line = [middle - along * 45.0, middle + along * 45.0];
    let found = centrelines(
        &drawn(120, &[line], 2.305589474236106),
        &CentrelineOptions::default(),
    );
    assert_eq!(found.strokes.len(), 1);
    for point in &found.strokes[0].points {
        let aside = (DVec2::from(point.place) - middle).perp_dot(along);
        assert!(aside.abs() < 0.05, "{aside} at {point:?}");
    }
}
