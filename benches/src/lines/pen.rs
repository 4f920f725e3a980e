//! A pen on paper: lines become black pixels, and black pixels a middle line one pixel wide.

use std::ops::Range;

use glam::DVec2;

/// Width of the pen's line, in pixels of the picture.
pub const PEN_PX: f64 = 3.0;

/// Pixels of the paper for one of the picture, along each side: middle lines wander less than on the picture's own.
const FINENESS: f64 = 2.0;

/// Longest side of the picture that is drawn, in pixels; what lies beyond is left out.
const LONGEST_SIDE_PX: u32 = 8192;

/// Paper that a round pen has drawn on, with a white pixel more on each side of the picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Paper {
    width: usize,
    height: usize,
    black: Vec<bool>,
}

impl Paper {
    /// White paper for a picture of `size` pixels, of which at most the first 8192 of each side are kept.
    pub fn new(size: [u32; 2]) -> Self {
        let [width, height] = size.map(|side| {
            let side = f64::from(side.min(LONGEST_SIDE_PX));
            (side * FINENESS) as usize + 2
        });
        Self {
            width,
            height,
            black: vec![false; width * height],
        }
    }

    /// Draws straight from one place in the picture to another: all pixels whose middle is half the pen's width from
    /// the line.
    ///
    /// O(pixels drawn) plus a step for each row of the paper that the line passes.
    pub fn draw(&mut self, line: [[f64; 2]; 2]) {
        if line.iter().flatten().any(|v| !v.is_finite()) {
            return;
        }
        let [from, to] = line.map(|place| DVec2::from(place) * FINENESS + 1.0);
        let along = to - from;
        let radius = PEN_PX * FINENESS / 2.0;
        for row in inner(from.y.min(to.y), from.y.max(to.y), radius, self.height) {
            // The part of the line that can reach the row.
            let y = row as f64 + 0.5;
            let share = |at: f64| ((at - from.y) / along.y).clamp(0.0, 1.0);
            let [a, b] = if along.y == 0.0 {
                [from.x, to.x]
            } else {
                [y - radius, y + radius].map(|at| from.x + share(at) * along.x)
            };
            for column in inner(a.min(b), a.max(b), radius, self.width) {
                let middle = DVec2::new(column as f64 + 0.5, y);
                let at = (middle - from).dot(along) / along.length_squared();
                // A line without length is its first place.
                let at = if at.is_nan() { 0.0 } else { at.clamp(0.0, 1.0) };
                if middle.distance(from + at * along) <= radius {
                    self.black[row * self.width + column] = true;
                }
            }
        }
    }

    /// Blackens white specks smaller than the blot of the pen, and slits half a pixel wide: no pen can leave them out.
    ///
    /// Where two lines part slowly, slits open and close with every step of the paper's pixels; they would be islands
    /// of two lines.
    pub fn fill_specks(&mut self) {
        let blot = (std::f64::consts::PI * (PEN_PX * FINENESS / 2.0).powi(2)) as usize;
        for pixel in self.black_pixels() {
            for side in self.sides(pixel) {
                let speck = self.white_around(side, blot);
                speck.into_iter().for_each(|white| self.black[white] = true);
            }
        }
    }

    /// The white pixels that hang together with one by their sides; none where they are `most` or more and not all in
    /// slits.
    fn white_around(&self, start: usize, most: usize) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open = vec![start];
        let mut is_slit = true;
        while let Some(pixel) = open.pop() {
            if self.black[pixel] || found.contains(&pixel) {
                continue;
            }
            found.push(pixel);
            // The margin hangs together with all that is outside.
            if self.is_margin(pixel) {
                return Vec::new();
            }
            is_slit = is_slit && !self.is_in_white_square(pixel);
            if found.len() >= most && !is_slit {
                return Vec::new();
            }
            open.extend(self.sides(pixel));
        }
        found
    }

    /// Whether four white pixels meet at a corner of this one, which lies inside the margin.
    fn is_in_white_square(&self, pixel: usize) -> bool {
        let white = self.around(pixel).map(|near| !self.black[near]);
        (0..8)
            .step_by(2)
            .any(|side| white[side] && white[side + 1] && white[(side + 2) % 8])
    }

    fn is_margin(&self, pixel: usize) -> bool {
        let [row, column] = [pixel / self.width, pixel % self.width];
        row == 0 || column == 0 || row + 1 == self.height || column + 1 == self.width
    }

    /// Peels black off until lines one pixel wide are left, which hang together as before, corners included.
    ///
    /// A round takes the pixels with white on one side, for each of the four sides: those that hold nothing together
    /// and are no end of a line [Rosenfeld 1975]. As many rounds as the thickest spot has pixels across.
    pub fn thin(&mut self) {
        let mut black = self.black_pixels();
        loop {
            let before = black.len();
            for side in 0..4 {
                // Find the pixels with white on this side.
                let edge: Vec<usize> = black
                    .iter()
                    .copied()
                    .filter(|pixel| !self.black[self.sides(*pixel)[side]])
                    .collect();

                // Take those that hold nothing together.
                for pixel in edge {
                    if self.can_go(pixel) {
                        self.black[pixel] = false;
                    }
                }
                black.retain(|pixel| self.black[*pixel]);
            }
            if black.len() == before {
                return;
            }
        }
    }

    /// Whether what is around a black pixel hangs together without it, and goes on from it to more than one pixel.
    fn can_go(&self, pixel: usize) -> bool {
        let around = self.around(pixel).map(|near| self.black[near]);
        let count = around.iter().filter(|black| **black).count();
        // Of the four sides, those that are white and not followed by black corners and black sides: one for every
        // way out.
        let ways = (0..8)
            .step_by(2)
            .filter(|side| !around[*side] && (around[(side + 1) % 8] || around[(side + 2) % 8]));
        count > 1 && ways.count() == 1
    }

    /// Numbers of all black pixels, row after row.
    pub fn black_pixels(&self) -> Vec<usize> {
        (0..self.black.len())
            .filter(|pixel| self.black[*pixel])
            .collect()
    }

    /// The black pixels around one, those at its sides first.
    pub fn black_around(&self, pixel: usize) -> impl Iterator<Item = usize> {
        let around = self.around(pixel);
        [0, 2, 4, 6, 1, 3, 5, 7]
            .into_iter()
            .map(move |i| around[i])
            .filter(|near| self.black[*near])
    }

    /// Right, upper, left and lower neighbour.
    fn sides(&self, pixel: usize) -> [usize; 4] {
        let around = self.around(pixel);
        [around[0], around[2], around[4], around[6]]
    }

    /// The eight neighbours of a pixel inside the margin, from the right one on counter-clockwise.
    fn around(&self, pixel: usize) -> [usize; 8] {
        let w = self.width as isize;
        let step = |by: isize| pixel.checked_add_signed(by).unwrap_or(pixel);
        [1, 1 - w, -w, -w - 1, -1, w - 1, w, w + 1].map(step)
    }

    /// The middle of a pixel in the picture.
    pub fn place(&self, pixel: usize) -> [f64; 2] {
        let [row, column] = [pixel / self.width, pixel % self.width];
        [column, row].map(|v| (v as f64 - 0.5) / FINENESS)
    }
}

/// Rows or columns within `radius` of a range, without those of the margin, which stay white.
fn inner(low: f64, high: f64, radius: f64, count: usize) -> Range<usize> {
    let low = (low - radius).floor().max(1.0);
    let high = (high + radius).ceil().min(count as f64 - 1.0);
    (low as usize)..(high as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// How many parts the pixels of one colour hang together in: black ones by corners too, white ones by sides.
    fn parts(paper: &Paper, black: bool) -> usize {
        let mut seen = vec![false; paper.black.len()];
        let mut count = 0;
        for start in 0..seen.len() {
            let mut open = vec![start];
            count += usize::from(paper.black[start] == black && !seen[start]);
            while let Some(pixel) = open.pop() {
                if paper.black[pixel] != black || std::mem::replace(&mut seen[pixel], true) {
                    continue;
                }
                let near = paper.around(pixel);
                let step = if black { 1 } else { 2 };
                open.extend(near.into_iter().step_by(step).filter(|p| *p < seen.len()));
            }
        }
        count
    }

    fn touched(places: &[(f64, f64)]) -> Paper {
        let mut paper = Paper::new([24, 20]);
        places.iter().for_each(|(x, y)| paper.draw([[*x, *y]; 2]));
        paper
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn thinning_keeps_parts_and_holes(places in prop::collection::vec((-2.0..26.0, -2.0..22.0), 0..40)) {
            let thick = touched(&places);
            let mut thin = thick.clone();
            thin.thin();
            prop_assert_eq!(parts(&thin, true), parts(&thick, true));
            prop_assert_eq!(parts(&thin, false), parts(&thick, false));
            // What is left was black, and no pixel of it could go.
            for pixel in thin.black_pixels() {
                prop_assert!(thick.black[pixel] && !thin.can_go(pixel));
            }
        }

        #[test]
        fn filling_takes_small_holes_only(places in prop::collection::vec((-2.0..26.0, -2.0..22.0), 0..40)) {
            let drawn = touched(&places);
            let mut filled = drawn.clone();
            filled.fill_specks();
            prop_assert!(drawn.black_pixels().iter().all(|pixel| filled.black[*pixel]));
            for pixel in (0..filled.black.len()).filter(|p| !filled.black[*p] && !filled.is_margin(*p)) {
                prop_assert!(filled.white_around(pixel, 28).is_empty());
            }
        }

        #[test]
        fn any_numbers_may_be_drawn(line: [[f64; 2]; 2]) {
            let mut paper = Paper::new([9, 7]);
            paper.draw(line);
            paper.fill_specks();
            paper.thin();
            prop_assert!(paper.black_pixels().len() <= 63 * 4);
        }

        #[test]
        fn a_line_is_black_as_far_as_the_pen_is_wide(from in (-2.0..26.0, -2.0..22.0), to in (-2.0..26.0, -2.0..22.0)) {
            let mut paper = Paper::new([24, 20]);
            paper.draw([from.into(), to.into()]);
            let [from, to] = [from, to].map(DVec2::from);
            for pixel in (0..paper.black.len()).filter(|pixel| !paper.is_margin(*pixel)) {
                let place = DVec2::from(paper.place(pixel));
                let off = (0..=1000).map(|i| place.distance(from.lerp(to, f64::from(i) / 1000.0)));
                let off = off.fold(f64::INFINITY, f64::min);
                // What is told apart by less than the oracle's steps is left to either.
                if (off - PEN_PX / 2.0).abs() > 0.02 {
                    prop_assert_eq!(paper.black[pixel], off < PEN_PX / 2.0);
                }
            }
        }
    }

    #[test]
    fn paper_without_pixels_stays_white() {
        let mut paper = Paper::new([0, 0]);
        paper.draw([[0.0, 0.0]; 2]);
        paper.fill_specks();
        paper.thin();
        assert!(paper.black_pixels().is_empty());
    }
}
