//! Lines that lie side by side, drawn thinner so that paper stays between them.
//!
//! A pen that draws a spring or a railing is held lighter than one that draws an outline: lines as wide as the way
//! between them would run into one black patch.

use crate::ends::Cells;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::Stroke;
use rayon::prelude::*;

/// Least pixels between samples of a stroke.
const SAMPLE_PX: f64 = 2.0;

/// Width of a cell, in pixels.
const CELL_PX: f64 = 12.0;

/// Widest line that is looked for from its neighbours, in pixels.
const WIDEST_PX: f64 = 24.0;

/// Greatest distance at which neighbours are looked for, in pixels.
const FARTHEST_PX: f64 = 4.0 * WIDEST_PX;

/// Least share of its width that a line keeps.
const LEAST: f64 = 0.3;

/// Cosine of the largest angle between two lines that lie side by side.
const ALONGSIDE_COS: f64 = 0.8;

/// Pixels to either side over which widths are averaged along a stroke.
const MEAN_PX: f64 = 14.0;

/// Half widths between two middles under which two lines are one to the eye, and from which they are two.
const ONE: f64 = 0.25;
const TWO: f64 = 0.6;

/// A place of a stroke that others keep away from.
#[derive(Debug, Clone, Copy)]
struct Sample {
    stroke: u32,
    /// Pixels along the stroke.
    way: f64,
    at: [f64; 2],
    /// Unit direction of the stroke.
    along: [f64; 2],
    width: f64,
}

/// Thins the visible strokes for which `is_drawn` is true where others run beside them, so that the ink of two takes no
/// more than `share` of the way between their middles, 0..1; 0 leaves all as it is.
///
/// A line keeps at least 0.3 of its width, and where two lie nearer than a quarter of a width apart, which is one line
/// to the eye, both keep theirs. Widths change along strokes within some 14 pixels, so nothing jumps. Strokes count at
/// their points, so long pieces without any are not seen. O(points), on all threads, with the same result for any
/// number of them.
pub fn leave_room(strokes: &mut [Stroke], share: f64, is_drawn: impl Fn(&Stroke) -> bool + Sync) {
    if share.is_nan() || share <= 0.0 {
        return;
    }

    // Sample all lines, and sort the samples into cells.
    let numbered = strokes.par_iter().enumerate();
    let samples: Vec<Vec<Sample>> = numbered
        .map(
            |(number, stroke)| match stroke.is_visible() && is_drawn(stroke) {
                true => samples_of(stroke, number as u32),
                false => Vec::new(),
            },
        )
        .collect();
    let all = || samples.iter().flatten();
    let cells = Cells::new(CELL_PX, all().map(|sample| (sample.at, *sample)));
    let widest = all().map(|sample| sample.width.min(WIDEST_PX));
    let widest = widest.fold(0.0, f64::max);

    // Thin each where another is near.
    let lengths: Vec<f64> = strokes.par_iter().map(Stroke::length).collect();
    let all = strokes.par_iter_mut().zip(&samples).zip(&lengths);
    all.for_each(|((stroke, samples), length)| {
        let ring = stroke.closed.then_some(*length);
        let left = |sample: &Sample| {
            let reach = (sample.width + widest) / (2.0 * share);
            let mut least: f64 = 1.0;
            cells.near(sample.at, sample.at, reach.min(FARTHEST_PX), |other| {
                if let Some((away, width)) = beside(sample, other, ring) {
                    least = least.min(left_of(away, [sample.width, width], share));
                }
            });
            least
        };
        let left: Vec<[f64; 2]> = samples.iter().map(|of| [of.way, left(of)]).collect();
        if left.iter().any(|[_, left]| *left < 1.0) {
            thin(stroke, &evened(&left));
        }
    });
}

/// The places of a stroke, at least so far apart.
fn samples_of(stroke: &Stroke, number: u32) -> Vec<Sample> {
    let points = &stroke.points;
    let (mut way, mut last) = (0.0, f64::MIN);
    let mut samples = Vec::new();
    for (i, point) in points.iter().enumerate() {
        if i > 0 {
            way += distance(points[i - 1].position, point.position);
        }
        if way - last < SAMPLE_PX || !way.is_finite() {
            continue;
        }
        let [before, after] = [i.saturating_sub(1), (i + 1).min(points.len() - 1)];
        let [a, b] = [before, after].map(|i| points[i].position);
        let length = distance(a, b);
        if length > 0.0 && point.width > 0.0 {
            samples.push(Sample {
                stroke: number,
                way,
                at: point.position,
                along: [0, 1].map(|k| (b[k] - a[k]) / length),
                width: point.width,
            });
            last = way;
        }
    }
    samples
}

/// How far away, and how wide, a line is that runs beside a place; none that crosses or that is the same stretch of the
/// same stroke, whose length is `ring` where it is closed.
fn beside(sample: &Sample, other: &Sample, ring: Option<f64>) -> Option<(f64, f64)> {
    let off = [0, 1].map(|k| other.at[k] - sample.at[k]);
    let away = off[0].hypot(off[1]);
    if sample.stroke == other.stroke {
        let apart = (sample.way - other.way).abs();
        let apart = ring.map_or(apart, |length| apart.min(length - apart));
        if apart < 4.0 * sample.width.max(away) {
            return None;
        }
    }
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let is_alongside = dot(sample.along, other.along).abs() > ALONGSIDE_COS;
    let is_beside = dot(sample.along, off).abs() <= SAMPLE_PX;
    let to_the_side = dot([-sample.along[1], sample.along[0]], off).abs();
    (is_alongside && is_beside).then_some((to_the_side, other.width))
}

/// Share of its width that a line keeps whose neighbour's middle is so far away.
fn left_of(away: f64, widths: [f64; 2], share: f64) -> f64 {
    let half = 0.5 * (widths[0] + widths[1]);
    let kept = (share * away / half).clamp(LEAST, 1.0);
    let two = ((away / half - ONE) / (TWO - ONE)).clamp(0.0, 1.0);
    1.0 - two * (1.0 - kept)
}

/// Shares at ways, averaged along the stroke.
fn evened(left: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let (mut from, mut to) = (0, 0);
    let mut sum = 0.0;
    left.iter()
        .map(|[way, _]| {
            while to < left.len() && left[to][0] <= way + MEAN_PX {
                sum += left[to][1];
                to += 1;
            }
            while left[from][0] < way - MEAN_PX {
                sum -= left[from][1];
                from += 1;
            }
            [*way, sum / (to - from) as f64]
        })
        .collect()
}

/// Scales the widths of a stroke by shares at ways along it, which rise.
fn thin(stroke: &mut Stroke, left: &[[f64; 2]]) {
    let (mut way, mut before) = (0.0, None);
    let mut next = 0;
    for point in &mut stroke.points {
        way += before.map_or(0.0, |before| distance(before, point.position));
        before = Some(point.position);
        while next + 1 < left.len() && left[next + 1][0] <= way {
            next += 1;
        }
        let [at, share] = left[next];
        let share = match left.get(next + 1) {
            Some([end, other]) if way > at => share + (other - share) * (way - at) / (end - at),
            _ => share,
        };
        point.width *= share.clamp(LEAST, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_strokes::stroke_of;
    use proptest::prelude::*;

    /// A level line of a width, with a point every 1.5 pixels.
    fn level(y: f64, width: f64) -> Stroke {
        let points: Vec<[f64; 2]> = (0..80).map(|i| [1.5 * f64::from(i), y]).collect();
        let mut stroke = stroke_of(&points);
        stroke
            .points
            .iter_mut()
            .for_each(|point| point.width = width);
        stroke
    }

    fn middle(stroke: &Stroke) -> f64 {
        stroke.points[40].width
    }

    #[test]
    fn the_ink_of_a_spring_leaves_paper_between_its_rings() {
        for away in [3.7, 4.5, 6.0] {
            let mut rings: Vec<Stroke> = (0..9).map(|i| level(away * f64::from(i), 5.0)).collect();
            leave_room(&mut rings, 0.6, |_| true);
            for ring in &rings {
                assert!(
                    middle(ring) <= 0.6 * away + 0.8,
                    "{} of {away}",
                    middle(ring)
                );
                assert!(middle(ring) >= 0.3 * 5.0);
            }
        }
    }

    #[test]
    fn lines_with_room_lines_that_cross_and_doubles_keep_their_width() {
        let far = vec![level(0.0, 4.0), level(9.0, 4.0)];
        let double = vec![level(0.0, 4.0), level(1.0, 4.0)];
        let mut across = level(40.0, 4.0);
        for point in &mut across.points {
            point.position.reverse();
        }
        let crossing = vec![level(30.0, 4.0), across];
        for before in [far, double, crossing] {
            let mut after = before.clone();
            leave_room(&mut after, 0.6, |_| true);
            assert!(after == before, "{:?}", after[0].points[40]);
        }
        let mut off = vec![level(0.0, 4.0), level(4.0, 4.0)];
        let before = off.clone();
        leave_room(&mut off, 0.0, |_| true);
        assert_eq!(off, before);
        leave_room(&mut off, 0.6, |_| false);
        assert_eq!(off, before);
    }

    proptest! {
        /// Widths only shrink, no further than they may, and never by more than a little from point to point.
        #[test]
        fn widths_shrink_evenly(
            lines in prop::collection::vec((0.0..60.0_f64, 0.5..9.0_f64), 2..9), share in 0.05..1.0_f64,
        ) {
            let before: Vec<Stroke> = lines.iter().map(|(y, width)| level(*y, *width)).collect();
            let mut after = before.clone();
            leave_room(&mut after, share, |_| true);
            for (old, new) in before.iter().zip(&after) {
                let shares = old.points.iter().zip(&new.points).map(|(a, b)| b.width / a.width);
                let shares: Vec<f64> = shares.collect();
                prop_assert!(shares.iter().all(|share| (LEAST - 1e-9..=1.0).contains(share)));
                prop_assert!(shares.windows(2).all(|pair| (pair[0] - pair[1]).abs() < 0.2));
            }
        }

        /// Nothing hostile stops it.
        #[test]
        fn any_numbers_are_taken(
            places in prop::collection::vec(prop::array::uniform2(any::<f64>()), 1..12), width: f64, share: f64,
        ) {
            let mut stroke = stroke_of(&places);
            stroke.points.iter_mut().for_each(|point| point.width = width);
            leave_room(&mut [stroke.clone(), stroke], share, |_| true);
        }
    }
}
