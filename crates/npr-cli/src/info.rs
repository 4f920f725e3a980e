//! `npr info`: reports the contents of a file.

use crate::arguments::InfoArguments;
use crate::fault::{Exit, Fault};
use crate::inventory::{Inventory, VolumeInventory};
use crate::output;
use crate::source::Source;
use crate::volume::VolumeSource;
use npr_smoke::file::VolumeOptions;
use serde::Serialize;

/// Prints what is in a file, what of it is drawn, and what is ignored and why.
pub fn info(args: &InfoArguments) -> Result<(), Fault> {
    let limits = args.limits.limits();
    let loaded = Source::of(&args.file).load(&limits, args.allow_external.as_deref())?;
    let file = args.file.to_string_lossy();
    let text = match &loaded.volume {
        Some(VolumeSource::Read(_, bytes)) => {
            let options = VolumeOptions {
                memory_limit: limits.memory_bytes,
                ..VolumeOptions::default()
            };
            let inventory = VolumeInventory::new(&file, bytes, &options)?;
            reported(args.json, &inventory, VolumeInventory::text)?
        }
        _ => reported(args.json, &Inventory::new(&file, loaded), Inventory::text)?,
    };
    output::print(text.as_bytes())
}

/// An inventory as JSON or in words.
fn reported<T: Serialize>(
    as_json: bool,
    inventory: &T,
    in_words: fn(&T) -> String,
) -> Result<String, Fault> {
    if !as_json {
        return Ok(in_words(inventory));
    }
    let json =
        serde_json::to_string_pretty(inventory).map_err(|error| Fault::new(Exit::Failed, error))?;
    Ok(format!("{json}\n"))
}
