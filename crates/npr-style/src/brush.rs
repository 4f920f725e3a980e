//! Brushes: images of what draws a stroke, made by formulas or from a picture.
//!
//! An image lies along a stroke, as wide as it, and repeats. Every texel has the height of the nap, which decides how
//! soon it touches the paper, and a share of ink. Heights made by formulas are ranks: a share of the image lies under a
//! height of the same share, so numbers mean the same for every tip.
//!
//! ```
//! use npr_style::brush::Tip;
//!
//! assert!(Tip::Pen.image().is_none(), "a pen draws one even ink");
//! let chalk = Tip::Chalk.image().unwrap();
//! assert_eq!(chalk.length(), 16.0, "the image repeats every sixteen widths");
//! ```

mod image;
mod tips;

pub use image::{BrushError, BrushImage, PICTURE_SIDE_MAX};
pub use tips::{Manner, Tip};
