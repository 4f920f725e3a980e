//! Values that are the same all over a triangle, so that its pixels need not find them.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;

/// The constants of a triangle.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct TriangleConstants {
    /// Indices of its vertices.
    pub corners: [u32; 3],
    /// Its part.
    pub part: u32,
    /// Linear light: the colour of the surface, or the light on it, or their product if both are known; with the ink
    /// over it if [`TriangleConstants::WHOLE`] is set.
    pub color: [f32; 3],
    /// Bits of [`TriangleConstants::PLAIN`] to [`TriangleConstants::WHOLE`]; with the last, the colour as sRGB bytes
    /// above them.
    pub bits: u32,
}
gpu_layout!(TriangleConstants {
    corners,
    part,
    color,
    bits
});

impl TriangleConstants {
    /// Bit: the surface has one colour, with neither texture nor vertex colours, or they are left out.
    pub const PLAIN: u32 = 1;
    /// Bit: light is the same all over.
    pub const EVEN: u32 = 2;
    /// Bit: no highlight reaches it.
    pub const MATT: u32 = 4;
    /// Bit: there is no ink on it.
    pub const BARE: u32 = 8;
    /// Bit: it lies in solid ink.
    pub const SOLID: u32 = 16;
    /// Bit: nothing is left to find.
    pub const WHOLE: u32 = 32;

    /// Place of the bytes of red, green and blue.
    pub const BYTES: u32 = 8;

    /// Notes that nothing is left to find, with the colour as an opaque sRGB texel.
    pub fn complete(&mut self, texel: u32) {
        self.bits |= Self::WHOLE | texel << Self::BYTES;
    }

    /// The opaque sRGB texel of a triangle that has one colour all over.
    #[inline]
    pub fn texel(&self) -> Option<u32> {
        self.has(Self::WHOLE)
            .then_some(self.bits >> Self::BYTES | 0xff00_0000)
    }

    /// The colour of a triangle that has one colour all over.
    #[inline]
    pub fn whole(&self) -> Option<[f32; 3]> {
        self.has(Self::WHOLE).then_some(self.color)
    }

    /// Whether [`TriangleConstants::color`] holds the colour of the surface.
    #[inline]
    pub fn is_plain(&self) -> bool {
        self.has(Self::PLAIN)
    }

    /// Whether [`TriangleConstants::color`] holds the light on the surface.
    #[inline]
    pub fn is_even(&self) -> bool {
        self.has(Self::EVEN)
    }

    /// Whether no highlight shows.
    #[inline]
    pub fn is_matt(&self) -> bool {
        self.has(Self::MATT)
    }

    /// Ink, 0 or 1, where it is the same all over.
    #[inline]
    pub fn ink(&self) -> Option<f32> {
        if self.has(Self::BARE) {
            return Some(0.0);
        }
        self.has(Self::SOLID).then_some(1.0)
    }

    /// Sets a bit if `is_so`.
    pub fn learn(&mut self, bit: u32, is_so: bool) {
        self.bits |= if is_so { bit } else { 0 };
    }

    /// What is left where the light is another than was found.
    #[must_use]
    pub fn without_light(self) -> Self {
        Self {
            bits: self.bits & !(Self::PLAIN | Self::EVEN | Self::WHOLE),
            ..self
        }
    }

    fn has(&self, bit: u32) -> bool {
        self.bits & bit != 0
    }
}
