//! Lines painted in textures.

use super::ink::LineInk;
use super::picture::SurfacePicture;
use crate::graph::CurveNode;
use npr_core::geometry::NONE;
use rayon::prelude::*;

/// What of a texture is a painted line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaintedRule {
    /// Half the greatest width, in pixels: what is dark over more is a surface, not a line.
    pub reach_px: u32,
    /// How much darker than beside it a line is, in shares of white as seen (sRGB).
    pub contrast: f32,
}

impl Default for PaintedRule {
    fn default() -> Self {
        Self {
            reach_px: 4,
            contrast: 0.2,
        }
    }
}

/// Marks dark lines on lighter surfaces: what `lightness` (0..1, one a pixel) shows of textures.
///
/// The black top-hat of a square [Serra 1982]: where the picture closed by the square is lighter than itself by the contrast, something
/// dark lies that no square fits into. Only pixels that show the same object count as beside each other, and what `lines` ink is
/// left to them. O(pixels * reach), in parallel over rows.
pub fn painted(
    picture: &SurfacePicture,
    lightness: &[f32],
    lines: &LineInk,
    rule: &PaintedRule,
) -> LineInk {
    let width = picture.size[0] as usize;
    let mut ink = LineInk::new(picture.size);
    if width == 0 {
        return ink;
    }
    let object: Vec<u32> = picture.pixels.iter().map(|pixel| pixel.object).collect();
    let reach = rule.reach_px as usize;
    let closed = closed(lightness, &object, width, reach);
    for pixel in 0..lightness.len() {
        let is_dark = closed[pixel] - lightness[pixel] >= rule.contrast;
        let [x, y] = [pixel % width, pixel / width].map(|at| at as u32);
        if is_dark && object[pixel] != NONE && !lines.is_ink(x, y) {
            ink.add(pixel as u32, CurveNode::MARKED, 0);
        }
    }
    ink
}

/// Greatest values over squares, then least ones over the same, each among pixels of the same object.
fn closed(values: &[f32], object: &[u32], width: usize, reach: usize) -> Vec<f32> {
    let greatest = along_both(values, object, width, reach, f32::max);
    along_both(&greatest, object, width, reach, f32::min)
}

fn along_both(
    values: &[f32],
    object: &[u32],
    width: usize,
    reach: usize,
    pick: impl Fn(f32, f32) -> f32 + Sync,
) -> Vec<f32> {
    let height = values.len() / width;
    let over = |from: &[f32], across: bool| -> Vec<f32> {
        let value = |pixel: usize| {
            let [at, count, step] = match across {
                true => [pixel % width, width, 1],
                false => [pixel / width, height, width],
            };
            let first = pixel - at.min(reach) * step;
            let steps = at.min(reach) + (count - 1 - at).min(reach);
            (0..=steps)
                .map(|k| first + k * step)
                .filter(|other| object[*other] == object[pixel])
                .fold(from[pixel], |best, other| pick(best, from[other]))
        };
        (0..from.len()).into_par_iter().map(value).collect()
    };
    over(&over(values, true), false)
}
