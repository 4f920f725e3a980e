//! Cartoon smoke [Hoshino 2004]: spheres become a few flat tones under an outline.
//!
//! The twins of the passes `smoke.*`, in the order in which a frame runs them: [`draw`], [`shade`], [`blur`] and
//! [`resolve`]; then [`crate::compose`] lays the result over the scene.

pub mod blur;
mod depth_map;
pub mod draw;
mod line;
mod look;
pub mod pen;
pub mod resolve;
pub mod shade;
mod smoke_layer;

pub use look::{CELLS_MAX, LAYERS_MAX, SmokeLook, TAPS_MAX};
pub(crate) use smoke_layer::SmokeLayer;
