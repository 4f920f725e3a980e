//! The arguments of all commands that draw scenes.

use super::{CameraArguments, LimitArguments, LookArguments, PoseArguments, Size, VolumeArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What the user said about a drawing, of whichever sort.
#[derive(Debug, Clone, Args)]
pub struct DrawingArguments {
    /// Width and height in pixels, 32768 at most.
    // Reset the heading, which options flattened before this one may have set.
    #[arg(
        long, value_name = "WxH", default_value_t = Size { width: 1280, height: 720 }, help_heading = None
    )]
    pub size: Size,
    /// The camera.
    #[command(flatten)]
    pub camera: CameraArguments,
    /// The pose.
    #[command(flatten)]
    pub pose: PoseArguments,
    /// The style.
    #[command(flatten)]
    pub look: LookArguments,
    /// Smoke.
    #[command(flatten)]
    pub volumes: VolumeArguments,
    /// What draws.
    #[arg(long, value_enum, default_value_t = Backend::Auto, help_heading = "Work")]
    pub backend: Backend,
    /// Tell on standard error how long each step took.
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
