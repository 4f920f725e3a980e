//! Smooth curves through polylines: few cubic Beziers that stay within a tolerance [Schneider 1990].
//!
//! A polyline is cut at its corners. Every run between two corners becomes a line where it is straight, else one cubic
//! with the run's own end tangents, fitted by least squares; where the cubic strays, the run is cut once more. A run
//! of two points is a line, so the polyline itself is the fallback and the work is bounded: O(n log n).
//!
//! Every result is measured before it is taken, point by point and between the points, on both sides: no point of the
//! polyline is further than the tolerance from the curve, and no point of the curve further from the polyline.
//!
//! Differs: kurbo's own fitting is not used. On folds and slivers it can hang, which no check afterwards can catch,
//! and it follows the staircase of a polyline's tangents where least squares average over it.

use kurbo::{BezPath, CubicBez, ParamCurve, ParamCurveDeriv, PathEl, Point, Vec2};

/// How closely curves follow points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Greatest distance between curve and polyline, in the unit of the points.
    pub tolerance: f64,
    /// Turn, in radians over a few tolerances, from which a point stays a corner.
    pub corner: f64,
}

impl Default for FitOptions {
    /// A quarter of a pixel, and corners from 40 degrees.
    fn default() -> Self {
        Self {
            tolerance: 0.25,
            corner: 0.7,
        }
    }
}

/// Bound of coordinates, so that products of differences stay finite.
const FAR: f64 = 1e9;

/// Distance to the predecessor under which a point is left out, as a share of the tolerance.
const THINNING: f64 = 0.05;

/// The share of the tolerance that is left for curves after thinning.
const MEASURED: f64 = 0.94;

/// Distance along the polyline over which tangents and corners are measured, in tolerances.
///
/// Shorter, and noise below the tolerance turns into corners; longer, and small round shapes become angular.
const ARM: f64 = 4.0;

/// Most points examined along an arm, so that points heaped on one place cost no more.
const ARM_POINTS: usize = 32;

/// Rounds of moving parameters to the nearest place on the curve before a run is cut.
const ROUNDS: usize = 4;

/// The curve along a polyline.
///
/// A closed polyline does not repeat its first point and gives a closed path, which may start at another point. Points
/// that are not finite are left out; with fewer than two different points left the path is empty.
///
/// ```
/// use npr_drawing::fit::{FitOptions, fit};
///
/// let corner = [[0.0, 0.0], [5.0, 0.0], [10.0, 0.0], [10.0, 8.0]];
/// assert_eq!(fit(&corner, false, &FitOptions::default()).to_svg(), "M0,0 L10,0 L10,8");
/// ```
pub fn fit(points: &[[f64; 2]], closed: bool, options: &FitOptions) -> BezPath {
    let points = clean(points, closed, options.tolerance * THINNING);
    let corners = find_corners(&points, closed, options);
    fit_with_corners(&points, &corners, closed, options.tolerance)
}

/// The curve along a polyline whose corners are known.
///
/// Points are finite, and neighbours differ; `corners` holds one entry per point.
pub(crate) fn fit_with_corners(
    points: &[Point],
    corners: &[bool],
    closed: bool,
    tolerance: f64,
) -> BezPath {
    let mut path = BezPath::new();
    if points.len() < 2 {
        return path;
    }
    let (run, cuts) = if closed {
        open_up(points, corners)
    } else {
        (points.to_vec(), cuts_of(corners))
    };
    // A closed curve without corners is smooth where it starts, too.
    let seam = (closed && cuts.len() == 2 && !corners.contains(&true))
        .then(|| tangent_between(points[points.len() - 1], points[0], points[1]));
    path.move_to(run[0]);
    for pair in cuts.windows(2) {
        fit_run(&run[pair[0]..=pair[1]], seam, tolerance, &mut path);
    }
    if closed { close(path, run[0]) } else { path }
}

/// Closes a path; a last line back to its start is dropped, since closing draws it anyway.
fn close(mut path: BezPath, start: Point) -> BezPath {
    if path.elements().len() > 2 && path.elements().last() == Some(&PathEl::LineTo(start)) {
        path.pop();
    }
    path.close_path();
    path
}

/// Finite points of which each is at least `gap` from the one before.
fn clean(points: &[[f64; 2]], closed: bool, gap: f64) -> Vec<Point> {
    // Leave out what is not finite, and points too close to the one before.
    let mut kept: Vec<Point> = Vec::with_capacity(points.len());
    let finite = points
        .iter()
        .filter(|p| p.iter().all(|v| v.is_finite()))
        .map(|p| Point::new(p[0].clamp(-FAR, FAR), p[1].clamp(-FAR, FAR)));
    let mut last = None;
    for point in finite {
        last = Some(point);
        if kept
            .last()
            .is_none_or(|k| (point - *k).hypot2() > gap * gap)
        {
            kept.push(point);
        }
    }

    // Keep the end of an open line; a closed one does not come back to its start.
    match (closed, last) {
        (false, Some(last)) if kept.last() != Some(&last) => kept.push(last),
        (true, _) => {
            while kept.len() > 1 && (kept[kept.len() - 1] - kept[0]).hypot2() <= gap * gap {
                kept.pop();
            }
        }
        _ => {}
    }
    kept
}

/// A closed polyline as an open one from a corner, or from its first point, back to the same point.
fn open_up(points: &[Point], corners: &[bool]) -> (Vec<Point>, Vec<usize>) {
    let start = corners.iter().position(|c| *c).unwrap_or(0);
    let around = |i: usize| (start + i) % points.len();
    let run: Vec<Point> = (0..=points.len()).map(|i| points[around(i)]).collect();
    let sharp: Vec<bool> = (0..=points.len()).map(|i| corners[around(i)]).collect();
    (run, cuts_of(&sharp))
}

/// Indices of both ends and of the corners between them.
fn cuts_of(corners: &[bool]) -> Vec<usize> {
    let last = corners.len() - 1;
    (0..=last)
        .filter(|i| *i == 0 || *i == last || corners[*i])
        .collect()
}

/// Which points are corners: the sharpest turn within an arm's reach, where it is sharp enough.
fn find_corners(points: &[Point], closed: bool, options: &FitOptions) -> Vec<bool> {
    // Measure the turn at every point over an arm on either side.
    let walk = Walk { points, closed };
    let reach = options.tolerance * ARM;
    let arms: Vec<[usize; 2]> = (0..points.len())
        .map(|i| [walk.arm(i, false, reach), walk.arm(i, true, reach)])
        .collect();
    let turns: Vec<f64> = (0..points.len())
        .map(|i| {
            let [back, fore] = arms[i].map(|steps| steps as isize);
            let (before, after) = (walk.at(i, -back), walk.at(i, fore));
            match (unit(points[i] - before), unit(after - points[i])) {
                (Some(arriving), Some(leaving)) => arriving.dot(leaving),
                _ => 1.0,
            }
        })
        .collect();

    // Corners turn most within their arms.
    let limit = libm_cos(options.corner);
    (0..points.len())
        .map(|i| {
            let sharper = |steps: isize| {
                let j = walk.index(i, steps);
                turns[j] < turns[i] || (turns[j] == turns[i] && j < i)
            };
            let [back, fore] = arms[i].map(|steps| steps as isize);
            turns[i] < limit && !(-back..=fore).any(sharper)
        })
        .collect()
}

/// Cosine with the same bits on every platform.
fn libm_cos(angle: f64) -> f64 {
    f64::from(npr_core::math::cos(angle as f32))
}

/// A polyline, with the indices of a closed one running round.
struct Walk<'a> {
    points: &'a [Point],
    closed: bool,
}

impl Walk<'_> {
    /// The index `steps` from `from`; at the ends of an open polyline it stays there.
    fn index(&self, from: usize, steps: isize) -> usize {
        let (count, place) = (self.points.len() as isize, from as isize + steps);
        if self.closed {
            place.rem_euclid(count) as usize
        } else {
            place.clamp(0, count - 1) as usize
        }
    }

    fn at(&self, from: usize, steps: isize) -> Point {
        self.points[self.index(from, steps)]
    }

    /// Number of steps to the first point at least `reach` away.
    fn arm(&self, from: usize, forward: bool, reach: f64) -> usize {
        let limit = ARM_POINTS.min(self.points.len() - 1);
        let step = |k: usize| if forward { k as isize } else { -(k as isize) };
        (1..limit)
            .find(|k| (self.at(from, step(*k)) - self.points[from]).hypot2() >= reach * reach)
            .unwrap_or(limit)
    }
}

/// A vector of length one, or nothing where it has no direction.
pub(crate) fn unit(v: Vec2) -> Option<Vec2> {
    let length = v.hypot2().sqrt();
    (length > 0.0 && length.is_finite()).then(|| v / length)
}

/// Direction of the parabola through three points at the middle one.
fn tangent_between(before: Point, here: Point, after: Point) -> Vec2 {
    let (arriving, leaving) = (here - before, after - here);
    let (a, b) = (arriving.hypot2().sqrt(), leaving.hypot2().sqrt());
    if a == 0.0 || b == 0.0 {
        return unit(after - before).unwrap_or(Vec2::new(1.0, 0.0));
    }
    unit(arriving * (b / a) + leaving * (a / b))
        .or(unit(leaving))
        .unwrap_or(Vec2::new(1.0, 0.0))
}

/// Direction of the parabola through three points at the first one.
fn tangent_at_end(here: Point, near: Point, far: Point) -> Vec2 {
    let (a, b) = ((near - here).hypot2().sqrt(), (far - here).hypot2().sqrt());
    let straight = unit(near - here).unwrap_or(Vec2::new(1.0, 0.0));
    if b <= a * 1.2 {
        return straight;
    }
    let slope = (near - here) * (b / a) - (far - here) * (a / b);
    // A parabola that turns away from its own first chord only follows noise.
    unit(slope)
        .filter(|t| t.dot(straight) > 0.5)
        .unwrap_or(straight)
}

/// A part of a run that has no curve yet.
struct Part {
    first: usize,
    last: usize,
    leaving: Vec2,
    arriving: Vec2,
}

/// Curves along a run without corners; `seam` is the direction at both ends of a smooth closed curve.
fn fit_run(run: &[Point], seam: Option<Vec2>, tolerance: f64, path: &mut BezPath) {
    // Leave straight lines straight.
    let limit = tolerance * MEASURED;
    let last = run.len() - 1;
    if seam.is_none() && is_straight(run, limit * 0.5) {
        return path.line_to(run[last]);
    }

    // Take the directions at both ends; a seam has the same on both sides.
    let walk = Walk {
        points: run,
        closed: false,
    };
    let reach = tolerance * ARM;
    let end = |i: usize, forward: bool| {
        let arm = walk.arm(i, forward, reach) as isize;
        let sign = if forward { 1 } else { -1 };
        tangent_at_end(run[i], walk.at(i, sign * arm), walk.at(i, 2 * sign * arm))
    };
    let mut parts = vec![Part {
        first: 0,
        last,
        leaving: seam.unwrap_or_else(|| end(0, true)),
        arriving: seam.map_or_else(|| end(last, false), |t| -t),
    }];

    // Fit curves, and cut where one misses too much, with a common direction at the cut.
    let mut fitter = Fitter::new(limit);
    while let Some(part) = parts.pop() {
        let points = &run[part.first..=part.last];
        match fitter.curve(points, part.leaving, part.arriving) {
            Found::Line => path.line_to(run[part.last]),
            Found::Curve(c) => path.curve_to(c.p1, c.p2, c.p3),
            Found::CutAt(cut) => {
                let cut = part.first + cut;
                let arms = [false, true].map(|forward| walk.arm(cut, forward, reach) as isize);
                let through =
                    tangent_between(walk.at(cut, -arms[0]), run[cut], walk.at(cut, arms[1]));
                parts.push(Part {
                    first: cut,
                    leaving: through,
                    ..part
                });
                parts.push(Part {
                    last: cut,
                    arriving: -through,
                    ..part
                });
            }
        }
    }
}

/// Whether all points lie within `limit` of the line between the ends.
fn is_straight(points: &[Point], limit: f64) -> bool {
    let (a, b) = (points[0], points[points.len() - 1]);
    points
        .iter()
        .all(|p| distance2_to_segment(*p, a, b) <= limit * limit)
}

/// Square of the distance between a point and a segment.
pub(crate) fn distance2_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (along, out) = (b - a, p - a);
    let length2 = along.hypot2();
    if length2 == 0.0 {
        return out.hypot2();
    }
    let t = (out.dot(along) / length2).clamp(0.0, 1.0);
    (out - along * t).hypot2()
}

/// The result of fitting a part.
enum Found {
    Line,
    Curve(CubicBez),
    /// No curve is near enough; cut at this point, which is neither end.
    CutAt(usize),
}

/// Fits one cubic at a time; keeps its list of parameters between calls.
struct Fitter {
    /// Greatest distance that samples may have.
    limit: f64,
    /// Parameter on the curve of each point, rising from 0 to 1.
    params: Vec<f64>,
}

/// The greatest squared distance between a curve and its points, and the point where it lies.
struct Miss {
    worst: f64,
    at: usize,
}

impl Fitter {
    fn new(limit: f64) -> Self {
        Self {
            limit,
            params: Vec::new(),
        }
    }

    /// A line or cubic along `points`, or where to cut them.
    fn curve(&mut self, points: &[Point], leaving: Vec2, arriving: Vec2) -> Found {
        if points.len() == 2 || is_straight(points, self.limit * 0.1) {
            return Found::Line;
        }
        let limit2 = self.limit * self.limit;
        let length = self.spread_by_chords(points);
        let mut at = points.len() / 2;
        for round in 0..=ROUNDS {
            let curve = self.least_squares(points, leaving, arriving, length);
            let miss = self.miss(&curve, points);
            if miss.worst <= limit2 {
                return Found::Curve(curve);
            }
            at = miss.at;
            let hopeless = miss.worst > 16.0 * limit2;
            if round == ROUNDS || hopeless || !self.move_to_nearest(&curve, points) {
                break;
            }
        }
        // Keep both parts a fair share, or the work could grow with the square of the points.
        let (last, share) = (points.len() - 1, points.len() / 8);
        Found::CutAt(at.clamp(share.max(1), (last - share).min(last - 1)))
    }

    /// Sets parameters by distance along the polyline, and returns its length.
    fn spread_by_chords(&mut self, points: &[Point]) -> f64 {
        self.params.clear();
        self.params.push(0.0);
        let mut length = 0.0;
        for pair in points.windows(2) {
            length += (pair[1] - pair[0]).hypot2().sqrt();
            self.params.push(length);
        }
        for param in &mut self.params {
            *param /= length;
        }
        length
    }

    /// The cubic with the given ends and end directions that is nearest to the points in the mean [Schneider 1990].
    fn least_squares(
        &self,
        points: &[Point],
        leaving: Vec2,
        arriving: Vec2,
        length: f64,
    ) -> CubicBez {
        let (p0, p3) = (points[0], points[points.len() - 1]);
        let (mut aa, mut ab, mut bb, mut ax, mut bx) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (point, u) in points.iter().zip(&self.params) {
            let v = 1.0 - u;
            let (b1, b2) = (3.0 * u * v * v, 3.0 * u * u * v);
            let (a, b) = (leaving * b1, arriving * b2);
            let ends = p0.to_vec2() * (v * v * v + b1) + p3.to_vec2() * (b2 + u * u * u);
            let rest = point.to_vec2() - ends;
            aa += a.dot(a);
            ab += a.dot(b);
            bb += b.dot(b);
            ax += a.dot(rest);
            bx += b.dot(rest);
        }
        let det = aa * bb - ab * ab;
        let (first, second) = ((ax * bb - bx * ab) / det, (aa * bx - ab * ax) / det);
        let sound = |reach: f64| reach > 1e-3 * length && reach < length;
        // Handles of a third of the chord are what is left when the points do not determine them.
        let third = (p3 - p0).hypot2().sqrt() / 3.0;
        let (first, second) = if sound(first) && sound(second) {
            (first, second)
        } else {
            (third, third)
        };
        CubicBez::new(p0, p0 + leaving * first, p3 + arriving * second, p3)
    }

    /// Measures the curve at its points, and bounds how far it strays from the polyline between them.
    ///
    /// Between two points the curve is a Bezier curve of its own. It lies in the hull of its control points, and the
    /// distance to a segment is convex, so no place of it is further away than the furthest control point.
    fn miss(&self, curve: &CubicBez, points: &[Point]) -> Miss {
        // Keep the worst distance; what is no number is the worst.
        let mut miss = Miss { worst: 0.0, at: 1 };
        let mut note = |distance2: f64, at: usize| {
            let distance2 = if distance2.is_nan() {
                f64::INFINITY
            } else {
                distance2
            };
            if distance2 > miss.worst {
                miss = Miss {
                    worst: distance2,
                    at,
                };
            }
        };

        // Compare ends, and handles of every stretch, with the line.
        let speed = curve.deriv();
        let mut handle = speed.eval(0.0).to_vec2();
        let mut start = curve.p0;
        for i in 1..points.len() {
            let (a, b) = (points[i - 1], points[i]);
            let third = (self.params[i] - self.params[i - 1]) / 3.0;
            let (end, next_handle) = (
                curve.eval(self.params[i]),
                speed.eval(self.params[i]).to_vec2(),
            );
            note((end - b).hypot2(), i);
            note(distance2_to_segment(start + handle * third, a, b), i - 1);
            note(distance2_to_segment(end - next_handle * third, a, b), i);
            (start, handle) = (end, next_handle);
        }
        miss
    }

    /// Moves every parameter towards the place on the curve that is nearest to its point, by one Newton step.
    ///
    /// False where parameters would no longer rise: the curve then runs back and forth.
    fn move_to_nearest(&mut self, curve: &CubicBez, points: &[Point]) -> bool {
        let first = curve.deriv();
        let second = first.deriv();
        let last = points.len() - 1;
        let mut previous = 0.0;
        for (point, u) in points[..last].iter().zip(&mut self.params).skip(1) {
            let out = curve.eval(*u) - *point;
            let (d1, d2) = (first.eval(*u).to_vec2(), second.eval(*u).to_vec2());
            let slope = d1.hypot2() + out.dot(d2);
            if slope > 0.0 {
                *u = (*u - out.dot(d1) / slope).clamp(0.0, 1.0);
            }
            if *u < previous {
                return false;
            }
            previous = *u;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kurbo::{ParamCurveNearest, PathSeg};
    use proptest::prelude::*;

    /// Greatest distance from the points to the path, and from the path to the polyline, by brute force.
    fn distances(points: &[[f64; 2]], closed: bool, path: &BezPath) -> [f64; 2] {
        let corners: Vec<Point> = points.iter().map(|p| Point::new(p[0], p[1])).collect();
        let segments: Vec<PathSeg> = path.segments().collect();
        let to_path = |p: Point| {
            segments
                .iter()
                .map(|s| s.nearest(p, 1e-6).distance_sq)
                .fold(f64::INFINITY, f64::min)
        };
        let count = corners.len();
        let pieces = if closed { count } else { count - 1 };
        let to_points = |p: Point| {
            (0..pieces)
                .map(|i| distance2_to_segment(p, corners[i], corners[(i + 1) % count]))
                .fold(f64::INFINITY, f64::min)
        };
        let away = corners.iter().map(|p| to_path(*p)).fold(0.0, f64::max);
        let astray = segments
            .iter()
            .flat_map(|s| (0..=40).map(move |k| s.eval(f64::from(k) / 40.0)))
            .map(to_points)
            .fold(0.0, f64::max);
        [away.sqrt(), astray.sqrt()]
    }

    fn assert_near(points: &[[f64; 2]], closed: bool, options: &FitOptions) -> BezPath {
        let path = fit(points, closed, options);
        let [away, astray] = distances(points, closed, &path);
        assert!(
            away <= options.tolerance,
            "a point is {away} away: {points:?}"
        );
        assert!(
            astray <= options.tolerance,
            "the curve strays {astray}: {points:?}"
        );
        path
    }

    fn arc(radius: f64, count: usize, turn: f64) -> Vec<[f64; 2]> {
        (0..count)
            .map(|i| {
                let angle = (i as f64 / count as f64 * turn) as f32;
                let (sin, cos) = (npr_core::math::sin(angle), npr_core::math::cos(angle));
                [
                    100.0 + radius * f64::from(cos),
                    100.0 + radius * f64::from(sin),
                ]
            })
            .collect()
    }

    /// Polylines of several tempers: noisy walks, folds on few places, heaps of near points.
    fn polyline() -> impl Strategy<Value = Vec<[f64; 2]>> {
        let step = prop_oneof![
            (-1.0..1.0f64, -1.0..1.0f64),
            (0.5..1.5f64, -0.3..0.3f64),
            (-60.0..60.0f64, -60.0..60.0f64),
            (-2i32..3, -2i32..3).prop_map(|(x, y)| (f64::from(x), f64::from(y))),
            (-1e-3..1e-3f64, -1e-3..1e-3f64),
        ];
        prop::collection::vec((step, 0usize..4), 2..60).prop_map(|steps| {
            let mut here = [50.0, 50.0];
            steps
                .iter()
                .flat_map(|((dx, dy), repeats)| {
                    here = [here[0] + dx, here[1] + dy];
                    vec![here; 1 + repeats / 3]
                })
                .collect()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn curve_and_polyline_stay_within_the_tolerance(points in polyline(), closed: bool) {
            let spread = points.iter().any(|p| {
                (p[0] - points[0][0]).abs().max((p[1] - points[0][1]).abs()) > 0.1
            });
            prop_assume!(spread);
            assert_near(&points, closed, &FitOptions::default());
        }

        #[test]
        fn any_numbers_give_a_finite_path(
            points in prop::collection::vec([any::<f64>(), any::<f64>()], 0..30), closed: bool,
        ) {
            prop_assert!(fit(&points, closed, &FitOptions::default()).is_finite());
        }

        #[test]
        fn scale_changes_nothing_but_scale(points in polyline(), power in -20i32..20) {
            let scale = f64::from(power).exp2();
            let grown: Vec<_> = points.iter().map(|p| p.map(|v| v * scale)).collect();
            let options = FitOptions::default();
            let grown_options = FitOptions { tolerance: options.tolerance * scale, ..options };
            let (small, large) = (fit(&points, false, &options), fit(&grown, false, &grown_options));
            prop_assert_eq!(kurbo::Affine::scale(scale) * small, large);
        }
    }

    #[test]
    fn a_straight_run_is_one_line() {
        let points: Vec<[f64; 2]> = (0..500)
            .map(|i| [f64::from(i), 3.0 + 0.1 * f64::from(i % 2)])
            .collect();
        let path = assert_near(&points, false, &FitOptions::default());
        assert_eq!(path.elements().len(), 2);
    }

    #[test]
    fn a_circle_needs_few_curves() {
        let points = arc(60.0, 400, std::f64::consts::TAU);
        let path = assert_near(&points, true, &FitOptions::default());
        assert!(path.segments().count() <= 8, "{}", path.to_svg());
    }

    #[test]
    fn a_spiral_stays_smooth() {
        let points: Vec<[f64; 2]> = arc(1.0, 2000, 40.0)
            .iter()
            .enumerate()
            .map(|(i, p)| p.map(|v| 100.0 + (v - 100.0) * i as f64 * 0.05))
            .collect();
        let path = assert_near(&points, false, &FitOptions::default());
        assert!(path.segments().count() <= 60, "{}", path.segments().count());
        assert!(
            path.segments()
                .skip(4)
                .all(|s| matches!(s, PathSeg::Cubic(_)))
        );
    }

    #[test]
    fn corners_stay_corners() {
        let mut points = Vec::new();
        let square = [[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]];
        for side in 0..4 {
            let (a, b): ([f64; 2], [f64; 2]) = (square[side], square[(side + 1) % 4]);
            points.extend(
                (0..20).map(|k| [0, 1].map(|i| a[i] + (b[i] - a[i]) * f64::from(k) / 20.0)),
            );
        }
        let path = assert_near(&points, true, &FitOptions::default());
        assert_eq!(path.to_svg(), "M0,0 L40,0 L40,40 L0,40 Z");
    }

    #[test]
    fn what_is_no_line_gives_no_path() {
        let options = FitOptions::default();
        assert!(fit(&[], false, &options).is_empty());
        assert!(fit(&[[1.0, 1.0]], true, &options).is_empty());
        assert!(fit(&[[1.0, 1.0], [f64::NAN, 0.0], [1.0, 1.0]], false, &options).is_empty());
    }

    #[test]
    fn folds_and_slivers_end() {
        for points in [
            vec![[0.0, 0.0], [10.0, 0.0], [0.0, 0.0]],
            vec![[0.0, 0.0], [10.0, 0.0], [0.0, 1e-9], [10.0, 1e-9]],
            [[0.0, 0.0], [10.0, 0.1]].repeat(200),
        ] {
            for closed in [false, true] {
                assert_near(&points, closed, &FitOptions::default());
            }
        }
    }
}
