//! Line drawings through the facade.

mod cache;
mod meaning;
mod robustness;
mod scenes;
