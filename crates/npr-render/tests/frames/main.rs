//! Frames through the facade.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod backdrop;
mod bands;
#[cfg(feature = "wgpu")]
mod embedded;
mod smoke;
