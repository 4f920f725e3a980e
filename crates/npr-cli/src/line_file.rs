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
use npr_render::{Drawing, RenderError};

/// Memory for a pixel of a PNG file, in bytes: canvas, picture and file together.
const BYTES_PER_PIXEL: usize = 12;

/// The bytes of the file that a job asks for, with its lines drawn by `brushes`, and `lettering` over them.
pub fn encode(
    job: &LineJob<'_>,
    drawing: &Drawing,
    brushes: StrokeBrushes,
    lettering: Vec<Lettered>,
) -> Result<Vec<u8>, Fault> {
    if stamp_count(drawing, &brushes) > STAMPS_LIMIT {
        let error = RenderError::TooMany {
            what: "stamps of brushes",
            limit: STAMPS_LIMIT,
        };
        return Err(error.into());
    }
    let artwork = ArtworkOptions {
        lettering,
        brushes,
        ..job.artwork.clone()
    };
    match job.format {
        LineFormat::Svg => Ok(write_svg(drawing, &artwork)),
        LineFormat::Json => Ok(write_json(drawing)),
        LineFormat::Pdf => Ok(write_pdf(drawing, &artwork)),
        LineFormat::Png => png(job, drawing, &artwork),
    }
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

fn png(job: &LineJob<'_>, drawing: &Drawing, artwork: &ArtworkOptions) -> Result<Vec<u8>, Fault> {
    let rgba = rasterise(drawing, artwork);
    if rgba.is_empty() {
        return Err(Fault::new(
            Exit::Failed,
            "the picture is too large for memory",
        ));
    }
    encoder::png(drawing.size, &rgba, job.look.is_transparent())
}
