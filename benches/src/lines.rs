//! How right drawings are: measures against a reference that shares no code with what is measured.
//!
//! [`mod@reference`] finds the lines that a view must show: [`soup`] welds triangles, [`candidates`] tells which
//! edges may bear a line, [`occluders`] casts a ray for every half pixel of them, [`chains`] joins what is seen.
//! [`analytic`] knows the outlines of two shapes without any mesh. [`measures`] compares a drawing with either;
//! drawings come from the renderer or, through [`stroke_file`], from any program. [`drawn`] counts the strokes that a
//! pen needs, [`picture`] shows all side by side.

pub mod analytic;
pub mod candidates;
pub mod chains;
pub mod digest;
pub mod doubles;
pub mod drawn;
pub mod ink;
pub mod layers;
pub mod measures;
mod net;
pub mod occluders;
pub mod pen;
pub mod picture;
pub mod reference;
pub mod report;
pub mod sampled;
pub mod scaling;
pub mod soup;
pub mod stroke_file;
pub mod subjects;
pub mod viewpoint;
