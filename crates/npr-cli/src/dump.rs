//! A style as it comes out, printed.

use crate::arguments::{DrawingArguments, LookArguments};
use crate::fault::{Exit, Fault};
use crate::look::Look;
use crate::output;

/// Prints a style as it comes out.
pub fn dump_style(args: &LookArguments, drawing: &DrawingArguments) -> Result<(), Fault> {
    let look = Look::resolve(args, drawing.allow_external.as_deref())?.with_smoke(&drawing.volumes);
    let text = look
        .style
        .to_toml()
        .map_err(|error| Fault::new(Exit::Failed, error))?;
    output::print(text.as_bytes())
}
