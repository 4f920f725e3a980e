//! Fonts: from bytes to shaped letters and their outlines.

use super::error::LetteringError;
use harfrust::font::glyph::outline::{DrawMemory, DrawOptions, PathSink};
use harfrust::{Buffer, GlyphId, ShapeOptions, ShaperFont, shape};
use kurbo::BezPath;
use npr_core::decoding::guard;
use std::fmt;
use std::sync::Arc;

/// Height of capitals where a font does not state it and has no H, as a share of the em: that of most text fonts.
const USUAL_CAP_HEIGHT: f64 = 0.7;

/// Farthest that a letter may reach, in cap heights; swashes stay within ten.
const REACH_MAX: f64 = 1000.0;

/// A font with outlines: TrueType, OpenType (also the first of a collection) or Type 1, at its default weight.
///
/// Cloning is cheap. Fonts are equal where their bytes are.
#[derive(Clone)]
pub struct Font {
    bytes: Arc<Vec<u8>>,
    font: harfrust::Font,
    /// Font units per cap height.
    cap_height: f64,
}

impl PartialEq for Font {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.bytes, &other.bytes) || self.bytes == other.bytes
    }
}

impl fmt::Debug for Font {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Font({} bytes)", self.bytes.len())
    }
}

/// A letter in a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Letter {
    glyph: GlyphId,
    /// The first character that it stands for.
    pub(super) character: char,
    /// Distance that the pen moves after it, in cap heights.
    pub(super) advance: f64,
    /// Place relative to the pen, in cap heights, y down.
    pub(super) offset: [f64; 2],
}

impl Letter {
    /// Whether the font lacks it; blanks never count.
    pub(super) fn is_missing(&self) -> bool {
        self.glyph == GlyphId::NOTDEF && !self.character.is_whitespace()
    }
}

impl Font {
    /// The font in a file's bytes.
    ///
    /// It reads the font's directory, not its letters: a broken letter is found when it is set.
    ///
    /// # Errors
    ///
    /// [`LetteringError`] where the bytes are no font, or one without outlines or with an absurd grid.
    pub fn new(bytes: Vec<u8>) -> Result<Self, LetteringError> {
        let bytes = Arc::new(bytes);
        let shared: Arc<dyn AsRef<[u8]> + Send + Sync> = bytes.clone();
        let read = guard(|| {
            let font = harfrust::Font::new(shared, 0).ok_or(LetteringError::NotAFont)?;
            if font.outline_glyphs().is_empty() {
                return Err(LetteringError::NoOutlines);
            }
            let metrics = font.metrics();
            let stated = metrics.cap_height.map(|height| height.to_i32());
            let units = metrics.raw_units_per_em;
            Ok((font, units, stated))
        });
        let (font, units, stated) = read.unwrap_or(Err(LetteringError::NotAFont))?;
        if !(16..=16384).contains(&units) {
            return Err(LetteringError::Units { units });
        }
        let em = f64::from(units);
        let mut font = Self {
            bytes,
            font,
            cap_height: em * USUAL_CAP_HEIGHT,
        };
        // Take what the font states, or else the height of its H, and nothing absurd.
        let is_sound = |height: &f64| (0.2 * em..=2.0 * em).contains(height);
        let stated = stated.map(f64::from).filter(is_sound);
        let measured = stated.or_else(|| font.height_of_h().filter(is_sound));
        font.cap_height = measured.unwrap_or(font.cap_height);
        Ok(font)
    }

    /// Height of the letter H in font units; `None` if the font has none.
    fn height_of_h(&self) -> Option<f64> {
        let h = self.shape("H").ok()?.first().copied()?;
        let bounds = kurbo::Shape::bounding_box(&self.outline(&h).ok()?);
        Some(-bounds.y0 * self.cap_height)
    }

    /// The letters of one line, from left to right.
    pub(super) fn shape(&self, text: &str) -> Result<Vec<Letter>, LetteringError> {
        // Shape the line, with kerning and ligatures.
        let characters: Vec<char> = text.chars().filter(|c| !c.is_control()).collect();
        let shaped = guard(|| {
            let mut buffer = Buffer::new();
            for (cluster, character) in characters.iter().enumerate() {
                buffer.push(u32::from(*character), cluster as u32);
            }
            buffer.guess_segment_properties();
            let shaper = ShaperFont::new(&self.font);
            let shaped = shape(&shaper, &mut buffer, ShapeOptions::new());
            (shaped.is_ok() && buffer.allocation_successful()).then_some(buffer)
        });
        let shaped = shaped.map_err(|_| LetteringError::BrokenLetter {
            letter: characters.first().copied().unwrap_or_default(),
        })?;
        let buffer = shaped.ok_or(LetteringError::TooComplex)?;

        // Measure the letters in cap heights.
        let glyphs = buffer.glyph_infos().iter().zip(buffer.glyph_positions());
        glyphs
            .map(|(info, place)| {
                let character = characters.get(info.cluster as usize).copied();
                let character = character.unwrap_or(char::REPLACEMENT_CHARACTER);
                let lengths = [
                    place.x_advance,
                    place.x_offset,
                    -place.y_offset.max(-i32::MAX),
                ]
                .map(|units| f64::from(units) / self.cap_height);
                if lengths.iter().any(|length| length.abs() > REACH_MAX) {
                    return Err(LetteringError::BrokenLetter { letter: character });
                }
                Ok(Letter {
                    glyph: GlyphId::new(info.glyph_id),
                    character,
                    advance: lengths[0],
                    offset: [lengths[1], lengths[2]],
                })
            })
            .collect()
    }

    /// The outline of a letter in cap heights, y down, every part closed; empty for blanks.
    pub(super) fn outline(&self, letter: &Letter) -> Result<BezPath, LetteringError> {
        let broken = LetteringError::BrokenLetter {
            letter: letter.character,
        };
        let mut sink = Sink {
            path: BezPath::new(),
            scale: 1.0 / self.cap_height,
            is_open: false,
            is_sound: true,
        };
        let drawn = guard(|| {
            let glyphs = self.font.outline_glyphs();
            let glyph = glyphs.get(letter.glyph);
            glyph.map(|glyph| glyph.draw(&DrawOptions::new(), DrawMemory::Scratch, &mut sink))
        });
        sink.close();
        match drawn {
            // A blank has no outline.
            Ok(None) => Ok(BezPath::new()),
            Ok(Some(Ok(_))) if sink.is_sound => Ok(sink.path),
            _ => Err(broken),
        }
    }
}

/// Takes outlines in font units, y up.
struct Sink {
    path: BezPath,
    scale: f64,
    /// Whether a subpath has begun and is not closed.
    is_open: bool,
    /// Whether all numbers so far are finite and within reach.
    is_sound: bool,
}

impl Sink {
    fn point(&mut self, x: f32, y: f32) -> (f64, f64) {
        let point = (f64::from(x) * self.scale, -f64::from(y) * self.scale);
        // False for what is no number, too.
        self.is_sound &= point.0.abs() <= REACH_MAX && point.1.abs() <= REACH_MAX;
        point
    }

    /// Begins a subpath where the font did not.
    fn begin(&mut self) {
        if !self.is_open {
            self.path.move_to((0.0, 0.0));
            self.is_open = true;
        }
    }
}

impl PathSink for Sink {
    fn move_to(&mut self, x: f32, y: f32) {
        self.close();
        let p = self.point(x, y);
        self.path.move_to(p);
        self.is_open = true;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.begin();
        let p = self.point(x, y);
        self.path.line_to(p);
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        self.begin();
        let (a, p) = (self.point(cx0, cy0), self.point(x, y));
        self.path.quad_to(a, p);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        self.begin();
        let (a, b) = (self.point(cx0, cy0), self.point(cx1, cy1));
        let p = self.point(x, y);
        self.path.curve_to(a, b, p);
    }

    fn close(&mut self) {
        if self.is_open {
            self.path.close_path();
            self.is_open = false;
        }
    }
}
