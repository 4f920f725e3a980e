//! The tones of smoke as areas, traced from the numbers behind its picture.

use super::LineOptions;
use crate::error::RenderError;
use crate::features::smoke::{Measure, SmokeMoment, SmokePasses};
use crate::frame_graph::{pixel_count, write};
use crate::light::ChosenLights;
use crate::tiles::{TILE_PIXELS, Tiles};
use npr_core::window::Window;
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::pass::Format;
use npr_gpu::processor::Processor;
use npr_stylesheet::{SmokeMethod, SmokeStyle, Style};

/// How far tones go on beyond the smoke, in pixels, so that their edges reach its outline.
const BEYOND_PX: usize = 3;

/// Smoothed tones of a picture of smoke.
#[derive(Debug)]
pub(super) struct ToneMap {
    size: [usize; 2],
    /// Tone of every pixel, 0..1; not a number away from the smoke.
    tones: Vec<f32>,
    /// Where each tone of the style but the first begins.
    steps: Vec<f32>,
}

impl ToneMap {
    /// Draws the smoke as pictures have it, as spheres and on the processor, lit by `chosen`.
    pub fn new(
        moment: &SmokeMoment<'_>,
        chosen: ChosenLights,
        options: &LineOptions,
    ) -> Result<Self, RenderError> {
        let style = Style {
            smoke: SmokeStyle {
                method: SmokeMethod::Spheres,
                ..moment.style.smoke.clone()
            },
            ..moment.style.clone()
        };
        let moment = SmokeMoment {
            style: &style,
            ..*moment
        };

        // Plan the passes of smoke alone, for one tile of the picture.
        let mut measure = Measure {
            height_px: options.size[1] as f32,
            dpi: options.dpi,
            size: options.size,
            samples: 1,
        };
        let margin = measure.reach_px(&style.smoke).min(1e4) as u32;
        let tiles = Tiles::new(options.size, margin, TILE_PIXELS);
        measure.size = tiles.size();
        let mut graph = Graph::new();
        let window = graph.uniform::<Window>("output window");
        let none = graph.image("no surfaces", Format::Depth, [1, 1]);
        let sized = (&style.smoke, moment.smoke.spheres.len());
        let unshaded = (none, 0);
        let passes = SmokePasses::plan(&mut graph, (measure, chosen), sized, window, unshaded);
        let mut session = Processor.prepare(graph)?;
        passes.upload(session.as_mut(), moment.smoke, &style.smoke)?;
        passes.upload_view(session.as_mut(), &moment)?;

        // Read the tones of every tile where it shows smoke.
        let mut map = Self {
            size: options.size.map(|side| side as usize),
            tones: vec![f32::NAN; pixel_count(options.size)],
            steps: style.smoke.ramp.iter().skip(1).map(|s| s.at).collect(),
        };
        for origin in tiles.origins() {
            let [width, height] = measure.size;
            let extent = [width as f32, height as f32];
            let corner = tiles.corner_px(origin);
            let over = Window::over(moment.view.frame_px, corner, extent, measure.size);
            write(session.as_mut(), window, &[over])?;
            let (_, mut read) = session.run_reading(&[passes.ids, passes.tones])?;
            let (ids, tones) = (read.take(passes.ids), read.take(passes.tones));
            let tone_of = |(id, tone): (&u32, &u32)| match id {
                0 => f32::NAN,
                _ => f32::from_bits(*tone),
            };
            let tones: Vec<f32> = ids.iter().zip(&tones).map(tone_of).collect();
            map.paste(&tones, width as usize, &tiles, origin);
        }

        // Let them go on a little beyond the smoke.
        for _ in 0..BEYOND_PX {
            map.grow();
        }
        Ok(map)
    }

    /// Copies the part of a tile that is kept.
    fn paste(&mut self, tile: &[f32], tile_width: usize, tiles: &Tiles, origin: [u32; 2]) {
        let [left, top] = origin.map(|at| at as usize);
        let [columns, rows] = tiles.kept.map(|side| side as usize);
        let (columns, rows) = (
            columns.min(self.size[0] - left),
            rows.min(self.size[1] - top),
        );
        let margin = tiles.margin as usize;
        for row in 0..rows {
            let from = (margin + row) * tile_width + margin;
            let to = (top + row) * self.size[0] + left;
            self.tones[to..to + columns].copy_from_slice(&tile[from..from + columns]);
        }
    }

    fn at(&self, x: usize, y: usize) -> f32 {
        let is_inside = x < self.size[0] && y < self.size[1];
        let found = is_inside.then(|| self.tones.get(y * self.size[0] + x));
        found.flatten().copied().unwrap_or(f32::NAN)
    }

    /// Gives pixels beside the smoke the mean tone of those around.
    fn grow(&mut self) {
        let [width, height] = self.size;
        let grown = (0..width * height).map(|i| {
            let (x, y) = (i % width, i / width);
            if !self.tones[i].is_nan() {
                return self.tones[i];
            }

            // Take the mean of the neighbours that have a tone.
            let (mut sum, mut count) = (0.0, 0.0);
            for step in 0..9 {
                let beside = self.at(
                    (x + step % 3).wrapping_sub(1),
                    (y + step / 3).wrapping_sub(1),
                );
                if !beside.is_nan() {
                    (sum, count) = (sum + beside, count + 1.0);
                }
            }
            sum / count
        });
        self.tones = grown.collect();
    }

    /// Which tone of the style a place in the picture has, from 0.
    pub fn level_at(&self, [x, y]: [f64; 2]) -> u32 {
        let tone = self.at(x.max(0.0) as usize, y.max(0.0) as usize);
        self.steps.iter().filter(|step| tone >= **step).count() as u32
    }

    /// The lines between tones, in pieces shorter than two pixels.
    pub fn edges(&self) -> Vec<[[f64; 2]; 2]> {
        level_lines(self.size, 1.0, &|x, y| self.at(x, y), &self.steps)
    }
}

/// Pieces of the lines, in pixels, along which values pass through any of `steps`. Values are known in the middles of
/// `cells`; a piece lies in a square of four of them, and there is none where one is not a number.
pub(super) fn level_lines(
    cells: [usize; 2],
    cell_px: f64,
    value_at: &dyn Fn(usize, usize) -> f32,
    steps: &[f32],
) -> Vec<[[f64; 2]; 2]> {
    // Look at squares of four values, two rows at a time.
    let row = |y: usize| -> Vec<f32> { (0..cells[0]).map(|x| value_at(x, y)).collect() };
    let mut edges = Vec::new();
    let mut upper = row(0);
    for y in 1..cells[1] {
        let lower = row(y);
        for x in 1..cells[0] {
            let corners = [upper[x - 1], upper[x], lower[x], lower[x - 1]];
            if corners.iter().all(|value| !value.is_nan()) {
                let origin = [x as f64 - 0.5, y as f64 - 0.5];
                let steps = steps.iter();
                steps.for_each(|step| add_edges(origin, corners, *step, &mut edges));
            }
        }
        upper = lower;
    }

    // Turn cells into pixels.
    for place in edges.as_flattened_mut() {
        *place = place.map(|v| v * cell_px);
    }
    edges
}

/// Adds where a square of four places, clockwise from the upper left, passes from below a tone to above it.
fn add_edges(origin: [f64; 2], corners: [f32; 4], step: f32, edges: &mut Vec<[[f64; 2]; 2]>) {
    let above = corners.map(|tone| tone >= step);
    if above == [above[0]; 4] {
        return;
    }
    let places = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let crossing = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        let t = f64::from((step - a) / (b - a)).clamp(0.0, 1.0);
        let (from, to): ([f64; 2], [f64; 2]) = (places[i], places[(i + 1) % 4]);
        std::array::from_fn(|k| origin[k] + from[k] + (to[k] - from[k]) * t)
    };
    let sides: Vec<usize> = (0..4)
        .filter(|i| above[*i] != above[(*i + 1) % 4])
        .collect();
    // Where tones lie crosswise the mean says which two corners hang together.
    let is_mean_above = corners.iter().sum::<f32>() / 4.0 >= step;
    let turn = usize::from(sides.len() == 4 && is_mean_above == above[0]);
    for pair in 0..sides.len() / 2 {
        let [a, b] = [2 * pair + turn, 2 * pair + turn + 1].map(|i| sides[i % sides.len()]);
        edges.push([crossing(a), crossing(b)]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn map_of(size: [usize; 2], tones: Vec<f32>, steps: Vec<f32>) -> ToneMap {
        ToneMap { size, tones, steps }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Between two neighbours of different tones runs an odd number of edges for each step between them, else an
        /// even one.
        #[test]
        fn edges_part_what_differs(tones in prop::collection::vec(0f32..1.0, 36), step in 0.1f32..0.9) {
            let map = map_of([6, 6], tones, vec![step]);
            let edges = map.edges();
            for y in 1..5 {
                for x in 0..5 {
                    let differ = (map.at(x, y) >= step) != (map.at(x + 1, y) >= step);
                    let on_side = |p: &[f64; 2]| {
                        (p[1] - y as f64 - 0.5).abs() < 1e-9 && p[0] >= x as f64 + 0.5 && p[0] <= x as f64 + 1.5
                    };
                    // Each crossing of this side ends one piece above it and one below.
                    let ends = edges.iter().flatten().filter(|p| on_side(p)).count();
                    prop_assert!(!differ || ends >= 2, "{} ends beside {}, {}", ends, x, y);
                }
            }
            prop_assert_eq!(map.level_at([2.5, 2.5]), u32::from(map.at(2, 2) >= step));
        }
    }

    #[test]
    fn tones_reach_a_little_beyond_the_smoke() {
        let mut tones = vec![f32::NAN; 49];
        tones[24] = 0.7;
        let mut map = map_of([7, 7], tones, vec![0.5]);
        assert_eq!(map.edges(), Vec::<[[f64; 2]; 2]>::new());
        map.grow();
        assert!((map.at(2, 2) - 0.7).abs() < 1e-6 && map.at(1, 1).is_nan());
        assert!((map.at(3, 3) - 0.7).abs() < 1e-6);
        assert_eq!(map.level_at([3.5, 3.5]), 1);
        assert_eq!(map.level_at([-9.0, 1e9]), 0);
    }
}
