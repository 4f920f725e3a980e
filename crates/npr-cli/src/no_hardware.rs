//! The functions of `hardware`, in a build without graphics devices.

use crate::adapter_report::AdapterReport;
use crate::device_choice::DeviceChoice;
use npr_gpu::engine::{Engine, EngineError};

/// Always fails.
pub fn open(_: DeviceChoice, _: bool) -> Result<Box<dyn Engine + Send>, EngineError> {
    Err(EngineError::NoDevice {
        reason: "this build draws on the processor only".to_owned(),
    })
}

/// Always empty.
pub fn adapters() -> Vec<AdapterReport> {
    Vec::new()
}
