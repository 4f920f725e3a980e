//! Line drawings through the facade.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod background_contrast;
mod cache;
mod cards;
mod colors;
mod creases;
mod hold;
mod image;
mod meaning;
mod polylines;
mod robustness;
mod scenes;
mod smoke;
