//! Smoke over the surfaces of a pixel, and its shadow on them: the twin of `lib/smoke_layer`.

use npr_core::geometry::FAR_DEPTH;

use super::depth_map::DepthTexels;
use crate::compose::{Compose, Layers, Samples};

/// Radii in pixels around a line at which its surface is looked for.
const LINE_RINGS_PX: [f32; 3] = [1.0, 2.5, 5.0];

/// Smoke over a pixel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SmokeLayer {
    /// Linear light, straight alpha.
    color: [f32; 4],
    depth: f32,
    /// Which samples it covers.
    mask: u32,
    /// Share of the surface or background that it hides in each sample.
    pub(crate) hidden: [f32; 4],
}

impl SmokeLayer {
    /// Lays the smoke over surfaces from which the hidden shares are already left out; premultiplied.
    pub(crate) fn add_to(&self, color: &mut [f32; 4], samples: usize) {
        let shown = self.hidden[..samples].iter().sum::<f32>() / samples as f32;
        let [r, g, b, _] = self.color;
        *color = [
            color[0] + r * shown,
            color[1] + g * shown,
            color[2] + b * shown,
            color[3] + shown,
        ];
    }

    /// Share of triangle `id` that the smoke hides in sample `i`.
    pub(crate) fn over(&self, layers: &Layers<'_>, id: u32, i: u32, frame_px: [f32; 2]) -> f32 {
        if self.mask & (1 << i) == 0 {
            return 0.0;
        }
        let offset = layers.sample_offset(i);
        let at = [frame_px[0] + offset[0], frame_px[1] + offset[1]];
        if id != 0 && layers.depth_of(id, at) < self.depth {
            return 0.0;
        }
        self.color[3]
    }

    /// Share of a pixel's lines that the smoke hides.
    ///
    /// 0 if a surface nearby lies before the smoke: the line belongs to the foremost surface, and half of it lies
    /// beside that.
    pub(crate) fn line_fade(
        &self,
        layers: &Layers<'_>,
        pixel: [u32; 2],
        frame_px: [f32; 2],
    ) -> f32 {
        let whole = (layers.compose.samples * layers.compose.samples) as f32;
        let shown = self.color[3] * self.mask.count_ones() as f32 / whole;
        if self.is_before(layers, pixel, frame_px, [0.0; 2]) {
            return 0.0;
        }
        for ring in LINE_RINGS_PX {
            for [x, y] in DIRECTIONS {
                if self.is_before(layers, pixel, frame_px, [x * ring, y * ring]) {
                    return 0.0;
                }
            }
        }
        shown
    }

    /// Whether a surface some pixels away lies before the smoke.
    fn is_before(
        &self,
        layers: &Layers<'_>,
        pixel: [u32; 2],
        frame_px: [f32; 2],
        step: [f32; 2],
    ) -> bool {
        // Find the surface at the pixel that lies there.
        let (window, samples) = (layers.window, layers.compose.samples);
        let at: [u32; 2] = std::array::from_fn(|i| {
            let px = (pixel[i] as f32 + step[i] + 0.5).floor();
            px.clamp(0.0, window.size[i] as f32 - 1.0) as u32
        });
        let stride = window.size[0] * samples;
        let id = layers.ids[(at[1] * samples * stride + at[0] * samples) as usize];

        // Compare its depth with that of the smoke.
        let moved: [f32; 2] = std::array::from_fn(|i| {
            frame_px[i] + (at[i] as f32 - pixel[i] as f32) * window.frame_step[i]
        });
        let offset = layers.sample_offset(0);
        let there = [moved[0] + offset[0], moved[1] + offset[1]];
        id != 0 && layers.depth_of(id, there) < self.depth
    }
}

/// The eight directions in which a line's surface is looked for.
const DIRECTIONS: [[f32; 2]; 8] = [
    [1.0, 0.0],
    [0.7, 0.7],
    [0.0, 1.0],
    [-0.7, 0.7],
    [-1.0, 0.0],
    [-0.7, -0.7],
    [0.0, -1.0],
    [0.7, -0.7],
];

impl Layers<'_> {
    /// The smoke's own texel, if it covers all of a pixel without surfaces: the full composition would give the same.
    pub(crate) fn smoke_alone(&self, x: u32, y: u32, seen: &Samples) -> Option<u32> {
        // Tones that the pen has still to finish are no colours yet.
        let alone = Compose::SMOKE | Compose::SMOKE_PEN;
        if self.compose.flags & alone != Compose::SMOKE || seen.iter().any(|id| *id != 0) {
            return None;
        }
        let texel = (y * self.window.size[0] + x) as usize;
        let whole = (1 << seen.len()) - 1;
        let mask = self.smoke_depths[texel] & crate::smoke::resolve::MASK;
        let color = self.smoke_colors[texel];
        (mask & whole == whole && color >> 24 == 255).then_some(color)
    }

    /// The smoke over a pixel whose samples show the triangles `seen`; `None` without smoke.
    pub(crate) fn smoke_layer_of(
        &self,
        x: u32,
        y: u32,
        seen: &Samples,
        frame_px: [f32; 2],
    ) -> Option<SmokeLayer> {
        // Leave out pixels without smoke.
        if self.compose.flags & Compose::SMOKE == 0 {
            return None;
        }
        let texel = (y * self.window.size[0] + x) as usize;
        let bits = self.smoke_depths[texel];
        let mask = bits & crate::smoke::resolve::MASK;
        if mask == 0 {
            return None;
        }

        // Take its colour, finished by the pen where there is one.
        let depth = f32::from_bits(bits & !crate::smoke::resolve::MASK);
        let mut color = self.linear_texel(self.smoke_colors[texel]);
        if self.compose.flags & Compose::SMOKE_PEN != 0 {
            color = self.penned([x, y], frame_px, color);
        }

        // Find how much of the surfaces it hides, sample by sample.
        let mut smoke_layer = SmokeLayer {
            color,
            depth: depth.min(FAR_DEPTH),
            mask,
            hidden: [0.0; 4],
        };
        for (i, id) in seen.iter().enumerate() {
            smoke_layer.hidden[i] = smoke_layer.over(self, *id, i as u32, frame_px);
        }
        Some(smoke_layer)
    }

    /// Whether smoke lies between a place and the light of a shadow image.
    pub(crate) fn is_behind_smoke(&self, map: usize, world: [f32; 3]) -> bool {
        let side = self.compose.smoke_shadow_side;
        if side == 0 {
            return false;
        }
        DepthTexels::around(&self.lights.shadows[map], side, world)
            .is_some_and(|texels| texels.are_nearer(self.smoke_shadows[map], side))
    }
}
