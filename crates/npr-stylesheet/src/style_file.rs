//! Styles as text: files, presets and overrides.

use crate::error::StyleError;
use crate::set::Assignment;
use crate::{Style, layers, preset, set};

impl Style {
    /// Reads a style file of at most 1 MiB.
    ///
    /// Its parents in `extends` are laid below it: presets by name, anything else through `load`, which
    /// is given the parent as named and answers with its text or with why there is none. Tables merge key
    /// by key, `rule` and `id_map` blocks add up, and any other value of the file replaces its parents'.
    ///
    /// # Errors
    ///
    /// [`StyleError`] for the first fault, with line and column where it stands in `text` itself.
    pub fn from_toml(
        text: &str,
        load: &dyn Fn(&str) -> Result<String, String>,
    ) -> Result<Self, StyleError> {
        Ok(layers::read(text, load)?.style)
    }

    /// The preset called `name`, or `name@version`.
    ///
    /// # Errors
    ///
    /// [`StyleError::UnknownPreset`] or [`StyleError::PresetVersion`].
    pub fn preset(name: &str) -> Result<Self, StyleError> {
        let found = preset::find(name)?;
        Self::from_toml(found.text, &|parent| {
            Err(format!(
                "preset '{}' extends no file '{parent}'",
                found.name
            ))
        })
    }

    /// Overrides one value by `key.path=value`, such as `line.width.base=5px`.
    ///
    /// The value is TOML; text needs no quotes. Entries of lists are counted from 0: `rule.0.line.on=false`.
    /// What rules say about the same key gives way, so that an override always shows.
    ///
    /// # Errors
    ///
    /// [`StyleError`] for an unknown key or a value that does not fit; the style is unchanged then.
    pub fn set(&mut self, assignment: &str) -> Result<(), StyleError> {
        *self = set::assign(self, &[Assignment::of(assignment)?])?;
        Ok(())
    }

    /// The style as TOML with every value spelled out; reading it gives the same style.
    ///
    /// # Errors
    ///
    /// [`StyleError::Syntax`] if a value has no TOML form, which no style that was read has.
    pub fn to_toml(&self) -> Result<String, StyleError> {
        toml::to_string(self).map_err(|error| StyleError::Syntax {
            place: None,
            message: error.to_string(),
        })
    }
}
