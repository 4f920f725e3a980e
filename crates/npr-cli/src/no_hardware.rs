//! Graphics devices, in a build without any.

use crate::doctor::AdapterReport;
use crate::engine::Choice;
use npr_gpu::engine::{Engine, EngineError};

/// Always fails.
pub fn open(_: Choice) -> Result<Box<dyn Engine>, EngineError> {
    Err(EngineError::NoDevice {
        reason: "this build draws on the processor only".to_owned(),
    })
}

/// None.
pub fn adapters() -> Vec<AdapterReport> {
    Vec::new()
}
