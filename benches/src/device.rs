//! Graphics devices to measure on.

use npr_gpu::device::{AdapterChoice, Device};
use npr_gpu::engine::Engine;

/// The best device of this machine, software ones included; says on standard error why there is none.
pub fn open() -> Option<Box<dyn Engine>> {
    open_of(AdapterChoice::Any)
}

/// The best graphics hardware of this machine; says on standard error why there is none.
pub fn open_hardware() -> Option<Box<dyn Engine>> {
    open_of(AdapterChoice::Hardware)
}

fn open_of(choice: AdapterChoice) -> Option<Box<dyn Engine>> {
    match Device::open(choice) {
        Ok(device) => Some(Box::new(device)),
        Err(error) => {
            eprintln!("device left out: {error}");
            None
        }
    }
}
