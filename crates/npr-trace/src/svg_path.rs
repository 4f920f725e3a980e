//! The value of `d` of an SVG path: relative commands, exact on a grid.

use kurbo::Point;
use npr_core::number::{on_grid, push_steps};

/// The value of `d` as it is written.
#[derive(Debug, Clone)]
pub struct PathData {
    /// What is written so far.
    pub text: String,
    decimals: u32,
    /// Where the pen is, on the grid.
    here: [i64; 2],
    /// Where the subpath began.
    start: [i64; 2],
    /// The last command; blank where a subpath has been begun but not written.
    letter: char,
}

impl PathData {
    /// Nothing yet, for a grid of `10^-decimals`.
    pub fn new(decimals: u32) -> Self {
        Self {
            text: String::new(),
            decimals,
            here: [0; 2],
            start: [0; 2],
            letter: ' ',
        }
    }

    fn grid(&self, p: Point) -> [i64; 2] {
        [p.x, p.y].map(|v| on_grid(v, self.decimals))
    }

    /// Begins a subpath.
    pub fn begin(&mut self, p: Point) {
        self.here = self.grid(p);
        self.start = self.here;
        self.letter = ' ';
    }

    /// Goes on by a relative command; `points` are absolute.
    pub fn piece<const N: usize>(&mut self, letter: char, points: &[Point; N]) {
        let ends = points.map(|p| self.grid(p));
        if ends.iter().all(|end| *end == self.here) {
            return;
        }
        if self.letter == ' ' {
            self.text.push('M');
            self.pair(self.start, true);
        }
        let mut first = self.letter != letter;
        if first {
            self.text.push(letter);
            self.letter = letter;
        }
        for end in &ends {
            self.pair([0, 1].map(|i| end[i] - self.here[i]), first);
            first = false;
        }
        self.here = ends[ends.len() - 1];
    }

    /// Closes the subpath, if anything of it was written.
    pub fn close(&mut self) {
        if self.letter != ' ' {
            self.text.push('z');
            self.here = self.start;
            self.letter = ' ';
        }
    }

    /// Writes two numbers; a minus parts as well as a blank does.
    fn pair(&mut self, pair: [i64; 2], first: bool) {
        for (i, steps) in pair.into_iter().enumerate() {
            if steps >= 0 && !(first && i == 0) {
                self.text.push(' ');
            }
            push_steps(&mut self.text, steps, self.decimals);
        }
    }
}
