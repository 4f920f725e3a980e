//! The command `npr`.

mod headless;

use std::process::ExitCode;

fn main() -> ExitCode {
    npr_cli::run(std::env::args_os(), headless::quiet_drivers)
}
