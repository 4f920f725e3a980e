//! Exact lines of a mesh as strokes; [`draw`] runs all of it.
//!
//! 1. Find curves on the mesh: [`contour`] between faces, [`zero_set`] across them, [`feature`], [`intersect`] and
//!    [`polyline`]; [`graph`] holds them, linked.
//! 2. Find what hides them: `visibility` with [`bvh`]; or leave that to [`sampled`](crate::sampled) pictures; [`puff`]
//!    adds smoke.
//! 3. Make strokes of what is seen: `run_assembly` cuts it into the parts of [`run`]; `relabel_intersections`,
//!    `duplicates`, `merge`, `overshoot`, `corner` and `smooth` tidy them.

pub(crate) mod anchor;
mod bridge;
pub mod bvh;
pub mod contour;
pub(crate) mod corner;
pub mod draw;
mod duplicates;
pub mod feature;
pub mod graph;
pub mod intersect;
mod joints;
mod line;
pub(crate) mod line_parts;
mod line_settings;

mod merge;
pub(crate) mod near;
mod overshoot;
pub mod polyline;
pub mod puff;
mod relabel_intersections;
pub mod rounded;
pub mod run;
mod run_assembly;
mod smooth;
mod suppressed_edges;
mod visibility;
pub mod zero_set;

pub use joints::{DrawnBetween, HeldJoints, JointsInView, Tip, WasBetween};
pub use merge::{DEPTH_SHARE, FACING_PX, STRAIGHT_COS, TOUCHING_PX};
