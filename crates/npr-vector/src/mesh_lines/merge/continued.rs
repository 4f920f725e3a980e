//! Where a line goes on as one of another kind or surface.

use super::limits::Limits;
use super::{TOUCHING_PX, distance, dot, ends_of, go_on, near_pairs, paired};
use crate::mesh_lines::joints::Bond;
use crate::mesh_lines::run::Run;

/// The end that goes on as each end, or [`usize::MAX`]: of one object, both seen or both hidden, about as deep, the
/// same way, and within a pen's width. Each is used once, the best pairs first. O(n log n).
///
/// End `2 r` is the first point of run `r`, `2 r + 1` its last.
pub(crate) fn continued_ends(runs: &[Run]) -> Vec<usize> {
    let (ends, limits) = (ends_of(runs), Limits::of(Bond::New));
    let fit = |[a, b]: [usize; 2]| {
        let (end_a, end_b) = (ends[a].as_ref()?, ends[b].as_ref()?);
        let as_deep = (end_a.depth - end_b.depth).abs() <= limits.depth_share * end_a.depth.abs();
        let goes_on = a / 2 != b / 2
            && as_deep
            && runs[a / 2].is_beside(&runs[b / 2])
            && go_on(end_a, end_b, &limits);
        let gap = distance(end_a.place, end_b.place);
        goes_on.then(|| (gap / TOUCHING_PX + dot(end_a.out, end_b.out), a, b))
    };
    let pairs = near_pairs(&ends, TOUCHING_PX).into_iter();
    paired(pairs.filter_map(fit).collect(), ends.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::run::testing::run_along;
    use crate::stroke::Kind;

    const NONE: usize = usize::MAX;

    #[test]
    fn a_line_goes_on_as_one_of_another_kind() {
        let outline = run_along(1, &[[0.0, 0.0], [40.0, 0.0]]);
        let mut fold = run_along(1, &[[41.0, 0.5], [80.0, 8.0]]);
        (fold.kind, fold.surface, fold.id) = (Kind::Crease, 7, 9);
        assert_eq!(
            continued_ends(&[outline.clone(), fold.clone()]),
            [NONE, 2, 1, NONE]
        );

        // Whichever way they run.
        fold.reverse();
        assert_eq!(continued_ends(&[fold, outline]), [NONE, 3, NONE, 1]);
    }

    #[test]
    fn ends_that_turn_or_lie_elsewhere_do_not_go_on() {
        let line = run_along(1, &[[0.0, 0.0], [40.0, 0.0]]);
        let none = [NONE; 4];
        let around_a_corner = run_along(1, &[[40.0, 0.0], [40.0, 40.0]]);
        assert_eq!(continued_ends(&[line.clone(), around_a_corner]), none);
        let far = run_along(1, &[[46.0, 0.0], [80.0, 0.0]]);
        assert_eq!(continued_ends(&[line.clone(), far]), none);
        let on = run_along(1, &[[40.0, 0.0], [80.0, 0.0]]);
        for change in 0..3 {
            let mut other = on.clone();
            match change {
                0 => other.object += 1,
                1 => other.occluders += 1,
                _ => other.points.iter_mut().for_each(|point| point.depth *= 1.5),
            }
            assert_eq!(continued_ends(&[line.clone(), other]), none, "{change}");
        }
    }

    #[test]
    fn of_two_that_would_go_on_the_straighter_does() {
        let line = run_along(1, &[[0.0, 0.0], [40.0, 0.0]]);
        let bent = run_along(1, &[[40.0, 0.0], [76.0, 17.0]]);
        let on = run_along(1, &[[40.0, 0.0], [80.0, 1.0]]);
        assert_eq!(
            continued_ends(&[bent, line, on]),
            [NONE, NONE, NONE, 4, 3, NONE]
        );
    }
}
