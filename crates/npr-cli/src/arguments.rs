//! The arguments of the command line, as clap parses them.

mod animate;
mod byte_count;
mod cache;
mod camera;
mod deferred;
mod drawing;
mod frames;
mod limits;
mod lines;
mod look;
mod outline;
mod point;
mod pose;
mod render;
mod size;
mod smoke;
mod trace;
mod trace_form;
mod view;
mod volume;

pub use animate::{AnimateArguments, FilmArguments};
pub use cache::CacheArguments;
pub use camera::CameraArguments;
pub use deferred::Deferred;
pub use drawing::{Backend, DrawingArguments, TimingsForm};
pub use frames::Frames;
pub use limits::LimitArguments;
pub use lines::{
    HiddenLines, LineArguments, LineFormat, LinesArguments, PaintedName, PathForm, SheetArguments,
    Switch,
};
pub use look::LookArguments;
pub use outline::{Behind, OutlineArguments};
pub use point::Point;
pub use pose::{ExpressionShare, LookedAt, PoseArguments};
pub use render::RenderArguments;
pub use size::Size;
pub use smoke::SmokeArguments;
pub use trace::{TraceArguments, TracedForm, TracedFormat};
pub use view::{Said, ViewArguments};
pub use volume::{PlacedVolume, VolumeArguments, VolumeUp};

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;

/// Draws 3D scenes as ink, cels and vector lines.
#[derive(Debug, Parser)]
#[command(name = "npr", version, max_term_width = 100)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw one picture of a scene.
    ///
    /// Without options, `npr render model.glb` draws the model from three quarters above in the style
    /// `toon` and writes model.png into the current folder.
    Render(Box<Deferred<RenderArguments>>),
    /// Draw only the lines of a scene, as curves.
    ///
    /// Without options, `npr lines model.glb` draws the model from three quarters above and writes model.svg
    /// into the current folder.
    Lines(Box<Deferred<LinesArguments>>),
    /// Draw a film of a scene: a picture or a line drawing for every frame, or all frames in one file.
    ///
    /// Without options, `npr animate model.glb --turntable` turns the camera once around the model in the style `toon`
    /// and writes model_0000.png and so on into the current folder; `-o model.gif` writes one file that plays. What a
    /// frame shows follows from its number alone: a film may be drawn in parts, `--length 240 --frames 0..59` and so
    /// on, with the same bytes.
    Animate(Box<Deferred<AnimateArguments>>),
    /// Draw cartoon smoke: from a built-in simulation, a volume file, or a series of them.
    ///
    /// Without options, `npr smoke plume` lets a plume rise and writes plume.png into the current folder;
    /// `npr smoke plume --frames 1..96 -o smoke_####.png` draws the film.
    Smoke(Box<Deferred<SmokeArguments>>),
    /// Trace bitmaps: turn black and white pictures into curves, by the method of Potrace.
    ///
    /// Without options, `npr trace drawing.png` writes drawing.svg into the current folder.
    Trace(Box<Deferred<TraceArguments>>),
    /// Outline a figure before a background by the method of Tsuji: where both are alike, the line becomes a lighter
    /// or darker colour of the figure.
    ///
    /// Without options, `npr outline hero.png street.png -o out.png` draws a black line of one pixel around what is
    /// opaque in hero.png, before street.png, and changes it where it would not be seen.
    Outline(Box<Deferred<OutlineArguments>>),
    /// Open a window with a picture of a scene that the mouse turns, and a control for every key of its style.
    ///
    /// Without options, `npr view model.glb` shows the model as `npr render model.glb` draws it. The window saves
    /// style and picture, and gives the command line that draws what it shows. It takes a build with the feature view.
    View(Box<Deferred<Said<ViewArguments>>>),
    /// Tell what is in a file, what of it is drawn, and what is ignored and why.
    Info(Deferred<InfoArguments>),
    /// List, show and check styles.
    Styles {
        /// What to do with them.
        #[command(subcommand)]
        command: StylesCommand,
    },
    /// Tell what this machine can do, ready to paste into a report.
    Doctor {
        /// As JSON.
        #[arg(long)]
        json: bool,
    },
    /// Print a manual page, such as `npr man lines | man -l -`.
    Man {
        /// The command it is about; without, of all of them.
        command: Option<String>,
    },
    /// Print a completion script for a shell.
    Completions {
        /// The shell it is for.
        shell: Shell,
    },
}

impl Command {
    /// Whether the command draws, which uses all threads. Other commands need only their own thread.
    pub fn draws(&self) -> bool {
        matches!(
            self,
            Self::Render(_)
                | Self::Lines(_)
                | Self::Animate(_)
                | Self::Smoke(_)
                | Self::Trace(_)
                | Self::Outline(_)
        )
    }

    /// Whether the command may open a graphics device.
    pub fn may_open_device(&self) -> bool {
        let backend = match self {
            Self::Render(arguments) => arguments.0.drawing.backend,
            Self::Lines(arguments) => arguments.0.drawing.backend,
            Self::Animate(arguments) => arguments.0.drawing.backend,
            Self::Smoke(arguments) => arguments.0.drawing.backend,
            Self::View(arguments) => arguments.0.args.drawing.backend,
            Self::Doctor { .. } => return true,
            _ => return false,
        };
        backend != Backend::Cpu
    }
}

/// What the user said to `npr info`.
#[derive(Debug, Args)]
pub struct InfoArguments {
    /// Scene: .glb, .gltf, .vrm, .obj, .stl or .ply; or volume: .vdb or .npy; - reads standard input.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// As JSON.
    #[arg(long)]
    pub json: bool,
    /// A second folder that the scene may read files from, besides its own.
    #[arg(long, value_name = "DIR")]
    pub allow_external: Option<PathBuf>,
    /// Safety limits.
    #[command(flatten)]
    pub limits: LimitArguments,
}

/// What to do with styles.
#[derive(Debug, Subcommand)]
pub enum StylesCommand {
    /// List the presets.
    List,
    /// Print a preset as a style file, to start from.
    Show {
        /// Name of the preset, alone or with its version: ink, ink@1.
        name: String,
    },
    /// Check a style file; says line, column and the nearest valid key.
    Check {
        /// The style file.
        file: PathBuf,
    },
    /// Print the JSON Schema of style files, for editors.
    Schema,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn devices_are_opened_for_pictures_only_and_not_where_the_processor_draws() {
        let may_open = |line: &str| {
            let arguments = Arguments::try_parse_from(line.split(' ')).expect("a right line");
            arguments.command.may_open_device()
        };
        assert!(may_open("npr render a.glb") && may_open("npr doctor"));
        assert!(may_open("npr smoke plume --backend gpu"));
        assert!(!may_open("npr lines a.glb --backend cpu"));
        assert!(!may_open("npr trace a.png") && !may_open("npr info a.glb"));
    }

    #[test]
    fn commands_say_what_they_do() {
        let mut command = <Arguments as clap::CommandFactory>::command();
        command.build();
        for name in ["render", "lines", "animate", "smoke", "trace", "outline"] {
            let found = command.find_subcommand(name).expect("a command");
            let long = found.get_long_about().map(ToString::to_string);
            assert!(long.is_some_and(|text| text.contains("Without options, `npr ")));
            assert!(found.get_arguments().count() > 10);
        }
    }
}
