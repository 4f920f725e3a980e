//! Meshes prepared: generated, random, hostile and real ones.

mod cards;
mod shape;
mod suzanne;
mod threads;
