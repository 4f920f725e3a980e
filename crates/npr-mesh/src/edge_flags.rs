//! What is special about an edge.

use std::ops::{BitOr, BitOrAssign};

/// A set of properties of an [`Edge`](crate::Edge).
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub struct EdgeFlags(pub u32);

impl EdgeFlags {
    /// Nothing special: two faces of one material, wound alike.
    pub const NONE: Self = Self(0);
    /// Only one face meets the edge.
    pub const BOUNDARY: Self = Self(1);
    /// Three or more faces meet the edge, which is then listed once per neighbouring pair.
    pub const NON_MANIFOLD: Self = Self(2);
    /// The two faces have different materials.
    pub const MATERIAL: Self = Self(4);
    /// The two faces are wound in opposite senses: seen from one side, one shows its front and one its back.
    pub const FLIPPED: Self = Self(8);
    /// The first face runs along the edge from `ends[1]` to `ends[0]`.
    pub const BACKWARD: Self = Self(16);
    /// Each face lies in front of the other, as in a valley; never set together with
    /// [`FLIPPED`](Self::FLIPPED) or [`NON_MANIFOLD`](Self::NON_MANIFOLD).
    pub const CONCAVE: Self = Self(32);

    /// Whether all of `flags` are set.
    pub fn contains(self, flags: Self) -> bool {
        self.0 & flags.0 == flags.0
    }

    /// Whether any of `flags` is set.
    pub fn intersects(self, flags: Self) -> bool {
        self.0 & flags.0 != 0
    }

    /// These flags where `condition` holds, else none.
    pub(crate) fn when(self, condition: bool) -> Self {
        if condition { self } else { Self::NONE }
    }
}

impl BitOr for EdgeFlags {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for EdgeFlags {
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}
