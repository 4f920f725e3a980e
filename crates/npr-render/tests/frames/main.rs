//! Frames through the facade.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod backdrop;
mod bands;
mod costs;
#[cfg(feature = "wgpu")]
mod embedded;
mod interrupts;
mod memory;
mod sequences;
mod smoke;
mod tiles;
