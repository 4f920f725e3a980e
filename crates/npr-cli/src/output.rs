//! The destinations of results: standard output, or a file that appears whole or not at all.

use crate::fault::{Exit, Fault};
use crate::interrupt;
use crate::message::quoted;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The destination of a picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Output {
    /// Standard output.
    Standard,
    /// A file that can be written; links in its path are resolved.
    File(PathBuf),
}

impl Output {
    /// The destination that `path` names; `-` is standard output.
    ///
    /// Fails before any work is done where the folder is missing, or where something other than a writable file is at
    /// `path`.
    pub fn of(path: &Path) -> Result<Self, Fault> {
        if path.as_os_str() == "-" {
            return Ok(Self::Standard);
        }
        resolve(path)
            .map(Self::File)
            .map_err(|fault| fault.while_doing(format_args!("cannot write {}", quoted(path))))
    }

    /// Refuses to write over a file that the picture is made from.
    pub fn refuse_any_of(&self, inputs: &[PathBuf]) -> Result<(), Fault> {
        let Self::File(path) = self else {
            return Ok(());
        };
        let same = |input: &PathBuf| input.canonicalize().is_ok_and(|input| input == *path);
        if inputs.iter().any(same) {
            let message = format!("cannot write {}: it is also an input", quoted(path));
            return Err(Fault::new(Exit::Usage, message));
        }
        Ok(())
    }

    /// Writes all bytes. It is no error where the reader of standard output closes it early.
    pub fn write(&self, bytes: &[u8]) -> Result<(), Fault> {
        self.write_with(|sink| sink.write_all(bytes))
    }

    /// Writes the bytes of `fill` as they come, otherwise as [`Self::write`] does.
    pub fn write_with(
        &self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Fault> {
        match self {
            Self::Standard => print_with(fill),
            Self::File(path) => write_atomic(path, |file| fill(file))
                .map_err(|error: io::Error| self.cannot_write(error.into())),
        }
    }

    /// Lets `fill` write a file at the path that it gets, otherwise as [`Self::write`] does. Standard output has no
    /// path.
    pub fn write_by(&self, fill: impl FnOnce(&Path) -> Result<(), Fault>) -> Result<(), Fault> {
        let Self::File(path) = self else {
            return Err(Fault::new(Exit::Usage, "it cannot go to standard output"));
        };
        write_atomic(path, |file| fill(file.path())).map_err(|fault| self.cannot_write(fault))
    }

    /// An empty file without a name, in the folder of the file, for what is needed until that is written.
    pub fn scratch(&self) -> io::Result<std::fs::File> {
        match self {
            Self::Standard => tempfile::tempfile(),
            Self::File(path) => tempfile::tempfile_in(folder_of(path)),
        }
    }

    /// The fault of writing, with the name of what cannot be written.
    pub fn cannot_write(&self, fault: Fault) -> Fault {
        match self {
            Self::Standard => fault.while_doing("cannot write to standard output"),
            Self::File(path) => fault.while_doing(format_args!("cannot write {}", quoted(path))),
        }
    }
}

/// Writes to standard output; a closed pipe is a quiet success.
pub fn print(bytes: &[u8]) -> Result<(), Fault> {
    print_with(|sink| sink.write_all(bytes))
}

fn print_with(fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Fault> {
    let mut stdout = io::stdout().lock();
    match fill(&mut stdout).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Fault::from(error).while_doing("cannot write to standard output")),
        Ok(()) => Ok(()),
    }
}

/// `path` with links resolved, if a file may be written there.
fn resolve(path: &Path) -> Result<PathBuf, Fault> {
    match std::fs::metadata(path) {
        Ok(there) if !there.is_file() => Err(Fault::new(
            Exit::Failed,
            "it exists and is not a regular file",
        )),
        Ok(there) if there.permissions().readonly() => {
            Err(Fault::new(Exit::Failed, "it is read-only"))
        }
        Ok(_) => Ok(path.canonicalize()?),
        Err(error) if error.kind() == ErrorKind::NotFound => in_folder(path),
        Err(error) => Err(error.into()),
    }
}

/// A path that does not exist yet, with the links of its folder resolved.
fn in_folder(path: &Path) -> Result<PathBuf, Fault> {
    let folder = folder_of(path);
    let folder = folder.canonicalize().map_err(|error| match error.kind() {
        ErrorKind::NotFound => Fault::new(
            Exit::Failed,
            format_args!("there is no folder {}", quoted(folder)),
        ),
        _ => error.into(),
    })?;
    Ok(folder.join(path.file_name().unwrap_or_default()))
}

/// The folder that a path lies in; the current one where it names none.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Writes a temporary file in the same folder and renames it when it is whole, so that readers see the old file or the
/// new one. No temporary file stays behind after a failure or an interrupt.
fn write_atomic<E: From<io::Error>>(
    path: &Path,
    fill: impl FnOnce(&mut NamedTempFile) -> Result<(), E>,
) -> Result<(), E> {
    let mut file = {
        let _writing = interrupt::hold_off();
        let file = new_file_in(folder_of(path))?;
        *interrupt::unfinished() = Some(file.path().to_owned());
        file
    };
    let filled = fill(&mut file);
    // From here on an interrupt waits until the file has its final name.
    let _writing = interrupt::hold_off();
    *interrupt::unfinished() = None;
    filled?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

#[cfg(unix)]
fn new_file_in(folder: &Path) -> io::Result<NamedTempFile> {
    use std::os::unix::fs::PermissionsExt;

    // Ask for the permissions of any new file, which the user's umask restricts.
    let permissions = std::fs::Permissions::from_mode(0o666);
    tempfile::Builder::new()
        .prefix(".npr-")
        .permissions(permissions)
        .tempfile_in(folder)
}

#[cfg(not(unix))]
fn new_file_in(folder: &Path) -> io::Result<NamedTempFile> {
    tempfile::Builder::new().prefix(".npr-").tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_nothing_stays_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("out.png");
        for content in ["first", "second"] {
            Output::of(&path)
                .and_then(|output| output.write(content.as_bytes()))
                .expect("written");
            assert_eq!(std::fs::read_to_string(&path).expect("a file"), content);
        }
        assert_eq!(
            std::fs::read_dir(folder.path()).expect("a folder").count(),
            1
        );
    }

    #[test]
    fn folders_are_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let inner = folder.path().join("folder.png");
        std::fs::create_dir(&inner).expect("a folder");
        assert_eq!(
            Output::of(&inner).map_err(|fault| fault.exit),
            Err(Exit::Failed)
        );
    }
}
