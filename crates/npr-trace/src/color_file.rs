//! Pictures of few colours as files of filled shapes.

use super::colors::{IndexPicture, layers};
use super::file::{FEATURES_HEAD, Sheet, json_head, svg_head};
use super::paths::{EARLY_STEPS, Outlines};
use super::pdf::write_page;
use super::{TraceFormat, TraceOptions};
use std::io::{self, BufWriter, Write};

/// Traces every layer of a picture and writes them, the lowest first, each filled with its colour.
///
/// In SVG a layer is a group; in JSON an object of the list `layers` with its `fill` and its `paths`, whose parents
/// count within the layer; in GeoJSON every shape has the property `fill`. What is left out as a speck shows what
/// lies under it.
///
/// O(pixels) for [`layers`], then for each the time of [`trace`](super::trace()): the picture's whole ink for a
/// colour that is everywhere. The same bytes for any number of threads. A byte a step of every layer's paths is held
/// until all are found.
///
/// # Errors
///
/// What `sink` says.
pub fn trace_colors_to_file(
    picture: &IndexPicture,
    options: &TraceOptions,
    format: TraceFormat,
    sink: &mut dyn Write,
) -> io::Result<()> {
    // Find the outlines of every colour, the first of them drawn early.
    let mut early = EARLY_STEPS;
    let mut stack = Vec::new();
    for layer in layers(picture) {
        let color = picture.palette().get(usize::from(layer.index));
        let outlines = Outlines::of(&layer.ink, options, format, early);
        early = early.saturating_sub(outlines.step_count());
        stack.push(Painted {
            color: color.copied().unwrap_or_default(),
            outlines,
        });
    }

    // Write the lowest colour first.
    stack.reverse();
    let mut sink = BufWriter::new(sink);
    write(picture.size(), &stack, options, format, &mut sink)?;
    sink.flush()
}

/// A traced layer.
struct Painted {
    color: [u8; 3],
    outlines: Outlines,
}

impl Painted {
    fn fill(&self) -> String {
        let [r, g, b] = self.color;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

fn write(
    size: [u32; 2],
    stack: &[Painted],
    options: &TraceOptions,
    format: TraceFormat,
    sink: &mut dyn Write,
) -> io::Result<()> {
    let sheets = stack.iter().map(|layer| {
        let sheet = Sheet {
            paths: &layer.outlines,
            size,
            options,
            format,
        };
        (layer, sheet)
    });
    match format {
        TraceFormat::Svg => {
            sink.write_all(svg_head(size).as_bytes())?;
            for (layer, sheet) in sheets {
                writeln!(sink, "<g fill=\"{}\">", layer.fill())?;
                sheet.write_svg_shapes(sink)?;
                sink.write_all(b"</g>\n")?;
            }
            sink.write_all(b"</svg>\n")
        }
        TraceFormat::Pdf => write_page(size, sink, |sink| {
            for (layer, sheet) in sheets {
                let [r, g, b] = layer.color.map(|byte| f32::from(byte) / 255.0);
                writeln!(sink, "{r:.4} {g:.4} {b:.4} rg")?;
                sheet.write_pdf_shapes(sink)?;
            }
            Ok(())
        }),
        TraceFormat::Json => {
            sink.write_all(json_head(size).as_bytes())?;
            sink.write_all(b"\"layers\":[")?;
            for (index, (layer, sheet)) in sheets.enumerate() {
                let comma = if index == 0 { "" } else { "," };
                write!(sink, "{comma}\n{{\"fill\":\"{}\",\"paths\":[", layer.fill())?;
                sheet.write_list(sink)?;
                sink.write_all(b"\n]}")?;
            }
            sink.write_all(b"\n]}\n")
        }
        TraceFormat::GeoJson => {
            sink.write_all(FEATURES_HEAD)?;
            let mut comma = "\n";
            for (layer, sheet) in sheets {
                let fill = format!(",\"fill\":\"{}\"", layer.fill());
                sheet.write_features(&fill, &mut comma, sink)?;
            }
            sink.write_all(b"\n]}\n")
        }
    }
}
