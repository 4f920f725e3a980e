//! Lines found on images and drawn on shapes [Okuya et al. 2016].
//!
//! A map of the crate, a folder for each way to lines:
//!
//! | folder | lines | source |
//! |---|---|---|
//! | [`screen`] | outlines of a frame: a mask of pixels, and mesh edges drawn where it shows | [Okuya et al. 2016] |
//! | [`mesh_lines`] | exact curves of a mesh: contours, creases, intersections, and what hides them | |
//! | [`pixel_strokes`] | strokes of the pixels that lines cover | [Jiang et al. 2022] |
//! | [`image_lines`] | borders between surfaces in a picture, and lines painted in textures | |
//! | [`sampled`] | what is seen of lines, by samples, and the ink of it | [Cole & Finkelstein 2010] |
//! | [`hold`] | what strokes take over from the frame before | [Kalnins et al. 2003] |
//! | [`rank`] | list ranking, which orders the nodes of lines in parallel | [Wyllie 1979] |
//! | [`stroke_ink`] | strokes in the pixels of a frame, drawn with a [`brush`] | |
//!
//! Functions of [`screen`], [`rank`], [`pixel_strokes`], [`sampled`] and [`stroke_ink`] are twins of shaders. All ways
//! but the first end in a [`stroke::Drawing`]; [`project`] and [`surface_location`] say where its points lie. Bitmaps
//! alone are the crate [`npr_trace`], here [`trace`].
//!
//! ```
//! // A line one pixel wide whose spine runs through a pixel's centre covers it whole.
//! assert_eq!(npr_vector::screen::sweep::line_coverage(0.0, 0.5), 1.0);
//! ```

pub mod brush;
pub mod hold;
pub mod image_lines;
pub mod ink_point;
pub mod mesh_lines;
pub mod pixel_strokes;
pub mod project;
pub mod rank;
pub mod sampled;
pub mod screen;
pub mod stroke;
pub mod stroke_ink;
pub mod surface_location;

/// Bitmaps to curves: the crate `npr-trace`, which lines painted in textures are followed with.
pub use npr_trace as trace;
