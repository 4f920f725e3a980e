//! Beams of light: laser, flash, explosion, trail.
//!
//! A beam is a mesh that is no surface. Its colour depends on how squarely it faces the eye, T = E . N: low at the rim
//! of a tube, 1 in its middle [Suzuki 2004, section 3.5]. A ramp over T gives it one colour, a light inside or a strong
//! inside.

use npr_core::geometry::{Part, Triangle};
use npr_core::raster::ID_MASK;
use npr_core::surface::{blend, dot, weights_at};

use crate::compose::{Layers, Samples};
use crate::ramp::{Level, ramp_light};
use crate::smoke::SmokeLayer;

/// Most steps of a beam's ramp.
pub const BEAM_STOPS_MAX: usize = 4;

/// Colour of a beam at place `t` of its ramp, 0 the rim and 1 the middle; linear light, straight alpha.
pub fn beam_color(part: &Part, t: f32) -> [f32; 4] {
    let colors: &[Level] = bytemuck::cast_slice(&part.ramp);
    let mut alphas = [Level {
        light: [0.0; 3],
        at: Level::UNUSED,
    }; BEAM_STOPS_MAX];
    for (i, level) in alphas.iter_mut().enumerate() {
        level.light = [part.beam_alpha[i]; 3];
        level.at = colors[i].at;
    }
    let [r, g, b] = ramp_light(colors, part.softness, t);
    [r, g, b, ramp_light(&alphas, part.softness, t)[0]]
}

impl Layers<'_> {
    /// Lays the beams over the surfaces of a pixel, and returns how much of its lines they cover.
    ///
    /// A beam shows in the samples in which it lies before the surface.
    pub(crate) fn add_beams(
        &self,
        seen: &Samples,
        beams: &Samples,
        smoke_layer: Option<&SmokeLayer>,
        frame_px: [f32; 2],
        color: &mut [f32; 4],
    ) -> f32 {
        // Count the samples in which each beam shows.
        let share = 1.0 / beams.len() as f32;
        let mut glow = [0.0; 4];
        let mut covered = 0.0;
        for (i, &id) in beams.iter().enumerate() {
            if id == 0 || beams[..i].contains(&id) {
                continue;
            }
            let shown = (i..beams.len())
                .filter(|&j| beams[j] == id && self.beam_shows(id, seen[j], j as u32, frame_px))
                .map(|j| {
                    smoke_layer.map_or(1.0, |smoke_layer| {
                        1.0 - smoke_layer.over(self, id, j as u32, frame_px)
                    })
                })
                .sum::<f32>()
                * share;

            // Add its light, and its share of the cover over lines.
            let part = self.part_of(id);
            let [r, g, b, a] = beam_color(part, self.beam_place(id, frame_px));
            let added = [r * a, g * a, b * a, a];
            glow = std::array::from_fn(|k| glow[k] + added[k] * shown);
            if part.flags & Part::BEAM_COVERS != 0 {
                covered += a * shown;
            }
        }

        // Lay the light over the surfaces.
        *color = std::array::from_fn(|k| glow[k] + color[k] * (1.0 - glow[3]));
        covered
    }

    fn part_of(&self, id: u32) -> &Part {
        let Triangle { part, .. } = self.triangles[((id & ID_MASK) - 1) as usize];
        &self.parts[part as usize]
    }

    /// Whether a beam shows before a surface in sample `i` of a pixel.
    fn beam_shows(&self, id: u32, surface: u32, i: u32, frame_px: [f32; 2]) -> bool {
        if surface == 0 {
            return true;
        }
        if self.part_of(id).flags & Part::BEAM_BEHIND != 0 {
            return false;
        }
        let offset = self.sample_offset(i);
        let at = [frame_px[0] + offset[0], frame_px[1] + offset[1]];
        self.depth_of(id, at) < self.depth_of(surface, at)
    }

    /// Depth of a triangle's plane at a position of the frame.
    pub(crate) fn depth_of(&self, id: u32, frame_px: [f32; 2]) -> f32 {
        let corners = self.triangles[((id & ID_MASK) - 1) as usize]
            .corners
            .map(|v| &self.posed[v as usize]);
        let weights = weights_at(corners.map(|v| v.clip), self.view.ndc_at(frame_px));
        blend(weights, corners.map(|v| v.depth))
    }

    /// T = E . N of a beam, 0 at its rim and 1 in its middle.
    fn beam_place(&self, id: u32, frame_px: [f32; 2]) -> f32 {
        let corners = self.corners_of(&self.triangles[((id & ID_MASK) - 1) as usize]);
        let weights = weights_at(corners.clip, self.view.ndc_at(frame_px));
        let eye = self.view.to_eye(corners.world(weights));
        dot(corners.normal(weights), eye).clamp(0.0, 1.0)
    }
}
