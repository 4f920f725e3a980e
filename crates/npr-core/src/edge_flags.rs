//! What is special about a mesh edge.

use crate::line_kind::KindSet;
use bytemuck::{Pod, Zeroable};
use std::ops::{BitOr, BitOrAssign};

/// A set of properties of a mesh edge, or of a line along one.
///
/// One bit means one thing wherever edges and lines are stored: in lists of edges, in half-edge meshes, in nodes of
/// curves and in the buffers of passes. Properties that make an edge a line in every view have the bit of its kind in
/// a [`KindSet`]; all others lie from [`KindSet::END`] on.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct EdgeFlags(pub u32);

impl EdgeFlags {
    /// Nothing special: two faces of one material, wound alike.
    pub const NONE: Self = Self(0);
    /// Only one face meets the edge.
    pub const BOUNDARY: Self = Self(KindSet::BOUNDARY);
    /// The two faces have different materials.
    pub const MATERIAL: Self = Self(KindSet::MATERIAL);
    /// The file or the user asks for a line here.
    pub const MARKED: Self = Self(KindSet::MARKED);
    /// The two faces are wound in opposite senses: seen from one side, one shows its front and one its back.
    pub const FLIPPED: Self = Self(KindSet::END);
    /// Three or more faces meet the edge.
    pub const NON_MANIFOLD: Self = Self(KindSet::END << 1);
    /// The first face runs along the edge from its second end to its first.
    pub const BACKWARD: Self = Self(KindSet::END << 2);
    /// Each face lies in front of the other, as in a valley; never set together with
    /// [`FLIPPED`](Self::FLIPPED) or [`NON_MANIFOLD`](Self::NON_MANIFOLD).
    pub const CONCAVE: Self = Self(KindSet::END << 3);
    /// Its object has a boundary, so that backs of faces may be seen.
    pub const OPEN: Self = Self(KindSet::END << 4);
    /// It is drawn against the way in which it is stored.
    pub const REVERSED: Self = Self(KindSet::END << 5);
    /// It is a line of its own, without faces.
    pub const POLYLINE: Self = Self(KindSet::END << 6);
    /// A face beside it is turned to the eye: as published, each such edge is a line.
    pub const FACING: Self = Self(KindSet::END << 7);
    /// Its line turns from its surface's visible to its hidden side here.
    pub const CUSP: Self = Self(KindSet::END << 8);
    /// Its line only links faces that are wound against each other.
    pub const SEAM: Self = Self(KindSet::END << 9);

    /// Whether all of `flags` are set.
    pub const fn contains(self, flags: Self) -> bool {
        self.0 & flags.0 == flags.0
    }

    /// Whether any of `flags` is set.
    pub const fn intersects(self, flags: Self) -> bool {
        self.0 & flags.0 != 0
    }

    /// Whether any of them is set among bits that hold kinds of line too.
    pub const fn is_in(self, bits: u32) -> bool {
        self.0 & bits != 0
    }

    /// These flags where `condition` holds, else none.
    pub const fn when(self, condition: bool) -> Self {
        if condition { self } else { Self::NONE }
    }

    /// Those of its flags that are in `flags`.
    pub const fn among(self, flags: Self) -> Self {
        Self(self.0 & flags.0)
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
