//! Which graphics devices may draw.

/// Which graphics devices may draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DeviceChoice {
    /// Hardware only: software devices are slower than the processor engine.
    Hardware,
    /// Any device; hardware is preferred.
    Any,
}
