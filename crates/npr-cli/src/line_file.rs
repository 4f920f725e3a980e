//! Encodes a line drawing in the format of its file.

use crate::arguments::LineFormat;
use crate::encoder;
use crate::fault::{Exit, Fault};
use crate::line_job::LineJob;
use npr_core::budget::Budget;
use npr_drawing::artwork::{ArtworkOptions, STAMPS_LIMIT, StrokeBrushes, stamp_count};
use npr_drawing::drawing::rasterise;
use npr_drawing::json::write_json;
use npr_drawing::lettering::Lettered;
use npr_drawing::pdf::write_pdf;
use npr_drawing::svg::write_svg;
use npr_render::{Drawing, Frame, RenderError};

/// Memory for a pixel of a PNG file, in bytes: canvas, picture and file together.
const BYTES_PER_PIXEL: usize = 12;

/// What a file has beside its lines.
pub struct Ink {
    /// The brushes that draw the lines.
    pub brushes: StrokeBrushes,
    /// Words over them.
    pub lettering: Vec<Lettered>,
}

/// The bytes of the file that a job asks for.
pub fn encode(job: &LineJob<'_>, drawing: &Drawing, ink: Ink) -> Result<Vec<u8>, Fault> {
    match job.format {
        LineFormat::Svg => Ok(write_svg(drawing, &artwork(job, drawing, ink)?)),
        LineFormat::Json => Ok(write_json(drawing)),
        LineFormat::Pdf => Ok(write_pdf(drawing, &artwork(job, drawing, ink)?)),
        LineFormat::Png => {
            let frame = pixels(job, drawing, ink)?;
            encoder::png(frame.size, &frame.rgba, job.look.is_transparent())
        }
    }
}

/// The drawing as pixels.
pub fn pixels(job: &LineJob<'_>, drawing: &Drawing, ink: Ink) -> Result<Frame, Fault> {
    let rgba = rasterise(drawing, &artwork(job, drawing, ink)?);
    if rgba.is_empty() {
        return Err(Fault::new(
            Exit::Failed,
            "the picture is too large for memory",
        ));
    }
    Ok(Frame {
        size: drawing.size,
        rgba,
        ..Frame::default()
    })
}

/// The options of the file with its ink.
fn artwork(job: &LineJob<'_>, drawing: &Drawing, ink: Ink) -> Result<ArtworkOptions, Fault> {
    let Ink { brushes, lettering } = ink;
    if stamp_count(drawing, &brushes) > STAMPS_LIMIT {
        let error = RenderError::TooMany {
            what: "stamps of brushes",
            limit: STAMPS_LIMIT,
        };
        return Err(error.into());
    }
    Ok(ArtworkOptions {
        lettering,
        brushes,
        ..job.artwork.clone()
    })
}

/// Refuses a picture that exceeds the memory limit.
pub fn check_memory(job: &LineJob<'_>) -> Result<(), Fault> {
    if job.format != LineFormat::Png {
        return Ok(());
    }
    let [width, height] = job.options.size.map(|side| side as usize);
    let mut budget = Budget::new(job.limits.memory_bytes);
    let planned = budget.take("the picture", width * height, BYTES_PER_PIXEL);
    planned.map_err(|error| RenderError::from(error).into())
}
