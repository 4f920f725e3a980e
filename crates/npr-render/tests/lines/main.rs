//! Line drawings through the facade.

mod cache;
mod colors;
mod meaning;
mod robustness;
mod scenes;
