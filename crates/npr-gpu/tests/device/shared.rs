//! The device that all tests share.

use npr_gpu::device::{AdapterChoice, Device};
use std::sync::OnceLock;

/// Whether a missing device is a failure.
fn is_required() -> bool {
    std::env::var("NPR_REQUIRE_GPU").is_ok_and(|value| value == "1")
}

/// A device of its own for a test that breaks it; `None` where there is none and none is required.
pub fn open() -> Option<Device> {
    match Device::open(AdapterChoice::Any) {
        Ok(device) => Some(device),
        Err(error) if is_required() => panic!("NPR_REQUIRE_GPU is set, but {error}"),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    }
}

/// The shared device.
pub fn device() -> Option<&'static Device> {
    static DEVICE: OnceLock<Option<Device>> = OnceLock::new();
    DEVICE.get_or_init(open).as_ref()
}
