//! What tests of every crate ask before they go without a device.

/// Whether a missing graphics device fails a test: `NPR_REQUIRE_GPU=1` is set.
pub fn is_device_required() -> bool {
    std::env::var("NPR_REQUIRE_GPU").is_ok_and(|value| value == "1")
}
