//! What a frame is composed from: the inputs of all features that a pixel may show.

use super::{Compose, cover};
use crate::backdrop::{self, ContrastCache, Rules};
use crate::corners::Corners;
use crate::lighting::{Lights, SHADOWS_MAX};
use crate::triangle_constants::TriangleConstants;
use npr_core::color::pack_rgba8;
use npr_core::geometry::{ChartCorners, NONE, Part, PosedVertex, Triangle, Vertex};
use npr_core::surface::faces_eye;
use npr_core::texture;
use npr_core::window::{View, Window};

/// The inputs from which a frame is composed.
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
    /// Evened tone of every pixel, see [`even_tones`](crate::even_tones::even_tones); not read without such parts.
    pub evened: &'a [u32],
    /// Stroke charts, one for each triangle; may be shorter if no part uses them.
    pub charts: &'a [ChartCorners],
    /// What is known of the triangles, see [`know_triangles`](super::know_triangles).
    pub known: &'a [TriangleConstants],
    /// Triangle numbers as the lights with shadows see them, [`Lights::shadow_side`] texels square; not read if that is
    /// 0.
    pub shadows: [&'a [u32]; SHADOWS_MAX],
    /// Smoke, sRGB bytes with straight alpha; not read without smoke.
    pub smoke_colors: &'a [u32],
    /// Depth of the smoke and which samples it covers, see [`crate::smoke::resolve`].
    pub smoke_depths: &'a [u32],
    /// Reversed depths of the smoke as the lights with shadows see it, [`Compose::smoke_shadow_side`] texels square.
    pub smoke_shadows: [&'a [u32]; SHADOWS_MAX],
    /// The rules by which lines adapt to what lies behind them.
    pub rules: &'a Rules,
    /// With [`Compose::BACKDROP`] the subject's colour beside every line, see [`backdrop::spread_rims`]; with
    /// [`Compose::BARE`] a texel for every tile, see [`backdrop::flag_tiles`].
    pub fronts: &'a [u32],
    /// With [`Compose::BACKDROP`] the colour behind every line.
    pub backs: &'a [u32],
}

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

impl<'a> Layers<'a> {
    /// The settings of a frame without any pictures, surfaces or textures.
    pub fn empty(
        view: &'a View,
        window: &'a Window,
        compose: &'a Compose,
        lights: &'a Lights,
        rules: &'a Rules,
    ) -> Self {
        Self {
            view,
            window,
            compose,
            lights,
            ids: &[],
            beam_ids: &[],
            ribbons: &[],
            posed: &[],
            vertices: &[],
            triangles: &[],
            parts: &[],
            texels: &[],
            evened: &[],
            charts: &[],
            known: &[],
            shadows: [&[]; SHADOWS_MAX],
            smoke_colors: &[],
            smoke_depths: &[],
            smoke_shadows: [&[]; SHADOWS_MAX],
            rules,
            fronts: &[],
            backs: &[],
        }
    }

    /// The triangle numbers of beams in a pixel's samples; 0 where there are none.
    pub(crate) fn beams_of(&self, x: u32, y: u32) -> Samples {
        if self.compose.flags & Compose::BEAMS == 0 {
            return Samples {
                ids: [0; 4],
                count: (self.compose.samples * self.compose.samples) as usize,
            };
        }
        self.samples_in(self.beam_ids, x, y)
    }

    /// The triangle numbers of a pixel's samples.
    pub(crate) fn samples_of(&self, x: u32, y: u32) -> Samples {
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

    /// The colours of the lines at a pixel, from the bottom: ribbons, overlay; sRGB bytes with coverage in alpha.
    pub(crate) fn lines_at(&self, x: u32, y: u32, overlay: u32) -> [u32; 2] {
        let has = |bit: u32| self.compose.flags & bit != 0;
        let ribbon = match has(Compose::RIBBONS) {
            true => self.ribbons[(y * self.window.size[0] + x) as usize],
            false => 0,
        };
        [ribbon, if has(Compose::OVERLAY) { overlay } else { 0 }]
    }

    /// Whether a pixel of the picture without lines is not needed.
    pub(crate) fn is_left_out(&self, x: u32, y: u32) -> bool {
        if self.compose.flags & Compose::BARE == 0 {
            return false;
        }
        let across = backdrop::tiles_across(self.window.size);
        self.fronts[(y / backdrop::TILE * across + x / backdrop::TILE) as usize] == 0
    }

    /// The colour of a line, adapted to what lies behind it at a pixel; linear light.
    pub(crate) fn contrasted(
        &self,
        contrast_cache: &mut ContrastCache,
        line: [f32; 3],
        frame_px: [f32; 2],
    ) -> [f32; 3] {
        if self.compose.flags & Compose::BACKDROP == 0 {
            return line;
        }
        let [x, y] = self.window.pixel_at(frame_px);
        let element = (y * self.window.size[0] + x) as usize;
        let sides = [self.fronts[element], self.backs[element]];
        contrast_cache.light(line, sides, self.rules, |texel| self.linear_texel(texel))
    }

    /// What lies behind everything, premultiplied.
    pub(crate) fn background(&self, frame_px: [f32; 2]) -> [f32; 4] {
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

    /// Position of sample `i` within a pixel, from its centre.
    #[inline]
    pub(crate) fn sample_offset(&self, i: u32) -> [f32; 2] {
        if self.compose.samples == 1 {
            return [0.0; 2];
        }
        [(i & 1) as f32 * 0.5 - 0.25, (i >> 1) as f32 * 0.5 - 0.25]
    }

    /// The corners of a triangle, as the camera sees them.
    #[inline]
    pub(crate) fn corners_of(&self, triangle: &Triangle) -> Corners<'a> {
        let posed = triangle.corners.map(|v| &self.posed[v as usize]);
        let clip = posed.map(|v| v.clip);
        Corners {
            posed,
            clip,
            side: if faces_eye(clip) { 1.0 } else { -1.0 },
        }
    }
}
