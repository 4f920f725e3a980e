//! Points in an order of which any first few cover the tile evenly.

use npr_core::random::{hash, signed, unit};

/// Candidates per point: with more of them, the widest gap is met more closely, at a cost that grows with their number.
const CANDIDATES: u32 = 4;

/// Places `count` points on the tile, 0..1, in pairs that a half turn swaps; the widest gap is filled first.
///
/// Farthest-point sampling [Eldar et al. 1997] among scattered candidates: any first few points
/// keep about the largest distance from each other that they can, in no visible order. O(count^2).
///
/// Differs: each candidate has a handicap of its own, or the first points, chosen among many, would form a lattice.
pub fn spread(count: u32, seed: u32) -> Vec<[f32; 2]> {
    // Measure the room of every candidate, each with a handicap.
    let candidates = candidates(count, seed);
    let handicap = |i: u32| 1.0 - 0.3 * unit(hash(seed, 4, i));
    let handicaps: Vec<f32> = (0..candidates.len() as u32).map(handicap).collect();
    let room = |p: [f32; 2], q: [f32; 2], handicap: f32| handicap * distance2(p, q);
    let mut rooms: Vec<f32> = candidates
        .iter()
        .zip(&handicaps)
        .map(|(&p, &handicap)| room(p, turned(p), handicap))
        .collect();

    // Set the candidate with the most room and its half turn, until there are enough.
    let mut points = Vec::with_capacity(count as usize);
    while points.len() < count as usize {
        let Some(widest) = widest(&rooms) else { break };
        let pair = [candidates[widest], turned(candidates[widest])];
        for ((left, &p), &handicap) in rooms.iter_mut().zip(&candidates).zip(&handicaps) {
            *left = left
                .min(room(p, pair[0], handicap))
                .min(room(p, pair[1], handicap));
        }
        points.extend(pair);
    }
    points
}

/// Index of the greatest number, the first of equal ones; `None` for an empty list.
fn widest(rooms: &[f32]) -> Option<usize> {
    (0..rooms.len()).reduce(|best, i| if rooms[i] > rooms[best] { i } else { best })
}

/// One candidate somewhere in each cell of a grid over half the tile.
fn candidates(count: u32, seed: u32) -> Vec<[f32; 2]> {
    let side = (((count * CANDIDATES) as f32).sqrt().ceil() as u32)
        .next_multiple_of(2)
        .max(4);
    (0..side * side / 2)
        .map(|cell| {
            let at =
                |axis: u32, place: u32| (place as f32 + unit(hash(seed, axis, cell))) / side as f32;
            [at(1, cell % side), at(2, cell / side)]
        })
        .collect()
}

/// The point half a turn away.
pub fn turned(p: [f32; 2]) -> [f32; 2] {
    p.map(|x| if x == 0.0 { 0.0 } else { 1.0 - x })
}

/// Squared distance of two points on a tile that repeats.
pub fn distance2(p: [f32; 2], q: [f32; 2]) -> f32 {
    let axis = |i: usize| {
        let d = (p[i] - q[i]).abs();
        d.min(1.0 - d)
    };
    axis(0) * axis(0) + axis(1) * axis(1)
}

/// Cells around its own in which a place looks for the nearest point.
const REACH: usize = 2;

/// Points of a tile sorted into square cells, in which the nearest one is found.
///
/// A margin of [`REACH`] cells repeats those of the far side, so that a search is a few slices.
pub struct Cells {
    side: usize,
    starts: Vec<u32>,
    dots: Vec<Dot>,
}

/// A point and its weight: a dot of weight w reaches w times as far.
#[derive(Debug, Clone, Copy)]
struct Dot {
    place: [f32; 2],
    inverse_weight2: f32,
}

impl Cells {
    /// Sorts `points`, 0..1, into cells that hold one each on average.
    ///
    /// Weights are 1 plus or minus `variation` times 0.4, the same for a pair of points.
    pub fn new(points: &[[f32; 2]], variation: f32, seed: u32) -> Self {
        let side = ((points.len() as f32).sqrt() as usize).max(1);
        let width = side + 2 * REACH;
        let mut sorted: Vec<(usize, Dot)> = Vec::new();
        for (dot, shift) in dots(points, variation, seed).flat_map(|dot| SHIFTS.map(|s| (dot, s))) {
            let place = [dot.place[0] + shift[0], dot.place[1] + shift[1]];
            let [x, y] = place.map(|x| (x * side as f32).floor() as i64 + REACH as i64);
            let within = 0..width as i64;
            if within.contains(&x) && within.contains(&y) {
                sorted.push((y as usize * width + x as usize, Dot { place, ..dot }));
            }
        }
        sorted.sort_by_key(|(cell, _)| *cell);
        let start = |cell| sorted.partition_point(|(other, _)| *other < cell) as u32;
        Self {
            side,
            starts: (0..=width * width).map(start).collect(),
            dots: sorted.into_iter().map(|(_, dot)| dot).collect(),
        }
    }

    /// Least squared distance from `p`, 0..1, over squared weight, to the points of the cells around it.
    ///
    /// That is the nearest of all points where they cover the tile evenly; infinite if there are none.
    pub fn nearest2(&self, p: [f32; 2]) -> f32 {
        let width = self.side + 2 * REACH;
        let [x, y] = p.map(|x| ((x * self.side as f32) as usize).min(self.side - 1));
        let mut least = f32::INFINITY;
        for row in y..=y + 2 * REACH {
            let from = self.starts[row * width + x] as usize;
            let to = self.starts[row * width + x + 2 * REACH + 1] as usize;
            for dot in &self.dots[from..to] {
                let [dx, dy] = [p[0] - dot.place[0], p[1] - dot.place[1]];
                least = least.min((dx * dx + dy * dy) * dot.inverse_weight2);
            }
        }
        least
    }
}

/// The tile and its eight neighbours.
const SHIFTS: [[f32; 2]; 9] = [
    [0.0, 0.0],
    [1.0, 0.0],
    [1.0, 1.0],
    [0.0, 1.0],
    [-1.0, 1.0],
    [-1.0, 0.0],
    [-1.0, -1.0],
    [0.0, -1.0],
    [1.0, -1.0],
];

/// Points with their weights.
fn dots(points: &[[f32; 2]], variation: f32, seed: u32) -> impl Iterator<Item = Dot> {
    points.iter().enumerate().map(move |(i, &place)| {
        let weight = 1.0 + 0.4 * variation * signed(hash(seed, 3, i as u32 / 2));
        Dot {
            place,
            inverse_weight2: 1.0 / (weight * weight),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Least distance between any two of the points.
    fn least_gap2(points: &[[f32; 2]]) -> f32 {
        let pairs = points.iter().enumerate();
        let gaps = pairs.flat_map(|(i, &p)| points[..i].iter().map(move |&q| distance2(p, q)));
        gaps.fold(f32::INFINITY, f32::min)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn any_first_few_points_keep_their_distance(seed: u32, pairs in 2usize..60) {
            let points = spread(128, seed);
            let first = &points[..2 * pairs];
            let area = 1.0 / first.len() as f32;
            prop_assert!(least_gap2(first) > 0.2 * area, "{} of {area}", least_gap2(first));
            for pair in first.chunks(2) {
                prop_assert_eq!(turned(pair[0]), pair[1]);
            }
        }

        #[test]
        fn cells_find_the_nearest(
            seed: u32, pairs in 1usize..64, variation in 0.0f32..1.0, p in [0.0f32..1.0, 0.0f32..1.0],
        ) {
            let points = &spread(128, seed)[..2 * pairs];
            let cells = Cells::new(points, variation, seed);
            let all = dots(points, variation, seed)
                .map(|dot| distance2(p, dot.place) * dot.inverse_weight2)
                .fold(f32::INFINITY, f32::min);
            prop_assert!((cells.nearest2(p) - all).abs() < 1e-6);
        }
    }
}
