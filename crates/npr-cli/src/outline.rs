//! `npr outline`: outlines a figure before a background, by the published method on two pictures.

use crate::arguments::{Behind, OutlineArguments};
use crate::encoder::png;
use crate::fault::{Exit, Fault};
use crate::input::{read_file, read_standard};
use crate::job::check_ending;
use crate::message;
use crate::message::quoted;
use crate::output::Output;
use crate::picture;
use crate::progress::Progress;
use crate::source::Source;
use npr_core::budget::Budget;
use npr_render::{Picture, RenderError};
use npr_scene::Limits;
use npr_style::backdrop::published;
use std::path::PathBuf;

/// Memory for a pixel while it is drawn, in bytes: three colours of four floats, the colour of its line, and four
/// bytes for each of three pictures.
const PIXEL_BYTES: usize = 3 * 16 + 16 + 12;

/// Outlines the figure that the user named before its background.
pub fn outline(args: &OutlineArguments) -> Result<(), Fault> {
    // Check all that can be known before anything is read.
    check_ending(&args.output)?;
    let output = Output::of(&args.output)?;
    let sources = Sources::of(args)?;
    output.refuse_any_of(&sources.inputs())?;

    // Read both pictures, and check that they have the same size.
    let limits = args.limits.limits();
    let mut progress = Progress::new(args.quiet);
    let figure = progress.step("load", || load(&sources.figure, &limits))?;
    let size = figure.size;
    let background = match &sources.behind {
        Ground::Color(color) => vec![*color; figure.rgba.len() / 4],
        Ground::Picture(source) => {
            let background = progress.step("load", || load(source, &limits))?;
            check_sizes(size, background.size)?;
            colors(&background)
        }
    };
    let mut budget = Budget::new(limits.memory_bytes);
    let planned = budget.take("the outline", background.len(), PIXEL_BYTES);
    planned.map_err(|error| Fault::from(RenderError::from(error)))?;

    // Draw and write.
    let drawn = progress.step("outline", || {
        let (line, rule) = (args.color.srgb(), args.rule.rule());
        published::draw(size, &colors(&figure), &background, line, &rule)
    });
    let (drawn, count) = drawn.ok_or_else(|| Fault::new(Exit::Failed, "the pictures differ"))?;
    if count == 0 {
        let text = "there is no outline: nothing in the picture is both opaque and beside something transparent";
        progress.suspend(|| message::warn(args.quiet, text));
    }
    let bytes = png(size, &bytes(&drawn), false)?;
    progress.step("write", || output.write(&bytes))?;
    progress.finish();
    Ok(())
}

/// The sources of the figure and of what lies behind it.
struct Sources {
    figure: Source,
    behind: Ground,
}

/// What lies behind the figure.
enum Ground {
    /// One colour, sRGB-encoded with alpha.
    Color([f32; 4]),
    Picture(Source),
}

impl Sources {
    fn of(args: &OutlineArguments) -> Result<Self, Fault> {
        let figure = Source::of(&args.picture);
        let behind = match &args.background {
            Behind::Color(color) => Ground::Color(color.srgb()),
            Behind::Picture(path) => Ground::Picture(Source::of(path)),
        };
        if figure == Source::Standard && matches!(&behind, Ground::Picture(Source::Standard)) {
            let message = "standard input can be read only once";
            return Err(Fault::new(Exit::Usage, message));
        }
        Ok(Self { figure, behind })
    }

    /// The paths of the sources that are files.
    fn inputs(&self) -> Vec<PathBuf> {
        let behind = match &self.behind {
            Ground::Color(_) => None,
            Ground::Picture(source) => Some(source),
        };
        let sources = [Some(&self.figure), behind].into_iter().flatten();
        let path = |source: &Source| match source {
            Source::Standard => None,
            Source::File(path) => Some(path.clone()),
        };
        sources.filter_map(path).collect()
    }
}

fn load(source: &Source, limits: &Limits) -> Result<Picture, Fault> {
    let (name, bytes) = match source {
        Source::Standard => (
            "standard input".to_owned(),
            read_standard(limits.file_bytes)?,
        ),
        Source::File(path) => (quoted(path), read_file(path, limits.file_bytes)?),
    };
    let picture = picture::decode_any(&bytes, limits);
    picture.map_err(|fault| fault.while_doing(format_args!("cannot read {name}")))
}

fn check_sizes(size: [u32; 2], behind: [u32; 2]) -> Result<(), Fault> {
    if behind == size {
        return Ok(());
    }
    let [width, height] = size;
    let message = format!(
        "the picture has {width}x{height} pixels and its background {}x{}: they are compared one to one",
        behind[0], behind[1]
    );
    Err(Fault::new(Exit::Input, message))
}

/// The pixels of a picture, 0..1, sRGB-encoded with straight alpha.
fn colors(picture: &Picture) -> Vec<[f32; 4]> {
    let (pixels, _) = picture.rgba.as_chunks::<4>();
    let color = |pixel: &[u8; 4]| pixel.map(|byte| f32::from(byte) / 255.0);
    pixels.iter().map(color).collect()
}

/// The pixels as sRGB bytes with straight alpha.
fn bytes(pixels: &[[f32; 4]]) -> Vec<u8> {
    let byte = |channel: &f32| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    pixels.iter().flatten().map(byte).collect()
}
