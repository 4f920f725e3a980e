//! How far a path along pixel edges is straight [Selinger 2003, 2.2.1].

use super::decompose::STEPS;
use super::strip::Strip;
use std::ops::Range;

/// Paths longer than this many steps are measured on several threads.
const PIECE_STEPS: usize = 1 << 11;

/// Stretches of more runs than this are followed from corner to corner by their hulls, instead of being walked anew
/// from each.
///
/// About where both take the same time.
const LONG_RUNS: usize = 128;

/// For every corner of a closed path, how many steps from there on are straight.
///
/// `steps` are directions as in [`PixelLoop::steps`](super::PixelLoop::steps). A stretch is straight where one line
/// segment comes within half a pixel, along each axis, of all its corners in order, and where it does not go in all
/// four directions. By the paper's theorem that is so where every three corners of it pass the test: the middle one
/// lies within one pixel, along each axis, of the line through the outer two.
///
/// O(n t) for n steps and t turns in a stretch, of which at most 128 count; beyond that, O(n log^2 t).
///
/// Differs: the paper tests every corner; here only those at which the path turns, since a line that comes within a
/// pixel of both ends of a run comes as near to all between.
pub fn straight_lengths(steps: &[u8]) -> Vec<u32> {
    let mut lengths = Vec::new();
    measure(steps, steps.len() as u32, &mut lengths);
    lengths
}

/// [`straight_lengths`], of which none is more than `limit`, into a vector that is used again. Gives how many runs
/// and corners were looked at.
pub(super) fn measure(steps: &[u8], limit: u32, lengths: &mut Vec<u32>) -> u64 {
    measure_from(steps, limit, LONG_RUNS, lengths)
}

/// [`measure`], with stretches of more than `long_runs` runs followed by their hulls.
pub(super) fn measure_from(
    steps: &[u8],
    limit: u32,
    long_runs: usize,
    lengths: &mut Vec<u32>,
) -> u64 {
    let n = steps.len();
    lengths.clear();
    lengths.resize(n, 0);
    let runs = Run::all(steps);
    let whole = Path {
        steps,
        runs: &runs,
        // The last run may go on where the first one stands.
        seam: match (runs.first(), steps.last()) {
            (Some(first), Some(last)) if first.direction() == *last & 3 => first.length(),
            _ => 0,
        },
        limit: limit.min(n as u32),
        long_runs,
    };
    let looks = whole.measure(0..runs.len(), 0, lengths);
    // A stretch is straight only if all within it are: none ends after one that starts a step later. The last ones are
    // followed by the first.
    let mut most = lengths.first().map_or(0, |first| first.saturating_add(1));
    for _ in 0..2 {
        for length in lengths.iter_mut().rev() {
            *length = most.min(*length);
            most = *length + 1;
        }
    }
    looks
}

/// A closed path, run by run.
struct Path<'a> {
    steps: &'a [u8],
    runs: &'a [Run],
    /// Steps by which the last run goes on over the seam.
    seam: u32,
    /// Nothing longer is looked for.
    limit: u32,
    /// Stretches of more runs are followed by their hulls.
    long_runs: usize,
}

impl Path<'_> {
    /// Measures from every corner of some runs on; `lengths` are those of these runs' steps, the first of which is
    /// number `from`. Long paths are halved for other threads. Gives how much was looked at.
    fn measure(&self, runs: Range<usize>, from: usize, lengths: &mut [u32]) -> u64 {
        let middle = runs.start + runs.len() / 2;
        if lengths.len() > PIECE_STEPS && runs.len() > 1 {
            let part = self.runs.get(runs.start..middle).unwrap_or(&[]);
            let count: u32 = part.iter().map(|run| run.length()).sum();
            let (first, second) = lengths.split_at_mut(count as usize);
            let (a, b) = rayon::join(
                || self.measure(runs.start..middle, from, first),
                || self.measure(middle..runs.end, from + count as usize, second),
            );
            return a + b;
        }
        let mut most = self.limit;
        let mut looks = 0;
        let mut strip: Option<Strip<'_>> = None;
        let mut corner = from + lengths.len();
        let mut places = lengths.iter_mut().rev();
        for index in runs.rev() {
            let run = self.runs[index];
            let tail = if index + 1 == self.runs.len() {
                self.seam
            } else {
                0
            };
            for (left, place) in (1..=run.length()).zip(&mut places) {
                corner -= 1;
                if let Some(moving) = &mut strip {
                    most = moving.step_back(self.limit);
                    *place = most;
                    if (most as usize) < self.long_runs / 2 {
                        looks += moving.looks;
                        strip = None;
                    }
                    continue;
                }
                // No longer than from the step after, which saves looking further.
                let most_here = self.limit.min(most + 1);
                let skipped = usize::from(tail > 0);
                let seen;
                (most, seen) = self.length_from(index, left + tail, skipped, most_here);
                *place = most;
                looks += seen as u64;
                if seen > self.long_runs && most > 1 {
                    strip = Some(Strip::new(self.steps, corner, corner + most as usize));
                }
            }
        }
        looks + strip.map_or(0, |strip| strip.looks)
    }

    /// How many steps from a corner on are straight by the triples that begin there, at most `most`; and how many
    /// runs that took.
    ///
    /// The corner has `left` steps before it in the direction of the run `index`, which may take in the first
    /// `skipped` runs.
    #[inline]
    fn length_from(&self, index: usize, left: u32, skipped: usize, most: u32) -> (u32, usize) {
        // Begin at the corner, with a cone that holds everything.
        let mut cone = Cone::default();
        let mut seen = 0u8;
        let mut place = [0i32; 2];
        let mut length = 0;
        let mut looks = 0;
        let mut next = index + 1;
        let (mut direction, mut count) = (self.runs[index].direction(), left);
        loop {
            // Give up once all four directions have been seen.
            looks += 1;
            seen |= 1 << direction;
            if seen == 0b1111 {
                return (length, looks);
            }

            // Stop where the run leaves the cone.
            let step = STEPS[usize::from(direction)];
            let end = [
                place[0] + step[0] * count as i32,
                place[1] + step[1] * count as i32,
            ];
            if !cone.holds(end) {
                let length = length + cone.steps_inside(place, step, count);
                return (most.min(length), looks);
            }
            length += count;
            if length >= most {
                return (most, looks);
            }

            // Narrow the cone, and take the next run, around the loop.
            place = end;
            cone.narrow(place);
            if next >= self.runs.len() {
                next = skipped;
            }
            let run = self.runs[next];
            (direction, count) = (run.direction(), run.length());
            next += 1;
        }
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

/// The directions from a corner that pass within a pixel, along each axis, of all corners seen.
///
/// Bounded by two vectors: allowed is what lies to the left of `right` and to the right of `left`, with y up; as long
/// as both are zero, everything.
#[derive(Debug, Clone, Copy, Default)]
struct Cone {
    left: [i32; 2],
    right: [i32; 2],
}

impl Cone {
    /// Whether a place lies within.
    #[inline]
    fn holds(&self, place: [i32; 2]) -> bool {
        cross(self.right, place) >= 0 && cross(self.left, place) <= 0
    }

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
        // The corners of the square around the place that stand furthest to the left and right; of two in line, the
        // nearer.
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
