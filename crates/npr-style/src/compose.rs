//! Surfaces shaded by their ramps, lines over them, background behind: the twin of `shade.compose_frame`.

use bytemuck::{Pod, Zeroable};
use npr_core::color::{SrgbEncoder, pack_rgba8};
use npr_core::geometry::{NONE, Part, PosedVertex, Triangle, Vertex};
use npr_core::gpu_layout;
use npr_core::outline::MASK_KINDS;
use npr_core::raster::{HULL_BIT, ID_MASK};
use npr_core::surface::{blend2, blend3, dot, faces_eye, unit_or_z, weights_at};
use npr_core::texture;
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// Settings of the last pass.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Compose {
    /// Unit vector towards the light, in the world.
    pub light_world: [f32; 3],
    /// Samples per pixel along each axis, 1 or 2.
    pub samples: u32,
    /// Background colour, linear light, straight alpha.
    pub background: [f32; 4],
    /// Colour of lines drawn straight from the mask, sRGB, straight alpha.
    pub line_color: [f32; 4],
    /// Header of the background texture, or [`NONE`].
    pub background_texture: u32,
    /// Bits of [`Compose::MASK`] to [`Compose::STAMPS`].
    pub flags: u32,
    /// Strength of surface colours: 0 grey, 1 as they are.
    pub saturation: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: u32,
}
gpu_layout!(Compose {
    light_world,
    samples,
    background,
    line_color,
    background_texture,
    flags,
    saturation,
    unused,
});

impl Compose {
    /// Draws the mask itself: the image filter.
    pub const MASK: u32 = 1;
    /// Draws surfaces that turn from the eye as lines.
    pub const ANGLE: u32 = 2;
    /// Lays the ribbons over the surfaces.
    pub const RIBBONS: u32 = 4;
    /// Lays the stamps over the surfaces.
    pub const STAMPS: u32 = 8;
}

/// How far beside the tones of its corners a flat triangle's tone may lie, in ramp coordinate: rounding.
const TONE_ROOM: f32 = 0.002;

/// Share of each channel in luminance [ITU-R BT.709].
const LUMA: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// What a frame is composed from.
#[derive(Debug, Clone, Copy)]
pub struct Layers<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of the output.
    pub window: &'a Window,
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// Settings.
    pub compose: &'a Compose,
    /// Triangle numbers, `samples` times the output's size each way.
    pub ids: &'a [u32],
    /// Ribbons, sRGB bytes with coverage in alpha.
    pub ribbons: &'a [u32],
    /// Posed vertices.
    pub posed: &'a [PosedVertex],
    /// Stored vertices.
    pub vertices: &'a [Vertex],
    /// Triangles.
    pub triangles: &'a [Triangle],
    /// Parts.
    pub parts: &'a [Part],
    /// The texture store.
    pub texels: &'a [u32],
    /// The mask.
    pub mask: &'a [u32],
    /// Stamps, sRGB bytes with coverage in alpha.
    pub stamped: &'a [u32],
}

/// Composes the output as sRGB bytes with straight alpha.
///
/// Every pixel has one or four samples that say which triangles it shows; each triangle is shaded once, at the middle of
/// its samples. Layers go over each other as in [Porter & Duff 1984], in linear light. O(pixels), parallel over rows.
pub fn compose(layers: &Layers<'_>, frame: &mut [u32]) {
    let encoder = SrgbEncoder::new();
    let evens = layers.even_colors();
    let width = layers.window.size[0] as usize;
    frame.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        let mut composer = Composer {
            layers,
            encoder: &encoder,
            evens: &evens,
            empty: layers.empty_texel(&encoder),
            last: (0, 0),
        };
        for (x, texel) in row.iter_mut().enumerate() {
            *texel = composer.texel(x as u32, y as u32);
        }
    });
}

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

/// Triangle numbers of a pixel's samples.
#[derive(Debug, Clone, Copy)]
struct Samples {
    ids: [u32; 4],
    count: usize,
}

impl std::ops::Deref for Samples {
    type Target = [u32];

    fn deref(&self) -> &[u32] {
        &self.ids[..self.count]
    }
}

/// Composes the pixels of a row.
struct Composer<'a> {
    layers: &'a Layers<'a>,
    encoder: &'a SrgbEncoder,
    /// Colour of every triangle that has one colour all over, marked by a 1 in alpha.
    evens: &'a [[f32; 4]],
    /// A pixel that shows nothing but a plain background.
    empty: Option<u32>,
    /// The last number whose single colour filled a pixel, and that pixel.
    last: (u32, u32),
}

impl Composer<'_> {
    /// A pixel of the output as sRGB bytes with straight alpha.
    fn texel(&mut self, x: u32, y: u32) -> u32 {
        let frame_px = self.layers.window.frame_at(x, y);
        let seen = self.layers.samples_of(x, y);
        let lines = self.layers.lines_at(x, y, frame_px);
        if lines == [0; 3] && seen.iter().all(|id| *id == seen[0]) {
            if let Some(texel) = self.even_texel(seen[0]) {
                return texel;
            }
        }
        let mut color = self.even_surfaces(&seen).unwrap_or_else(|| self.surfaces(&seen, frame_px));
        if color[3] < 1.0 {
            let behind = self.layers.background(frame_px);
            let left = 1.0 - color[3];
            color = std::array::from_fn(|i| color[i] + behind[i] * left);
        }
        for line in lines {
            if line >> 24 != 0 {
                color = over(self.layers.linear_texel(line), color);
            }
        }
        encoded(self.encoder, color)
    }

    /// The pixel that a single number fills, where that is of one colour.
    fn even_texel(&mut self, id: u32) -> Option<u32> {
        if id == 0 {
            return self.empty;
        }
        if self.last.0 != id {
            self.last = (id, encoded(self.encoder, self.even_color(id)?));
        }
        Some(self.last.1)
    }

    /// Colour of a triangle that has one colour all over.
    fn even_color(&self, id: u32) -> Option<[f32; 4]> {
        if id & HULL_BIT != 0 {
            return None;
        }
        Some(self.evens[(id - 1) as usize]).filter(|color| color[3] == 1.0)
    }

    /// The surfaces of a pixel, premultiplied, where each has one colour all over.
    fn even_surfaces(&self, seen: &[u32]) -> Option<[f32; 4]> {
        let share = 1.0 / seen.len() as f32;
        let mut sum = [0.0; 4];
        for id in seen.iter().filter(|id| **id != 0) {
            let color = self.even_color(*id)?;
            sum = std::array::from_fn(|i| sum[i] + color[i] * share);
        }
        Some(sum)
    }

    /// The surfaces of a pixel, premultiplied.
    fn surfaces(&self, seen: &[u32], frame_px: [f32; 2]) -> [f32; 4] {
        let count = seen.len();
        let mut sum = [0.0; 4];
        let mut left = (1u32 << count) - 1;
        for i in 0..count {
            if left & (1 << i) == 0 {
                continue;
            }
            let members = (i..count).filter(|j| seen[*j] == seen[i]).fold(0, |bits, j| bits | 1 << j);
            left &= !members;
            if seen[i] == 0 {
                continue;
            }
            let share = members.count_ones() as f32 / count as f32;
            let [r, g, b] = self.layers.shade(seen[i], members, frame_px);
            sum = [sum[0] + r * share, sum[1] + g * share, sum[2] + b * share, sum[3] + share];
        }
        sum
    }
}

/// Premultiplied linear light as sRGB bytes with straight alpha.
fn encoded(encoder: &SrgbEncoder, [r, g, b, a]: [f32; 4]) -> u32 {
    let [r, g, b] = [r, g, b].map(|light| encoder.byte(light / a.max(1e-6)));
    r | g << 8 | b << 16 | ((a.clamp(0.0, 1.0) * 255.0 + 0.5) as u32) << 24
}

impl<'a> Layers<'a> {
    /// A pixel that shows only the background, where that is of one colour.
    fn empty_texel(&self, encoder: &SrgbEncoder) -> Option<u32> {
        (self.compose.background_texture == NONE)
            .then(|| encoded(encoder, self.background([0.0; 2])))
    }

    /// The triangle numbers of a pixel's samples.
    fn samples_of(&self, x: u32, y: u32) -> Samples {
        let samples = self.compose.samples;
        let stride = self.window.size[0] * samples;
        let mut seen = Samples {
            ids: [0; 4],
            count: (samples * samples) as usize,
        };
        for i in 0..samples * samples {
            seen.ids[i as usize] =
                self.ids[((y * samples + (i >> 1)) * stride + x * samples + (i & 1)) as usize];
        }
        seen
    }

    /// The lines over a pixel, from the bottom: mask, ribbons, stamps; sRGB bytes with coverage in alpha.
    fn lines_at(&self, x: u32, y: u32, frame_px: [f32; 2]) -> [u32; 3] {
        let element = (y * self.window.size[0] + x) as usize;
        let flags = self.compose.flags;
        let masked = flags & Compose::MASK != 0 && self.is_masked(frame_px);
        [
            if masked {
                pack_rgba8(self.compose.line_color)
            } else {
                0
            },
            if flags & Compose::RIBBONS != 0 {
                self.ribbons[element]
            } else {
                0
            },
            if flags & Compose::STAMPS != 0 {
                self.stamped[element]
            } else {
                0
            },
        ]
    }

    fn is_masked(&self, frame_px: [f32; 2]) -> bool {
        let at = self.mask_window.pixel_at(frame_px);
        self.mask[(at[1] * self.mask_window.size[0] + at[0]) as usize] & MASK_KINDS != 0
    }

    /// Colour of every triangle that has one colour all over, marked by a 1 in alpha.
    fn even_colors(&self) -> Vec<[f32; 4]> {
        let even = |triangle| self.even_color(triangle).map_or([0.0; 4], |[r, g, b]| [r, g, b, 1.0]);
        self.triangles.par_iter().with_min_len(1024).map(even).collect()
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
    fn shade(&self, id: u32, members: u32, frame_px: [f32; 2]) -> [f32; 3] {
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
                let tone = self.tone_at(part, &corners, [frame_px[0] + offset[0], frame_px[1] + offset[1]]);
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
            ramp_light(part, self.ramp_coordinate(normal))
        }
    }

    /// The Lambert term mapped from -1..1 to 0..1 [Suzuki 2004, section 3.2].
    fn ramp_coordinate(&self, normal: [f32; 3]) -> f32 {
        (dot(normal, self.compose.light_world) + 1.0) * 0.5
    }

    /// Whether the whole triangle lies within one tone.
    fn is_one_tone(&self, part: &Part, corners: &Corners<'_>) -> bool {
        if part.flags & Part::UNLIT != 0 {
            return true;
        }
        let at = corners.posed.map(|v| self.ramp_coordinate(v.normal.map(|n| n * corners.side)));
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

    /// What lies behind everything, premultiplied.
    fn background(&self, frame_px: [f32; 2]) -> [f32; 4] {
        let mut color = self.compose.background;
        let at = self.compose.background_texture;
        if at != NONE {
            let size = [
                self.texels[at as usize] as f32,
                self.texels[at as usize + 1] as f32,
            ];
            let frame = self.view.frame_px;
            // Cover the frame, centred, like a poster that is cut at two sides.
            let zoom = (frame[0] / size[0]).max(frame[1] / size[1]);
            let uv =
                std::array::from_fn(|i| (frame_px[i] - 0.5 * frame[i]) / (size[i] * zoom) + 0.5);
            color = texture::sample(self.texels, at, uv, 1.0 / (size[0].max(size[1]) * zoom));
        }
        let [r, g, b, a] = color;
        [r * a, g * a, b * a, a]
    }

    fn linear_of(&self, srgb: [f32; 4]) -> [f32; 4] {
        self.linear_texel(pack_rgba8(srgb))
    }

    fn linear_texel(&self, texel: u32) -> [f32; 4] {
        texture::linear_texel(self.texels, texel)
    }
}

/// Light of a part's ramp at coordinate `x`: each step takes over where its coordinate begins, over `softness`.
pub fn ramp_light(part: &Part, x: f32) -> [f32; 3] {
    let [r, g, b, _] = part.ramp[0];
    let mut light = [r, g, b];
    for stop in &part.ramp[1..] {
        if stop[3] > 1.5 {
            break;
        }
        let share = step_share(stop[3], part.softness, x);
        light = std::array::from_fn(|i| light[i] + (stop[i] - light[i]) * share);
    }
    light
}

fn step_share(at: f32, softness: f32, x: f32) -> f32 {
    if softness <= 0.0 {
        return if x >= at { 1.0 } else { 0.0 };
    }
    let t = ((x - at) / softness + 0.5).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A straight-alpha layer laid over a premultiplied one.
fn over(top: [f32; 4], below: [f32; 4]) -> [f32; 4] {
    let a = top[3];
    if a == 0.0 {
        return below;
    }
    [
        top[0] * a + below[0] * (1.0 - a),
        top[1] * a + below[1] * (1.0 - a),
        top[2] * a + below[2] * (1.0 - a),
        a + below[3] * (1.0 - a),
    ]
}
