//! Cuts spurs: the last few pixels of a line beyond the place where another ends on it.
//!
//! Where one outline comes out from behind another, both are found a little past the place where they meet: the front
//! one runs on to its cusp. On paper that is a whisker on the corner of one line, so a pen goes round the corner and
//! leaves it out.

use crate::mesh_lines::merge::{DOT_PX, TOUCHING_PX};
use crate::mesh_lines::near::{Cells, cell_of, cells_around};
use crate::mesh_lines::run::{Run, distance};

/// Least length of a run that must be left, in pixels: a shorter one is no line with a spur, but a short line.
const LEAST_LEFT_PX: f64 = 4.0 * DOT_PX;

/// Greatest length of a spur, in pixels, on a line that is long enough for it.
const LONGEST_PX: f64 = 1.5 * DOT_PX;

/// Greatest length of a spur beyond 8 pixels, as a share of the line with it: an eighth of what stays.
const SHARE: f64 = 1.0 / 9.0;

/// Runs without spurs; order is kept. Runs must be sampled at most a pen's width apart.
///
/// The end of an open run is taken off up to the place where an end of another run of the kind, object, surface and
/// visibility touches it, if that is less than 8 pixels from its tip, if its tip touches no other run, and if at
/// least 32 pixels stay. From lines that stay eight times as long as what goes, up to 12 pixels go: what is an end of
/// its own on a short line is a slip on a long one. Ends that were cut at corners stay. O(samples) for lines that do
/// not crowd in one place.
pub fn cut_overshoot(mut runs: Vec<Run>) -> Vec<Run> {
    let near = Near::new(&runs);
    let spurs: Vec<[usize; 2]> = (0..runs.len())
        .map(|index| [false, true].map(|at_tail| near.spur(&runs, index, at_tail)))
        .collect();
    for (run, [head, tail]) in runs.iter_mut().zip(spurs) {
        run.points.truncate(run.points.len() - tail);
        run.points.drain(..head);
    }
    runs
}

/// A point of a run.
struct Sample {
    place: [f64; 2],
    run: usize,
    /// Whether it is the first or last point of an open run.
    is_end: bool,
}

/// Points of all runs, in cells.
struct Near {
    cells: Cells<Sample>,
}

impl Near {
    fn new(runs: &[Run]) -> Self {
        let mut cells = Cells::new(TOUCHING_PX);
        for (index, run) in runs.iter().enumerate() {
            let last = run.points.len() - 1;
            for (i, point) in run.points.iter().enumerate() {
                let sample = Sample {
                    place: point.place,
                    run: index,
                    is_end: !run.closed && (i == 0 || i == last),
                };
                cells.add(point.place, sample);
            }
        }
        Self { cells }
    }

    /// How many points at an end of a run are a spur.
    fn spur(&self, runs: &[Run], index: usize, at_tail: bool) -> usize {
        let run = &runs[index];
        let length = run.length();
        if run.closed || run.cut[usize::from(at_tail)] || length < LEAST_LEFT_PX + 2.0 * DOT_PX {
            return 0;
        }

        // Tips that touch another line are no overshoot.
        let last = run.points.len() - 1;
        let place = |i: usize| run.points[if at_tail { last - i } else { i }].place;
        if self.others(place(0), index).next().is_some() {
            return 0;
        }

        // Look for the last place near the tip at which another line ends.
        let longest = (SHARE * length).clamp(DOT_PX, LONGEST_PX);
        let mut from_tip = 0.0;
        let mut spur = 0;
        for i in 1..=last {
            from_tip += distance(place(i - 1), place(i));
            if from_tip >= longest {
                break;
            }
            let ends_here = |other: &Sample| other.is_end && run.may_join(&runs[other.run]);
            if self.others(place(i), index).any(ends_here) {
                spur = i;
            }
        }
        spur
    }

    /// The points of other runs that touch a place.
    fn others(&self, place: [f64; 2], run: usize) -> impl Iterator<Item = &Sample> {
        let around = self.cells.of(cells_around(cell_of(place, TOUCHING_PX)));
        around.filter(move |other| other.run != run && distance(other.place, place) <= TOUCHING_PX)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::run::testing::straight;
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_2;

    /// A level line from the origin to x = 60, and one that goes down from `beyond` pixels before its end, starting
    /// `gap` pixels under it.
    fn corner(beyond: f64, gap: f64) -> Vec<Run> {
        vec![
            straight(0, [0.0, 0.0], 0.0, 60.0),
            straight(1, [60.0 - beyond, gap], FRAC_PI_2, 40.0),
        ]
    }

    fn length_of_first(runs: Vec<Run>) -> f64 {
        cut_overshoot(runs)[0].length()
    }

    #[test]
    fn a_line_ends_where_another_ends_on_it() {
        let left = length_of_first(corner(6.0, 1.0));
        assert!((left - 54.0).abs() < 3.0, "{left} px");
    }

    #[test]
    fn longer_ends_and_other_lines_stay() {
        assert_eq!(length_of_first(corner(12.0, 0.0)), 60.0);
        assert_eq!(length_of_first(corner(6.0, 4.0)), 60.0);
        let with = |change: fn(&mut Run)| {
            let mut runs = corner(6.0, 1.0);
            change(&mut runs[1]);
            length_of_first(runs)
        };
        assert_eq!(with(|other| other.object = 1), 60.0);
        assert_eq!(with(|other| other.occluders = 1), 60.0);
        assert_eq!(with(|other| other.closed = true), 60.0);
        let mut cut = corner(6.0, 1.0);
        cut[0].cut = [false, true];
        assert_eq!(length_of_first(cut), 60.0);
    }

    #[test]
    fn a_longer_spur_goes_from_a_long_line() {
        let left = |length: f64, beyond: f64| {
            length_of_first(vec![
                straight(0, [0.0, 0.0], 0.0, length),
                straight(1, [length - beyond, 1.0], FRAC_PI_2, 40.0),
            ])
        };
        assert!((left(100.0, 10.0) - 90.0).abs() < 3.0);
        assert!((left(300.0, 11.0) - 289.0).abs() < 3.0);
        assert_eq!(left(70.0, 12.0), 70.0);
        assert_eq!(left(300.0, 16.0), 300.0);
    }

    #[test]
    fn an_end_that_touches_something_stays() {
        let mut runs = corner(6.0, 1.0);
        runs.push(straight(2, [61.0, 0.0], 1.0, 30.0));
        assert_eq!(length_of_first(runs), 60.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// A run keeps a part in one piece of itself, all but less than eight pixels at each end, and short runs all.
        #[test]
        fn only_ends_go(
            lines in prop::collection::vec((prop::array::uniform2(0.0_f64..40.0), 0.0_f64..6.3, 2.0_f64..60.0), 0..25),
        ) {
            let made = |(id, (from, angle, length)): (u64, &([f64; 2], f64, f64))| straight(id, *from, *angle, *length);
            let runs: Vec<Run> = (0..).zip(&lines).map(made).collect();
            let cut = cut_overshoot(runs.clone());
            prop_assert_eq!(cut.len(), runs.len());
            for (new, old) in cut.iter().zip(&runs) {
                let from = old.points.iter().position(|p| *p == new.points[0]).unwrap();
                prop_assert_eq!(&new.points[..], &old.points[from..from + new.points.len()]);
                prop_assert!(old.length() - new.length() < 2.0 * DOT_PX);
                prop_assert!(new == old || new.length() > LEAST_LEFT_PX);
            }
        }
    }
}
