//! Drawings as SVG files that vector editors and pen plotters read.
//!
//! Layers are groups that Inkscape shows as layers, by kind; inside are groups by object; every path carries the id
//! of its stroke in `data-id`. Stamps of a brush are uses of images that stand once, as PNG files within the file, in
//! a group a stroke. Coordinates are whole hundredths of a pixel (thousandths of a millimetre on a page).
//! Names are data: they are escaped, and what could break or disguise text is left out.

use crate::artwork::{
    Artwork, DASH, Group, Layer, Mark, Paint, REGION_SEAM_PX, StampImage, arrange, plain_name,
};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use kurbo::{BezPath, PathEl};
use npr_core::number::{on_grid, push_fixed, push_steps};
use npr_trace::svg_path::PathData;
use npr_vector::stroke::Drawing;

pub use crate::artwork::ArtworkOptions as SvgOptions;

/// The drawing as an SVG file, UTF-8.
///
/// Same drawing and options, same bytes. A drawing without lines gives a file without layers.
pub fn write_svg(drawing: &Drawing, options: &SvgOptions) -> Vec<u8> {
    let artwork = arrange(drawing, options);
    let mut writer = Writer {
        text: String::new(),
        decimals: if artwork.is_page { 3 } else { 2 },
        seam: REGION_SEAM_PX * artwork.scale,
    };
    writer.artwork(&artwork);
    writer.text.into_bytes()
}

/// A name as an attribute's value.
fn attribute(name: &str) -> String {
    quick_xml::escape::escape(plain_name(name)).into_owned()
}

struct Writer {
    text: String,
    decimals: u32,
    /// Width of the line around regions.
    seam: f64,
}

impl Writer {
    fn artwork(&mut self, artwork: &Artwork) {
        // Open the file with the size of the page or the picture.
        let unit = if artwork.is_page { "mm" } else { "" };
        let [width, height] = artwork.size.map(|side| {
            let mut text = String::new();
            push_fixed(&mut text, side, 3);
            text
        });
        // Viewers of all ages follow links of this kind.
        let links = match artwork.images.is_empty() {
            true => "",
            false => "xmlns:xlink=\"http://www.w3.org/1999/xlink\" ",
        };
        self.text += &format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" {links}\
             xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
             width=\"{width}{unit}\" height=\"{height}{unit}\" viewBox=\"0 0 {width} {height}\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
        );

        // Hold the images of brushes, a unit wide and high.
        if !artwork.images.is_empty() {
            self.text += "<defs>\n";
            for (number, image) in artwork.images.iter().enumerate() {
                let data = BASE64_STANDARD.encode(png(image));
                self.text += &format!(
                    "<image id=\"stamp-{number}\" width=\"1\" height=\"1\" \
                     preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{data}\"/>\n"
                );
            }
            self.text += "</defs>\n";
        }

        // Lay the ground.
        if let Some(color) = artwork.background.filter(|color| color[3] > 0) {
            let fill = paint("fill", color);
            self.text +=
                &format!("<rect id=\"background\" width=\"{width}\" height=\"{height}\"{fill}/>\n");
        }

        // Write layers from the lowest to the topmost.
        for layer in &artwork.layers {
            self.layer(layer);
        }
        self.text += "</svg>\n";
    }

    fn layer(&mut self, layer: &Layer) {
        let name = &layer.name;
        let head =
            format!("<g id=\"{name}\" inkscape:groupmode=\"layer\" inkscape:label=\"{name}\">\n");
        let start = self.text.len();
        self.text += &head;
        for (number, group) in layer.groups.iter().enumerate() {
            self.group(name, number, group);
        }
        self.close_group(start, head.len());
    }

    fn group(&mut self, layer: &str, number: usize, group: &Group) {
        // What all marks share stands once, at the group.
        let styles: Vec<String> = group.marks.iter().map(|mark| self.style(mark)).collect();
        let shared = styles
            .first()
            .filter(|first| styles.iter().all(|style| style == *first))
            .cloned()
            .unwrap_or_default();
        let label = attribute(&group.label);
        let head = format!("<g id=\"{layer}-{number}\" inkscape:label=\"{label}\"{shared}>\n");
        let start = self.text.len();
        self.text += &head;
        let mut stamped = None;
        for (mark, style) in group.marks.iter().zip(&styles) {
            // Stamps of a stroke have a group of their own.
            let of_stamps = mark
                .stroke
                .filter(|_| matches!(mark.paint, Paint::Image(_)));
            if stamped != of_stamps {
                self.text += if stamped.is_some() { "</g>\n" } else { "" };
                if let Some(id) = of_stamps {
                    self.text += &format!("<g data-id=\"{id}\">\n");
                }
                stamped = of_stamps;
            }
            if let Paint::Image(number) = mark.paint {
                self.stamp(mark, number, if shared.is_empty() { style } else { "" });
                continue;
            }
            let Some(data) = path_data(&mark.path, self.decimals) else {
                continue;
            };
            let own = if shared.is_empty() { style } else { "" };
            let id = mark
                .stroke
                .map(|id| format!(" data-id=\"{id}\""))
                .unwrap_or_default();
            self.text += &format!("<path{id}{own} d=\"{data}\"/>\n");
        }
        self.text += if stamped.is_some() { "</g>\n" } else { "" };
        self.close_group(start, head.len());
    }

    /// A use of an image where a mark lies.
    fn stamp(&mut self, mark: &Mark, number: u32, style: &str) {
        let Some(place) = mark.image_place() else {
            return;
        };
        self.text += &format!("<use xlink:href=\"#stamp-{number}\"{style} transform=\"matrix(");
        for (i, number) in place.as_coeffs().into_iter().enumerate() {
            self.text += if i > 0 { " " } else { "" };
            push_fixed(&mut self.text, number, self.decimals);
        }
        self.text += ")\"/>\n";
    }

    /// Ends a group, or removes its start if nothing was put into it.
    fn close_group(&mut self, start: usize, head: usize) {
        if self.text.len() == start + head {
            self.text.truncate(start);
        } else {
            self.text += "</g>\n";
        }
    }

    /// The attributes that say how a mark is painted.
    fn style(&self, mark: &Mark) -> String {
        match mark.paint {
            Paint::Ink => paint("fill", mark.color),
            Paint::Region => {
                let seam = if mark.color[3] == 255 {
                    self.stroke(mark.color, self.seam)
                } else {
                    String::new()
                };
                format!("{} fill-rule=\"evenodd\"{seam}", paint("fill", mark.color))
            }
            Paint::Line(width) => {
                format!(" fill=\"none\"{}", self.stroke(mark.color, width))
            }
            Paint::Image(_) => opacity("", mark.color[3]),
            Paint::Dashes(width) => {
                let [dash, gap] = DASH.map(|share| self.number(share * width));
                format!(
                    " fill=\"none\"{} stroke-dasharray=\"{dash} {gap}\"",
                    self.stroke(mark.color, width)
                )
            }
        }
    }

    fn stroke(&self, color: [u8; 4], width: f64) -> String {
        format!(
            "{} stroke-width=\"{}\"",
            paint("stroke", color),
            self.number(width)
        )
    }

    /// A length above zero.
    fn number(&self, value: f64) -> String {
        let mut text = String::new();
        push_steps(
            &mut text,
            on_grid(value, self.decimals).max(1),
            self.decimals,
        );
        text
    }
}

/// Attributes of a colour, with its opacity where it is not full.
fn paint(attribute: &str, [r, g, b, a]: [u8; 4]) -> String {
    let prefix = format!("{attribute}-");
    format!(
        " {attribute}=\"#{r:02x}{g:02x}{b:02x}\"{}",
        opacity(&prefix, a)
    )
}

/// The attribute of an opacity that is not full.
fn opacity(prefix: &str, alpha: u8) -> String {
    if alpha == 255 {
        return String::new();
    }
    let mut opacity = String::new();
    push_fixed(&mut opacity, f64::from(alpha) / 255.0, 3);
    format!(" {prefix}opacity=\"{opacity}\"")
}

/// The image of a brush as a PNG file.
fn png(image: &StampImage) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, image.size[0], image.size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_compression(png::Compression::High);
    let written = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&image.rgba()));
    // Memory takes whatever is written, and the pixels are as many as the size says.
    debug_assert!(written.is_ok());
    file
}

/// The value of `d`: every subpath begins with an absolute place, all other coordinates are relative and exact on the
/// grid.
///
/// Pieces without length on the grid are left out; a path of only such pieces gives `None`.
fn path_data(path: &BezPath, decimals: u32) -> Option<String> {
    let mut data = PathData::new(decimals);
    for element in path.elements() {
        match element {
            PathEl::MoveTo(p) => data.begin(*p),
            PathEl::LineTo(p) => data.piece('l', &[*p]),
            PathEl::QuadTo(a, p) => data.piece('q', &[*a, *p]),
            PathEl::CurveTo(a, b, p) => data.piece('c', &[*a, *b, *p]),
            PathEl::ClosePath => data.close(),
        }
    }
    (!data.text.is_empty()).then_some(data.text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::artwork::NAME_LENGTH;

    #[test]
    fn paths_are_relative_and_exact() {
        let path = BezPath::from_svg("M1.004,2 L3.5,1 L3.501,1.001 C4,1 5,2 5,3 Z M7,7 L7,7 Z")
            .expect("a path");
        assert_eq!(
            path_data(&path, 2).as_deref(),
            Some("M1 2l2.5-1c0.5 0 1.5 1 1.5 2z")
        );
        assert_eq!(
            path_data(&BezPath::from_svg("M1,1 L1.001,1").expect("a path"), 2),
            None
        );
    }

    #[test]
    fn names_hold_nothing_that_acts() {
        let name = "\u{0}a\u{1b}\u{202e}<b>&\"']]>--><script>\u{fffe}\u{2066}";
        let safe = attribute(name);
        assert_eq!(
            safe,
            "a&lt;b&gt;&amp;&quot;&apos;]]&gt;--&gt;&lt;script&gt;"
        );
        assert_eq!(attribute(&"x".repeat(100_000)).len(), NAME_LENGTH);
    }
}
