//! The arguments of `npr animate`.

use super::frames::frame_rate;
use super::{CacheArguments, DrawingArguments, Frames, LineArguments, SheetArguments, Switch};
use clap::Args;
use std::path::PathBuf;

/// What the user said to `npr animate`.
#[derive(Debug, Args)]
pub struct AnimateArguments {
    /// Scene: .glb, .gltf, .vrm, .obj, .stl or .ply; or a volume of smoke: .vdb or .npy; - reads standard input.
    #[arg(required_unless_present = "dump_style")]
    pub scene: Option<PathBuf>,
    /// Film to write: frames as frame_####.png, .exr, .svg, .pdf or .json, where #### is the frame number; or all in
    /// one .gif, .apng, .mp4 or .webm, the last two by the program ffmpeg; - writes a single frame as .png to standard
    /// output [default: the scene's name with _####.png, in the current folder].
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Frames.
    #[command(flatten)]
    pub film: FilmArguments,
    /// Draw only the lines, as `npr lines` does; .svg, .pdf and .json always hold lines only.
    #[arg(long = "lines", id = "lines_only", help_heading = "Lines")]
    pub lines_only: bool,
    /// Which lines.
    #[command(flatten)]
    pub lines: LineArguments,
    /// What is written of them.
    #[command(flatten)]
    pub sheet: SheetArguments,
    /// The drawing.
    #[command(flatten)]
    pub drawing: DrawingArguments,
    /// What is kept.
    #[command(flatten)]
    pub cache: CacheArguments,
}

/// What the user said about the frames of a film, and about what moves in it.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(next_help_heading = "Film")]
pub struct FilmArguments {
    /// Frames to draw, the first and the last, or one; they count from 0. A frame is the same whichever others are
    /// drawn [default: the whole film].
    #[arg(long, value_name = "A..B")]
    pub frames: Option<Frames>,
    /// Frames of the whole film, of which --frames draws a part: over so many a turntable turns once [default: the
    /// frames that are drawn; of a turntable without --frames, those of 5 seconds].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub length: Option<u32>,
    /// Frames per second.
    #[arg(long, value_name = "N", default_value_t = crate::volume::DEFAULT_FPS, value_parser = frame_rate)]
    pub fps: f32,
    /// Turn the camera once around the target, counter-clockwise as seen from above; the last frame runs on into the
    /// first.
    #[arg(long)]
    pub turntable: bool,
    /// Turn the camera by so many degrees a frame, counter-clockwise as seen from above, or clockwise by less than 0.
    #[arg(
        long, value_name = "DEG", allow_hyphen_values = true, value_parser = orbit_angle,
        conflicts_with = "turntable"
    )]
    pub orbit: Option<f64>,
    /// Whether strokes hold to those of the frame before: their textures, dashes, ids and order stay. For a part of a
    /// film the strokes of all frames before it are found too; frames without strokes are not concerned.
    #[arg(long, value_enum, default_value_t)]
    pub hold: Switch,
    /// Skip frames whose files there are already, such as those of a run that was interrupted.
    #[arg(long)]
    pub resume: bool,
}

/// Parses an angle from frame to frame, up to 180 degrees.
fn orbit_angle(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(degrees) if degrees != 0.0 && degrees.abs() <= 180.0 => Ok(degrees),
        Ok(_) => Err("must lie between -180 and 180 degrees, and not be 0".to_owned()),
        Err(_) => Err("must be a number of degrees".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_orbit_moves() {
        assert_eq!(orbit_angle("-1.5"), Ok(-1.5));
        for text in ["0", "181", "nan", "inf", "round", ""] {
            assert!(orbit_angle(text).is_err(), "{text}");
        }
    }
}
