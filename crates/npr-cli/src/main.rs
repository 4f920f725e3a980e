//! The command `npr`.

mod headless;

use std::process::ExitCode;

fn main() -> ExitCode {
    headless::quiet_drivers();
    npr_cli::run(std::env::args_os())
}
