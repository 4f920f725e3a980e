//! Tones smoothed within layers: the twins of `smoke.gather_tones`, `blur_rows`, `blur_columns` and `smooth_tones`.
//!
//! Each tone becomes the mean of those around it in the same layer, weighted by a Gaussian [Hoshino 2004, section 3.3].
//! Sums over a layer are sums over the pixels that belong to it, so a wide Gaussian runs on a coarse grid per layer:
//! first along rows, then along columns, and the result is read between the cells.

use npr_core::smoke::SmokePixel;
use rayon::prelude::*;

use super::SmokeLook;

/// The sums of a cell: tone times share, and share.
pub type Cell = [f32; 2];

impl SmokeLook {
    /// Index of the first cell of a layer in row `y`.
    fn row_start(&self, y: u32, layer: u32) -> usize {
        ((y * self.layers + layer) * self.cells[0]) as usize
    }
}

/// Sums the tones of every layer in the cells of its grid, as fractions of a whole cell.
///
/// `size` is that of the picture. Grids lie row by row, in each row layer by layer. O(pixels).
pub fn gather_tones(size: [u32; 2], look: &SmokeLook, pixels: &[SmokePixel], cells: &mut [Cell]) {
    if look.shift == 0 {
        cells.fill([0.0; 2]);
        return;
    }
    let rows = (look.cells[0] * look.layers).max(1) as usize;
    cells.par_chunks_mut(rows).enumerate().for_each(|(y, row)| {
        row.fill([0.0; 2]);
        gather_row(size, look, pixels, y as u32, row);
    });
}

/// One row of cells of all layers. Sums run over the pixels of a cell row by row, as in the shader.
fn gather_row(
    size: [u32; 2],
    look: &SmokeLook,
    pixels: &[SmokePixel],
    cell_y: u32,
    row: &mut [Cell],
) {
    // Add the tone of every pixel to its cell, shared out between up to two layers.
    let part = 1.0 / ((1u32 << look.shift) * (1u32 << look.shift)) as f32;
    let (top, bottom) = (cell_y << look.shift, (cell_y + 1) << look.shift);
    for y in top..bottom.min(size[1]) {
        let start = (y * size[0]) as usize;
        for (x, pixel) in pixels[start..start + size[0] as usize].iter().enumerate() {
            if pixel.place < 0.0 {
                continue;
            }
            let layer = pixel.place as u32;
            for layer in layer..(layer + 2).min(look.layers) {
                let share = SmokeLook::share_of(pixel.place, layer);
                let at = (layer * look.cells[0]) as usize + (x >> look.shift);
                if let Some(cell) = row.get_mut(at) {
                    *cell = [cell[0] + pixel.tone * share, cell[1] + share];
                }
            }
        }
    }

    // Divide the sums by a whole cell.
    for cell in row {
        *cell = cell.map(|sum| sum * part);
    }
}

/// Applies the Gaussian along the rows of every layer's grid. O(cells x taps).
pub fn blur_rows(look: &SmokeLook, cells: &[Cell], blurred: &mut [Cell]) {
    // Empty the cells where tones are smoothed without grids.
    if look.shift == 0 {
        blurred.fill([0.0; 2]);
        return;
    }

    // Weigh the cells to the left and right of each.
    let width = look.cells[0].max(1) as usize;
    let rows = blurred.par_chunks_mut(width).zip(cells.par_chunks(width));
    rows.for_each(|(blurred, cells)| {
        if is_empty(cells) {
            blurred.fill([0.0; 2]);
            return;
        }
        for (x, cell) in blurred.iter_mut().enumerate() {
            let mut sum = [0.0; 2];
            for i in -(look.taps as i32)..=look.taps as i32 {
                let at = x as i32 + i;
                if at >= 0 && at < width as i32 {
                    let (weight, from) = (look.weight(i.unsigned_abs()), cells[at as usize]);
                    sum = [sum[0] + from[0] * weight, sum[1] + from[1] * weight];
                }
            }
            *cell = sum;
        }
    });
}

/// Applies the Gaussian along the columns of every layer's grid. O(cells x taps).
pub fn blur_columns(look: &SmokeLook, cells: &[Cell], blurred: &mut [Cell]) {
    // Empty the cells where tones are smoothed without grids.
    if look.shift == 0 {
        blurred.fill([0.0; 2]);
        return;
    }

    // Add whole rows above and below, each with its weight.
    let width = look.cells[0].max(1) as usize;
    let rows = blurred.par_chunks_mut(width).enumerate();
    rows.for_each(|(row, blurred)| {
        let (y, layer) = (row as u32 / look.layers, row as u32 % look.layers);
        blurred.fill([0.0; 2]);
        for i in -(look.taps as i32)..=look.taps as i32 {
            let at = y as i32 + i;
            if at < 0 || at >= look.cells[1] as i32 {
                continue;
            }
            let start = look.row_start(at as u32, layer);
            let weight = look.weight(i.unsigned_abs());
            for (sum, from) in blurred.iter_mut().zip(&cells[start..start + width]) {
                *sum = [sum[0] + from[0] * weight, sum[1] + from[1] * weight];
            }
        }
    });
}

fn is_empty(cells: &[Cell]) -> bool {
    cells.iter().all(|cell| cell[1] == 0.0)
}

/// The smoothed tone of every pixel, 0 where there is no smoke.
///
/// The tone is read from the grids if there are any, else summed over all pixels in reach. A pixel between two layers
/// takes from each by its share in it. O(pixels), or O(pixels x taps^2) without grids, where taps are at most 11.
pub fn smooth_tones(
    size: [u32; 2],
    look: &SmokeLook,
    pixels: &[SmokePixel],
    cells: &[Cell],
    tones: &mut [f32],
) {
    // Find once the cells and weights that columns of pixels share.
    let with = Smoothing {
        size,
        look,
        pixels,
        cells,
        columns: (0..size[0]).map(|x| Taps::new(look, x, 0)).collect(),
    };

    // Smooth the tones row by row.
    let width = size[0].max(1) as usize;
    tones
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            let rows = Taps::new(look, y as u32, 1);
            for (x, tone) in row.iter_mut().enumerate() {
                *tone = with.tone([x as u32, y as u32], &rows);
            }
        });
}

struct Smoothing<'a> {
    size: [u32; 2],
    look: &'a SmokeLook,
    pixels: &'a [SmokePixel],
    cells: &'a [Cell],
    /// The cells and weights for every column of pixels.
    columns: Vec<Taps>,
}

/// The four cells along an axis that a row or column of pixels reads, and their weights.
struct Taps {
    cells: [u32; 4],
    weights: [f32; 4],
}

impl Taps {
    fn new(look: &SmokeLook, px: u32, axis: usize) -> Self {
        let cell = (1u32 << look.shift) as f32;
        let at = (px as f32 + 0.5) / cell - 0.5;
        let low = at.floor();
        let last = look.cells[axis] as f32 - 1.0;
        Self {
            cells: std::array::from_fn(|k| (low + k as f32 - 1.0).clamp(0.0, last) as u32),
            weights: spline(at - low),
        }
    }
}

impl Smoothing<'_> {
    fn tone(&self, [x, y]: [u32; 2], rows: &Taps) -> f32 {
        let own = self.pixels[(y * self.size[0] + x) as usize];
        if own.place < 0.0 {
            return 0.0;
        }
        if self.look.taps == 0 && self.look.shift == 0 {
            return own.tone;
        }
        let layer = own.place as u32;
        let passed = own.place - layer as f32;
        let mut tone = self.mean_of([x, y], rows, layer, own.tone);
        if passed > 0.0 {
            tone += (self.mean_of([x, y], rows, layer + 1, own.tone) - tone) * passed;
        }
        tone
    }

    /// The mean tone of a layer around a pixel; `own` if nothing of the layer is near.
    fn mean_of(&self, [x, y]: [u32; 2], rows: &Taps, layer: u32, own: f32) -> f32 {
        let sum = match self.look.shift {
            0 => self.window_sum(x, y, layer),
            _ => self.grid_sum(&self.columns[x as usize], rows, layer),
        };
        if sum[1] > 1e-12 { sum[0] / sum[1] } else { own }
    }

    /// The sums of the published method, over all pixels in reach.
    fn window_sum(&self, x: u32, y: u32, layer: u32) -> Cell {
        let taps = self.look.taps;
        let (left, right) = (x.saturating_sub(taps), (x + taps).min(self.size[0] - 1));
        let (top, bottom) = (y.saturating_sub(taps), (y + taps).min(self.size[1] - 1));
        let mut sum = [0.0; 2];
        for row in top..=bottom {
            for column in left..=right {
                let pixel = self.pixels[(row * self.size[0] + column) as usize];
                let weight = self.look.weight(row.abs_diff(y))
                    * self.look.weight(column.abs_diff(x))
                    * SmokeLook::share_of(pixel.place, layer);
                sum = [sum[0] + pixel.tone * weight, sum[1] + weight];
            }
        }
        sum
    }

    /// The sums between the sixteen cells around a pixel, by a cubic B-spline: edges of tones bend without kinks.
    fn grid_sum(&self, columns: &Taps, rows: &Taps, layer: u32) -> Cell {
        let mut sum = [0.0; 2];
        for (row, weight_y) in rows.cells.into_iter().zip(rows.weights) {
            let start = self.look.row_start(row, layer);
            for (column, weight_x) in columns.cells.into_iter().zip(columns.weights) {
                let from = self.cells[start + column as usize];
                let weight = weight_y * weight_x;
                sum = [sum[0] + from[0] * weight, sum[1] + from[1] * weight];
            }
        }
        sum
    }
}

/// Weights of four cells for a place `t` of the way from the second to the third, by the cubic B-spline.
fn spline(t: f32) -> [f32; 4] {
    let s = 1.0 - t;
    [
        s * s * s / 6.0,
        (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
        (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0,
        t * t * t / 6.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::math::mix_bits;
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [40, 28];

    /// Patches of a few pixels in random layers and tones, some without smoke.
    fn picture(seed: u32, layers: u32, blends: bool) -> Vec<SmokePixel> {
        let random = |x: u32, y: u32, k: u32| mix_bits(seed ^ mix_bits(x * 977 + y * 31 + k)) >> 8;
        let pixel = |i: u32| {
            let (x, y) = (i % SIZE[0], i / SIZE[0]);
            let patch = random(x / 6, y / 5, 1) % (layers + 1);
            let part = (random(x / 3, y / 3, 2) % 3) as f32 * 0.5;
            let place = patch as f32
                + if blends && patch + 1 < layers {
                    part
                } else {
                    0.0
                };
            SmokePixel {
                tone: (random(x / 2, y / 2, 3) % 1000) as f32 / 999.0,
                place: if patch == layers { -1.0 } else { place },
                ..SmokePixel::default()
            }
        };
        (0..SIZE[0] * SIZE[1]).map(pixel).collect()
    }

    fn look(sigma: f32, layers: u32) -> SmokeLook {
        let mut look = SmokeLook {
            layers,
            ..SmokeLook::default()
        };
        look.smooth(SIZE, sigma);
        look
    }

    fn smoothed(look: &SmokeLook, pixels: &[SmokePixel]) -> Vec<f32> {
        let mut cells = vec![[9.0; 2]; look.cell_count()];
        let mut blurred = cells.clone();
        gather_tones(SIZE, look, pixels, &mut cells);
        blur_rows(look, &cells, &mut blurred);
        blur_columns(look, &blurred, &mut cells);
        let mut tones = vec![9.0; pixels.len()];
        smooth_tones(SIZE, look, pixels, &cells, &mut tones);
        tones
    }

    /// Equations c' and w of the paper as they stand, over the whole picture; a pixel between two layers has both.
    fn published(sigma: f64, pixels: &[SmokePixel], at: usize) -> f64 {
        let own = f64::from(pixels[at].place);
        let width = SIZE[0] as usize;
        let mean_of = |layer: f64| {
            let (mut c, mut w) = (0.0, 0.0);
            for (i, pixel) in pixels.iter().enumerate().filter(|(_, p)| p.place >= 0.0) {
                let dx = (i % width) as f64 - (at % width) as f64;
                let dy = (i / width) as f64 - (at / width) as f64;
                let same = (1.0 - (f64::from(pixel.place) - layer).abs()).max(0.0);
                let weight = (-(dx * dx + dy * dy) / (2.0 * sigma * sigma)).exp() * same;
                c += weight * f64::from(pixel.tone);
                w += weight;
            }
            c / w
        };
        let passed = own - own.floor();
        mean_of(own.floor()) * (1.0 - passed)
            + if passed > 0.0 {
                mean_of(own.floor() + 1.0) * passed
            } else {
                0.0
            }
    }

    fn largest_error(sigma: f32, layers: u32, pixels: &[SmokePixel], step: usize) -> f64 {
        let tones = smoothed(&look(sigma, layers), pixels);
        let seen = (0..pixels.len())
            .step_by(step)
            .filter(|i| pixels[*i].place >= 0.0);
        seen.map(|i| (published(f64::from(sigma), pixels, i) - f64::from(tones[i])).abs())
            .fold(0.0, f64::max)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Within 0.004 of a tone: what lies beyond 3.5 deviations is left out.
        #[test]
        fn windows_are_the_published_sum(seed: u32, sigma in 0.3f32..2.99, layers in 1u32..5, blends: bool) {
            let error = largest_error(sigma, layers, &picture(seed, layers, blends), 37);
            prop_assert!(error < 0.004, "{error}");
        }

        /// Within 0.06 of a tone at every pixel of a noisy picture: less than a third of a tone's step in a ramp of
        /// three.
        #[test]
        fn grids_are_near_the_published_sum(seed: u32, sigma in 3f32..14.0, layers in 1u32..5, blends: bool) {
            let error = largest_error(sigma, layers, &picture(seed, layers, blends), 37);
            prop_assert!(error < 0.06, "{error}");
        }

        #[test]
        fn smoothing_keeps_even_tones_and_stays_within_others(seed: u32, sigma in 0f32..60.0, layers in 1u32..5) {
            let mut pixels = picture(seed, layers, true);
            let tones = smoothed(&look(sigma, layers), &pixels);
            prop_assert!(tones.iter().all(|tone| (-1e-5..=1.00001).contains(tone)));
            for pixel in &mut pixels { pixel.tone = 0.3; }
            for (pixel, tone) in pixels.iter().zip(smoothed(&look(sigma, layers), &pixels)) {
                let wanted = if pixel.place < 0.0 { 0.0 } else { 0.3 };
                prop_assert!((tone - wanted).abs() < 1e-4, "{tone}");
            }
        }
    }

    #[test]
    fn layers_do_not_mix_and_a_lone_pixel_keeps_its_tone() {
        let mut pixels = picture(1, 1, false);
        for (i, pixel) in pixels.iter_mut().enumerate() {
            let is_left = i as u32 % SIZE[0] < 20;
            pixel.place = if is_left { 0.0 } else { 1.0 };
            pixel.tone = if is_left { 0.0 } else { 1.0 };
        }
        pixels[14 * 40 + 5].place = 2.0;
        pixels[14 * 40 + 5].tone = 0.7;
        for sigma in [2.0, 8.0] {
            let tones = smoothed(&look(sigma, 3), &pixels);
            assert!(tones[14 * 40 + 19] < 1e-5 && tones[14 * 40 + 20] > 0.999);
            assert!((tones[14 * 40 + 5] - 0.7).abs() < 1e-3);
        }
    }

    #[test]
    fn cost_does_not_grow_with_the_deviation() {
        for sigma in [3.0, 10.0, 100.0, 1e9, f32::NAN] {
            let mut look = look(sigma, 16);
            look.smooth([4000, 1000], sigma);
            let taps = u64::from(look.taps) * look.cell_count() as u64;
            assert!(taps <= 11 * super::super::CELLS_MAX, "{sigma}: {look:?}");
        }
    }
}
