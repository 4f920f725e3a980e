//! Line drawings through the facade.

mod cache;
mod colors;
mod creases;
mod image;
mod meaning;
mod minding;
mod robustness;
mod scenes;
mod wires;
