//! Which pixels of a drawing are dark.

use crate::Wanted;
use npr_core::math;
use npr_render::Frame;

/// The sRGB byte of half the light of white.
const HALF_COVERED: u8 = 188;

/// The dark pixels of a drawing on white paper.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ink {
    /// Width and height in pixels.
    pub size: [u32; 2],
    dark: Vec<bool>,
}

impl Ink {
    /// Pixels that black covers by more than half; they mix with the paper in linear light.
    pub fn of(frame: &Frame) -> Self {
        Self::darker_than(frame, HALF_COVERED)
    }

    /// The same of strokes, which mix with the paper by their sRGB values.
    pub fn of_strokes(frame: &Frame) -> Self {
        Self::darker_than(frame, 128)
    }

    /// Pixels of one colour, as sRGB bytes with alpha.
    pub fn of_color(frame: &Frame, color: &[u8]) -> Self {
        Self::where_pixels(frame, |pixel| pixel == color)
    }

    fn darker_than(frame: &Frame, byte: u8) -> Self {
        Self::where_pixels(frame, |pixel| pixel[1] < byte)
    }

    fn where_pixels(frame: &Frame, is_inked: impl Fn(&[u8]) -> bool) -> Self {
        Self {
            size: frame.size,
            dark: frame.rgba.chunks_exact(4).map(is_inked).collect(),
        }
    }

    /// Whether the pixel in a column and row is inked; none is outside the picture.
    pub fn at(&self, x: i32, y: i32) -> bool {
        let [width, height] = self.size.map(|side| side as i32);
        (0..width).contains(&x) && (0..height).contains(&y) && self.dark[(y * width + x) as usize]
    }

    /// Number of inked pixels.
    pub fn count(&self) -> usize {
        self.dark.iter().filter(|dark| **dark).count()
    }

    /// Centres of the inked pixels, row by row.
    pub fn centers(&self) -> impl Iterator<Item = [f32; 2]> + '_ {
        let width = self.size[0] as usize;
        let inked = (0..self.dark.len()).filter(|i| self.dark[*i]);
        inked.map(move |i| [(i % width) as f32 + 0.5, (i / width) as f32 + 0.5])
    }

    /// Ink here that is not there.
    pub fn without(&self, other: &Self) -> Self {
        let pairs = self.dark.iter().zip(&other.dark);
        Self {
            size: self.size,
            dark: pairs.map(|(here, there)| *here && !there).collect(),
        }
    }

    /// The ink grown by `reach` pixels to all eight sides.
    pub fn grown(&self, reach: i32) -> Self {
        let near = |x: i32, y: i32| {
            (y - reach..=y + reach).any(|v| (x - reach..=x + reach).any(|u| self.at(u, v)))
        };
        let [width, height] = self.size.map(|side| side as i32);
        let dark = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self {
            size: self.size,
            dark: dark.map(|(x, y)| near(x, y)).collect(),
        }
    }

    /// Whether any pixel within `reach` of a point is inked.
    pub fn is_near(&self, point: [f32; 2], reach: f32) -> bool {
        let [x, y] = point.map(|v| (v - 0.5).round() as i32);
        let around = reach.ceil() as i32 + 1;
        (y - around..=y + around).any(|v| {
            (x - around..=x + around).any(|u| {
                let apart = [u as f32 + 0.5 - point[0], v as f32 + 0.5 - point[1]];
                self.at(u, v) && apart[0].hypot(apart[1]) <= reach
            })
        })
    }

    /// Number of inked pixels in each blob joined over sides and corners, largest first.
    pub fn components(&self) -> Vec<usize> {
        let mut left = self.dark.clone();
        let mut sizes = Vec::new();
        for start in 0..left.len() {
            if left[start] {
                sizes.push(self.flood(start, &mut left));
            }
        }
        sizes.sort_unstable_by(|a, b| b.cmp(a));
        sizes
    }

    /// Takes the blob of a pixel out of `left` and counts it.
    fn flood(&self, start: usize, left: &mut [bool]) -> usize {
        let [width, height] = self.size.map(|side| side as usize);
        let (mut open, mut count) = (vec![start], 0);
        left[start] = false;
        while let Some(i) = open.pop() {
            count += 1;
            let (x, y) = (i % width, i / width);
            for v in y.saturating_sub(1)..=(y + 1).min(height - 1) {
                for u in x.saturating_sub(1)..=(x + 1).min(width - 1) {
                    if std::mem::take(&mut left[v * width + u]) {
                        open.push(v * width + u);
                    }
                }
            }
        }
        count
    }

    /// Largest distance of any ink from the wanted lines, in pixels; 0 without ink.
    pub fn farthest_from(&self, wanted: &Wanted) -> f32 {
        let apart = self.centers().map(|center| wanted.distance(center));
        apart.fold(0.0, f32::max)
    }

    /// Share of the wanted lines' length with ink within `reach` pixels.
    pub fn share_of(&self, wanted: &Wanted, reach: f32) -> f32 {
        let points = wanted.points();
        let found = points.iter().filter(|point| self.is_near(**point, reach));
        found.count() as f32 / points.len() as f32
    }

    /// Length of the run of ink through `from`, in pixels: the line's width where `along` is its normal.
    pub fn run(&self, from: [f32; 2], along: [f32; 2]) -> f32 {
        const STEP: f32 = 0.25;
        let inked = |steps: i32| {
            let at: [f32; 2] = std::array::from_fn(|i| from[i] + along[i] * STEP * steps as f32);
            self.at(at[0].floor() as i32, at[1].floor() as i32)
        };
        if !inked(0) {
            return 0.0;
        }
        let ahead = (1..).take_while(|steps| inked(*steps)).count();
        let behind = (1..).take_while(|steps| inked(-*steps)).count();
        (ahead + behind + 1) as f32 * STEP
    }

    /// Width of the ink at a point, in pixels: the shortest run over eight directions; 0 where there is none.
    pub fn thickness(&self, at: [f32; 2]) -> f32 {
        let angles = (0..8).map(|i| i as f32 * std::f32::consts::PI / 8.0);
        let runs = angles.map(|angle| self.run(at, [math::cos(angle), math::sin(angle)]));
        runs.fold(f32::MAX, f32::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ink(rows: &[&str]) -> Ink {
        Ink {
            size: [rows[0].len() as u32, rows.len() as u32],
            dark: rows
                .iter()
                .flat_map(|row| row.bytes().map(|b| b == b'#'))
                .collect(),
        }
    }

    #[test]
    fn blobs_join_over_corners() {
        let ink = ink(&["#..#", ".#.#", "....", "#..."]);
        assert_eq!(ink.components(), [2, 2, 1]);
    }

    #[test]
    fn a_run_measures_across_a_line() {
        let ink = ink(&["......", ".###..", ".###..", "......"]);
        assert_eq!(ink.run([2.5, 1.5], [1.0, 0.0]), 3.0);
        assert_eq!(ink.run([2.5, 1.5], [0.0, 1.0]), 2.0);
        assert_eq!(ink.run([0.5, 0.5], [0.0, 1.0]), 0.0);
        assert_eq!(ink.thickness([2.5, 1.5]), 2.0);
    }

    #[test]
    fn ink_is_compared_with_wanted_lines_both_ways() {
        let ink = ink(&["......", "####..", "......"]);
        let wanted = Wanted::new(vec![[[0.5, 1.5], [5.5, 1.5]]]);
        assert!(ink.farthest_from(&wanted) < 1e-6);
        assert!((ink.share_of(&wanted, 0.75) - 0.75).abs() < 0.1);
    }
}
