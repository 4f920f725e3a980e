//! What is seen of lines, by samples in a picture of surfaces, and the ink of it.
//!
//! Visibility is a property of a line's spine, not of the pixels that its stroke covers [Cole & Finkelstein 2010].
//! Every step is the twin of a pass, so a device draws lines from their spines to their ink without the host:
//!
//! 1. [`see_samples`]: whether a triangle beside the sample's pixel hides it, and how far in front it lies;
//! 2. [`weigh_samples`], [`filter_visibility`]: the verdicts of neighbours, so that noise makes no dashes;
//! 3. [`part_samples`]: where parts of lines begin, visible and hidden ones in turns;
//! 4. [`ink_samples`]: points of ink, thinner at free ends.
//!
//! [`visible_samples`] is steps 1 and 2 in one, [`inked`] steps 3 and 4.

mod filter;
mod ink;
mod see;

pub use filter::{filter_visibility, visible_samples, weigh_samples};
pub use ink::{Parts, ink_samples, inked, part_samples};
pub use see::{Scenery, see_samples};

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// A point of a line's spine, and what its stroke is like there.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SpineSample {
    /// Place of the spine in the frame, in pixels: what is seen is decided here.
    pub spine_px: [f32; 2],
    /// Distance of the spine from the eye along the view axis.
    pub depth: f32,
    /// Number of its line.
    pub line: u32,
    /// Place in the frame where the stroke is drawn, in pixels: smoothed, and swaying as a hand does.
    pub px: [f32; 2],
    /// Half the width of the stroke, in pixels; 0 of samples that are there to fill a buffer.
    pub half_width: f32,
    /// sRGB bytes and alpha, red lowest.
    pub color: u32,
}
gpu_layout!(SpineSample {
    spine_px,
    depth,
    line,
    px,
    half_width,
    color
});

/// A line of samples.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct SampledLine {
    /// Its first sample; an even number.
    pub first: u32,
    /// Number of its samples; even, and at least 2.
    pub count: u32,
    /// Distance of its samples along the stroke, in pixels.
    pub step_px: f32,
    /// [`InkPoint::flags`](crate::ink_point::InkPoint::flags) that all its points have.
    pub ink_flags: u32,
    /// Place along the image of the brush at its first sample.
    pub u_start: f32,
    /// How far that moves per pixel along it.
    pub u_per_px: f32,
    /// Half width at which the brush is pressed down fully.
    pub full_half_width: f32,
    /// [`SampledLine::START_FREE`] and the other bits.
    pub bits: u32,
}
gpu_layout!(SampledLine {
    first,
    count,
    step_px,
    ink_flags,
    u_start,
    u_per_px,
    full_half_width,
    bits
});

impl SampledLine {
    /// No other line meets its start.
    pub const START_FREE: u32 = 1;
    /// No other line meets its end.
    pub const END_FREE: u32 = 2;
    /// Its last sample lies where its first does.
    pub const CLOSED: u32 = 4;
    /// The image of its brush lies once over every visible part.
    pub const ONCE: u32 = 8;
    /// The bits from this one on are the number of its [`PartWidth`].
    pub const WIDTH_SHIFT: u32 = 8;

    /// The width of its parts, among those of all lines.
    pub fn width<'a>(&self, widths: &'a [PartWidth]) -> &'a PartWidth {
        &widths[(self.bits >> Self::WIDTH_SHIFT) as usize]
    }
}

/// How visible parts of lines are found and drawn.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct PartWidth {
    /// Factor on the width along a part, at even steps from its start to its end.
    pub along: [[f32; 4]; 8],
    /// Pixels over which a part swells from its start and thins out towards its end.
    pub taper_px: [f32; 2],
    /// Greatest share of its part that each of the two takes, 0..0.5.
    pub taper_share: f32,
    /// Share of the width that is left at the tip, 0..1.
    pub tip: f32,
    /// Pixels under which a part that meets no other line is thinner as a whole; at half of them it is gone.
    pub short_px: f32,
    /// Pixels under which a part is a speck, and not drawn.
    pub speck_px: f32,
    /// 1 where ends that meet another line thin out too.
    pub at_all_ends: u32,
    /// Number of samples on either side over which verdicts are averaged.
    pub radius: u32,
}
gpu_layout!(PartWidth {
    along,
    taper_px,
    taper_share,
    tip,
    short_px,
    speck_px,
    at_all_ends,
    radius
});

/// The widths of parts of lines that are drawn in several manners.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct PartWidths {
    /// One for each manner; behind those of all, anything.
    pub all: [PartWidth; PartWidths::MOST],
}
gpu_layout!(PartWidths { all });

impl PartWidths {
    /// Most manners.
    pub const MOST: usize = 64;

    /// Those of so many manners, at most [`PartWidths::MOST`]; of more the first count.
    pub fn of(widths: &[PartWidth]) -> Self {
        let of = |number: usize| widths.get(number).copied().unwrap_or_default();
        Self {
            all: std::array::from_fn(of),
        }
    }
}
