//! Devices for tests of every crate: no other code in a test opens one, so that all tests skip alike.

mod canvas;

pub use canvas::Canvas;

use super::adapter::open_raw;
use super::{AdapterChoice, Device};
use crate::engine::EngineError;
use crate::testing::is_device_required;
use std::sync::OnceLock;

/// The device that all tests of a program share; `None` if there is none, which is said once on standard error.
///
/// # Panics
///
/// Where there is none and `NPR_REQUIRE_GPU=1` is set.
pub fn device() -> Option<&'static Device> {
    static DEVICE: OnceLock<Option<Device>> = OnceLock::new();
    DEVICE.get_or_init(open).as_ref()
}

/// A device of its own for a test that breaks it; `None` if there is none, which is said on standard error.
///
/// # Panics
///
/// As [`device`].
pub fn open() -> Option<Device> {
    opened(Device::open(AdapterChoice::Any))
}

/// A device as a host program opens one, with these limits and no features; `None` if there is none, which is said on
/// standard error.
///
/// # Panics
///
/// As [`device`].
pub fn open_host(limits: &wgpu::Limits) -> Option<(wgpu::Adapter, wgpu::Device, wgpu::Queue)> {
    let host = wgpu::DeviceDescriptor {
        label: Some("host"),
        required_limits: limits.clone(),
        ..wgpu::DeviceDescriptor::default()
    };
    opened(open_raw(AdapterChoice::Any, &|_| host.clone()))
}

/// What was opened, unless there is none and none is required.
fn opened<T>(result: Result<T, EngineError>) -> Option<T> {
    match result {
        Ok(device) => Some(device),
        Err(error) if is_device_required() => panic!("NPR_REQUIRE_GPU is set, but {error}"),
        Err(error) => {
            eprintln!("skipped: {error}");
            None
        }
    }
}
