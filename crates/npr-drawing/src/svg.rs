//! Drawings as SVG files that vector editors and pen plotters read.
//!
//! Layers are groups that Inkscape shows as layers, by kind; inside are groups by object; every path carries the id
//! of its stroke in `data-id`. Coordinates are whole hundredths of a pixel (thousandths of a millimetre on a page).
//! Names are data: they are escaped, and what could break or disguise text is left out.

use crate::artwork::{
    Artwork, DASH, Group, Layer, Mark, Paint, REGION_SEAM_PX, arrange, plain_name,
};
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
        self.text += &format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" \
             xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
             width=\"{width}{unit}\" height=\"{height}{unit}\" viewBox=\"0 0 {width} {height}\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\">\n"
        );

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
        for (mark, style) in group.marks.iter().zip(&styles) {
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
        self.close_group(start, head.len());
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
    let color = format!(" {attribute}=\"#{r:02x}{g:02x}{b:02x}\"");
    if a == 255 {
        return color;
    }
    let mut opacity = String::new();
    push_fixed(&mut opacity, f64::from(a) / 255.0, 3);
    format!("{color} {attribute}-opacity=\"{opacity}\"")
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
