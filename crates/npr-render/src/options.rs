//! What a renderer needs beside a model and a style.

use crate::error::RenderError;
use crate::smoke::Smoke;
use crate::stage::SurfaceStage;
use crate::tiles::TILE_PIXELS;
use npr_core::interrupt::Interrupt;
use npr_drawing::lettering::Font;
use npr_scene::Image;
use std::collections::BTreeMap;

/// Most pixels of a frame along a side.
const FRAME_SIDE: u32 = 32_768;

/// A picture that a style names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// sRGB bytes with straight alpha, row by row from the top.
    pub rgba: Vec<u8>,
}

impl From<Image> for Picture {
    fn from(image: Image) -> Self {
        Self {
            size: [image.width, image.height],
            rgba: image.rgba,
        }
    }
}

/// What a renderer needs beside model and style.
#[derive(Debug, Clone, PartialEq)]
pub struct RendererOptions {
    /// Width and height of the frame in pixels.
    pub size: [u32; 2],
    /// Pixels per inch, for lengths in millimetres.
    pub dpi: f32,
    /// How much larger the frame is than the picture whose strokes it shows, 1 for its own: strokes are found for a
    /// picture of `size` divided by that, rounded down, and enlarged, so that a small frame and a large one are the
    /// same drawing. Lengths of strokes in `px` are pixels of the small one.
    pub enlarged: u32,
    /// Width and height of the picture whose strokes the frame shows, where that is one of the same shape and another
    /// size: strokes are found for it, and scaled to the frame with all their lengths. It takes the place of
    /// `enlarged`; a draft that has the strokes of its full picture need not find any ([`LineModel::keep_views`]).
    ///
    /// [`LineModel::keep_views`]: crate::LineModel::keep_views
    pub strokes_of: Option<[u32; 2]>,
    /// The picture behind the scene, where the style names one.
    pub background_image: Option<Picture>,
    /// The pictures that [`Style::named_pictures`](npr_stylesheet::Style::named_pictures) lists, by the names that the
    /// style gives them.
    pub pictures: BTreeMap<String, Picture>,
    /// Fonts of the style's words, by the names that the style gives them.
    pub fonts: BTreeMap<String, Font>,
    /// Smoke beside the model; [`Renderer::set_smoke`](crate::Renderer::set_smoke) changes it from frame to frame.
    pub smoke: Option<Smoke>,
    /// Most bytes that may be planned.
    pub memory_limit: u64,
    /// Most pixels drawn at once, 8 million (4K) by default and at most, 4 million where lines are found on a mask; a
    /// larger frame is drawn in tiles. Fewer need less memory and more time. Tiles keep at least 64 pixels a side.
    pub tile_pixels: u32,
    /// Whether [`Renderer::draw_bands`](crate::Renderer::draw_bands) draws the frame where it can: then memory is
    /// planned for a single band.
    pub in_bands: bool,
    /// Whether every frame is decided by itself, so that it is the same in any sequence. Else, which is the default,
    /// lines before a background (`line.background`) go on from the frame before.
    pub alone: bool,
    /// Whether frames come with [`Frame::layers`](crate::Frame::layers), for compositing; those that are recorded for
    /// another program never do.
    pub layers: bool,
    /// Whether frames with layers come with [`Frame::stages`](crate::Frame::stages) too, for somebody who wants to see
    /// how they are made.
    pub stages: bool,
    /// How far surfaces are drawn: all the way by default, else to a stage that somebody wants to see.
    pub surfaces: SurfaceStage,
    /// Ends a frame that is being drawn, where somebody else raises it: it is asked between the steps of finding
    /// strokes, between tiles and, on the processor, between passes. The frame then fails with
    /// [`RenderError::is_interrupted`]; the next is drawn as if it were the first. A device ends what it has begun.
    pub interrupt: Interrupt,
}

impl RendererOptions {
    /// Size of the picture that strokes are found for.
    pub(crate) fn stroke_size(&self) -> [u32; 2] {
        let own = self.size.map(|side| (side / self.enlarged.max(1)).max(1));
        self.strokes_of.unwrap_or(own)
    }

    /// Pixels per inch of that picture.
    pub(crate) fn stroke_dpi(&self) -> f32 {
        match self.strokes_of {
            Some(_) => self.dpi,
            None => self.dpi / self.enlarged.max(1) as f32,
        }
    }

    /// How much larger the frame is than that picture.
    pub(crate) fn stroke_scale(&self) -> f64 {
        match self.strokes_of {
            Some([_, height]) => f64::from(self.size[1]) / f64::from(height.max(1)),
            None => f64::from(self.enlarged.max(1)),
        }
    }

    /// Options for a frame of `size` pixels with strokes of its own: 96 pixels per inch, no pictures, fonts, smoke or
    /// layers, 4 GiB.
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            dpi: 96.0,
            enlarged: 1,
            strokes_of: None,
            background_image: None,
            pictures: BTreeMap::new(),
            fonts: BTreeMap::new(),
            smoke: None,
            memory_limit: 4 << 30,
            tile_pixels: TILE_PIXELS,
            in_bands: false,
            alone: false,
            layers: false,
            stages: false,
            surfaces: SurfaceStage::default(),
            interrupt: Interrupt::default(),
        }
    }
}

/// Refuses frames without pixels and those that are too large.
pub(crate) fn check_size([width, height]: [u32; 2]) -> Result<(), RenderError> {
    if width == 0 || height == 0 {
        return Err(RenderError::EmptyFrame { width, height });
    }
    if width.max(height) > FRAME_SIDE {
        return Err(RenderError::FrameTooLarge {
            width,
            height,
            limit: FRAME_SIDE,
        });
    }
    Ok(())
}
