//! Lines on images: the twin of `line.detect`.

use npr_core::geometry::{FAR_DEPTH, GPixel, NONE, Part};
use npr_core::math;
use npr_core::outline::{MASK_OWNER, MASK_SIDE, Outline};
use npr_core::surface::dot;
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// The bits of a mask pixel that say which buffers found it.
pub const MASK_KINDS: u32 = 15;

/// What lines are detected on.
#[derive(Debug, Clone, Copy)]
pub struct Detection<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of the mask.
    pub window: &'a Window,
    /// Thresholds.
    pub outline: &'a Outline,
    /// Parts: those without lines are not separated from each other.
    pub parts: &'a [Part],
}

/// Marks every pixel that differs from one of its four neighbours [Okuya et al. 2016, section 3.2].
///
/// Each G-buffer has its own threshold and the mask is their union. Low bits say which buffers found a pixel,
/// [`MASK_OWNER`] whether its surface is the one in front, the bits from [`MASK_SIDE`] on which sides the line runs.
///
/// Differs: the paper compares depths directly, which lights up planes seen at a grazing angle; with
/// [`Outline::PLANE_DEPTH`] a depth is compared with the neighbour's tangent plane.
///
/// O(pixels), parallel over rows.
pub fn detect(with: &Detection<'_>, gbuffer: &[GPixel], mask: &mut [u32]) {
    let width = with.window.size[0] as usize;
    mask.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            *out = with.pixel(gbuffer, [x as i32, y as i32]);
        }
    });
}

impl Detection<'_> {
    fn pixel(&self, gbuffer: &[GPixel], pixel: [i32; 2]) -> u32 {
        let size = self.window.size.map(|n| n as i32);
        let here = &gbuffer[(pixel[1] * size[0] + pixel[0]) as usize];
        let mut found = 0;
        for side in 0..4u32 {
            let along = (side & 1) as i32 * 2 - 1;
            let step = if side < 2 { [along, 0] } else { [0, along] };
            let next = [pixel[0] + step[0], pixel[1] + step[1]];
            if next[0] < 0 || next[1] < 0 || next[0] >= size[0] || next[1] >= size[1] {
                continue;
            }
            let there = &gbuffer[(next[1] * size[0] + next[0]) as usize];
            let kinds = self.separations(here, there, step.map(|v| v as f32));
            if kinds == 0 || !(self.has_lines(here) || self.has_lines(there)) {
                continue;
            }
            found |= kinds;
            // Of two equally near surfaces, the right or lower pixel owns the line.
            if here.depth < there.depth || (here.depth == there.depth && along < 0) {
                found |= MASK_OWNER | (MASK_SIDE << side);
            }
        }
        found
    }

    /// Which buffers separate two neighbours.
    fn separations(&self, here: &GPixel, there: &GPixel, step: [f32; 2]) -> u32 {
        let outline = self.outline;
        if here.part == NONE && there.part == NONE {
            return 0;
        }
        let mut found = 0;
        if here.object != there.object {
            found |= Outline::OBJECT_ID;
        }
        if here.material != there.material {
            found |= Outline::MATERIAL_ID;
        }
        if here.part == NONE || there.part == NONE {
            return (found | Outline::DEPTH | Outline::NORMAL) & outline.detects;
        }
        if self.depth_jump(here, there, step) > outline.depth_threshold {
            found |= Outline::DEPTH;
        }
        let turn = here.normal != there.normal
            && dot(math::unpack_unit(here.normal), math::unpack_unit(there.normal)) < outline.normal_cos;
        if turn {
            found |= Outline::NORMAL;
        }
        found & outline.detects & MASK_KINDS
    }

    /// Depth jump between two neighbours as a share of the frame's height.
    fn depth_jump(&self, here: &GPixel, there: &GPixel, step: [f32; 2]) -> f32 {
        let mut gap = (here.depth - there.depth).abs();
        if self.outline.detects & Outline::PLANE_DEPTH != 0 {
            let back = step.map(|v| -v);
            gap = gap.min(self.plane_gap(here, there, step)).min(self.plane_gap(there, here, back));
        }
        gap / self.view.height_at(here.depth.min(there.depth))
    }

    /// How far `there` lies from the tangent plane of `here`, one pixel along `step`, in depth.
    fn plane_gap(&self, here: &GPixel, there: &GPixel, step: [f32; 2]) -> f32 {
        let change = here.plane_step[0] * step[0] + here.plane_step[1] * step[1];
        let coordinate = self.view.plane_coordinate(here.depth) + change;
        (self.depth_of_coordinate(coordinate) - there.depth).abs()
    }

    fn depth_of_coordinate(&self, coordinate: f32) -> f32 {
        if self.view.perspective < 0.5 {
            coordinate
        } else if coordinate > 1e-30 {
            1.0 / coordinate
        } else {
            FAR_DEPTH
        }
    }

    fn has_lines(&self, pixel: &GPixel) -> bool {
        pixel.part != NONE && self.parts[pixel.part as usize].flags & Part::LINES != 0
    }
}
