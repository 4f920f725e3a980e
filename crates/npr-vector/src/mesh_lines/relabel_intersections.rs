//! Relabels lines that change between an intersection and another kind every few pixels.
//!
//! Where a shape is pressed into another with about the same outline, a peg into a hole, the line between the two is
//! now a contour of the one and now where they intersect, a facet each. To the eye it is one line, and only runs of
//! one kind are joined.

use crate::mesh_lines::merge::{DOT_PX, TOUCHING_PX, near_ends};
use crate::mesh_lines::run::Run;
use crate::stroke::Kind;

/// Short intersections between the ends of two runs of other kinds take the kind of one of these; order is kept.
///
/// Less than 8 pixels is short. The others must touch one end each and be of the object and visibility; of two kinds
/// the one that comes first in [`Kind::ALL`] is taken, and its surface too, so that they can be joined. Edges of the
/// mesh keep their kinds: each stands for itself. O(n log n) for ends that are spread over the picture.
pub fn relabel_intersections(mut runs: Vec<Run>) -> Vec<Run> {
    if runs.iter().all(|run| run.kind != Kind::Intersection) {
        return runs;
    }

    // Find at each end of an intersection the strongest line that touches it.
    let mut stronger: Vec<[Option<(Kind, u32)>; 2]> = vec![[None; 2]; runs.len()];
    for [a, b] in near_ends(&runs, TOUCHING_PX) {
        let (run_a, run_b) = (&runs[a / 2], &runs[b / 2]);
        if !run_a.is_beside(run_b) {
            continue;
        }
        let (weaker, other) = match (run_a.kind, run_b.kind) {
            (Kind::Intersection, Kind::Intersection) => continue,
            (Kind::Intersection, _) => (a, run_b),
            (_, Kind::Intersection) => (b, run_a),
            _ => continue,
        };
        let found = &mut stronger[weaker / 2][weaker % 2];
        let offered = (other.kind, other.surface);
        *found = Some(found.map_or(offered, |before| before.min(offered)));
    }

    // A dot between two such lines becomes one of them.
    for (run, sides) in runs.iter_mut().zip(stronger) {
        if let [Some(a), Some(b)] = sides
            && run.length() < DOT_PX
        {
            (run.kind, run.surface) = a.min(b);
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::merge::merge_ends;
    use crate::mesh_lines::run::testing::{ring, run_along};
    use proptest::prelude::*;

    /// A circle of facets, contours and intersections in turns.
    fn peg(count: usize, radius: f64, first: Kind) -> Vec<Run> {
        let places = ring(0, radius, count).points;
        let place = |i: usize| places[i % count].place;
        let facet = |i: usize| {
            let kind = match i.is_multiple_of(2) == (first == Kind::Contour) {
                true => Kind::Contour,
                false => Kind::Intersection,
            };
            let surface = u32::from(kind == Kind::Intersection);
            Run {
                kind,
                surface,
                ..run_along(i as u64, &[place(i), place(i + 1)])
            }
        };
        (0..count).map(facet).collect()
    }

    #[test]
    fn a_long_line_keeps_its_kind() {
        let between = |length: f64| {
            let middle = run_along(1, &[[20.0, 0.0], [20.0 + length, 0.0]]);
            vec![
                run_along(0, &[[0.0, 0.0], [20.0, 0.0]]),
                Run {
                    kind: Kind::Intersection,
                    ..middle
                },
                run_along(2, &[[20.0 + length, 0.0], [60.0, 0.0]]),
            ]
        };
        assert_eq!(relabel_intersections(between(7.0))[1].kind, Kind::Contour);
        assert_eq!(
            relabel_intersections(between(9.0))[1].kind,
            Kind::Intersection
        );
        let mut hidden = between(7.0);
        hidden[2].occluders = 1;
        assert_eq!(relabel_intersections(hidden.clone()), hidden);
    }

    #[test]
    fn of_several_lines_at_an_end_the_first_kind_counts_in_any_order() {
        let of = |kind: Kind, surface: u32, run: Run| Run {
            kind,
            surface,
            ..run
        };
        let crease = of(Kind::Crease, 5, run_along(0, &[[0.0, 0.0], [20.0, 0.0]]));
        let contour = of(Kind::Contour, 6, run_along(1, &[[20.0, 30.0], [20.0, 0.0]]));
        let short = of(
            Kind::Intersection,
            7,
            run_along(2, &[[20.0, 0.0], [27.0, 0.0]]),
        );
        let beyond = of(Kind::Material, 8, run_along(3, &[[27.0, 0.0], [60.0, 0.0]]));
        let runs = [crease, contour, short, beyond];
        for order in [[0, 1, 2, 3], [1, 0, 2, 3], [3, 2, 1, 0]] {
            let relabelled = relabel_intersections(order.map(|i: usize| runs[i].clone()).to_vec());
            let short = relabelled.iter().find(|run| run.id == 2).unwrap();
            assert_eq!((short.kind, short.surface), (Kind::Contour, 6), "{order:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// What is left of a peg in a hole is one closed line.
        #[test]
        fn a_peg_in_a_hole_is_one_line(half in 8_usize..60, facet in 3.2_f64..7.5, starts in prop::bool::ANY) {
            let count = 2 * half;
            let radius = facet / (2.0 * (std::f64::consts::PI / count as f64).sin());
            let first = if starts { Kind::Contour } else { Kind::Intersection };
            let runs = merge_ends(relabel_intersections(peg(count, radius, first)), TOUCHING_PX);
            prop_assert_eq!(runs.len(), 1);
            prop_assert!(runs[0].closed && runs[0].kind == Kind::Contour);
        }

        /// Places, order and number of runs never change, and no kind but that of short intersections.
        #[test]
        fn only_kinds_change(
            lines in prop::collection::vec(
                (
                    prop::array::uniform2(0.0_f64..20.0), prop::array::uniform2(0.0_f64..20.0),
                    0_usize..Kind::ALL.len(), 0_u32..2,
                ),
                0..30,
            ),
        ) {
            let runs: Vec<Run> = lines.iter().enumerate().map(|(id, (from, to, kind, occluders))| {
                Run { kind: Kind::ALL[*kind], occluders: *occluders, ..run_along(id as u64, &[*from, *to]) }
            }).collect();
            let adopted = relabel_intersections(runs.clone());
            prop_assert_eq!(adopted.len(), runs.len());
            for (new, old) in adopted.iter().zip(&runs) {
                let kept = Run { kind: old.kind, surface: old.surface, ..new.clone() };
                prop_assert_eq!(&kept, old);
                prop_assert!(new == old || old.kind == Kind::Intersection && old.length() < DOT_PX);
            }
        }
    }
}
