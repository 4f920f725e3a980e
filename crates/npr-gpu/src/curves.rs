//! Lines as linked points, found, ranked and tested for visibility on an engine.
//!
//! The steps are those of [`npr_vector::mesh_lines::contour::steps`] and [`npr_vector::rank`], each a pass. On a
//! processor the plain functions there are faster than these passes and give the same; passes are for graphs that stay
//! on a device from the mesh to the picture.
//!
//! ```
//! use npr_gpu::curves::{Scheme, rank_on};
//! use npr_gpu::processor::Processor;
//!
//! let (next, keys) = ([2, 0, 1, 3], [5, 6, 7, 8]);
//! let ranked = rank_on(&Processor, &next, &keys, Scheme::RULING_SET)?;
//! assert_eq!(ranked, npr_vector::rank::walk(&next, &keys)?);
//! # Ok::<(), npr_gpu::curves::CurvesError>(())
//! ```

pub mod contours;
pub mod pixels;
pub mod ranking;
mod resident;
mod resident_pixels;
pub mod sampling;
pub mod sums;
pub mod work;

pub use ranking::{Scheme, rank_on};
pub use resident::ResidentShape;
pub use resident_pixels::{Hiders, ResidentPixels, trace_on};

use crate::engine::EngineError;
use npr_vector::rank::RankError;

/// Why lines were not ranked.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CurvesError {
    /// The links are no lists, or the rounds were too few.
    #[error(transparent)]
    Rank(#[from] RankError),
    /// The engine failed.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

impl CurvesError {
    /// The error of the lists, unless the engine failed.
    ///
    /// # Errors
    ///
    /// [`EngineError`] where the engine failed.
    pub fn split(self) -> Result<RankError, EngineError> {
        match self {
            Self::Rank(error) => Ok(error),
            Self::Engine(error) => Err(error),
        }
    }
}
