//! The command `npr`.

use std::process::ExitCode;

fn main() -> ExitCode {
    npr_cli::run(std::env::args_os())
}
