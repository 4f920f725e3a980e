//! The published outline of a frame [Okuya et al. 2016].
//!
//! [`gbuffer`] finds the surface under every pixel, [`detect`] marks the pixels that differ from a neighbour,
//! [`ribbon`] draws mesh edges with width where the mask shows them, and [`residual`] inks what the mask shows and no
//! edge explains. [`sweep`] says what a line with width covers.

pub mod detect;
pub mod gbuffer;
pub mod residual;
pub mod ribbon;
pub mod sweep;
