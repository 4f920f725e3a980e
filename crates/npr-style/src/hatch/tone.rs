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

/// How much the deep tones of a blend are raised, and its light ones lowered.
///
/// The white of two drawings lies in part at different places, and a mean keeps less of it than either
/// has: without this, deep shade holds up to 8 % too much ink halfway between two drawings. Found by trial
/// over all patterns.
const BLEND_LIFT: f32 = 3.4;

/// Least S on the ridge of a stroke that is about to go, as a part of what comes in its place.
///
/// As much as the ridge goes up and down where it passes between texels: hairlines would end as dotted lines.
const RIDGE: f32 = 0.16;

/// Octaves between the size at which strokes have their spacing and the size on screen.
///
/// `texels_per_px` is how many texels of the finest level a pixel covers across the strokes;
/// `spacing_texels` is the tile's, `spacing_px` what the style asks for. Negative where even the finest
/// level is too coarse: strokes then grow. Not a number only if an input is, or two are 0.
#[inline]
pub fn detail(texels_per_px: f32, spacing_px: f32, spacing_texels: f32) -> f32 {
    math::log2(texels_per_px * spacing_px / spacing_texels)
}

/// The level to draw from and how far towards the next, 0..1, at `detail`.
///
/// Beyond the coarsest level strokes shrink with the surface. A `detail` that is no number counts as 0.
#[inline]
pub fn level_at(detail: f32, level_count: u32) -> (u32, f32) {
    let coarsest = level_count.saturating_sub(1) as f32;
    let detail = detail.max(0.0).min(coarsest);
    (detail as u32, detail - detail.floor())
}

/// Hatch luminance S, 0..1, of a texel's four drawings at `f`, 0..1, between its level and the next.
///
/// The width of a stroke is the inverse of the slope of S, so the harmonic mean of the two drawings next
/// to `f` blends widths: strokes thin evenly to a hair before they go, and the ink share of a tone
/// stays what it is in both. In deep shade the same holds for the white between strokes, the harmonic
/// mean of `1 - S`. Channels are never 0 or 1, see [`HatchTile`](super::HatchTile).
pub fn hatch_luminance(texel: [f32; 4], f: f32) -> f32 {
    let (step, t) = step_at(f);
    between_drawings(texel[step], texel[step + 1], t)
}

/// The drawing of a texel's four that comes before `f`, 0..1, and how far `f` lies towards the next, 0..1.
#[inline]
fn step_at(f: f32) -> (usize, f32) {
    let place = f * STEPS as f32;
    let step = (place as usize).min(STEPS as usize - 1);
    (step, place - step as f32)
}

/// Hatch luminance of two drawings at `t`, 0..1, between them.
#[inline]
fn between_drawings(before: f32, after: f32, t: f32) -> f32 {
    let near = before.max(RIDGE * t * after);
    let far = after.max(RIDGE * (1.0 - t) * before);
    let mean = math::mix(far, near, t);
    // Both harmonic means share one division.
    let over = 1.0 / (mean * (1.0 - mean));
    let strokes = near * far * (1.0 - mean) * over;
    let white = (1.0 - near) * (1.0 - far) * mean * over;
    let s = math::mix(strokes, 1.0 - white, strokes);
    s + BLEND_LIFT * t * (1.0 - t) * s * s * (1.0 - s) * (s - 0.45)
}

/// Hatch luminance at `(u, v)` of a level of `side * side` texels at `f`, blended over four texels.
///
/// The tile repeats; `side` is a power of two, texel centres lie at `(i + 0.5) / side`. The gradient comes with the
/// same four loads.
///
/// # Panics
///
/// If `level` holds fewer texels than its side asks for.
#[inline]
pub fn sample(level: &[[u8; 4]], side: u32, [u, v]: [f32; 2], f: f32) -> HatchSample {
    let (column, tx) = texel_at(u, side);
    let (row, ty) = texel_at(v, side);
    let (step, t) = step_at(f);
    let at = |dx: i32, dy: i32| {
        let within = |i: i32| i as u32 & (side - 1);
        level[(within(row + dy) * side + within(column + dx)) as usize]
    };
    // All four at once, and channels by shifts, so that they become one run of vector instructions.
    let texels = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)].map(u32::from_le_bytes);
    let channel =
        |shift: u32| texels.map(|texel| ((texel >> shift) & 255) as i32 as f32 * (1.0 / 255.0));
    let before = channel(8 * step as u32);
    let after = channel(8 * step as u32 + 8);
    let [s00, s10, s01, s11] = std::array::from_fn(|i| between_drawings(before[i], after[i], t));
    HatchSample {
        luminance: math::mix(math::mix(s00, s10, tx), math::mix(s01, s11, tx), ty),
        gradient: [
            math::mix(s10 - s00, s11 - s01, ty),
            math::mix(s01 - s00, s11 - s10, tx),
        ],
    }
}

/// The texel before a place of a tile along one axis, -1 and up, and how far the place lies towards the next, 0..1.
///
/// By casts: `floor` is a call on processors without an instruction for it.
#[inline]
fn texel_at(place: f32, side: u32) -> (i32, f32) {
    let rest = place - place as i32 as f32;
    let within = if rest < 0.0 { rest + 1.0 } else { rest };
    // Places too far to be told apart lie on the tile's edge.
    let at = within.clamp(0.0, 1.0) * side as f32 + 0.5;
    let texel = at as i32;
    (texel - 1, at - texel as f32)
}

/// Steeper or softer strokes: S turned about one half, 0..1 [Suzuki 2004, section 3.3].
#[inline]
pub fn sharpen(s: f32, gain: f32) -> f32 {
    (0.5 + (s - 0.5) * gain).clamp(0.0, 1.0)
}

/// The ink share, 0..1, from which on the second layer joins in: that of light `cross_at`, 0..1.
pub fn second_layer_start(cross_at: f32) -> f32 {
    (1.5 - 2.0 * cross_at).clamp(0.0, 1.0)
}

/// Hatch luminance of two layers laid over each other, 0..1: the lower of both, as [`cross_layers`] thins them.
pub fn cross_luminance(s_first: f32, s_second: f32, start: f32) -> f32 {
    let [first, second] = cross_layers(s_first, s_second, start);
    first[0].min(second[0])
}

/// Luminance of each of two layers laid over each other, 0..1, with how much steeper it runs than before.
///
/// Up to the ink share `start` only the first layer inks. From there on both leave equal parts of the
/// rest white, `sqrt((1 - share) / (1 - start))` of it each, so the ink share of both together stays
/// linear in light as far as the layers are independent.
pub fn cross_layers(s_first: f32, s_second: f32, start: f32) -> [[f32; 2]; 2] {
    [first_of_two(s_first, start), second_of_two(s_second, start)]
}

/// The first of [`cross_layers`].
#[inline]
pub fn first_of_two(s: f32, start: f32) -> [f32; 2] {
    let rest = (1.0 - start).max(1e-6);
    let white = 1.0 - s;
    let thinned = 1.0 - white * white / rest;
    if thinned > s {
        [thinned, 2.0 * white / rest]
    } else {
        [s, 1.0]
    }
}

/// The second of [`cross_layers`]; its luminance is at least `start`.
#[inline]
pub fn second_of_two(s: f32, start: f32) -> [f32; 2] {
    let rest = (1.0 - start).max(1e-6);
    let white = 1.0 - s;
    [1.0 - rest * white * white, 2.0 * rest * white]
}

/// The value F that a threshold cuts into ink and paper: `S + 2 (L - 0.5)` [Suzuki 2004, eq. 3.3].
///
/// Both inputs 0..1. With a threshold of one half, ink covers the share `1.5 - 2 L` of the tile, all of it
/// up to `L = 0.25` and none from `L = 0.75`.
#[inline]
pub fn tone_value(s: f32, l: f32) -> f32 {
    s + 2.0 * (l - 0.5)
}

/// Gradient of F per pixel that edges are smoothed with: the true one, but not less than half of what strokes
/// `spacing_px` apart have on average.
///
/// On the ridge of a stroke S is flat, and a hairline would be all ink in one pixel and none in the next.
#[inline]
pub fn edge_gradient(gradient_per_px: f32, spacing_px: f32) -> f32 {
    gradient_per_px.max(1.0 / spacing_px)
}

/// Part of a pixel, 0..1, that lies on the ink's side of the threshold.
///
/// `gradient_per_px` is the length of F's gradient over the screen; the edge is taken as straight across
/// the pixel. Where F is flat the edge is hard.
#[inline]
pub fn ink_coverage(tone_value: f32, gradient_per_px: f32, threshold: f32) -> f32 {
    ((threshold - tone_value) / gradient_per_px.max(1e-6) + 0.5).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn black_below_a_quarter_white_above_three_quarters() {
        let ink = |s, l| ink_coverage(tone_value(s, l), 0.0, 0.5);
        for s in [0.01, 0.5, 0.99] {
            assert_eq!([ink(s, 0.25), ink(s, 0.75)], [1.0, 0.0], "at {s}");
        }
        assert_eq!([ink(0.4, 0.5), ink(0.6, 0.5)], [1.0, 0.0]);
        assert!((tone_value(0.3, 0.4) - 0.1).abs() < 1e-6, "S + 2 (L - 0.5)");
    }

    #[test]
    fn an_edge_through_the_middle_of_a_pixel_covers_half() {
        assert_eq!(ink_coverage(0.5, 0.25, 0.5), 0.5);
        assert_eq!(ink_coverage(0.4375, 0.25, 0.5), 0.75);
        assert_eq!(edge_gradient(0.0, 8.0), 0.125);
        assert_eq!(edge_gradient(0.4, 8.0), 0.4);
    }

    #[test]
    fn levels_follow_the_distance() {
        assert_eq!(detail(1.0, 8.0, 8.0), 0.0);
        assert_eq!(detail(4.0, 8.0, 8.0), 2.0);
        assert_eq!(level_at(-3.0, 5), (0, 0.0));
        assert_eq!(level_at(1.25, 5), (1, 0.25));
        assert_eq!(level_at(99.0, 5), (4, 0.0));
        assert_eq!(level_at(f32::NAN, 5), (0, 0.0));
        assert_eq!(level_at(f32::INFINITY, 0), (0, 0.0));
    }

    #[test]
    fn gain_turns_about_one_half() {
        assert_eq!(sharpen(0.5, 7.0), 0.5);
        assert_eq!(sharpen(0.625, 2.0), 0.75);
        assert_eq!(sharpen(0.1, 4.0), 0.0);
    }

    #[test]
    fn crossed_layers_of_even_ranks_stay_linear() {
        for start in [0.0, 0.3, 0.5, 0.9, 1.0] {
            for share in [0.1, 0.3, 0.5, 0.7, 0.9] {
                let rank = |i: u32| (i as f32 + 0.5) / 200.0;
                let inked = |i: &u32| cross_luminance(rank(i % 200), rank(i / 200), start) < share;
                let got = (0..40_000).filter(inked).count() as f32 / 40_000.0;
                assert!(
                    (got - share).abs() < 0.01,
                    "{got} is not {share} from {start}"
                );
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn the_blend_meets_every_drawing_and_hardly_leaves_their_range(
            texel in [1u8..255, 1u8..255, 1u8..255, 1u8..255], f in 0.0f32..=1.0,
        ) {
            let texel = texel.map(|channel| f32::from(channel) / 255.0);
            for (step, channel) in texel.iter().enumerate() {
                let there = hatch_luminance(texel, step as f32 / STEPS as f32);
                prop_assert!((there - channel).abs() < 1e-4, "{there} is not {channel}");
            }
            let step = ((f * STEPS as f32) as usize).min(2);
            let (low, high) = (texel[step].min(texel[step + 1]), texel[step].max(texel[step + 1]));
            let s = hatch_luminance(texel, f);
            prop_assert!(s > low - 0.02 && s < high + 0.05 && s > 0.0 && s < 1.0);
        }

        #[test]
        fn the_gradient_is_that_of_the_luminance(
            texels in proptest::collection::vec([1u8..255, 1u8..255, 1u8..255, 1u8..255], 16),
            cell in [0u32..4, 0u32..4], within in [0.1f32..0.9, 0.1f32..0.9], f in 0.0f32..=1.0,
        ) {
            let place: [f32; 2] = std::array::from_fn(|i| (cell[i] as f32 + 0.5 + within[i]) / 4.0);
            let at = |du: f32, dv: f32| sample(&texels, 4, [place[0] + du / 4.0, place[1] + dv / 4.0], f);
            let here = at(0.0, 0.0);
            let h = 0.05;
            let slopes = [at(h, 0.0).luminance - at(-h, 0.0).luminance, at(0.0, h).luminance - at(0.0, -h).luminance];
            for (slope, gradient) in slopes.iter().zip(here.gradient) {
                prop_assert!((slope / (2.0 * h) - gradient).abs() < 1e-3);
            }
            let far = at(-12.0, 8.0);
            prop_assert!((far.luminance - here.luminance).abs() < 1e-3);
        }
    }
}
