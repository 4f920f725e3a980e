//! Traced shapes as a PDF file, written as they come.

use std::io::{self, Write};

/// Points per pixel: 96 pixels are an inch.
const POINTS_PER_PX: f64 = 0.75;

/// Writes a PDF file of one page, with what `shapes` writes as its content: operators in pixels, y down.
///
/// How long the content is stands in an object behind it, so nothing is held back.
pub(super) fn write_page(
    size: [u32; 2],
    sink: &mut dyn Write,
    shapes: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut file = Counted { sink, count: 0 };
    let [width, height] = size.map(|side| f64::from(side) * POINTS_PER_PX);
    let mut places = Vec::new();
    // Bytes beyond ASCII in the second line tell that it is no text.
    file.write_all(b"%PDF-1.7\n%\x80\x80\x80\x80\n")?;
    let page = format!(
        "<</Type/Page/Parent 2 0 R/MediaBox[0 0 {width} {height}]/Contents 4 0 R/Resources<<>>>>"
    );
    let objects = [
        "<</Type/Catalog/Pages 2 0 R>>",
        "<</Type/Pages/Kids[3 0 R]/Count 1>>",
        &page,
    ];
    for (number, object) in (1..).zip(objects) {
        places.push(file.count);
        write!(file, "{number} 0 obj\n{object}\nendobj\n")?;
    }
    places.push(file.count);
    write!(file, "4 0 obj\n<</Length 5 0 R>>\nstream\n")?;
    let start = file.count;
    writeln!(file, "{POINTS_PER_PX} 0 0 -{POINTS_PER_PX} 0 {height} cm")?;
    shapes(&mut file)?;
    let length = file.count - start;
    write!(file, "\nendstream\nendobj\n")?;
    places.push(file.count);
    write!(file, "5 0 obj\n{length}\nendobj\n")?;
    // List where every object is.
    let table = file.count;
    write!(file, "xref\n0 {}\n0000000000 65535 f\r\n", places.len() + 1)?;
    for place in &places {
        write!(file, "{place:010} 00000 n\r\n")?;
    }
    let count = places.len() + 1;
    write!(
        file,
        "trailer\n<</Size {count}/Root 1 0 R>>\nstartxref\n{table}\n%%EOF"
    )
}

/// A sink that knows how much went into it.
struct Counted<'a> {
    sink: &'a mut dyn Write,
    count: u64,
}

impl Write for Counted<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.sink.write(bytes)?;
        self.count += count as u64;
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.sink.flush()
    }
}
