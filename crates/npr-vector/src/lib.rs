//! Lines found on images and drawn on shapes [Okuya et al. 2016].
//!
//! A frame becomes lines in four steps, each usable alone: [`gbuffer`] finds the surface under every
//! pixel, [`detect`] marks the pixels that differ from a neighbour, [`ribbon`] draws mesh edges with width where the
//! mask shows them, and [`residual`] inks what the mask shows and no edge explains. Every function here is the twin of
//! a shader of the same name.
//!
//! ```
//! // A line one pixel wide whose spine runs through a pixel's centre covers it whole.
//! assert_eq!(npr_vector::ribbon::line_coverage(0.0, 0.5), 1.0);
//! ```

pub mod adopt;
pub mod artwork;
pub mod bvh;
pub mod centreline;
mod clip;
pub mod contour;
pub mod corner;
mod covered;
pub mod detect;
pub mod doubles;
pub mod draw;
pub mod drawing;
pub mod feature;
pub mod fill;
pub mod fit;
pub mod gbuffer;
pub mod graph;
mod hue;
pub mod image_line;
pub mod intersect;
pub mod json;
pub mod lettering;
pub mod merge;
mod near;
mod number;
pub mod outline;
mod page;
pub mod pdf;
pub mod pixel_contour;
pub mod plot;
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
pub mod svg;
pub mod trace;
pub mod visibility;
pub mod wire;
pub mod zero_set;
