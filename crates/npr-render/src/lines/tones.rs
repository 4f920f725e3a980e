//! The tones of smoke as areas: those of its picture, traced.

use super::LineOptions;
use crate::error::RenderError;
use crate::model::Model;
use crate::renderer::{Picture, Renderer, RendererOptions};
use crate::smoke::Smoke;
use npr_core::camera::Camera;
use npr_core::color::linear_from_byte;
use npr_gpu::processor::Processor;
use npr_stylesheet::{
    Background, Color, SmokeInk, SmokeLines, SmokeMethod, SmokeStop, SmokeStyle, Style,
};
use std::collections::BTreeMap;

/// How far tones go on beyond the smoke, in pixels, so that their edges reach its outline.
const BEYOND_PX: usize = 3;

/// Rounds in which tones are evened out, over a pixel more each.
const ROUNDS: usize = 4;

/// Tones that differ by less are of one slope.
const ALIKE: f32 = 0.06;

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
    /// Draws the smoke as pictures have it, on the processor, lit by the lights of a model without surfaces.
    pub fn new(
        smoke: &Smoke,
        (model, pictures): (&Model, &BTreeMap<String, Picture>),
        style: &Style,
        options: &LineOptions,
        camera: &Camera,
    ) -> Result<Self, RenderError> {
        let renderer_options = RendererOptions {
            dpi: options.dpi,
            smoke: Some(smoke.clone()),
            pictures: pictures.clone(),
            ..RendererOptions::new(options.size)
        };
        let telling = telling_tones(style);
        let mut renderer = Renderer::new(&Processor, model, &telling, &renderer_options)?;
        let frame = renderer.draw(camera)?;
        let pixels = frame.rgba.as_chunks::<4>().0;
        let tone = |[r, g, _, a]: &[u8; 4]| match a {
            0 => f32::NAN,
            _ => 0.5 * (linear_from_byte(*r) + linear_from_byte(*g)),
        };
        let mut map = Self {
            size: frame.size.map(|side| side as usize),
            tones: pixels.iter().map(tone).collect(),
            steps: style.smoke.ramp.iter().skip(1).map(|s| s.at).collect(),
        };
        for _ in 0..BEYOND_PX {
            map.grow();
        }
        for _ in 0..ROUNDS {
            map.even_out();
        }
        Ok(map)
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

    /// Gives pixels the mean of those around with about their tone: bytes make steps of gentle slopes, which edges
    /// would follow.
    fn even_out(&mut self) {
        let evened = (0..self.tones.len()).map(|i| {
            let (x, y, own) = (i % self.size[0], i / self.size[0], self.tones[i]);
            let (mut sum, mut count) = (0.0, 0.0);
            for step in 0..9 {
                let beside = self.at(
                    (x + step % 3).wrapping_sub(1),
                    (y + step / 3).wrapping_sub(1),
                );
                if (beside - own).abs() < ALIKE {
                    (sum, count) = (sum + beside, count + 1.0);
                }
            }
            sum / count
        });
        self.tones = evened.collect();
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

/// Where values, known in the middles of cells of a picture, pass through any of the steps, in pieces within a cell
/// of four of them; none where a value is no number.
pub(super) fn level_lines(
    cells: [usize; 2],
    cell_px: f64,
    value_at: &dyn Fn(usize, usize) -> f32,
    steps: &[f32],
) -> Vec<[[f64; 2]; 2]> {
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
    for place in edges.as_flattened_mut() {
        *place = place.map(|v| v * cell_px);
    }
    edges
}

/// A style whose smoke tells its tone: red counts up to the half, green on from there.
fn telling_tones(style: &Style) -> Style {
    let stop = |at, r, g| SmokeStop {
        at,
        color: Color::rgb(r, g, 0),
    };
    let mut telling = Style {
        background: Background::Transparent,
        smoke: SmokeStyle {
            method: SmokeMethod::Spheres,
            ramp: vec![stop(0.0, 0, 0), stop(0.25, 255, 0), stop(0.75, 255, 255)],
            softness: 0.5,
            opacity: 1.0,
            ramp_image: String::new(),
            ink: SmokeInk::default(),
            ..style.smoke.clone()
        },
        light: style.light.clone(),
        ..Style::default()
    };
    telling.smoke.line.method = SmokeLines::Off;
    telling.antialias.samples = 1;
    telling
}

/// Where a square of four places, clockwise from the upper left, passes from below a tone to above it.
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
        map.even_out();
        assert!((map.at(3, 3) - 0.7).abs() < 1e-6 && map.at(1, 1).is_nan());
        assert_eq!(map.level_at([3.5, 3.5]), 1);
        assert_eq!(map.level_at([-9.0, 1e9]), 0);
    }
}
