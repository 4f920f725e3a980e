//! The graphics device that the tests of a program share.

use npr_gpu::device::{AdapterChoice, Device};
use std::sync::OnceLock;

/// The shared device; `None`, said once on standard error, where there is none.
///
/// # Panics
///
/// Where there is none and `NPR_REQUIRE_GPU=1` is set.
pub fn device() -> Option<&'static Device> {
    static DEVICE: OnceLock<Option<Device>> = OnceLock::new();
    DEVICE.get_or_init(open).as_ref()
}

fn open() -> Option<Device> {
    let is_required = std::env::var("NPR_REQUIRE_GPU").is_ok_and(|value| value == "1");
    match Device::open(AdapterChoice::Any) {
        Ok(device) => Some(device),
        Err(error) if is_required => panic!("NPR_REQUIRE_GPU is set, but {error}"),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    }
}
