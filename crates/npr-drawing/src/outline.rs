//! Lines of varying width as filled outlines: the union of discs whose centres and radii run along the line.
//!
//! The outline walks along one side, round the end and back along the other, so one rule serves sides, joins and caps.
//! At every point the offsets of the two neighbouring pieces meet: on the outer side of a turn an arc joins them; on
//! the inner side they cross, and the walk turns where they do. Where a line turns tighter than its own half width
//! they do not cross; the walk then follows the line's middle, and whole discs are added. Every part thus winds the
//! same way, so no rule of filling can leave a hole, and nothing lies outside the union of discs.

use crate::fit::{fit_with_corners, unit};
use glam::DVec2;
use kurbo::{BezPath, Point, Vec2};
use npr_vector::stroke::StrokePoint;

/// Bound of coordinates and widths: points beyond it are left out, widths are cut to it.
const FAR: f64 = 1e6;

/// Change of place or radius, in pixels, under which a point adds nothing.
const STEP: f64 = 0.05;

/// Turn in radians from which a place on the inner side stays a corner of the outline.
const CORNER: f64 = 0.5;

/// Number of pieces on either side of a turn that are searched for the place where its inner sides cross.
const SEARCH: usize = 48;

/// A disc under the pen.
#[derive(Debug, Clone, Copy)]
struct Disc {
    center: Point,
    radius: f64,
}

/// The filled shape of a line with round ends and joins; fill it by the nonzero rule.
///
/// The shape is the union of all discs with the line's width along it, within `tolerance` pixels (a tenth of a pixel
/// looks exact). An open line gives one closed curve, a closed one a ring of two; discs are added where the line turns
/// tighter than its half width, and where the width changes by more than twice the way the line is parted. Points that
/// are not finite are left out, and nothing is left of a line without two different points, or without width.
///
/// O(n) for lines that turn in a few places.
pub fn outline(points: &[StrokePoint], closed: bool, tolerance: f64) -> BezPath {
    let discs = discs_of(points, closed);
    let mut path = BezPath::new();
    if discs.len() < 2 {
        return path;
    }
    for part in parts_of(discs, closed) {
        // Go around each part: a ring on both sides, a line there and back.
        let walks = match &part {
            Part::Disc(disc) => {
                path.extend(circle(*disc, tolerance));
                continue;
            }
            Part::Ring(discs) => vec![discs.clone(), discs.iter().rev().copied().collect()],
            Part::Line(discs) => {
                let inner = &discs[1..discs.len() - 1];
                vec![discs.iter().chain(inner.iter().rev()).copied().collect()]
            }
        };

        // Fit curves to the side of the ink.
        let is_ring = matches!(part, Part::Ring(_));
        for walk in walks {
            let side = Side::of(&walk, is_ring, tolerance);
            path.extend(fit_with_corners(
                &side.points,
                &side.corners,
                true,
                tolerance * 0.7,
            ));
            for disc in side.discs {
                path.extend(circle(disc, tolerance));
            }
        }
    }
    path
}

/// A part of a line along which no disc contains its neighbour.
enum Part {
    Disc(Disc),
    Line(Vec<Disc>),
    Ring(Vec<Disc>),
}

/// Parts whose union is the line.
///
/// No side runs from a disc to one inside it, and the stretch between them adds nothing to the larger one. So the line
/// is cut there; a part that is only a disc inside its neighbour is left out.
fn parts_of(mut discs: Vec<Disc>, closed: bool) -> Vec<Part> {
    // Start where one disc holds the next, if a closed line has such a place.
    let count = discs.len();
    let closed = closed && count > 2;
    let holds = |a: &Disc, b: &Disc| (b.center - a.center).hypot() <= a.radius - b.radius;
    let is_cut = |a: &Disc, b: &Disc| holds(a, b) || holds(b, a);
    let seam = (0..count).find(|i| is_cut(&discs[*i], &discs[(i + 1) % count]));
    match seam {
        None if closed => return vec![Part::Ring(discs)],
        Some(seam) if closed => discs.rotate_left((seam + 1) % count),
        _ => {}
    }

    // Cut the line at such places.
    let mut parts = Vec::new();
    let mut start = 0;
    for end in 1..=count {
        if end < count && !is_cut(&discs[end - 1], &discs[end]) {
            continue;
        }

        // Keep a disc that no neighbour holds.
        let part = &discs[start..end];
        if let [disc] = part {
            let before = (closed || start > 0).then(|| &discs[(start + count - 1) % count]);
            let after = (closed || end < count).then(|| &discs[end % count]);
            if !before
                .into_iter()
                .chain(after)
                .any(|other| holds(other, disc))
            {
                parts.push(Part::Disc(*disc));
            }
        } else if part.iter().any(|disc| disc.radius > 0.0) {
            parts.push(Part::Line(part.to_vec()));
        }
        start = end;
    }
    parts
}

/// Discs along the line; neighbours differ.
fn discs_of(points: &[StrokePoint], closed: bool) -> Vec<Disc> {
    // Make a disc of each point that is not far outside.
    let mut discs: Vec<Disc> = Vec::with_capacity(points.len());
    let differ = |a: &Disc, b: &Disc| {
        (a.center - b.center).hypot2() > STEP * STEP || (a.radius - b.radius).abs() > STEP
    };
    let inside = points
        .iter()
        .filter(|p| p.position.iter().all(|v| v.abs() <= FAR));
    for point in inside {
        let width = if point.width.is_finite() {
            point.width
        } else {
            0.0
        };
        let disc = Disc {
            center: Point::new(point.position[0], point.position[1]),
            radius: 0.5 * width.clamp(0.0, FAR),
        };
        if discs.last().is_none_or(|last| differ(last, &disc)) {
            discs.push(disc);
        }
    }

    // A closed line does not come back to its first disc.
    while closed && discs.len() > 1 && !differ(&discs[0], &discs[discs.len() - 1]) {
        discs.pop();
    }
    discs
}

/// The left side of a walk over discs that ends where it began.
#[derive(Default)]
struct Side {
    points: Vec<Point>,
    corners: Vec<bool>,
    /// The disc of each point.
    owners: Vec<usize>,
    /// Discs to be added, because the side does not go around them.
    discs: Vec<Disc>,
}

/// A place on the left side of a walk.
#[derive(Clone, Copy)]
struct OutlinePoint {
    point: Point,
    corner: bool,
    /// The disc that it belongs to.
    disc: usize,
    /// Whether it is the middle of the disc, since the walk cannot stay on the side.
    pivot: bool,
}

/// The piece of line from one disc to the next.
#[derive(Clone, Copy)]
struct Piece {
    along: Vec2,
    length: f64,
    /// By how much the side leans towards the thinner end, in radians.
    lean: f64,
}

impl Piece {
    fn between(a: &Disc, b: &Disc) -> Self {
        let offset = b.center - a.center;
        let length = offset.hypot2().sqrt();
        let sin = ((a.radius - b.radius) / length).clamp(-1.0, 1.0);
        let cos = (1.0 - sin * sin).sqrt();
        Self {
            along: unit(offset).unwrap_or(Vec2::new(1.0, 0.0)),
            length,
            lean: DVec2::new(cos, sin).to_angle(),
        }
    }

    /// Length of its side, which is tangent to both discs.
    fn side_length(&self) -> f64 {
        self.length * DVec2::from_angle(self.lean).x
    }

    /// Direction from the middle to the left side.
    fn normal(&self) -> Vec2 {
        rotate(Vec2::new(-self.along.y, self.along.x), -self.lean)
    }
}

fn rotate(v: Vec2, angle: f64) -> Vec2 {
    let turned = DVec2::from_angle(angle).rotate(DVec2::new(v.x, v.y));
    Vec2::new(turned.x, turned.y)
}

/// Angle from one direction to another, in -pi..=pi.
fn angle_between(a: Vec2, b: Vec2) -> f64 {
    DVec2::new(a.dot(b), a.cross(b)).to_angle()
}

impl Side {
    fn of(walk: &[Disc], closed: bool, tolerance: f64) -> Self {
        let pieces: Vec<Piece> = (0..walk.len())
            .map(|i| Piece::between(&walk[i], &walk[(i + 1) % walk.len()]))
            .collect();
        let mut places = Vec::with_capacity(2 * walk.len());
        for (i, disc) in walk.iter().enumerate() {
            let (arriving, leaving) = (&pieces[(i + walk.len() - 1) % walk.len()], &pieces[i]);
            let is_end = !closed && (i == 0 || i == walk.len() / 2);
            join(i, disc, arriving, leaving, is_end, tolerance, &mut places);
        }
        Self::untangle(places, walk, tolerance)
    }

    /// Replaces every passage through the middle by the place where the side crosses itself, if there is one.
    fn untangle(mut places: Vec<OutlinePoint>, walk: &[Disc], tolerance: f64) -> Self {
        // Start away from passages, so that what they search lies on both sides of them.
        let start = (0..places.len())
            .find(|i| (0..3).all(|k| !places[(i + k) % places.len()].pivot))
            .unwrap_or(0);
        places.rotate_left(start);
        let mut side = Self::default();
        // Points before this one belong to an earlier passage.
        let mut fence = 0;
        let mut i = 0;
        while i < places.len() {
            let place = places[i];
            i += 1;
            if !place.pivot {
                side.push(&place);
                continue;
            }
            // In a tight bend one passage follows the other; the side may cross before and behind them all.
            let mut end = i;
            while places.get(end + 2).is_some_and(|next| next.pivot) {
                end += 3;
            }
            let bend = [place.disc, places[end - 1].disc];
            if let Some((keep, skip, crossing)) = side.crossing(fence, bend, &places[end..], walk) {
                side.cut(keep);
                side.push(&OutlinePoint {
                    point: crossing,
                    corner: true,
                    ..place
                });
                i = end + skip;
            } else {
                side.pass(&place, walk[place.disc], tolerance);
                if let Some(next) = places.get_mut(i) {
                    next.corner = true;
                }
            }
            fence = side.points.len();
        }
        side
    }

    /// Adds a point, unless it is where the last one is.
    fn push(&mut self, place: &OutlinePoint) {
        match (self.points.last(), self.corners.last_mut()) {
            (Some(last), Some(flag)) if (*last - place.point).hypot2() < 1e-6 => {
                *flag |= place.corner;
            }
            _ => {
                self.points.push(place.point);
                self.corners.push(place.corner);
                self.owners.push(place.disc);
            }
        }
    }

    fn cut(&mut self, keep: usize) {
        self.points.truncate(keep);
        self.corners.truncate(keep);
        self.owners.truncate(keep);
    }

    /// Where later places cross the side before a bend: points to keep, places to skip, and the crossing.
    ///
    /// There is none if the area between the two sides would otherwise not be filled.
    fn crossing(
        &self,
        fence: usize,
        bend: [usize; 2],
        ahead: &[OutlinePoint],
        walk: &[Disc],
    ) -> Option<(usize, usize, Point)> {
        // Look ahead to the next stop, and back to the last corner.
        let reach = ahead
            .iter()
            .position(|place| place.pivot || place.corner)
            .map_or(ahead.len(), |stop| stop + 1)
            .min(SEARCH);
        let corner = self.corners.iter().rposition(|c| *c).unwrap_or(0);
        let behind = fence
            .max(corner)
            .max(self.points.len().saturating_sub(SEARCH));

        // The first crossing decides: it counts where the ink doubles over itself in one bend.
        for j in 1..reach {
            for i in (behind + 1..self.points.len()).rev() {
                let (a, b) = (self.points[i - 1], self.points[i]);
                if let Some(crossing) = cross(a, b, ahead[j - 1].point, ahead[j].point) {
                    let (from, to) = (self.owners[i - 1], ahead[j].disc);
                    let doubled = is_one_bend(walk, from, to)
                        && self.points[i..]
                            .iter()
                            .all(|p| covers(walk, bend[0], to, true, *p))
                        && ahead[..j]
                            .iter()
                            .all(|p| covers(walk, bend[1], from, false, p.point));
                    return doubled.then_some((i, j, crossing));
                }
            }
        }
        None
    }

    /// Goes through the middle of the line, and adds a disc in place of the side.
    fn pass(&mut self, place: &OutlinePoint, disc: Disc, tolerance: f64) {
        if let Some(flag) = self.corners.last_mut() {
            *flag = true;
        }
        self.push(place);
        // Between two discs their union is thinner than the line by the square of their distance.
        let near = |last: &Disc| {
            (last.center - disc.center).hypot2() <= 2.0 * tolerance * disc.radius
                && (last.radius - disc.radius).abs() < tolerance
        };
        if !self.discs.last().is_some_and(near) {
            self.discs.push(disc);
        }
    }
}

/// Whether the line between two discs turns by less than half a turn, and swells slowly.
///
/// Only parts of a curl, or of a disc that contains its neighbour, would be filled twice.
fn is_one_bend(walk: &[Disc], from: usize, to: usize) -> bool {
    let count = walk.len();
    let along = |i: usize| walk[(i + 1) % count].center - walk[i % count].center;
    let steps = (to + count - from) % count;
    let turning: f64 = (from + 1..from + steps)
        .map(|i| angle_between(along(i - 1), along(i)).abs())
        .sum();
    let slow = |i: usize| {
        let swell = walk[(i + 1) % count].radius - walk[i % count].radius;
        swell * swell < 0.5 * along(i).hypot2()
    };
    turning < 0.85 * std::f64::consts::PI && (from..from + steps).all(slow)
}

/// Whether a point lies beside the line between disc `from` and `to`, and within its width.
fn covers(walk: &[Disc], from: usize, to: usize, forward: bool, p: Point) -> bool {
    let count = walk.len();
    let mut here = from;
    while here != to {
        let next = (here + if forward { 1 } else { count - 1 }) % count;
        let (a, b) = (&walk[here], &walk[next]);
        let along = b.center - a.center;
        let t = (p - a.center).dot(along) / along.hypot2();
        let radius = a.radius + (b.radius - a.radius) * t.min(1.0);
        let beside = t > 1e-9 || here != from;
        let middle = a.center + along * t.clamp(0.0, 1.0);
        if beside && (p - middle).hypot2() <= radius * radius {
            return true;
        }
        here = next;
    }
    false
}

/// Places on the side where two pieces meet at disc `i`.
fn join(
    i: usize,
    disc: &Disc,
    arriving: &Piece,
    leaving: &Piece,
    is_end: bool,
    tolerance: f64,
    places: &mut Vec<OutlinePoint>,
) {
    // At an end the walk turns back, with the tip on its left.
    let bend = if is_end {
        -std::f64::consts::PI
    } else {
        angle_between(arriving.along, leaving.along)
    };
    let turn = bend + arriving.lean - leaving.lean;
    let normal = arriving.normal();
    let mut put = |offset: Vec2, corner: bool, pivot: bool| {
        places.push(OutlinePoint {
            point: disc.center + offset,
            corner,
            disc: i,
            pivot,
        });
    };
    if turn <= 0.0 {
        let steps = arc_steps(disc.radius, -turn, tolerance);
        if steps == 0 {
            return put(rotate(normal, 0.5 * turn) * disc.radius, false, false);
        }
        // A round join is a run of its own, so that straight sides stay straight.
        let round = turn < -CORNER;
        for k in 0..=steps {
            let angle = turn * k as f64 / steps as f64;
            let is_seam = round && (k == 0 || k == steps);
            put(rotate(normal, angle) * disc.radius, is_seam, false);
        }
        return;
    }
    let half = DVec2::from_angle(0.5 * turn);
    let inset = disc.radius * half.y;
    let room = 0.5 * arriving.side_length().min(leaving.side_length());
    if half.x > 1e-3 && inset <= room * half.x {
        let miter = rotate(normal, 0.5 * turn) * (disc.radius / half.x);
        put(miter, turn > CORNER, false);
    } else {
        put(normal * disc.radius, false, false);
        put(Vec2::ZERO, true, true);
        put(leaving.normal() * disc.radius, false, false);
    }
}

/// Number of chords for an arc; 0 if one point in its middle is enough.
fn arc_steps(radius: f64, turn: f64, tolerance: f64) -> usize {
    // A chord over an angle is radius * angle^2 / 8 away from its arc.
    let step = (2.0 * tolerance / radius.max(1e-9)).sqrt().min(0.6);
    if turn <= 0.5 * step {
        return 0;
    }
    (turn / step).ceil() as usize
}

/// Where the segment `a b` meets `c d`, if the way from one to the other turns left there.
///
/// With the shape on the right of the walk, a left turn means that the first segment enters the area beside the second.
/// Crossings the other way lead out of the shape, and the area between must stay.
fn cross(a: Point, b: Point, c: Point, d: Point) -> Option<Point> {
    let (ab, cd, ac) = (b - a, d - c, c - a);
    let area = ab.cross(cd);
    let within = 0.0..=area;
    let (s, t) = (ac.cross(cd), ac.cross(ab));
    (area > 0.0 && within.contains(&s) && within.contains(&t)).then(|| a + ab * (s / area))
}

/// A disc as a closed curve that winds as outlines do.
fn circle(disc: Disc, tolerance: f64) -> BezPath {
    let steps = arc_steps(disc.radius, std::f64::consts::TAU, tolerance).max(8);
    let points: Vec<Point> = (0..steps)
        .map(|k| {
            let angle = -std::f64::consts::TAU * k as f64 / steps as f64;
            disc.center + rotate(Vec2::new(disc.radius, 0.0), angle)
        })
        .collect();
    fit_with_corners(&points, &vec![false; steps], true, tolerance * 0.7)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const TOLERANCE: f64 = 0.08;

    fn stroke(points: &[[f64; 3]]) -> Vec<StrokePoint> {
        points
            .iter()
            .map(|[x, y, width]| StrokePoint {
                position: [*x, *y],
                width: *width,
                ..StrokePoint::default()
            })
            .collect()
    }

    /// Signed distance to the union of discs, by trying many discs.
    fn distance_to_discs(p: Point, points: &[StrokePoint], closed: bool) -> f64 {
        let count = points.len();
        let pieces = if closed { count } else { count - 1 };
        (0..pieces)
            .flat_map(|i| {
                let (a, b) = (points[i], points[(i + 1) % count]);
                let step = distance(a.position, b.position).max((a.width - b.width).abs());
                let steps = (step * 4.0).ceil().max(1.0);
                (0..=steps as usize).map(move |k| {
                    let t = k as f64 / steps;
                    let [x, y] =
                        [0, 1].map(|i| a.position[i] + (b.position[i] - a.position[i]) * t);
                    let radius = 0.5 * (a.width + (b.width - a.width) * t);
                    (p - Point::new(x, y)).hypot2().sqrt() - radius
                })
            })
            .fold(f64::INFINITY, f64::min)
    }

    fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
        ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
    }

    /// Asserts that exactly the union of discs is filled, but for `slack` pixels about its border.
    fn assert_fills_discs(points: &[StrokePoint], closed: bool, slack: f64) {
        use kurbo::Shape;
        let path = outline(points, closed, TOLERANCE);
        let frame = path.bounding_box().inflate(2.0, 2.0);
        let flat = flatten(&path);
        const GRID: usize = 32;
        for j in 0..GRID {
            for i in 0..GRID {
                let p = Point::new(
                    frame.x0 + frame.width() * (i as f64 + 0.37) / GRID as f64,
                    frame.y0 + frame.height() * (j as f64 + 0.61) / GRID as f64,
                );
                let outside = distance_to_discs(p, points, closed);
                let filled = winding(&flat, p) != 0;
                assert!(
                    if filled {
                        outside < slack
                    } else {
                        outside > -slack
                    },
                    "{p:?}: filled {filled}, distance {outside}, of {:?}",
                    points
                        .iter()
                        .map(|p| [p.position[0], p.position[1], p.width])
                        .collect::<Vec<_>>(),
                );
            }
        }
    }

    fn flatten(path: &BezPath) -> Vec<[Point; 2]> {
        let mut lines = Vec::new();
        let (mut start, mut here) = (Point::ZERO, Point::ZERO);
        kurbo::flatten(path, 0.005, |element| match element {
            kurbo::PathEl::MoveTo(p) => (start, here) = (p, p),
            kurbo::PathEl::LineTo(p) => {
                lines.push([here, p]);
                here = p;
            }
            _ => {
                lines.push([here, start]);
                here = start;
            }
        });
        lines
    }

    fn winding(lines: &[[Point; 2]], p: Point) -> i32 {
        lines
            .iter()
            .map(|[a, b]| {
                let side = (*b - *a).cross(p - *a);
                match (a.y <= p.y, b.y <= p.y) {
                    (true, false) if side > 0.0 => 1,
                    (false, true) if side < 0.0 => -1,
                    _ => 0,
                }
            })
            .sum()
    }

    /// Walks with few turns and smooth widths, zigzags, and dense noisy lines.
    fn lines() -> impl Strategy<Value = Vec<[f64; 3]>> {
        let wide = (-12.0..12.0f64, -12.0..12.0f64, 1.0..9.0f64);
        let dense = (0.2..1.2f64, -0.6..0.6f64, 3.0..5.0f64);
        let curl = (0.5..1.0f64, 0.0..0.7f64);
        let walk = |steps: Vec<(f64, f64, f64)>| {
            let mut here = [40.0, 40.0];
            steps
                .iter()
                .map(|(dx, dy, width)| {
                    here = [here[0] + dx, here[1] + dy];
                    [here[0], here[1], *width]
                })
                .collect::<Vec<_>>()
        };
        prop_oneof![
            prop::collection::vec(wide, 2..8).prop_map(walk),
            prop::collection::vec(dense, 3..40).prop_map(walk),
            prop::collection::vec(curl, 3..40).prop_map(|steps| {
                let (mut here, mut angle) = (DVec2::splat(40.0), 0.0);
                steps
                    .iter()
                    .enumerate()
                    .map(|(i, (step, turn))| {
                        angle += turn;
                        here += *step * DVec2::from_angle(angle);
                        [here.x, here.y, 2.0 + 0.2 * i as f64]
                    })
                    .collect()
            }),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn the_outline_fills_the_union_of_discs(points in lines(), closed: bool) {
            let points = stroke(&points);
            if discs_of(&points, closed).len() > 2 {
                assert_fills_discs(&points, closed, 0.3);
            }
        }

        #[test]
        fn any_numbers_give_a_finite_outline(
            points in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..12), closed: bool,
        ) {
            prop_assert!(outline(&stroke(&points), closed, TOLERANCE).is_finite());
        }
    }

    #[test]
    fn a_straight_even_line_is_a_stadium() {
        let points: Vec<[f64; 3]> = (0..100).map(|i| [f64::from(i), 20.0, 4.0]).collect();
        let path = outline(&stroke(&points), false, TOLERANCE);
        assert!(path.elements().len() <= 9, "{}", path.to_svg());
        assert_fills_discs(&stroke(&points), false, 0.15);
    }

    #[test]
    fn a_sharp_corner_of_dense_points_has_one_inner_point() {
        let down = (0..30).map(|i| [f64::from(i), 0.0, 6.0]);
        let right = (1..30).map(|i| [29.0, f64::from(i), 6.0]);
        let points: Vec<[f64; 3]> = down.chain(right).collect();
        let path = outline(&stroke(&points), false, TOLERANCE);
        assert!(path.elements().len() <= 14, "{}", path.to_svg());
        assert_fills_discs(&stroke(&points), false, 0.15);
    }

    #[test]
    fn a_closed_line_is_a_ring() {
        let points: Vec<[f64; 3]> = (0..90)
            .map(|i| {
                let d = DVec2::from_angle(f64::from(i) * 4f64.to_radians()) * 30.0;
                [d.x, d.y, 5.0]
            })
            .collect();
        let path = outline(&stroke(&points), true, TOLERANCE);
        assert_eq!(
            path.elements()
                .iter()
                .filter(|e| matches!(e, kurbo::PathEl::MoveTo(_)))
                .count(),
            2
        );
        assert!(path.elements().len() <= 24, "{}", path.elements().len());
        assert_fills_discs(&stroke(&points), true, 0.15);
    }

    #[test]
    fn a_disc_that_swallows_its_neighbour_is_filled() {
        let lines: [&[[f64; 3]]; 5] = [
            &[
                [40.0, 40.0, 8.781529433942906],
                [39.69915392232791, 42.29202542276073, 1.0],
                [44.522447180610754, 41.03710940851424, 7.238254998635625],
            ],
            &[
                [40.0, 40.0, 1.0],
                [44.937751387942804, 44.7232131459743, 1.4614137398213711],
                [40.24110082659484, 39.47253999199228, 8.164538233695156],
            ],
            &[
                [40.0, 40.0, 8.997858241899795],
                [44.826326932191456, 38.042166360850985, 1.0],
                [46.59578893933479, 32.79428515778122, 1.0],
                [46.12875042913454, 32.14784749326782, 8.33699959765384],
                [55.111267929347115, 28.470504786656733, 3.234715245494532],
                [55.111267929347115, 19.343110122085953, 2.6918535964483614],
            ],
            &[
                [40.0, 40.0, 7.557999258004244],
                [29.669839291948577, 31.444268408040294, 8.21620265039535],
                [29.207580742051036, 31.945044479850694, 1.0],
            ],
            &[
                [40.0, 40.0, 1.0],
                [40.26402000230203, 40.04235327431522, 7.543824037561096],
                [40.26402000230203, 40.04235327431522, 1.0],
                [40.26402000230203, 40.04235327431522, 1.0],
                [40.26402000230203, 46.999124068850655, 1.0],
            ],
        ];
        for line in lines {
            for closed in [false, true] {
                assert_fills_discs(&stroke(line), closed, 0.3);
            }
        }
    }

    #[test]
    fn what_is_no_line_has_no_outline() {
        assert!(outline(&[], false, TOLERANCE).is_empty());
        assert!(outline(&stroke(&[[1.0, 1.0, 3.0]; 5]), true, TOLERANCE).is_empty());
        assert!(
            outline(
                &stroke(&[[1.0, 1.0, 0.0], [9.0, 1.0, f64::NAN]]),
                false,
                TOLERANCE
            )
            .is_empty()
        );
    }
}
