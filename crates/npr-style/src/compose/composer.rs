//! A frame put together pixel by pixel.

use super::{Compose, Layers};
use crate::backdrop::ContrastCache;
use crate::corners::Corners;
use crate::line_color::LinePoint;
use npr_core::color::{SrgbEncoder, pack_rgba8, srgb_from_linear, unpack_rgba8};
use npr_core::geometry::{NONE, Part};
use npr_core::list::{self, Listed};
use npr_core::raster::{HULL_BIT, ID_MASK};
use rayon::prelude::*;
use std::ops::Range;

/// Fills the pixels that show one known colour and nothing over it, and lists the others: their number, then the
/// pixels, row by row.
///
/// Where [`Compose::OVERLAY`] asks for them, `frame` holds stamps or the mask before, as sRGB bytes with coverage in
/// alpha, and keeps them at the listed pixels. O(pixels), parallel over rows.
pub fn fill(layers: &Layers<'_>, frame: &mut [u32], into: &mut [u32]) {
    // Fill row by row.
    let width = layers.window.size[0] as usize;
    let rows = frame.par_chunks_mut(width.max(1)).enumerate();
    let evens = layers.parts.iter().any(|part| part.tone_reach_px > 0.0);
    let left = rows.map(|(y, row)| layers.fill_row(y, row, evens));
    let left: Vec<Vec<u32>> = left.collect();

    // List what is left.
    list::fill(into, &left);
}

/// Composes the listed pixels as sRGB bytes with straight alpha, over what [`fill`] left there.
///
/// Every pixel has one or four samples that say which triangles it shows; each triangle is shaded once, at the middle
/// of its samples. Layers go over each other as in [Porter & Duff 1984], in linear light. O(listed pixels), parallel
/// over rows.
pub fn compose(layers: &Layers<'_>, list: &[u32], frame: &mut [u32]) {
    let listed = Listed::of(list);
    let encoder = SrgbEncoder::new();
    let width = layers.window.size[0] as usize;
    let new = || Composer {
        layers,
        encoder: &encoder,
        near: None,
        contrast_cache: ContrastCache::default(),
    };
    let rows = frame.par_chunks_mut(width.max(1)).enumerate();
    rows.for_each_init(new, |composer, (y, row)| {
        for (x, _) in listed.row(y, width) {
            row[x] = composer.texel(x as u32, y as u32, row[x]);
        }
    });
}

/// Pixels of a row that are checked together for anything but background.
const RUN: usize = 32;

/// Composes the pixels of some rows.
struct Composer<'a> {
    layers: &'a Layers<'a>,
    encoder: &'a SrgbEncoder,
    /// The last shaded triangle and its corners: mostly that of the next pixel too.
    near: Option<(u32, Corners<'a>)>,
    contrast_cache: ContrastCache,
}

impl<'a> Composer<'a> {
    /// A pixel of the output as sRGB bytes with straight alpha; `overlay` is what it held before.
    fn texel(&mut self, x: u32, y: u32, overlay: u32) -> u32 {
        // Take smoke that covers all as it is.
        let frame_px = self.layers.window.frame_at(x, y);
        let seen = self.layers.samples_of(x, y);
        let lines = self.layers.lines_at(x, y, overlay);
        let beams = self.layers.beams_of(x, y);
        let has_beams = beams.iter().any(|id| *id != 0);
        if lines == [0; 2]
            && !has_beams
            && let Some(texel) = self.layers.smoke_alone(x, y, &seen)
        {
            return texel;
        }

        // Find the smoke.
        let smoke_layer = self.layers.smoke_layer_of(x, y, &seen, frame_px);
        let is_one = seen.iter().all(|id| *id == seen[0]);

        // Shade the surfaces, smoke over them, the background behind.
        let hidden = smoke_layer.map_or([0.0; 4], |smoke_layer| smoke_layer.hidden);
        let mut color = if is_one && seen[0] != 0 && smoke_layer.is_none() {
            let [r, g, b] = self.surface(seen[0], (1 << seen.len()) - 1, frame_px);
            [r, g, b, 1.0]
        } else {
            self.even_surfaces(&seen, &hidden)
                .unwrap_or_else(|| self.surfaces(&seen, &hidden, frame_px))
        };
        if let Some(smoke_layer) = &smoke_layer {
            smoke_layer.add_to(&mut color, seen.len());
        }
        if color[3] < 1.0 {
            let behind = self.layers.background(frame_px);
            let left = 1.0 - color[3];
            color = std::array::from_fn(|i| color[i] + behind[i] * left);
        }

        // Lay beams over them.
        let covered = if has_beams {
            let smoke_layer = smoke_layer.as_ref();
            self.layers
                .add_beams(&seen, &beams, smoke_layer, frame_px, &mut color)
        } else {
            0.0
        };

        // Lay lines over everything, as far as neither beams nor smoke cover them.
        let faded = match &smoke_layer {
            Some(smoke_layer) if lines != [0; 2] => {
                smoke_layer.line_fade(self.layers, [x, y], frame_px)
            }
            _ => 0.0,
        };
        let in_srgb = self.layers.compose.flags & Compose::LINES_IN_SRGB != 0;
        let mut shown = None;
        for line in lines {
            if line >> 24 != 0 {
                let [r, g, b, a] = self.layers.linear_texel(line);
                let [r, g, b] =
                    self.layers
                        .contrasted(&mut self.contrast_cache, [r, g, b], frame_px);
                let a = a * (1.0 - covered) * (1.0 - faded);
                if in_srgb {
                    let below = shown.unwrap_or_else(|| unpack_rgba8(encoded(self.encoder, color)));
                    let [r, g, b] = [r, g, b].map(srgb_from_linear);
                    shown = Some(over_straight([r, g, b, a], below));
                } else {
                    color = over([r, g, b, a], color);
                }
            }
        }
        shown.map_or_else(|| encoded(self.encoder, color), pack_rgba8)
    }

    /// Colour of a triangle that has one colour all over.
    fn even_color(&self, id: u32) -> Option<[f32; 4]> {
        if id & HULL_BIT != 0 {
            return None;
        }
        let [r, g, b] = self
            .layers
            .whole_color(&self.layers.known[(id - 1) as usize])?;
        Some([r, g, b, 1.0])
    }

    /// The surfaces of a pixel, premultiplied, if each has one colour all over.
    fn even_surfaces(&self, seen: &[u32], hidden: &[f32; 4]) -> Option<[f32; 4]> {
        let mut sum = [0.0; 4];
        for (id, hidden) in seen.iter().zip(hidden).filter(|(id, _)| **id != 0) {
            let share = (1.0 - hidden) / seen.len() as f32;
            let color = self.even_color(*id)?;
            sum = std::array::from_fn(|i| sum[i] + color[i] * share);
        }
        Some(sum)
    }

    /// The surfaces of a pixel, premultiplied.
    fn surfaces(&mut self, seen: &[u32], hidden: &[f32; 4], frame_px: [f32; 2]) -> [f32; 4] {
        // Take the samples triangle by triangle.
        let count = seen.len();
        let mut sum = [0.0; 4];
        let mut left = (1u32 << count) - 1;
        for i in 0..count {
            if left & (1 << i) == 0 {
                continue;
            }
            let members = (i..count)
                .filter(|j| seen[*j] == seen[i])
                .fold(0, |bits, j| bits | 1 << j);
            left &= !members;
            if seen[i] == 0 {
                continue;
            }

            // Leave out what smoke hides.
            let shown = (i..count)
                .filter(|j| members & (1 << j) != 0)
                .map(|j| 1.0 - hidden[j])
                .sum::<f32>();
            if shown == 0.0 {
                continue;
            }

            // Shade the triangle once for all of its samples.
            let share = shown / count as f32;
            let [r, g, b] = self.surface(seen[i], members, frame_px);
            sum = [
                sum[0] + r * share,
                sum[1] + g * share,
                sum[2] + b * share,
                sum[3] + share,
            ];
        }
        sum
    }

    /// Light of what the samples in `members` show, a triangle or its hull.
    fn surface(&mut self, id: u32, members: u32, frame_px: [f32; 2]) -> [f32; 3] {
        // Draw a hull in the colour of its line.
        let index = ((id & ID_MASK) - 1) as usize;
        if id & HULL_BIT != 0 {
            let triangle = &self.layers.triangles[index];
            let part = &self.layers.parts[triangle.part as usize];
            let corners = self.layers.corners_of(triangle);
            let place = LinePoint {
                px: frame_px,
                step_px: [1.0; 2],
                is_hull: true,
            };
            let line = match part.flags & Part::TOON_LINE {
                0 => self.layers.line_light(triangle, part, &corners, &place),
                _ => self.layers.toon_outline(triangle, part, &corners, &place),
            };
            return self
                .layers
                .contrasted(&mut self.contrast_cache, line, frame_px);
        }

        // Shade a triangle, unless its colour is known.
        let known = &self.layers.known[index];
        if let Some(color) = self.layers.whole_color(known) {
            return color;
        }
        let corners = self.corners(id);
        let contrast_cache = &mut self.contrast_cache;
        self.layers
            .shade(id, members, frame_px, known, &corners, contrast_cache)
    }

    /// The corners of a triangle.
    fn corners(&mut self, id: u32) -> Corners<'a> {
        match self.near {
            Some((near, corners)) if near == id => corners,
            _ => {
                let corners = self
                    .layers
                    .corners_of(&self.layers.triangles[(id - 1) as usize]);
                self.near = Some((id, corners));
                corners
            }
        }
    }
}

/// Premultiplied linear light as sRGB bytes with straight alpha.
#[inline]
pub fn encoded(encoder: &SrgbEncoder, [r, g, b, a]: [f32; 4]) -> u32 {
    let scale = a.max(1e-6);
    let [r, g, b] = if scale == 1.0 {
        [r, g, b]
    } else {
        [r, g, b].map(|light| light / scale)
    };
    let [r, g, b] = [r, g, b].map(|light| encoder.byte(light));
    r | g << 8 | b << 16 | ((a.clamp(0.0, 1.0) * 255.0 + 0.5) as u32) << 24
}

/// A layer laid over another, both with straight alpha.
fn over_straight(top: [f32; 4], below: [f32; 4]) -> [f32; 4] {
    let left = below[3] * (1.0 - top[3]);
    let alpha = top[3] + left;
    let mixed = |i: usize| (top[i] * top[3] + below[i] * left) / alpha.max(1e-6);
    [mixed(0), mixed(1), mixed(2), alpha]
}

/// A straight-alpha layer laid over a premultiplied one.
fn over(top: [f32; 4], below: [f32; 4]) -> [f32; 4] {
    let a = top[3];
    if a == 0.0 {
        return below;
    }
    [
        top[0] * a + below[0] * (1.0 - a),
        top[1] * a + below[1] * (1.0 - a),
        top[2] * a + below[2] * (1.0 - a),
        a + below[3] * (1.0 - a),
    ]
}

impl Layers<'_> {
    /// Fills what it can of row `y`; gives the other pixels. `evens` tells whether tones of any part are evened.
    fn fill_row(&self, y: usize, row: &mut [u32], evens: bool) -> Vec<u32> {
        // Fill runs of plain background at once.
        let width = self.window.size[0] as usize;
        let is_plain = self.compose.background_texture == NONE;
        let empty = is_plain.then_some(self.compose.background_texel);
        let is_whole = self.compose.flags & Compose::BARE == 0;
        let mut left = Vec::new();
        for start in (0..row.len()).step_by(RUN) {
            let run = start..row.len().min(start + RUN);
            let texels = &mut row[run.clone()];
            if let Some(empty) = empty
                && is_whole
                && self.is_bare(run, y, texels)
            {
                texels.fill(empty);
                continue;
            }

            // Fill other pixels one by one.
            for (x, texel) in (start as u32..).zip(texels) {
                if self.is_left_out(x, y as u32) {
                    *texel = 0;
                    continue;
                }
                match self.known_texel(x, y as u32, *texel, evens) {
                    Some(known) => *texel = known,
                    None => left.push((y * width) as u32 + x),
                }
            }
        }
        left
    }

    /// What a pixel shows, if all of its samples show the same known colour and nothing lies over them.
    fn known_texel(&self, x: u32, y: u32, overlay: u32, evens: bool) -> Option<u32> {
        let lines = self.lines_at(x, y, overlay);
        if lines.iter().any(|line| line >> 24 != 0)
            || self.has_smoke(x, y)
            || self.beams_of(x, y).iter().any(|id| *id != 0)
        {
            return None;
        }
        let seen = self.samples_of(x, y);
        let first = self.texel_of(seen[0])?;
        let mut others = seen[1..].iter();
        let is_one = others.all(|id| *id == seen[0] || self.texel_of(*id) == Some(first));
        (is_one && (!evens || self.is_settled(x, y, &seen))).then_some(first)
    }

    /// The colour of triangle `id`, or of the background for 0, if it is known and the same all over.
    fn texel_of(&self, id: u32) -> Option<u32> {
        match id {
            0 => (self.compose.background_texture == NONE).then_some(self.compose.background_texel),
            _ if id & HULL_BIT != 0 => None,
            _ => self.known[(id - 1) as usize].texel(),
        }
    }

    /// Whether smoke covers any sample of a pixel.
    fn has_smoke(&self, x: u32, y: u32) -> bool {
        let element = (y * self.window.size[0] + x) as usize;
        self.compose.flags & Compose::SMOKE != 0
            && self.smoke_depths[element] & crate::smoke::resolve::MASK != 0
    }

    /// Whether some pixels of a row, which hold `overlay`, show nothing but the background.
    fn is_bare(&self, run: Range<usize>, y: usize, overlay: &[u32]) -> bool {
        // Check whole runs of texels for 0, without a branch for each.
        let (width, samples) = (self.window.size[0] as usize, self.compose.samples as usize);
        let holds = |bit: u32| self.compose.flags & bit != 0;
        let pixels = y * width + run.start..y * width + run.end;
        let is_zero = |texels: &[u32], mask: u32| {
            texels.iter().fold(0, |all, texel| all | (texel & mask)) == 0
        };
        let is_free = |ids: &[u32]| {
            (y * samples..(y + 1) * samples).all(|row| {
                let start = row * width * samples;
                let texels = start + run.start * samples..start + run.end * samples;
                is_zero(&ids[texels], u32::MAX)
            })
        };
        let is_off = |bit: u32, texels: &[u32], mask: u32| {
            !holds(bit) || is_zero(&texels[pixels.clone()], mask)
        };

        // Check the layers that the frame has.
        is_free(self.ids)
            && (!holds(Compose::BEAMS) || is_free(self.beam_ids))
            && is_off(Compose::RIBBONS, self.ribbons, u32::MAX)
            && (!holds(Compose::OVERLAY) || is_zero(overlay, u32::MAX))
            && is_off(
                Compose::SMOKE,
                self.smoke_depths,
                crate::smoke::resolve::MASK,
            )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_layer_over_another_never_lightens_coverage(
            top in prop::array::uniform4(0f32..1.0), below in prop::array::uniform4(0f32..1.0),
        ) {
            let premultiplied = [below[0] * below[3], below[1] * below[3], below[2] * below[3], below[3]];
            let both = over(top, premultiplied);
            prop_assert!(both[3] >= top[3].max(below[3]) - 1e-6 && both[3] <= 1.0 + 1e-6);
            prop_assert!(both[..3].iter().all(|c| *c >= 0.0 && *c <= both[3] + 1e-6));
        }
    }
}
