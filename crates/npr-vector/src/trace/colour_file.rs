//! Pictures of few colours as files of filled shapes.

use super::colours::{IndexPicture, layers};
use super::file::{
    FEATURES_HEAD, json_head, page, pieces, push_features, push_list, push_pdf_shapes,
    push_svg_shapes, svg_head,
};
use super::{TraceFormat, TraceOptions, TracedPath};

/// Traces every layer of a picture and writes them, the lowest first, each filled with its colour.
///
/// In SVG a layer is a group; in JSON an object of the list `layers` with its `fill` and its `paths`, whose parents count within the layer;
/// in GeoJSON every shape has the property `fill`. What is left out as a speck shows what lies under it.
///
/// O(pixels) for [`layers`], then for each the time of [`trace`](super::trace()): the picture's whole ink for a colour that is
/// everywhere. The same bytes for any number of threads.
pub fn trace_colours_to_file(
    picture: &IndexPicture,
    options: &TraceOptions,
    format: TraceFormat,
) -> Vec<u8> {
    let mut stack: Vec<Painted> = layers(picture)
        .map(|layer| {
            let color = picture.palette().get(usize::from(layer.index));
            Painted {
                color: color.copied().unwrap_or_default(),
                paths: pieces(&layer.ink, options, format),
            }
        })
        .collect();
    stack.reverse();
    write(picture.size(), stack, format)
}

/// A traced layer.
struct Painted {
    color: [u8; 3],
    paths: Vec<TracedPath<String>>,
}

impl Painted {
    fn fill(&self) -> String {
        let [r, g, b] = self.color;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

fn write(size: [u32; 2], stack: Vec<Painted>, format: TraceFormat) -> Vec<u8> {
    let mut text = String::new();
    match format {
        TraceFormat::Svg => {
            text += &svg_head(size);
            for layer in stack {
                text += &format!("<g fill=\"{}\">\n", layer.fill());
                push_svg_shapes(&mut text, layer.paths);
                text += "</g>\n";
            }
            text += "</svg>\n";
        }
        TraceFormat::Pdf => {
            for layer in stack {
                let [r, g, b] = layer.color.map(|byte| f32::from(byte) / 255.0);
                text += &format!("{r:.4} {g:.4} {b:.4} rg\n");
                push_pdf_shapes(&mut text, layer.paths);
            }
            return page(size, &text);
        }
        TraceFormat::Json => {
            text += &json_head(size);
            text += "\"layers\":[";
            for (index, layer) in stack.iter().enumerate() {
                let comma = if index == 0 { "" } else { "," };
                text += &format!("{comma}\n{{\"fill\":\"{}\",\"paths\":[", layer.fill());
                push_list(&mut text, &layer.paths);
                text += "\n]}";
            }
            text += "\n]}\n";
        }
        TraceFormat::GeoJson => {
            text += FEATURES_HEAD;
            let mut comma = "\n";
            for layer in stack {
                let fill = format!(",\"fill\":\"{}\"", layer.fill());
                push_features(&mut text, layer.paths, &fill, &mut comma);
            }
            text += "\n]}\n";
        }
    }
    text.into_bytes()
}
