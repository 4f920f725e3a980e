//! How much ink lies where, so that lines over black paper can be left out.

use super::{MARGIN, Piece, Span};

/// Length of line in a cell, in pixels for every pixel of area, at which it counts as black: with lines two pixels wide
/// at random places one part in e^6 of the paper still shows, less than a step of eight bits.
pub const BLACK: u64 = 3;

/// Side of a cell in pixels.
const CELL_PX: f64 = 8.0;

/// Parts of a pixel in which lengths are counted as whole numbers, so that their sum does not depend on the order.
const PARTS: f64 = 256.0;

/// Steps along a line in which its ink is counted, in pixels.
const STEP_PX: f64 = 4.0;

/// The ink of crowded lines on the paper, in cells.
#[derive(Debug)]
pub(crate) struct Ink {
    cells: Vec<u64>,
    columns: usize,
    rows: usize,
    origin: f64,
}

impl Ink {
    /// White paper of `size` pixels.
    pub(crate) fn new(size: [u32; 2]) -> Self {
        let margin = MARGIN * f64::from(size[0].max(size[1]));
        let [columns, rows] =
            size.map(|side| ((f64::from(side) + 2.0 * margin) / CELL_PX) as usize + 1);
        Self {
            cells: vec![0; columns * rows],
            columns,
            rows,
            origin: -margin,
        }
    }

    /// The parts of a piece over black paper, in shares of its image: ascending, apart from each other.
    pub(crate) fn black_parts(&self, piece: &Piece) -> Vec<[f64; 2]> {
        let full = BLACK * (CELL_PX * CELL_PX * PARTS) as u64;
        let steps: Vec<bool> = self
            .steps(piece, 0.0, 1.0)
            .map(|(cell, _)| self.cells[cell] >= full)
            .collect();
        let share = |step: usize| step as f64 / steps.len() as f64;
        let mut parts = Vec::new();
        let mut from = 0;
        for run in steps.chunk_by(|a, b| a == b) {
            let to = from + run.len();
            if run[0] {
                parts.push([share(from), share(to)]);
            }
            from = to;
        }
        parts
    }

    /// Counts the ink of the spans of a piece that a drawing shows.
    pub(crate) fn draw(&mut self, piece: &Piece, spans: &[Span], with_hidden: bool) {
        let shown = spans
            .iter()
            .filter(|span| with_hidden || span.occluders == 0);
        for span in shown {
            let steps: Vec<(usize, f64)> = self.steps(piece, span.from, span.to).collect();
            for (cell, length) in steps {
                self.cells[cell] += (length * PARTS) as u64;
            }
        }
    }

    /// The cells along a part of a piece, with the length in each.
    fn steps(&self, piece: &Piece, from: f64, to: f64) -> impl Iterator<Item = (usize, f64)> {
        let length = piece.length() * (to - from);
        let count = (length / STEP_PX).ceil().clamp(1.0, 1e6);
        (0..count as u32).map(move |step| {
            let share = from + (to - from) * (f64::from(step) + 0.5) / count;
            let [x, y] = piece.place_at(share).map(|v| (v - self.origin) / CELL_PX);
            let column = (x.max(0.0) as usize).min(self.columns - 1);
            let row = (y.max(0.0) as usize).min(self.rows - 1);
            (row * self.columns + column, length / count)
        })
    }
}
