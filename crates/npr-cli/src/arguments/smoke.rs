//! The arguments of `npr smoke`.

use super::frames::frame_rate;
use super::{DrawingArguments, Frames};
use clap::Args;
use std::path::PathBuf;
use std::str::FromStr;

/// What the user said to `npr smoke`.
#[derive(Debug, Args)]
pub struct SmokeArguments {
    /// What smokes: plume, puff, explosion or cloud from the built-in simulation; a .vdb or .npy file; or a series of
    /// files such as smoke_####.vdb, where #### is the frame number.
    #[arg(required_unless_present = "dump_style")]
    pub source: Option<PathBuf>,
    /// Picture to write, .png; #### is the frame number where there are several; - writes to standard output
    /// [default: the source's name with .png, in the current folder].
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Frames to draw, the first and the last, or one [default: all of a series, else one that shows the smoke well].
    #[arg(long, value_name = "A..B")]
    pub frames: Option<Frames>,
    /// Frames from one picture to the next; 0.5 draws one between every two, as the motion goes. Pictures are
    /// numbered on from the first frame.
    #[arg(long, value_name = "FRAMES", default_value_t = crate::volume::DEFAULT_STEP, value_parser = step)]
    pub step: f64,
    /// Frames per second, of a simulation or of a series of files.
    #[arg(long, value_name = "N", default_value_t = crate::volume::DEFAULT_FPS, value_parser = frame_rate)]
    pub fps: f32,
    /// Cells of the simulation: width, depth and height, 4 or more each; 15x15x20 is that of the publication
    /// [default: by the source, 30x30x60 for plume].
    #[arg(long, value_name = "XxYxZ")]
    pub grid: Option<Grid>,
    /// The drawing.
    #[command(flatten)]
    pub drawing: DrawingArguments,
}

/// Size of a simulation: cells along x, y and z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Grid(pub [u32; 3]);

impl FromStr for Grid {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const EXPECTED: &str = "must be width, depth and height in cells, such as 15x15x20";
        let mut sides = text.split(['x', 'X']).map(|side| side.trim().parse().ok());
        let mut next = || sides.next().flatten().ok_or(EXPECTED);
        let grid = [next()?, next()?, next()?];
        if sides.next().is_some() {
            return Err(EXPECTED);
        }
        Ok(Self(grid))
    }
}

/// Parses the frames from one picture to the next, 0.001 to 1000000.
fn step(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(step) if (0.001..=1e6).contains(&step) => Ok(step),
        _ => Err("must be a number of frames from 0.001 to 1000000".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_three_sides() {
        assert_eq!("15x15X20".parse(), Ok(Grid([15, 15, 20])));
        for text in ["15x15", "1x2x3x4", "x", "1.5x2x3", "-1x2x3"] {
            assert!(text.parse::<Grid>().is_err(), "{text}");
        }
    }

    #[test]
    fn steps_and_rates_have_bounds() {
        assert_eq!(step("0.5"), Ok(0.5));
        assert_eq!(frame_rate("12"), Ok(12.0));
        for text in ["0", "-1", "nan", "inf", "fast"] {
            assert!(step(text).is_err() && frame_rate(text).is_err(), "{text}");
        }
    }
}
