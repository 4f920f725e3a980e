//! Colour of one triangle under a pixel: the shading half of `shade.compose_frame`.
//!
//! A triangle that lies in one tone and has neither texture nor vertex colours has one colour all over, found
//! once a frame; the others are shaded at the samples.

use crate::compose::{Compose, Layers};
use crate::ramp::{ramp_coordinate, ramp_light};
use npr_core::geometry::{NONE, Part, PosedVertex, Triangle};
use npr_core::raster::{HULL_BIT, ID_MASK};
use npr_core::surface::{blend2, blend3, dot, faces_eye, unit_or_z, weights_at};
use npr_core::texture;
use rayon::prelude::*;

/// How far beside the tones of its corners a flat triangle's tone may lie, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;

/// Share of each channel in luminance [ITU-R BT.709].
const LUMA: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// A triangle's corners, and 1 where its front is seen or -1 where its back is.
#[derive(Debug, Clone, Copy)]
struct Corners<'a> {
    posed: [&'a PosedVertex; 3],
    clip: [[f32; 4]; 3],
    side: f32,
}

impl Corners<'_> {
    fn normal(&self, weights: [f32; 3]) -> [f32; 3] {
        unit_or_z(blend3(weights, self.posed.map(|v| v.normal))).map(|v| v * self.side)
    }
}

impl<'a> Layers<'a> {
    /// Colour of every triangle that has one colour all over, marked by a 1 in alpha.
    pub(crate) fn even_colors(&self) -> Vec<[f32; 4]> {
        let even = |triangle| {
            self.even_color(triangle)
                .map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0])
        };
        self.triangles
            .par_iter()
            .with_min_len(1024)
            .map(even)
            .collect()
    }

    /// The colour of a triangle that lies in one tone and has neither texture nor vertex colours.
    fn even_color(&self, triangle: &Triangle) -> Option<[f32; 3]> {
        let part = &self.parts[triangle.part as usize];
        let white = |v: &u32| self.vertices[*v as usize].color | 0xff00_0000 == u32::MAX;
        if part.texture != NONE || !triangle.corners.iter().all(white) {
            return None;
        }
        let light = self.one_tone(part, &self.corners_of(triangle))?;
        let [r, g, b, _] = part.base_color;
        let base = self.strengthened([r, g, b]);
        Some(std::array::from_fn(|i| base[i] * light[i]))
    }

    /// The light on a triangle that lies within one tone as a whole.
    fn one_tone(&self, part: &Part, corners: &Corners<'_>) -> Option<[f32; 3]> {
        let angle = self.compose.flags & Compose::ANGLE != 0;
        let one = !angle && self.is_one_tone(part, corners);
        one.then(|| self.light_of(part, corners.posed[0].normal.map(|n| n * corners.side)))
    }

    /// Light of what the samples in `members` show, a triangle or its hull.
    pub(crate) fn shade(&self, id: u32, members: u32, frame_px: [f32; 2]) -> [f32; 3] {
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
        let tone = match self.one_tone(part, &corners) {
            Some([r, g, b]) => [r, g, b, 0.0],
            None => samples.fold([0.0; 4], |sum, i| {
                let offset = self.sample_offset(i);
                let tone = self.tone_at(
                    part,
                    &corners,
                    [frame_px[0] + offset[0], frame_px[1] + offset[1]],
                );
                std::array::from_fn(|k| sum[k] + tone[k] / count)
            }),
        };
        let base = self.strengthened(self.plain_color(triangle, part, &corners, center));
        std::array::from_fn(|i| {
            let lit = base[i] * tone[i];
            lit + (line[i] - lit) * tone[3]
        })
    }

    /// Position of sample `i` within a pixel, from its centre.
    fn sample_offset(&self, i: u32) -> [f32; 2] {
        if self.compose.samples == 1 {
            return [0.0; 2];
        }
        [(i & 1) as f32 * 0.5 - 0.25, (i >> 1) as f32 * 0.5 - 0.25]
    }

    fn corners_of(&self, triangle: &Triangle) -> Corners<'a> {
        let posed = triangle.corners.map(|v| &self.posed[v as usize]);
        let clip = posed.map(|v| v.clip);
        Corners {
            posed,
            clip,
            side: if faces_eye(clip) { 1.0 } else { -1.0 },
        }
    }

    /// Tone and ink at one point: rgb light, and 1 where the surface-angle method draws a line.
    fn tone_at(&self, part: &Part, corners: &Corners<'_>, frame_px: [f32; 2]) -> [f32; 4] {
        let angle = self.compose.flags & Compose::ANGLE != 0 && part.flags & Part::LINES != 0;
        let weights = weights_at(corners.clip, self.view.ndc_at(frame_px));
        let normal = corners.normal(weights);
        let light = self.light_of(part, normal);
        let mut ink = 0.0;
        if angle {
            let world = blend3(weights, corners.posed.map(|v| v.world));
            if dot(normal, self.view.to_eye(world)).abs() < part.facing_threshold {
                ink = 1.0;
            }
        }
        [light[0], light[1], light[2], ink]
    }

    /// Light on a surface that faces along `normal`.
    fn light_of(&self, part: &Part, normal: [f32; 3]) -> [f32; 3] {
        if part.flags & Part::UNLIT != 0 {
            [1.0; 3]
        } else {
            ramp_light(
                bytemuck::cast_slice(&part.ramp),
                part.softness,
                self.coordinate(normal),
            )
        }
    }

    /// Place on the ramp of a surface that faces along `normal`.
    fn coordinate(&self, normal: [f32; 3]) -> f32 {
        ramp_coordinate(dot(normal, self.compose.light_world))
    }

    /// Whether the whole triangle lies within one tone.
    fn is_one_tone(&self, part: &Part, corners: &Corners<'_>) -> bool {
        if part.flags & Part::UNLIT != 0 {
            return true;
        }
        let at = corners
            .posed
            .map(|v| self.coordinate(v.normal.map(|n| n * corners.side)));
        // A blend of normals that is made unit again bulges beyond them by at most what they differ.
        let [a, b, c] = corners.posed.map(|v| v.normal);
        let bulge = 0.5 * (1.0 - dot(a, b).min(dot(b, c)).min(dot(c, a)));
        let room = TONE_ROOM + bulge + part.softness * 0.5;
        let low = at[0].min(at[1]).min(at[2]) - room;
        let high = at[0].max(at[1]).max(at[2]) + room;
        !part.ramp[1..]
            .iter()
            .any(|stop| stop[3] > low && stop[3] <= high)
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
        let weights = weights_at(corners.clip, self.view.ndc_at(frame_px));
        let tint = blend3(
            weights,
            vertices.map(|v| {
                let [r, g, b, _] = self.linear_texel(v.color);
                [r, g, b]
            }),
        );
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
        let square = |there: [f32; 2]| (there[0] - uv[0]).powi(2) + (there[1] - uv[1]).powi(2);
        let footprint = square(right).max(square(down)).sqrt();
        let texel = texture::sample(self.texels, part.texture, uv, footprint);
        std::array::from_fn(|i| color[i] * texel[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::geometry::Vertex;
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
            let compose = Compose { light_world: unit_or_z(light), saturation: 1.0, ..Compose::default() };
            let layers = Layers {
                view: &View::default(), window: &Window::default(), mask_window: &Window::default(),
                compose: &compose, ids: &[], ribbons: &[], posed: &posed, vertices: &[Vertex::default(); 3],
                triangles: &[triangle], parts: &[part], texels: &[], mask: &[], stamped: &[],
            };
            let corners = layers.corners_of(&triangle);
            if let Some(one) = layers.one_tone(&part, &corners) {
                let sum: f32 = weights.iter().sum();
                let inside = layers.light_of(&part, corners.normal(weights.map(|w| w / sum)));
                prop_assert_eq!(one, inside);
            }
        }
    }
}
