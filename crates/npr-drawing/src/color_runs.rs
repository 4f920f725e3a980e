//! Cuts strokes that change colour into pieces of one colour each, as files know no other.
//!
//! Pieces share their joints. Opaque ones overlap there by their round ends, so no gap shows at any size; of
//! translucent ones overlaps would show as beads, so they are strips that end square in each other's edge.

use crate::outline::outline;
use color::{Oklab, OpaqueColor, Srgb};
use kurbo::{BezPath, Point, Vec2};
use npr_vector::stroke::StrokePoint;

/// Difference between neighbouring pieces, as a distance in OKLab or of opacity: it can hardly be seen side by side.
const STEP: f64 = 0.02;

/// Most pieces between two points.
const PIECES_MAX: f64 = 64.0;

/// Pieces into which the round end of a strip is broken.
const CAP: u32 = 8;

/// A colour in OKLab, with opacity last.
fn lab([r, g, b, a]: [u8; 4]) -> [f64; 4] {
    let srgb = OpaqueColor::<Srgb>::new([r, g, b].map(|byte| f32::from(byte) / 255.0));
    let [l, x, y] = srgb.convert::<Oklab>().components.map(f64::from);
    [l, x, y, f64::from(a) / 255.0]
}

/// The difference between two colours: their distance in OKLab, or that of their opacities if it is greater.
fn difference(a: [u8; 4], b: [u8; 4]) -> f64 {
    if a == b {
        return 0.0;
    }
    let (a, b) = (lab(a), lab(b));
    let [l, x, y] = [0, 1, 2].map(|i| a[i] - b[i]);
    (l * l + x * x + y * y).sqrt().max((a[3] - b[3]).abs())
}

/// The colour a share of the way from one to another, mixed in OKLab; if only one is given, that one.
pub(crate) fn between(a: Option<[u8; 4]>, b: Option<[u8; 4]>, t: f64) -> Option<[u8; 4]> {
    let (Some(from), Some(to)) = (a, b) else {
        return a.or(b);
    };
    if from == to {
        return a;
    }
    let (low, high) = (lab(from), lab(to));
    let mix = |i: usize| (low[i] + (high[i] - low[i]) * t) as f32;
    let mixed = OpaqueColor::<Oklab>::new([mix(0), mix(1), mix(2)]).convert::<Srgb>();
    let byte = |v: f32| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    let [r, g, b] = mixed.components.map(byte);
    Some([r, g, b, byte(mix(3))])
}

/// The mean colour of points that have one, each with its own weight; `None` if none has.
pub(crate) fn mean(points: &[StrokePoint]) -> Option<[u8; 4]> {
    let mut sum = [0.0; 4];
    let mut count = 0.0;
    for color in points.iter().filter_map(|point| point.color) {
        count += 1.0;
        sum = std::array::from_fn(|i| sum[i] + f64::from(color[i]));
    }
    (count > 0.0).then(|| sum.map(|sum| (sum / count + 0.5) as u8))
}

/// A part of a stroke in one colour.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Piece {
    pub points: Vec<StrokePoint>,
    pub closed: bool,
    pub color: [u8; 4],
    /// Whether another piece continues it at its start and at its end.
    pub goes_on: [bool; 2],
    /// Points just before its start and after its end, where other pieces continue it.
    beyond: [Option<[f64; 2]>; 2],
}

/// The pieces of a stroke, in order; each begins at the last point of the one before. `other` is the colour of points
/// without one. O(points + pieces).
pub(crate) fn pieces(points: &[StrokePoint], closed: bool, other: [u8; 4]) -> Vec<Piece> {
    let color_of = |point: &StrokePoint| point.color.unwrap_or(other);
    let whole = |color| Piece {
        points: points.to_vec(),
        closed,
        color,
        goes_on: [false; 2],
        beyond: [None; 2],
    };

    // A stroke of one colour is one piece.
    let Some(first) = points.first().map(color_of) else {
        return Vec::new();
    };
    if points.iter().all(|point| color_of(point) == first) {
        return vec![whole(first)];
    }

    // Begin a piece wherever the colour has gone a step from where the last began.
    let chain = refined(points, closed, other);
    let middle = |i: usize| {
        let [a, b] = [&chain[i], &chain[i + 1]].map(color_of);
        between(Some(a), Some(b), 0.5).unwrap_or(a)
    };
    let last = chain.len() - 1;
    let mut starts = vec![0];
    let mut begun = middle(0);
    for i in 1..last {
        let color = middle(i);
        if difference(begun, color) > STEP {
            starts.push(i);
            begun = color;
        }
    }
    if starts.len() == 1 {
        return vec![whole(middle(last / 2))];
    }
    starts.push(last);

    // Let each piece know where the line comes from and goes on to, for its joints.
    let place = |i: usize| chain[i].position;
    let piece = |pair: &[usize]| {
        let (from, to) = (pair[0], pair[1]);
        let before = if from > 0 {
            Some(place(from - 1))
        } else {
            closed.then(|| place(last - 1))
        };
        let after = if to < last {
            Some(place(to + 1))
        } else {
            closed.then(|| place(1))
        };
        Piece {
            points: chain[from..=to].to_vec(),
            closed: false,
            color: middle((from + to - 1) / 2),
            goes_on: [before.is_some(), after.is_some()],
            beyond: [before, after],
        }
    };
    starts.windows(2).map(piece).collect()
}

/// The points, and more between those whose colours differ; a closed stroke ends with its first point.
fn refined(points: &[StrokePoint], closed: bool, other: [u8; 4]) -> Vec<StrokePoint> {
    let own = |point: &StrokePoint| StrokePoint {
        color: Some(point.color.unwrap_or(other)),
        ..*point
    };
    let mut chain: Vec<StrokePoint> = Vec::with_capacity(points.len() + 1);
    let back = points.first().filter(|_| closed);
    for point in points.iter().chain(back).map(own) {
        if let Some(last) = chain.last().copied() {
            let [from, to] = [last, point].map(|p| p.color.unwrap_or(other));
            let count = (difference(from, to) / STEP).ceil().clamp(1.0, PIECES_MAX);
            let steps = 1..count as u32;
            chain.extend(steps.map(|i| point_between(&last, &point, f64::from(i) / count)));
        }
        chain.push(point);
    }
    chain
}

/// The point a share of the way from one to another. What both have in common stays as it is, to the bit.
pub(crate) fn point_between(a: &StrokePoint, b: &StrokePoint, t: f64) -> StrokePoint {
    let mix = |a: f64, b: f64| if a == b { a } else { a * (1.0 - t) + b * t };
    StrokePoint {
        position: std::array::from_fn(|i| mix(a.position[i], b.position[i])),
        depth: mix(a.depth, b.depth),
        width: mix(a.width, b.width),
        u: mix(a.u, b.u),
        world: std::array::from_fn(|i| mix(a.world[i].into(), b.world[i].into()) as f32),
        location: a.location,
        color: between(a.color, b.color, t),
    }
}

impl Piece {
    /// The shape of its ink, for the nonzero rule, within `tolerance` pixels; `translucent` says how it meets its
    /// neighbours.
    pub fn outline(&self, tolerance: f64, translucent: bool) -> BezPath {
        if translucent && self.goes_on != [false; 2] {
            self.strip()
        } else {
            outline(&self.points, self.closed, tolerance)
        }
    }

    /// A strip along its points: square at ends that other pieces continue, round at others.
    fn strip(&self) -> BezPath {
        // Take the points that differ.
        let at = |p: [f64; 2]| Point::new(p[0], p[1]);
        let mut spine: Vec<(Point, f64)> = Vec::with_capacity(self.points.len());
        for point in &self.points {
            let place = at(point.position);
            if spine.last().is_none_or(|last| last.0 != place) {
                spine.push((place, 0.5 * point.width.clamp(0.0, 1e5)));
            }
        }
        if spine.len() < 2 {
            return BezPath::new();
        }

        // Find the side of each point, across the line.
        let last = spine.len() - 1;
        let side = |i: usize| {
            let before = match i {
                0 => self.beyond[0].map(at),
                i => Some(spine[i - 1].0),
            };
            let after = spine
                .get(i + 1)
                .map(|next| next.0)
                .or(self.beyond[1].map(at));
            let along = after.unwrap_or(spine[i].0) - before.unwrap_or(spine[i].0);
            let length = along.hypot().max(1e-9);
            Vec2::new(-along.y, along.x) * (spine[i].1 / length)
        };

        // Go along one side and back along the other, with round caps at ends of the line.
        let mut corners: Vec<Point> = (0..=last).map(|i| spine[i].0 + side(i)).collect();
        if !self.goes_on[1] {
            corners.extend(cap(spine[last].0, side(last)));
        }
        corners.extend((0..=last).rev().map(|i| spine[i].0 - side(i)));
        if !self.goes_on[0] {
            corners.extend(cap(spine[0].0, -side(0)));
        }

        // Close the outline.
        let mut path = BezPath::new();
        for (i, corner) in corners.into_iter().enumerate() {
            match i {
                0 => path.move_to(corner),
                _ => path.line_to(corner),
            }
        }
        path.close_path();
        path
    }
}

/// Half a circle from a side of a line round its end, without its ends.
fn cap(center: Point, side: Vec2) -> impl Iterator<Item = Point> {
    (1..CAP).map(move |i| {
        let angle = -std::f32::consts::PI * i as f32 / CAP as f32;
        let (sin, cos) = (npr_core::math::sin(angle), npr_core::math::cos(angle));
        let (sin, cos) = (f64::from(sin), f64::from(cos));
        center + Vec2::new(side.x * cos - side.y * sin, side.x * sin + side.y * cos)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(position: [f64; 2], color: [u8; 4]) -> StrokePoint {
        StrokePoint {
            position,
            width: 2.0,
            color: Some(color),
            ..StrokePoint::default()
        }
    }

    fn stroke() -> impl Strategy<Value = Vec<StrokePoint>> {
        let any_point = ([0.0..50.0f64, 0.0..50.0f64], any::<[u8; 4]>());
        prop::collection::vec(any_point, 2..12).prop_map(|points| {
            points
                .into_iter()
                .map(|(p, color)| point(p, color))
                .collect()
        })
    }

    fn length(points: &[StrokePoint]) -> f64 {
        let step = |pair: &[StrokePoint]| {
            let [dx, dy] = [0, 1].map(|i| pair[1].position[i] - pair[0].position[i]);
            (dx * dx + dy * dy).sqrt()
        };
        points.windows(2).map(step).sum()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Pieces follow each other without a gap over the whole stroke, and neighbours look alike.
        #[test]
        fn pieces_make_up_the_stroke(points in stroke(), closed: bool) {
            let found = pieces(&points, closed, [0, 0, 0, 255]);
            let mut all = points.clone();
            if closed {
                all.push(points[0]);
            }
            let total: f64 = found.iter().map(|piece| {
                let mut own = piece.points.clone();
                if piece.closed {
                    own.push(own[0]);
                }
                length(&own)
            }).sum();
            prop_assert!((total - length(&all)).abs() < 1e-6 * total.max(1.0));
            for pair in found.windows(2) {
                let joint = [&pair[0].points[pair[0].points.len() - 1], &pair[1].points[0]];
                prop_assert_eq!(joint[0].position, joint[1].position);
                prop_assert!(difference(pair[0].color, pair[1].color) < 3.0 * STEP + 0.02, "{:?}", pair);
            }
        }

        #[test]
        fn one_color_is_one_piece(points in stroke(), color: [u8; 4], closed: bool) {
            let points: Vec<StrokePoint> = points.iter().map(|p| StrokePoint { color: Some(color), ..*p }).collect();
            let found = pieces(&points, closed, [0; 4]);
            prop_assert_eq!(found.len(), 1);
            prop_assert_eq!(&found[0].points, &points);
            prop_assert_eq!((found[0].color, found[0].closed), (color, closed));
        }

        #[test]
        fn a_mix_lies_between(a: [u8; 4], b: [u8; 4], t in 0.0..1.0f64) {
            let mixed = between(Some(a), Some(b), t).expect("both have one");
            let whole = difference(a, b);
            // Bytes round, and mixes of colours within sRGB may leave it a little.
            prop_assert!(difference(a, mixed) <= whole + 0.05 && difference(mixed, b) <= whole + 0.05);
            prop_assert_eq!(between(Some(a), None, t), Some(a));
        }

        #[test]
        fn strips_are_finite(points in stroke(), closed: bool) {
            for piece in pieces(&points, closed, [0; 4]) {
                let path = piece.outline(0.1, true);
                prop_assert!(path.elements().iter().all(|element| element.is_finite()));
            }
        }
    }

    #[test]
    fn without_points_there_are_no_pieces() {
        assert_eq!(pieces(&[], true, [0; 4]), Vec::new());
        assert_eq!(mean(&[StrokePoint::default()]), None);
    }
}
