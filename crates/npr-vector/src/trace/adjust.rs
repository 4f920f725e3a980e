//! Polygon corners moved to where the sides meet [Selinger 2003, 2.3.1].

use super::decompose::{PixelLoop, STEPS};
use glam::{DMat2, DVec2};

/// Corners of a loop's polygon, each moved by at most half a pixel along each axis to where the squared
/// distances from the lines of its two sides have the least sum. Pixels, y down.
///
/// The line of a side is the one that fits the path's corners along it best, by least squares. `polygon` is as
/// [`optimal_polygon`](super::optimal_polygon) gives it; O(n).
///
/// Not in the paper: where both lines are parallel, the place nearest to the polygon's corner is taken of all equally good ones.
pub fn adjust_corners(pixels: &PixelLoop<'_>, polygon: &[u32]) -> Vec<DVec2> {
    let mut adjusted = Vec::new();
    adjust_into(pixels, polygon, &mut adjusted);
    adjusted
}

/// [`adjust_corners`] into a vector that is used again.
pub(super) fn adjust_into(pixels: &PixelLoop<'_>, polygon: &[u32], adjusted: &mut Vec<DVec2>) {
    adjusted.clear();
    let mut ends = polygon.iter().skip(1).map(|corner| *corner as usize);
    let mut place = pixels.start.map(i64::from);
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
}

/// The corner from which the second line starts, moved.
fn corner_between(before: &Line, after: &Line) -> DVec2 {
    let corner = DVec2::from(after.start);
    corner + nearest_to_both(corner, before, after)
}

/// The line that fits the corners along a side best.
#[derive(Debug, Clone, Copy)]
struct Line {
    /// Where the side starts.
    start: [f64; 2],
    /// The middle of its corners, from its start.
    middle: DVec2,
    /// Of length 1, across the line; zero where no line is better than another.
    normal: DVec2,
}

impl Line {
    /// Fits a line to the corners from a place on along steps; and gives the place where they end.
    fn along(steps: &[u8], start: [i64; 2]) -> (Self, [i64; 2]) {
        let [mut x, mut y] = [0i64; 2];
        let [mut sx, mut sy, mut sxx, mut sxy, mut syy] = [0i64; 5];
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
        // Covariances, times the square of the count; exact, since sides are short of 2^17 steps.
        let count = steps.len() as i64 + 1;
        let xx = (count * sxx - sx * sx) as f64;
        let xy = (count * sxy - sx * sy) as f64;
        let yy = (count * syy - sy * sy) as f64;
        let line = Self {
            start: start.map(|v| v as f64),
            middle: DVec2::new(sx as f64, sy as f64) / count as f64,
            normal: least_axis(xx, xy, yy),
        };
        (line, [start[0] + x, start[1] + y])
    }
}

/// The axis of least spread, of length 1; zero where the spread is the same in all directions.
fn least_axis(xx: f64, xy: f64, yy: f64) -> DVec2 {
    let half = (xx - yy) / 2.0;
    let root = (half * half + xy * xy).sqrt();
    // The axis of greatest spread in the form that does not cancel, turned by a quarter.
    let axis = if half >= 0.0 {
        DVec2::new(half + root, xy)
    } else {
        DVec2::new(xy, root - half)
    };
    DVec2::new(-axis.y, axis.x).normalize_or_zero()
}

/// The place within half a pixel, along each axis, of a corner that is nearest to both lines; from the corner.
fn nearest_to_both(corner: DVec2, before: &Line, after: &Line) -> DVec2 {
    let mut sum = Quadratic::default();
    for line in [before, after] {
        let from_middle = corner - DVec2::from(line.start) - line.middle;
        sum.add_line(line.normal, line.normal.dot(from_middle));
    }
    sum.least_in_unit_square()
}

/// `p.M p + 2 v.p` with a matrix M that is no saddle.
#[derive(Debug, Clone, Copy, Default)]
struct Quadratic {
    xx: f64,
    xy: f64,
    yy: f64,
    linear: DVec2,
}

impl Quadratic {
    /// Adds the square of the distance from a line: of the origin it is `distance`.
    fn add_line(&mut self, normal: DVec2, distance: f64) {
        self.xx += normal.x * normal.x;
        self.xy += normal.x * normal.y;
        self.yy += normal.y * normal.y;
        self.linear += normal * distance;
    }

    fn value(&self, p: DVec2) -> f64 {
        let [x, y] = p.to_array();
        self.xx * x * x + 2.0 * self.xy * x * y + self.yy * y * y + 2.0 * self.linear.dot(p)
    }

    /// Where it is least among places up to 1/2 from the origin along each axis.
    fn least_in_unit_square(&self) -> DVec2 {
        let least = self.least();
        if least.abs().max_element() <= 0.5 {
            return least;
        }
        // It is convex, so the least place within lies on the border.
        let along = |numerator: f64, denominator: f64| {
            if denominator > 0.0 {
                (-numerator / denominator).clamp(-0.5, 0.5)
            } else {
                0.0
            }
        };
        let borders = [-0.5, 0.5].into_iter().flat_map(|side| {
            let upright = along(self.xy * side + self.linear.y, self.yy);
            let level = along(self.xy * side + self.linear.x, self.xx);
            [DVec2::new(side, upright), DVec2::new(level, side)]
        });
        let mut best = (f64::INFINITY, DVec2::ZERO);
        for place in borders {
            let value = self.value(place);
            if value < best.0 {
                best = (value, place);
            }
        }
        best.1
    }

    /// Where it is least of all; of many such places the nearest to the origin.
    fn least(&self) -> DVec2 {
        let matrix = DMat2::from_cols_array(&[self.xx, self.xy, self.xy, self.yy]);
        let determinant = matrix.determinant();
        let trace = self.xx + self.yy;
        if determinant > PARALLEL * trace * trace {
            return matrix.inverse() * -self.linear;
        }
        if trace > 0.0 {
            // Both lines are parallel: go straight across them.
            return -self.linear / trace;
        }
        DVec2::ZERO
    }
}

/// Share of the squared trace up to which the determinant of a matrix counts as zero: that of lines at an angle of 1e-5.
const PARALLEL: f64 = 1e-11;
