//! Light on spheres, and the layer in which each is smoothed: the twin of `smoke.shade_spheres`.

use npr_core::geometry::FAR_DEPTH;
use npr_core::smoke::{SmokePixel, Sphere, SphereView, ViewSphere};
use npr_core::surface::{apply_point, dot};
use npr_core::window::Window;
use rayon::prelude::*;

use super::SmokeLook;
use super::depth_map::DepthTexels;
use crate::lighting::{LightSource, Lights, Openness, SHADOWS_MAX};

/// The inputs from which smoke is lit.
#[derive(Debug, Clone, Copy)]
pub struct Shading<'a> {
    /// The eye.
    pub lens: &'a SphereView,
    /// The pixel grid.
    pub window: &'a Window,
    /// Settings.
    pub look: &'a SmokeLook,
    /// The lights of the frame.
    pub lights: &'a Lights,
    /// Numbers of the nearest spheres, plus one.
    pub ids: &'a [u32],
    /// Numbers of the nearest spheres as the lights with shadows see them, [`SmokeLook::shadow_side`] texels square.
    pub shadows: [&'a [u32]; SHADOWS_MAX],
    /// Reversed depths of the surfaces that the first [`SmokeLook::surface_maps`] of those lights see,
    /// [`SmokeLook::surface_side`] texels square.
    pub surfaces: [&'a [u32]; SHADOWS_MAX],
    /// The spheres.
    pub spheres: &'a [Sphere],
    /// The spheres as the eye sees them.
    pub balls: &'a [ViewSphere],
}

/// Light, depth and layer of every pixel [Hoshino 2004, section 3.2].
///
/// Light is Lambert's, reaches round the sphere as far as [`SmokeLook::wrap`] says, is summed over lights and cut at 1.
/// A place that another sphere or a surface hides from a light gets at most [`Lights::shadow_at`] of it. O(pixels x
/// lights).
pub fn shade_spheres(with: &Shading<'_>, pixels: &mut [SmokePixel]) {
    let width = with.window.size[0] as usize;
    if width == 0 {
        return;
    }
    pixels
        .par_chunks_mut(width)
        .enumerate()
        .for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = with.pixel(x as u32, y as u32);
            }
        });
}

impl Shading<'_> {
    fn pixel(&self, x: u32, y: u32) -> SmokePixel {
        // Leave out pixels without smoke.
        let id = self.ids[(y * self.window.size[0] + x) as usize];
        if id == 0 {
            return SmokePixel {
                depth: FAR_DEPTH,
                place: -1.0,
                ..SmokePixel::default()
            };
        }

        // Find the depth at which the ray meets the sphere.
        let (sphere, ball) = (
            &self.spheres[(id - 1) as usize],
            &self.balls[(id - 1) as usize],
        );
        let ray = self.lens.ray(self.window.frame_at(x, y));
        let depth = self.lens.depth_of(ball, ray);

        // Light that place on the sphere in the world.
        let light = if self.look.flags & SmokeLook::UNLIT != 0 {
            1.0
        } else {
            let at = self.lens.place_at(ray, depth);
            let out: [f32; 3] = std::array::from_fn(|i| (at[i] - ball.center[i]) / ball.radius);
            let normal = self.lens.direction_in_world(out);
            let world = std::array::from_fn(|i| sphere.center[i] + normal[i] * sphere.radius);
            self.light_at(id, world, normal)
        };
        SmokePixel {
            tone: light + (sphere.heat.clamp(0.0, 1.0) - light) * self.look.heat,
            depth,
            place: self.look.place_of(ball.center[2]),
            unused: 0.0,
        }
    }

    /// Light on a place of sphere `id` with the normal `normal`, 0..1.
    fn light_at(&self, id: u32, world: [f32; 3], normal: [f32; 3]) -> f32 {
        // Add skies as they are: nothing throws a shadow in them.
        let mut sum = self.look.ambient;
        for source in &self.lights.sources[..self.lights.count as usize] {
            if source.kind == LightSource::SKY {
                sum += self.lights.sky_light(source, normal, Openness::FULL).share;
                continue;
            }

            // Let the light reach round the puff, unless something stands in its way.
            let (towards, strength) = source.reach_at(world);
            let wrap = self.look.wrap;
            let facing = (dot(normal, towards) + wrap) / (1.0 + wrap);
            let mut lit = facing.clamp(0.0, 1.0);
            if lit > self.lights.shadow_at
                && (self.is_dark(id, source, world, towards)
                    || self.is_behind_surface(source, world))
            {
                lit = self.lights.shadow_at;
            }
            sum += lit * strength;
        }
        sum.min(1.0)
    }

    /// Whether the sphere that the light sees in the texel of a place lies between place and light.
    ///
    /// The texel only names the sphere; whether the ray meets it is computed, so shadows have the outlines of circles,
    /// not of texels.
    fn is_dark(&self, own: u32, source: &LightSource, world: [f32; 3], towards: [f32; 3]) -> bool {
        // Find the texel of the place in the picture that the light has of the smoke.
        if self.look.shadow_side == 0 || source.shadow == 0 {
            return false;
        }
        let map = source.shadow as usize - 1;
        let clip = apply_point(&self.lights.shadows[map], world);
        let side = self.look.shadow_side as f32;
        let texel = [
            (clip[0] / clip[3] + 1.0) * 0.5 * side,
            (1.0 - clip[1] / clip[3]) * 0.5 * side,
        ];
        let is_inside = |x: f32| x >= 0.0 && x < side;
        if !(clip[3] > 0.0 && is_inside(texel[0]) && is_inside(texel[1])) {
            return false;
        }

        // Test whether the ray to the light meets the sphere seen there.
        let seen =
            self.shadows[map][(texel[1] as u32 * self.look.shadow_side + texel[0] as u32) as usize];
        if seen == 0 || seen == own {
            return false;
        }
        let caster = &self.spheres[(seen - 1) as usize];
        let offset: [f32; 3] = std::array::from_fn(|i| caster.center[i] - world[i]);
        let ahead = dot(offset, towards);
        ahead > 0.0 && dot(offset, offset) - ahead * ahead < caster.radius * caster.radius
    }
}

impl Shading<'_> {
    /// Whether a surface lies between a place and a light.
    fn is_behind_surface(&self, source: &LightSource, world: [f32; 3]) -> bool {
        let side = self.look.surface_side;
        if source.shadow == 0 || source.shadow > self.look.surface_maps {
            return false;
        }
        let map = source.shadow as usize - 1;
        DepthTexels::around(&self.lights.shadows[map], side, world)
            .is_some_and(|texels| texels.are_nearer(self.surfaces[map], side))
    }
}

impl SmokeLook {
    /// The layer of a sphere whose middle lies at a depth: a whole number, or between two where the sphere passes on.
    ///
    /// Layers are fixed to the smoke, not to the picture, and a sphere changes gradually from one to the next, so
    /// neither a moving camera nor a drifting sphere makes tones jump. With `range_blend` 0 they are the ids of
    /// [Hoshino 2004, section 3.3].
    pub(super) fn place_of(&self, depth: f32) -> f32 {
        let last = self.layers as f32 - 1.0;
        let place = ((depth - self.range_start) / self.range_size).clamp(0.0, last);
        let whole = place.floor();
        let passed = (place - whole - (1.0 - self.range_blend)) / self.range_blend.max(1e-6);
        (whole + passed.clamp(0.0, 1.0)).min(last)
    }

    /// Share of a pixel at `place` in a layer, 0..1; 0 for a pixel without smoke.
    pub(super) fn share_of(place: f32, layer: u32) -> f32 {
        if place < 0.0 {
            return 0.0;
        }
        (1.0 - (place - layer as f32).abs()).max(0.0)
    }
}
