//! The source of a style: a preset or a style file.

use crate::fault::{Exit, Fault};
use crate::input::read_file;
use crate::message::quoted;
use crate::output::folder_of;
use npr_scene::{FolderResources, Resources};
use npr_stylesheet::{DEFAULT_PRESET, Stated, TEXT_BYTES_MAX};
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// A preset or a style file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StyleSource {
    /// Name of a preset, perhaps with its version.
    Preset(String),
    /// Path of a style file.
    File(PathBuf),
}

impl StyleSource {
    /// The source that a text names. A text with a folder in it or with the extension .toml is a file, any other a
    /// preset; `None` is the default preset.
    pub fn of(text: Option<&str>) -> Self {
        let text = text.unwrap_or(DEFAULT_PRESET);
        let path = Path::new(text);
        let is_toml = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        if is_toml || path.components().count() > 1 || path.is_absolute() {
            Self::File(path.to_owned())
        } else {
            Self::Preset(text.to_owned())
        }
    }

    /// The file, if it is one.
    pub fn file(&self) -> Option<&Path> {
        match self {
            Self::Preset(_) => None,
            Self::File(path) => Some(path),
        }
    }

    /// Loads the style. Its parents are looked for in its own folder and below, and in `external`.
    pub fn load(&self, external: Option<&Path>) -> Result<Stated, Fault> {
        self.load_with_files(external).map(|(stated, _)| stated)
    }

    /// The same with the files that it was read from: its own, and those of its parents.
    pub fn load_with_files(
        &self,
        external: Option<&Path>,
    ) -> Result<(Stated, Vec<PathBuf>), Fault> {
        match self {
            Self::Preset(name) => match Stated::preset(name) {
                Ok(stated) => Ok((stated, Vec::new())),
                Err(error) => Err(Fault::new(Exit::Usage, error)),
            },
            Self::File(path) => load_file(path, external),
        }
    }
}

fn load_file(path: &Path, external: Option<&Path>) -> Result<(Stated, Vec<PathBuf>), Fault> {
    // Read one byte more than a style may have, so that the parser of styles reports its own limit.
    let bytes = read_file(path, TEXT_BYTES_MAX as u64 + 1).map_err(|fault| match fault.exit {
        Exit::Failed => fault,
        _ => Fault::new(Exit::Usage, fault.message),
    })?;
    let wrong = |reason: &dyn std::fmt::Display| {
        Fault::new(Exit::Usage, format!("style {}: {reason}", quoted(path)))
    };
    let text = String::from_utf8(bytes).map_err(|_| wrong(&"it is not UTF-8 text"))?;
    let folder = FolderResources::new(folder_of(path), external)?;
    let files = RefCell::new(vec![path.to_owned()]);
    let parent = |name: &str| {
        files.borrow_mut().push(folder_of(path).join(name));
        let bytes = folder
            .read(name, TEXT_BYTES_MAX as u64 + 1)
            .map_err(|error| Fault::from(error).message)?;
        String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".to_owned())
    };
    let stated = Stated::from_toml(&text, &parent).map_err(|error| wrong(&error))?;
    Ok((stated, files.into_inner()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_told_from_presets() {
        let file = |text: &str| StyleSource::of(Some(text)).file().is_some();
        assert!(file("my.toml") && file("looks/ink") && file("/ink") && file("a.TOML"));
        assert!(!file("ink") && !file("ink@1"));
        assert_eq!(
            StyleSource::of(None),
            StyleSource::Preset(DEFAULT_PRESET.to_owned())
        );
    }
}
