//! The report about a graphics adapter.

use crate::message::plain;
use serde::Serialize;

/// Name, kind and limits of a graphics adapter, as `npr doctor` reports them.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct AdapterReport {
    /// Name of the device.
    pub name: String,
    /// Discrete, integrated, virtual, unknown or software.
    pub kind: &'static str,
    /// The graphics API through which it is reached.
    pub backend: &'static str,
    /// Name and version of the driver.
    pub driver: String,
    /// Largest width and height of an image, in texels.
    pub max_image_side: u32,
    /// Largest buffer that a pass can bind, in bytes.
    pub max_binding_bytes: u64,
    /// Whether it has a clock that times passes.
    pub has_clock: bool,
}

impl AdapterReport {
    /// The adapter in one line.
    pub fn text(&self) -> String {
        let clock = if self.has_clock { "clock" } else { "no clock" };
        format!(
            "{}: {}, {}, {}, images to {} px, bindings to {} MiB, {clock}",
            plain(&self.name),
            self.kind,
            self.backend,
            plain(&self.driver),
            self.max_image_side,
            self.max_binding_bytes >> 20,
        )
    }
}
