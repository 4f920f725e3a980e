//! `npr man`: manual pages.

use crate::fault::{Exit, Fault};
use crate::message;
use crate::output;
use clap_mangen::Man;

/// Prints the manual page of a command, or that of `npr` itself where `name` is `None`.
pub fn manual(name: Option<&str>) -> Result<(), Fault> {
    let mut command = crate::command();
    command.build();
    if let Some(name) = name {
        let found = command.find_subcommand(name).cloned();
        command = found.ok_or_else(|| {
            let name = message::name(name);
            Fault::new(
                Exit::Usage,
                format!("there is no command '{name}'; npr --help lists them"),
            )
        })?;
    }
    let mut page = Vec::new();
    Man::new(command).render(&mut page)?;
    output::print(&page)
}
