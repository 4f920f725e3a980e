//! Where files that a scene refers to come from.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use crate::limits::{self, LimitError};
use crate::shown::shown;

/// Why a file that a scene refers to was not read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResourceError {
    /// The name leads out of the scene's folder.
    #[error(
        "'{}' lies outside the scene's folder; --allow-external widens it",
        shown(name)
    )]
    Outside {
        /// The name as the scene gives it.
        name: String,
    },
    /// The name has a scheme such as `http:` or `file:`.
    #[error("'{}' is no relative path, and only those are followed", shown(name))]
    Remote {
        /// The name as the scene gives it.
        name: String,
    },
    /// The percent escapes do not give text.
    #[error("'{}' has percent escapes that give no text", shown(name))]
    BadEscape {
        /// The name as the scene gives it.
        name: String,
    },
    /// The text after `base64,` is not base64.
    #[error("a data URI holds no valid base64")]
    BadData,
    /// Folders, pipes and devices are not opened.
    #[error("'{}' is not a regular file", shown(name))]
    NotAFile {
        /// The name as the scene gives it.
        name: String,
    },
    /// The system could not read it.
    #[error("cannot read '{}': {}", shown(name), shown(fault))]
    Unreadable {
        /// The name as the scene gives it.
        name: String,
        /// The system's own words, without its number for them.
        fault: String,
    },
    /// It is larger than the limit for files.
    #[error(transparent)]
    TooLarge(#[from] LimitError),
}

/// Gives a scene the files it refers to.
pub trait Resources {
    /// The content of the file that `name` leads to from the scene's own folder.
    ///
    /// `name` is a path with `/` between its parts and without percent escapes.
    ///
    /// # Errors
    ///
    /// [`ResourceError`] where the file may not be read, cannot be, or exceeds `limit_bytes`.
    fn read(&self, name: &str, limit_bytes: u64) -> Result<Vec<u8>, ResourceError>;

    /// Hears of a file that the scene refers to, but that is not read, because
    /// [`Limits::decode_images`](crate::Limits::decode_images) is off.
    ///
    /// Such a file is still part of the scene, and nothing should be written over it.
    fn mention(&self, _name: &str) {}
}

/// Files in memory, for tests, the web and scenes from standard input.
#[derive(Debug, Clone, Default)]
pub struct MemoryResources {
    /// Content by name.
    pub files: BTreeMap<String, Vec<u8>>,
}

impl Resources for MemoryResources {
    fn read(&self, name: &str, limit_bytes: u64) -> Result<Vec<u8>, ResourceError> {
        let Some(bytes) = self.files.get(name) else {
            return Err(unreadable(name, "no such file"));
        };
        limits::check(
            "size of a file in bytes",
            bytes.len() as u64,
            limit_bytes,
            "--max-file",
        )?;
        Ok(bytes.clone())
    }
}

/// Files in and below a folder, and perhaps one more; links that lead outside are not followed.
#[derive(Debug, Clone)]
pub struct FolderResources {
    folder: PathBuf,
    external: Option<PathBuf>,
}

impl FolderResources {
    /// Files below `folder`, and below `external` where one is given.
    ///
    /// # Errors
    ///
    /// [`ResourceError::Unreadable`] where one of the folders does not exist.
    pub fn new(folder: &Path, external: Option<&Path>) -> Result<Self, ResourceError> {
        let external = external.map(canonical).transpose()?;
        Ok(Self {
            folder: canonical(folder)?,
            external,
        })
    }

    fn resolve(&self, name: &str) -> Result<PathBuf, ResourceError> {
        // Refuse before touching the disk, so that not even existence leaks.
        if self.external.is_none() && !stays_below(name) {
            return Err(ResourceError::Outside {
                name: name.to_owned(),
            });
        }
        let path = self.folder.join(name);
        let path = path
            .canonicalize()
            .map_err(|fault| unreadable(name, fault))?;
        let inside = |root: &PathBuf| path.starts_with(root);
        if inside(&self.folder) || self.external.as_ref().is_some_and(inside) {
            return Ok(path);
        }
        Err(ResourceError::Outside {
            name: name.to_owned(),
        })
    }
}

impl Resources for FolderResources {
    fn read(&self, name: &str, limit_bytes: u64) -> Result<Vec<u8>, ResourceError> {
        read_regular(&self.resolve(name)?, name, limit_bytes)
    }
}

/// Content of the regular file at `path`; `name` stands for it in messages.
pub(crate) fn read_regular(
    path: &Path,
    name: &str,
    limit_bytes: u64,
) -> Result<Vec<u8>, ResourceError> {
    // Opening a pipe or a device may block, so its kind is checked first.
    let metadata = path.metadata().map_err(|fault| unreadable(name, fault))?;
    if !metadata.is_file() {
        return Err(ResourceError::NotAFile {
            name: name.to_owned(),
        });
    }
    let check =
        |size: u64| limits::check("size of a file in bytes", size, limit_bytes, "--max-file");
    check(metadata.len())?;

    // Read no further than one byte past the limit: the file may grow meanwhile.
    let mut bytes = Vec::with_capacity(usize::try_from(metadata.len()).unwrap_or(0));
    let file = File::open(path).map_err(|fault| unreadable(name, fault))?;
    let mut file = file.take(limit_bytes.saturating_add(1));
    file.read_to_end(&mut bytes)
        .map_err(|fault| unreadable(name, fault))?;
    check(bytes.len() as u64)?;
    Ok(bytes)
}

fn canonical(folder: &Path) -> Result<PathBuf, ResourceError> {
    folder
        .canonicalize()
        .map_err(|fault| unreadable(&folder.to_string_lossy(), fault))
}

fn unreadable(name: &str, fault: impl ToString) -> ResourceError {
    let mut fault = fault.to_string();
    // The number of a system error tells people nothing.
    if let Some(start) = fault.rfind(" (os error ") {
        fault.truncate(start);
    }
    ResourceError::Unreadable {
        name: name.to_owned(),
        fault,
    }
}

/// Whether the parts of `name` never climb above where they start.
fn stays_below(name: &str) -> bool {
    let mut depth = 0usize;
    for component in Path::new(name).components() {
        let next = match component {
            Component::Normal(_) => depth.checked_add(1),
            Component::CurDir => Some(depth),
            Component::ParentDir => depth.checked_sub(1),
            Component::Prefix(_) | Component::RootDir => None,
        };
        let Some(next) = next else { return false };
        depth = next;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder_with_secret() -> (tempfile::TempDir, FolderResources) {
        let outer = tempfile::tempdir().expect("temporary folder");
        let inner = outer.path().join("scene");
        std::fs::create_dir(&inner).expect("inner folder");
        write(&outer.path().join("secret.bin"), b"secret");
        write(&inner.join("mesh.bin"), b"mesh");
        let resources = FolderResources::new(&inner, None).expect("folder exists");
        (outer, resources)
    }

    #[allow(clippy::disallowed_methods, reason = "a fixture, not an output")]
    fn write(path: &Path, bytes: &[u8]) {
        std::fs::write(path, bytes).expect("fixture written");
    }

    #[test]
    fn files_of_the_folder_are_read() {
        let (_outer, resources) = folder_with_secret();
        assert_eq!(resources.read("mesh.bin", 100), Ok(b"mesh".to_vec()));
        assert_eq!(
            resources.read("./x/../mesh.bin", 100).is_ok(),
            cfg!(windows)
        );
        assert!(matches!(
            resources.read("mesh.bin", 3),
            Err(ResourceError::TooLarge(_))
        ));
    }

    #[test]
    fn a_missing_file_is_told_in_words() {
        let (_outer, resources) = folder_with_secret();
        let fault = resources.read("absent.mtl", 100).expect_err("absent");
        assert!(matches!(fault, ResourceError::Unreadable { .. }));
        assert!(!fault.to_string().contains("os error"), "{fault}");
    }

    #[test]
    fn nothing_outside_is_read() {
        let (outer, resources) = folder_with_secret();
        let absolute = outer
            .path()
            .join("secret.bin")
            .to_string_lossy()
            .into_owned();
        for name in [
            "../secret.bin",
            "a/../../secret.bin",
            &absolute,
            "/dev/zero",
        ] {
            assert!(
                matches!(
                    resources.read(name, 100),
                    Err(ResourceError::Outside { .. })
                ),
                "{name}"
            );
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_that_leads_outside_is_refused_until_its_goal_is_allowed() {
        let (outer, resources) = folder_with_secret();
        let link = outer.path().join("scene/link.bin");
        std::os::unix::fs::symlink(outer.path().join("secret.bin"), link).expect("link made");
        assert!(matches!(
            resources.read("link.bin", 100),
            Err(ResourceError::Outside { .. })
        ));

        let inner = outer.path().join("scene");
        let wider = FolderResources::new(&inner, Some(outer.path())).expect("both exist");
        assert_eq!(wider.read("link.bin", 100), Ok(b"secret".to_vec()));
        assert_eq!(wider.read("../secret.bin", 100), Ok(b"secret".to_vec()));
    }

    #[test]
    fn a_folder_is_no_file() {
        let (_outer, resources) = folder_with_secret();
        assert!(matches!(
            resources.read(".", 100),
            Err(ResourceError::NotAFile { .. })
        ));
    }
}
