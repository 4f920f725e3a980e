//! What the user said to `npr render`.

use super::{CameraArguments, LimitArguments, Size};
use clap::{Args, ValueEnum};
use npr_style::Background;
use std::path::PathBuf;

/// What the user said to `npr render`.
#[derive(Debug, Args)]
pub struct RenderArguments {
    /// Scene: .glb, .gltf, .vrm, .obj, .stl or .ply; - reads standard input.
    #[arg(required_unless_present = "dump_style")]
    pub scene: Option<PathBuf>,
    /// Picture to write, .png, or .svg where the style is lines only; - writes a .png to standard output
    /// [default: the scene's name with .png, in the current folder].
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Width and height in pixels, 32768 at most.
    #[arg(long, value_name = "WxH", default_value_t = Size { width: 1280, height: 720 })]
    pub size: Size,
    /// The camera.
    #[command(flatten)]
    pub camera: CameraArguments,
    /// The style.
    #[command(flatten)]
    pub look: LookArguments,
    /// What draws.
    #[arg(long, value_enum, default_value_t = Backend::Auto, help_heading = "Work")]
    pub backend: Backend,
    /// Tell on standard error how long each pass took.
    #[arg(
        long, value_enum, value_name = "FORM", num_args = 0..=1, default_missing_value = "table",
        help_heading = "Work"
    )]
    pub timings: Option<TimingsForm>,
    /// No warnings and no progress.
    #[arg(short, long, help_heading = "Work")]
    pub quiet: bool,
    /// A second folder that the scene and the style may read files from, besides their own.
    #[arg(long, value_name = "DIR", help_heading = "Safety limits")]
    pub allow_external: Option<PathBuf>,
    /// Safety limits.
    #[command(flatten)]
    pub limits: LimitArguments,
}

/// What the user said about the style.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Style")]
pub struct LookArguments {
    /// A preset, alone or with its version, or a style file [default: toon].
    #[arg(long, value_name = "NAME|FILE.toml")]
    pub style: Option<String>,
    /// Override one value of the style; repeatable, later ones win.
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    /// What shows where no surface is: a CSS colour, `transparent`, or a .png or .jpg image.
    #[arg(long, value_name = "COLOUR|IMAGE", value_parser = background)]
    pub background: Option<Background>,
    /// Print the style as it comes out, with every value, and draw nothing.
    #[arg(long)]
    pub dump_style: bool,
}

/// What draws a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Backend {
    /// A hardware graphics device where there is one, else the processor.
    Auto,
    /// The processor.
    Cpu,
    /// The best graphics device, software ones included.
    Gpu,
}

/// How times are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TimingsForm {
    /// Lines for people.
    Table,
    /// One line for programs.
    Json,
}

fn background(text: &str) -> Result<Background, String> {
    text.parse()
        .map_err(|error: npr_style::BackgroundError| format!("it {error}"))
}
