//! Smoke from files: which grids of an OpenVDB file it is made of, or an `.npy` array, and the volume they give.
//!
//! ```no_run
//! use npr_smoke::file::{VolumeFile, VolumeOptions};
//!
//! let file = VolumeFile::read(&std::fs::read("smoke.vdb")?, &VolumeOptions::default())?;
//! let volume = file.volume(&file.extent())?;
//! println!("{:?} voxels, the densest {}", volume.size(), volume.peak());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod choice;
mod extent;
mod fault;
mod options;
mod placement;
mod velocity;

pub use choice::Choice;
pub use extent::Extent;
pub use fault::{MAX_VOXELS, VolumeFault};
pub use options::{UpAxis, VolumeOptions};

use crate::{Volume, VolumeError};
use choice::shown;
use npr_core::budget::Budget;
use npr_vdb::{Bounds, Grid, Limits, npy};
use placement::{affine, array_placement, lookup};
use velocity::Velocity;

/// Whether bytes begin as those of a volume do.
pub fn is_volume(bytes: &[u8]) -> bool {
    is_vdb(bytes) || is_npy(bytes)
}

fn is_vdb(bytes: &[u8]) -> bool {
    bytes.starts_with(b" BDV")
}

fn is_npy(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x93NUMPY")
}

/// An opened file with the grids that smoke is made of.
#[derive(Debug, Clone)]
pub struct VolumeFile {
    density: Density,
    velocity: Velocity,
    heat: Option<Grid<f32>>,
    up: UpAxis,
    memory_limit: u64,
    notices: Vec<String>,
}

/// The densities that a file holds.
#[derive(Debug, Clone)]
enum Density {
    /// A grid of OpenVDB.
    Sparse(Box<Grid<f32>>),
    /// Voxels along each axis, and their values.
    Dense([usize; 3], Vec<f32>),
}

impl VolumeFile {
    /// Finds and reads the grids of a file that smoke is made of: of OpenVDB or of an `.npy` array, by the content.
    ///
    /// O(voxels that are stored), and as much memory; refused before it is taken where it exceeds the limit.
    ///
    /// # Errors
    ///
    /// [`VolumeFault`] for files that are no volumes, grids that are not there or cannot be read, and limits.
    pub fn read(bytes: &[u8], options: &VolumeOptions) -> Result<Self, VolumeFault> {
        let limits = Limits {
            memory_bytes: options.memory_limit,
        };
        if is_npy(bytes) {
            return Self::read_npy(bytes, &limits, options);
        }
        // Whatever is no array is told from an OpenVDB file by its reader.
        if !is_vdb(bytes) {
            return Err(VolumeFault::Unknown);
        }
        let file = npr_vdb::read(bytes, &limits)?;
        let choice = Choice::of(file.grids(), options)?;
        let velocity = Velocity::read(&file, &choice)?;
        let heat = choice.heat.map(|heat| file.scalar_at(heat)).transpose()?;
        let notice = choice.guess.then(|| {
            let name = shown(&file.grids()[choice.density].name);
            format!("grid '{name}' is taken for the densities")
        });
        Ok(Self {
            density: Density::Sparse(Box::new(file.scalar_at(choice.density)?)),
            velocity,
            heat,
            up: options.up,
            memory_limit: options.memory_limit,
            notices: notice.into_iter().collect(),
        })
    }

    fn read_npy(
        bytes: &[u8],
        limits: &Limits,
        options: &VolumeOptions,
    ) -> Result<Self, VolumeFault> {
        let array = npy::read(bytes, limits)?;
        let npy::Values::Scalars(values) = array.values else {
            return Err(VolumeFault::Vectors);
        };
        Ok(Self {
            density: Density::Dense(array.size, values),
            velocity: Velocity::Unknown,
            heat: None,
            up: options.up,
            memory_limit: options.memory_limit,
            notices: Vec::new(),
        })
    }

    /// What was guessed, for the user.
    pub fn notices(&self) -> &[String] {
        &self.notices
    }

    /// The box of voxels that are active in the grid of densities.
    pub fn extent(&self) -> Extent {
        match &self.density {
            Density::Sparse(grid) => {
                let bounds = grid.active_bounds();
                Extent {
                    low: bounds.map_or([0; 3], |bounds| bounds.low),
                    size: bounds.map_or([0; 3], |bounds: Bounds| bounds.size()),
                    world_from_index: self.up.turn() * affine(grid.index_to_world()),
                }
            }
            Density::Dense(size, _) => Extent {
                low: [0; 3],
                size: *size,
                world_from_index: array_placement(*size, self.up),
            },
        }
    }

    /// The smoke in a box of voxels, such as the [`extent`](Self::extent), dense.
    ///
    /// What a file holds beyond the box is left out; what it does not hold is empty. Velocities of other grids than the
    /// density's are looked up by place. O(voxels of the box).
    ///
    /// # Errors
    ///
    /// [`VolumeFault`] where the box exceeds a limit.
    pub fn volume(&self, extent: &Extent) -> Result<Volume, VolumeFault> {
        let count = extent.checked_count()?;
        let mut budget = Budget::new(self.memory_limit);
        budget.take("the volume", count, self.bytes_per_voxel())?;
        let (size, place) = extent.turned();
        let mut volume = Volume::new(size, self.densities(extent)?, place)?;
        if let Some(velocity) = self.velocity.within(extent, self.up)? {
            volume = volume.with_velocity(velocity)?;
        }
        if let Some(heat) = &self.heat {
            volume = volume.with_temperature(lookup(heat, extent, self.up)?)?;
        }
        Ok(volume)
    }

    /// Bytes that a voxel of a dense volume takes while it is made and while spheres are fitted to it.
    fn bytes_per_voxel(&self) -> usize {
        let heat = if self.heat.is_some() { 4 } else { 0 };
        8 + self.velocity.bytes_per_voxel() + heat
    }

    fn densities(&self, extent: &Extent) -> Result<Vec<f32>, VolumeFault> {
        match &self.density {
            Density::Sparse(grid) => Ok(grid.dense(extent.low, extent.size)?),
            Density::Dense(size, values) if *size == extent.size => Ok(values.clone()),
            Density::Dense(..) => Err(VolumeError::DifferentGrids {
                first: extent.size.map(|side| side as u32),
                second: self.extent().size.map(|side| side as u32),
            }
            .into()),
        }
    }
}

#[cfg(test)]
mod tests;
