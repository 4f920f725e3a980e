//! Outlines detected on images and drawn on shapes, line by line of Okuya et al. 2016.
//!
//! Every test stands for lines of `docs/coverage.toml`; drawings are compared with lines that are known from the
//! shapes.

mod colors;
mod detection;
mod fixture;
mod hidden;
mod joins;
mod limits;
mod mask_scale;
mod pipeline;
mod quad;
mod rivals;
mod teapot;
mod width;
