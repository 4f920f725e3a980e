//! Corners of drawn lines.

use super::calm::{Calm, beside, parabola};
use glam::DVec2;

/// Lengths of the sides beside a corner that are tried, in pixels.
const SIDES: [usize; 3] = [6, 9, 14];

/// Share of a gentle bend's squared distances that a corner's may have. Pixels are off by 0.29 in the mean: a right
/// angle with sides of 9 pixels has a third, one of 45 degrees with sides of 14 too, and an arc more than 1.
const SHARPER: f64 = 0.5;

/// A corner of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Index of the place at it.
    pub at: usize,
    /// Where its sides meet.
    pub place: DVec2,
    /// Places on either side that the ink of the corner has moved.
    pub gap: usize,
}

/// Corners of a line, in order: where two straight sides meet at an angle of `turn` radians or more.
///
/// Straight means: places within the tolerance of `how` of their mean line. Sides begin `gap` of the place away, since
/// lines thinned from wide ones cut their corners. The sharpest of near corners is taken. O(places).
pub fn corners(
    places: &[DVec2],
    gap: impl Fn(usize) -> usize,
    turn: f64,
    how: &Calm,
) -> Vec<Corner> {
    let count = places.len();
    let limit = f64::from(npr_core::math::cos(turn as f32));
    let mut found: Vec<(f64, usize, Corner)> = Vec::new();
    for at in 0..count {
        let gap = gap(at);
        let sharpest = SIDES
            .iter()
            .filter_map(|side| Some((corner(places, at, gap, *side, how)?, *side)))
            .filter(|((cosine, _), _)| *cosine < limit)
            .min_by(|a, b| a.0.0.total_cmp(&b.0.0));
        if let Some(((cosine, place), side)) = sharpest {
            found.push((cosine, gap + side, Corner { at, place, gap }));
        }
    }
    // Of two corners that share a side, the sharper one stays.
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|a, b| found[*a].0.total_cmp(&found[*b].0).then(a.cmp(b)));
    let mut taken: Vec<(usize, Corner)> = Vec::new();
    for index in order {
        let (_, reach, corner) = found[index];
        let is_near = |other: &(usize, Corner)| {
            let apart = other.1.at.abs_diff(corner.at);
            let apart = if how.closed {
                apart.min(count - apart)
            } else {
                apart
            };
            apart < reach.min(other.0)
        };
        if !taken.iter().rev().any(is_near) {
            taken.push((reach, corner));
        }
    }
    let mut corners: Vec<Corner> = taken.into_iter().map(|(_, corner)| corner).collect();
    corners.sort_by_key(|corner| corner.at);
    corners
}

/// Cosine of the turn at a place, and where the sides beside it meet, if both are straight and together are not.
fn corner(
    places: &[DVec2],
    at: usize,
    gap: usize,
    side: usize,
    how: &Calm,
) -> Option<(f64, DVec2)> {
    // Corners need a side before and after.
    let count = places.len();
    let reach = gap + side;
    if count < 2 * reach + 1 {
        return None;
    }
    if !how.closed && (at < reach || at + reach >= count) {
        return None;
    }

    // Lay a line through each side, beyond the gap that thinning has moved.
    let run = |from: usize, to: usize| -> Vec<DVec2> {
        (from..=to)
            .map(|k| places[(at + count - reach + k) % count])
            .collect()
    };
    let before = mean_line(&run(0, side), how.tolerance)?;
    let after = mean_line(&run(reach + gap, 2 * reach), how.tolerance)?;
    let cosine = before[1].dot(after[1]);
    if !is_sharper(&run(0, 2 * reach), gap, [before, after]) {
        return None;
    }

    // Put the corner where both sides meet, unless that is far off.
    let middle = places[at % count];
    let area = before[1].perp_dot(after[1]);
    let meet = before[0] + before[1] * ((after[0] - before[0]).perp_dot(after[1]) / area);
    let near = 1.5 + 1.5 * gap as f64;
    let place = if meet.distance(middle) <= near {
        meet
    } else {
        middle
    };
    Some((cosine, place))
}

/// Whether two lines come much nearer to places, but for those around the middle, than a gentle bend does.
fn is_sharper(places: &[DVec2], gap: usize, lines: [[DVec2; 2]; 2]) -> bool {
    let reach = places.len() / 2;
    let sides = || {
        let outer = places
            .iter()
            .enumerate()
            .filter(|(k, _)| k.abs_diff(reach) >= gap);
        outer.map(|(k, place)| ((k as f64 - reach as f64) / reach as f64, *place))
    };
    let bend = parabola(places[reach], sides().map(|(t, place)| (t, place, 1.0)));
    let squares = |distance: &dyn Fn(f64, DVec2) -> f64| -> f64 {
        sides().map(|(t, place)| distance(t, place).powi(2)).sum()
    };
    let of_bend = squares(&|t, place| beside(&bend, t, place));
    let of_lines = squares(&|t, place| {
        let [middle, along] = lines[usize::from(t > 0.0)];
        (place - middle).perp_dot(along).abs()
    });
    of_lines < SHARPER * of_bend
}

/// The middle and direction of places, if all lie beside that line by no more than a tolerance.
fn mean_line(places: &[DVec2], tolerance: f64) -> Option<[DVec2; 2]> {
    let count = places.len() as f64;
    let middle = places.iter().sum::<DVec2>() / count;
    let half = (count - 1.0) / 2.0;
    let slope: DVec2 = places
        .iter()
        .enumerate()
        .map(|(k, place)| (*place - middle) * (k as f64 - half))
        .sum();
    let along = slope.try_normalize()?;
    let is_straight = places
        .iter()
        .all(|place| (*place - middle).perp_dot(along).abs() <= tolerance);
    is_straight.then_some([middle, along])
}
