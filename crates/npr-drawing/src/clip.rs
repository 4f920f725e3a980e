//! Strokes and rings cut to the picture, so that no file holds anything far outside of it.

use crate::color_runs::point_between;
use npr_vector::stroke::{Stroke, StrokePoint};

/// The parts of a stroke within `pad` of the picture, each with whether it is closed.
///
/// Points that are not finite are left out first. A closed stroke that leaves the picture becomes open parts.
pub(crate) fn clip_stroke(
    stroke: &Stroke,
    size: [f64; 2],
    pad: f64,
) -> Vec<(Vec<StrokePoint>, bool)> {
    // Leave a stroke alone that lies within.
    let finite = |p: &&StrokePoint| p.position.iter().all(|v| v.is_finite());
    let mut points: Vec<StrokePoint> = stroke.points.iter().filter(finite).copied().collect();
    let (low, high) = ([-pad; 2], size.map(|side| side + pad));
    let inside = |p: &StrokePoint| (0..2).all(|i| (low[i]..=high[i]).contains(&p.position[i]));
    let Some(outside) = points.iter().position(|p| !inside(p)) else {
        return if points.len() < 2 {
            Vec::new()
        } else {
            vec![(points, stroke.closed)]
        };
    };

    // Start a closed one outside, so that no part runs over its start.
    if stroke.closed {
        points.rotate_left(outside);
        points.push(points[0]);
    }

    // Cut it segment by segment, and join those that meet within.
    let mut parts: Vec<(Vec<StrokePoint>, bool)> = Vec::new();
    let mut open = false;
    for pair in points.windows(2) {
        let Some([from, to]) = clip_segment(&pair[0], &pair[1], low, high) else {
            open = false;
            continue;
        };
        match parts.last_mut().filter(|_| open) {
            Some((part, _)) => part.push(to),
            None => parts.push((vec![from, to], false)),
        }
        open = to == pair[1];
    }
    parts
}

/// The part of a segment in a box [Liang, Barsky 1984].
fn clip_segment(
    a: &StrokePoint,
    b: &StrokePoint,
    low: [f64; 2],
    high: [f64; 2],
) -> Option<[StrokePoint; 2]> {
    // Cut the segment between both bounds of each axis.
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for i in 0..2 {
        let (from, step) = (a.position[i], b.position[i] - a.position[i]);
        if step == 0.0 {
            if from < low[i] || from > high[i] {
                return None;
            }
            continue;
        }
        let (s, t) = ((low[i] - from) / step, (high[i] - from) / step);
        enter = enter.max(s.min(t));
        leave = leave.min(s.max(t));
    }

    // Keep what is left.
    (enter <= leave).then(|| {
        [
            between(a, b, enter, low, high),
            between(a, b, leave, low, high),
        ]
    })
}

/// The point at share `t` of a segment, kept in the box against rounding: far from it, either end may be meant.
fn between(a: &StrokePoint, b: &StrokePoint, t: f64, low: [f64; 2], high: [f64; 2]) -> StrokePoint {
    let mut point = match t {
        0.0 => *a,
        1.0 => *b,
        _ => point_between(a, b, t),
    };
    for (i, v) in point.position.iter_mut().enumerate() {
        *v = v.clamp(low[i], high[i]);
    }
    point
}

/// The part of a ring in the picture [Sutherland, Hodgman 1974]; empty if there is none.
///
/// A ring that leaves and comes back runs along the border in between, which even-odd filling does not show.
pub(crate) fn clip_ring(ring: &[[f64; 2]], size: [f64; 2]) -> Vec<[f64; 2]> {
    let mut ring: Vec<[f64; 2]> = ring
        .iter()
        .filter(|p| p.iter().all(|v| v.is_finite()))
        .copied()
        .collect();
    for (axis, side) in size.into_iter().enumerate() {
        ring = clip_half(&ring, axis, 0.0, 1.0);
        ring = clip_half(&ring, axis, side, -1.0);
    }
    ring.dedup();
    if ring.len() < 3 { Vec::new() } else { ring }
}

/// The part of a ring on one side of `limit` along an axis; the greater side where `sign` is 1.
fn clip_half(ring: &[[f64; 2]], axis: usize, limit: f64, sign: f64) -> Vec<[f64; 2]> {
    let inside = |p: &[f64; 2]| sign * (p[axis] - limit) >= 0.0;
    let mut kept = Vec::with_capacity(ring.len());
    for (i, b) in ring.iter().enumerate() {
        let a = &ring[(i + ring.len() - 1) % ring.len()];
        if inside(a) != inside(b) {
            let t = (limit - a[axis]) / (b[axis] - a[axis]);
            let other = 1 - axis;
            let mut crossing = [limit; 2];
            crossing[other] = a[other] * (1.0 - t) + b[other] * t;
            kept.push(crossing);
        }
        if inside(b) {
            kept.push(*b);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::Kind;
    use proptest::prelude::*;

    const SIZE: [f64; 2] = [30.0, 20.0];

    fn stroke(points: &[[f64; 2]], closed: bool) -> Stroke {
        Stroke {
            id: 0,
            kind: Kind::Contour,
            occluders: 0,
            surface: 0,
            closed,
            part: None,
            points: points
                .iter()
                .map(|p| StrokePoint {
                    position: *p,
                    ..StrokePoint::default()
                })
                .collect(),
        }
    }

    /// Length of the part of a line inside the picture, by walking it in small steps, and how far it may be off: of
    /// every segment half a step at each of the two places where it crosses the border.
    fn length_inside(points: &[[f64; 2]], closed: bool) -> [f64; 2] {
        const STEPS: usize = 4000;
        let pieces = if closed {
            points.len()
        } else {
            points.len() - 1
        };
        (0..pieces)
            .map(|i| {
                let (a, b) = (points[i], points[(i + 1) % points.len()]);
                let length = ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt();
                let inside = (0..STEPS).filter(|k| {
                    let t = (*k as f64 + 0.5) / STEPS as f64;
                    (0..2).all(|i| (0.0..=SIZE[i]).contains(&(a[i] + (b[i] - a[i]) * t)))
                });
                let step = length / STEPS as f64;
                [step * inside.count() as f64, step]
            })
            .fold([0.0; 2], |[length, off], [more, step]| {
                [length + more, off + step]
            })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn what_lies_inside_stays_and_nothing_else(
            points in prop::collection::vec([-30.0..60.0f64, -30.0..50.0f64], 2..8), closed: bool,
        ) {
            let parts = clip_stroke(&stroke(&points, closed), SIZE, 0.0);
            let mut kept = 0.0;
            for (part, closed) in &parts {
                prop_assert!(part.len() >= 2);
                prop_assert!(part.iter().all(|p| (0..2).all(|i| (0.0..=SIZE[i]).contains(&p.position[i]))));
                let copy = stroke(&part.iter().map(|p| p.position).collect::<Vec<_>>(), *closed);
                kept += copy.length();
            }
            let [length, off] = length_inside(&points, closed);
            prop_assert!((kept - length).abs() <= off + 1e-9, "{kept} is not {length}");
        }

        #[test]
        fn rings_keep_what_lies_inside(
            ring in prop::collection::vec([-30.0..60.0f64, -30.0..50.0f64], 3..8), x in 0.1..29.9f64, y in 0.1..19.9f64,
        ) {
            let inside = |ring: &[[f64; 2]]| {
                (0..ring.len()).filter(|i| {
                    let (a, b) = (ring[*i], ring[(i + 1) % ring.len()]);
                    (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
                }).count() % 2 == 1
            };
            let cut = clip_ring(&ring, SIZE);
            prop_assert_eq!(inside(&ring), inside(&cut));
            prop_assert!(cut.iter().all(|p| (0..2).all(|i| (-1e-9..=SIZE[i] + 1e-9).contains(&p[i]))));
        }
    }

    /// Lines along a side of the picture cross none of the two borders beside them.
    #[test]
    fn upright_and_level_lines_are_kept_inside_alone() {
        for (x, kept) in [(-1.0, 0), (15.0, 1), (31.0, 0)] {
            let parts = clip_stroke(&stroke(&[[x, -5.0], [x, 25.0]], false), SIZE, 0.0);
            assert_eq!(parts.len(), kept, "upright at {x}");
        }
        for (y, kept) in [(-1.0, 0), (10.0, 1), (21.0, 0)] {
            let parts = clip_stroke(&stroke(&[[-5.0, y], [35.0, y]], false), SIZE, 0.0);
            assert_eq!(parts.len(), kept, "level at {y}");
        }
    }

    #[test]
    fn a_closed_line_inside_stays_closed() {
        let parts = clip_stroke(
            &stroke(&[[1.0, 1.0], [9.0, 1.0], [5.0, 8.0]], true),
            SIZE,
            0.0,
        );
        assert!(parts.len() == 1 && parts[0].1);
    }
}
