//! The function of `window`, in a build without one.

use crate::arguments::{Said, ViewArguments};
use crate::fault::{Exit, Fault};

/// Says how to get a window.
pub fn view(_: &Said<ViewArguments>) -> Result<(), Fault> {
    let message = "this build has no window: build it again with --features view";
    Err(Fault::new(Exit::Usage, message))
}
