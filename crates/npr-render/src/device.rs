//! Drawings on the devices of other programs.

mod embedded;
mod hosted;

pub use embedded::{EmbeddedRenderer, HostView};
