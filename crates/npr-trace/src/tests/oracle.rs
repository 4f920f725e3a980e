//! What the paper says, done slowly enough to believe at sight.

use crate::{Bitmap, TurnPolicy};

/// A bitmap as the paper sees it: pixels that are inverted.
struct Pixels {
    now: Vec<Vec<bool>>,
}

impl Pixels {
    fn new(bitmap: &Bitmap) -> Self {
        let row = |y| {
            (0..bitmap.width())
                .map(|x| bitmap.is_ink(i64::from(x), y))
                .collect()
        };
        Self {
            now: (0..i64::from(bitmap.height())).map(row).collect(),
        }
    }

    fn at(&self, x: i32, y: i32) -> bool {
        let row = usize::try_from(y).ok().and_then(|y| self.now.get(y));
        let pixel = usize::try_from(x).ok().and_then(|x| row?.get(x));
        pixel.copied().unwrap_or(false)
    }

    fn first(&self) -> Option<[i32; 2]> {
        let y = self.now.iter().position(|row| row.contains(&true))?;
        let x = self.now[y].iter().position(|ink| *ink)?;
        Some([x as i32, y as i32])
    }

    /// Whether ink prevails in the smallest square around a corner, of sides 4, 6 and 8, that has no tie.
    fn prevails(&self, x: i32, y: i32) -> bool {
        for reach in 2..=4 {
            let inks = (y - reach..y + reach)
                .flat_map(|row| (x - reach..x + reach).map(move |column| (column, row)))
                .filter(|(column, row)| self.at(*column, *row))
                .count() as i32;
            if inks != 2 * reach * reach {
                return inks > 2 * reach * reach;
            }
        }
        false
    }
}

/// Decomposition word by word from the paper: follow a path around ink, invert its inside, go on.
pub fn decompose_slowly(bitmap: &Bitmap, policy: TurnPolicy) -> Vec<(bool, Vec<[i32; 2]>)> {
    let mut pixels = Pixels::new(bitmap);
    let mut found = Vec::new();
    while let Some(start) = pixels.first() {
        let is_ink = bitmap.is_ink(i64::from(start[0]), i64::from(start[1]));
        let [mut x, mut y] = start;
        let [mut dx, mut dy] = [0, 1];
        let mut corners = Vec::new();
        loop {
            corners.push([x, y]);
            (x, y) = (x + dx, y + dy);
            if [x, y] == start {
                break;
            }
            // The pixels ahead on both sides: a corner's lower right pixel has its coordinates.
            let ahead = |side: i32| {
                let (sx, sy) = (dx + side * dy, dy - side * dx);
                pixels.at(x + (sx - 1) / 2, y + (sy - 1) / 2)
            };
            let (left, right) = (ahead(1), ahead(-1));
            let turns_left = match (left, right) {
                (true, true) => false,
                (false, false) => true,
                (true, false) => continue,
                (false, true) => !match policy {
                    TurnPolicy::Black => is_ink,
                    TurnPolicy::White => !is_ink,
                    TurnPolicy::Left => false,
                    TurnPolicy::Right => true,
                    TurnPolicy::Majority => pixels.prevails(x, y),
                    TurnPolicy::Minority => !pixels.prevails(x, y),
                    TurnPolicy::Random => {
                        let hash = npr_core::math::mix_bits;
                        (hash(x as u32 ^ hash(y as u32)) & 1 == 1) == is_ink
                    }
                },
            };
            (dx, dy) = if turns_left { (dy, -dx) } else { (-dy, dx) };
        }
        for (corner, next) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            if corner[0] == next[0] {
                let row = &mut pixels.now[corner[1].min(next[1]) as usize];
                for pixel in &mut row[corner[0] as usize..] {
                    *pixel = !*pixel;
                }
            }
        }
        found.push((is_ink, corners));
    }
    found
}

/// Whether a pixel lies inside a closed path along pixel edges.
pub fn holds(corners: &[[i32; 2]], [x, y]: [i32; 2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crossed = corners
        .iter()
        .zip(next)
        .filter(|(a, b)| a[0] == b[0] && a[0] <= x && a[1].min(b[1]) == y);
    crossed.count() % 2 == 1
}

/// The definition of the paper: every three corners pass, and a direction is missing.
pub fn is_straight(corners: &[[i32; 2]]) -> bool {
    let mut directions: Vec<[i32; 2]> = corners
        .windows(2)
        .map(|pair| [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]])
        .collect();
    directions.sort_unstable();
    directions.dedup();
    let passes = |i: usize, j: usize, k: usize| {
        let [a, b, c] = [corners[i], corners[j], corners[k]];
        let (dx, dy) = (c[0] - a[0], c[1] - a[1]);
        ((b[0] - a[0]) * dy - (b[1] - a[1]) * dx).abs() <= dx.abs() + dy.abs()
    };
    let count = corners.len();
    let all = |i| (i + 2..count).all(|k| (i + 1..k).all(|j| passes(i, j, k)));
    directions.len() < 4 && (0..count).all(all)
}

/// The path from one corner to another, around the end of the list if need be.
pub fn stretch(corners: &[[i32; 2]], from: usize, length: usize) -> Vec<[i32; 2]> {
    (from..=from + length)
        .map(|i| corners[i % corners.len()])
        .collect()
}

/// Length of a side times the standard deviation of the corners from its line, one by one.
pub fn penalty(corners: &[[i32; 2]]) -> f64 {
    let [from, to] = [corners[0], corners[corners.len() - 1]].map(|c| c.map(f64::from));
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    // Distance times length of the side, which may be 0.
    let squares = corners.iter().map(|corner| {
        let [x, y] = corner.map(f64::from);
        let area = (x - from[0]) * dy - (y - from[1]) * dx;
        area * area
    });
    (squares.sum::<f64>() / corners.len() as f64).sqrt()
}

/// Fewest sides and least penalty of all polygons from the start, by trying every side that is allowed.
pub fn best_polygon(corners: &[[i32; 2]]) -> (usize, f64) {
    let count = corners.len();
    let mut best = vec![(usize::MAX, f64::INFINITY); count + 1];
    best[0] = (0, 0.0);
    for to in 1..=count {
        for from in 0..to {
            let wide = stretch(corners, from + count - 1, to - from + 2);
            let allowed = to - from == 1 || (to - from + 3 <= count && is_straight(&wide));
            if !allowed || best[from].0 == usize::MAX {
                continue;
            }
            let (sides, cost) = best[from];
            let way = (
                sides + 1,
                cost + penalty(&stretch(corners, from, to - from)),
            );
            if way.0 < best[to].0 || (way.0 == best[to].0 && way.1 < best[to].1) {
                best[to] = way;
            }
        }
    }
    best[count]
}
