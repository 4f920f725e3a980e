//! Velocities of a file: one grid of vectors, or three grids of their components.

use super::placement::lookup;
use super::{Choice, Extent, UpAxis, VolumeFault};
use glam::Vec3;
use npr_vdb::{File, Grid, GridClass};

/// The velocities that a file holds.
#[derive(Debug, Clone)]
pub(super) enum Velocity {
    /// It holds none.
    Unknown,
    /// One vector per voxel, in its middle or on its faces.
    Vectors(Box<Grid<[f32; 3]>>),
    /// Components along x, y and z.
    Components(Box<[Grid<f32>; 3]>),
}

impl Velocity {
    /// Reads the grids that are chosen for velocities.
    pub(super) fn read(file: &File<'_>, choice: &Choice) -> Result<Self, VolumeFault> {
        Ok(match choice.velocity[..] {
            [vectors] => Self::Vectors(Box::new(file.vector_at(vectors)?)),
            [x, y, z] => Self::Components(Box::new([
                file.scalar_at(x)?,
                file.scalar_at(y)?,
                file.scalar_at(z)?,
            ])),
            _ => Self::Unknown,
        })
    }

    /// Bytes that the velocity of a voxel takes while a dense volume is made of it.
    pub(super) fn bytes_per_voxel(&self) -> usize {
        match self {
            Self::Unknown => 0,
            Self::Vectors(_) => 24,
            Self::Components(_) => 28,
        }
    }

    /// Velocities at the voxels of a box along the world's axes, z fastest; none where the file holds none.
    pub(super) fn within(
        &self,
        extent: &Extent,
        up: UpAxis,
    ) -> Result<Option<Vec<Vec3>>, VolumeFault> {
        // Look up the vectors in the middle of each voxel.
        let turn = up.turn().matrix3.as_mat3();
        let vectors: Vec<[f32; 3]> = match self {
            Self::Unknown => return Ok(None),
            Self::Vectors(grid) if grid.info().class == GridClass::Staggered => {
                centred(grid, extent, up)?
            }
            Self::Vectors(grid) => lookup(grid, extent, up)?,
            Self::Components(grids) => {
                let [x, y, z] = grids.each_ref().map(|grid| lookup(grid, extent, up));
                let (x, y, z) = (x?, y?, z?);
                let rows = x.into_iter().zip(y).zip(z);
                rows.map(|((x, y), z)| [x, y, z]).collect()
            }
        };

        // Turn them as the file is turned.
        Ok(Some(
            vectors.into_iter().map(|v| turn * Vec3::from(v)).collect(),
        ))
    }
}

/// Velocities in the middle of voxels from those on their faces.
fn centred(
    grid: &Grid<[f32; 3]>,
    extent: &Extent,
    up: UpAxis,
) -> Result<Vec<[f32; 3]>, VolumeFault> {
    let mut vectors = lookup(grid, extent, up)?;
    for axis in 0..3 {
        let mut next = *extent;
        next.low[axis] = next.low[axis].saturating_add(1);
        let ahead = lookup(grid, &next, up)?;
        for (vector, ahead) in vectors.iter_mut().zip(ahead) {
            vector[axis] = 0.5 * (vector[axis] + ahead[axis]);
        }
    }
    Ok(vectors)
}
