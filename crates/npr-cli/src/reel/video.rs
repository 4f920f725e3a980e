//! Films that the program ffmpeg encodes: frames go to it through a pipe.

use super::{Pixels, Whole};
use crate::fault::{Exit, Fault};
use crate::interrupt;
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, ErrorKind, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// The program, found as the system finds programs.
const PROGRAM: &str = "ffmpeg";

/// How colours are stored: as brightness and difference of Rec. 709, in the range of television, from sRGB.
const COLORS: &str = "scale=out_color_matrix=bt709:out_range=tv,\
                      setparams=colorspace=bt709:color_primaries=bt709:color_trc=iec61966-2-1:range=tv";

/// Most lines of its messages that are told, the last ones.
const TOLD_LINES: usize = 3;

/// Time between two looks whether it has ended.
const PATIENCE: Duration = Duration::from_millis(5);

/// A format that it writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Codec {
    /// H.264 in an MP4 file.
    Mp4,
    /// VP9 in a WebM file, which may be transparent.
    WebM,
}

impl Codec {
    /// Refuses what the format cannot hold: sides of an odd number of pixels, and transparency, which `keep_alpha`
    /// asks for; and fails where the program is missing.
    pub fn check(self, [width, height]: [u32; 2], keep_alpha: bool) -> Result<(), Fault> {
        if self == Self::Mp4 && (width % 2 == 1 || height % 2 == 1) {
            let (even_width, even_height) = (width + width % 2, height + height % 2);
            let message = format!(
                ".mp4 needs even sides, and {width}x{height} has not: say --size {even_width}x{even_height}"
            );
            return Err(Fault::new(Exit::Usage, message));
        }
        if self == Self::Mp4 && keep_alpha {
            let message = ".mp4 has no transparency: give a --background, or write .webm or .apng";
            return Err(Fault::new(Exit::Usage, message));
        }
        let asked = Command::new(PROGRAM)
            .arg("-version")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status();
        match asked {
            Ok(_) => Ok(()),
            Err(error) => Err(cannot_start(&error)),
        }
    }

    /// The arguments about the encoding.
    fn arguments(self, keep_alpha: bool) -> Vec<&'static str> {
        let pixels = match keep_alpha {
            true => "yuva420p",
            false => "yuv420p",
        };
        let coded = match self {
            Self::Mp4 => "-c:v libx264 -preset medium -crf 18 -movflags +faststart -f mp4",
            Self::WebM => "-c:v libvpx-vp9 -b:v 0 -crf 24 -row-mt 1 -f webm",
        };
        ["-pix_fmt", pixels]
            .into_iter()
            .chain(coded.split(' '))
            .collect()
    }
}

fn cannot_start(error: &std::io::Error) -> Fault {
    let message = match error.kind() {
        ErrorKind::NotFound => {
            "there is no program ffmpeg, which writes .mp4 and .webm: install it, \
             or write .gif, .apng or frame_####.png"
                .to_owned()
        }
        _ => format!("cannot start ffmpeg: {error}"),
    };
    Fault::new(Exit::Failed, message)
}

/// Hands frames to ffmpeg, which writes the film. A frame is held at a time.
pub fn write(film: &Whole<'_>, codec: Codec, frames: Pixels<'_>) -> Result<(), Fault> {
    film.output.write_by(|path| {
        // Start it, where an interrupt finds it and ends it.
        let mut child = started(film, codec, path)?;
        let (pipe, complaints) = (child.stdin.take(), child.stderr.take());
        let reading = complaints.map(|complaints| thread::spawn(move || last_lines(complaints)));
        *interrupt::helper() = Some(child);

        // Give it the frames. It breaks the pipe where it fails.
        let mut count = 0;
        if let Some(mut pipe) = pipe {
            for rgba in frames {
                if pipe.write_all(&rgba).is_err() {
                    break;
                }
                count += 1;
            }
        }

        // Wait until it is done; it ended early where the film did.
        let whole = film.check_whole(count);
        let status = waited()?;
        let said = reading.map_or(Ok(String::new()), JoinHandle::join);
        check_status(status, &said.unwrap_or_default())?;
        Ok(whole?)
    })
}

fn started(film: &Whole<'_>, codec: Codec, path: &Path) -> Result<Child, Fault> {
    let [width, height] = film.size;
    let mut command = Command::new(PROGRAM);
    command
        .args(["-hide_banner", "-loglevel", "error", "-y"])
        .args(["-f", "rawvideo", "-pixel_format", "rgba"])
        .args(["-video_size", &format!("{width}x{height}")])
        .args(["-framerate", &film.fps.to_string(), "-i", "pipe:0", "-an"])
        // Say how colours become brightness, which players otherwise guess by the size.
        .args(["-vf", COLORS])
        .args(codec.arguments(film.keep_alpha))
        // Without its own version and the time, the same frames give the same file.
        .args(["-map_metadata", "-1", "-fflags", "+bitexact"])
        .args(["-flags:v", "+bitexact"])
        .arg(path)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    command.spawn().map_err(|error| cannot_start(&error))
}

/// Waits for the program without keeping an interrupt from ending it.
fn waited() -> Result<ExitStatus, Fault> {
    loop {
        let mut helper = interrupt::helper();
        let Some(child) = helper.as_mut() else {
            return Err(Fault::new(Exit::Failed, "ffmpeg is gone"));
        };
        if let Some(status) = child.try_wait()? {
            *helper = None;
            return Ok(status);
        }
        drop(helper);
        thread::sleep(PATIENCE);
    }
}

fn check_status(status: ExitStatus, said: &str) -> Result<(), Fault> {
    if status.success() {
        return Ok(());
    }
    let reason = match said {
        "" => format!("it ended with {status}"),
        said => said.to_owned(),
    };
    Err(Fault::new(Exit::Failed, format!("ffmpeg failed: {reason}")))
}

/// The last lines of its messages, in one.
fn last_lines(complaints: impl Read) -> String {
    let mut lines = VecDeque::new();
    let mut complaints = BufReader::new(complaints);
    let mut line = Vec::new();
    while complaints
        .read_until(b'\n', &mut line)
        .is_ok_and(|read| read > 0)
    {
        let text = String::from_utf8_lossy(&line).trim().to_owned();
        line.clear();
        if !text.is_empty() {
            lines.push_back(text);
        }
        if lines.len() > TOLD_LINES {
            lines.pop_front();
        }
    }
    Vec::from(lines).join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_lines_are_told_in_one() {
        let said = "one\ntwo\n\nthree\r\nfour\n";
        assert_eq!(last_lines(said.as_bytes()), "two; three; four");
        assert_eq!(last_lines(&b""[..]), "");
    }

    #[test]
    fn odd_sides_and_transparency_are_refused_for_mp4() {
        let fault = |size, alpha| Codec::Mp4.check(size, alpha).expect_err("refused");
        assert!(fault([639, 360], false).message.contains("640x360"));
        assert!(fault([640, 360], true).message.contains(".webm"));
    }
}
