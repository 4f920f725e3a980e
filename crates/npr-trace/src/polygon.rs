//! The polygon with the fewest sides along a path [Selinger 2003, 2.2].

use super::decompose::{PixelLoop, STEPS};
use super::straight;

/// Corners of the optimal polygon of a loop, as numbers of its steps, ascending; 0 is always the first.
///
/// A side may lead from corner i to corner j where the path from one step before i to one step after j is straight and
/// leaves at least three steps out. Of the polygons with the fewest sides it is the one whose sides have the least
/// sum of penalties: the length of a side times the standard deviation of the path's corners from its line.
///
/// O(n w) for n steps and at most w places that one corner can take.
///
/// Differs: sides of a loop of `n` steps span at most `2^30 / n` steps, or 64 if that is less, so that chequers, one
/// loop of millions of steps and long diagonals, take seconds; loops in pictures of up to 4096 pixels a side are not
/// concerned up to 100 000 steps. And the polygon begins at the loop's start, as that of the program Potrace does.
/// Another corner could save one side.
pub fn optimal_polygon(pixels: &PixelLoop<'_>) -> Vec<u32> {
    let mut search = Search::default();
    search.run(pixels.steps);
    search.polygon
}

/// Sides that may be weighed for a loop: its steps times the steps of its longest side.
const SIDE_WORK: usize = 1 << 30;

/// Steps that the longest side may always have.
const LEAST_LONGEST: usize = 64;

/// The search for polygons, with its memory kept from loop to loop.
#[derive(Debug, Default)]
pub(super) struct Search {
    /// What was found: corners of the polygon.
    pub polygon: Vec<u32>,
    /// For every corner, the furthest one that a side can lead to; before that, how many steps from it are straight.
    reach: Vec<u32>,
    /// The first and the last corner that can be a polygon's k-th, of polygons with the fewest sides.
    layers: Vec<[u32; 2]>,
    /// For every corner, the one before it on the best polygon to it.
    before: Vec<u32>,
    /// Penalties of the best polygons to the corners of two layers.
    costs: [Vec<f64>; 2],
    moments: Moments,
}

impl Search {
    /// Finds the polygon of a closed path.
    pub fn run(&mut self, steps: &[u8]) {
        self.polygon.clear();
        let n = steps.len() as u32;
        self.find_reach(steps);
        self.find_layers(n);
        self.find_best(steps);
        // Walk back from the end, which is the start again.
        let mut corner = n;
        for _ in 1..self.layers.len() {
            corner = self.before[corner as usize];
            self.polygon.push(corner);
        }
        self.polygon.reverse();
    }

    /// Gives all memory back but the polygon's.
    pub fn keep_polygon(&mut self) {
        *self = Self {
            polygon: std::mem::take(&mut self.polygon),
            ..Self::default()
        };
    }

    fn find_reach(&mut self, steps: &[u8]) {
        let n = steps.len() as u32;
        let longest = (SIDE_WORK / steps.len().max(1)).max(LEAST_LONGEST) as u32;
        straight::measure(steps, longest, &mut self.reach);
        let most = n.saturating_sub(3).max(1);
        // The straight stretch begins a step before the corner and ends a step after the other.
        self.reach.rotate_right(usize::from(n > 0));
        for (corner, reach) in (0..n).zip(&mut self.reach) {
            let side = reach.saturating_sub(2).clamp(1, most);
            *reach = (corner + side).min(n);
        }
    }

    /// Finds where the k-th corner can lie: as far as k sides reach, but not so near that the rest becomes too long.
    fn find_layers(&mut self, n: u32) {
        self.layers.clear();
        let mut corner = 0;
        self.layers.push([0, 0]);
        while corner < n {
            corner = self.reach[corner as usize];
            self.layers.push([0, corner]);
        }
        let mut first = n;
        let mut place = n;
        for layer in self.layers.iter_mut().rev() {
            layer[0] = first;
            // Reaches never go back, so the first corner that gets there is found by going down.
            while place > 0 && self.reach[place as usize - 1] >= first {
                place -= 1;
            }
            first = place;
        }
    }

    /// Finds the best polygon to every corner of every layer.
    fn find_best(&mut self, steps: &[u8]) {
        self.before.clear();
        self.before.resize(steps.len() + 1, 0);
        let [costs_before, costs] = &mut self.costs;
        costs_before.clear();
        costs_before.push(0.0);
        let mut place = [0; 2];
        for layers in self.layers.windows(2) {
            let [[from, to], [first, last]] = [layers[0], layers[1]];
            self.moments.sum(steps, from, last, place);
            place = self.moments.place((first - from) as usize);
            costs.clear();
            let mut nearest = from;
            for corner in first..=last {
                while self.reach[nearest as usize] < corner {
                    nearest += 1;
                }
                let mut best = (f64::INFINITY, nearest);
                for other in nearest..=to.min(corner - 1) {
                    let penalty = self
                        .moments
                        .penalty((other - from) as usize, (corner - from) as usize);
                    let cost = costs_before[(other - from) as usize] + penalty;
                    // Of equal ones the later: not in the paper.
                    if cost <= best.0 {
                        best = (cost, other);
                    }
                }
                costs.push(best.0);
                self.before[corner as usize] = best.1;
            }
            std::mem::swap(costs_before, costs);
        }
    }
}

/// Sums of coordinates over the corners of a stretch, so that penalties take constant time.
#[derive(Debug, Default)]
struct Moments {
    /// For every corner of the stretch: its place from the loop's start, and sums of x, y, xx, xy, yy of those before
    /// it.
    sums: Vec<[i64; 7]>,
}

impl Moments {
    /// Sums over the corners `first..=last`, the first of which lies at a place.
    fn sum(&mut self, steps: &[u8], first: u32, last: u32, [mut x, mut y]: [i64; 2]) {
        self.sums.clear();
        let mut sum = [0; 5];
        for corner in first..=last {
            let [sx, sy, sxx, sxy, syy] = sum;
            self.sums.push([x, y, sx, sy, sxx, sxy, syy]);
            sum = [sx + x, sy + y, sxx + x * x, sxy + x * y, syy + y * y];
            // The last corner of all is the start again.
            let direction = steps.get(corner as usize).copied().unwrap_or(0);
            let step = STEPS[usize::from(direction & 3)];
            x += i64::from(step[0]);
            y += i64::from(step[1]);
        }
    }

    fn place(&self, corner: usize) -> [i64; 2] {
        [self.sums[corner][0], self.sums[corner][1]]
    }

    /// Length of the side between two corners times the standard deviation of the corners from its line.
    #[inline]
    fn penalty(&self, i: usize, j: usize) -> f64 {
        let [from, to] = [&self.sums[i], &self.sums[j]];
        let [x, y] = [(to[0] - from[0]) as f64, (to[1] - from[1]) as f64];
        let count = (j - i + 1) as f64;
        // Sums over both ends and all between, from the middle of the side.
        let middle = [
            (from[0] + to[0]) as f64 / 2.0,
            (from[1] + to[1]) as f64 / 2.0,
        ];
        let sum_x = (to[2] - from[2] + to[0]) as f64;
        let sum_y = (to[3] - from[3] + to[1]) as f64;
        let sum_xx = (to[4] - from[4] + to[0] * to[0]) as f64;
        let sum_xy = (to[5] - from[5] + to[0] * to[1]) as f64;
        let sum_yy = (to[6] - from[6] + to[1] * to[1]) as f64;
        let a = (sum_xx - 2.0 * middle[0] * sum_x) / count + middle[0] * middle[0];
        let b = (sum_xy - middle[0] * sum_y - middle[1] * sum_x) / count + middle[0] * middle[1];
        let c = (sum_yy - 2.0 * middle[1] * sum_y) / count + middle[1] * middle[1];
        let square = a * y * y - 2.0 * b * x * y + c * x * x;
        square.max(0.0).sqrt()
    }
}
