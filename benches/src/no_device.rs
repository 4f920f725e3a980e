//! Graphics devices to measure on, in a build without any.

use npr_gpu::engine::Engine;

/// None; says so on standard error.
pub fn open_hardware() -> Option<Box<dyn Engine>> {
    open()
}

/// None; says so on standard error.
pub fn open_timing_passes() -> Option<Box<dyn Engine>> {
    open()
}

/// None; says so on standard error.
pub fn open() -> Option<Box<dyn Engine>> {
    eprintln!("device left out: built without the feature wgpu");
    None
}
