//! Arcs joined to fewer arcs [Selinger 2003, 2.4].

use super::curve::{Bend, Segment, segment};
use glam::DVec2;

/// Cosine of 179 degrees, the most that a joined arc may turn.
const TURN_LIMIT: f64 = -0.999_847_695_156_391_3;

/// The curve of [`curve()`](super::curve()), with consecutive arcs joined where one arc does.
///
/// It has the fewest segments, and of those the least sum of squared distances; the first segment starts where the first
/// bend's arc ends. Arcs may be joined that bend to the same side, by less than 179 degrees together, where
/// an arc with the same ends, the same tangents there and the same area stays near: where it is parallel to a side of the
/// polygon, it lies within `tolerance` pixels of it, and where it is parallel to an arc's chord, no more than that further
/// inside than the arc did.
///
/// O(n t) arcs are tried for n bends, of which t turn by half a circle.
pub fn join_arcs(bends: &[Bend], tolerance: f64) -> Vec<Segment> {
    let mut joiner = Joiner::default();
    joiner.run(bends, tolerance)
}

/// The search for joined curves, with its memory kept from loop to loop.
#[derive(Debug, Default)]
pub(super) struct Joiner {
    /// Twice around, and two more.
    bends: Vec<Bend>,
    /// The best way to every bend.
    best: Vec<Step>,
    /// Which side every bend turns to.
    turns: Vec<f64>,
    /// Sums of signed areas up to every bend.
    areas: Vec<f64>,
}

/// The best way to the end of a bend's arc.
#[derive(Debug, Clone, Copy)]
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
    /// Joins what can be joined.
    pub fn run(&mut self, bends: &[Bend], tolerance: f64) -> Vec<Segment> {
        let count = bends.len();
        if count < 3 {
            return super::curve(bends);
        }
        self.prepare(bends);
        self.best.clear();
        self.best.push(Step {
            count: 0,
            penalty: 0.0,
            from: 0,
            arc: None,
        });
        for end in 1..=count {
            let step = self.best_to(end, count, tolerance);
            self.best.push(step);
        }
        self.collect(count)
    }

    fn prepare(&mut self, bends: &[Bend]) {
        let count = bends.len();
        self.bends.clear();
        self.bends.extend(bends.iter().cycle().take(2 * count + 2));
        self.turns.clear();
        self.areas.clear();
        let origin = bends[0].corner;
        let mut area = 0.0;
        for index in 0..=count {
            let before = self.bends[index + count - 1].corner;
            let bend = &self.bends[index + count];
            let after = self.bends[index + count + 1].corner;
            let corner = bend.corner;
            let turn = (corner - before).perp_dot(after - corner);
            self.turns
                .push(if bend.alpha.is_none() { 0.0 } else { turn });
            // Up to the end of the first bend's arc nothing is summed.
            if index > 0 {
                let (start, end) = (before.midpoint(corner), corner.midpoint(after));
                if let Some(alpha) = bend.alpha {
                    let triangle = (corner - start).perp_dot(end - start);
                    area += 0.3 * alpha * (4.0 - alpha) * triangle;
                }
                area += (start - origin).perp_dot(end - origin);
            }
            self.areas.push(area);
        }
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
            // Not in the paper, and measured on the program Potrace: beyond arcs that cannot be joined none longer are tried.
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

    /// Whether the bends after one and up to another turn to one side, by less than the limit; those after the next are known to.
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
        let origin = self.corner(0);
        let area = self.areas[end] - self.areas[start] - (p0 - origin).perp_dot(p3 - origin);
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

    fn collect(&self, count: usize) -> Vec<Segment> {
        let mut segments = Vec::with_capacity(self.best[count].count as usize);
        let mut end = count;
        while end > 0 {
            let step = &self.best[end];
            let place = self.end(end);
            segments.push(match step.arc {
                Some(arc) => Segment::Arc {
                    from: arc.from,
                    to: arc.to,
                    end: place,
                },
                None => segment(self.end(end - 1), &self.bends[end], place),
            });
            end = step.from;
        }
        segments.reverse();
        segments
    }
}

/// The place at which an arc is parallel to a direction.
///
/// Not in the paper, and measured on the program Potrace: for an arc in the place of a pair there is none where the equation for it
/// is linear, as for pairs that are each other's mirror image. They stay apart.
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
