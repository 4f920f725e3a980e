//! What is the same all over a triangle, so that its pixels need not find it.

/// What is known of a triangle.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct TriangleConstants {
    /// Linear light: the colour of the surface, or the light on it, or where both are known their product, under its
    /// ink if that is [`TriangleConstants::WHOLE`].
    pub color: [f32; 3],
    /// Bits of [`TriangleConstants::PLAIN`] to [`TriangleConstants::WHOLE`].
    bits: u32,
}

impl TriangleConstants {
    /// The surface has one colour: neither texture nor vertex colours, or they are left out.
    pub const PLAIN: u32 = 1;
    /// Light is the same all over.
    pub const EVEN: u32 = 2;
    /// No highlight reaches it.
    pub const MATT: u32 = 4;
    /// There is no ink on it.
    pub const BARE: u32 = 8;
    /// It lies in solid ink.
    pub const SOLID: u32 = 16;
    /// There is nothing left to find.
    pub const WHOLE: u32 = 32;

    /// The one colour of a triangle that has it all over.
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

    /// Sets a bit where something is so.
    pub fn learn(&mut self, bit: u32, is_so: bool) {
        self.bits |= if is_so { bit } else { 0 };
    }

    fn has(&self, bit: u32) -> bool {
        self.bits & bit != 0
    }
}
