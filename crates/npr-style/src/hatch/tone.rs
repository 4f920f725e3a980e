//! From the texels of a tile to ink: one function per equation, as shaders repeat them.

use npr_core::math;

use super::drawing::STEPS;

/// Hatch luminance between texels, and how fast it changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HatchSample {
    /// Hatch luminance S, 0..1.
    pub luminance: f32,
    /// Change of S per texel of the level, along u and v.
    pub gradient: [f32; 2],
}

/// Octaves between the size at which strokes have their spacing and the size on screen.
///
/// `texels_per_px` is how many texels of the finest level a pixel covers across the strokes;
/// `spacing_texels` is the tile's, `spacing_px` what the style asks for. Negative where even the finest
/// level is too coarse: strokes then grow. Not a number only if an input is, or two are 0.
pub fn detail(texels_per_px: f32, spacing_px: f32, spacing_texels: f32) -> f32 {
    math::log2(texels_per_px * spacing_px / spacing_texels)
}

/// The level to draw from and how far towards the next, 0..1, at `detail`.
///
/// Beyond the coarsest level strokes shrink with the surface. A `detail` that is no number counts as 0.
pub fn level_at(detail: f32, level_count: u32) -> (u32, f32) {
    let coarsest = level_count.saturating_sub(1) as f32;
    let detail = detail.max(0.0).min(coarsest);
    (detail as u32, detail - detail.floor())
}

/// Hatch luminance S, 0..1, of a texel's four drawings at `f`, 0..1, between its level and the next.
///
/// The harmonic mean of the two drawings next to `f`. The width of a stroke is the inverse of the slope
/// of S, so the mean blends widths: strokes thin evenly to a hair before they go, and the ink
/// share of a tone stays what it is in both drawings. Channels are never 0, see
/// [`HatchTile`](super::HatchTile).
pub fn hatch_luminance(texel: [f32; 4], f: f32) -> f32 {
    let place = f * STEPS as f32;
    let step = (place as usize).min(STEPS as usize - 1);
    let t = place - step as f32;
    let near = texel[step];
    let far = texel[step + 1];
    near * far / math::mix(far, near, t)
}

/// Hatch luminance at `(u, v)` of a level of `side * side` texels at `f`, blended over four texels.
///
/// The tile repeats; texel centres lie at `(i + 0.5) / side`. The gradient comes with the same four loads.
///
/// # Panics
///
/// If `level` holds fewer texels than its side asks for.
pub fn sample(level: &[[u8; 4]], side: u32, [u, v]: [f32; 2], f: f32) -> HatchSample {
    let x = (u - u.floor()) * side as f32 - 0.5;
    let y = (v - v.floor()) * side as f32 - 0.5;
    let (left, top) = (x.floor(), y.floor());
    let (tx, ty) = (x - left, y - top);
    let at = |dx: f32, dy: f32| {
        let column = ((left + dx) as i32).rem_euclid(side as i32) as usize;
        let row = ((top + dy) as i32).rem_euclid(side as i32) as usize;
        let texel = level[row * side as usize + column];
        hatch_luminance(texel.map(|channel| f32::from(channel) / 255.0), f)
    };
    let (s00, s10, s01, s11) = (at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0));
    HatchSample {
        luminance: math::mix(math::mix(s00, s10, tx), math::mix(s01, s11, tx), ty),
        gradient: [
            math::mix(s10 - s00, s11 - s01, ty),
            math::mix(s01 - s00, s11 - s10, tx),
        ],
    }
}

/// Steeper or softer strokes: S turned about one half, 0..1 [Suzuki 2004, section 3.3].
pub fn sharpen(s: f32, gain: f32) -> f32 {
    (0.5 + (s - 0.5) * gain).clamp(0.0, 1.0)
}

/// The ink share, 0..1, from which on the second layer joins in: that of light `cross_at`, 0..1.
pub fn second_layer_start(cross_at: f32) -> f32 {
    (1.5 - 2.0 * cross_at).clamp(0.0, 1.0)
}

/// What two layers of hatch luminance laid over each other are cut at: the luminance of each, 0..1, with how much steeper
/// it runs than before; the lower of both luminances counts.
///
/// Up to the ink share `start` only the first layer inks. From there on both leave equal parts of the
/// rest white, `sqrt((1 - share) / (1 - start))` of it each, so the ink share of both together stays
/// linear in light as far as the layers are independent.
pub fn cross_layers(s_first: f32, s_second: f32, start: f32) -> [[f32; 2]; 2] {
    let rest = (1.0 - start).max(1e-6);
    let white_first = 1.0 - s_first;
    let white_second = 1.0 - s_second;
    let thinned = 1.0 - white_first * white_first / rest;
    let first = if thinned > s_first {
        [thinned, 2.0 * white_first / rest]
    } else {
        [s_first, 1.0]
    };
    let second = [
        1.0 - rest * white_second * white_second,
        2.0 * rest * white_second,
    ];
    [first, second]
}

/// The value F that a threshold cuts into ink and paper: `S + 2 (L - 0.5)` [Suzuki 2004, eq. 3.3].
///
/// Both inputs 0..1. With a threshold of one half, ink covers the share `1.5 - 2 L` of the tile, all of it
/// up to `L = 0.25` and none from `L = 0.75`.
pub fn tone_value(s: f32, l: f32) -> f32 {
    s + 2.0 * (l - 0.5)
}

/// Part of a pixel, 0..1, that lies on the ink's side of the threshold.
///
/// `gradient_per_px` is the length of F's gradient over the screen; the edge is taken as straight across
/// the pixel. Where F is flat the edge is hard.
pub fn ink_coverage(tone_value: f32, gradient_per_px: f32, threshold: f32) -> f32 {
    ((threshold - tone_value) / gradient_per_px.max(1e-6) + 0.5).clamp(0.0, 1.0)
}
