//! Films as GIF files: one palette for the whole film, so that nothing flickers that stands still.
//!
//! The colours are chosen when all frames are known. Until then frames wait, compressed without loss, in a file
//! without a name beside the film: memory does not grow with it.

use super::{Pixels, Whole};
use crate::colors::found_colors;
use crate::fault::{Exit, Fault};
use gif::{DisposalMethod, Encoder, Frame, Repeat};
use png::{ColorType, Compression, Decoder};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{self, BufReader, BufWriter, Cursor, Read, Seek, Write};

/// Most frames a second: browsers play faster films at a tenth of their pace.
pub const FASTEST_FPS: f32 = 50.0;

/// Colours of a palette beside the transparent one.
const MOST_COLORS: usize = 255;

/// Bits of a channel that tell colours apart where a film has more than a palette.
const BITS: u32 = 6;

/// How many pixels stand for those of a film of more colours, as its palette is chosen; a few more where it has many.
const SAMPLE: u64 = 1 << 20;

/// Hundredths of a second, the unit of delays.
const DELAYS_PER_SECOND: f64 = 100.0;

/// Refuses rates that browsers do not play.
pub fn check_rate(fps: f32) -> Result<(), Fault> {
    if fps <= FASTEST_FPS {
        return Ok(());
    }
    let message = format!(
        "--fps {fps}: browsers play .gif files of more than {FASTEST_FPS} frames a second slowly: write .apng or .mp4"
    );
    Err(Fault::new(Exit::Usage, message))
}

/// Writes a film that plays for ever. Pixels less than half opaque are transparent. Two frames are held at a time, and
/// 4 MiB of counts.
pub fn write(film: &Whole<'_>, frames: Pixels<'_>) -> Result<(), Fault> {
    // Put frames aside, and count their colours.
    let cannot_keep = |error: io::Error| film.output.cannot_write(error.into());
    let mut kept = BufWriter::new(film.output.scratch().map_err(cannot_keep)?);
    let mut census = Census::new();
    let mut count = 0;
    for rgba in frames {
        census.add(&rgba);
        keep(film.size, &rgba, &mut kept).map_err(cannot_keep)?;
        count += 1;
    }
    let kept = kept.into_inner().map_err(io::IntoInnerError::into_error);
    let mut kept = kept.map_err(cannot_keep)?;
    kept.rewind()?;

    // Choose the palette, and write all frames in it.
    let sees_through = census.sees_through;
    let palette = census.palette()?;
    film.output.write_with(|sink| {
        film.check_whole(count)?;
        let mut writer = Writer::new(film, &palette, sees_through, BufWriter::new(sink))?;
        let mut kept = BufReader::new(kept);
        for _ in 0..count {
            writer.write(&take_back(&mut kept)?)?;
        }
        writer.finish()
    })
}

/// Writes a frame as a small PNG file after its length.
fn keep([width, height]: [u32; 2], rgba: &[u8], sink: &mut impl Write) -> io::Result<()> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(ColorType::Rgba);
    encoder.set_compression(Compression::Fastest);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgba)?;
    writer.finish()?;
    sink.write_all(&(file.len() as u64).to_le_bytes())?;
    sink.write_all(&file)
}

/// The pixels of the next frame that was put aside.
fn take_back(kept: &mut impl Read) -> io::Result<Vec<u8>> {
    let mut length = [0; 8];
    kept.read_exact(&mut length)?;
    let mut file = vec![0; u64::from_le_bytes(length) as usize];
    kept.read_exact(&mut file)?;
    let mut reader = Decoder::new(Cursor::new(file)).read_info()?;
    let mut rgba = vec![0; reader.output_buffer_size().unwrap_or(0)];
    reader.next_frame(&mut rgba)?;
    Ok(rgba)
}

/// The colours of a film, counted.
struct Census {
    /// All of them, while they fit into a palette.
    own: Option<BTreeSet<[u8; 3]>>,
    /// Those that agree in the upper bits of every channel, together.
    bins: Vec<Bin>,
    /// Whether any pixel is transparent.
    sees_through: bool,
}

/// Colours that are nearly the same.
#[derive(Debug, Clone, Copy, Default)]
struct Bin {
    /// Number of their pixels.
    count: u64,
    /// The colour of more than half of the pixels, where there is one; else one of the colours.
    color: [u8; 3],
    /// How many pixels of this colour no other pixel has been set against [Boyer and Moore 1991].
    votes: u64,
}

impl Bin {
    fn add(&mut self, color: [u8; 3], count: u64) {
        self.count += count;
        if self.color == color {
            self.votes += count;
        } else if self.votes >= count {
            self.votes -= count;
        } else {
            (self.color, self.votes) = (color, count - self.votes);
        }
    }
}

/// The bin of a colour.
fn bin_of(color: [u8; 3]) -> usize {
    let [r, g, b] = color.map(|channel| usize::from(channel >> (8 - BITS)));
    (r << (2 * BITS)) | (g << BITS) | b
}

/// The colour of a pixel, none where it is transparent.
fn color_of(&[r, g, b, a]: &[u8; 4]) -> Option<[u8; 3]> {
    (a >= 128).then_some([r, g, b])
}

impl Census {
    fn new() -> Self {
        Self {
            own: Some(BTreeSet::new()),
            bins: vec![Bin::default(); 1 << (3 * BITS)],
            sees_through: false,
        }
    }

    /// Counts the pixels of a frame.
    fn add(&mut self, rgba: &[u8]) {
        let (pixels, _) = rgba.as_chunks::<4>();
        for run in pixels.chunk_by(|a, b| a == b) {
            let Some(color) = color_of(&run[0]) else {
                self.sees_through = true;
                continue;
            };
            self.bins[bin_of(color)].add(color, run.len() as u64);
            let own = self.own.take();
            self.own = own.and_then(|mut own| {
                own.insert(color);
                (own.len() <= MOST_COLORS).then_some(own)
            });
        }
    }

    /// The palette of the film: its own colours, or else such as the method of [Wu 1991] chooses among the bins. A
    /// chosen colour is exactly that of most of its pixels, where most have one: paper stays paper.
    fn palette(self) -> Result<Palette, Fault> {
        if let Some(own) = self.own {
            return Ok(Palette {
                colors: own.into_iter().collect(),
                of_bins: None,
            });
        }

        // Let pixels stand for the bins, at least one for each.
        let total: u64 = self.bins.iter().map(|bin| bin.count).sum();
        let filled = self
            .bins
            .iter()
            .enumerate()
            .filter(|(_, bin)| bin.count > 0);
        let mut pixels = Vec::new();
        let mut starts = Vec::new();
        for (number, bin) in filled {
            let share = u128::from(bin.count) * u128::from(SAMPLE) / u128::from(total.max(1));
            starts.push((number, pixels.len()));
            pixels.extend(std::iter::repeat_n(bin.color, (share as usize).max(1)));
        }
        let (mut colors, numbers) = found_colors(&pixels, MOST_COLORS as u16)?;

        // Number the bins, and prefer colours that many pixels have.
        let mut of_bins = vec![0; self.bins.len()];
        let mut sums = vec![(0, Bin::default()); colors.len()];
        for (bin, start) in starts {
            of_bins[bin] = numbers[start];
            let (sum, largest) = &mut sums[usize::from(numbers[start])];
            *sum += self.bins[bin].count;
            if self.bins[bin].count > largest.count {
                *largest = self.bins[bin];
            }
        }
        for (color, (sum, largest)) in colors.iter_mut().zip(sums) {
            if 2 * largest.count > sum {
                *color = largest.color;
            }
        }
        Ok(Palette {
            colors,
            of_bins: Some(of_bins),
        })
    }
}

/// The colours of a film.
struct Palette {
    /// At most `MOST_COLORS`; sorted where they are the film's own.
    colors: Vec<[u8; 3]>,
    /// For every bin the number of its colour; none where the colours are the film's own.
    of_bins: Option<Vec<u8>>,
}

impl Palette {
    /// The number of transparent pixels.
    fn transparent(&self) -> u8 {
        self.colors.len() as u8
    }

    /// The numbers of the colours of a frame.
    fn numbers(&self, rgba: &[u8]) -> Vec<u8> {
        let (pixels, _) = rgba.as_chunks::<4>();
        let number = |pixel: &[u8; 4]| match (color_of(pixel), &self.of_bins) {
            (None, _) => self.transparent(),
            (Some(color), Some(of_bins)) => of_bins[bin_of(color)],
            (Some(color), None) => self.colors.binary_search(&color).unwrap_or(0) as u8,
        };
        let runs = pixels.chunk_by(|a, b| a == b);
        runs.flat_map(|run| std::iter::repeat_n(number(&run[0]), run.len()))
            .collect()
    }
}

/// A film that is being written.
struct Writer<'a, W: Write> {
    encoder: Encoder<W>,
    palette: &'a Palette,
    size: [usize; 2],
    fps: f64,
    /// Whether frames are whole and replace those before them; else they hold what changes.
    sees_through: bool,
    /// The colours of the frame before.
    before: Option<Vec<u8>>,
    /// Number of frames that are written.
    count: u32,
}

impl<'a, W: Write> Writer<'a, W> {
    fn new(
        film: &Whole<'_>,
        palette: &'a Palette,
        sees_through: bool,
        sink: W,
    ) -> io::Result<Self> {
        let mut colors = palette.colors.concat();
        // The transparent one.
        colors.extend([0; 3]);
        let [width, height] = film.size.map(|side| side as u16);
        let mut encoder = Encoder::new(sink, width, height, &colors).map_err(io::Error::other)?;
        encoder
            .set_repeat(Repeat::Infinite)
            .map_err(io::Error::other)?;
        Ok(Self {
            encoder,
            palette,
            size: film.size.map(|side| side as usize),
            fps: f64::from(film.fps),
            sees_through,
            before: None,
            count: 0,
        })
    }

    fn write(&mut self, rgba: &[u8]) -> io::Result<()> {
        let numbers = self.palette.numbers(rgba);
        let area = match &self.before {
            Some(before) if !self.sees_through => changed(before, &numbers, self.size[0]),
            _ => Area {
                low: [0; 2],
                high: self.size,
            },
        };
        let [width, height] = [0, 1].map(|i| area.high[i] - area.low[i]);
        let frame = Frame {
            delay: self.delay(),
            dispose: match self.sees_through {
                true => DisposalMethod::Background,
                false => DisposalMethod::Keep,
            },
            transparent: Some(self.palette.transparent()),
            left: area.low[0] as u16,
            top: area.low[1] as u16,
            width: width as u16,
            height: height as u16,
            buffer: Cow::Owned(self.inside(&numbers, &area)),
            ..Frame::default()
        };
        self.encoder
            .write_frame(&frame)
            .map_err(|error| match error {
                gif::EncodingError::Io(error) => error,
                error => io::Error::other(error),
            })?;
        self.before = Some(numbers);
        self.count += 1;
        Ok(())
    }

    /// What a frame holds of an area: its colours, transparent where the frame before has the same.
    fn inside(&self, numbers: &[u8], area: &Area) -> Vec<u8> {
        let mut held = Vec::new();
        for y in area.low[1]..area.high[1] {
            let row = y * self.size[0];
            let range = row + area.low[0]..row + area.high[0];
            let same = self.before.as_ref().filter(|_| !self.sees_through);
            match same {
                None => held.extend_from_slice(&numbers[range]),
                Some(before) => {
                    let pairs = numbers[range.clone()].iter().zip(&before[range]);
                    held.extend(pairs.map(|(now, before)| match now == before {
                        true => self.palette.transparent(),
                        false => *now,
                    }));
                }
            }
        }
        held
    }

    /// How long the next frame lasts: frames begin at the hundredth of a second that is nearest to their time.
    fn delay(&self) -> u16 {
        let begins = |frame: u32| (f64::from(frame) * DELAYS_PER_SECOND / self.fps).round();
        (begins(self.count + 1) - begins(self.count)) as u16
    }

    fn finish(self) -> io::Result<()> {
        let mut sink = self.encoder.into_inner().map_err(io::Error::other)?;
        sink.flush()
    }
}

/// A rectangle of pixels: columns and rows from `low` to before `high`.
struct Area {
    low: [usize; 2],
    high: [usize; 2],
}

/// The least area outside of which two frames are the same; one pixel where they are the same all over.
fn changed(before: &[u8], now: &[u8], width: usize) -> Area {
    let mut area = Area {
        low: [usize::MAX; 2],
        high: [0; 2],
    };
    let rows = before.chunks(width).zip(now.chunks(width)).enumerate();
    for (y, (before, now)) in rows.filter(|(_, (before, now))| before != now) {
        let mut differ = before.iter().zip(now).map(|(before, now)| before != now);
        let first = differ.clone().position(|differs| differs).unwrap_or(0);
        let last = differ.rposition(|differs| differs).unwrap_or(0);
        area.low = [area.low[0].min(first), area.low[1].min(y)];
        area.high = [area.high[0].max(last + 1), y + 1];
    }
    match area.high {
        [0, 0] => Area {
            low: [0; 2],
            high: [1; 2],
        },
        _ => area,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_colours_stay_as_they_are() {
        let rgba: Vec<u8> = (0..=254).flat_map(|i| [i, 255 - i, i / 2, 255]).collect();
        let mut census = Census::new();
        census.add(&rgba);
        let palette = census.palette().expect("colours");
        let shown = palette
            .numbers(&rgba)
            .into_iter()
            .map(|number| palette.colors[usize::from(number)]);
        let wanted = rgba.as_chunks::<4>().0.iter().filter_map(color_of);
        assert!(shown.eq(wanted));
    }

    #[test]
    fn of_many_colours_paper_stays_paper_and_no_other_goes_far() {
        // Paper of a colour among a slope of many.
        let paper = [201, 103, 128];
        let slope = (0..=255_u8).flat_map(|i| (0..64_u8).map(move |j| [i, j * 4, 128]));
        let colors: Vec<[u8; 3]> = std::iter::repeat_n(paper, 400).chain(slope).collect();
        let rgba: Vec<u8> = colors
            .iter()
            .flat_map(|[r, g, b]| [*r, *g, *b, 255])
            .collect();
        let mut census = Census::new();
        census.add(&rgba);
        let palette = census.palette().expect("colours");
        assert!(palette.colors.contains(&paper) && palette.colors.len() <= MOST_COLORS);
        // The method measures as the eye does, to which dark colours look more alike than their numbers.
        let (mut sum, mut most) = (0, 0);
        for (color, number) in colors.iter().zip(palette.numbers(&rgba)) {
            let shown = palette.colors[usize::from(number)];
            for (wanted, shown) in color.iter().zip(shown) {
                let off = u64::from(wanted.abs_diff(shown));
                (sum, most) = (sum + off, most.max(off));
            }
        }
        let mean = sum as f64 / (256 * 64 * 3) as f64;
        assert!(mean < 5.0 && most < 64, "{mean} of 255, {most} at most");
    }

    #[test]
    fn what_changes_is_found_to_the_pixel() {
        let before = [0; 12];
        let mut now = before;
        (now[5], now[10]) = (1, 1);
        let area = changed(&before, &now, 4);
        assert_eq!((area.low, area.high), ([1, 1], [3, 3]));
        let same = changed(&before, &before, 4);
        assert_eq!((same.low, same.high), ([0, 0], [1, 1]));
    }
}
