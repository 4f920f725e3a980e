//! Stretches of a path that move backwards along it, and whether they are straight: for long stretches with many turns.

use super::decompose::STEPS;

/// A straight stretch whose start goes back corner by corner and whose end is cut off as needed.
///
/// A stretch in at most three directions runs one way along an axis, here called u, and back and forth along v. It is
/// straight where some line `v = s u + c` comes within half a pixel, along each axis, of all corners: where for every
/// two of them `(v - v') - s (u - u') <= 1 + |s|`. Only corners of the convex hull matter, which are few, since a
/// stretch with one corner too many still lies in a narrow strip of the grid.
///
/// The stretch is held in two parts, each with its hull: a front that grows towards the start, and a back that loses
/// what was added last. When the back is used up, the front becomes the back, so a corner enters hulls twice at most
/// as long as the axis stays; O(log^2 n) for a step of a stretch of n corners.
#[derive(Debug)]
pub(super) struct Strip<'a> {
    steps: &'a [u8],
    /// The first and the last corner, by the steps before them; the last may lie beyond the seam.
    first: usize,
    last: usize,
    /// The last corner of the front.
    pivot: usize,
    /// How many steps there are in every direction.
    counts: [u32; 4],
    /// The direction that does not occur.
    missing: u8,
    /// Where the first corner lies.
    place: [i32; 2],
    front: Hull,
    back: Hull,
    /// How many corners were put into hulls, and corners of hulls held against each other.
    pub looks: u64,
}

impl<'a> Strip<'a> {
    /// The stretch between two corners of a closed path, which is straight.
    pub fn new(steps: &'a [u8], first: usize, last: usize) -> Self {
        let mut strip = Self {
            steps,
            first,
            last,
            pivot: first,
            counts: [0; 4],
            missing: 0,
            place: [0; 2],
            front: Hull::default(),
            back: Hull::default(),
            looks: 0,
        };
        for at in first..last {
            strip.counts[usize::from(strip.direction(at))] += 1;
        }
        strip.make_back();
        strip
    }

    /// Puts the start a step back, and takes from the end what is more than `most` steps or not straight any more.
    /// Gives the steps left.
    pub fn step_back(&mut self, most: u32) -> u32 {
        // Add the step before the start.
        self.first -= 1;
        let direction = self.direction(self.first);
        self.counts[usize::from(direction)] += 1;
        let step = STEPS[usize::from(direction)];
        self.place = [self.place[0] - step[0], self.place[1] - step[1]];

        // Drop steps beyond the most, and until a direction is missing.
        while self.last - self.first > most as usize || self.counts.iter().all(|count| *count > 0) {
            self.drop_last();
        }
        if self.counts[usize::from(self.missing)] > 0 {
            self.make_back();
        } else {
            self.front.push(turned(self.place, self.missing), -1);
            self.trim_back();
        }

        // Drop steps until the rest is straight.
        while !self.is_straight() {
            self.drop_last();
            self.trim_back();
        }
        (self.last - self.first) as u32
    }

    fn direction(&self, at: usize) -> u8 {
        self.steps[at % self.steps.len()] & 3
    }

    /// Leaves the last corner out; the back holds it until it is trimmed.
    fn drop_last(&mut self) {
        self.last -= 1;
        self.counts[usize::from(self.direction(self.last))] -= 1;
    }

    /// Takes from the back what lies after the last corner.
    fn trim_back(&mut self) {
        if self.last < self.pivot {
            return self.make_back();
        }
        while self.back.len() > self.last - self.pivot {
            self.back.undo();
        }
    }

    /// Puts all corners into the back, seen along the axis that they run one way along.
    fn make_back(&mut self) {
        let missing = self.counts.iter().position(|count| *count == 0);
        self.missing = missing.unwrap_or(0) as u8;
        self.pivot = self.first;
        self.front.clear();
        self.back.clear();
        let mut place = self.place;
        self.front.push(turned(place, self.missing), -1);
        for at in self.first..self.last {
            let step = STEPS[usize::from(self.direction(at))];
            place = [place[0] + step[0], place[1] + step[1]];
            self.back.push(turned(place, self.missing), 1);
        }
        self.looks += (self.last - self.first) as u64;
    }

    fn is_straight(&mut self) -> bool {
        let [front, back] = [&self.front, &self.back];
        self.looks += (front.upper.count + back.upper.count) as u64
            * (front.lower.count + back.lower.count) as u64;
        [1, -1].into_iter().any(|sign| {
            let mut slopes = Slopes::default();
            let lower = || front.lower.places().chain(back.lower.places());
            let mut upper = front.upper.places().chain(back.upper.places());
            upper.all(|p| lower().all(|q| slopes.narrow(p, q, sign)))
        })
    }
}

/// A place by its axes u and v: along u, steps other than in the missing direction never go back.
fn turned([x, y]: [i32; 2], missing: u8) -> [i32; 2] {
    match missing {
        0 => [-x, y],
        1 => [y, x],
        2 => [x, y],
        _ => [-y, x],
    }
}

/// Slopes of one sign, by their size, that are steep and flat enough: `least.0 / least.1` up to `most.0 / most.1`.
#[derive(Debug, Clone, Copy)]
struct Slopes {
    least: (i64, i64),
    most: (i64, i64),
}

impl Default for Slopes {
    fn default() -> Self {
        Self {
            least: (0, 1),
            most: (1, 0),
        }
    }
}

impl Slopes {
    /// Leaves the slopes with which the place p is not too far above q; whether there are any.
    #[inline]
    fn narrow(&mut self, p: [i32; 2], q: [i32; 2], sign: i64) -> bool {
        // With the slope sign r: r (sign (qu - pu) - 1) <= 1 - (pv - qv).
        let factor = sign * i64::from(q[0] - p[0]) - 1;
        let bound = 1 - i64::from(p[1] - q[1]);
        match factor.signum() {
            1 if bound * self.most.1 < self.most.0 * factor => self.most = (bound, factor),
            -1 if -bound * self.least.1 > self.least.0 * -factor => self.least = (-bound, -factor),
            0 if bound < 0 => return false,
            _ => return true,
        }
        self.least.0 * self.most.1 <= self.most.0 * self.least.1
    }
}

/// The convex hull of places that come in order along u.
#[derive(Debug)]
struct Hull {
    upper: Side,
    lower: Side,
}

impl Default for Hull {
    fn default() -> Self {
        Self {
            upper: Side::new(1),
            lower: Side::new(-1),
        }
    }
}

impl Hull {
    fn clear(&mut self) {
        self.upper.clear();
        self.lower.clear();
    }

    /// How many places it is made of.
    fn len(&self) -> usize {
        self.upper.taken.len()
    }

    /// Adds a place that none so far is beyond: `along` is 1 where u grows from place to place, else -1.
    fn push(&mut self, place: [i32; 2], along: i64) {
        self.upper.push(place, along);
        self.lower.push(place, along);
    }

    /// Takes away what was added last.
    fn undo(&mut self) {
        self.upper.undo();
        self.lower.undo();
    }
}

/// The corners of a hull's upper or lower side.
#[derive(Debug)]
struct Side {
    /// 1 for the upper side, -1 for the lower.
    up: i64,
    /// The corners, then what was once there and may come back.
    corners: Vec<[i32; 2]>,
    count: usize,
    /// For every place added, how many corners there were, and the one that it took the place of; none if it is no
    /// corner.
    taken: Vec<Option<(usize, [i32; 2])>>,
}

impl Side {
    fn new(up: i64) -> Self {
        Self {
            up,
            corners: Vec::new(),
            count: 0,
            taken: Vec::new(),
        }
    }

    fn clear(&mut self) {
        self.count = 0;
        self.corners.clear();
        self.taken.clear();
    }

    fn places(&self) -> impl Iterator<Item = [i32; 2]> {
        self.corners.iter().take(self.count).copied()
    }

    fn push(&mut self, place: [i32; 2], along: i64) {
        let mut at = self.count;
        if at > 0 && self.corners[at - 1][0] == place[0] {
            if i64::from(place[1] - self.corners[at - 1][1]) * self.up <= 0 {
                return self.taken.push(None);
            }
            at -= 1;
        }
        while at > 1
            && turn(self.corners[at - 2], self.corners[at - 1], place) * along * self.up >= 0
        {
            at -= 1;
        }
        if at == self.corners.len() {
            self.corners.push(place);
        }
        let before = std::mem::replace(&mut self.corners[at], place);
        self.taken.push(Some((self.count, before)));
        self.count = at + 1;
    }

    fn undo(&mut self) {
        if let Some(Some((count, before))) = self.taken.pop() {
            self.corners[self.count - 1] = before;
            self.count = count;
        }
    }
}

/// Twice the signed area of a triangle, positive where it turns from u to v.
fn turn(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i64 {
    let [bu, bv, cu, cv] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]].map(i64::from);
    bu * cv - bv * cu
}
