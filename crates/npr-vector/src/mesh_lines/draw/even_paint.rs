//! Evens out colours and widths along strokes.

use crate::mesh_lines::run::distance;
use crate::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;

/// Pixels along a stroke to either side over which its paint is averaged: normals of scans jump from face to face, so
/// that light would change a line every few pixels, and no pen does.
const REACH_PX: f64 = 14.0;

/// Pixels by which a width may change along a pixel of a stroke: a tip that is pressed down opens within a few of its
/// widths.
const WIDTH_SLOPE: f64 = 0.12;

/// Gives each point of a stroke the mean paint of the stretch around it: colours by alpha, widths by length.
///
/// Towards ends stretches are shorter, so that what changes evenly stays as it is, as does what is even. Where a point
/// has no colour, or one near it, its colour stays.
/// O(points): the points of a stretch are few.
pub(super) fn even_out(stroke: &mut Stroke) {
    let points = &stroke.points;
    let count = points.len();
    let is_even = points
        .windows(2)
        .all(|pair| (pair[0].color, pair[0].width) == (pair[1].color, pair[1].width));
    if is_even {
        return;
    }
    let length = points.last().map_or(0.0, |last| last.u);
    let means: Vec<(Option<[u8; 4]>, f64)> = (0..count)
        .map(|at| {
            let mut mean = Mean::default();
            let reach = match stroke.closed {
                true => REACH_PX,
                false => REACH_PX.min(points[at].u).min(length - points[at].u),
            };
            let gaps = [1, count - 1].map(|step| walk(stroke, (at, step), reach, &mut mean));
            mean.add(
                &points[at],
                (0.5 * (gaps[0] + gaps[1])).max(f64::MIN_POSITIVE),
            );
            (mean.color().or(points[at].color), mean.width())
        })
        .collect();
    for (point, (color, width)) in stroke.points.iter_mut().zip(means) {
        (point.color, point.width) = (color, width);
    }
}

/// Adds the points within `reach` on one side of a point and gives the way to the first of them, 0 where there is none;
/// `step` is 1, or the number of points less 1 for the other side.
fn walk(stroke: &Stroke, (from, step): (usize, usize), reach: f64, mean: &mut Mean) -> f64 {
    let (points, count) = (&stroke.points, stroke.points.len());
    let (mut at, mut passed, mut first) = (from, 0.0, 0.0);
    for _ in 1..count {
        let next = (at + step) % count;
        let is_seam = at.abs_diff(next) != 1 || count == 2 && (step == 1) != (next > at);
        if is_seam && !stroke.closed {
            break;
        }
        let gap = distance(points[at].position, points[next].position);
        passed += gap;
        if at == from {
            first = gap;
        }
        if passed > reach {
            break;
        }
        // Near points count more, so that what is left of a jump is a slope.
        mean.add(&points[next], gap * (1.0 - passed / reach));
        at = next;
    }
    first
}

/// Limits how fast widths change along the strokes that `is_limited`, as [`limit_slope`] does, and across the ends
/// where one goes on as another: there a pen does not jump either. `mates` holds for each end the one that goes on, or
/// [`usize::MAX`]; end `2 s` is the first point of stroke `s`, `2 s + 1` its last. O(points).
pub(super) fn limit_slopes(
    strokes: &mut [Stroke],
    mates: &[usize],
    is_limited: impl Fn(usize) -> bool + Sync,
) {
    // Follow every line from one of its ends, and rings from anywhere.
    let goes_on = |end: usize| {
        let mate = mates[end];
        let is_limited = mate != usize::MAX && is_limited(end / 2) && is_limited(mate / 2);
        is_limited.then_some(mate)
    };
    let mut chains: Vec<Vec<usize>> = Vec::new();
    let mut used = vec![false; strokes.len()];
    let open = (0..mates.len()).filter(|end| goes_on(*end).is_none());
    for start in open.chain((0..strokes.len()).map(|stroke| 2 * stroke)) {
        let mut chain = Vec::new();
        let mut entry = Some(start);
        while let Some(end) = entry.filter(|end| !used[end / 2]) {
            used[end / 2] = true;
            chain.push(end);
            entry = goes_on(end ^ 1);
        }
        if chain.first().is_some_and(|end| is_limited(end / 2)) {
            chains.push(chain);
        }
    }

    // Limit those of several strokes as one stroke.
    let (several, alone): (Vec<_>, Vec<_>) = chains.into_iter().partition(|chain| chain.len() > 1);
    let widths = |chain: &Vec<usize>| {
        let along = |end: &usize| {
            let points = strokes[end / 2].points.iter().copied();
            match end % 2 {
                0 => points.collect::<Vec<_>>(),
                _ => points.rev().collect(),
            }
        };
        let last = chain.last().map(|end| end ^ 1);
        let mut whole = Stroke {
            points: chain.iter().flat_map(along).collect(),
            closed: last.is_some_and(|last| mates[last] == chain[0]),
            ..strokes[chain[0] / 2].clone()
        };
        limit_slope(&mut whole);
        whole.points
    };
    let limited: Vec<Vec<StrokePoint>> = several.par_iter().map(widths).collect();
    for (chain, points) in several.iter().zip(limited) {
        let mut points = points.iter();
        for end in chain {
            let own = strokes[end / 2].points.iter_mut();
            let take =
                |(own, of_whole): (&mut StrokePoint, &StrokePoint)| own.width = of_whole.width;
            match end % 2 {
                0 => own.zip(points.by_ref()).for_each(take),
                _ => own.rev().zip(points.by_ref()).for_each(take),
            }
        }
    }

    // Limit the others each for itself.
    let mut is_alone = vec![false; strokes.len()];
    alone.iter().for_each(|chain| is_alone[chain[0] / 2] = true);
    let alone = strokes.par_iter_mut().zip(&is_alone);
    alone
        .filter(|(_, is_alone)| **is_alone)
        .for_each(|(stroke, _)| limit_slope(stroke));
}

/// Lets widths that follow the surface change along a stroke no faster than a pen does: at hard edges and small facets
/// the surface bends at once, and there they would jump.
///
/// Each point gets the mean of the widest width that lies nowhere above the stroke's and of the narrowest that lies
/// nowhere below it, of those that change by [`WIDTH_SLOPE`] at most. So what changes slower stays as it is, and a jump
/// becomes a slope to both of its sides. O(points).
fn limit_slope(stroke: &mut Stroke) {
    let points = &stroke.points;
    let steeper = |from: &StrokePoint, to: &StrokePoint| {
        (to.width - from.width).abs() > WIDTH_SLOPE * distance(from.position, to.position)
    };
    let seam = points.last().zip(points.first()).filter(|_| stroke.closed);
    let is_steep = points.windows(2).any(|pair| steeper(&pair[0], &pair[1]))
        || seam.is_some_and(|(last, first)| steeper(last, first));
    if !is_steep {
        return;
    }
    let widths = || points.iter().map(|point| point.width);
    let below = envelope(stroke, widths().collect());
    let above = envelope(stroke, widths().map(|width| -width).collect());
    for ((point, below), above) in stroke.points.iter_mut().zip(below).zip(above) {
        point.width = 0.5 * (below - above);
    }
}

/// The greatest values that lie nowhere above these, and change along a stroke by [`WIDTH_SLOPE`] at most.
fn envelope(stroke: &Stroke, mut values: Vec<f64>) -> Vec<f64> {
    let (points, count) = (&stroke.points, values.len());
    // A ring is walked from its least value, which stays, once round.
    let least = (0..count).min_by(|a, b| values[*a].total_cmp(&values[*b]));
    let (start, steps) = match stroke.closed {
        true => (least.unwrap_or(0), count),
        false => (0, count - 1),
    };
    let place = |step: usize| (start + step) % count;
    let mut limit = |from: usize, to: usize| {
        let gap = distance(points[from].position, points[to].position);
        values[to] = values[to].min(values[from] + WIDTH_SLOPE * gap);
    };
    for step in 0..steps {
        limit(place(step), place(step + 1));
    }
    for step in (0..steps).rev() {
        limit(place(step + 1), place(step));
    }
    values
}

/// A mean of paint.
#[derive(Debug, Default)]
struct Mean {
    weight: f64,
    width: f64,
    /// Colours times alpha, then alpha.
    color: [f64; 4],
    is_colorless: bool,
}

impl Mean {
    fn add(&mut self, point: &StrokePoint, weight: f64) {
        self.weight += weight;
        self.width += point.width * weight;
        let Some(color) = point.color else {
            self.is_colorless = true;
            return;
        };
        let [r, g, b, alpha] = color.map(f64::from);
        for (sum, value) in self
            .color
            .iter_mut()
            .zip([r * alpha, g * alpha, b * alpha, alpha])
        {
            *sum += value * weight;
        }
    }

    fn width(&self) -> f64 {
        self.width / self.weight
    }

    /// None where a point has no colour, or nothing is seen of any.
    fn color(&self) -> Option<[u8; 4]> {
        let [r, g, b, alpha] = self.color;
        let is_seen = !self.is_colorless && alpha > 0.0;
        is_seen.then(|| {
            let [r, g, b] = [r, g, b].map(|sum| (sum / alpha).round() as u8);
            [r, g, b, (alpha / self.weight).round() as u8]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh_lines::draw::PointPaint;
    use crate::mesh_lines::draw::paint::strokes_of;
    use crate::mesh_lines::run::testing::{ring, run_along};
    use proptest::prelude::*;

    const BLACK: [u8; 4] = [0, 0, 0, 255];
    const WHITE: [u8; 4] = [255; 4];

    fn painted(closed: bool, count: usize, paint: impl Fn(usize) -> ([u8; 4], f64)) -> Stroke {
        let run = match closed {
            true => ring(1, count as f64, count),
            false => run_along(
                1,
                &(0..count)
                    .map(|i| [3.0 * i as f64, 0.0])
                    .collect::<Vec<_>>(),
            ),
        };
        let plain = PointPaint {
            color: None,
            width: 1.0,
        };
        let mut stroke = strokes_of(vec![run], &|_, _| plain).remove(0);
        for (i, point) in stroke.points.iter_mut().enumerate() {
            let (color, width) = paint(i);
            (point.color, point.width) = (Some(color), width);
        }
        stroke
    }

    /// The greatest step of lightness from point to point.
    fn steepest(stroke: &Stroke) -> u8 {
        let tones = |point: &StrokePoint| point.color.map_or(0, |color| color[0]);
        let pairs = stroke.points.windows(2);
        pairs
            .map(|pair| tones(&pair[0]).abs_diff(tones(&pair[1])))
            .max()
            .unwrap_or(0)
    }

    #[test]
    fn what_flips_from_point_to_point_becomes_even() {
        for closed in [false, true] {
            let flips = |i: usize| {
                (
                    if i.is_multiple_of(2) { BLACK } else { WHITE },
                    1.0 + (i % 2) as f64,
                )
            };
            let mut stroke = painted(closed, 40, flips);
            assert_eq!(steepest(&stroke), 255);
            even_out(&mut stroke);
            // The last pixels at open ends have short stretches.
            let ends = if closed { 0 } else { 4 };
            stroke.points.drain(..ends);
            stroke.points.truncate(40 - 2 * ends);
            assert!(steepest(&stroke) < 60, "{}", steepest(&stroke));
            let middle = &stroke.points[20];
            assert!((middle.width - 1.5).abs() < 0.15, "{}", middle.width);
        }
    }

    #[test]
    fn a_jump_becomes_a_slope_and_both_sides_stay() {
        let mut stroke = painted(false, 40, |i| (if i < 20 { BLACK } else { WHITE }, 2.0));
        even_out(&mut stroke);
        assert!(steepest(&stroke) < 80, "{}", steepest(&stroke));
        let ends = [0, 39].map(|i| stroke.points[i].color);
        assert_eq!(ends, [Some(BLACK), Some(WHITE)]);
    }

    proptest! {
        /// What is even stays, bit for bit, and means lie between what there was.
        #[test]
        fn means_lie_within(
            closed: bool, paints in prop::collection::vec((any::<[u8; 4]>(), 0.0..9.0_f64), 3..40),
        ) {
            let mut even = painted(closed, paints.len(), |_| paints[0]);
            let before = even.clone();
            even_out(&mut even);
            prop_assert_eq!(even, before);
            let mut stroke = painted(closed, paints.len(), |i| paints[i]);
            even_out(&mut stroke);
            let widths = || paints.iter().map(|(_, width)| *width);
            let (least, most) = (widths().fold(f64::MAX, f64::min), widths().fold(0.0, f64::max));
            for point in &stroke.points {
                prop_assert!(point.width >= least - 1e-9 && point.width <= most + 1e-9);
            }
        }
    }

    #[test]
    fn a_ring_is_as_even_over_its_seam() {
        let mut stroke = painted(true, 100, |i| (BLACK, 1.0 + 0.03 * i as f64));
        limit_slope(&mut stroke);
        let [last, first] = [99, 0].map(|i| &stroke.points[i]);
        let most = 0.12 * distance(last.position, first.position);
        assert!((last.width - first.width).abs() <= most + 1e-9);
    }

    #[test]
    fn a_swell_on_a_short_facet_opens_and_closes_as_a_pen_does() {
        // Thin for 180 pixels, thick for 15, thin again.
        let thick = 60..65;
        let mut stroke = painted(false, 140, |i| {
            (BLACK, if thick.contains(&i) { 5.5 } else { 2.0 })
        });
        limit_slope(&mut stroke);
        let width = |i: usize| stroke.points[i].width;
        for pair in stroke.points.windows(2) {
            assert!((pair[1].width - pair[0].width).abs() <= 3.0 * 0.12 + 1e-9);
        }
        assert!((3.5..5.0).contains(&width(62)), "{}", width(62));
        assert_eq!([width(20), width(120)], [2.0; 2]);
    }

    proptest! {
        #[test]
        fn widths_change_no_faster_than_a_pen_opens(
            seed in any::<u64>(), closed in any::<bool>(), count in 3_usize..60,
        ) {
            let mut random = npr_mesh::testing::Random::new(seed);
            let widths: Vec<f64> = (0..count).map(|_| f64::from(random.unit()) * 6.0).collect();
            let mut stroke = painted(closed, count, |i| (BLACK, widths[i]));
            let before = stroke.clone();
            limit_slope(&mut stroke);
            let around = stroke.points.iter().zip(stroke.points.iter().cycle().skip(1));
            for (from, to) in around.take(if closed { count } else { count - 1 }) {
                let most = 0.12 * distance(from.position, to.position);
                prop_assert!((to.width - from.width).abs() <= most + 1e-9);
            }
            let (least, most) = widths.iter().fold((9.0_f64, 0.0_f64), |(a, b), w| (a.min(*w), b.max(*w)));
            prop_assert!(stroke.points.iter().all(|p| p.width >= least - 1e-9 && p.width <= most + 1e-9));
            // What is slow enough stays as it is.
            let mut again = stroke.clone();
            limit_slope(&mut again);
            for (a, b) in again.points.iter().zip(&stroke.points) {
                prop_assert!((a.width - b.width).abs() < 1e-9);
            }
            prop_assert_eq!(stroke.points.len(), before.points.len());
        }

        /// Whether it is one stroke or several that go on as each other, however they run and whatever their order.
        #[test]
        fn a_line_in_pieces_has_the_widths_of_the_whole(
            seed in any::<u64>(), closed in any::<bool>(), count in 12_usize..80, cuts in 1_usize..6,
        ) {
            // Limit the whole.
            let mut random = npr_mesh::testing::Random::new(seed);
            let widths: Vec<f64> = (0..count).map(|_| f64::from(random.unit()) * 6.0).collect();
            let mut whole = painted(closed, count, |i| (BLACK, widths[i]));
            let given = whole.clone();
            limit_slope(&mut whole);

            // Cut it: pieces share the points between them.
            let mut at: Vec<usize> = (0..cuts).map(|_| 1 + random.below(count - 2)).collect();
            at.sort_unstable();
            at.dedup();
            let bounds: Vec<usize> = match closed {
                true => at.iter().copied().chain([at[0] + count]).collect(),
                false => [0].into_iter().chain(at.iter().copied()).chain([count - 1]).collect(),
            };
            let pieces: Vec<Vec<usize>> = bounds
                .windows(2)
                .map(|pair| (pair[0]..=pair[1]).map(|i| i % count).collect())
                .collect();

            // Shuffle them, and turn some round.
            let mut order: Vec<usize> = (0..pieces.len()).collect();
            for i in (1..order.len()).rev() {
                order.swap(i, random.below(i + 1));
            }
            let turned: Vec<bool> = order.iter().map(|_| random.below(2) == 1).collect();
            let points_of = |number: usize| -> Vec<usize> {
                let points = pieces[order[number]].iter().copied();
                if turned[number] { points.rev().collect() } else { points.collect() }
            };
            let mut strokes: Vec<Stroke> = (0..order.len())
                .map(|number| Stroke {
                    closed: false,
                    points: points_of(number).into_iter().map(|i| given.points[i]).collect(),
                    ..given.clone()
                })
                .collect();

            // Tell which end goes on as which.
            let place = |piece: usize| order.iter().position(|other| *other == piece).unwrap();
            let end = |piece: usize, is_last: bool| 2 * place(piece) + usize::from(is_last != turned[place(piece)]);
            let mut mates = vec![usize::MAX; 2 * pieces.len()];
            let seams = if closed { pieces.len() } else { pieces.len() - 1 };
            if pieces.len() > 1 {
                for piece in 0..seams {
                    let [a, b] = [end(piece, true), end((piece + 1) % pieces.len(), false)];
                    (mates[a], mates[b]) = (b, a);
                }
                limit_slopes(&mut strokes, &mates, |_| true);
                for (number, stroke) in strokes.iter().enumerate() {
                    for (point, i) in stroke.points.iter().zip(points_of(number)) {
                        let wanted = whole.points[i].width;
                        prop_assert!((point.width - wanted).abs() < 1e-9, "{} for {wanted}", point.width);
                    }
                }
            }
        }

        #[test]
        fn blades_keep_their_widths_and_end_a_line(seed in any::<u64>(), count in 3_usize..40) {
            let mut random = npr_mesh::testing::Random::new(seed);
            let widths: Vec<f64> = (0..count).map(|_| f64::from(random.unit()) * 6.0).collect();
            let one = painted(false, count, |i| (BLACK, widths[i]));
            let mut alone = one.clone();
            limit_slope(&mut alone);
            let mut both = [one.clone(), one.clone()];
            limit_slopes(&mut both, &[usize::MAX, 2, 1, usize::MAX], |stroke| stroke == 0);
            prop_assert_eq!(both, [alone, one]);
        }

        #[test]
        fn mirrored_strokes_have_mirrored_widths(seed in any::<u64>(), count in 3_usize..60) {
            let mut random = npr_mesh::testing::Random::new(seed);
            let widths: Vec<f64> = (0..count).map(|_| f64::from(random.unit()) * 6.0).collect();
            let mut there = painted(false, count, |i| (BLACK, widths[i]));
            let mut back = painted(false, count, |i| (BLACK, widths[count - 1 - i]));
            limit_slope(&mut there);
            limit_slope(&mut back);
            for (a, b) in there.points.iter().zip(back.points.iter().rev()) {
                prop_assert!((a.width - b.width).abs() < 1e-9);
            }
        }
    }
}
