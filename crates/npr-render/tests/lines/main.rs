//! Line drawings through the facade.

mod background_contrast;
mod cache;
mod colors;
mod creases;
mod image;
mod meaning;
mod polylines;
mod robustness;
mod scenes;
