//! Boxes of voxels in files.

use super::{MAX_VOXELS, VolumeFault};
use crate::MAX_SIDE;
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// A box of voxels in a file, and where it lies: what the volumes of a series must share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// The lowest index along each axis of the file.
    pub low: [i32; 3],
    /// Voxels along each axis of the file.
    pub size: [usize; 3],
    /// World from the file's indices, up made y.
    pub world_from_index: DAffine3,
}

impl Extent {
    /// The smallest box that holds both; none unless both are of one grid. Nothing is added by an empty one.
    pub fn union(&self, other: &Self) -> Option<Self> {
        if self.is_empty() || other.is_empty() {
            return Some(if self.is_empty() { *other } else { *self });
        }
        if self.world_from_index != other.world_from_index {
            return None;
        }
        let end =
            |extent: &Self, axis: usize| i64::from(extent.low[axis]) + extent.size[axis] as i64;
        let low: [i32; 3] = std::array::from_fn(|axis| self.low[axis].min(other.low[axis]));
        let size = |axis: usize| end(self, axis).max(end(other, axis)) - i64::from(low[axis]);
        Some(Self {
            low,
            size: std::array::from_fn(|axis| size(axis).max(0) as usize),
            ..*self
        })
    }

    /// Lowest and highest corner of its voxels in the world, a unit box where those are not finite; none where there
    /// are no voxels.
    pub fn bounds(&self) -> Option<([f32; 3], [f32; 3])> {
        // Place the corners of the box, half a voxel beyond its outermost centres.
        let corner = |i: usize| {
            let index = |axis: usize| {
                let end = if i >> axis & 1 == 0 {
                    0.0
                } else {
                    self.size[axis] as f64
                };
                f64::from(self.low[axis]) + end - 0.5
            };
            let index = DVec3::from_array(std::array::from_fn(index));
            self.world_from_index.transform_point3(index).as_vec3()
        };

        // Take the box around them.
        let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = (0..8)
            .map(corner)
            .fold(none, |(low, high), at| (low.min(at), high.max(at)));
        if self.is_empty() {
            None
        } else if low.is_finite() && high.is_finite() {
            Some((low.to_array(), high.to_array()))
        } else {
            Some(([-0.5; 3], [0.5; 3]))
        }
    }

    /// Whether there is no voxel in it.
    pub fn is_empty(&self) -> bool {
        self.size.contains(&0)
    }

    /// Number of voxels, if it may be drawn.
    pub(super) fn checked_count(&self) -> Result<usize, VolumeFault> {
        let size = self.size;
        let count = size
            .iter()
            .try_fold(1usize, |count, side| count.checked_mul(*side));
        let fits = size.iter().all(|&side| side <= MAX_SIDE as usize);
        count
            .filter(|&count| fits && count <= MAX_VOXELS)
            .ok_or(VolumeFault::TooLarge { size })
    }

    /// Sizes and places as [`Volume`] has them: its x runs fastest, a file's z does, so axes change their names.
    pub(super) fn turned(&self) -> ([u32; 3], DAffine3) {
        let [x, y, z] = self.size.map(|side| side as u32);
        let low = DVec3::from_array(self.low.map(f64::from));
        let m = self.world_from_index.matrix3;
        let axes = DMat3::from_cols(m.z_axis, m.y_axis, m.x_axis);
        let origin = self.world_from_index.transform_point3(low);
        ([z, y, x], DAffine3::from_mat3_translation(axes, origin))
    }
}
