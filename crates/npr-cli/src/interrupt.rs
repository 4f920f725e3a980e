//! Ctrl-C: the process ends with exit code 130, and leaves no half-written file behind.

use std::path::PathBuf;
use std::process::Child;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Exit code of an interrupted run.
const INTERRUPTED: i32 = 130;

/// Held while a file is created, or moved to its final name.
static WRITING: Mutex<()> = Mutex::new(());

/// The temporary file that is being written. An interrupt removes it.
static UNFINISHED: Mutex<Option<PathBuf>> = Mutex::new(None);

/// The program that works for this one. An interrupt ends it.
static HELPER: Mutex<Option<Child>> = Mutex::new(None);

/// Makes Ctrl-C and requests to terminate end the process. They wait for [`hold_off`], end a program
/// that helps, and remove an unfinished file.
///
/// Where the system refuses the handler, Ctrl-C keeps the system's own behaviour.
pub fn install() {
    let _ = ctrlc::set_handler(|| {
        let _writing = hold_off();
        if let Some(mut child) = helper().take() {
            let _ = child.kill().and_then(|()| child.wait());
        }
        if let Some(path) = unfinished().take() {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(INTERRUPTED);
    });
}

/// Delays an interrupt for as long as the guard lives. Use it only for work that is sure to end.
pub fn hold_off() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The file to remove where the process is interrupted.
pub fn unfinished() -> MutexGuard<'static, Option<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The program to end where the process is interrupted. Hold it for short.
pub fn helper() -> MutexGuard<'static, Option<Child>> {
    HELPER.lock().unwrap_or_else(PoisonError::into_inner)
}
