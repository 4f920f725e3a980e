//! The frames of a simulation by their numbers.

use crate::{Smoke, Volume};

/// A simulation that goes on as far as frames are asked for.
#[derive(Debug, Clone)]
pub struct Simulation {
    smoke: Smoke,
    /// Frames that are done.
    done: u32,
}

impl Simulation {
    /// A simulation before its first frame, which is number 1.
    pub fn new(smoke: Smoke) -> Self {
        Self { smoke, done: 0 }
    }

    /// The smoke of a frame. Frames that are past cannot be had again: they show the latest one.
    pub fn read(&mut self, frame: u32) -> Volume {
        while self.done < frame {
            self.smoke.step();
            self.done += 1;
        }
        self.smoke.volume()
    }
}
