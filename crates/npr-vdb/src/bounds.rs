//! Boxes of voxels.

/// A box of voxels, both corners inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Bounds {
    /// The lowest index along each axis.
    pub low: [i32; 3],
    /// The highest.
    pub high: [i32; 3],
}

impl Bounds {
    /// Voxels along each side; none where `high` lies below `low`.
    pub fn size(&self) -> [usize; 3] {
        std::array::from_fn(|axis| {
            let side = i64::from(self.high[axis]) - i64::from(self.low[axis]) + 1;
            usize::try_from(side.max(0)).unwrap_or(usize::MAX)
        })
    }

    /// The smallest box that holds both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|axis| self.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])),
        }
    }
}
