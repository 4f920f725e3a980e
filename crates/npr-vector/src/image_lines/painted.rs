//! Lines painted in textures.

use super::ink::LineInk;
use super::picture::{ImageScene, SurfacePicture};
use super::slender::{Paint, slender};
use crate::screen::detect::GRAZING_SLOPE;
use npr_core::geometry::{GPixel, NONE};
use npr_core::line_kind::KindSet;
use rayon::prelude::*;

/// Whether painted lines are darker or lighter than what is beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PaintedTone {
    /// Dark lines on lighter paint.
    #[default]
    Dark,
    /// Light lines on darker paint.
    Light,
}

/// Which paint of a texture is a painted line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaintedRule {
    /// Half the usual greatest width, in pixels: wider dark (or light) paint is a surface, not a line. In places a line
    /// may be up to twice as wide, if most of it is not.
    pub reach_px: u32,
    /// By how much a line is darker (or lighter) than the paint beside it, as a share of white, sRGB-encoded.
    pub contrast: f32,
    /// Whether lines are dark or light; default dark.
    pub tone: PaintedTone,
    /// Whether lines must also differ from the mean of the paint around them; default false.
    ///
    /// For finding lines of both tones: a gap between two dark lines is light, but so is the paint around them, and
    /// it is no line. The mean over a square of [`GROUND`] times the reach has to be nearer to what is beside the
    /// line than to the line.
    pub on_ground: bool,
}

/// Half the side of the square whose mean is a line's ground, in reaches of the rule.
pub const GROUND: u32 = 4;

impl Default for PaintedRule {
    fn default() -> Self {
        Self {
            reach_px: 4,
            contrast: 0.2,
            tone: PaintedTone::Dark,
            on_ground: false,
        }
    }
}

/// Marks painted lines, darker or lighter than the paint beside them, as [`painted`] finds them: of connected ink only
/// what is much longer than wide.
///
/// Corners of dark areas, spots and the cells of a chequer are no lines, even where cells hang together at their
/// corners. A line may swell to twice the width of the rule as long as most of it keeps to that, and run where its
/// surface turns away as long as most of it does not: there everything looks slender.
pub fn painted_lines(
    scene: &ImageScene<'_>,
    picture: &SurfacePicture,
    lightness: &[f32],
    lines: &LineInk,
    rule: &PaintedRule,
) -> LineInk {
    // Ink what is painted with the usual reach, and with twice that.
    let with_reach = |reach_px: u32| {
        let rule = PaintedRule { reach_px, ..*rule };
        painted(picture, lightness, lines, &rule)
    };
    let is_ink = |ink: &LineInk| ink.owners.iter().map(|owner| *owner != NONE).collect();
    let mut wide = with_reach(2 * rule.reach_px);
    let [all, thin]: [Vec<bool>; 2] = [is_ink(&wide), is_ink(&with_reach(rule.reach_px))];

    // Keep what is slender, and not only because it is seen at a grazing angle.
    if !all.is_empty() {
        let window = scene.window();
        let faces_eye = |pixel: &GPixel| {
            let slope = scene.view.slope_of(&window, pixel.depth, pixel.plane_step);
            slope < GRAZING_SLOPE
        };
        let kept = slender(&Paint {
            ink: &all,
            thin: &thin,
            ground: &lightness
                .iter()
                .map(|light| !light.is_nan())
                .collect::<Vec<bool>>(),
            width: picture.size[0] as usize,
            facing: &picture.pixels.iter().map(faces_eye).collect::<Vec<bool>>(),
            usual_width: 2 * rule.reach_px as usize,
            around: 5 * rule.reach_px as usize,
        });
        wide.retain(|pixel| kept[pixel]);
    }
    wide
}

/// Marks paint that is darker, or lighter, than the paint beside it, by the `lightness` of textures at every pixel,
/// 0..1. Pixels that are not a number have no paint, neither of a line nor beside one.
///
/// The black top-hat of a square [Serra 1982]: where the picture closed by the square is lighter than itself by the
/// contrast, something dark lies that no square fits into. Light lines are the dark ones of the negative. Only pixels
/// that show the same object count as beside each other, and what `lines` ink is left to them. O(pixels * reach), in
/// parallel over rows.
pub fn painted(
    picture: &SurfacePicture,
    lightness: &[f32],
    lines: &LineInk,
    rule: &PaintedRule,
) -> LineInk {
    let width = picture.size[0] as usize;
    let is_light = rule.tone == PaintedTone::Light;
    let mut ink = LineInk {
        is_light,
        ..LineInk::new(picture.size)
    };
    if width == 0 {
        return ink;
    }

    // Make light lines dark ones.
    let negative: Vec<f32>;
    let mut lightness = lightness;
    if is_light {
        negative = lightness.par_iter().map(|light| 1.0 - light).collect();
        lightness = &negative;
    }

    // Fill dark lines up to what lies beside them, and find the ground around.
    let object = &picture.objects;
    let reach = rule.reach_px as usize;
    let closed = closed(lightness, object, width, reach);
    let ground = match rule.on_ground {
        true => means(lightness, object, width, reach * GROUND as usize),
        false => Vec::new(),
    };

    // Ink what is darker than what lies beside it and stands out from the ground.
    for pixel in 0..lightness.len() {
        let (here, beside) = (lightness[pixel], closed[pixel]);
        let stands_out = |ground: &f32| 2.0 * ground >= here + beside;
        let is_dark = beside - here >= rule.contrast && ground.get(pixel).is_none_or(stands_out);
        let [x, y] = [pixel % width, pixel / width].map(|at| at as u32);
        if is_dark && object[pixel] != NONE && !lines.is_ink(x, y) {
            ink.add(pixel as u32, KindSet::MARKED, 0);
        }
    }
    ink
}

/// Greatest values over squares, then least ones of these over the same squares, among pixels of the same object.
fn closed(values: &[f32], object: &[u32], width: usize, reach: usize) -> Vec<f32> {
    let mut greatest = along_both(values, object, width, reach, f32::max);
    // What has no paint is as what lies outside.
    for (greatest, value) in greatest.iter_mut().zip(values) {
        if value.is_nan() {
            *greatest = f32::NAN;
        }
    }
    along_both(&greatest, object, width, reach, f32::min)
}

/// Means over squares, among pixels of the same object that have a value.
fn means(values: &[f32], object: &[u32], width: usize, reach: usize) -> Vec<f32> {
    let counted = |value: &f32| match value.is_nan() {
        true => [0.0; 2],
        false => [*value, 1.0],
    };
    let counted: Vec<[f32; 2]> = values.par_iter().map(counted).collect();
    let sums = along_both(&counted, object, width, reach, |[a, m], [b, n]| {
        [a + b, m + n]
    });
    sums.iter().map(|[sum, count]| sum / count).collect()
}

/// Combines, by `pick`, all pixels of a row up to `reach` away that show the same object, then the results along
/// columns.
fn along_both<T: Copy + Send + Sync>(
    values: &[T],
    object: &[u32],
    width: usize,
    reach: usize,
    pick: impl Fn(T, T) -> T + Sync,
) -> Vec<T> {
    let height = values.len() / width;

    // Combine each pixel with those of its object within reach, along one axis.
    let over = |from: &[T], across: bool| -> Vec<T> {
        let value = |pixel: usize| {
            let [at, count, step] = match across {
                true => [pixel % width, width, 1],
                false => [pixel / width, height, width],
            };
            let first = pixel - at.min(reach) * step;
            let steps = at.min(reach) + (count - 1 - at).min(reach);
            (0..=steps)
                .map(|k| first + k * step)
                .filter(|other| *other != pixel && object[*other] == object[pixel])
                .fold(from[pixel], |best, other| pick(best, from[other]))
        };
        (0..from.len()).into_par_iter().map(value).collect()
    };

    // Rows first, then columns: together a square.
    over(&over(values, true), false)
}
