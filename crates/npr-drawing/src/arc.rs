//! Strokes measured along themselves: parts of them, and ends that run on straight or stop short.

use crate::color_runs::point_between;
use npr_vector::mesh_lines::run::distance;
use npr_vector::stroke::{Stroke, StrokePoint};

/// Longest stroke, in pixels, whose course is changed; longer ones, and those that are not finite, stay as they are.
const LONGEST_PX: f64 = 1e6;

/// Distance, in pixels, under which two points are one.
const TOO_NEAR_PX: f64 = 1e-3;

/// The same of a point and the end of a part: a corner that is left out makes the line shorter by up to twice as much.
const AT_END_PX: f64 = 1e-6;

/// Length, in pixels, of the piece at an end that says where a line runs on to: steps of pixels and the last bend of a
/// smoothed line are shorter.
const TANGENT_PX: f64 = 6.0;

/// Whether the course of a stroke of this length is changed.
pub(crate) fn has_course(length: f64) -> bool {
    length > TOO_NEAR_PX && length <= LONGEST_PX
}

/// A stroke with the way from its start to each of its points.
#[derive(Debug)]
pub(crate) struct Measured {
    /// Its points; of a closed stroke the first one comes again at the end.
    points: Vec<StrokePoint>,
    /// Pixels from the start to each of them.
    along: Vec<f64>,
    pub closed: bool,
}

impl Measured {
    /// Measures a stroke; `None` for one whose length says that it stays as it is. O(points).
    pub fn new(stroke: &Stroke) -> Option<Self> {
        let mut points = stroke.points.clone();
        let ends = (stroke.points.first(), stroke.points.last());
        if let (true, (Some(first), Some(last))) = (stroke.closed, ends) {
            points.push(StrokePoint {
                u: last.u + distance(last.position, first.position),
                ..*first
            });
        }
        Self::of_points(points, stroke.closed)
    }

    fn of_points(points: Vec<StrokePoint>, closed: bool) -> Option<Self> {
        let mut way = 0.0;
        let ways = points.windows(2).map(|pair| {
            way += distance(pair[0].position, pair[1].position);
            way
        });
        let along: Vec<f64> = std::iter::once(0.0).chain(ways).collect();
        has_course(way).then_some(Self {
            points,
            along,
            closed,
        })
    }

    /// Its length in pixels, which is more than 0.
    pub fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or_default()
    }

    /// All pieces between two points: the ways from the start to both, and the texture coordinates there.
    pub fn pieces(&self) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
        let ends = self.along.windows(2).zip(self.points.windows(2));
        ends.map(|(ways, points)| ([ways[0], ways[1]], [points[0].u, points[1].u]))
    }

    /// The point `way` pixels from the start; an end for ways beyond it.
    pub fn at(&self, way: f64) -> StrokePoint {
        let next = self.along.partition_point(|along| *along <= way);
        let next = next.clamp(1, self.points.len() - 1);
        let (from, to) = (self.along[next - 1], self.along[next]);
        let share = if to > from {
            ((way - from) / (to - from)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        point_between(&self.points[next - 1], &self.points[next], share)
    }

    /// The part of it from one way to another, which begins and ends exactly there; points between are its own.
    ///
    /// A closed stroke goes on through its start, below 0 and beyond its length, by one round at most. O(log points +
    /// points of the part).
    pub fn part(&self, from: f64, to: f64) -> Vec<StrokePoint> {
        let length = self.length();
        if self.closed && from < 0.0 {
            self.joined(self.part(from + length, length), self.part(0.0, to))
        } else if self.closed && to > length {
            self.joined(self.part(from, length), self.part(0.0, to - length))
        } else {
            self.inner_part(from.max(0.0), to.min(length))
        }
    }

    fn inner_part(&self, from: f64, to: f64) -> Vec<StrokePoint> {
        let first = self
            .along
            .partition_point(|along| *along < from + AT_END_PX);
        let after = self.along.partition_point(|along| *along <= to - AT_END_PX);
        let between = self.points.get(first..after).unwrap_or_default();
        let ends = [self.at(from), self.at(to)];
        let mut points = Vec::with_capacity(between.len() + 2);
        points.push(ends[0]);
        points.extend_from_slice(between);
        points.push(ends[1]);
        points
    }

    /// Two parts that meet in the start of a closed stroke; the texture coordinate runs on through it.
    fn joined(&self, mut before: Vec<StrokePoint>, after: Vec<StrokePoint>) -> Vec<StrokePoint> {
        let round = self.points[self.points.len() - 1].u - self.points[0].u;
        before.extend(after.into_iter().skip(1).map(|point| StrokePoint {
            u: point.u + round,
            ..point
        }));
        before
    }

    /// An open stroke whose start and end run on straight by so many pixels; negative numbers cut them off.
    ///
    /// What runs on keeps the width, colour, depth and place in the world of the end.
    pub fn with_ends(&self, [start, end]: [f64; 2]) -> Vec<StrokePoint> {
        let length = self.length();
        let mut points = self.part((-start).max(0.0), length - (-end).max(0.0));
        let beyond = [start, end].map(|px| (px > 0.0).then_some(px));
        let tips = [self.tip(0.0, beyond[0]), self.tip(length, beyond[1])];
        points.splice(0..0, tips[0]);
        points.extend(tips[1]);
        points
    }

    /// The point so many pixels beyond an end, straight on; `None` where the line turns back onto its end.
    fn tip(&self, end: f64, beyond: Option<f64>) -> Option<StrokePoint> {
        let beyond = beyond?;
        let length = self.length();
        let reach = TANGENT_PX.min(length);
        let (inner, sign) = match end > 0.0 {
            true => (length - reach, 1.0),
            false => (reach, -1.0),
        };
        let (end, inner) = (self.at(end), self.at(inner));
        let chord = distance(inner.position, end.position);
        (chord > TOO_NEAR_PX).then(|| {
            let step = |i: usize| (end.position[i] - inner.position[i]) * (beyond / chord);
            StrokePoint {
                position: [0, 1].map(|i| end.position[i] + step(i)),
                u: end.u + sign * beyond,
                ..end
            }
        })
    }

    /// Its points and more between them, no two farther apart than `step` pixels, each with its way from the start.
    /// A closed stroke's first point does not come again.
    pub fn in_steps(&self, step: f64) -> Vec<(f64, StrokePoint)> {
        let count = (self.length() / step) as usize + self.points.len();
        let mut points = Vec::with_capacity(count);
        for (ways, ends) in self.along.windows(2).zip(self.points.windows(2)) {
            let pieces = ((ways[1] - ways[0]) / step).ceil().max(1.0) as u32;
            points.extend((0..pieces).map(|piece| {
                let share = f64::from(piece) / f64::from(pieces);
                let way = ways[0] + (ways[1] - ways[0]) * share;
                (way, point_between(&ends[0], &ends[1], share))
            }));
        }
        let last = (self.length(), self.points[self.points.len() - 1]);
        points.extend((!self.closed).then_some(last));
        points
    }
}

/// Measures points as an open stroke.
pub(crate) fn measure_open(points: Vec<StrokePoint>) -> Option<Measured> {
    Measured::of_points(points, false)
}

#[cfg(test)]
mod tests;
