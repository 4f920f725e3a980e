//! Opens and lists graphics devices.

use crate::adapter_report::AdapterReport;
use crate::device_choice::DeviceChoice;
use npr_gpu::device::{self, AdapterChoice, AdapterKind, AdapterSummary, Device};
use npr_gpu::engine::{Engine, EngineError};

/// Opens the best device that `choice` admits. With `times_passes`, the device measures the times of passes reliably,
/// which may make frames slower.
pub fn open(
    choice: DeviceChoice,
    times_passes: bool,
) -> Result<Box<dyn Engine + Send>, EngineError> {
    let choice = match choice {
        DeviceChoice::Hardware => AdapterChoice::Hardware,
        DeviceChoice::Any => AdapterChoice::Any,
    };
    let device = Device::open(choice)?;
    Ok(Box::new(match times_passes {
        true => device.timing_passes(),
        false => device,
    }))
}

/// Every adapter of this machine, best first.
pub fn adapters() -> Vec<AdapterReport> {
    device::adapters().into_iter().map(report).collect()
}

fn report(adapter: AdapterSummary) -> AdapterReport {
    AdapterReport {
        kind: match adapter.kind {
            AdapterKind::Discrete => "discrete",
            AdapterKind::Integrated => "integrated",
            AdapterKind::Virtual => "virtual",
            AdapterKind::Unknown => "unknown",
            AdapterKind::Software => "software",
        },
        name: adapter.name,
        backend: adapter.backend,
        driver: adapter.driver,
        max_image_side: adapter.max_image_side,
        max_binding_bytes: adapter.max_binding_bytes,
        has_clock: adapter.has_clock,
    }
}
