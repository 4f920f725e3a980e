//! Volumes from files: OpenVDB grids and `.npy` arrays, in pure Rust.
//!
//! [`read`] lists the grids of an OpenVDB file; [`File::scalar`] and [`File::vector`] read one of them into a sparse
//! [`Grid`]. What cannot be read is a [`Fault`] that says what and where.
//!
//! ```
//! use npr_vdb::{Limits, read};
//!
//! # let file = npr_vdb::testing::Sample::puff().bytes();
//! // let file = std::fs::read("smoke.vdb")?;
//! let volume = read(&file, &Limits::default())?;
//! for grid in volume.grids() {
//!     println!("{}: {}", grid.name, grid.values);
//! }
//! let density = volume.scalar("density")?;
//! if let Some(bounds) = density.active_bounds() {
//!     // Every voxel in the bounds, tiles expanded; z runs fastest, as in an array [x][y][z].
//!     let voxels: Vec<f32> = density.dense(bounds.low, bounds.size())?;
//!     let centre_world = density.index_to_world().point(bounds.low.map(f64::from));
//!     assert_eq!(voxels[0], density.value(bounds.low));
//!     assert!(centre_world.iter().all(|part| part.is_finite()));
//! }
//! # Ok::<(), npr_vdb::Fault>(())
//! ```
//!
//! # What is read
//!
//! - File format versions 220 to 224, files and streams; version 224 is what OpenVDB has written since version 3.
//! - Grids of `float`, `double`, `int32`, `int64` and `bool` values as `f32`, of `vec3s`, `vec3d` and `vec3i` values as
//!   `[f32; 3]`, stored in full or as half floats, in trees of the usual layout 5_4_3.
//! - Chunks stored plainly, by zip or by blosc (LZ4, BloscLZ, zlib, zstd; bytes or bits shuffled), with or without
//!   masks of active values.
//! - Every linear transform. A frustum is a fault that names it.
//!
//! Grids of points, strings, masks and other types are listed, and are a fault only when asked for.
//!
//! # Hostile files
//!
//! Files are hostile until proven sound: memory is planned against [`Limits`] before it is allocated, nothing recurses,
//! every offset is checked. A file never makes its lists longer than 256 times its own size, whatever it states.
//! Values themselves are handed on as they are: NaN and infinities too.

// Every byte comes from a stranger.
#![cfg_attr(
    not(test),
    deny(
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::indexing_slicing,
        clippy::arithmetic_side_effects
    )
)]

mod blosc;
#[allow(
    clippy::arithmetic_side_effects,
    clippy::indexing_slicing,
    reason = "holds what was read and checked"
)]
mod bounds;
mod chunk;
mod cursor;
#[allow(
    clippy::arithmetic_side_effects,
    clippy::indexing_slicing,
    reason = "holds what was read and checked"
)]
mod fault;
mod file;
#[allow(
    clippy::arithmetic_side_effects,
    clippy::indexing_slicing,
    reason = "holds what was read and checked"
)]
mod grid;
mod half;
mod info;
mod limits;
mod mask;
mod metadata;
pub mod npy;
mod packed;
mod shown;
#[cfg(any(test, feature = "testing"))]
#[allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects,
    reason = "writes what tests ask for"
)]
pub mod testing;
mod transform;
mod tree;
mod voxel;
mod zlib;

pub use bounds::Bounds;
pub use fault::Fault;
pub use file::{File, read};
pub use grid::{Grid, Leaf, Tile};
pub use info::{GridClass, GridInfo, Values};
pub use limits::Limits;
pub use metadata::{MetaValue, Metadata};
pub use transform::Transform;
pub use voxel::{ValueType, Voxel};
