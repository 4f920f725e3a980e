//! Dashes in a picture of lines: pieces of ink that are too small to be a line.
//!
//! One definition serves every method, whatever it makes lines of: it looks at the ink alone.

use std::f64::consts::FRAC_PI_8;

/// Area in square pixels under which a piece of ink is a dash.
pub const LEAST_AREA_PX: usize = 12;

/// Extent in pixels under which a piece of ink is a dash.
pub const LEAST_EXTENT_PX: f64 = 9.0;

/// Ink in a picture: which pixels it covers by more than half.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InkPicture {
    width: usize,
    is_ink: Vec<bool>,
}

/// A piece of ink: pixels that touch each other by a side or by a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Number of its pixels.
    pub area: usize,
    /// Greatest distance between the centres of two of its pixels, in pixels; of pieces that are no dash by it, that
    /// of two opposite sides of the box around them, which is no more.
    pub extent: f64,
    /// One of its pixels: the first in rows from the top.
    pub place: [usize; 2],
}

impl Piece {
    /// Whether it is too small to be a line.
    pub fn is_dash(&self) -> bool {
        self.area < LEAST_AREA_PX || self.extent < LEAST_EXTENT_PX
    }
}

impl InkPicture {
    /// The pixels of a picture, row by row from the top, of which ink covers more than half.
    ///
    /// # Panics
    ///
    /// Where `coverage` is not as long as `size` says.
    pub fn new(size: [u32; 2], coverage: impl Iterator<Item = f32>) -> Self {
        let is_ink: Vec<bool> = coverage.map(|share| share > 0.5).collect();
        let [width, height] = size.map(|side| side as usize);
        assert_eq!(is_ink.len(), width * height, "a share for every pixel");
        Self { width, is_ink }
    }

    /// Length of the lines in pixels: half of the way around the ink.
    ///
    /// By Cauchy and Crofton: lines in all directions have sides of pixels between ink and paper in the ratio of 4 to
    /// pi to the way around. Lines along rows or columns come out at 0.79 of their length, diagonal ones at 1.11.
    /// O(pixels).
    pub fn length(&self) -> f64 {
        let rows = || self.is_ink.chunks_exact(self.width.max(1));
        let along_rows = rows().map(|row| {
            let ends = [row.first(), row.last()].into_iter().flatten();
            changes(row.iter().zip(&row[1..])) + ends.filter(|ink| **ink).count()
        });
        let between_rows = rows()
            .zip(rows().skip(1))
            .map(|(a, b)| changes(a.iter().zip(b)));
        let outer = [rows().next(), rows().last()]
            .into_iter()
            .flatten()
            .flatten();
        let sides: usize = along_rows.chain(between_rows).sum();
        FRAC_PI_8 * (sides + outer.filter(|ink| **ink).count()) as f64
    }

    /// The pieces of ink, by their first pixels in rows from the top. O(pixels).
    pub fn pieces(&self) -> Vec<Piece> {
        let mut is_left = self.is_ink.clone();
        let mut pieces = Vec::new();
        for first in 0..is_left.len() {
            if is_left[first] {
                pieces.push(self.piece_from(first, &mut is_left));
            }
        }
        pieces
    }

    /// The piece that a pixel is of; takes its pixels away from those that are left.
    fn piece_from(&self, first: usize, is_left: &mut [bool]) -> Piece {
        // Follow the ink from pixel to pixel.
        let mut pixels = vec![first];
        is_left[first] = false;
        let mut next = 0;
        while let Some(pixel) = pixels.get(next) {
            for beside in self.around(*pixel) {
                if std::mem::take(&mut is_left[beside]) {
                    pixels.push(beside);
                }
            }
            next += 1;
        }

        // Measure it.
        let places: Vec<[usize; 2]> = pixels.iter().map(|pixel| self.place(*pixel)).collect();
        Piece {
            area: places.len(),
            extent: extent_of(&places),
            place: self.place(first),
        }
    }

    fn place(&self, pixel: usize) -> [usize; 2] {
        [pixel % self.width, pixel / self.width]
    }

    /// The pixels that touch a pixel.
    fn around(&self, pixel: usize) -> impl Iterator<Item = usize> + use<> {
        let [x, y] = self.place(pixel);
        let (width, height) = (self.width, self.is_ink.len() / self.width);
        let rows = y.saturating_sub(1)..(y + 2).min(height);
        rows.flat_map(move |y| {
            let columns = x.saturating_sub(1)..(x + 2).min(width);
            columns.map(move |x| y * width + x)
        })
    }
}

/// How many pairs are not alike.
fn changes<'a>(pairs: impl Iterator<Item = (&'a bool, &'a bool)>) -> usize {
    pairs.filter(|(a, b)| a != b).count()
}

/// The extent of a piece from its pixels.
fn extent_of(places: &[[usize; 2]]) -> f64 {
    let side = |axis: usize| {
        let along = places.iter().map(|place| place[axis]);
        let ends = along.clone().min().zip(along.max());
        ends.map_or(0.0, |(least, most)| (most - least) as f64)
    };
    let side = side(0).max(side(1));
    if side >= LEAST_EXTENT_PX {
        return side;
    }
    let apart = |a: &[usize; 2], b: &[usize; 2]| {
        let [x, y] = [0, 1].map(|i| a[i].abs_diff(b[i]) as f64);
        (x * x + y * y).sqrt()
    };
    let pairs = places
        .iter()
        .flat_map(|a| places.iter().map(move |b| apart(a, b)));
    pairs.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Cells of boxes of ink, and how far they lie apart: too far for boxes to touch.
    const CELLS: usize = 6;
    const CELL_PX: usize = 20;

    fn picture(width: usize, is_ink: &[bool]) -> InkPicture {
        let size = [width as u32, (is_ink.len() / width) as u32];
        InkPicture::new(size, is_ink.iter().map(|ink| f32::from(*ink)))
    }

    /// For every pixel the least number of a pixel of its piece: numbers are handed on until nothing changes.
    fn leaders(width: usize, is_ink: &[bool]) -> Vec<usize> {
        let touch = |a: usize, b: usize| {
            (a % width).abs_diff(b % width) <= 1 && (a / width).abs_diff(b / width) <= 1
        };
        let mut leaders: Vec<usize> = (0..is_ink.len()).collect();
        loop {
            let before = leaders.clone();
            for a in (0..is_ink.len()).filter(|a| is_ink[*a]) {
                for b in (0..is_ink.len()).filter(|b| is_ink[*b] && touch(a, *b)) {
                    leaders[a] = leaders[a].min(leaders[b]);
                }
            }
            if leaders == before {
                return leaders;
            }
        }
    }

    /// A straight bar in the middle of a picture.
    fn bar(size: u32, length: f64, width: f64, angle: f64) -> InkPicture {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let middle = f64::from(size) / 2.0;
        let covers = |i: u32| {
            let [x, y] = [i % size, i / size].map(|at| f64::from(at) + 0.5 - middle);
            let (along, across) = (x * cos + y * sin, y * cos - x * sin);
            along.abs() <= length / 2.0 && across.abs() <= width / 2.0
        };
        let coverage = (0..size * size).map(|i| if covers(i) { 1.0 } else { 0.0 });
        InkPicture::new([size; 2], coverage)
    }

    proptest! {
        /// Pieces are what numbers handed on from pixel to pixel make one of.
        #[test]
        fn pieces_are_what_hangs_together(
            width in 1_usize..9, is_ink in prop::collection::vec(any::<bool>(), 8..60),
        ) {
            let is_ink = &is_ink[..is_ink.len() / width * width];
            let leaders = leaders(width, is_ink);
            let members = |first: usize| leaders.iter().filter(|leader| **leader == first).count();
            let firsts = (0..is_ink.len()).filter(|i| is_ink[*i] && leaders[*i] == *i);
            let expected: Vec<_> = firsts.map(|i| (members(i), [i % width, i / width])).collect();
            let found: Vec<_> = picture(width, is_ink).pieces().iter().map(|p| (p.area, p.place)).collect();
            prop_assert_eq!(found, expected);
        }

        /// Of boxes apart, dashes are those that are small or short, by their sides alone.
        #[test]
        fn dashes_are_the_small_boxes(
            boxes in prop::collection::vec(prop::option::of([1_usize..16, 1_usize..16]), CELLS * CELLS),
        ) {
            let width = CELLS * CELL_PX;
            let mut is_ink = vec![false; width * width];
            for (cell, sides) in boxes.iter().enumerate() {
                let [wide, high] = sides.unwrap_or_default();
                let corner = (cell / CELLS * width + cell % CELLS) * CELL_PX;
                for y in 0..high {
                    is_ink[corner + y * width..][..wide].fill(true);
                }
            }
            let is_small = |[wide, high]: &[usize; 2]| {
                let diagonal_squared = (wide - 1).pow(2) + (high - 1).pow(2);
                wide * high < 12 || diagonal_squared < 81
            };
            let pieces = picture(width, &is_ink).pieces();
            let dashes = pieces.iter().filter(|piece| piece.is_dash()).count();
            prop_assert_eq!(pieces.len(), boxes.iter().flatten().count());
            prop_assert_eq!(dashes, boxes.iter().flatten().filter(|sides| is_small(sides)).count());
        }

        /// A picture turned by a quarter has as long lines, and one with a margin too.
        #[test]
        fn lengths_do_not_hang_on_the_border(
            width in 1_usize..9, is_ink in prop::collection::vec(any::<bool>(), 8..60),
        ) {
            let height = is_ink.len() / width;
            let is_ink = &is_ink[..width * height];
            let turned: Vec<bool> = (0..width * height)
                .map(|i| is_ink[i % height * width + i / height])
                .collect();
            let mut wide = vec![false; (width + 2) * (height + 2)];
            for y in 0..height {
                wide[(y + 1) * (width + 2) + 1..][..width].copy_from_slice(&is_ink[y * width..][..width]);
            }
            let length = picture(width, is_ink).length();
            prop_assert_eq!(picture(height, &turned).length(), length);
            prop_assert_eq!(picture(width + 2, &wide).length(), length);
        }
    }

    #[test]
    fn lengths_are_right_over_all_directions() {
        let (length, width, turns) = (150.0, 3.0, 180);
        let found = |turn: u32| bar(200, length, width, f64::from(turn).to_radians()).length();
        let lengths: Vec<f64> = (0..turns).map(found).collect();
        let mean = lengths.iter().sum::<f64>() / f64::from(turns);
        assert!((mean / (length + width) - 1.0).abs() < 0.02, "{mean}");
        let [least, most] =
            [f64::min, f64::max].map(|pick| lengths.iter().copied().fold(mean, pick));
        assert!(
            least > 0.77 * length && most < 1.14 * (length + width),
            "{least} to {most}"
        );
    }
}
