//! The files of a film: a picture for every frame, or all frames in one file.

mod apng;
mod gif;
mod video;

pub use gif::check_rate;
pub use video::Codec;

use crate::arguments::Frames;
use crate::encoder;
use crate::fault::{Exit, Fault};
use crate::layers;
use crate::output::Output;
use crate::target::Target;
use npr_render::Frame;
use std::collections::BTreeMap;
use std::io;

/// What was drawn of a frame.
#[derive(Debug)]
pub enum Shown {
    /// Its pixels, and its layers where the format has some.
    Pixels(Frame),
    /// Its file.
    File(Vec<u8>),
}

/// The files of a film.
pub enum Reel<'a> {
    /// A file for every frame.
    Stills(Stills<'a>),
    /// One file.
    Whole(Whole<'a>),
}

/// A film with a file for every frame.
pub struct Stills<'a> {
    /// Where the frames go.
    pub target: &'a Target,
    /// Their numbers, in rising order.
    pub numbers: Vec<u32>,
    /// Their format.
    pub encoding: Encoding<'a>,
}

/// How frames become files.
pub enum Encoding<'a> {
    /// PNG; whether transparency is kept where a frame has none.
    Png {
        /// Whether files always have an alpha channel.
        keep_alpha: bool,
    },
    /// OpenEXR, with the names of objects.
    Exr(BTreeMap<u32, &'a str>),
}

/// A film in one file.
#[derive(Debug, Clone, Copy)]
pub struct Whole<'a> {
    /// Where it goes.
    pub output: &'a Output,
    /// Its format.
    pub format: FilmFormat,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Number of frames.
    pub count: u32,
    /// Frames per second.
    pub fps: f32,
    /// Whether it may be transparent.
    pub keep_alpha: bool,
}

/// The format of a film in one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmFormat {
    /// 256 colours, plays everywhere.
    Gif,
    /// PNG with all frames, without loss.
    Apng,
    /// What ffmpeg encodes.
    Video(Codec),
}

/// Most frames that one run draws: so many are 11 hours at 24 a second, and their numbers take 4 MB.
const FRAMES_LIMIT: u64 = 1_000_000;

/// Refuses more frames than one run may draw.
pub fn check_frames(frames: Frames) -> Result<(), Fault> {
    let count = u64::from(frames.last - frames.first) + 1;
    if count <= FRAMES_LIMIT {
        return Ok(());
    }
    let message = format!(
        "{count} frames exceed the limit of {FRAMES_LIMIT} a run; --frames draws a part of a film"
    );
    Err(Fault::new(Exit::Limit, message))
}

impl Reel<'_> {
    /// Number of frames that are written.
    pub fn count(&self) -> usize {
        match self {
            Self::Stills(stills) => stills.numbers.len(),
            Self::Whole(whole) => whole.count as usize,
        }
    }

    /// Writes frames as they come. A film in one file that ends before its last frame leaves no file.
    pub fn write(self, frames: &mut dyn Iterator<Item = Shown>) -> Result<(), Fault> {
        match self {
            Self::Stills(stills) => stills.write(frames),
            Self::Whole(whole) => whole.write(&mut frames.filter_map(|shown| match shown {
                Shown::Pixels(frame) => Some(frame.rgba),
                Shown::File(_) => None,
            })),
        }
    }
}

impl Stills<'_> {
    fn write(self, frames: &mut dyn Iterator<Item = Shown>) -> Result<(), Fault> {
        for (number, shown) in self.numbers.iter().zip(frames) {
            let bytes = match shown {
                Shown::File(bytes) => bytes,
                Shown::Pixels(frame) => self.encoding.file(frame)?,
            };
            self.target.output(*number)?.write(&bytes)?;
        }
        Ok(())
    }
}

impl Encoding<'_> {
    fn file(&self, mut frame: Frame) -> Result<Vec<u8>, Fault> {
        match self {
            Self::Png { keep_alpha } => encoder::png(frame.size, &frame.rgba, *keep_alpha),
            Self::Exr(names) => layers::exr(&mut frame, names),
        }
    }
}

/// The pixels of frames: sRGB bytes with straight alpha, row by row from the top.
type Pixels<'a> = &'a mut dyn Iterator<Item = Vec<u8>>;

impl Whole<'_> {
    fn write(&self, frames: Pixels<'_>) -> Result<(), Fault> {
        match self.format {
            FilmFormat::Gif => gif::write(self, frames),
            FilmFormat::Apng => apng::write(self, frames),
            FilmFormat::Video(codec) => video::write(self, codec, frames),
        }
    }

    /// Fails where a film of `count` frames ended early, so that no file of it stays.
    fn check_whole(&self, count: u32) -> io::Result<()> {
        match count == self.count {
            true => Ok(()),
            false => Err(io::Error::other("the film is not whole")),
        }
    }
}
