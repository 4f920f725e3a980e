//! Pictures beside each other, for people to look at.

use std::error::Error;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use npr_render::Frame;

/// A sheet of pictures of equal size, filled row by row; cells without a picture stay white.
#[derive(Debug, Clone)]
pub struct Sheet {
    columns: usize,
    /// Width and height of a picture in pixels.
    cell: [usize; 2],
    count: usize,
    rgba: Vec<u8>,
}

impl Sheet {
    /// An empty sheet of at least one column.
    pub fn new(columns: usize, cell: [u32; 2]) -> Self {
        Self {
            columns: columns.max(1),
            cell: cell.map(|side| side as usize),
            count: 0,
            rgba: Vec::new(),
        }
    }

    /// Adds a picture; what reaches beyond its cell is cut off.
    pub fn add(&mut self, frame: &Frame) {
        let [width, height] = self.cell;
        let stride = self.columns * width * 4;
        let column = self.count % self.columns;
        if column == 0 {
            self.rgba.resize(self.rgba.len() + stride * height, 255);
        }
        let top = self.count / self.columns * height;
        let row_bytes = frame.size[0] as usize * 4;
        let rows = frame.rgba.chunks_exact(row_bytes.max(1)).take(height);
        for (row, y) in rows.zip(top..) {
            let start = y * stride + column * width * 4;
            let shown = row_bytes.min(width * 4);
            self.rgba[start..start + shown].copy_from_slice(&row[..shown]);
        }
        self.count += 1;
    }

    /// Writes the sheet as PNG.
    ///
    /// # Errors
    ///
    /// Where the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let [width, height] = self.cell;
        let size = [
            self.columns * width,
            self.count.div_ceil(self.columns) * height,
        ];
        #[allow(
            clippy::disallowed_methods,
            reason = "sheets are for people who look at once"
        )]
        let file = BufWriter::new(File::create(path)?);
        let mut encoder = png::Encoder::new(file, size[0] as u32, size[1] as u32);
        encoder.set_color(png::ColorType::Rgba);
        encoder.write_header()?.write_image_data(&self.rgba)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_in_rows() {
        let dot = |gray: u8| Frame {
            size: [1, 1],
            rgba: vec![gray; 4],
            ..Frame::default()
        };
        let mut sheet = Sheet::new(2, [1, 1]);
        for gray in [10, 20, 30] {
            sheet.add(&dot(gray));
        }
        let grays: Vec<u8> = sheet.rgba.chunks_exact(4).map(|pixel| pixel[0]).collect();
        assert_eq!(grays, [10, 20, 30, 255]);
    }
}
