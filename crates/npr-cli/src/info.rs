//! `npr info`: what is in a file.

use crate::arguments::InfoArguments;
use crate::fault::{Exit, Fault};
use crate::inventory::Inventory;
use crate::output;
use crate::source::Source;

/// Prints what is in a file, what of it is drawn, and what is ignored and why.
pub fn info(said: &InfoArguments) -> Result<(), Fault> {
    let loaded =
        Source::of(&said.file).load(&said.limits.limits(), said.allow_external.as_deref())?;
    let inventory = Inventory::new(&said.file.to_string_lossy(), loaded);
    let text = if said.json {
        json(&inventory)?
    } else {
        inventory.text()
    };
    output::print(text.as_bytes())
}

fn json(inventory: &Inventory) -> Result<String, Fault> {
    let json =
        serde_json::to_string_pretty(inventory).map_err(|error| Fault::new(Exit::Failed, error))?;
    Ok(format!("{json}\n"))
}
