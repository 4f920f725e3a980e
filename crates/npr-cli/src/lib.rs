//! The command `npr` as a library of two functions: [`run`] executes a command line, and [`command`] describes every
//! command and option, for completions and manual pages.
//!
//! A command line is parsed into plain arguments, which are then resolved into a job. Only the second step touches
//! files or a graphics device.
//!
//! ```
//! let command = npr_cli::command();
//! assert!(command.find_subcommand("render").is_some());
//! ```

mod adapter_report;
mod animate;
mod arguments;
mod bands;
mod broken_image;
mod colors;
mod completions;
mod debug_layer;
mod device_choice;
mod doctor;
mod dump;
mod encoder;
mod ending;
mod engine;
mod fault;
mod film_plan;
#[cfg(feature = "gpu")]
mod hardware;
#[cfg(not(feature = "gpu"))]
#[path = "no_hardware.rs"]
mod hardware;
mod idle;
mod info;
mod input;
mod interrupt;
mod inventory;
mod job;
mod layers;
mod line_file;
mod line_job;
mod lines;
mod look;
mod manual;
mod message;
mod outline;
mod output;
mod picture;
mod playing;
mod pose;
mod progress;
mod reel;
mod render;
mod screening;
mod smoke;
mod source;
mod style_source;
mod styles;
mod target;
mod timings;
mod trace;
#[cfg(any(test, feature = "view"))]
mod view;
mod viewpoint;
mod volume;
#[cfg(feature = "view")]
mod window;
#[cfg(not(feature = "view"))]
#[path = "no_window.rs"]
mod window;

use arguments::{Arguments, Command};
use clap::{CommandFactory, Parser};
use fault::{Exit, Fault};
use std::ffi::OsString;
use std::process::ExitCode;

/// Executes a command line, whose first entry is the program's own name, and returns the exit code.
///
/// The code is 0 for success, 1 for a failure while working, 2 for a wrong command line or style file, 3 for invalid
/// or unsupported input, 4 where no graphics device can draw, and 5 for a safety limit. An interrupt ends the process
/// with 130. The function handles the interrupt signals of the process, so call it only once.
///
/// `before_devices` is called before anything else is done for a command that may open a graphics device.
pub fn run(
    arguments: impl IntoIterator<Item = OsString>,
    before_devices: impl FnOnce(),
) -> ExitCode {
    // Execute the command line, or report what is wrong with it.
    let done = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => {
            if arguments.command.may_open_device() {
                before_devices();
            }
            interrupt::install();
            if arguments.command.draws() {
                join_workers();
            }
            obey(arguments.command)
        }
        Err(error) if !error.use_stderr() => output::print(error.render().to_string().as_bytes()),
        Err(error) => Err(Fault::new(Exit::Usage, message::of_usage(&error))),
    };

    // Turn the outcome into an exit code.
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            message::fault(&fault);
            ExitCode::from(fault.exit.code())
        }
    }
}

/// Every command with its options, as clap describes them.
pub fn command() -> clap::Command {
    Arguments::command()
}

/// Makes this thread one of the workers for parallel work, so that one thread less is started.
///
/// A failure to start workers is ignored here, because the first parallel work reports it.
fn join_workers() {
    let _ = rayon::ThreadPoolBuilder::new()
        .use_current_thread()
        .build_global();
}

fn obey(command: Command) -> Result<(), Fault> {
    match command {
        Command::Render(arguments) => render::render(&arguments.0),
        Command::Lines(arguments) => lines::lines(&arguments.0),
        Command::Animate(arguments) => animate::animate(&arguments.0),
        Command::Smoke(arguments) => smoke::smoke(&arguments.0),
        Command::Trace(arguments) => trace::trace(&arguments.0),
        Command::Outline(arguments) => outline::outline(&arguments.0),
        Command::View(arguments) => window::view(&arguments.0),
        Command::Info(arguments) => info::info(&arguments.0),
        Command::Styles { command } => styles::styles(&command),
        Command::Doctor { json } => doctor::doctor(json),
        Command::Man { command } => manual::manual(command.as_deref()),
        Command::Completions { shell } => completions::completions(shell),
    }
}
