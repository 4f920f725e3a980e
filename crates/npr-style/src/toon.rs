//! Toon materials as MToon draws them: base and shade colour with a border between, rims, matcaps, outlines
//! [VRMC_materials_mtoon-1.0]. The twin of `lib/toon`.
//!
//! A material is a row of words in the texture store, so parts without one carry a single number.
//!
//! Differs: light of intensity 1 that falls on a surface squarely leaves its colour as it is, as the light of VRM
//! viewers does that is pi strong.

use bytemuck::{Pod, Zeroable};
use npr_core::geometry::{NONE, Part, Triangle};
use npr_core::math;
use npr_core::surface::{blend2, dot, unit_or_z, weights_at};
use npr_core::texture;

use crate::compose::Layers;
use crate::corners::Corners;
use crate::lighting::{LightSource, Openness};
use crate::line_color::LinePoint;
use crate::surface_color::footprint;

/// A toon material.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct Toon {
    /// Colour where no light falls, linear light, as all colours here.
    pub shade_color: [f32; 3],
    /// How hard the border between light and shade is, 0..1.
    pub toony: f32,
    /// Light that is added where the surface turns from the eye.
    pub rim_color: [f32; 3],
    /// Exponent of that, above 0.
    pub rim_power: f32,
    /// Factor on the matcap.
    pub matcap_color: [f32; 3],
    /// Widens the rim.
    pub rim_lift: f32,
    /// Light that the surface gives off.
    pub emissive: [f32; 3],
    /// How much of rim and matcap is multiplied by the light on the surface, 0..1.
    pub rim_mix: f32,
    /// Colour of the outline.
    pub outline_color: [f32; 3],
    /// How much of it is multiplied by what the surface shows, 0..1.
    pub outline_mix: f32,
    /// Added to the cosine between normal and light.
    pub shift: f32,
    /// Factor on the red of `shift_map` that is added to it.
    pub shift_scale: f32,
    /// How much the light of a sky is the same on all sides, 0..1.
    pub gi_equalization: f32,
    /// Multiplies the base colour.
    pub base_map: ToonMap,
    /// Multiplies the shade colour.
    pub shade_map: ToonMap,
    /// Moves the border.
    pub shift_map: ToonMap,
    /// Multiplies rim and matcap.
    pub rim_map: ToonMap,
    /// Multiplies the light that the surface gives off.
    pub emissive_map: ToonMap,
    /// The matcap, looked up by the normal in the picture.
    pub matcap_map: ToonMap,
}

/// A picture of a toon material.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub struct ToonMap {
    /// Where its header starts in the texture store, or [`NONE`].
    pub texture: u32,
    /// What turns the coordinates of vertices into its own: two rows of factors on u and v and what is added.
    pub lay: [f32; 6],
}

impl ToonMap {
    /// No picture.
    pub const EMPTY: Self = Self {
        texture: NONE,
        lay: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
    };

    /// Coordinates of the picture at those of the vertices.
    pub fn uv(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        let [a, b, c, d, e, f] = self.lay;
        [a * u + b * v + c, d * u + e * v + f]
    }

    /// Its colour where the vertices' coordinates are `uvs[0]`, and those to the right and below the other two; white
    /// without a picture.
    fn color(&self, texels: &[u32], uvs: [[f32; 2]; 3]) -> [f32; 3] {
        if self.texture == NONE {
            return [1.0; 3];
        }
        let uvs = uvs.map(|uv| self.uv(uv));
        let [r, g, b, _] = texture::sample(texels, self.texture, uvs[0], footprint(uvs));
        [r, g, b]
    }
}

/// Words of a toon material, and where its values and pictures start among them.
pub const TOON_WORDS: usize = 65;
const TOON_SHADE: usize = 0;
const TOON_RIM: usize = 4;
const TOON_MATCAP: usize = 8;
const TOON_EMISSIVE: usize = 12;
const TOON_OUTLINE: usize = 16;
const TOON_SHIFT: usize = 20;
const TOON_MAPS: usize = 23;
const TOON_MATCAP_MAP: usize = 58;

/// Words of a picture's description, and how many pictures lie on the surface: one after the other in the order of
/// their fields.
const TOON_MAP_WORDS: usize = 7;
const TOON_LAID: usize = 5;

// Shaders count words where the twin names fields.
const _: () = {
    use std::mem::offset_of;
    assert!(size_of::<Toon>() == 4 * TOON_WORDS);
    assert!(offset_of!(Toon, shade_color) == 4 * TOON_SHADE);
    assert!(offset_of!(Toon, rim_color) == 4 * TOON_RIM);
    assert!(offset_of!(Toon, matcap_color) == 4 * TOON_MATCAP);
    assert!(offset_of!(Toon, emissive) == 4 * TOON_EMISSIVE);
    assert!(offset_of!(Toon, outline_color) == 4 * TOON_OUTLINE);
    assert!(offset_of!(Toon, shift) == 4 * TOON_SHIFT);
    assert!(size_of::<ToonMap>() == 4 * TOON_MAP_WORDS);
    assert!(offset_of!(Toon, base_map) == 4 * TOON_MAPS);
    assert!(offset_of!(Toon, shade_map) == 4 * (TOON_MAPS + TOON_MAP_WORDS));
    assert!(offset_of!(Toon, shift_map) == 4 * (TOON_MAPS + 2 * TOON_MAP_WORDS));
    assert!(offset_of!(Toon, rim_map) == 4 * (TOON_MAPS + 3 * TOON_MAP_WORDS));
    assert!(offset_of!(Toon, emissive_map) == 4 * (TOON_MAPS + 4 * TOON_MAP_WORDS));
    assert!(offset_of!(Toon, matcap_map) == 4 * (TOON_MAPS + TOON_LAID * TOON_MAP_WORDS));
    assert!(offset_of!(Toon, matcap_map) == 4 * TOON_MATCAP_MAP);
};

/// Least half width of the border, in cosines: a harder one has none.
const HARD: f32 = 1e-5;

/// How lit a surface is, 0..1, whose unit normal meets the direction to the light at cosine `n_dot_l`: a straight line
/// over the border [VRMC_materials_mtoon-1.0, lighting].
#[inline]
pub fn toon_shading(n_dot_l: f32, shift: f32, toony: f32) -> f32 {
    let half = (1.0 - toony).max(HARD);
    ((n_dot_l + shift + half) / (2.0 * half)).clamp(0.0, 1.0)
}

/// Strength of the rim, 0..1, of a surface that faces the eye at cosine `n_dot_v`.
#[inline]
pub fn toon_rim(n_dot_v: f32, lift: f32, power: f32) -> f32 {
    let base = (1.0 - n_dot_v + lift).clamp(0.0, 1.0);
    if base <= 0.0 {
        return 0.0;
    }
    math::powf(base, power)
}

/// Where a matcap is looked up: by a unit normal and the unit vector to the eye, both in the camera's axes.
fn matcap_uv(normal: [f32; 3], eye: [f32; 3]) -> [f32; 2] {
    let x = unit_or_z([eye[2], 0.0, -eye[0]]);
    let y = [
        eye[1] * x[2] - eye[2] * x[1],
        eye[2] * x[0] - eye[0] * x[2],
        eye[0] * x[1] - eye[1] * x[0],
    ];
    [0.5 + 0.5 * dot(x, normal), 0.5 - 0.5 * dot(y, normal)]
}

/// What of a toon material is looked up in pictures, at one place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ToonPaint {
    /// Colours in light and in shade.
    base: [f32; 3],
    shade: [f32; 3],
    shift: f32,
    /// Factor on rim and matcap.
    rim: [f32; 3],
    emissive: [f32; 3],
}

fn times(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|i| a[i] * b[i])
}

fn mixed(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

impl Layers<'_> {
    /// The toon material of a part, which has one.
    fn toon_of(&self, part: &Part) -> &Toon {
        let start = part.toon as usize;
        bytemuck::from_bytes(bytemuck::cast_slice(
            &self.texels[start..start + TOON_WORDS],
        ))
    }

    /// What a toon material's pictures show in the middle of some samples.
    pub(crate) fn toon_paint(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        px: [f32; 2],
    ) -> ToonPaint {
        let [x, y] = px;
        let around = [[x, y], [x + 1.0, y], [x, y + 1.0]];
        let weights = around.map(|px| weights_at(corners.clip, self.view.ndc_at(px)));
        self.toon_paint_at(triangle, part, weights)
    }

    /// The same where the corners have these weights, there, to the right and below.
    fn toon_paint_at(&self, triangle: &Triangle, part: &Part, weights: [[f32; 3]; 3]) -> ToonPaint {
        // Find the coordinates of the pictures. Vertices do not tint the base colour.
        let toon = self.toon_of(part);
        let vertices = triangle.corners.map(|v| &self.vertices[v as usize]);
        let uvs = weights.map(|weights| blend2(weights, vertices.map(|v| v.uv)));
        let [r, g, b, _] = part.base_color;
        let color = |map: &ToonMap| map.color(self.texels, uvs);

        // Look up the rest. The shift is a number, not light.
        let mut shift = toon.shift;
        if toon.shift_map.texture != NONE {
            let [red, _, _] = color(&toon.shift_map);
            shift += npr_core::color::srgb_from_linear(red) * toon.shift_scale;
        }
        ToonPaint {
            base: self.strengthened(times([r, g, b], color(&toon.base_map))),
            shade: self.strengthened(times(toon.shade_color, color(&toon.shade_map))),
            shift,
            rim: color(&toon.rim_map),
            emissive: times(toon.emissive, color(&toon.emissive_map)),
        }
    }

    /// Light of a toon at `world` with the normal `normal`, in the shadow of the lights in `dark`, that sees `open` of
    /// the sky. O(lights).
    pub(crate) fn toon_light(
        &self,
        part: &Part,
        paint: &ToonPaint,
        (world, normal): ([f32; 3], [f32; 3]),
        dark: u32,
        open: Openness,
    ) -> [f32; 3] {
        // Add up the lights: each shows base or shade colour, and a sky the base colour.
        let toon = self.toon_of(part);
        let (mut sum, mut lighting) = ([0.0; 3], [0.0; 3]);
        let lights = &self.lights.sources[..self.lights.count as usize];
        for (i, source) in lights.iter().enumerate() {
            let (light, color) = if source.kind == LightSource::SKY {
                (self.toon_sky(toon, source, normal, open), paint.base)
            } else {
                let (towards, strength) = source.reach_at(world);
                let is_dark = (dark >> i) & 1 != 0;
                let shading = match is_dark {
                    true => 0.0,
                    false => toon_shading(dot(normal, towards), paint.shift, toon.toony),
                };
                let light = source.color.map(|c| c * strength);
                (light, mixed(paint.shade, paint.base, shading))
            };
            sum = std::array::from_fn(|k| sum[k] + color[k] * light[k]);
            lighting = std::array::from_fn(|k| lighting[k] + light[k]);
        }

        // Add rim and matcap, and what the surface gives off.
        let eye = self.view.to_eye(world);
        let rim = toon_rim(dot(normal, eye), toon.rim_lift, toon.rim_power);
        let mut added = toon.rim_color.map(|c| c * rim);
        if toon.matcap_map.texture != NONE {
            let axes = self.compose.axes();
            let in_view = |v: [f32; 3]| axes.map(|axis| dot(v, axis));
            let uv = toon.matcap_map.uv(matcap_uv(in_view(normal), in_view(eye)));
            let [r, g, b, _] = texture::sample(self.texels, toon.matcap_map.texture, uv, 0.0);
            let matcap = times(toon.matcap_color, [r, g, b]);
            added = std::array::from_fn(|k| added[k] + matcap[k]);
        }
        let added = times(
            times(added, paint.rim),
            mixed([1.0; 3], lighting, toon.rim_mix),
        );
        std::array::from_fn(|k| sum[k] + added[k] + paint.emissive[k])
    }

    /// Light of a sky, equalised as far as the material asks for.
    fn toon_sky(
        &self,
        toon: &Toon,
        source: &LightSource,
        normal: [f32; 3],
        open: Openness,
    ) -> [f32; 3] {
        let towards = |normal: [f32; 3]| self.lights.sky_light(source, normal, open).color;
        let (above, below) = (towards([0.0, 1.0, 0.0]), towards([0.0, -1.0, 0.0]));
        let even = std::array::from_fn(|k| (above[k] + below[k]) * 0.5);
        mixed(towards(normal), even, toon.gi_equalization)
    }

    /// Light of a toon's outline on its hull at a place.
    pub(crate) fn toon_outline(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        place: &LinePoint,
    ) -> [f32; 3] {
        let toon = self.toon_of(part);
        if toon.outline_mix == 0.0 {
            return toon.outline_color;
        }
        let around = [
            place.weights(self.view, corners, 0.0, 0.0),
            place.weights(self.view, corners, 1.0, 0.0),
            place.weights(self.view, corners, 0.0, 1.0),
        ];
        let paint = self.toon_paint_at(triangle, part, around);
        // Hulls show the backs of faces, but their outline is at the front.
        let normal = corners.normal(around[0]).map(|v| v * corners.side);
        let at = (corners.world(around[0]), normal);
        let light = self.toon_light(part, &paint, at, 0, Openness::FULL);
        times(toon.outline_color, mixed([1.0; 3], light, toon.outline_mix))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The oracle is the formula of the specification: a linear step between -1 + toony and 1 - toony.
    #[test]
    fn the_border_lies_where_the_specification_says() {
        for (n_dot_l, shift, toony, wanted) in [
            (0.0, 0.0, 0.9, 0.5),
            (0.1, 0.0, 0.9, 1.0),
            (-0.1, 0.0, 0.9, 0.0),
            (0.05, 0.0, 0.9, 0.75),
            (0.0, 0.3, 0.0, 0.65),
            (-0.3, 0.3, 1.0, 0.5),
            (-0.301, 0.3, 1.0, 0.0),
            (-0.299, 0.3, 1.0, 1.0),
        ] {
            let got = toon_shading(n_dot_l, shift, toony);
            assert!(
                (got - wanted).abs() < 1e-4,
                "{n_dot_l} {shift} {toony}: {got}"
            );
        }
    }

    #[test]
    fn a_matcap_is_looked_up_by_the_normal_in_the_picture() {
        let ahead = [0.0, 0.0, 1.0];
        assert_eq!(matcap_uv(ahead, ahead), [0.5, 0.5]);
        let up = matcap_uv([0.0, 1.0, 0.0], ahead);
        let right = matcap_uv([1.0, 0.0, 0.0], ahead);
        assert_eq!((up, right), ([0.5, 0.0], [1.0, 0.5]));
    }

    proptest! {
        #[test]
        fn more_light_is_never_darker(a in -1f32..1.0, more in 0f32..1.0, shift in -1f32..1.0, toony in 0f32..=1.0) {
            let (less, more) = (toon_shading(a, shift, toony), toon_shading(a + more, shift, toony));
            prop_assert!(less <= more && (0.0..=1.0).contains(&less));
        }

        #[test]
        fn rims_widen_with_their_lift(cosine in -1f32..1.0, lift in 0f32..1.0, power in 0.1f32..20.0) {
            let (plain, lifted) = (toon_rim(cosine, 0.0, power), toon_rim(cosine, lift, power));
            prop_assert!(plain <= lifted && (0.0..=1.0).contains(&plain));
        }
    }
}
