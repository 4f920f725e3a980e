//! Turns errors about volumes into faults of the command.

use crate::fault::{Exit, Fault};
use crate::message::quoted;
use npr_core::budget::OverBudget;
use npr_smoke::VolumeError;
use npr_smoke::file::VolumeFault;
use npr_smoke::film::{Numbered, SeriesError};
use npr_smoke::solver::SmokeError;

/// The fault for a volume that cannot be read. `name` goes into the message as it is, so paths must be quoted.
pub fn of_volume(name: &str, fault: VolumeFault) -> Fault {
    let exit = match &fault {
        fault if fault.is_limit() => Exit::Limit,
        VolumeFault::Components { .. } | VolumeFault::Read(npr_vdb::Fault::NoGrid { .. }) => {
            Exit::Usage
        }
        _ => Exit::Input,
    };
    let remedy = match (fault.is_memory(), exit) {
        (true, _) => "; --memory-limit lifts that",
        (false, Exit::Limit) => ", and no option lifts that",
        (false, _) => "",
    };
    Fault::new(exit, format!("cannot read {name}: {fault}{remedy}"))
}

/// The fault for a series of files. The message names the file at fault.
pub fn of_series(series: &Numbered, error: SeriesError<Fault>) -> Fault {
    let name = |frame: u32| quoted(&series.path(frame));
    match error {
        SeriesError::Open(fault) => fault,
        SeriesError::Frame { frame, fault } => of_volume(&name(frame), fault),
        SeriesError::OtherGrid { frame, first } => {
            let (here, start) = (name(frame), name(first));
            let message =
                format!("cannot read {here}: its voxels do not lie on the grid of {start}");
            Fault::new(Exit::Input, message)
        }
        SeriesError::Volume(error) => error.into(),
    }
}

/// The fault for smoke that exceeds the memory limit.
pub fn limit_of(error: &OverBudget) -> Fault {
    Fault::new(Exit::Limit, format!("{error}; --memory-limit lifts that"))
}

impl From<SmokeError> for Fault {
    fn from(error: SmokeError) -> Self {
        match &error {
            SmokeError::OverBudget(error) => limit_of(error),
            _ => Self::new(Exit::Usage, format!("--grid: {error}")),
        }
    }
}

impl From<VolumeError> for Fault {
    fn from(error: VolumeError) -> Self {
        Self::new(Exit::Input, error)
    }
}
