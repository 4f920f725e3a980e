//! Words as outlines: sound effects and captions, bent, leaning, growing, with bands around the letters.
//!
//! A [`Font`] is read from the bytes of a font file. [`set_words`] shapes a text with it, kerning and ligatures
//! included, and gives outlines in *cap heights*: a capital letter is 1 high, y runs down, and the middle of all
//! lines is the origin. [`Words::marks`] turns them into the shapes of a drawing, in pixels.
//!
//! ```no_run
//! use npr_drawing::drawing::paint_over;
//! use npr_drawing::lettering::{Band, Font, Setting, set_words};
//!
//! let font = Font::new(std::fs::read("comic.ttf")?)?;
//! let setting = Setting { bend: 0.3, ..Setting::default() };
//! let words = set_words(&font, "POW!", &setting)?;
//! let rim = Band { color: [0, 0, 0, 255], width_px: 8.0 };
//! let marks = words.marks([320.0, 120.0], 90.0, [255, 210, 30, 255], &[rim]);
//! let mut picture = vec![255; 640 * 360 * 4];
//! paint_over(&marks, &mut picture, [640, 360]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Shaping is HarfBuzz's, by the crate harfrust; scripts of all directions work, but lines are horizontal. Of
//! variable fonts the default weight is used, of colour fonts the plain outlines.

mod error;
mod font;
mod setting;
#[cfg(any(test, feature = "testing"))]
pub mod testing;
#[cfg(test)]
mod tests;
mod warp;

pub use error::{LetteringError, TEXT_MAX};
pub use font::Font;
pub use setting::{SPREAD_MAX, Setting};

use crate::mark::{Mark, Paint};
use error::CURVES_MAX;
use font::Letter;
use kurbo::{Affine, BezPath, PathEl};
use std::collections::BTreeSet;
use warp::Warp;

/// Space between the lowest part of a line and the highest of the next, in cap heights.
const CLEAR: f64 = 0.15;

/// Words as outlines.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Words {
    /// Closed outlines of all letters in cap heights, y down, for the nonzero rule.
    pub outline: BezPath,
    /// Characters that the font lacks, each once, in the order of their code points. They leave a gap.
    pub missing: Vec<char>,
}

/// A line of letters, each at its place.
struct Line {
    /// Outlines with the baseline's start as origin, y down.
    outline: BezPath,
    /// Place of the pen after the last letter.
    width: f64,
}

/// Sets a text of one or more lines, each centred, as outlines.
///
/// Line breaks separate lines; other control characters are left out. Letters take the order and the forms of their
/// script. Curves are bent within 0.001 cap heights. O(n) in curves.
///
/// # Errors
///
/// [`LetteringError`] for a text or letters beyond the limits, and for a font that breaks off.
pub fn set_words(font: &Font, text: &str, setting: &Setting) -> Result<Words, LetteringError> {
    let setting = setting.within_bounds();
    let count = text.chars().count();
    if count > TEXT_MAX {
        return Err(LetteringError::TooLong { count });
    }
    let mut missing = BTreeSet::new();
    let lines: Vec<Line> = text
        .lines()
        .map(|line| set_line(font, line, setting.spacing, &mut missing))
        .collect::<Result<_, _>>()?;
    let outline = stack(&lines, &setting)?;
    Ok(Words {
        outline,
        missing: missing.into_iter().collect(),
    })
}

fn set_line(
    font: &Font,
    text: &str,
    spacing: f64,
    missing: &mut BTreeSet<char>,
) -> Result<Line, LetteringError> {
    let mut outline = BezPath::new();
    let mut pen = 0.0;
    let mut width = 0.0;
    for letter in font.shape(text)? {
        let Letter { character, .. } = letter;
        if letter.is_missing() {
            missing.insert(character);
        } else {
            let place = Affine::translate((pen + letter.offset[0], letter.offset[1]));
            outline.extend(&(place * font.outline(&letter)?));
        }
        pen += letter.advance;
        width = pen;
        // Accents stand on their letter: no gap between them.
        if letter.advance > 0.0 {
            pen += spacing;
        }
    }
    if outline.elements().len() > CURVES_MAX {
        return Err(LetteringError::TooComplex);
    }
    Ok(Line { outline, width })
}

/// Places lines below one another, centred, and bends them.
fn stack(lines: &[Line], setting: &Setting) -> Result<BezPath, LetteringError> {
    let baselines = baselines_of(lines, setting.line_step);
    let placed: Vec<(f64, BezPath)> = lines
        .iter()
        .zip(baselines)
        .map(|(line, baseline)| {
            let place = Affine::translate((-0.5 * line.width, baseline));
            (baseline, place * line.outline.clone())
        })
        .collect();
    let warp = Warp::around(placed.iter().map(|(_, path)| path), setting);
    let mut outline = BezPath::new();
    for (baseline, path) in &placed {
        warp.carry_path(path, *baseline, &mut outline);
        if outline.elements().len() > CURVES_MAX {
            return Err(LetteringError::TooComplex);
        }
    }
    Ok(warp::turned(setting.turn) * outline)
}

/// Where the baselines of lines lie, so that the middle of all capitals is 0.
fn baselines_of(lines: &[Line], line_step: f64) -> Vec<f64> {
    let mut baselines = Vec::with_capacity(lines.len());
    let mut at = 0.0;
    for (i, line) in lines.iter().enumerate() {
        if let Some(above) = i.checked_sub(1).and_then(|above| lines.get(above)) {
            let met = above.hang() + line.rise() + CLEAR;
            at += if line_step < 1.0 {
                line_step
            } else {
                line_step.max(met)
            };
        }
        baselines.push(at);
    }
    let middle = 0.5 * at;
    baselines.into_iter().map(|y| y - middle + 0.5).collect()
}

impl Line {
    /// Distance by which letters hang below the baseline, in cap heights.
    fn hang(&self) -> f64 {
        if self.outline.is_empty() {
            0.0
        } else {
            self.outline.control_box().y1
        }
    }

    /// Distance by which they rise above it, in cap heights.
    fn rise(&self) -> f64 {
        if self.outline.is_empty() {
            0.0
        } else {
            -self.outline.control_box().y0
        }
    }
}

/// A band around letters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// sRGB and alpha.
    pub color: [u8; 4],
    /// Distance that it reaches beyond what it surrounds, in pixels.
    pub width_px: f64,
}

/// Words in a picture.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Lettered {
    /// The words as written; any text.
    pub text: String,
    /// Bands and letters, the lowest first, in pixels.
    pub marks: Vec<Mark>,
}

impl Words {
    /// The shapes that draw the words: the outermost band first, the letters last. Joins are round.
    ///
    /// The middle of the words lies at `middle_px`, and a capital is `cap_height_px` high. `bands` run from the letters
    /// outwards; those without width or colour are left out, but bands outside of them keep their place. Bands cover
    /// the area under the letters too, so translucent letters show them. There are no shapes if a number is not finite.
    pub fn marks(
        &self,
        middle_px: [f64; 2],
        cap_height_px: f64,
        fill: [u8; 4],
        bands: &[Band],
    ) -> Vec<Mark> {
        // Put the letters in the picture; broken numbers give none.
        let place = Affine::translate((middle_px[0], middle_px[1])) * Affine::scale(cap_height_px);
        let outline = place * self.outline.clone();
        let is_sound = |el: &PathEl| el.end_point().is_none_or(|p| p.is_finite());
        if !(outline.elements().iter().all(is_sound) && cap_height_px > 0.0) {
            return Vec::new();
        }
        let mark = |paint, color| Mark {
            stroke: None,
            path: outline.clone(),
            paint,
            color,
        };

        // Lay bands around them, the innermost on top.
        let mut reach = 0.0;
        let mut marks = Vec::new();
        for band in bands {
            reach += band.width_px.max(0.0);
            if band.width_px > 0.0 && reach.is_finite() && band.color[3] > 0 {
                marks.push(mark(Paint::Line(2.0 * reach), band.color));
            }
        }
        marks.reverse();

        // Lay the letters over all bands.
        if fill[3] > 0 {
            marks.push(mark(Paint::Ink, fill));
        }
        marks
    }
}
