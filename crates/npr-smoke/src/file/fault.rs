//! Why a file gives no smoke.

use crate::{MAX_SIDE, VolumeError};
use npr_core::budget::OverBudget;
use npr_vdb::Fault;

/// Most voxels of a volume.
pub const MAX_VOXELS: usize = 1 << 30;

/// Why a file gives no smoke. Messages leave out the file's own name, which the caller puts before them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VolumeFault {
    /// The first bytes are those of no format that is read.
    #[error("this is neither an OpenVDB file nor an .npy array")]
    Unknown,
    /// Reading failed.
    #[error(transparent)]
    Read(#[from] Fault),
    /// No grid has a name that tells it, and none is the only one that could be.
    #[error("no grid is called density; name one of {names}")]
    NoDensity {
        /// Those that hold numbers, quoted, the first few.
        names: String,
    },
    /// No grid can be a density at all.
    #[error("no grid holds densities: {found}")]
    NothingDrawn {
        /// What there is instead.
        found: String,
    },
    /// A grid of distances was to be densities.
    #[error("grid '{grid}' is a level set: it holds distances to a surface, no densities")]
    LevelSet {
        /// Its name.
        grid: String,
    },
    /// An array of vectors was to be densities.
    #[error("the array holds vectors, not densities")]
    Vectors,
    /// Neither one nor three grids of velocities were named.
    #[error("{count} grids are named for velocities, not one or three")]
    Components {
        /// How many.
        count: usize,
    },
    /// There are too many voxels.
    #[error(
        "a box of {}x{}x{} voxels exceeds the limit of {} voxels and {} a side",
        size[0], size[1], size[2], MAX_VOXELS, MAX_SIDE
    )]
    TooLarge {
        /// Voxels along each axis of the file.
        size: [usize; 3],
    },
    /// There is too little memory for them.
    #[error(transparent)]
    Memory(#[from] OverBudget),
    /// They make no volume.
    #[error(transparent)]
    Volume(#[from] VolumeError),
}

impl VolumeFault {
    /// Whether a limit stands against it, rather than the file.
    pub fn is_limit(&self) -> bool {
        matches!(
            self,
            Self::TooLarge { .. }
                | Self::Memory(_)
                | Self::Volume(VolumeError::TooLarge { .. })
                | Self::Read(Fault::Memory { .. } | Fault::OutOfMemory { .. })
        )
    }

    /// Whether a memory limit stands against it, which may be raised.
    pub fn is_memory(&self) -> bool {
        self.is_limit() && !matches!(self, Self::TooLarge { .. } | Self::Volume(_))
    }
}
