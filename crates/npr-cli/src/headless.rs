//! Quiet drivers on machines without a display.

/// Variable that tells Mesa's device selection layer to stay out.
#[cfg(target_os = "linux")]
const SELECTION_OFF: &str = "NODEVICE_SELECT";

/// Starts the program again with Mesa's device selection layer off, where that layer would write to standard error.
///
/// The layer complains of a missing display before it says anything useful, and only an environment set before the
/// process starts silences it. Where the program cannot be started again, it goes on as it is.
#[cfg(target_os = "linux")]
pub fn quiet_drivers() {
    use std::os::unix::process::CommandExt;

    let has_display = std::env::var_os("XDG_RUNTIME_DIR").is_some();
    if has_display || std::env::var_os(SELECTION_OFF).is_some() {
        return;
    }
    if let Ok(program) = std::env::current_exe() {
        let arguments = std::env::args_os().skip(1);
        let _error = std::process::Command::new(program)
            .args(arguments)
            .env(SELECTION_OFF, "1")
            .exec();
    }
}

/// Other systems have no such layer.
#[cfg(not(target_os = "linux"))]
pub fn quiet_drivers() {}
