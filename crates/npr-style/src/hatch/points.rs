//! Points in an order whose every beginning covers the tile evenly.

use super::noise::{hash, signed, unit};

/// Candidates per point: more follow the widest gap closer, at a cost that grows with their number.
const CANDIDATES: u32 = 4;

/// `count` points of the tile, 0..1, in pairs that a half turn swaps, the widest gap filled first.
///
/// Farthest-point sampling [Eldar et al. 1997] among scattered candidates: any first few points
/// keep about the largest distance from each other that they can, in no visible order. O(count^2) steps
/// of a single addition and comparison.
pub fn spread(count: u32, seed: u32) -> Vec<[f32; 2]> {
    let candidates = candidates(count, seed);
    let mut room: Vec<f32> = candidates
        .iter()
        .map(|&p| distance2(p, turned(p)))
        .collect();
    let mut points = Vec::with_capacity(count as usize);
    while points.len() < count as usize {
        let Some(widest) = widest(&room) else { break };
        let pair = [candidates[widest], turned(candidates[widest])];
        for (room, &p) in room.iter_mut().zip(&candidates) {
            *room = room.min(distance2(p, pair[0])).min(distance2(p, pair[1]));
        }
        points.extend(pair);
    }
    points
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

/// Index of the greatest number, the first of equals; none of nothing.
fn widest(room: &[f32]) -> Option<usize> {
    (0..room.len()).reduce(|best, i| if room[i] > room[best] { i } else { best })
}

/// The point half a turn away.
pub fn turned(p: [f32; 2]) -> [f32; 2] {
    p.map(|x| if x == 0.0 { 0.0 } else { 1.0 - x })
}

/// Squared distance of two points of a tile that repeats.
pub fn distance2(p: [f32; 2], q: [f32; 2]) -> f32 {
    let axis = |i: usize| {
        let d = (p[i] - q[i]).abs();
        d.min(1.0 - d)
    };
    axis(0) * axis(0) + axis(1) * axis(1)
}

/// Points of a tile sorted into square cells, to find the nearest.
pub struct Cells {
    side: u32,
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
        let side = ((points.len() as f32).sqrt() as u32).max(1);
        let cell = |p: [f32; 2]| {
            let [x, y] = p.map(|x| ((x * side as f32) as u32).min(side - 1));
            (y * side + x) as usize
        };
        let mut starts = vec![0u32; (side * side) as usize + 1];
        for &p in points {
            starts[cell(p) + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|&i| cell(points[i]));
        let dot = |i: usize| {
            let weight = 1.0 + 0.4 * variation * signed(hash(seed, 3, i as u32 / 2));
            Dot {
                place: points[i],
                inverse_weight2: 1.0 / (weight * weight),
            }
        };
        Self {
            side,
            starts,
            dots: order.into_iter().map(dot).collect(),
        }
    }

    /// Least squared distance, over squared weight, from `p` to the points of the cells around it.
    ///
    /// Cells up to two away count; that is enough for points that cover the tile evenly.
    pub fn nearest2(&self, p: [f32; 2]) -> f32 {
        let side = self.side as i32;
        let [x, y] = p.map(|x| (x * side as f32) as i32);
        let reach = if side < 5 {
            (side - 1) / 2..=side / 2
        } else {
            2..=2
        };
        let around = -reach.start()..=*reach.end();
        let mut least = f32::INFINITY;
        for dy in around.clone() {
            for dx in around.clone() {
                let cell = ((y + dy).rem_euclid(side) * side + (x + dx).rem_euclid(side)) as usize;
                let dots = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                for dot in &self.dots[dots] {
                    least = least.min(distance2(p, dot.place) * dot.inverse_weight2);
                }
            }
        }
        least
    }
}
