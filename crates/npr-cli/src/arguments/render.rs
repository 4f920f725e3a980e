//! The arguments of `npr render`.

use super::{CacheArguments, DrawingArguments};
use crate::debug_layer::DebugLayer;
use clap::Args;
use std::path::PathBuf;

/// What the user said to `npr render`.
#[derive(Debug, Args)]
pub struct RenderArguments {
    /// Scene: .glb, .gltf, .vrm, .obj, .stl or .ply; or a volume of smoke: .vdb or .npy; - reads standard input.
    #[arg(required_unless_present_any = ["dump_style", "debug_layer"])]
    pub scene: Option<PathBuf>,
    /// Picture to write: .png; .exr with layers for compositing: beauty, line, depth, normal, object and line id, line
    /// depth; or .svg where the style is lines only; - writes a .png to standard output [default: the scene's name with
    /// .png, in the current folder].
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Draw the picture N times as large as --size, 1 to 16, with the strokes of that size: what was tried small comes
    /// out as the same drawing in print. Of methods strokes and potrace.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=16))]
    pub enlarge: u32,
    /// Show a layer in place of the picture, to see what it is made of; list names them.
    #[arg(long, value_name = "NAME")]
    pub debug_layer: Option<DebugLayer>,
    /// The drawing.
    #[command(flatten)]
    pub drawing: DrawingArguments,
    /// What is kept.
    #[command(flatten)]
    pub cache: CacheArguments,
}
