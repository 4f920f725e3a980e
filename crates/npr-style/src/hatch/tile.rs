//! Tiles: all drawings of a hatch, packed level by level.

use npr_core::math;
use rayon::prelude::*;

use super::dots::{self, Stipple};
use super::drawing::{Drawing, Hand, SPACING_TEXELS, STEPS};
use super::lines::Strokes;
use super::{Hatch, Pattern, points, rank};
use npr_core::random::{hash, unit};

/// Fewest texels per side: a level with two strokes.
pub const SIDE_MIN: u32 = 2 * SPACING_TEXELS;

/// Most texels per side.
pub const SIDE_MAX: u32 = 1024;

/// Why no tile was made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HatchError {
    /// The side of a tile is not a power of two, or out of range.
    #[error("a hatch tile has a power of two from 16 to 1024 texels per side, not {side}")]
    Side {
        /// Texels per side asked for.
        side: u32,
    },
    /// A picture without pixels, or with more than are taken.
    #[error("a hatch picture has 1 to 4096 pixels per side, not {width} x {height}")]
    PictureSize {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Pixels are missing or left over.
    #[error("a hatch picture of {width} x {height} has {pixel_count} pixels")]
    PixelCount {
        /// Pixels per row.
        width: usize,
        /// Rows.
        height: usize,
        /// Pixels that were given.
        pixel_count: usize,
    },
}

/// A square of hatching that repeats, in levels of falling detail.
#[derive(Debug, Clone, PartialEq)]
pub struct HatchTile {
    /// Texels per side of the finest level.
    pub side: u32,
    /// Texels of any level between neighbouring strokes or dots, on average, at the level's first drawing.
    pub spacing_texels: f32,
    /// Levels of `(side >> l)^2` texels, rows of growing v, down to [`SIDE_MIN`].
    ///
    /// A texel holds the S of four drawings, a third of an octave apart: 255 means 1. Neither 0 nor 255 is
    /// ever stored, so that blending them cannot divide 0 by 0.
    pub levels: Vec<Vec<[u8; 4]>>,
}

/// The tile of `hatch` with `side` texels per side.
///
/// Pattern, length, wobble, taper, variation and seed change it; everything else is for shading. The same
/// for any number of threads. O(texels), for stipple also O(dots^2).
///
/// # Errors
///
/// If `side` is no power of two from [`SIDE_MIN`] to [`SIDE_MAX`].
pub fn levels(hatch: &Hatch, side: u32) -> Result<HatchTile, HatchError> {
    check_side(side)?;
    let hand = Hand::of(hatch);
    let finest = Drawing { side, step: 0 };
    let points = match hatch.pattern {
        Pattern::Stipple => points::spread(dots::stipple_count(finest), hatch.seed),
        _ => Vec::new(),
    };
    let draw = |drawing| draw(hatch, &hand, &points, drawing);
    Ok(HatchTile {
        side,
        spacing_texels: spacing_texels(hatch.pattern),
        levels: sides(side).map(|side| pack(side, &draw)).collect(),
    })
}

/// Refuses sides that tiles do not come in.
pub(super) fn check_side(side: u32) -> Result<(), HatchError> {
    if side.is_power_of_two() && (SIDE_MIN..=SIDE_MAX).contains(&side) {
        Ok(())
    } else {
        Err(HatchError::Side { side })
    }
}

/// Sides of the levels of a tile, finest first.
pub(super) fn sides(side: u32) -> impl Iterator<Item = u32> {
    std::iter::successors(Some(side), |side| Some(side / 2)).take_while(|&side| side >= SIDE_MIN)
}

/// Texels between neighbours: dots lie one to two squares of a track's spacing.
fn spacing_texels(pattern: Pattern) -> f32 {
    let tracks = SPACING_TEXELS as f32;
    match pattern {
        Pattern::Stipple | Pattern::Dots => tracks * 2.0f32.sqrt(),
        _ => tracks,
    }
}

/// One level: ranks the heights of its four drawings and packs them into texels.
///
/// The coarsest level has nothing coarser to turn into and holds its first drawing four times.
pub(super) fn pack(side: u32, draw: &(impl Fn(Drawing) -> Vec<f32> + Sync)) -> Vec<[u8; 4]> {
    let last = if side == SIDE_MIN { 0 } else { STEPS };
    let channels: Vec<Vec<u8>> = (0..=last)
        .into_par_iter()
        .map(|step| {
            let mut heights = draw(Drawing { side, step });
            rank::rank(&mut heights);
            heights.into_iter().map(byte).collect()
        })
        .collect();
    (0..(side * side) as usize)
        .map(|i| std::array::from_fn(|step| channels[step.min(last as usize)][i]))
        .collect()
}

/// S as a byte, never 0 or 1.
fn byte(s: f32) -> u8 {
    (s * 255.0).round().clamp(1.0, 254.0) as u8
}

/// Heights of one drawing, made for the upper half and turned for the lower.
fn draw(hatch: &Hatch, hand: &Hand, points: &[[f32; 2]], drawing: Drawing) -> Vec<f32> {
    // Prepare the strokes and the dots that rows are drawn from.
    let side = drawing.side as usize;
    let strokes = Strokes {
        drawing,
        hand: *hand,
        seed: hatch.seed,
    };
    let stipple = Stipple::new(drawing, hand, hatch.seed, points);

    // Draw the rows of the upper half, with the grain of the paper over them.
    let mut heights = vec![0.0; side * side];
    let upper = &mut heights[..side * side / 2];
    upper.par_chunks_mut(side).enumerate().for_each(|(y, row)| {
        let v = (y as f32 + 0.5) / side as f32;
        match hatch.pattern {
            Pattern::Stipple => stipple.fill_row(v, row),
            Pattern::Dots => dots::fill_screen_row(drawing, v, row),
            Pattern::Parallel | Pattern::Cross | Pattern::Pencil | Pattern::Brush => {
                strokes.fill_row(v, row);
            }
        }
        add_grain(drawing, hand, hatch.seed, y as u32, row);
    });
    mirror(&mut heights);
    heights
}

/// Overwrites the lower half of a square with the upper, turned by half a turn.
pub(super) fn mirror(heights: &mut [f32]) {
    let (upper, lower) = heights.split_at_mut(heights.len() / 2);
    for (below, above) in lower.iter_mut().zip(upper.iter().rev()) {
        *below = *above;
    }
}

/// Adds the paper's grain, spots two texels wide at the level's first drawing.
fn add_grain(drawing: Drawing, hand: &Hand, seed: u32, y: u32, row: &mut [f32]) {
    if hand.grain == 0.0 {
        return;
    }
    let spot = |x: u32, size: u32| {
        let (column, line, across) = (x / size, y / size, drawing.side / size);
        unit(hash(seed, 0x5000 + across, line * across + column))
    };
    for (x, height) in row.iter_mut().enumerate() {
        let grain = math::mix(spot(x as u32, 2), spot(x as u32, 4), drawing.octave());
        *height += hand.grain * grain;
    }
}
