//! The condition under which tests of every crate skip for lack of a device.

/// Whether a missing graphics device fails a test: `NPR_REQUIRE_GPU=1` is set.
pub fn is_device_required() -> bool {
    std::env::var("NPR_REQUIRE_GPU").is_ok_and(|value| value == "1")
}
