//! Polygon corners moved to where the sides meet [Selinger 2003, 2.3.1].

use super::decompose::{PixelLoop, STEPS};
use glam::DVec2;

/// Corners of a loop's polygon, each moved by at most half a pixel along each axis to where the squared
/// distances from the lines of its two sides have the least sum. Pixels, y down.
///
/// The line of a side is the one that fits the path's corners along it best, by least squares. `polygon` is as
/// [`optimal_polygon`](super::optimal_polygon) gives it; O(n).
///
/// Not in the paper: where both lines are parallel, or one side has no best line, a line across them through the
/// polygon's corner takes part as a third. Whether they are parallel, and which of two equally good places on the
/// square's border is taken, hangs on rounding; so that curves become those of the program Potrace, the order of
/// operations is the one of 360 that gave its results on all of 166 such corners of a noise picture.
pub fn adjust_corners(pixels: &PixelLoop<'_>, polygon: &[u32]) -> Vec<DVec2> {
    let mut adjusted = Vec::new();
    adjust_into(pixels, polygon, &mut adjusted);
    adjusted
}

/// [`adjust_corners`] into a vector that is used again.
pub(super) fn adjust_into(pixels: &PixelLoop<'_>, polygon: &[u32], adjusted: &mut Vec<DVec2>) {
    adjusted.clear();
    let mut ends = polygon.iter().skip(1).map(|corner| *corner as usize);
    // From the loop's start, so that equal loops become equal curves.
    let mut place = [0; 2];
    let lines = polygon.iter().map(|corner| {
        let end = ends.next().unwrap_or(pixels.steps.len());
        let side = pixels.steps.get(*corner as usize..end).unwrap_or(&[]);
        let (line, next) = Line::along(side, place);
        place = next;
        line
    });
    let mut both: Option<[Line; 2]> = None;
    for line in lines {
        let [first, before] = both.unwrap_or([line; 2]);
        adjusted.push(corner_between(&before, &line));
        both = Some([first, line]);
    }
    // The first corner has the last line before it.
    if let (Some(place), Some([first, last])) = (adjusted.first_mut(), both) {
        *place = corner_between(&last, &first);
    }
    let start = DVec2::from(pixels.start.map(f64::from));
    adjusted.iter_mut().for_each(|place| *place += start);
}

/// The line that fits the corners along a side best.
#[derive(Debug, Clone, Copy)]
struct Line {
    /// Where the side starts.
    start: [f64; 2],
    /// The middle of its corners.
    middle: DVec2,
    /// Of length 1, across the line; zero where no line is better than another.
    normal: DVec2,
}

impl Line {
    /// Fits a line to the corners from a place on along steps; and gives the place where they end.
    fn along(steps: &[u8], start: [i64; 2]) -> (Self, [i64; 2]) {
        // Sum up the pixel corners that the steps pass.
        let [mut x, mut y] = start;
        let [mut sx, mut sy, mut sxx, mut sxy, mut syy] = [x, y, x * x, x * y, y * y];
        for direction in steps {
            let step = STEPS[usize::from(direction & 3)];
            x += i64::from(step[0]);
            y += i64::from(step[1]);
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
            syy += y * y;
        }

        // Lay a line through their mean, along their greatest spread.
        let count = (steps.len() + 1) as f64;
        let [sx, sy, sxx, sxy, syy] = [sx, sy, sxx, sxy, syy].map(|sum| sum as f64);
        let xx = (sxx - sx * sx / count) / count;
        let xy = (sxy - sx * sy / count) / count;
        let yy = (syy - sy * sy / count) / count;
        let line = Self {
            start: start.map(|v| v as f64),
            middle: DVec2::new(sx, sy) / count,
            normal: least_axis(xx, xy, yy),
        };
        (line, [x, y])
    }
}

/// The axis of least spread, of length 1; zero where the spread is the same in all directions.
fn least_axis(xx: f64, xy: f64, yy: f64) -> DVec2 {
    let most = (xx + yy + ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt()) / 2.0;
    let (left, right) = (xx - most, yy - most);
    // The longer of the two rows that the axis of most spread is across.
    let axis = if left.abs() >= right.abs() {
        DVec2::new(left, xy)
    } else {
        DVec2::new(xy, right)
    };
    let length = (axis.x * axis.x + axis.y * axis.y).sqrt();
    if length > 0.0 {
        axis / length
    } else {
        DVec2::ZERO
    }
}

/// The place within half a pixel, along each axis, of the corner between two sides that is nearest to both lines.
fn corner_between(before: &Line, after: &Line) -> DVec2 {
    let corner = DVec2::from(after.start);
    let mut distances = Distances::default();
    for line in [before, after] {
        distances.add(line.normal, line.middle);
    }
    if distances.determinant() == 0.0 {
        // Nothing tells how far to go along parallel lines: a third, through the corner and across them.
        let normals = [before.normal, after.normal];
        let normal = normals.into_iter().find(|normal| *normal != DVec2::ZERO);
        // Where no line is better than another, the corner stays.
        let Some(normal) = normal else {
            return corner;
        };
        distances.add(normal.perp(), corner);
    }
    distances.least_near(corner)
}

/// The sum of squared distances of a place from lines, as the quadratic form of `(x, y, 1)` [Selinger 2003, 2.3.1].
#[derive(Debug, Clone, Copy, Default)]
struct Distances([[f64; 3]; 3]);

impl Distances {
    /// Adds a line through a place, across a normal; none if that is zero.
    fn add(&mut self, normal: DVec2, through: DVec2) {
        let square = normal.length_squared();
        if square == 0.0 {
            return;
        }
        let line = [normal.x, normal.y, -normal.dot(through)];
        for (row, a) in self.0.iter_mut().zip(line) {
            for (entry, b) in row.iter_mut().zip(line) {
                *entry += a * b / square;
            }
        }
    }

    /// Zero where all lines are parallel, but for rounding.
    fn determinant(&self) -> f64 {
        let [[xx, xy, _], [_, yy, _], _] = self.0;
        xx * yy - xy * xy
    }

    fn at(&self, place: DVec2) -> f64 {
        let place = [place.x, place.y, 1.0];
        let rows = self.0.iter().zip(place);
        rows.fold(0.0, |sum, (row, a)| {
            let entries = row.iter().zip(place);
            entries.fold(sum, |sum, (entry, b)| sum + a * entry * b)
        })
    }

    /// Where it is least among places up to 1/2 from a corner along each axis.
    fn least_near(&self, corner: DVec2) -> DVec2 {
        let [[xx, xy, x], [_, yy, y], _] = self.0;
        let least = DVec2::new(xy * y - yy * x, xy * x - xx * y) / self.determinant();
        let is_near = |place: DVec2| (place - corner).abs().max_element() <= 0.5;
        if is_near(least) {
            return least;
        }
        // It is convex, so the least place within lies on the border: on the way along a side, or at its end.
        let level = [0.5, -0.5].map(|side| {
            let side = corner.y + side;
            DVec2::new(-(xy * side + x) / xx, side)
        });
        let upright = [-0.5, 0.5].map(|side| {
            let side = corner.x + side;
            DVec2::new(side, -(xy * side + y) / yy)
        });
        let ends = [-0.5, 0.5].map(|x| [-0.5, 0.5].map(|y| corner + DVec2::new(x, y)));
        let places = level.into_iter().chain(upright);
        let places = places.chain(ends.into_iter().flatten());
        let mut best = (f64::INFINITY, corner);
        for place in places.filter(|place| is_near(*place)) {
            let value = self.at(place);
            if value < best.0 {
                best = (value, place);
            }
        }
        best.1
    }
}
