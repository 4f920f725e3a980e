//! Sheets of paper, and where a picture lies on one.

use kurbo::Affine;

/// A sheet of paper, in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// The shorter and the longer side, in any order: the sheet is turned as the picture is.
    pub sides_mm: [f64; 2],
    /// Free space on all sides.
    pub margin_mm: f64,
}

impl Page {
    /// A sheet by name (`a3`, `a4`, `a5`, `letter`, in any case) or as `WIDTHxHEIGHTmm`, with a margin of 10 mm.
    ///
    /// ```
    /// use npr_drawing::artwork::Page;
    ///
    /// assert_eq!(Page::parse("A4").map(|p| p.sides_mm), Some([210.0, 297.0]));
    /// assert_eq!(Page::parse("100x80.5mm").map(|p| p.sides_mm), Some([100.0, 80.5]));
    /// assert_eq!(Page::parse("0x7mm"), None);
    /// ```
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.to_ascii_lowercase();
        let sides_mm = match text.as_str() {
            "a3" => [297.0, 420.0],
            "a4" => [210.0, 297.0],
            "a5" => [148.0, 210.0],
            "letter" => [215.9, 279.4],
            _ => {
                let (width, height) = text.strip_suffix("mm")?.split_once('x')?;
                [width.parse().ok()?, height.parse().ok()?]
            }
        };
        let sound = sides_mm.iter().all(|side| (1.0..=10_000.0).contains(side));
        sound.then_some(Self {
            sides_mm,
            margin_mm: 10.0,
        })
    }
}

/// Size of the file, and the place of the picture in it.
pub(crate) struct Placing {
    /// Width and height of the file, in pixels or millimetres.
    pub(crate) size: [f64; 2],
    /// Units per pixel.
    pub(crate) scale: f64,
    offset: [f64; 2],
}

impl Placing {
    pub(crate) fn of(size: [u32; 2], page: Option<Page>) -> Self {
        // Without a page a pixel is a unit.
        let picture = size.map(|side| f64::from(side.max(1)));
        let Some(page) = page else {
            return Self {
                size: size.map(f64::from),
                scale: 1.0,
                offset: [0.0; 2],
            };
        };

        // Turn the page as the picture is turned.
        let [a, b] = page.sides_mm;
        let size = if picture[0] > picture[1] {
            [a.max(b), a.min(b)]
        } else {
            [a.min(b), a.max(b)]
        };

        // Fit the picture between the margins, in the middle.
        let margin = page.margin_mm.clamp(0.0, 0.45 * a.min(b));
        let scale = [0, 1]
            .map(|i| (size[i] - 2.0 * margin) / picture[i])
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        Self {
            size,
            scale,
            offset: [0, 1].map(|i| 0.5 * (size[i] - scale * picture[i])),
        }
    }

    pub(crate) fn affine(&self) -> Affine {
        Affine::new([
            self.scale,
            0.0,
            0.0,
            self.scale,
            self.offset[0],
            self.offset[1],
        ])
    }
}
