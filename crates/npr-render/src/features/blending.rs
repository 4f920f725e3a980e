//! Two looks of one scene in one picture.

use crate::error::RenderError;
use crate::frame::Frame;
use crate::options::RendererOptions;
use crate::pictures::Pictures;
use npr_core::color::SrgbEncoder;
use npr_core::texture::{TextureStore, Wrap, linear_texel, sample};
use npr_style::compose::cover;
use npr_stylesheet::Style;
use npr_stylesheet::blend::blend;

/// How much of the first look each pixel of a blend shows.
pub(crate) struct Blending {
    amount: f32,
    /// Where the mask's header starts in the store.
    mask: Option<u32>,
    /// The mask, and the table of linear light.
    store: TextureStore,
}

impl Blending {
    /// How a style is blended with its other look; none where it is drawn alone.
    pub fn needs(style: &Style, options: &RendererOptions) -> Result<Option<Self>, RenderError> {
        if !style.blend.shows() {
            return Ok(None);
        }

        // Put the mask, where the style names one, into a store of its own.
        let mut store = TextureStore::new();
        let mask = if style.blend.mask.is_empty() {
            None
        } else {
            let pictures = Pictures::new(style, &options.pictures)?;
            let picture = pictures.of(&style.blend.mask)?;
            let start = store.add(picture.size, &picture.rgba, [Wrap::Clamp; 2]);
            Some(start.ok_or_else(|| RenderError::EmptyPicture {
                key: pictures.key_of(&style.blend.mask),
            })?)
        };
        Ok(Some(Self {
            amount: style.blend.amount,
            mask,
            store,
        }))
    }

    /// Lets the other look, a frame of the same size, show through a finished frame.
    pub fn finish(&self, other: &Frame, frame: &mut Frame) {
        let encoder = SrgbEncoder::new();
        let size = frame.size;
        let pixels = frame.rgba.as_chunks_mut().0.iter_mut();
        for (i, (pixel, other)) in pixels.zip(other.rgba.as_chunks().0).enumerate() {
            let place = [i as u32 % size[0], i as u32 / size[0]];
            let share = self.share_at(place, size);
            if share < 1.0 && pixel != other {
                *pixel = self.mixed(*pixel, *other, share, &encoder);
            }
        }
        frame.times.extend_from_slice(&other.times);
    }

    /// How much of the first look a pixel shows.
    fn share_at(&self, place: [u32; 2], size: [u32; 2]) -> f32 {
        let Some(start) = self.mask else {
            return self.amount;
        };
        let words = self.store.words();
        let at = start as usize;
        let mask_px = [words[at] as f32, words[at + 1] as f32];
        let frame_px = place.map(|v| v as f32 + 0.5);
        let (uv, footprint) = cover(frame_px, size.map(|side| side as f32), mask_px);
        let [r, g, b, _] = sample(words, start, uv, footprint);
        (r + g + b) / 3.0 * self.amount
    }

    fn mixed(&self, first: [u8; 4], second: [u8; 4], share: f32, encoder: &SrgbEncoder) -> [u8; 4] {
        let linear = |pixel: [u8; 4]| {
            let [r, g, b, a] = linear_texel(self.store.words(), u32::from_le_bytes(pixel));
            [r * a, g * a, b * a, a]
        };
        let [r, g, b, a] = blend(linear(first), linear(second), share);
        let [r, g, b] = [r, g, b].map(|v| encoder.byte(v / a.max(1e-6)) as u8);
        [r, g, b, (a * 255.0 + 0.5) as u8]
    }
}
