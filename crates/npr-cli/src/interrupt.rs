//! Ctrl-C: the process ends with 130, but never between a half-written file and its removal.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Exit code of an interrupted run.
const INTERRUPTED: i32 = 130;

/// Held while a file comes to be, or is put in its place.
static WRITING: Mutex<()> = Mutex::new(());

/// The file that is being written, under a name of its own: goes with the process.
static UNFINISHED: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Ends the process at Ctrl-C, or when asked to terminate, once no file is being written.
///
/// Where the system refuses the handler, Ctrl-C does what the system lets it do by itself.
pub fn install() {
    let _ = ctrlc::set_handler(|| {
        let _writing = hold_off();
        if let Some(path) = unfinished().take() {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(INTERRUPTED);
    });
}

/// Puts interruption off for as long as the guard lives. Only for work that ends by itself.
pub fn hold_off() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The file to remove where the process is interrupted.
pub fn unfinished() -> MutexGuard<'static, Option<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}
