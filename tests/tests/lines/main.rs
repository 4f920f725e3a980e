//! Lines of whole frames and of drawings, held against what is known of the shapes.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod brushes_in_frames;
mod contour_growth;
mod curves_in_frames;
mod expression;
mod files_and_frames;
mod manners_of_parts;
mod outlines;
mod sampled_sights;
mod why;
