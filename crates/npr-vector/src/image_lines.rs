//! Lines that exist only in a picture, followed along their middle: the image-space path without doubled edges.
//!
//! The path of [`crate::pixel_strokes`] draws mesh edges into a picture and goes around the ink, so every line comes
//! back twice and one of the two is culled by its direction; a small turn of the camera changes which. Here a line is
//! the border between two pixels that show different surfaces ([`detect`](crate::screen::detect)), which exists once.
//! The steps: [`SurfacePicture::new`] draws which face every pixel shows, [`SurfacePicture::borders`] finds where
//! neighbours differ, [`Borders::runs`] links these borders; [`painted_lines`] inks dark and light lines of textures,
//! and [`LineInk::runs`] follow their [`centreline`](crate::trace::centreline). Both give runs with kind, surface,
//! depth and place in the world, like all lines of a view, and [`strokes_from`] makes strokes of them.
//!
//! Differs from lines of meshes: only visible lines are found; borders of meshes count as contours, since in a picture
//! both are where a surface ends.

mod border;
mod chain;
mod ink;
mod painted;
mod picture;
mod run;
mod sheet;
mod slender;
#[cfg(test)]
mod tests;

pub use border::{Border, Borders};
pub use ink::LineInk;
pub use painted::{GROUND, PaintedRule, PaintedTone, painted, painted_lines};
pub use picture::{ImageScene, SurfacePicture};
pub use run::{On, strokes_from};

/// Bytes that a pixel of a picture takes while its lines are found.
pub const BYTES_PER_PIXEL: usize = 96;
