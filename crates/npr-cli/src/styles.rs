//! `npr styles`: lists, shows and checks presets and style files.

use crate::arguments::StylesCommand;
use crate::fault::{Exit, Fault};
use crate::output;
use crate::style_source::StyleSource;
use npr_stylesheet::{find_preset, presets, schema};

/// Runs one of the commands of `npr styles`.
pub fn styles(command: &StylesCommand) -> Result<(), Fault> {
    match command {
        StylesCommand::List => output::print(list().as_bytes()),
        StylesCommand::Show { name } => {
            let preset = find_preset(name).map_err(|error| Fault::new(Exit::Usage, error))?;
            output::print(preset.text.as_bytes())
        }
        StylesCommand::Check { file } => StyleSource::File(file.clone()).load(None).map(|_| ()),
        StylesCommand::Schema => output::print(format!("{:#}\n", schema()).as_bytes()),
    }
}

/// One line per preset: name, version, title.
fn list() -> String {
    let width = presets()
        .iter()
        .map(|preset| preset.name.len())
        .max()
        .unwrap_or(0);
    let line = |preset: &npr_stylesheet::Preset| {
        format!(
            "{:width$}  @{}  {}\n",
            preset.name,
            preset.version,
            preset.title()
        )
    };
    presets().iter().map(line).collect()
}
