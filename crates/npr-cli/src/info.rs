//! `npr info`: what is in a file.

use crate::arguments::InfoArguments;
use crate::fault::{Exit, Fault};
use crate::inventory::{Inventory, VolumeInventory};
use crate::output;
use crate::source::Source;
use crate::volume::VolumeSource;
use npr_render::VolumeOptions;
use serde::Serialize;

/// Prints what is in a file, what of it is drawn, and what is ignored and why.
pub fn info(said: &InfoArguments) -> Result<(), Fault> {
    let limits = said.limits.limits();
    let loaded = Source::of(&said.file).load(&limits, said.allow_external.as_deref())?;
    let file = said.file.to_string_lossy();
    let text = match &loaded.volume {
        Some(VolumeSource::Read(_, bytes)) => {
            let options = VolumeOptions {
                memory_limit: limits.memory_bytes,
                ..VolumeOptions::default()
            };
            let inventory = VolumeInventory::new(&file, bytes, &options)?;
            told(said.json, &inventory, VolumeInventory::text)?
        }
        _ => told(said.json, &Inventory::new(&file, loaded), Inventory::text)?,
    };
    output::print(text.as_bytes())
}

/// An inventory as JSON or in words.
fn told<T: Serialize>(
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
