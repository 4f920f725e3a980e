//! How far a path along pixel edges is straight [Selinger 2003, 2.2.1].

use super::decompose::STEPS;

/// For every corner of a closed path, how many steps from there on are straight.
///
/// `steps` are directions as in [`PixelLoop::steps`](super::PixelLoop::steps). A stretch is straight where one line segment comes within half a pixel,
/// along each axis, of all its corners in order, and where it does not go in all four directions. By the paper's
/// theorem that is so where every three corners of it pass the test: the middle one lies within one pixel, along each axis,
/// of the line through the outer two.
///
/// O(n t) for n steps and at most t turns in a stretch.
///
/// Differs: the paper tests every corner; here only those at which the path turns, since a line that comes within a pixel of
/// both ends of a run comes as near to all between.
pub fn straight_lengths(steps: &[u8]) -> Vec<u32> {
    let mut lengths = Vec::new();
    measure(steps, &mut lengths);
    lengths
}

/// [`straight_lengths`] into a vector that is used again.
pub(super) fn measure(steps: &[u8], lengths: &mut Vec<u32>) {
    let n = steps.len();
    lengths.clear();
    lengths.resize(n, 0);
    let runs = Run::all(steps);
    let (Some(first), Some(last)) = (runs.first(), steps.last()) else {
        return;
    };
    // A stretch is straight only if all within it are: none ends after the one that starts a step later.
    let mut most = n as u32;
    let seam = if first.direction() == *last & 3 {
        first.length()
    } else {
        0
    };
    let mut from = n;
    for (index, run) in runs.iter().enumerate().rev() {
        let tail = if index + 1 == runs.len() { seam } else { 0 };
        for left in 1..=run.length() {
            from -= 1;
            most = length_from(&runs, index, left, tail, most + 1);
            lengths[from] = most;
        }
    }
    // Around the seam: the last stretches end no later than the first ones.
    for length in lengths.iter_mut().rev() {
        most += 1;
        if *length <= most {
            break;
        }
        *length = most;
    }
}

/// Steps in one direction: the lowest two bits are the direction, the others count.
#[derive(Debug, Clone, Copy)]
struct Run(u32);

impl Run {
    fn all(steps: &[u8]) -> Vec<Self> {
        let runs = steps.chunk_by(|a, b| a == b).filter_map(|run| {
            let direction = u32::from(*run.first()? & 3);
            Some(Self((run.len() as u32) << 2 | direction))
        });
        runs.collect()
    }

    fn direction(self) -> u8 {
        (self.0 & 3) as u8
    }

    fn length(self) -> u32 {
        self.0 >> 2
    }
}

/// How many steps from a corner on are straight by the triples that begin there, at most `most`.
///
/// The corner has `left` steps of the run `index` before it, and `tail` more where that run goes on over the seam.
#[inline]
fn length_from(runs: &[Run], index: usize, left: u32, tail: u32, most: u32) -> u32 {
    let mut cone = Cone::default();
    let mut seen = 0u8;
    let mut place = [0i32; 2];
    let mut length = 0;
    let following = runs
        .iter()
        .skip(index + 1)
        .chain(runs.iter().skip(usize::from(tail > 0)));
    let mut direction = runs.get(index).map_or(0, |run| run.direction());
    let mut count = left + tail;
    for next in following {
        seen |= 1 << direction;
        if seen == 0b1111 {
            return length;
        }
        let step = STEPS[usize::from(direction)];
        let wanted = count.min(most - length);
        let inside = cone.steps_inside(place, step, wanted);
        length += inside;
        if inside < count {
            return length;
        }
        let far = inside as i32;
        place = [place[0] + step[0] * far, place[1] + step[1] * far];
        cone.narrow(place);
        (direction, count) = (next.direction(), next.length());
    }
    // Twice around a closed path: it has all four directions, and was left before.
    length
}

/// The directions from a corner that pass within a pixel, along each axis, of all corners seen.
///
/// Bounded by two vectors: allowed is what lies to the left of `right` and to the right of `left`, with y up; as long as both are
/// zero, everything.
#[derive(Debug, Clone, Copy, Default)]
struct Cone {
    left: [i32; 2],
    right: [i32; 2],
}

impl Cone {
    /// How many steps can be made from a place, at most `count`, without leaving the cone.
    #[inline]
    fn steps_inside(&self, place: [i32; 2], step: [i32; 2], count: u32) -> u32 {
        // Signed areas are linear along the run, and not below 0 at its start.
        let bounded = |bound: i64, change: i64| {
            if change < 0 && bound + change * i64::from(count) < 0 {
                (bound / -change) as u32
            } else {
                count
            }
        };
        let by_right = bounded(cross(self.right, place), cross(self.right, step));
        let by_left = bounded(-cross(self.left, place), -cross(self.left, step));
        by_right.min(by_left)
    }

    /// Leaves of the cone what passes within a pixel of a place.
    #[inline]
    fn narrow(&mut self, [x, y]: [i32; 2]) {
        // From so near every direction does.
        if x.abs() <= 1 && y.abs() <= 1 {
            return;
        }
        // The corners of the square around the place that stand furthest to the left and right; of two in line, the nearer.
        let left = [
            x + if y < 0 || (y == 0 && x < 0) { 1 } else { -1 },
            y + if x > 0 || (x == 0 && y < 0) { 1 } else { -1 },
        ];
        let right = [
            x + if y > 0 || (y == 0 && x < 0) { 1 } else { -1 },
            y + if x < 0 || (x == 0 && y < 0) { 1 } else { -1 },
        ];
        if self.left == [0; 2] || cross(left, self.left) >= 0 {
            self.left = left;
        }
        if self.right == [0; 2] || cross(self.right, right) >= 0 {
            self.right = right;
        }
    }
}

/// Twice the signed area between two vectors; positive where the second points to the left of the first, with y up.
#[inline]
fn cross(a: [i32; 2], b: [i32; 2]) -> i64 {
    i64::from(a[0]) * i64::from(b[1]) - i64::from(a[1]) * i64::from(b[0])
}
