//! Gaps in made-up lines.

use super::*;
use crate::mesh_lines::run::testing::run_along;
use proptest::prelude::*;

/// A straight contour from one place to another, with a point to a pixel.
fn contour(id: u64, from: [f64; 2], to: [f64; 2]) -> Run {
    let [from, to] = [from, to].map(DVec2::from);
    let count = from.distance(to).ceil().max(1.0) as u32;
    let places: Vec<[f64; 2]> = (0..=count)
        .map(|i| from.lerp(to, f64::from(i) / f64::from(count)).to_array())
        .collect();
    run_along(id, &places)
}

fn joins(runs: Vec<Run>) -> bool {
    let before = runs.len();
    bridge_gaps(runs, None).len() < before
}

#[test]
fn a_pen_comes_from_one_cusp_to_the_next() {
    let lip = contour(1, [0.0, 0.0], [30.0, 0.0]);
    let other = contour(2, [46.0, 1.0], [90.0, 0.0]);
    let both = vec![lip.clone(), other.clone()];
    let joined = bridge_gaps(both.clone(), None);
    assert_eq!((joined.len(), joined[0].id), (1, 1));
    assert_eq!(
        joined[0].points.len(),
        lip.points.len() + other.points.len()
    );

    // Not where something stands between, or runs along there.
    let between = [
        contour(3, [38.0, -20.0], [38.0, 20.0]),
        contour(3, [20.0, 3.0], [60.0, 3.0]),
        contour(3, [38.0, 2.0], [38.0, 60.0]),
    ];
    for third in between {
        assert!(!joins([&both[..], std::slice::from_ref(&third)].concat()));
        let hidden = Run {
            occluders: 1,
            ..third
        };
        assert!(
            joins([&both[..], &[hidden]].concat()),
            "hidden lines are not drawn"
        );
    }
    let aside = contour(3, [38.0, 6.0], [38.0, 60.0]);
    assert!(joins([&both[..], &[aside]].concat()));

    // Nor for lines that are not alike, are hidden, point elsewhere, or are short for the gap.
    let others = [
        Run {
            surface: 5,
            ..other.clone()
        },
        Run {
            object: 5,
            ..other.clone()
        },
        contour(2, [46.0, 9.0], [90.0, 9.0]),
        contour(2, [46.0, 0.0], [90.0, 30.0]),
        contour(2, [46.0, 0.0], [60.0, 0.0]),
        contour(2, [52.0, 0.0], [90.0, 0.0]),
    ];
    for other in others {
        assert!(!joins(vec![lip.clone(), other]));
    }
    let hidden = [&lip, &other].map(|run| Run {
        occluders: 2,
        ..run.clone()
    });
    assert!(!joins(hidden.to_vec()));
    let creases = [&lip, &other].map(|run| Run {
        kind: Kind::Crease,
        ..run.clone()
    });
    assert!(!joins(creases.to_vec()));
}

#[test]
fn of_two_gaps_at_an_end_the_narrower_is_bridged() {
    let lip = contour(1, [0.0, 0.0], [40.0, 0.0]);
    let near = contour(2, [52.0, 2.0], [100.0, 2.0]);
    let far = contour(3, [58.0, -3.0], [100.0, -3.0]);
    let joined = bridge_gaps(vec![far.clone(), lip, near], None);
    assert_eq!(joined.len(), 2);
    assert_eq!(joined[0], far);
}

proptest! {
    /// An arc with a gap is one line where the gap is narrow and the arc bends little over it.
    #[test]
    fn arcs_are_bridged_where_they_bend_little(
        radius in 30.0..600.0f64, gap in 9.0..26.0f64, lengths in prop::array::uniform2(8.0..60.0f64),
    ) {
        let arc = |from: f64, to: f64| {
            let count = (to - from).ceil().max(2.0);
            let places = (0..=count as u32).map(|i| {
                let angle = (from + (to - from) * f64::from(i) / count) / radius;
                [radius * angle.sin(), radius * angle.cos()]
            });
            places.collect::<Vec<[f64; 2]>>()
        };
        let [before, after] = lengths;
        let runs = vec![
            run_along(1, &arc(0.0, before)),
            run_along(2, &arc(before + gap, before + gap + after)),
        ];
        // Ends point the way of their last six pixels, three pixels before they end.
        let angle = (gap + 6.0) / radius;
        let chord = 2.0 * radius * (0.5 * gap / radius).sin();
        let margins = [
            STRAIGHT_COS.acos() - angle,
            (BRIDGED_PX - chord) / BRIDGED_PX,
            (BRIDGED_SHARE * before.min(after) - chord) / BRIDGED_PX,
        ];
        prop_assume!(margins.iter().all(|margin| margin.abs() > 0.04));
        prop_assert_eq!(joins(runs), margins.iter().all(|margin| *margin > 0.0));
    }
}
