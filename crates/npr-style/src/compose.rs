//! Surfaces shaded by their ramps, lines over them, background behind: the twin of `shade.compose_frame`.

use bytemuck::{Pod, Zeroable};
use npr_core::color::{SrgbEncoder, pack_rgba8};
use npr_core::geometry::{ChartCorners, NONE, Part, PosedVertex, Triangle, Vertex};
use npr_core::gpu_layout;
use npr_core::raster::{HULL_BIT, ID_MASK};
use npr_core::texture;
use npr_core::window::{View, Window};
use rayon::prelude::*;
use std::ops::Range;

use crate::backdrop::{self, Minding, Rules};
use crate::known::Known;
use crate::lighting::Lights;
use crate::line_color::LinePlace;
use crate::shadow::SHADOWS_MAX;
use crate::tone::Corners;

/// Share of each channel in luminance [ITU-R BT.709].
pub const LUMA: [f32; 3] = [0.2126, 0.7152, 0.0722];

/// Settings of the last pass.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Compose {
    /// Background colour, linear light, straight alpha.
    pub background: [f32; 4],
    /// Colour of lines drawn straight from the mask, sRGB, straight alpha.
    pub line_color: [f32; 4],
    /// Header of the background texture, or [`NONE`].
    pub background_texture: u32,
    /// Bits of [`Compose::RIBBONS`] to [`Compose::SMOKE_PEN`].
    pub flags: u32,
    /// Strength of surface colours: 0 grey, 1 as they are.
    pub saturation: f32,
    /// Samples per pixel along each axis, 1 or 2.
    pub samples: u32,
    /// Unit vector to the right of the picture, in the world: the axis of shaped highlights.
    pub right_world: [f32; 3],
    /// Texels along a side of the pictures that lights have of the smoke; 0 where it throws no shadow on surfaces.
    pub smoke_shadow_side: u32,
    /// Unit vector towards the light behind, in the world.
    pub back_world: [f32; 3],
    /// Keeps rows of 16 bytes.
    pub unused_b: u32,
    /// Across streaks of gloss, in the world; as long as 1 / radius of the model.
    pub streak_world: [f32; 3],
    /// Keeps rows of 16 bytes.
    pub unused_c: u32,
    /// Middle of the model.
    pub center_world: [f32; 3],
    /// Number of the part whose ramp and ink finish the smoke, with [`Compose::SMOKE_PEN`].
    pub smoke_part: u32,
    /// Colour of the smoke's outline, linear light.
    pub smoke_line: [f32; 4],
    /// Where the sheet of the smoke's strokes hangs, in frame pixels.
    pub smoke_anchor_px: [f32; 2],
    /// Hatch tiles of that sheet to a frame pixel.
    pub smoke_tiles: f32,
    /// Keeps rows of 16 bytes.
    pub unused_d: u32,
}
gpu_layout!(Compose {
    background,
    line_color,
    background_texture,
    flags,
    saturation,
    samples,
    right_world,
    smoke_shadow_side,
    back_world,
    unused_b,
    streak_world,
    unused_c,
    center_world,
    smoke_part,
    smoke_line,
    smoke_anchor_px,
    smoke_tiles,
    unused_d,
});

impl Compose {
    /// Lays the ribbons over the surfaces.
    pub const RIBBONS: u32 = 1;
    /// Lays the overlay over the surfaces: stamps, or the mask itself.
    pub const OVERLAY: u32 = 2;
    /// Lays beams of light over the surfaces.
    pub const BEAMS: u32 = 4;
    /// Lays smoke over what it stands before.
    pub const SMOKE: u32 = 8;
    /// Finishes the smoke: its colours are tones and lines yet, see [`crate::smoke::pen`].
    pub const SMOKE_PEN: u32 = 16;
    /// Lines mind what lies behind them: [`Layers::fronts`] and [`Layers::backs`] say what that is.
    pub const BACKDROP: u32 = 64;
    /// The picture without any lines, and only in the tiles that [`Layers::fronts`] marks.
    pub const BARE: u32 = 128;
}

/// What a frame is composed from.
#[derive(Debug, Clone, Copy)]
pub struct Layers<'a> {
    /// Camera and frame.
    pub view: &'a View,
    /// The pixel grid of the output.
    pub window: &'a Window,
    /// Settings.
    pub compose: &'a Compose,
    /// What surfaces are lit by.
    pub lights: &'a Lights,
    /// Triangle numbers, `samples` times the output's size each way.
    pub ids: &'a [u32],
    /// Triangle numbers of beams, on the same grid; not read without beams.
    pub beam_ids: &'a [u32],
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
    /// Stroke charts, a triangle each; may be shorter where no part uses them.
    pub charts: &'a [ChartCorners],
    /// Stamps or mask, sRGB bytes with coverage in alpha.
    pub overlay: &'a [u32],
    /// Triangle numbers as the lights with shadows see them, [`Lights::shadow_side`] texels square; not read where that is 0.
    pub shadows: [&'a [u32]; SHADOWS_MAX],
    /// Smoke, sRGB bytes with straight alpha; not read without smoke.
    pub smoke_colors: &'a [u32],
    /// Depth of the smoke and which samples it covers, see [`crate::smoke::resolve`].
    pub smoke_depths: &'a [u32],
    /// Reversed depths of the smoke as the lights with shadows see it, [`Compose::smoke_shadow_side`] texels square.
    pub smoke_shadows: [&'a [u32]; SHADOWS_MAX],
    /// The rules by which lines mind what lies behind them.
    pub rules: &'a Rules,
    /// With [`Compose::BACKDROP`] the subject's colour beside every line, see [`backdrop::spread_rims`]; with [`Compose::BARE`]
    /// a texel for every tile, see [`backdrop::flag_tiles`].
    pub fronts: &'a [u32],
    /// With [`Compose::BACKDROP`] the colour behind every line.
    pub backs: &'a [u32],
}

/// Composes the output as sRGB bytes with straight alpha.
///
/// Every pixel has one or four samples that say which triangles it shows; each triangle is shaded once, at the middle of
/// its samples. Layers go over each other as in [Porter & Duff 1984], in linear light. O(pixels), parallel over rows.
pub fn compose(layers: &Layers<'_>, frame: &mut [u32]) {
    let encoder = SrgbEncoder::new();
    let known = layers.known_triangles();
    let width = layers.window.size[0] as usize;
    let empty = layers.empty_texel(&encoder);
    let new = || Composer {
        layers,
        encoder: &encoder,
        known: &known,
        empty,
        last: (0, 0),
        near: None,
        minding: Minding::default(),
    };
    frame
        .par_chunks_mut(width)
        .enumerate()
        .for_each_init(new, |composer, (y, row)| {
            for left in (0..width).step_by(RUN) {
                let run = left..width.min(left + RUN);
                let texels = &mut row[run.clone()];
                if let Some(empty) = composer.empty
                    && layers.compose.flags & Compose::BARE == 0
                    && layers.is_bare(run, y)
                {
                    texels.fill(empty);
                    continue;
                }
                for (x, texel) in (left as u32..).zip(texels) {
                    *texel = match layers.is_left_out(x, y as u32) {
                        true => 0,
                        false => composer.texel(x, y as u32),
                    };
                }
            }
        });
}

/// Pixels in a row that are looked through together for anything but background.
const RUN: usize = 32;

/// Triangle numbers of a pixel's samples.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Samples {
    ids: [u32; 4],
    count: usize,
}

impl std::ops::Deref for Samples {
    type Target = [u32];

    fn deref(&self) -> &[u32] {
        &self.ids[..self.count]
    }
}

/// Composes the pixels of some rows.
struct Composer<'a> {
    layers: &'a Layers<'a>,
    encoder: &'a SrgbEncoder,
    /// What is known of every triangle.
    known: &'a [Known],
    /// A pixel that shows nothing but a plain background.
    empty: Option<u32>,
    /// The last number whose single colour filled a pixel, and that pixel.
    last: (u32, u32),
    /// The triangle that was shaded last, and its corners: mostly that of the next pixel too.
    near: Option<(u32, Corners<'a>)>,
    minding: Minding,
}

impl<'a> Composer<'a> {
    /// A pixel of the output as sRGB bytes with straight alpha.
    fn texel(&mut self, x: u32, y: u32) -> u32 {
        let frame_px = self.layers.window.frame_at(x, y);
        let seen = self.layers.samples_of(x, y);
        let lines = self.layers.lines_at(x, y);
        let beams = self.layers.beams_of(x, y);
        if lines == [0; 2]
            && beams.iter().all(|id| *id == 0)
            && let Some(texel) = self.layers.smoke_alone(x, y, &seen)
        {
            return texel;
        }
        let veil = self.layers.veil_of(x, y, &seen, frame_px);
        let is_one = seen.iter().all(|id| *id == seen[0]);
        let is_bare = lines == [0; 2] && veil.is_none() && beams.iter().all(|id| *id == 0);
        if is_one
            && is_bare
            && let Some(texel) = self.even_texel(seen[0])
        {
            return texel;
        }
        let hidden = veil.map_or([0.0; 4], |veil| veil.hidden);
        let mut color = if is_one && seen[0] != 0 && veil.is_none() {
            let [r, g, b] = self.surface(seen[0], (1 << seen.len()) - 1, frame_px);
            [r, g, b, 1.0]
        } else {
            self.even_surfaces(&seen, &hidden)
                .unwrap_or_else(|| self.surfaces(&seen, &hidden, frame_px))
        };
        if let Some(veil) = &veil {
            veil.add_to(&mut color, seen.len());
        }
        if color[3] < 1.0 {
            let behind = self.layers.background(frame_px);
            let left = 1.0 - color[3];
            color = std::array::from_fn(|i| color[i] + behind[i] * left);
        }
        let covered = self
            .layers
            .add_beams(&seen, &beams, veil.as_ref(), frame_px, &mut color);
        let faded = match &veil {
            Some(veil) if lines != [0; 2] => veil.line_fade(self.layers, [x, y], frame_px),
            _ => 0.0,
        };
        for line in lines {
            if line >> 24 != 0 {
                let [r, g, b, a] = self.layers.linear_texel(line);
                let [r, g, b] = self.layers.minded(&mut self.minding, [r, g, b], frame_px);
                let a = a * (1.0 - covered) * (1.0 - faded);
                color = over([r, g, b, a], color);
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
        let [r, g, b] = self.known[(id - 1) as usize].whole()?;
        Some([r, g, b, 1.0])
    }

    /// The surfaces of a pixel, premultiplied, where each has one colour all over.
    fn even_surfaces(&self, seen: &[u32], hidden: &[f32; 4]) -> Option<[f32; 4]> {
        let mut sum = [0.0; 4];
        for (id, hidden) in seen.iter().zip(hidden).filter(|(id, _)| **id != 0) {
            let share = (1.0 - hidden) / seen.len() as f32;
            let color = self.even_color(*id)?;
            sum = std::array::from_fn(|i| sum[i] + color[i] * share);
        }
        Some(sum)
    }

    /// The surfaces of a pixel, premultiplied.
    fn surfaces(&mut self, seen: &[u32], hidden: &[f32; 4], frame_px: [f32; 2]) -> [f32; 4] {
        let count = seen.len();
        let mut sum = [0.0; 4];
        let mut left = (1u32 << count) - 1;
        for i in 0..count {
            if left & (1 << i) == 0 {
                continue;
            }
            let members = (i..count)
                .filter(|j| seen[*j] == seen[i])
                .fold(0, |bits, j| bits | 1 << j);
            left &= !members;
            if seen[i] == 0 {
                continue;
            }
            let shown = (i..count)
                .filter(|j| members & (1 << j) != 0)
                .map(|j| 1.0 - hidden[j])
                .sum::<f32>();
            if shown == 0.0 {
                continue;
            }
            let share = shown / count as f32;
            let [r, g, b] = self.surface(seen[i], members, frame_px);
            sum = [
                sum[0] + r * share,
                sum[1] + g * share,
                sum[2] + b * share,
                sum[3] + share,
            ];
        }
        sum
    }

    /// Light of what the samples in `members` show, a triangle or its hull.
    fn surface(&mut self, id: u32, members: u32, frame_px: [f32; 2]) -> [f32; 3] {
        let index = ((id & ID_MASK) - 1) as usize;
        if id & HULL_BIT != 0 {
            let triangle = &self.layers.triangles[index];
            let part = &self.layers.parts[triangle.part as usize];
            let corners = self.layers.corners_of(triangle);
            let place = LinePlace {
                px: frame_px,
                step_px: [1.0; 2],
                is_hull: true,
            };
            let line = self.layers.line_light(triangle, part, &corners, &place);
            return self.layers.minded(&mut self.minding, line, frame_px);
        }
        let known = &self.known[index];
        if let Some(color) = known.whole() {
            return color;
        }
        let corners = self.corners(id);
        self.layers.shade(id, members, frame_px, known, &corners)
    }

    /// The corners of a triangle.
    fn corners(&mut self, id: u32) -> Corners<'a> {
        match self.near {
            Some((near, corners)) if near == id => corners,
            _ => {
                let corners = self
                    .layers
                    .corners_of(&self.layers.triangles[(id - 1) as usize]);
                self.near = Some((id, corners));
                corners
            }
        }
    }
}

/// Premultiplied linear light as sRGB bytes with straight alpha.
#[inline]
fn encoded(encoder: &SrgbEncoder, [r, g, b, a]: [f32; 4]) -> u32 {
    let scale = a.max(1e-6);
    let [r, g, b] = if scale == 1.0 {
        [r, g, b]
    } else {
        [r, g, b].map(|light| light / scale)
    };
    let [r, g, b] = [r, g, b].map(|light| encoder.byte(light));
    r | g << 8 | b << 16 | ((a.clamp(0.0, 1.0) * 255.0 + 0.5) as u32) << 24
}

impl<'a> Layers<'a> {
    /// A pixel that shows only the background, where that is of one colour.
    fn empty_texel(&self, encoder: &SrgbEncoder) -> Option<u32> {
        (self.compose.background_texture == NONE)
            .then(|| encoded(encoder, self.background([0.0; 2])))
    }

    /// Whether some pixels of a row show nothing but the background.
    fn is_bare(&self, run: Range<usize>, y: usize) -> bool {
        let (width, samples) = (self.window.size[0] as usize, self.compose.samples as usize);
        let holds = |bit: u32| self.compose.flags & bit != 0;
        let pixels = y * width + run.start..y * width + run.end;
        let is_zero = |texels: &[u32], mask: u32| {
            texels.iter().fold(0, |all, texel| all | (texel & mask)) == 0
        };
        let is_free = |ids: &[u32]| {
            (y * samples..(y + 1) * samples).all(|row| {
                let start = row * width * samples;
                let texels = start + run.start * samples..start + run.end * samples;
                is_zero(&ids[texels], u32::MAX)
            })
        };
        let is_off = |bit: u32, texels: &[u32], mask: u32| {
            !holds(bit) || is_zero(&texels[pixels.clone()], mask)
        };
        is_free(self.ids)
            && (!holds(Compose::BEAMS) || is_free(self.beam_ids))
            && is_off(Compose::RIBBONS, self.ribbons, u32::MAX)
            && is_off(Compose::OVERLAY, self.overlay, u32::MAX)
            && is_off(
                Compose::SMOKE,
                self.smoke_depths,
                crate::smoke::resolve::MASK,
            )
    }

    /// The triangle numbers of the beams over a pixel's samples; zeros where there are none.
    fn beams_of(&self, x: u32, y: u32) -> Samples {
        if self.compose.flags & Compose::BEAMS == 0 {
            return Samples {
                ids: [0; 4],
                count: (self.compose.samples * self.compose.samples) as usize,
            };
        }
        self.samples_in(self.beam_ids, x, y)
    }

    /// The triangle numbers of a pixel's samples.
    fn samples_of(&self, x: u32, y: u32) -> Samples {
        self.samples_in(self.ids, x, y)
    }

    fn samples_in(&self, ids: &[u32], x: u32, y: u32) -> Samples {
        let samples = self.compose.samples;
        let stride = self.window.size[0] * samples;
        let mut seen = Samples {
            ids: [0; 4],
            count: (samples * samples) as usize,
        };
        for i in 0..samples * samples {
            seen.ids[i as usize] =
                ids[((y * samples + (i >> 1)) * stride + x * samples + (i & 1)) as usize];
        }
        seen
    }

    /// The lines over a pixel, from the bottom: ribbons, overlay; sRGB bytes with coverage in alpha.
    fn lines_at(&self, x: u32, y: u32) -> [u32; 2] {
        let element = (y * self.window.size[0] + x) as usize;
        let layer = |bit: u32, texels: &[u32]| {
            if self.compose.flags & bit != 0 {
                texels[element]
            } else {
                0
            }
        };
        [
            layer(Compose::RIBBONS, self.ribbons),
            layer(Compose::OVERLAY, self.overlay),
        ]
    }

    /// Whether a pixel of the picture without lines is not needed.
    fn is_left_out(&self, x: u32, y: u32) -> bool {
        if self.compose.flags & Compose::BARE == 0 {
            return false;
        }
        let across = backdrop::tiles_across(self.window.size);
        self.fronts[(y / backdrop::TILE * across + x / backdrop::TILE) as usize] == 0
    }

    /// A line's colour as it minds what lies behind it there; linear light.
    pub(crate) fn minded(
        &self,
        minding: &mut Minding,
        line: [f32; 3],
        frame_px: [f32; 2],
    ) -> [f32; 3] {
        if self.compose.flags & Compose::BACKDROP == 0 {
            return line;
        }
        let [x, y] = self.window.pixel_at(frame_px);
        let element = (y * self.window.size[0] + x) as usize;
        let sides = [self.fronts[element], self.backs[element]];
        minding.light(line, sides, self.rules, |texel| self.linear_texel(texel))
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
            let (uv, footprint) = cover(frame_px, self.view.frame_px, size);
            color = texture::sample(self.texels, at, uv, footprint);
        }
        let [r, g, b, a] = color;
        [r * a, g * a, b * a, a]
    }

    pub(crate) fn linear_of(&self, srgb: [f32; 4]) -> [f32; 4] {
        self.linear_texel(pack_rgba8(srgb))
    }

    pub(crate) fn linear_texel(&self, texel: u32) -> [f32; 4] {
        texture::linear_texel(self.texels, texel)
    }
}

/// Where a place of a frame lies in a picture that covers it, centred, like a poster that is cut at two sides: its
/// texture coordinates, and the length of them that a pixel of the frame covers.
pub fn cover(frame_px: [f32; 2], frame: [f32; 2], size: [f32; 2]) -> ([f32; 2], f32) {
    let zoom = (frame[0] / size[0]).max(frame[1] / size[1]);
    let uv = std::array::from_fn(|i| (frame_px[i] - 0.5 * frame[i]) / (size[i] * zoom) + 0.5);
    (uv, 1.0 / (size[0].max(size[1]) * zoom))
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

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::texture::TextureStore;
    use proptest::prelude::*;

    /// A frame of 4x4 pixels without triangles.
    fn empty_frame(compose_settings: &Compose, ribbons: &[u32]) -> Vec<u32> {
        let view = View {
            frame_px: [4.0; 2],
            ..View::default()
        };
        let window = Window::over([4.0; 2], [0.0; 2], [4.0; 2], [4, 4]);
        let store = TextureStore::new();
        let layers = Layers {
            view: &view,
            window: &window,
            compose: compose_settings,
            lights: &Lights::default(),
            ids: &[0; 64],
            beam_ids: &[],
            ribbons,
            posed: &[],
            vertices: &[],
            triangles: &[],
            parts: &[],
            texels: store.words(),
            charts: &[],
            overlay: &[0; 16],
            shadows: [&[]; SHADOWS_MAX],
            smoke_colors: &[],
            smoke_depths: &[],
            smoke_shadows: [&[]; SHADOWS_MAX],
            rules: &Rules::default(),
            fronts: &[],
            backs: &[],
        };
        let mut frame = vec![0; 16];
        compose(&layers, &mut frame);
        frame
    }

    fn plain(background: [f32; 4]) -> Compose {
        Compose {
            samples: 2,
            background,
            background_texture: NONE,
            saturation: 1.0,
            ..Compose::default()
        }
    }

    #[test]
    fn nothing_shows_the_background() {
        assert_eq!(
            empty_frame(&plain([1.0, 0.0, 0.0, 1.0]), &[0; 16]),
            [0xff00_00ff; 16]
        );
        assert_eq!(empty_frame(&plain([0.0; 4]), &[0; 16]), [0; 16]);
    }

    #[test]
    fn a_line_over_nothing_keeps_its_own_coverage() {
        let settings = Compose {
            flags: Compose::RIBBONS,
            ..plain([0.0; 4])
        };
        assert_eq!(
            empty_frame(&settings, &[0x8010_2030; 16]),
            [0x8010_2030; 16]
        );
    }

    proptest! {
        #[test]
        fn a_layer_over_another_never_lightens_coverage(top in prop::array::uniform4(0f32..1.0), below in prop::array::uniform4(0f32..1.0)) {
            let premultiplied = [below[0] * below[3], below[1] * below[3], below[2] * below[3], below[3]];
            let both = over(top, premultiplied);
            prop_assert!(both[3] >= top[3].max(below[3]) - 1e-6 && both[3] <= 1.0 + 1e-6);
            prop_assert!(both[..3].iter().all(|c| *c >= 0.0 && *c <= both[3] + 1e-6));
        }
    }
}
