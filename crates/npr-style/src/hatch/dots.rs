//! Heights of drawings made of dots: squared distances, since the ink of a dot grows with the square of its reach.

use super::drawing::{Drawing, Hand};
use super::points::Cells;

/// Steps of the screen's grid along a side of the tile; dots lie on every second of its crossings.
///
/// Rows run at 45 degrees, and dots lie the root of two steps apart; the coarsest level still has two.
fn grid_side(drawing: Drawing) -> u32 {
    drawing.tracks()
}

/// Number of hand-set dots on a tile at this drawing: one for every two square spacings of tracks, an even number.
pub fn stipple_count(drawing: Drawing) -> u32 {
    let spacings = drawing.side_spacings();
    2 * ((0.25 * spacings * spacings).round() as u32).max(1)
}

/// Heights of hand-set dots; their points come in order of appearance.
pub struct Stipple(Cells);

impl Stipple {
    /// Takes from `points` the dots that `drawing` holds.
    pub fn new(drawing: Drawing, hand: &Hand, seed: u32, points: &[[f32; 2]]) -> Self {
        let count = (stipple_count(drawing) as usize).min(points.len());
        Self(Cells::new(&points[..count], hand.variation, seed))
    }

    /// Fills a row of heights at `v`.
    pub fn fill_row(&self, v: f32, heights: &mut [f32]) {
        let side = heights.len() as f32;
        for (x, height) in heights.iter_mut().enumerate() {
            *height = self.0.nearest2([(x as f32 + 0.5) / side, v]);
        }
    }
}

/// Fills a row of heights at `v` with a printer's screen.
///
/// With growing distance, every second dot shrinks to nothing by the second drawing, which turns the screen by 45
/// degrees; from there every second of the others does, which turns it back.
pub fn fill_screen_row(drawing: Drawing, v: f32, heights: &mut [f32]) {
    let steps = grid_side(drawing) as f32 / heights.len() as f32;
    let y = v * grid_side(drawing) as f32;
    for (x, height) in heights.iter_mut().enumerate() {
        let p = [(x as f32 + 0.5) * steps, y];
        let kept = lattice2(p, [0.0, 0.0], 4.0).min(lattice2(p, [2.0, 2.0], 4.0));
        let second = lattice2(p, [2.0, 0.0], 4.0).min(lattice2(p, [0.0, 2.0], 4.0));
        let first = lattice2(p, [1.0, 1.0], 2.0);
        // Doubling the squared distance halves the ink of a dot.
        *height = match drawing.step {
            0 => kept.min(second).min(first),
            1 => kept.min(second).min(2.0 * first),
            2 => kept.min(2.0 * second),
            _ => kept,
        };
    }
}

/// Squared distance from `p` to the nearest of the points `start + pitch * (i, j)`.
fn lattice2(p: [f32; 2], start: [f32; 2], pitch: f32) -> f32 {
    let axis = |i: usize| {
        let d = (p[i] - start[i]) / pitch;
        (d - d.round()) * pitch
    };
    axis(0) * axis(0) + axis(1) * axis(1)
}
