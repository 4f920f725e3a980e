//! Lines that exist only in a picture, followed along their middle: the image-space path without doubled edges.
//!
//! The path of [`crate::pixel_contour`] draws mesh edges into a picture and goes around the ink, so every line comes back twice and one of
//! the two is culled by its direction; a small turn of the camera changes which. Here the line is where two pixels show different
//! surfaces ([`detect`](crate::detect)), its ink is the two pixels beside it, and [`centreline`](crate::centreline) goes
//! along it once. The steps: [`SurfacePicture::new`] draws which face every pixel shows, [`SurfacePicture::lines`] marks what differs,
//! [`painted`] marks dark lines of textures, and [`LineInk::runs`] gives what both have in common with all other lines of a view:
//! runs with kind, surface, depth and place in the world.
//!
//! Differs from meshes' lines: visible ones alone; borders count as contours, for in a picture both are where a surface ends.

mod ink;
mod painted;
mod picture;
mod run;
#[cfg(test)]
mod tests;

pub use ink::LineInk;
pub use painted::{PaintedRule, painted};
pub use picture::{ImageScene, SurfacePicture};

/// Bytes that a pixel of a picture takes while its lines are found.
pub const BYTES_PER_PIXEL: usize = 96;
