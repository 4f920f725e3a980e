//! The errors that end a run, with their exit codes.

use npr_scene::{ResourceError, SceneError};
use std::fmt;
use std::io;

/// The kind of an error, which decides the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Files could not be read or written.
    Failed,
    /// The command line or a style file is wrong.
    Usage,
    /// The scene or a picture is broken or not supported.
    Input,
    /// A graphics device was demanded, and there is none that can draw.
    NoDevice,
    /// A safety limit was hit.
    Limit,
}

impl Exit {
    /// The exit code of the process.
    pub fn code(self) -> u8 {
        match self {
            Self::Failed => 1,
            Self::Usage => 2,
            Self::Input => 3,
            Self::NoDevice => 4,
            Self::Limit => 5,
        }
    }
}

/// An error that ends a run: its kind, and a message of one line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// The kind of the error.
    pub exit: Exit,
    /// The message in lower case without a full stop, the outermost context first.
    pub message: String,
}

impl Fault {
    /// A fault with its message.
    pub fn new(exit: Exit, message: impl fmt::Display) -> Self {
        let message = message.to_string();
        Self { exit, message }
    }

    /// The fault with its context in front of the message: `doing: message`.
    pub fn while_doing(self, doing: impl fmt::Display) -> Self {
        Self::new(self.exit, format!("{doing}: {}", self.message))
    }
}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::new(Exit::Failed, without_number(error))
    }
}

impl From<SceneError> for Fault {
    fn from(error: SceneError) -> Self {
        let exit = if error.is_limit() {
            Exit::Limit
        } else {
            Exit::Input
        };
        Self::new(exit, without_number(error))
    }
}

/// The fault for a file that a style names and that cannot be read.
impl From<ResourceError> for Fault {
    fn from(error: ResourceError) -> Self {
        let exit = match error {
            ResourceError::Unreadable { .. } => Exit::Failed,
            ResourceError::TooLarge(_) => Exit::Limit,
            _ => Exit::Usage,
        };
        Self::new(exit, without_number(error))
    }
}

/// The text of an error without the error number of the system.
fn without_number(error: impl fmt::Display) -> String {
    let mut text = error.to_string();
    if let Some(start) = text.rfind(" (os error ") {
        text.truncate(start);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_error_loses_its_number_and_gains_its_matter() {
        let error = io::Error::from_raw_os_error(2);
        let fault = Fault::from(error).while_doing("cannot read 'a.glb'");
        assert_eq!(fault.exit, Exit::Failed);
        assert!(fault.message.starts_with("cannot read 'a.glb': "));
        assert!(!fault.message.contains("os error"), "{}", fault.message);
    }
}
