//! Tones and outlines of every pixel: the twin of `smoke.resolve`.

use npr_core::color::SrgbEncoder;
use npr_core::geometry::FAR_DEPTH;
use npr_core::smoke::{SmokePixel, SphereView, ViewSphere};
use npr_core::window::Window;
use rayon::prelude::*;
use std::ops::Range;

use super::SmokeLook;
use crate::ramp::Level;

/// Low bits of a depth: which samples of the pixel the smoke covers.
pub const MASK: u32 = 15;

/// Offsets of a pixel's neighbourhood: itself, then those beside it.
const AROUND: [[i32; 2]; 9] = [
    [0, 0],
    [-1, 0],
    [1, 0],
    [0, -1],
    [0, 1],
    [-1, -1],
    [1, -1],
    [-1, 1],
    [1, 1],
];

/// Pixels of a row that are checked together for smoke.
const RUN: usize = 32;

/// What a picture of smoke is resolved from.
#[derive(Debug, Clone, Copy)]
pub struct Resolving<'a> {
    /// The eye.
    pub lens: &'a SphereView,
    /// The pixel grid.
    pub window: &'a Window,
    /// Settings.
    pub look: &'a SmokeLook,
    /// Numbers of the nearest spheres, plus one.
    pub ids: &'a [u32],
    /// The spheres as the eye sees them.
    pub balls: &'a [ViewSphere],
    /// Depth and layer of every pixel.
    pub pixels: &'a [SmokePixel],
    /// Smoothed tones.
    pub tones: &'a [f32],
}

/// Gives colours as sRGB bytes with straight alpha, and depths as bits of a float whose low four say which samples are
/// covered; both 0 without smoke.
///
/// Most pixels show one sphere. Where several meet or smoke ends, the spheres of the nine pixels around are tested for
/// every sample, so edges are as smooth as the frame's samples. O(pixels).
pub fn resolve(with: &Resolving<'_>, colors: &mut [u32], depths: &mut [u32]) {
    // Resolve rows; runs without smoke around are emptied at once.
    let width = with.window.size[0] as usize;
    if width == 0 {
        return;
    }
    let encoder = SrgbEncoder::new();
    colors
        .par_chunks_mut(width)
        .zip(depths.par_chunks_mut(width))
        .enumerate()
        .for_each(|(y, (colors, depths))| {
            for left in (0..width).step_by(RUN) {
                let run = left..width.min(left + RUN);
                let (colors, depths) = (&mut colors[run.clone()], &mut depths[run.clone()]);
                if with.is_empty_around(run, y) {
                    colors.fill(0);
                    depths.fill(0);
                    continue;
                }
                for (x, (color, depth)) in (left as u32..).zip(colors.iter_mut().zip(depths)) {
                    let (drawn, bits) = with.texel(x, y as u32);
                    (*color, *depth) = (packed(&encoder, drawn), bits);
                }
            }
        });
}

/// The spheres that a pixel's samples show, as indices into [`AROUND`].
struct Seen {
    owners: [Option<usize>; 4],
    count: usize,
}

impl Resolving<'_> {
    /// A neighbour, clamped to the picture.
    fn pixel_near(&self, x: u32, y: u32, dx: i32, dy: i32) -> [u32; 2] {
        let [width, height] = self.window.size.map(|side| side as i32);
        [
            (x as i32 + dx).clamp(0, width - 1) as u32,
            (y as i32 + dy).clamp(0, height - 1) as u32,
        ]
    }

    /// Index of a neighbour, clamped to the picture.
    pub(super) fn texel_near(&self, x: u32, y: u32, dx: i32, dy: i32) -> usize {
        let [x, y] = self.pixel_near(x, y, dx, dy);
        (y * self.window.size[0] + x) as usize
    }

    /// Whether some pixels of a row, and all pixels around them, are without smoke.
    fn is_empty_around(&self, run: Range<usize>, y: usize) -> bool {
        let [width, height] = self.window.size.map(|side| side as usize);
        let (left, right) = (run.start.saturating_sub(1), width.min(run.end + 1));
        (y.saturating_sub(1)..height.min(y + 2)).all(|row| {
            let ids = &self.ids[row * width + left..row * width + right];
            ids.iter().fold(0, |all, id| all | id) == 0
        })
    }

    fn texel(&self, x: u32, y: u32) -> ([f32; 4], u32) {
        // Paint a pixel within one sphere, or within nothing, without looking at its samples.
        if let Some(id) = self.only_around(x, y) {
            let texel = self.texel_near(x, y, 0, 0);
            return match id {
                0 => ([0.0; 4], 0),
                _ => (
                    self.paint_inside(id, texel, self.window.frame_at(x, y)),
                    with_mask(self.pixels[texel].depth, MASK),
                ),
            };
        }

        // Leave out pixels with no smoke around, and use the published method if asked for.
        let around = AROUND.map(|[dx, dy]| self.texel_near(x, y, dx, dy));
        let ids = around.map(|texel| self.ids[texel]);
        if ids.iter().all(|id| *id == 0) {
            return ([0.0; 4], 0);
        }
        if self.look.flags & SmokeLook::PUBLISHED != 0 {
            return self.published(x, y, &around);
        }

        // Paint one sphere whole, and blend several by samples.
        let frame_px = self.window.frame_at(x, y);
        if ids.iter().all(|id| *id == ids[0]) {
            let color = self.paint(ids[0], [x, y], frame_px);
            return (color, with_mask(self.pixels[around[0]].depth, MASK));
        }
        let seen = self.seen(&ids, frame_px);
        self.blended(&seen, &ids, [x, y], frame_px)
    }

    /// The number that a pixel and its eight neighbours share, if they do; `None` at the picture's border and in the
    /// published method, whose lines may lie on pixels without smoke.
    fn only_around(&self, x: u32, y: u32) -> Option<u32> {
        let [width, height] = self.window.size;
        let is_inside = x > 0 && y > 0 && x + 1 < width && y + 1 < height;
        if !is_inside || self.look.flags & SmokeLook::PUBLISHED != 0 {
            return None;
        }
        let (here, width) = ((y * width + x) as usize, width as usize);
        let id = self.ids[here];
        let is_same = |middle: usize| {
            let row = &self.ids[middle - 1..=middle + 1];
            row[0] == id && row[1] == id && row[2] == id
        };
        let same = is_same(here) && is_same(here - width) && is_same(here + width);
        same.then_some(id)
    }

    /// The nearest sphere in every sample, among those of the nine pixels.
    fn seen(&self, ids: &[u32; 9], frame_px: [f32; 2]) -> Seen {
        // Send a ray through every sample.
        let samples = self.look.samples;
        let mut seen = Seen {
            owners: [None; 4],
            count: (samples * samples) as usize,
        };
        let mut nearest = [FAR_DEPTH; 4];
        let rays: [[f32; 2]; 4] =
            std::array::from_fn(|i| self.lens.ray(self.sample_at(frame_px, i)));

        // Keep the nearest of the spheres that the neighbours show.
        for k in 0..9 {
            if ids[k] == 0 || ids[..k].contains(&ids[k]) {
                continue;
            }
            let ball = &self.balls[(ids[k] - 1) as usize];
            for i in 0..seen.count {
                let depth = self.lens.depth_of(ball, rays[i]);
                if depth < nearest[i] {
                    (nearest[i], seen.owners[i]) = (depth, Some(k));
                }
            }
        }
        seen
    }

    /// Frame position of sample `i` of the pixel at `frame_px`.
    fn sample_at(&self, frame_px: [f32; 2], i: usize) -> [f32; 2] {
        if self.look.samples == 1 {
            return frame_px;
        }
        let step = self.window.frame_step;
        [
            frame_px[0] + ((i & 1) as f32 * 0.5 - 0.25) * step[0],
            frame_px[1] + ((i >> 1) as f32 * 0.5 - 0.25) * step[1],
        ]
    }

    /// The mean colour of the samples, and the depth of the first.
    fn blended(
        &self,
        seen: &Seen,
        ids: &[u32; 9],
        [x, y]: [u32; 2],
        frame_px: [f32; 2],
    ) -> ([f32; 4], u32) {
        // Paint each sphere once, and weigh it by its samples.
        let owners = &seen.owners[..seen.count];
        let (mut sum, mut covered, mut mask, mut depth) = ([0.0; 4], 0.0, 0, FAR_DEPTH);
        for (i, owner) in owners.iter().enumerate() {
            let Some(k) = *owner else { continue };
            mask |= 1 << i;
            covered += 1.0;
            if owners[..i].contains(owner) {
                continue;
            }
            let count = owners[i..].iter().filter(|other| *other == owner).count() as f32;
            let shown = self.pixel_near(x, y, AROUND[k][0], AROUND[k][1]);
            let [r, g, b, a] = self.paint(ids[k], shown, frame_px);
            let weight = a * count;
            sum = [
                sum[0] + r * weight,
                sum[1] + g * weight,
                sum[2] + b * weight,
                sum[3] + weight,
            ];
            depth = depth.min(self.pixels[self.texel_near(x, y, AROUND[k][0], AROUND[k][1])].depth);
        }

        // Turn the sums into a colour, as opaque as samples are covered.
        if mask == 0 {
            return ([0.0; 4], 0);
        }
        let whole = sum[3].max(1e-6);
        let color = [
            sum[0] / whole,
            sum[1] / whole,
            sum[2] / whole,
            sum[3] / covered,
        ];
        (color, with_mask(depth, mask))
    }

    /// Tone and line of sphere `id` at a position; the tone is that of a pixel which shows it. Linear light, straight
    /// alpha.
    fn paint(&self, id: u32, pixel: [u32; 2], frame_px: [f32; 2]) -> [f32; 4] {
        let tone = self.tones[self.texel_near(pixel[0], pixel[1], 0, 0)];
        let [r, g, b] = self.look.color_of(tone, self.slope_at(pixel));
        self.look
            .under_line([r, g, b, self.look.alpha], self.line_at(id, frame_px))
    }

    /// [`paint`](Self::paint) for a pixel whose eight neighbours show the same sphere: all lie in one layer.
    fn paint_inside(&self, id: u32, texel: usize, frame_px: [f32; 2]) -> [f32; 4] {
        let width = self.window.size[0] as usize;
        let across = (self.tones[texel + 1] - self.tones[texel - 1]) * 0.5;
        let down = (self.tones[texel + width] - self.tones[texel - width]) * 0.5;
        let slope = (across * across + down * down).sqrt();
        let [r, g, b] = self.look.color_of(self.tones[texel], slope);
        self.look
            .under_line([r, g, b, self.look.alpha], self.line_at(id, frame_px))
    }

    /// Change of the smoothed tone per pixel, among neighbours of the same layer.
    fn slope_at(&self, [x, y]: [u32; 2]) -> f32 {
        let near = |dx, dy| self.texel_near(x, y, dx, dy);
        let here = near(0, 0);
        let across = self.change([near(-1, 0), here, near(1, 0)]);
        let down = self.change([near(0, -1), here, near(0, 1)]);
        (across * across + down * down).sqrt()
    }

    /// Change of tone per pixel over three pixels in a row.
    fn change(&self, [before, here, after]: [usize; 3]) -> f32 {
        let place = self.pixels[here].place;
        let is_same =
            |texel: usize| texel != here && (self.pixels[texel].place - place).abs() < 0.5;
        match (is_same(before), is_same(after)) {
            (true, true) => (self.tones[after] - self.tones[before]) * 0.5,
            (true, false) => self.tones[here] - self.tones[before],
            (false, true) => self.tones[after] - self.tones[here],
            (false, false) => 0.0,
        }
    }

    /// As published: one tone per pixel, and lines from differences of depth.
    fn published(&self, x: u32, y: u32, around: &[usize; 9]) -> ([f32; 4], u32) {
        let line = self.published_line(x, y);
        let is_smoke = self.ids[around[0]] != 0;
        if line == 0.0 && !is_smoke {
            return ([0.0; 4], 0);
        }
        let mut color = [0.0; 4];
        if is_smoke {
            let [r, g, b] = self.look.color_of(self.tones[around[0]], 0.0);
            color = [r, g, b, self.look.alpha];
        }
        let nearest = around
            .iter()
            .map(|texel| self.pixels[*texel].depth)
            .fold(FAR_DEPTH, f32::min);
        let color = self.look.under_line(color, line);
        (color, with_mask(nearest, MASK))
    }
}

impl SmokeLook {
    /// Colour of a tone that changes by `slope` per pixel, linear light: steps are as wide as a pixel, or softer.
    ///
    /// Each step is a ramp over the change of tone within one pixel, so edges are smooth even at one sample per pixel.
    pub(super) fn color_of(&self, tone: f32, slope: f32) -> [f32; 3] {
        let width = self.softness.max(slope).max(1e-6);
        let levels: &[Level] = bytemuck::cast_slice(&self.ramp);
        let mut color = levels[0].light;
        for level in &levels[1..] {
            if level.at > 1.5 {
                break;
            }
            let t = ((tone - level.at) / width + 0.5).clamp(0.0, 1.0);
            color = std::array::from_fn(|i| color[i] + (level.light[i] - color[i]) * t);
        }
        color
    }

    /// A colour under a line that covers `line` of it; linear light, straight alpha.
    fn under_line(&self, color: [f32; 4], line: f32) -> [f32; 4] {
        let top = line * self.line_color[3];
        let alpha = top + color[3] * (1.0 - top);
        let part = top / alpha.max(1e-6);
        let mixed = |i: usize| color[i] + (self.line_color[i] - color[i]) * part;
        [mixed(0), mixed(1), mixed(2), alpha]
    }
}

/// Linear light with straight alpha as sRGB bytes.
fn packed(encoder: &SrgbEncoder, [r, g, b, a]: [f32; 4]) -> u32 {
    let [r, g, b] = [r, g, b].map(|light| encoder.byte(light));
    r | g << 8 | b << 16 | ((a.clamp(0.0, 1.0) * 255.0 + 0.5) as u32) << 24
}

/// A depth whose low bits hold the covered samples; 19 bits of the depth's own fraction remain.
fn with_mask(depth: f32, mask: u32) -> u32 {
    depth.to_bits() & !MASK | mask
}
