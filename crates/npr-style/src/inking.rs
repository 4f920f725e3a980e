//! Ink and hatching at one point: the black half of `shade.compose_frame`.
//!
//! The shade ramp gives a luminance L, the hatch tile a luminance S; F = S + 2 (L - 0.5) is cut to black or
//! white by a threshold [Suzuki 2004, section 3.3, eq. 3.3]. So strokes swell as it gets darker, and merge into ink.

use crate::compose::Layers;
use crate::corners::Corners;
use crate::hatch::{
    detail, edge_gradient, first_of_two, ink_coverage, level_at, sample, second_of_two, sharpen,
    tone_value,
};
use crate::ink_step::NO_HATCH;
use crate::paint::painted_level;
use crate::ramp::ramp_coordinate;
use npr_core::geometry::{ChartCorners, Part, Triangle};
use npr_core::grain::paper_height;
use npr_core::math::unpack_shares;
use npr_core::raster::ID_MASK;
use npr_core::surface::{blend, blend2, weights_around};
use npr_core::texture::HEADER_WORDS;

/// Least luminance of the shade ramp on a surface with hatch but no ink, above half the threshold, at which all would
/// be ink: the paper between strokes stays open.
const OPEN_PAPER: f32 = 0.08;

/// Change of luminance between two strokes from which the strokes give way to the tone's own edge; at twice as much
/// they are gone.
const ABRUPT: f32 = 0.25;

/// Chart distortion, 0..1, from which dots are placed on the screen instead: on the chart they would be streaks.
const LOOSE: f32 = 0.3;

/// Share of the hatch, from its lightest part, that full chart distortion fills with ink at once.
const DISTORTION_FILL: f32 = 0.22;

/// Part of a pixel that is inked at a time where the crest of a stroke may lie within it.
const THIRD: f32 = 0.333_333_34;

/// Luminance L of the shade ramp at coordinate `x`: black up to `dark_at`, white from `light_at`, grey between.
pub fn shade_level(x: f32, dark_at: f32, light_at: f32) -> f32 {
    if light_at <= dark_at {
        return if x < light_at { 0.0 } else { 1.0 };
    }
    ((x - dark_at) / (light_at - dark_at)).clamp(0.0, 1.0)
}

/// Luminance of a part's shade ramp at coordinate `x`; a part with hatch but no ink never gets so dark that its hatch
/// closes.
fn level_of(part: &Part, x: f32) -> f32 {
    let l = shade_level(x, part.dark_at, part.light_at);
    if part.flags & Part::INK == 0 {
        l.max(part.threshold * 0.5 + OPEN_PAPER)
    } else {
        l
    }
}

/// Ink of a surface whose ramp coordinates all lie in `range`: 1 or 0 if it is the same all over, else `None`.
pub(crate) fn ink_over(part: &Part, range: [f32; 2]) -> Option<f32> {
    if part.flags & (Part::INK | Part::HATCH) == 0 {
        return Some(0.0);
    }
    let (lightest, darkest) = if part.flags & Part::HATCH != 0 {
        (0.0, 1.0)
    } else {
        (NO_HATCH, NO_HATCH)
    };
    // Paint is looked up at each place, but it only darkens.
    let painted = part.flags & Part::PAINTED != 0;
    if !painted && tone_value(lightest, level_of(part, range[0])) > part.threshold {
        Some(0.0)
    } else if tone_value(darkest, level_of(part, range[1])) < part.threshold {
        // The grain of the paper leaves white in a hatch however dark it is, and so does a face.
        let is_grained = part.flags & Part::HATCH != 0 && part.hatch_grain > 0.0;
        let is_spared = part.flags & Part::SPARED != 0;
        (!is_grained && !is_spared).then_some(1.0)
    } else {
        None
    }
}

/// Luminance of a place of which the pen leaves out a share of the shade: it lies that much lighter on the ramp, so
/// that the shade covers less, and what is left of it tapers as before.
fn spared_level(l: f32, spared: f32) -> f32 {
    l + spared
}

/// Height of the paper below which it takes less ink of a hatch, on paper of grain 1.
const LEVEL: f32 = 0.3;

/// Height over which its ink goes from all to none below that.
const SOFT: f32 = 0.25;

/// What the grain of the paper leaves of the ink of a hatch at a place of the picture, in pixels: all of it on hills,
/// less where the paper is lower than a level that rises with the grain.
pub(crate) fn on_paper(part: &Part, ink: f32, px: [f32; 2]) -> f32 {
    if ink <= 0.0 || part.hatch_grain <= 0.0 {
        return ink;
    }
    let above = paper_height(px, part.spots_per_px) - part.hatch_grain * LEVEL;
    ink * (1.0 + above / SOFT).clamp(0.0, 1.0)
}

/// Ink of a hatched surface at luminance `l` of the shade ramp, if no stroke is thin or wide enough to matter: 1 or 0;
/// `None` if the hatch decides.
///
/// The margin is half of F's change over a pixel at the edge of a stroke.
fn ink_of_level(part: &Part, l: f32) -> Option<f32> {
    let room = 1.0 / part.spacing_px;
    if tone_value(sharpen(0.0, part.hatch_gain), l) - room > part.threshold {
        Some(0.0)
    } else if tone_value(sharpen(1.0, part.hatch_gain), l) + room < part.threshold {
        Some(1.0)
    } else {
        None
    }
}

/// Whether the second of two layers may ink a place at luminance `l` of the shade ramp.
///
/// Its strokes end more gently than the first's, by `2 (1 - start)`, and so does the edge that a pixel smooths.
fn second_may_ink(part: &Part, l: f32) -> bool {
    let darkest = sharpen(part.second_from, part.hatch_gain);
    let room = 2.0 * (1.0 - part.second_from) * part.hatch_gain / part.spacing_px;
    tone_value(darkest, l) - room <= part.threshold
}

/// Luminance S of a hatch, and its change over a pixel to the right and down.
#[derive(Debug, Clone, Copy)]
struct Hatching {
    s: f32,
    slope: [f32; 2],
    /// Least change over a pixel with which its edges are smoothed.
    hairline: f32,
}

/// Position of a pixel in a hatch, in tiles, and the steps from there to its neighbours.
#[derive(Debug, Clone, Copy)]
struct HatchCoord {
    uv: [f32; 2],
    right: [f32; 2],
    down: [f32; 2],
}

impl HatchCoord {
    /// Coordinates of the layer whose strokes run across: u and v exchanged, moved to another place of the tile.
    fn crossed(self) -> Self {
        let swap = |[u, v]: [f32; 2]| [v, u];
        Self {
            uv: swap(self.uv).map(|at| at + 0.5),
            right: swap(self.right),
            down: swap(self.down),
        }
    }

    /// Direction in the picture, to the right and down, in which places leave a stroke the fastest.
    fn across(&self) -> [f32; 2] {
        let (right, down) = (self.right[0], self.down[0]);
        let per_px = length([right, down]).max(1e-9);
        [right / per_px, down / per_px]
    }

    /// The place `px` pixels further on in a direction of the picture.
    fn moved(&self, [right, down]: [f32; 2], px: f32) -> Self {
        let step = |i: usize| self.right[i] * right + self.down[i] * down;
        Self {
            uv: [0, 1].map(|i| self.uv[i] + step(i) * px),
            ..*self
        }
    }

    /// Tiles that a pixel covers across the strokes; if `isotropic`, the mean of both directions.
    fn step(&self, isotropic: bool) -> f32 {
        let (right, down) = (self.right, self.down);
        if isotropic {
            (right[0] * down[1] - right[1] * down[0]).abs().sqrt()
        } else {
            length([right[0], down[0]])
        }
    }
}

/// How far strokes give way at a place.
#[derive(Debug, Clone, Copy)]
struct Calm {
    /// Distortion of the chart, 0..1.
    chart_distortion: f32,
    /// How far the tone changes too fast for strokes, 0..1.
    abrupt: f32,
    /// How far strokes are cut away, 0..1.
    cut: f32,
}

/// Luminance of the shade ramp at a pixel and its neighbours to the right and below, with the paint under it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InkLevels {
    pub l: [f32; 3],
    /// White that paint leaves at the pixel.
    white: f32,
    /// How much the light under that paint changes over a pixel.
    per_px: f32,
}

/// The places of a pixel and of its neighbours to the right and below.
fn places_around(px: [f32; 2]) -> [[f32; 2]; 3] {
    [px, [px[0] + 1.0, px[1]], [px[0], px[1] + 1.0]]
}

impl Layers<'_> {
    /// How much of the surface of triangle `id` is inked at a place of the frame, 0..1; bits of `dark` are the lights
    /// whose shadow falls there.
    pub(crate) fn ink_at(
        &self,
        id: u32,
        part: &Part,
        corners: &Corners<'_>,
        px: [f32; 2],
        dark: u32,
    ) -> f32 {
        if part.flags & (Part::INK | Part::HATCH) == 0 {
            return 0.0;
        }
        let (ndc, step) = (self.view.ndc_at(px), self.view.pixel_ndc());
        let weights = weights_around(corners.clip, ndc, step);
        let levels = self.levels_at((id, part), corners, px, weights, dark);
        let l = levels.l;
        // Clamp the change: beyond a silhouette the surface runs on to anywhere.
        let darkens = [
            (2.0 * (l[1] - l[0])).clamp(-1.0, 1.0),
            (2.0 * (l[2] - l[0])).clamp(-1.0, 1.0),
        ];
        if part.flags & Part::HATCH == 0 {
            let value = tone_value(NO_HATCH, l[0]);
            return ink_coverage(value, length(darkens), part.threshold);
        }
        if let Some(ink) = ink_of_level(part, l[0]) {
            return on_paper(part, ink, px);
        }
        let [chart_distortion, _] = self.pen_at(id, weights[0]);
        let abrupt = abruptness(levels.per_px, part.spacing_px);
        let (place, chart_distortion) =
            if part.flags & Part::ISOTROPIC != 0 && chart_distortion >= LOOSE {
                (self.place_on_screen(part, px), 0.0)
            } else {
                let place = self.place_in_hatch(id, part, weights, places_around(px));
                (place, chart_distortion * levels.white)
            };
        let calm = Calm {
            chart_distortion,
            abrupt,
            cut: match part.flags & Part::CUT {
                0 => 0.0,
                _ => 1.0 - self.hatch_left(px),
            },
        };
        on_paper(
            part,
            self.ink_of_hatch(part, &place, l[0], darkens, calm),
            px,
        )
    }

    /// Ink of hatched surface at the luminance `l` of its shade ramp, which changes F by `darkens` over a pixel.
    fn ink_of_hatch(
        &self,
        part: &Part,
        place: &HatchCoord,
        l: f32,
        darkens: [f32; 2],
        calm: Calm,
    ) -> f32 {
        // Draw the first layer, which is all of most hatches.
        let start = part.second_from;
        let tone = (l, darkens);
        if part.flags & Part::TWO_LAYERS == 0 {
            let [ink, _] = self.ink_of_layer(part, place, tone, calm, |s| [s, 1.0]);
            return ink;
        }
        let [ink, s] = self.ink_of_layer(part, place, tone, calm, |s| first_of_two(s, start));

        // The first layer settles most places, or they are too light for the second.
        if ink == 1.0 || !second_may_ink(part, l) {
            return ink;
        }
        let crossed = place.crossed();
        let second = self.ink_of_layer(part, &crossed, tone, calm, |s| second_of_two(s, start));
        if s <= second[1] { ink } else { second[0] }
    }

    /// Ink of one layer of a hatch over a pixel, 0..1, and its luminance S at the middle. The shade ramp has luminance
    /// `l` there and changes F by `darkens` over a pixel; `share` is S within the layer and the factor on its slope.
    ///
    /// One straight edge is no picture of a hairline, which has two: where it runs through the middle of a pixel it
    /// would cover half of it at least, and next to nothing where it runs between two, so that slanting tips of strokes
    /// would be rows of dots. Where the crest of a stroke or of a gap may lie within the pixel, its thirds across the
    /// strokes are therefore inked one by one.
    fn ink_of_layer(
        &self,
        part: &Part,
        place: &HatchCoord,
        (l, darkens): (f32, [f32; 2]),
        calm: Calm,
        share: impl Fn(f32) -> [f32; 2],
    ) -> [f32; 2] {
        // Look the layer up at the middle of the pixel.
        let sheet = self.sheet(part, place);
        let layer_at = |place: &HatchCoord| {
            let raw = sheet.at(place);
            let layer = sharpened(scaled(raw, share(raw.s)), part.hatch_gain);
            let layer = untied(layer, calm.chart_distortion);
            toned_hatch(layer, calm.abrupt.max(calm.cut))
        };
        let slope_of = |layer: &Hatching| {
            let [right, down] = layer.slope;
            length([right + darkens[0], down + darkens[1]]).max(layer.hairline)
        };
        let middle = layer_at(place);
        let value = tone_value(middle.s, l);

        // Take the edge for straight where no crest is near.
        let is_plain = part.flags & Part::ISOTROPIC != 0
            || (value - part.threshold).abs() > part.hatch_gain / part.spacing_px;
        if is_plain {
            let ink = ink_coverage(value, slope_of(&middle), part.threshold);
            return [ink, middle.s];
        }

        // Ink the thirds of the pixel across the strokes.
        let across = place.across();
        let third = |layer: &Hatching, off: f32| {
            let darker = (across[0] * darkens[0] + across[1] * darkens[1]) * off;
            let value = tone_value(layer.s, l) + darker;
            ink_coverage(value, slope_of(layer) * THIRD, part.threshold)
        };
        let beside = |off: f32| third(&layer_at(&place.moved(across, off)), off);
        let sum = third(&middle, 0.0) + beside(-THIRD) + beside(THIRD);
        [sum * THIRD, middle.s]
    }

    /// How dark triangle `id` is to the pen at a position of the frame: light, faces and paint together.
    pub(crate) fn levels_at(
        &self,
        (id, part): (u32, &Part),
        corners: &Corners<'_>,
        px: [f32; 2],
        weights: [[f32; 3]; 3],
        dark: u32,
    ) -> InkLevels {
        let mut lit = self.lit_levels(part, corners, px, weights, dark);
        if part.flags & Part::SPARED != 0 {
            lit = std::array::from_fn(|i| spared_level(lit[i], self.pen_at(id, weights[i])[1]));
        }
        let white = self.paint_at(id, part, weights);
        InkLevels {
            l: std::array::from_fn(|i| painted_level(lit[i], white[i], part.threshold)),
            white: white[0],
            per_px: length([lit[1] - lit[0], lit[2] - lit[0]]) * white[0],
        }
    }

    /// Luminance of the shade ramp of a triangle at a position of the frame, one pixel to the right and one below.
    fn lit_levels(
        &self,
        part: &Part,
        corners: &Corners<'_>,
        px: [f32; 2],
        weights: [[f32; 3]; 3],
        dark: u32,
    ) -> [f32; 3] {
        // If the normal alone decides, positions need not be computed.
        let x = match self.lights.only_distant() {
            Some(towards) if dark == 0 => corners.cosines(weights, towards).map(ramp_coordinate),
            _ => {
                let open = self.openness(corners, px);
                let steps = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
                std::array::from_fn(|i| {
                    let (world, normal) = (corners.world(weights[i]), corners.normal(weights[i]));
                    let seen = open.at(steps[i]);
                    self.lights.coordinate_under(world, normal, dark, seen).0
                })
            }
        };
        x.map(|x| level_of(part, x))
    }

    /// Coordinates of a pixel and its neighbours to the right and below in the hatch of a part.
    fn place_in_hatch(
        &self,
        id: u32,
        part: &Part,
        weights: [[f32; 3]; 3],
        places: [[f32; 2]; 3],
    ) -> HatchCoord {
        // Find the coordinates of the three pixels: in the picture, in the chart of the surface, or those of the file.
        let triangle = ((id & ID_MASK) - 1) as usize;
        let uvs: [[f32; 2]; 3] = std::array::from_fn(|i| {
            let raw = if part.flags & Part::ON_SCREEN != 0 {
                places[i]
            } else if part.flags & Part::ON_SURFACE != 0 {
                let ChartCorners { a, b, c } = self.charts[triangle];
                blend2(weights[i], [a, b, c])
            } else {
                let Triangle { corners, .. } = self.triangles[triangle];
                blend2(weights[i], corners.map(|v| self.vertices[v as usize].uv))
            };

            // Turn them by the angle of the strokes and scale them to tiles.
            let [cos, sin] = part.turn;
            [
                (raw[0] * cos + raw[1] * sin) * part.tile_scale,
                (raw[1] * cos - raw[0] * sin) * part.tile_scale,
            ]
        });
        HatchCoord {
            uv: uvs[0],
            right: [uvs[1][0] - uvs[0][0], uvs[1][1] - uvs[0][1]],
            down: [uvs[2][0] - uvs[0][0], uvs[2][1] - uvs[0][1]],
        }
    }

    /// Coordinates of a pixel and its neighbours in the hatch of a part that is laid on the picture.
    fn place_on_screen(&self, part: &Part, px: [f32; 2]) -> HatchCoord {
        let header = part.hatch as usize;
        let spacing_texels = f32::from_bits(self.texels[header + 3]);
        let scale = spacing_texels / (self.texels[header] as f32 * part.spacing_px);
        HatchCoord {
            uv: px.map(|at| at * scale),
            right: [scale, 0.0],
            down: [0.0, scale],
        }
    }

    /// Two shares that triangle `id` has for the pen at these weights of its corners, 0..1: the distortion of its
    /// stroke chart, and how much of its shade is left out.
    fn pen_at(&self, id: u32, weights: [f32; 3]) -> [f32; 2] {
        let Triangle { corners, .. } = self.triangles[((id & ID_MASK) - 1) as usize];
        let shares = corners.map(|v| unpack_shares(self.vertices[v as usize].pen));
        [0, 1].map(|i| blend(weights, shares.map(|share| share[i])))
    }

    /// The level of the tile of a hatch on which strokes lie as far apart on screen as the part asks.
    fn sheet(&self, part: &Part, place: &HatchCoord) -> HatchSheet<'_> {
        let header = part.hatch as usize;
        let side = self.texels[header];
        let step = place.step(part.flags & Part::ISOTROPIC != 0).max(1e-9);
        let spacing_texels = f32::from_bits(self.texels[header + 3]);
        let detail = detail(step * side as f32, part.spacing_px, spacing_texels);
        let (level, fraction) = level_at(detail, self.texels[header + 2]);
        let level_side = side >> level;
        // Skip the levels before it, each four times as large as the next.
        let before = 4 * (side * side - level_side * level_side) / 3;
        let first = header + (HEADER_WORDS + before) as usize;
        let texels = &self.texels[first..][..(level_side * level_side) as usize];
        HatchSheet {
            texels: bytemuck::cast_slice(texels),
            side: level_side,
            fraction,
            hairline: edge_gradient(0.0, part.spacing_px),
        }
    }
}

/// A level of the tile of a hatch.
#[derive(Debug, Clone, Copy)]
struct HatchSheet<'a> {
    texels: &'a [[u8; 4]],
    side: u32,
    /// How far towards the next level, 0..1.
    fraction: f32,
    /// Least change over a pixel with which edges are smoothed.
    hairline: f32,
}

impl HatchSheet<'_> {
    /// One layer of the hatch at a place.
    fn at(&self, place: &HatchCoord) -> Hatching {
        let found = sample(self.texels, self.side, place.uv, self.fraction);
        let along = |[du, dv]: [f32; 2]| {
            (found.gradient[0] * du + found.gradient[1] * dv) * self.side as f32
        };
        Hatching {
            s: found.luminance,
            slope: [along(place.right), along(place.down)],
            hairline: self.hairline,
        }
    }
}

impl Layers<'_> {
    /// Ink of a tone that changes by `change` to the right and down, on a flat sheet; `at` is the position on it in
    /// pixels, and a pixel covers `scale` tiles.
    pub(crate) fn ink_on_sheet(
        &self,
        part: &Part,
        at: [f32; 2],
        scale: f32,
        tone: f32,
        change: [f32; 2],
    ) -> f32 {
        // Find the luminance of the shade ramp and how it changes.
        if part.flags & (Part::INK | Part::HATCH) == 0 {
            return 0.0;
        }
        let l = level_of(part, tone);
        let darker = change.map(|change| level_of(part, tone + change) - l);
        let darkens = darker.map(|d| (2.0 * d).clamp(-1.0, 1.0));

        // Settle solid ink, and tones in which no stroke matters.
        if part.flags & Part::HATCH == 0 {
            return ink_coverage(tone_value(NO_HATCH, l), length(darkens), part.threshold);
        }
        if let Some(ink) = ink_of_level(part, l) {
            return ink;
        }

        // Draw the strokes where the sheet has them.
        let [cos, sin] = part.turn;
        let on_sheet =
            |[x, y]: [f32; 2]| [(x * cos + y * sin) * scale, (y * cos - x * sin) * scale];
        let place = HatchCoord {
            uv: on_sheet(at),
            right: on_sheet([1.0, 0.0]),
            down: on_sheet([0.0, 1.0]),
        };
        let calm = Calm {
            chart_distortion: 0.0,
            abrupt: abruptness(length(darker), part.spacing_px),
            cut: 0.0,
        };
        self.ink_of_hatch(part, &place, l, darkens, calm)
    }
}

/// A hatch whose white is filled where the chart is distorted: the last strokes merge up to a fifth earlier than they
/// would.
///
/// Where the directions of a chart turn round, strokes cannot all end well; mostly the white specks in the dark show
/// it.
fn untied(hatching: Hatching, chart_distortion: f32) -> Hatching {
    let most = 1.0 - DISTORTION_FILL * chart_distortion.clamp(0.0, 1.0);
    if hatching.s <= most {
        return hatching;
    }
    // Only the edge of the tone is left, which is crisp.
    Hatching {
        hairline: 0.0,
        ..scaled(hatching, [most, 0.0])
    }
}

/// How far a tone changes from dark to light too fast for strokes to show, 0..1.
///
/// `per_px` is the change of luminance over a pixel, `spacing_px` the distance between strokes. In a groove narrower
/// than that, strokes would be a row of dots.
pub fn abruptness(per_px: f32, spacing_px: f32) -> f32 {
    ((per_px * spacing_px - ABRUPT) / ABRUPT).clamp(0.0, 1.0)
}

/// A hatch that gives way to the edge of the tone itself, as far as `share` says.
fn toned_hatch(hatching: Hatching, share: f32) -> Hatching {
    let s = hatching.s + (NO_HATCH - hatching.s) * share;
    Hatching {
        hairline: hatching.hairline * (1.0 - share),
        ..scaled(hatching, [s, 1.0 - share])
    }
}

/// A layer with luminance `s` and its slope times `steepness`.
fn scaled(layer: Hatching, [s, steepness]: [f32; 2]) -> Hatching {
    Hatching {
        s,
        slope: layer.slope.map(|d| d * steepness),
        ..layer
    }
}

fn sharpened(layer: Hatching, gain: f32) -> Hatching {
    scaled(layer, [sharpen(layer.s, gain), gain])
}

pub(crate) fn length(v: [f32; 2]) -> f32 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}

#[cfg(test)]
mod tests;
