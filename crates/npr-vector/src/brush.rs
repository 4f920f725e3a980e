//! Brushes: what of a stroke takes ink, by an image of the brush and the grain of the paper.
//!
//! The image of a brush lies along the stroke. Each texel has the height of the nap there and a share of ink. What the
//! brush is pressed on the paper with decides how deep the nap reaches: its high places touch first, on the hills of
//! the paper. Twin of `lib/brush.wgsl`.

use crate::ink_point::InkPoint;
use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;
use npr_core::grain::paper_height;
use npr_core::math;

/// Square pixels by which a place may be nearer to the next piece and still be drawn by this one.
const NEARER: f32 = 1e-3;

/// Half width, and length of a piece, in pixels, under which they count as this much.
const THINNEST_PX: f32 = 1e-3;

/// A brush, as passes read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Brush {
    /// Where the texels of its image start among the words, the finest level first, row by row.
    pub start: u32,
    /// Texels along the stroke on the finest level, a power of two.
    pub texels_along: u32,
    /// Texels across it, a power of two; 0 for a brush of one even ink.
    pub texels_across: u32,
    /// Levels, each half as large as the one before: at most as many as both sides can be halved.
    pub levels: u32,
    /// How deep the nap is, as a share of full pressure: 0 leaves an even ink, above 1 some of it never touches.
    pub dry: f32,
    /// How deep the grain of the paper is, as a share of full pressure.
    pub grain: f32,
    /// Pressure, as a share of the full one, over which ink grows from none to all; above 0.
    pub soft: f32,
    /// Hills of the paper per pixel.
    pub spots_per_px: f32,
}
gpu_layout!(Brush {
    start,
    texels_along,
    texels_across,
    levels,
    dry,
    grain,
    soft,
    spots_per_px
});

/// Brushes, and the words that hold their images.
#[derive(Debug, Clone, Copy)]
pub struct Brushes<'a> {
    /// The brushes, by the number that points have of theirs; the last one stands for numbers behind it.
    pub all: &'a [Brush],
    /// Texels: the height of the nap in the lowest byte, the share of ink in the next.
    pub texels: &'a [u32],
}

impl Brushes<'_> {
    /// One brush of an even ink.
    pub const SOLID: Self = Self {
        all: &[],
        texels: &[],
    };

    /// The brush with a number; `None` for one of an even ink.
    pub(crate) fn of(&self, number: u32) -> Option<&Brush> {
        let last = self.all.len().checked_sub(1)?;
        let brush = &self.all[last.min(number as usize)];
        (brush.texels_across > 0).then_some(brush)
    }

    /// Share of ink, 0 to 1, that its brush leaves at a place of a stroke of one piece, or of a stamp; 1 where the
    /// brush has an even ink. O(1).
    pub fn ink_alone(&self, ends: &[InkPoint; 2], px: [f32; 2]) -> f32 {
        let piece = BrushedPiece {
            ends: *ends,
            before: None,
            behind: None,
        };
        let brush = self.of(ends[0].flags >> InkPoint::BRUSH_SHIFT);
        brush.map_or(1.0, |brush| self.ink(brush, &piece, px))
    }

    /// Share of ink, 0 to 1, that a brush leaves in a pixel that a piece of a stroke covers; 0 where the piece before
    /// or behind lies nearer.
    pub(crate) fn ink(&self, brush: &Brush, piece: &BrushedPiece, px: [f32; 2]) -> f32 {
        let [a, b] = &piece.ends;
        let foot = Foot::new(a.px, b.px, px);

        // Leave the pixel to a neighbour that lies nearer.
        let is_nearer = |from: [f32; 2], to: [f32; 2]| {
            Foot::new(from, to, px).square_distance < foot.square_distance - NEARER
        };
        let (before, behind) = (piece.before, piece.behind);
        if before.is_some_and(|before| is_nearer(before, a.px))
            || behind.is_some_and(|behind| is_nearer(b.px, behind))
        {
            return 0.0;
        }

        // Find the place in the brush's image: beyond free ends it goes on straight. Stamps end at their sides.
        let is_stamp = a.flags & InkPoint::STAMP != 0;
        if is_stamp && foot.along != foot.along.clamp(0.0, 1.0) {
            return 0.0;
        }
        let t = foot.along.clamp(0.0, 1.0);
        let mut along = foot.along;
        if before.is_some() {
            along = along.max(0.0);
        }
        if behind.is_some() {
            along = along.min(1.0);
        }
        let is_beyond = t != foot.along;
        let goes_straight = is_beyond && along != t;
        let half_width = (a.half_width + (b.half_width - a.half_width) * t).max(THINNEST_PX);
        let side = if foot.beside < 0.0 { -1.0 } else { 1.0 };
        let around = side * foot.square_distance.sqrt();
        let beside = if is_beyond && !goes_straight {
            around
        } else {
            foot.beside
        };
        let across = |beside: f32| {
            let v = (beside / half_width).clamp(-1.0, 1.0) * 0.5 + 0.5;
            match a.flags & InkPoint::MIRRORED {
                0 => v,
                _ => 1.0 - v,
            }
        };
        let u = a.u + (b.u - a.u) * along;

        // Look it up as finely as pixels lie.
        let ab = [b.px[0] - a.px[0], b.px[1] - a.px[1]];
        let length = (ab[0] * ab[0] + ab[1] * ab[1]).sqrt().max(THINNEST_PX);
        let across_px = brush.texels_across as f32 / (2.0 * half_width);
        let along_px = brush.texels_along as f32 * (b.u - a.u).abs() / length;
        let texels_per_px = across_px.max(along_px);
        let [nap, mut ink] = self.texel(brush, [u, across(beside)], texels_per_px);

        // A round stamp falls off all around.
        if a.flags & InkPoint::ROUND != 0 {
            let off = [0, 1].map(|i| px[i] - (a.px[i] + b.px[i]) * 0.5);
            let far = (off[0] * off[0] + off[1] * off[1]).sqrt();
            if far >= half_width {
                return 0.0;
            }
            let [_, at_rim] = self.texel(brush, [u, across(far)], texels_per_px);
            ink = ink.min(at_rim);
        }

        // Lift the brush beyond a free end, which is round.
        let mut pressure = a.pressure + (b.pressure - a.pressure) * t;
        if goes_straight {
            let beyond = (along - t) * length / half_width;
            pressure *= (1.0 - beyond * beyond).max(0.0);
            let [_, at_rim] = self.texel(brush, [u, across(around)], texels_per_px);
            ink = ink.min(at_rim);
        }

        // Let the nap touch the paper.
        let reach = (pressure - brush.dry * (1.0 - nap)) / brush.soft + 0.5;
        let deepest = brush.grain / brush.soft;
        if reach <= 0.0 {
            return 0.0;
        }
        if reach - deepest >= 1.0 {
            return ink;
        }
        let valley = 1.0 - paper_height(px, brush.spots_per_px);
        ink * (reach - deepest * valley).clamp(0.0, 1.0)
    }

    /// Height of the nap and share of ink at a place of the image, where a pixel is `texels_per_px` wide.
    fn texel(&self, brush: &Brush, uv: [f32; 2], texels_per_px: f32) -> [f32; 2] {
        let last = brush.levels - 1;
        let level = math::log2(texels_per_px.max(1.0)).clamp(0.0, last as f32);
        let fine = (level as u32).min(last);
        let near = self.level(brush, fine, uv);
        let share = level - fine as f32;
        if share == 0.0 {
            return near;
        }
        let far = self.level(brush, (fine + 1).min(last), uv);
        std::array::from_fn(|i| near[i] + (far[i] - near[i]) * share)
    }

    /// The same in one of its levels, between texels.
    fn level(&self, brush: &Brush, level: u32, [u, v]: [f32; 2]) -> [f32; 2] {
        let (first, [width, height]) = brush.level(level);
        let x = (u - u.floor()) * width as f32 - 0.5;
        let y = (v * height as f32 - 0.5).clamp(0.0, (height - 1) as f32);
        let (column, row) = (x.floor(), y.floor());
        let left = (column + width as f32) as u32 % width;
        let right = (left + 1) % width;
        let upper = first + row as u32 * width;
        let lower = first + (row as u32 + 1).min(height - 1) * width;
        let texel = |at: u32| {
            let word = self.texels[at as usize];
            [word & 255, (word >> 8) & 255].map(|byte| byte as f32 / 255.0)
        };
        let mixed = |a: [f32; 2], b: [f32; 2], share: f32| -> [f32; 2] {
            std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
        };
        let top = mixed(texel(upper + left), texel(upper + right), x - column);
        let bottom = mixed(texel(lower + left), texel(lower + right), x - column);
        mixed(top, bottom, y - row)
    }
}

impl Brush {
    /// Where the texels of a level start, and its texels along and across.
    fn level(&self, level: u32) -> (u32, [u32; 2]) {
        let all = self.texels_along * self.texels_across;
        let first = self.start + (all - (all >> (2 * level))) / 3 * 4;
        let size = [self.texels_along, self.texels_across].map(|side| side >> level);
        (first, size)
    }
}

/// A piece of a stroke between two points, and the points before and behind, where the stroke goes on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BrushedPiece {
    pub ends: [InkPoint; 2],
    pub before: Option<[f32; 2]>,
    pub behind: Option<[f32; 2]>,
}

impl BrushedPiece {
    /// The piece from a point to the next.
    pub fn new(points: &[InkPoint], start: usize) -> Self {
        let before = start.checked_sub(1).map(|before| points[before]);
        let before = before.filter(|before| before.flags & InkPoint::JOINED != 0);
        let end = points[start + 1];
        let behind = points.get(start + 2);
        let behind = behind.filter(|_| end.flags & InkPoint::JOINED != 0);
        Self {
            ends: [points[start], end],
            before: before.map(|before| before.px),
            behind: behind.map(|behind| behind.px),
        }
    }
}

/// Where a place lies beside a piece.
struct Foot {
    /// Share of the way along it, beyond 0..1 before and behind it.
    along: f32,
    /// Distance from its line, to either side.
    beside: f32,
    /// Square distance from the piece itself.
    square_distance: f32,
}

impl Foot {
    fn new(a: [f32; 2], b: [f32; 2], p: [f32; 2]) -> Self {
        let ab = [b[0] - a[0], b[1] - a[1]];
        let ap = [p[0] - a[0], p[1] - a[1]];
        let square_length = (ab[0] * ab[0] + ab[1] * ab[1]).max(1e-12);
        let along = (ap[0] * ab[0] + ap[1] * ab[1]) / square_length;
        let t = along.clamp(0.0, 1.0);
        let off = [ap[0] - ab[0] * t, ap[1] - ab[1] * t];
        Self {
            along,
            beside: (ap[1] * ab[0] - ap[0] * ab[1]) / square_length.sqrt(),
            square_distance: off[0] * off[0] + off[1] * off[1],
        }
    }
}

#[cfg(test)]
mod tests;
