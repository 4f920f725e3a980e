//! Graphics devices to measure on.

use npr_gpu::device::{AdapterChoice, Device};
use npr_gpu::engine::{Engine, EngineError};

/// The best device of this machine, software ones included; says on standard error why there is none.
pub fn open() -> Option<Box<dyn Engine>> {
    open_of(AdapterChoice::Any)
}

/// The best graphics hardware of this machine; says on standard error why there is none.
pub fn open_hardware() -> Option<Box<dyn Engine>> {
    open_of(AdapterChoice::Hardware)
}

/// The best device of this machine, software ones included, with times of passes that can be believed; says on standard
/// error why there is none.
pub fn open_timing_passes() -> Option<Box<dyn Engine>> {
    let device = Device::open(AdapterChoice::Any).map(Device::timing_passes);
    boxed(device)
}

fn open_of(choice: AdapterChoice) -> Option<Box<dyn Engine>> {
    boxed(Device::open(choice))
}

fn boxed(device: Result<Device, EngineError>) -> Option<Box<dyn Engine>> {
    match device {
        Ok(device) => Some(Box::new(device)),
        Err(error) => {
            eprintln!("device left out: {error}");
            None
        }
    }
}
