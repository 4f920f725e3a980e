//! Arcs joined to fewer arcs [Selinger 2003, 2.4].

use super::curve::{Bend, Segment, segment};
use glam::DVec2;

/// Cosine of 179 degrees, the most that a joined arc may turn.
const TURN_LIMIT: f64 = -0.999_847_695_156_391_3;

/// The curve of [`curve()`](super::curve()), with consecutive arcs joined where one arc does.
///
/// It has the fewest segments, and of those the least sum of squared distances; the first segment starts where the
/// first bend's arc ends. Arcs may be joined that bend to the same side, by less than 179 degrees together, where an
/// arc with the same ends, the same tangents there and the same area stays near: where it is parallel to a side of
/// the polygon, it lies within `tolerance` pixels of it, and where it is parallel to an arc's chord, no more than
/// that further inside than the arc did.
///
/// O(n t) arcs are tried for n bends, of which t turn by half a circle.
pub fn join_arcs(bends: &[Bend], tolerance: f64) -> Vec<Segment> {
    let mut segments = Vec::new();
    let bend = |index| bends[index];
    Joiner::default().run(bends.len(), bend, tolerance, |s| segments.push(s));
    segments
}

/// The search for joined curves, with its memory kept from loop to loop.
///
/// No arc goes past a bend that turns to the other side, or not at all, so bends are taken stretch by stretch, as far
/// as they turn to one side. They are numbered from the one before the stretch, which is 0.
#[derive(Debug, Default)]
pub(super) struct Joiner {
    /// Those of the stretch, one before and one after.
    bends: Vec<Bend>,
    /// The best way to every bend.
    best: Vec<Step>,
    /// Which side every bend turns to.
    turns: Vec<f64>,
    /// Sums of signed areas up to every bend, from the loop's first on.
    areas: Vec<f64>,
    /// Whence areas are summed.
    origin: DVec2,
    /// Segments of the stretch, the last one first.
    segments: Vec<Segment>,
}

/// The best way to the end of a bend's arc.
#[derive(Debug, Clone, Copy, Default)]
struct Step {
    count: u32,
    penalty: f64,
    from: usize,
    arc: Option<Arc>,
}

/// An arc in the place of several, and how far it is off.
#[derive(Debug, Clone, Copy)]
struct Arc {
    from: DVec2,
    to: DVec2,
    penalty: f64,
}

impl Joiner {
    /// Joins what can be joined of so many bends, and draws segment by segment, from the end of the arc at bend 0.
    pub fn run(
        &mut self,
        count: usize,
        bend: impl Fn(usize) -> Bend,
        tolerance: f64,
        mut draw: impl FnMut(Segment),
    ) {
        // Two bends or fewer have nothing to join.
        if count < 3 {
            return super::curve::draw_curve(count, bend, draw);
        }
        self.bends.clear();
        self.origin = bend(0).corner;
        let mut before = Step::default();
        let mut area = 0.0;
        let mut first = 1;
        while first <= count {
            // Take bends up to the next that turns the other way.
            area = self.take_stretch(first, count, &bend, area);
            self.best.clear();
            self.best.push(before);

            // Find for each bend the fewest arcs that lead to it.
            let last = self.turns.len() - 1;
            for end in 1..=last {
                let step = self.best_to(end, count, tolerance);
                self.best.push(step);
            }

            // Draw them, and go on from there.
            before = self.best[last];
            self.collect(last, &mut draw);
            self.bends.drain(..last);
            first += last;
        }
    }

    /// Takes bends from one on, as long as they turn to one side; gives the sum of areas up to the last one.
    fn take_stretch(
        &mut self,
        first: usize,
        count: usize,
        bend: &impl Fn(usize) -> Bend,
        mut area: f64,
    ) -> f64 {
        self.turns.clear();
        self.turns.push(0.0);
        self.areas.clear();
        self.areas.push(area);
        for index in 1..=count + 1 - first {
            // Look one bend ahead.
            while self.bends.len() < index + 2 {
                let next = first - 1 + self.bends.len();
                self.bends
                    .push(bend(if next >= count { next - count } else { next }));
            }

            // End the stretch where the line turns the other way.
            let turn = self.turn(index);
            if index > 1 && turn * self.turns[1] <= 0.0 {
                break;
            }
            self.turns.push(turn);

            // Sum up the area under the curve.
            let bend = &self.bends[index];
            let (start, end) = (self.end(index - 1), self.end(index));
            if let Some(alpha) = bend.alpha {
                let triangle = (bend.corner - start).perp_dot(end - start);
                area += 0.3 * alpha * (4.0 - alpha) * triangle;
            }
            area += (start - self.origin).perp_dot(end - self.origin);
            self.areas.push(area);
        }
        area
    }

    /// Twice the signed area of a bend's triangle; 0 for a corner.
    fn turn(&self, index: usize) -> f64 {
        let [before, corner, after] = [index - 1, index, index + 1].map(|i| self.corner(i));
        if self.bends[index].alpha.is_none() {
            return 0.0;
        }
        (corner - before).perp_dot(after - corner)
    }

    /// The corner of a bend.
    fn corner(&self, index: usize) -> DVec2 {
        self.bends[index].corner
    }

    /// Where a bend's arc ends.
    fn end(&self, index: usize) -> DVec2 {
        self.corner(index).midpoint(self.corner(index + 1))
    }

    fn best_to(&self, end: usize, count: usize, tolerance: f64) -> Step {
        let last = self.best[end - 1];
        let mut best = Step {
            count: last.count + 1,
            penalty: last.penalty,
            from: end - 1,
            arc: None,
        };
        for start in (0..end.saturating_sub(1)).rev() {
            if end - start >= count || !self.may_join(start, end) {
                break;
            }
            // Not in the paper, and measured on the program Potrace: beyond arcs that cannot be joined none longer
            // are tried.
            let Some(arc) = self.arc(start, end, tolerance) else {
                break;
            };
            let before = self.best[start];
            let (pieces, penalty) = (before.count + 1, before.penalty + arc.penalty);
            if pieces < best.count || (pieces == best.count && penalty <= best.penalty) {
                best = Step {
                    count: pieces,
                    penalty,
                    from: start,
                    arc: Some(arc),
                };
            }
        }
        best
    }

    /// Whether the bends after one and up to another turn to one side, by less than the limit; those after the next
    /// are known to.
    fn may_join(&self, start: usize, end: usize) -> bool {
        let [first, last] = [self.turns[start + 1], self.turns[end]];
        if first * last <= 0.0 {
            return false;
        }
        let out = self.corner(start + 1) - self.corner(start);
        (start + 1..=end).all(|index| {
            let side = self.corner(index + 1) - self.corner(index);
            out.perp_dot(side) * last > 0.0
                && out.dot(side)
                    > TURN_LIMIT * (out.length_squared() * side.length_squared()).sqrt()
        })
    }

    /// The arc from the end of one bend's to that of another, if it is near enough to those between.
    fn arc(&self, start: usize, end: usize, tolerance: f64) -> Option<Arc> {
        let [p0, p3] = [self.end(start), self.end(end)];
        let out = self.corner(start + 1) - self.corner(start);
        let back = self.corner(end) - self.corner(end + 1);
        let meet = p0 + out * ((p3 - p0).perp_dot(back) / out.perp_dot(back));
        let triangle = (meet - p0).perp_dot(p3 - p0);
        let [from, to] = [p0, p3].map(|p| p - self.origin);
        let area = self.areas[end] - self.areas[start] - from.perp_dot(to);
        // The area below an arc is 0.3 alpha (4 - alpha) of its triangle's.
        let share = area / triangle / 0.3;
        if share.is_nan() || share > 4.0 {
            return None;
        }
        let alpha = 2.0 - (4.0 - share).sqrt();
        let cubic = [p0, p0.lerp(meet, alpha), p3.lerp(meet, alpha), p3];
        let penalty = self.penalty(start, end, &cubic, tolerance)?;
        Some(Arc {
            from: cubic[1],
            to: cubic[2],
            penalty,
        })
    }

    /// The sum of squared distances of an arc from the polygon and from the arcs that it replaces, if all are small.
    fn penalty(&self, start: usize, end: usize, cubic: &[DVec2; 4], tolerance: f64) -> Option<f64> {
        let mut penalty = 0.0;
        let is_pair = end - start == 2;
        for index in start + 1..end {
            // Each side must touch the arc within the tolerance.
            let [from, to] = [self.corner(index), self.corner(index + 1)];
            let side = to - from;
            let touch = touch(cubic, side, is_pair)?;
            let distance = (touch - from).perp_dot(side) / side.length();
            let along = (touch - from).dot(side);
            if distance.abs() > tolerance || along < 0.0 || along > side.length_squared() {
                return None;
            }
            penalty += distance * distance;
        }
        for index in start + 1..=end {
            // So must each bend.
            let bend = &self.bends[index];
            let from = self.end(index - 1);
            let chord = self.end(index) - from;
            let touch = touch(cubic, chord, is_pair)?;
            let mut distance = (touch - from).perp_dot(chord) / chord.length();
            let mut reach = (bend.corner - from).perp_dot(chord) / chord.length();
            reach *= 0.75 * bend.alpha.unwrap_or(1.0);
            if reach < 0.0 {
                (distance, reach) = (-distance, -reach);
            }
            if distance < reach - tolerance {
                return None;
            }
            if distance < reach {
                penalty += (distance - reach) * (distance - reach);
            }
        }
        Some(penalty)
    }

    /// Draws the best way to a bend.
    fn collect(&mut self, last: usize, draw: &mut impl FnMut(Segment)) {
        self.segments.clear();
        let mut end = last;
        while end > 0 {
            let step = &self.best[end];
            let place = self.end(end);
            self.segments.push(match step.arc {
                Some(arc) => Segment::Arc {
                    from: arc.from,
                    to: arc.to,
                    end: place,
                },
                None => segment(self.end(end - 1), &self.bends[end], place),
            });
            end = step.from;
        }
        while let Some(segment) = self.segments.pop() {
            draw(segment);
        }
    }
}

/// The place at which an arc is parallel to a direction.
///
/// Not in the paper, and measured on the program Potrace: for an arc in the place of a pair there is none where the
/// equation for it is linear, as for pairs that are each other's mirror image. They stay apart.
fn touch(cubic: &[DVec2; 4], direction: DVec2, is_pair: bool) -> Option<DVec2> {
    let [a, b, c] = [0, 1, 2].map(|i| (cubic[i + 1] - cubic[i]).perp_dot(direction));
    // a (1 - t)^2 + 2 b t (1 - t) + c t^2 = 0
    let (square, linear) = (a - 2.0 * b + c, 2.0 * (b - a));
    if square == 0.0 && is_pair {
        return None;
    }
    let root = (linear * linear - 4.0 * square * a).sqrt();
    if root.is_nan() {
        return None;
    }
    // Both in the form that does not cancel.
    let sum = -0.5 * (linear + root.copysign(linear));
    let within = |t: &f64| (0.0..=1.0).contains(t);
    let t = [sum / square, a / sum].into_iter().find(within)?;
    let s = 1.0 - t;
    let at = cubic[0] * (s * s * s)
        + cubic[1] * (3.0 * s * s * t)
        + cubic[2] * (3.0 * s * t * t)
        + cubic[3] * (t * t * t);
    Some(at)
}
