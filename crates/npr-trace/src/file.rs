//! Traced bitmaps as files.

use super::format::TraceFormat;
use super::paths::{EARLY_STEPS, Outlines, Paths, for_each_text, shapes};
use super::pdf::write_page;
use super::pen::TextPen;
use super::{Bitmap, TraceOptions, Tracing};
use std::borrow::Borrow;
use std::io::{self, BufWriter, Write};

/// Writes a tracing as a file. Same tracing, same bytes.
///
/// # Errors
///
/// What `sink` says.
pub fn write_tracing(
    tracing: &Tracing,
    format: TraceFormat,
    sink: &mut dyn Write,
) -> io::Result<()> {
    write(
        tracing,
        tracing.size,
        &TraceOptions::default(),
        format,
        sink,
    )
}

/// [`write_tracing`] of [`trace`](super::trace()), without keeping the curves: the same bytes, with some ten bytes a
/// step of the longest path and 30 a path, and 40 MB of text at most, but for that of one path. A bitmap that is
/// given away goes as soon as its paths are found.
///
/// # Errors
///
/// What `sink` says.
pub fn trace_to_file(
    bitmap: impl Borrow<Bitmap> + Send,
    options: &TraceOptions,
    format: TraceFormat,
    sink: &mut dyn Write,
) -> io::Result<()> {
    let seen: &Bitmap = bitmap.borrow();
    let size = [seen.width(), seen.height()];
    let outlines = Outlines::of(bitmap, options, format, EARLY_STEPS);
    write(&outlines, size, options, format, sink)
}

/// Bytes that are handed on at once.
const WRITTEN_BYTES: usize = 1 << 16;

pub(super) fn write(
    paths: &impl Paths,
    size: [u32; 2],
    options: &TraceOptions,
    format: TraceFormat,
    sink: &mut dyn Write,
) -> io::Result<()> {
    let mut sink = BufWriter::with_capacity(WRITTEN_BYTES, sink);
    let sheet = Sheet {
        paths,
        size,
        options,
        format,
    };
    match format {
        TraceFormat::Svg => {
            sink.write_all(svg_head(size).as_bytes())?;
            sink.write_all(b"<g fill=\"#000000\">\n")?;
            sheet.write_svg_shapes(&mut sink)?;
            sink.write_all(b"</g>\n</svg>\n")?;
        }
        TraceFormat::Pdf => write_page(size, &mut sink, |sink| sheet.write_pdf_shapes(sink))?,
        TraceFormat::Json => {
            sink.write_all(json_head(size).as_bytes())?;
            sink.write_all(b"\"paths\":[")?;
            sheet.write_list(&mut sink)?;
            sink.write_all(b"\n]}\n")?;
        }
        TraceFormat::GeoJson => {
            sink.write_all(FEATURES_HEAD)?;
            sheet.write_features("", &mut "\n", &mut sink)?;
            sink.write_all(b"\n]}\n")?;
        }
    }
    sink.flush()
}

/// What opens an SVG file.
pub(super) fn svg_head([width, height]: [u32; 2]) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\">\n"
    )
}

/// What opens a JSON file.
pub(super) fn json_head([width, height]: [u32; 2]) -> String {
    format!("{{\"version\":1,\"size\":[{width},{height}],")
}

/// What opens a GeoJSON file.
pub(super) const FEATURES_HEAD: &[u8] = b"{\"type\":\"FeatureCollection\",\"features\":[";

/// Paths to write, and how.
pub(super) struct Sheet<'a, P> {
    pub paths: &'a P,
    pub size: [u32; 2],
    pub options: &'a TraceOptions,
    pub format: TraceFormat,
}

impl<P: Paths> Sheet<'_, P> {
    pub fn write_svg_shapes(&self, sink: &mut dyn Write) -> io::Result<()> {
        self.write_shapes(sink, ["<path d=\"", "", "\"/>\n"], |_| String::new())
    }

    pub fn write_pdf_shapes(&self, sink: &mut dyn Write) -> io::Result<()> {
        self.write_shapes(sink, ["", "", "f\n"], |_| String::new())
    }

    /// Writes a feature a shape, with `properties` after its area; `comma` comes before the first and is that between
    /// them afterwards.
    pub fn write_features(
        &self,
        properties: &str,
        comma: &mut &str,
        sink: &mut dyn Write,
    ) -> io::Result<()> {
        let head = |area: u64| {
            let comma = std::mem::replace(comma, ",\n");
            format!(
                "{comma}{{\"type\":\"Feature\",\"properties\":{{\"area\":{area}{properties}}},\
                 \"geometry\":{{\"type\":\"Polygon\",\"coordinates\":["
            )
        };
        self.write_shapes(sink, ["", ",", "]}}"], head)
    }

    /// Writes every shape, then its holes: `head` of the area, what opens, the texts with what parts them, what closes.
    fn write_shapes(
        &self,
        sink: &mut dyn Write,
        [open, between, close]: [&str; 3],
        mut head: impl FnMut(u64) -> String,
    ) -> io::Result<()> {
        let mut is_open = false;
        let order = shapes(self.paths);
        self.for_each_text(
            order.iter().map(|number| *number as usize),
            |number, text| {
                let path = self.paths.head(number);
                if path.is_ink {
                    if std::mem::take(&mut is_open) {
                        sink.write_all(close.as_bytes())?;
                    }
                    // Without extent on the grid it is nothing, and its holes are none.
                    is_open = !text.is_empty();
                    if is_open {
                        sink.write_all(head(path.area).as_bytes())?;
                        sink.write_all(open.as_bytes())?;
                    }
                } else if is_open && !text.is_empty() {
                    sink.write_all(between.as_bytes())?;
                }
                sink.write_all(if is_open { text.as_bytes() } else { b"" })
            },
        )?;
        sink.write_all(if is_open { close.as_bytes() } else { b"" })
    }

    /// Writes every path as an object of a list.
    pub fn write_list(&self, sink: &mut dyn Write) -> io::Result<()> {
        self.for_each_text(0..self.paths.count(), |number, text| {
            let path = self.paths.head(number);
            let comma = if number == 0 { "" } else { "," };
            let (is_ink, area) = (path.is_ink, path.area);
            let parent = path.parent.map_or("null".to_owned(), |p| p.to_string());
            write!(
                sink,
                "{comma}\n{{\"ink\":{is_ink},\"area\":{area},\"parent\":{parent},\"segments\":[{text}]}}"
            )
        })
    }

    fn for_each_text(
        &self,
        order: impl Iterator<Item = usize>,
        write: impl FnMut(usize, &str) -> io::Result<()>,
    ) -> io::Result<()> {
        let height = f64::from(self.size[1]);
        let pen = || TextPen::new(self.format, height);
        for_each_text(self.paths, pen, self.options, order, write)
    }
}
