//! `npr completions`: scripts that let a shell complete commands and options.

use crate::fault::Fault;
use crate::output;
use clap_complete::{Shell, generate};

/// Prints the script for a shell.
pub fn completions(shell: Shell) -> Result<(), Fault> {
    let mut script = Vec::new();
    generate(shell, &mut crate::command(), "npr", &mut script);
    output::print(&script)
}
