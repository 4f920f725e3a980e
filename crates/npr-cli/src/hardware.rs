//! Graphics devices.

use crate::doctor::AdapterReport;
use crate::engine::Choice;
use npr_gpu::device::{self, AdapterChoice, AdapterKind, AdapterSummary, Device};
use npr_gpu::engine::{Engine, EngineError};

/// The best device that `choice` admits.
pub fn open(choice: Choice) -> Result<Box<dyn Engine>, EngineError> {
    let choice = match choice {
        Choice::Hardware => AdapterChoice::Hardware,
        Choice::Any => AdapterChoice::Any,
    };
    Ok(Box::new(Device::open(choice)?))
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
