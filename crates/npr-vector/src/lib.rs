//! Lines found on images and drawn on shapes [Okuya et al. 2016].
//!
//! Four ways to lines, each a row of functions that are usable alone; those of a frame are twins of shaders:
//!
//! - **The published outline of a frame** [Okuya et al. 2016]: [`gbuffer`] finds the surface under every pixel,
//!   [`detect`] marks the pixels that differ from a neighbour, [`ribbon`] draws mesh edges with width where the mask
//!   shows them, and [`residual`] inks what the mask shows and no edge explains.
//! - **Exact lines of a mesh**: [`contour`], [`zero_set`], [`feature`], [`intersect`] and [`wire`] find linked curves
//!   ([`graph`]), [`project`] puts them into the picture, [`visibility`] with [`bvh`] finds what hides them, and
//!   [`run`], [`corner`], [`adopt`], [`doubles`], [`merge`], [`smooth`] and [`spurs`] make strokes of what is seen.
//!   [`draw`] does it all; [`puff`] adds smoke.
//! - **Strokes of pixels** [Jiang et al. 2022]: [`pixel_contour`], ranked by [`rank`].
//! - **Lines of pictures**: [`image_line`] follows borders between surfaces and lines painted in textures; bitmaps
//!   alone are the crate [`npr_trace`], here [`trace`].
//!
//! All end in a [`stroke::Drawing`].
//!
//! ```
//! // A line one pixel wide whose spine runs through a pixel's centre covers it whole.
//! assert_eq!(npr_vector::ribbon::line_coverage(0.0, 0.5), 1.0);
//! ```

pub mod adopt;
pub mod bvh;
pub mod contour;
pub mod corner;
mod covered;
pub mod detect;
pub mod doubles;
pub mod draw;
pub mod feature;
pub mod gbuffer;
pub mod graph;
pub mod image_line;
pub mod intersect;
pub mod merge;
mod near;
pub mod pixel_contour;
pub mod project;
pub mod puff;
pub mod rank;
pub mod residual;
pub mod ribbon;
pub mod run;
pub mod sample;
pub mod seat;
pub mod smooth;
pub mod spurs;
pub mod stroke;
pub mod visibility;
pub mod wire;
pub mod zero_set;

/// Bitmaps to curves: the crate `npr-trace`, which lines painted in textures are followed with.
pub use npr_trace as trace;
