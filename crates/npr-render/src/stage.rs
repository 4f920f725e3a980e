//! Stages of a frame: what its surfaces, its lines and its pixels are on the way to the picture.

use npr_core::color::linear_from_srgb;
use npr_core::geometry::Part;
use npr_core::line_kind::Kind;
use npr_core::texture::TextureStore;
use npr_style::ramp::Level;
use npr_style::tone_row::{ROW_LENGTH, RowTone, row_words};

/// How far the surfaces of a frame are drawn.
///
/// A stage is drawn by the same passes as the whole, with less to do: both engines agree about it as they do about
/// frames. Beams, smoke and the background stay as they are; lines are drawn over it, and
/// [`StagePixel::surface`] is without them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SurfaceStage {
    /// All that the style asks for.
    #[default]
    Whole,
    /// Base colours with textures and vertex colours, without light.
    Base,
    /// Where on its ramp every place lies, as grey: 0 away from the light, 255 towards it, in sRGB values. Parts that
    /// are unlit are white.
    Light,
    /// Base colours times the tones of their ramps or toon materials, without ink and highlights.
    Tones,
    /// Solid ink and hatching alone, on white.
    Ink,
}

impl SurfaceStage {
    /// Takes from parts what later stages add; gives what the user should know of it. `Light` lays a row of tones into
    /// `textures`.
    pub(crate) fn apply(self, parts: &mut [Part], textures: &mut TextureStore) -> Option<String> {
        if self == Self::Whole {
            return None;
        }

        // Make the row that shows light itself.
        let mut row = None;
        if self == Self::Light {
            row = textures.add_words(row_words(&light_itself()));
            if row.is_none() {
                let notice = "light is shown by the ramps: the textures leave no room for another";
                return Some(notice.to_owned());
            }
        }

        // Leave out what comes later.
        for part in parts.iter_mut().filter(|part| part.flags & Part::BEAM == 0) {
            part.flags &= !(Part::HIGHLIGHTS | Part::ANGLE);
            if self != Self::Ink {
                part.flags &= !(Part::INK | Part::HATCH | Part::PAINTED);
            }
            if self != Self::Tones {
                part.flags &= !(Part::TOON | Part::TONE_ROW);
            }
            if matches!(self, Self::Light | Self::Ink) {
                part.flags |= Part::PLAIN;
                part.base_color = [1.0; 4];
            }
            match self {
                Self::Base => part.flags |= Part::UNLIT,
                Self::Ink => {
                    part.ramp = [[1.0, 1.0, 1.0, Level::UNUSED]; 8];
                    part.ramp[0][3] = 0.0;
                }
                Self::Light => {
                    part.tone_row = row.unwrap_or_default();
                    part.flags |= Part::TONE_ROW;
                }
                Self::Whole | Self::Tones => (),
            }
        }
        None
    }
}

/// A row of tones that shows every coordinate as that much grey.
fn light_itself() -> Vec<RowTone> {
    let tone = |place: usize| RowTone {
        light: [linear_from_srgb((place as f32 + 0.5) / ROW_LENGTH as f32); 3],
        same_until: place as u32,
    };
    (0..ROW_LENGTH).map(tone).collect()
}

/// How far lines are drawn, on the way from a shape to strokes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineStage {
    /// All lines as they are found, in pieces, those behind surfaces too. Methods that find lines in a picture of the
    /// scene, `image` and `potrace`, find none of these.
    Found,
    /// What is seen of them, in pieces.
    Seen,
    /// Pieces joined to strokes and smoothed, before the style changes anything about them.
    Joined,
}

/// What a pixel of a frame is on the way to the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StagePixel {
    /// The picture without lines, as sRGB bytes with straight alpha.
    pub surface: [u8; 4],
    /// Number of the nearest triangle, counted from 1; 0 without one.
    pub triangle: u32,
    /// Number of its material, counted from 1; `u32::MAX` for those without one, 0 without a surface.
    pub material: u32,
    /// What found a line on the mask, see [`MASK_KINDS`](npr_core::outline::MASK_KINDS); 0 where nothing did, and in
    /// frames without a mask.
    pub mask: u32,
    /// What the stroke that shows is on the shape; `None` where none does.
    pub kind: Option<Kind>,
}
