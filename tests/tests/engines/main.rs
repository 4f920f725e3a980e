//! Pictures and drawings of both engines, in one program so that all tests share the device and its compiled passes.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod backgrounds;
mod cards;
mod hulls_and_words;
mod id_maps;
mod kernels;
mod layers;
mod limbs;
mod lines;
mod models;
mod pixel_strokes;
mod polylines;
mod poses;
mod skies;
mod smoke;
mod stages;
mod toons;
