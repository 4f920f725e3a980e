//! Colour of one triangle under a pixel: the shading half of `shade.compose_frame`.
//!
//! A triangle that lies in one tone and has neither texture nor vertex colours has one colour all over, found
//! once a frame; the others are shaded at the samples.

use crate::compose::Layers;
use crate::inking::ink_over;
use crate::paint::LUMA;
use crate::ramp::{ramp_coordinate, ramp_light};
use npr_core::geometry::{NONE, Part, PosedVertex, Triangle, Vertex};
use npr_core::raster::{HULL_BIT, ID_MASK};
use npr_core::surface::{blend2, blend3, dot, faces_eye, unit_or_z, weights_at};
use npr_core::texture;
use rayon::prelude::*;

/// How far beside the tones of its corners a flat triangle's tone may lie, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;

/// A triangle's corners, and 1 where its front is seen or -1 where its back is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corners<'a> {
    pub posed: [&'a PosedVertex; 3],
    pub clip: [[f32; 4]; 3],
    pub side: f32,
}

impl Corners<'_> {
    pub fn normal(&self, weights: [f32; 3]) -> [f32; 3] {
        unit_or_z(blend3(weights, self.posed.map(|v| v.normal))).map(|v| v * self.side)
    }

    pub fn world(&self, weights: [f32; 3]) -> [f32; 3] {
        blend3(weights, self.posed.map(|v| v.world))
    }
}

/// Marks the colour of a triangle that has it all over.
pub(crate) const WHOLE: f32 = 1.0;

/// Marks the colour of a triangle that is lit alike all over, but not inked alike.
pub(crate) const LIT: f32 = 2.0;

/// A lit surface under so much ink, 0..1.
fn inked(part: &Part, lit: [f32; 3], share: f32) -> [f32; 3] {
    let ink = part.ink_color;
    std::array::from_fn(|i| lit[i] + (ink[i] - lit[i]) * (share * ink[3]))
}

/// What light and ink make of a surface.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Tone {
    /// What its colour is multiplied by.
    light: [f32; 3],
    /// How much of it is inked, 0..1.
    ink: f32,
}

/// What is the same all over a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Even {
    /// What its colour is multiplied by.
    light: [f32; 3],
    /// How much of it is inked, 0..1, where that is the same too.
    ink: Option<f32>,
}

/// Ink of a surface, summed over samples: where no shadow ends, all share that of the first.
#[derive(Debug, Clone, Copy)]
struct Inked {
    /// Lights whose shadow fell on the last sample, and its ink.
    dark: u32,
    last: f32,
    first: f32,
    mean: f32,
}

impl Inked {
    /// With one more of `count` samples, whose ink is that of the last one unless other shadows fall on it.
    fn with(before: Option<Self>, dark: u32, count: f32, ink_of: impl Fn() -> f32) -> Self {
        let Some(before) = before else {
            let ink = ink_of();
            return Self {
                dark,
                last: ink,
                first: ink,
                mean: ink,
            };
        };
        let last = if before.dark == dark {
            before.last
        } else {
            ink_of()
        };
        Self {
            dark,
            last,
            mean: before.mean + (last - before.first) / count,
            ..before
        }
    }
}

impl<'a> Layers<'a> {
    /// Colour of every triangle that has one colour all over, marked in alpha by [`WHOLE`], or by [`LIT`] where ink is still
    /// to come.
    pub(crate) fn even_colors(&self) -> Vec<[f32; 4]> {
        let even = |triangle| self.even_color(triangle).unwrap_or_default();
        self.triangles
            .par_iter()
            .with_min_len(1024)
            .map(even)
            .collect()
    }

    /// The colour of a triangle that lies in one tone and has neither texture nor vertex colours.
    fn even_color(&self, triangle: &Triangle) -> Option<[f32; 4]> {
        let part = &self.parts[triangle.part as usize];
        let white = |v: &u32| self.vertices[*v as usize].color | 0xff00_0000 == u32::MAX;
        let plain = part.flags & Part::PLAIN != 0;
        if !plain && (part.texture != NONE || !triangle.corners.iter().all(white)) {
            return None;
        }
        let even = self.one_light(part, &self.corners_of(triangle))?;
        let tone = Tone {
            light: even.light,
            ink: even.ink.unwrap_or_default(),
        };
        let [r, g, b, _] = part.base_color;
        let [r, g, b] = self.toned(part, [r, g, b], tone);
        Some([r, g, b, if even.ink.is_some() { WHOLE } else { LIT }])
    }

    /// A surface's colour in a tone, with the ink over it.
    fn toned(&self, part: &Part, color: [f32; 3], tone: Tone) -> [f32; 3] {
        let base = self.strengthened(color);
        inked(
            part,
            std::array::from_fn(|i| base[i] * tone.light[i]),
            tone.ink,
        )
    }

    /// The light of a triangle that is lit in one tone, and its ink where nothing in it is hatched.
    fn one_light(&self, part: &Part, corners: &Corners<'_>) -> Option<Even> {
        if part.flags & (Part::ANGLE | Part::HIGHLIGHTS) != 0 {
            return None;
        }
        if part.flags & (Part::UNLIT | Part::INK | Part::HATCH) == Part::UNLIT {
            return Some(Even {
                light: [1.0; 3],
                ink: Some(0.0),
            });
        }
        if self.lights.shadow_side != 0 {
            return None;
        }
        let range = self.coordinate_range(corners)?;
        let reach = part.softness * 0.5;
        let lit = part.flags & Part::UNLIT == 0;
        if lit
            && part.ramp[1..]
                .iter()
                .any(|stop| stop[3] > range[0] - reach && stop[3] <= range[1] + reach)
        {
            return None;
        }
        let normal = corners.posed[0].normal.map(|n| n * corners.side);
        Some(Even {
            light: self.light_of(part, corners.posed[0].world, normal, 0),
            ink: ink_over(part, range),
        })
    }

    /// Light of what the samples in `members` show, a triangle or its hull; `even` is the triangle's of
    /// [`even_colors`](Self::even_colors).
    pub(crate) fn shade(
        &self,
        id: u32,
        members: u32,
        frame_px: [f32; 2],
        even: [f32; 4],
    ) -> [f32; 3] {
        let triangle = &self.triangles[((id & ID_MASK) - 1) as usize];
        let part = &self.parts[triangle.part as usize];
        let [line_r, line_g, line_b, _] = self.linear_of(part.line_color);
        let line = [line_r, line_g, line_b];
        if id & HULL_BIT != 0 {
            return line;
        }
        let count = members.count_ones() as f32;
        let samples = (0..4).filter(|i| members & (1 << i) != 0);
        let mut center = frame_px;
        for i in samples.clone() {
            let offset = self.sample_offset(i);
            center = [center[0] + offset[0] / count, center[1] + offset[1] / count];
        }
        let corners = self.corners_of(triangle);
        let [r, g, b, mark] = even;
        if mark == WHOLE {
            return [r, g, b];
        }
        if mark == LIT {
            return inked(part, [r, g, b], self.ink_at(id, part, &corners, center, 0));
        }
        let color = self.plain_color(triangle, part, &corners, center);
        if let Some(even) = self.one_light(part, &corners) {
            let tone = Tone {
                light: even.light,
                ink: even
                    .ink
                    .unwrap_or_else(|| self.ink_at(id, part, &corners, center, 0)),
            };
            return self.toned(part, color, tone);
        }
        let mut sum = [0.0; 7];
        let mut ink = None;
        for i in samples {
            let offset = self.sample_offset(i);
            let at = [frame_px[0] + offset[0], frame_px[1] + offset[1]];
            let weights = weights_at(corners.clip, self.view.ndc_at(at));
            let dark = self.shadowed(id, &corners, weights);
            let tone = self.tone_at(part, &corners, weights, dark);
            sum = std::array::from_fn(|k| sum[k] + tone[k] / count);
            ink = Some(Inked::with(ink, dark, count, || {
                self.even_ink(part, &corners, dark)
                    .unwrap_or_else(|| self.ink_at(id, part, &corners, center, dark))
            }));
        }
        let tone = Tone {
            light: [sum[0], sum[1], sum[2]],
            ink: ink.map_or(0.0, |ink| ink.mean),
        };
        let color = self.toned(part, color, tone);
        std::array::from_fn(|i| {
            let lit = color[i] + sum[4 + i];
            lit + (line[i] - lit) * sum[3]
        })
    }

    /// Ink of a triangle that has the same all over, inside the shadow of the lights in `dark` or outside it: so a shadow
    /// changes nothing beside it. Without shadows [`Layers::one_light`] has asked before.
    fn even_ink(&self, part: &Part, corners: &Corners<'_>, dark: u32) -> Option<f32> {
        if self.lights.shadow_side == 0 {
            return None;
        }
        let range = self.coordinate_range(corners)?;
        let most = if dark != 0 {
            self.lights.shadow_at
        } else {
            1.0
        };
        ink_over(part, range.map(|x| x.min(most)))
    }

    /// Position of sample `i` within a pixel, from its centre.
    pub(crate) fn sample_offset(&self, i: u32) -> [f32; 2] {
        if self.compose.samples == 1 {
            return [0.0; 2];
        }
        [(i & 1) as f32 * 0.5 - 0.25, (i >> 1) as f32 * 0.5 - 0.25]
    }

    pub(crate) fn corners_of(&self, triangle: &Triangle) -> Corners<'a> {
        let posed = triangle.corners.map(|v| &self.posed[v as usize]);
        let clip = posed.map(|v| v.clip);
        Corners {
            posed,
            clip,
            side: if faces_eye(clip) { 1.0 } else { -1.0 },
        }
    }

    /// Tone at one point: rgb light, 1 where the surface-angle method draws a line, and rgb highlights.
    fn tone_at(
        &self,
        part: &Part,
        corners: &Corners<'_>,
        weights: [f32; 3],
        dark: u32,
    ) -> [f32; 7] {
        let (normal, world) = (corners.normal(weights), corners.world(weights));
        let light = self.light_of(part, world, normal, dark);
        let grazing = part.flags & Part::ANGLE != 0
            && dot(normal, self.view.to_eye(world)).abs() < part.facing_threshold;
        let ink = if grazing { 1.0 } else { 0.0 };
        let gloss = if part.flags & Part::HIGHLIGHTS != 0 {
            self.highlights_at(part, world, normal, dark)
        } else {
            [0.0; 3]
        };
        [
            light[0], light[1], light[2], ink, gloss[0], gloss[1], gloss[2],
        ]
    }

    /// Light on a surface at `world` that faces along `normal` and lies in the shadow of the lights in `dark`.
    fn light_of(&self, part: &Part, world: [f32; 3], normal: [f32; 3], dark: u32) -> [f32; 3] {
        if part.flags & Part::UNLIT != 0 {
            return [1.0; 3];
        }
        let (x, color) = self.lights.coordinate_at(world, normal, dark);
        let levels = bytemuck::cast_slice(&part.ramp);
        let light = ramp_light(levels, part.softness, x);
        std::array::from_fn(|i| light[i] * color[i])
    }

    /// Lowest and highest ramp coordinate that a triangle can have anywhere, where the normal alone decides.
    fn coordinate_range(&self, corners: &Corners<'_>) -> Option<[f32; 2]> {
        let towards = self.lights.only_distant()?;
        let at = corners
            .posed
            .map(|v| ramp_coordinate(dot(v.normal, towards) * corners.side));
        // A blend of normals that is made unit again bulges beyond them by at most what they differ.
        let [a, b, c] = corners.posed.map(|v| v.normal);
        let bulge = 0.5 * (1.0 - dot(a, b).min(dot(b, c)).min(dot(c, a)));
        let room = TONE_ROOM + bulge;
        Some([
            at[0].min(at[1]).min(at[2]) - room,
            at[0].max(at[1]).max(at[2]) + room,
        ])
    }

    /// A colour as strong as the style wants it.
    fn strengthened(&self, color: [f32; 3]) -> [f32; 3] {
        let saturation = self.compose.saturation;
        if saturation == 1.0 {
            return color;
        }
        let luma = dot(color, LUMA);
        color.map(|v| (luma + (v - luma) * saturation).max(0.0))
    }

    /// Surface colour without light.
    fn plain_color(
        &self,
        triangle: &Triangle,
        part: &Part,
        corners: &Corners<'_>,
        frame_px: [f32; 2],
    ) -> [f32; 3] {
        let vertices = triangle.corners.map(|v| &self.vertices[v as usize]);
        let [r, g, b, _] = part.base_color;
        if part.flags & Part::PLAIN != 0 {
            return [r, g, b];
        }
        let weights = weights_at(corners.clip, self.view.ndc_at(frame_px));
        let tint = self.tint(weights, vertices);
        let color = [r * tint[0], g * tint[1], b * tint[2]];
        if part.texture == NONE {
            return color;
        }
        let uvs = vertices.map(|v| v.uv);
        let uv_near = |dx: f32, dy: f32| {
            blend2(
                weights_at(
                    corners.clip,
                    self.view.ndc_at([frame_px[0] + dx, frame_px[1] + dy]),
                ),
                uvs,
            )
        };
        let (uv, right, down) = (blend2(weights, uvs), uv_near(1.0, 0.0), uv_near(0.0, 1.0));
        let covered = footprint([uv, right, down]);
        let texel = texture::sample(self.texels, part.texture, uv, covered);
        std::array::from_fn(|i| color[i] * texel[i])
    }

    /// Vertex colours of a triangle where its corners have these weights, linear light.
    pub(crate) fn tint(&self, weights: [f32; 3], vertices: [&Vertex; 3]) -> [f32; 3] {
        let color_of = |vertex: &Vertex| {
            let [r, g, b, _] = self.linear_texel(vertex.color);
            [r, g, b]
        };
        blend3(weights, vertices.map(color_of))
    }
}

/// How far a pixel reaches in coordinates of a texture that are `uv` there, and what they are to the right and below.
pub(crate) fn footprint([uv, right, down]: [[f32; 2]; 3]) -> f32 {
    let square = |there: [f32; 2]| (there[0] - uv[0]).powi(2) + (there[1] - uv[1]).powi(2);
    square(right).max(square(down)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose::Compose;
    use crate::lighting::Lights;
    use npr_core::window::{View, Window};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn a_triangle_of_one_tone_has_it_everywhere(
            normals in prop::array::uniform3(prop::array::uniform3(-1f32..1.0)),
            light in prop::array::uniform3(-1f32..1.0),
            at in prop::array::uniform3(0.05f32..0.95),
            weights in prop::array::uniform3(0.01f32..1.0),
        ) {
            let mut part = Part { texture: NONE, base_color: [1.0; 4], ..Part::default() };
            let mut steps = at;
            steps.sort_by(f32::total_cmp);
            part.ramp = [[1.0, 1.0, 1.0, 2.0]; 8];
            for (row, (i, step)) in part.ramp.iter_mut().zip([0.0].iter().chain(&steps).enumerate()) {
                *row = [i as f32, i as f32, i as f32, *step];
            }
            let posed = normals.map(|normal| PosedVertex { normal: unit_or_z(normal), ..PosedVertex::default() });
            let triangle = Triangle { corners: [0, 1, 2], part: 0 };
            let compose = Compose { saturation: 1.0, ..Compose::default() };
            let layers = Layers {
                view: &View::default(), window: &Window::default(), compose: &compose, lights: &Lights::distant(unit_or_z(light)),
                 ids: &[], beam_ids: &[], ribbons: &[], posed: &posed, vertices: &[Vertex::default(); 3],
                triangles: &[triangle], parts: &[part], texels: &[], charts: &[], overlay: &[], shadows: [&[]; 4],
            };
            let corners = layers.corners_of(&triangle);
            if let Some(one) = layers.one_light(&part, &corners) {
                let sum: f32 = weights.iter().sum();
                let inside = layers.light_of(&part, [0.0; 3], corners.normal(weights.map(|w| w / sum)), 0);
                prop_assert_eq!(one.light, inside);
            }
        }
    }
}
