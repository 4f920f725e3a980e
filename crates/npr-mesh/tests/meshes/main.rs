//! Meshes prepared: generated, random, hostile and real ones.

mod shape;
mod suzanne;
mod threads;
