//! `--dump-style`: prints the resolved style.

use crate::arguments::{DrawingArguments, LookArguments};
use crate::fault::{Exit, Fault};
use crate::look::Look;
use crate::output;

/// Prints the style with all overrides applied, every value spelled out.
pub fn dump_style(args: &LookArguments, drawing: &DrawingArguments) -> Result<(), Fault> {
    let look = Look::resolve(args, drawing.allow_external.as_deref())?.with_smoke(&drawing.volumes);
    let text = look
        .style
        .to_toml()
        .map_err(|error| Fault::new(Exit::Failed, error))?;
    output::print(text.as_bytes())
}
