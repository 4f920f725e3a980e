//! Lines that cross, and lines that merely branch off near each other.

use super::*;

/// Ink of lines: discs of half the width along them; of lines a pixel wide the pixels nearest to them, one a column
/// or row.
fn inked(size: u32, lines: &[[DVec2; 2]], width: f64) -> Bitmap {
    if width > 1.0 {
        return drawn(size, lines, width);
    }
    paint(size, size, |x, y| {
        let p = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        lines.iter().any(|[a, b]| {
            let along = (*b - *a).normalize();
            let reach = 0.5 * along.abs().max_element();
            let t = (p - *a).dot(along);
            (0.0..=a.distance(*b)).contains(&t) && (p - *a).perp_dot(along).abs() <= reach
        })
    })
}

/// Strokes, ends and junctions.
fn counts(found: &Centrelines) -> (usize, usize, usize) {
    (
        found.strokes.len(),
        found.end_count(),
        found.junctions.len(),
    )
}

fn cross(middle: DVec2, angle: f64, between: f64) -> [[DVec2; 2]; 2] {
    [angle, angle + between].map(|angle| {
        let reach = DVec2::from_angle(angle) * 65.0;
        [middle - reach, middle + reach]
    })
}

/// How far the stroke that strays least from a line strays.
fn astray(found: &Centrelines, line: &[DVec2; 2]) -> f64 {
    let of_stroke = |stroke: &CentreStroke| {
        let points = stroke.points.iter();
        points
            .map(|p| distance_to(p.place.into(), line))
            .fold(0.0, f64::max)
    };
    let strokes = found.strokes.iter().map(of_stroke);
    strokes.fold(f64::INFINITY, f64::min)
}

/// A line, and two others that end on it, `apart` along it, on the same side or on both.
fn stems(middle: DVec2, angle: f64, apart: f64, same_side: bool) -> [[DVec2; 2]; 3] {
    let along = DVec2::from_angle(angle);
    let [a, b] = [
        middle - along * (0.5 * apart),
        middle + along * (0.5 * apart),
    ];
    let side = if same_side { 50.0 } else { -50.0 };
    [
        [middle - along * 60.0, middle + along * 60.0],
        [a, a + along.perp() * 50.0],
        [b, b + along.perp() * side],
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn lines_that_cross_are_two_strokes(
        angle in 0.0..3.2f64, between in 0.7..1.57f64, width in prop_oneof![Just(1.0), 1.5..7.0f64], dx in 0.0..1.0f64,
    ) {
        let middle = DVec2::new(80.0 + dx, 80.3);
        let lines = cross(middle, angle, between);
        let found = centrelines(&inked(160, &lines, width), &CentrelineOptions::default());
        prop_assert_eq!(counts(&found), (2, 4, 1));
        // The pixels of a line lie up to a pixel beside it: half of one beside the middle of even ink, and that half
        // of one beside the line. Led on to the junction, its arms are a quarter further off. The place where two
        // lines cross moves along the line between them the more, the flatter they cross.
        let aside = 1.0 + 0.25;
        let off = DVec2::from(found.junctions[0]).distance(middle);
        prop_assert!(off < aside / (0.5 * between).sin(), "{} px", off);
        for line in &lines {
            prop_assert!(astray(&found, line) < 1.2);
        }
    }

    #[test]
    fn lines_that_branch_off_near_each_other_are_two_junctions(
        angle in 0.0..3.2f64, width in prop_oneof![Just(1.0), 1.5..6.0f64], gap in 2.0..20.0f64, same_side: bool,
        dx in 0.0..1.0f64,
    ) {
        let lines = stems(DVec2::new(80.0 + dx, 80.3), angle, width + gap, same_side);
        let found = centrelines(&inked(160, &lines, width), &CentrelineOptions::default());
        prop_assert_eq!(counts(&found), (3, 4, 2));
    }
}

#[test]
fn thin_lines_that_end_on_both_sides_of_another_do_not_cross_it() {
    // Two pixels of white are between them: over the little that is seen of them they seem to lead to each other.
    for (angle, dx) in [
        (0.05397851121258157, 0.9889415579776226),
        (3.087471331500078, 0.44153980762648964),
    ] {
        let lines = stems(DVec2::new(80.0 + dx, 80.3), angle, 3.0, false);
        let found = centrelines(&inked(160, &lines, 1.0), &CentrelineOptions::default());
        assert_eq!(counts(&found), (3, 4, 2), "{angle}");
    }
}

#[test]
fn a_line_goes_on_over_a_bridge_of_three_pixels() {
    // The pixel in the middle of the bridge lies aside, so that both its ends lead 45 degrees astray.
    let lines = stems(DVec2::new(80.0, 80.3), 1.3508682306311295, 3.0, true);
    let found = centrelines(&inked(160, &lines, 1.0), &CentrelineOptions::default());
    assert_eq!(counts(&found), (3, 4, 2));
}

#[test]
fn a_crossing_whose_arms_lie_at_the_sides_of_their_ink_is_one() {
    // The two arms of one of the lines have their pixels on opposite sides of its ink.
    let middle = DVec2::new(80.08920766553777, 80.3);
    let lines = cross(middle, 0.6792165281595175, 0.95759862294981);
    let found = centrelines(
        &inked(160, &lines, 2.3620199057292375),
        &CentrelineOptions::default(),
    );
    assert_eq!(counts(&found), (2, 4, 1));
}

/// Of 40 crossings of a width and angle, in all directions, how many are two strokes.
fn crossed(width: f64, degrees: f64) -> usize {
    let is_cross = |k: &u32| {
        let share = f64::from(*k);
        let middle = DVec2::new(80.0 + (share * 0.37).fract(), 80.0 + (share * 0.73).fract());
        let lines = cross(middle, share * 1.941, degrees.to_radians());
        let found = centrelines(&inked(160, &lines, width), &CentrelineOptions::default());
        counts(&found) == (2, 4, 1) && lines.iter().all(|line| astray(&found, line) < 1.5)
    };
    (0..40).filter(is_cross).count()
}

#[test]
fn flat_crossings_are_two_strokes_too() {
    for width in [1.0, 2.0, 3.0, 5.0] {
        for (degrees, least) in [(90.0, 40), (60.0, 40), (40.0, 39), (30.0, 39), (20.0, 36)] {
            let count = crossed(width, degrees);
            assert!(
                count >= least,
                "{count} of 40, {width} px, {degrees} degrees"
            );
        }
    }
}

#[test]
fn three_lines_through_one_place_are_three_strokes() {
    let middle = DVec2::splat(80.3);
    let lines = [0.2f64, 1.2, 2.3].map(|angle| {
        let reach = DVec2::from_angle(angle) * 65.0;
        [middle - reach, middle + reach]
    });
    for width in [1.0, 2.0, 3.0, 5.0] {
        let found = centrelines(&inked(160, &lines, width), &CentrelineOptions::default());
        assert_eq!(counts(&found), (3, 6, 1), "{width} px");
    }
}

/// Lines that touch for a while and part again, each on its own side, do not cross.
#[test]
fn lines_that_touch_and_part_keep_their_sides() {
    let bent = |side: f64| {
        let at = |x: f64, y: f64| DVec2::new(x, 80.0 + side * y);
        [
            [at(15.0, 30.0), at(70.0, 1.0)],
            [at(70.0, 1.0), at(90.0, 1.0)],
            [at(90.0, 1.0), at(145.0, 30.0)],
        ]
    };
    let lines: Vec<[DVec2; 2]> = [1.0, -1.0].into_iter().flat_map(bent).collect();
    let found = centrelines(&drawn(160, &lines, 3.0), &CentrelineOptions::default());
    assert_eq!((found.end_count(), found.junctions.len()), (4, 2));
}
