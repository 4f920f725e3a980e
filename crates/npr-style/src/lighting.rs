//! The lights of a frame, as passes read them: the twin of `lib/lighting`.
//!
//! Every light adds to the place on the ramp; a single distant light of intensity 1 gives `(N.L + 1) / 2`
//! [Suzuki 2004, section 3.2], as published.

use bytemuck::{Pod, Zeroable};
use npr_core::gpu_layout;
use npr_core::light_view::Matrix;
use npr_core::math;
use npr_core::surface::{dot, unit_or_z};

use crate::dome::harmonics;
use crate::luminance::LUMA;
use crate::ramp::ramp_coordinate;

/// Most lights that shade a frame.
pub const LIGHTS_MAX: usize = 16;

/// Most lights of a frame that throw shadows.
pub const SHADOWS_MAX: usize = 4;

/// One light.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct LightSource {
    /// Position in the world; ignored for distant lights.
    pub position: [f32; 3],
    /// [`LightSource::DISTANT`], [`LightSource::POINT`], [`LightSource::SPOT`] or [`LightSource::SKY`].
    pub kind: u32,
    /// Unit vector in the world: towards a distant light or the brightest part of the sky, along the axis of a spot.
    pub direction: [f32; 3],
    /// What it adds to the ramp coordinate of a surface that faces it, 0 and up.
    pub intensity: f32,
    /// Linear colour of its light; white leaves tones as they are.
    pub color: [f32; 3],
    /// Distance at which it has faded to nothing, in the world; 0 if it never fades.
    pub range: f32,
    /// Cosines of a spot's angles to its axis: where the light ends, and up to where it is full.
    pub cone: [f32; 2],
    /// Number of its shadow image, counted from 1; 0 for skies and if nothing throws shadows in its light.
    pub shadow: u32,
    /// Bits of [`LightSource::HIDDEN`] and [`LightSource::PICTURE`]; only for skies.
    pub sky: u32,
    /// Linear colour of the light from below, its greatest channel 1; only for skies.
    pub ground: [f32; 3],
    /// Strength of the light from below against that from above.
    pub ground_strength: f32,
}
gpu_layout!(LightSource {
    position,
    kind,
    direction,
    intensity,
    color,
    range,
    cone,
    shadow,
    sky,
    ground,
    ground_strength
});

impl LightSource {
    /// Light from one direction, the sun.
    pub const DISTANT: u32 = 0;
    /// Light from a point in all directions.
    pub const POINT: u32 = 1;
    /// Light from a point into a cone.
    pub const SPOT: u32 = 2;
    /// Light from everywhere: one colour from above, the ground's from below. Both halves are evenly bright and light a
    /// surface by how much of them it faces: `(1 + N.up) / 2` of the upper half and the rest of the lower one. Makes no
    /// highlights.
    pub const SKY: u32 = 3;

    /// Bit: things in the way hide the sky.
    pub const HIDDEN: u32 = 1;
    /// Bit: [`Lights::dome`] gives the light of a sky, not its two colours.
    pub const PICTURE: u32 = 2;
}

/// All lights of a frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Lights {
    /// How many of `sources` there are.
    pub count: u32,
    /// Side of the shadow images, in texels; 0 if nothing throws shadows.
    pub shadow_side: u32,
    /// Ramp coordinate above which a light cannot lift a place in its shadow.
    pub shadow_at: f32,
    /// How much nearer to the light an object must be than a place to shade it, in the world.
    pub bias_world: f32,
    /// The lights; those after `count` are dark.
    pub sources: [LightSource; LIGHTS_MAX],
    /// For each shadow image, the matrix from the world to its clip space.
    pub shadows: [Matrix; SHADOWS_MAX],
    /// Middle, in the world, of the ball that the pictures for a hidden sky show.
    pub sky_center: [f32; 3],
    /// Radius of that ball.
    pub sky_radius: f32,
    /// Where these pictures start in the texture store, see [`crate::sky`].
    pub sky_maps: u32,
    /// Number of these pictures; 0 if nothing hides the sky.
    pub sky_views: u32,
    /// Side of each picture in texels, an even number.
    pub sky_side: u32,
    /// Keeps rows of 16 bytes.
    pub sky_unused: u32,
    /// The picture of the sky, summed up by [`crate::sky::dome_of`].
    pub dome: [[f32; 4]; 9],
}
gpu_layout!(Lights {
    count,
    shadow_side,
    shadow_at,
    bias_world,
    sources,
    shadows,
    sky_center,
    sky_radius,
    sky_maps,
    sky_views,
    sky_side,
    sky_unused,
    dome
});

impl Lights {
    /// A single distant light of intensity 1 in direction `towards`, a unit vector in the world.
    pub fn distant(towards: [f32; 3]) -> Self {
        let mut lights = Self {
            count: 1,
            ..Self::default()
        };
        lights.sources[0] = LightSource {
            direction: towards,
            intensity: 1.0,
            color: [1.0; 3],
            ..LightSource::default()
        };
        lights
    }

    /// The direction of the only light, if that is distant and plain, of intensity 1: apart from shadows, tones then
    /// depend on the normal alone.
    #[inline]
    pub(crate) fn only_distant(&self) -> Option<[f32; 3]> {
        let first = &self.sources[0];
        (self.count == 1 && first.kind == LightSource::DISTANT && first.intensity == 1.0)
            .then_some(first.direction)
    }

    /// Ramp coordinate of a surface at `world` that faces along the unit vector `normal`, and the colour of the light
    /// there: the mean of the lights' colours, weighted by what each adds. Bit `i` of `dark` is set if the place lies
    /// in the shadow of light `i`. Nothing hides the sky. O(lights).
    #[inline]
    pub fn coordinate_at(&self, world: [f32; 3], normal: [f32; 3], dark: u32) -> (f32, [f32; 3]) {
        self.coordinate_under(world, normal, dark, Openness::FULL)
    }

    /// As [`coordinate_at`](Self::coordinate_at), with `open` as the shares of the sky that the place sees.
    #[inline]
    pub fn coordinate_under(
        &self,
        world: [f32; 3],
        normal: [f32; 3],
        dark: u32,
        open: Openness,
    ) -> (f32, [f32; 3]) {
        // The usual case: one sun, whose colour is the mean.
        if let Some(towards) = self.only_distant()
            && dark == 0
        {
            let x = ramp_coordinate(dot(normal, towards));
            let is_lit = x > 1e-6;
            return (
                x.min(1.0),
                if is_lit {
                    self.sources[0].color
                } else {
                    [1.0; 3]
                },
            );
        }
        let mut sum = 0.0;
        let mut color = [0.0; 3];
        for (i, source) in self.sources[..self.count as usize].iter().enumerate() {
            if source.kind == LightSource::SKY {
                let light = self.sky_light(source, normal, open);
                sum += light.share;
                color = std::array::from_fn(|i| color[i] + light.color[i]);
                continue;
            }
            let is_dark = (dark >> i) & 1 != 0;
            let most = if is_dark { self.shadow_at } else { 1.0 };
            let share = source.share_at(world, normal, most);
            sum += share;
            color = std::array::from_fn(|i| color[i] + source.color[i] * share);
        }
        let whole = sum.max(1e-6);
        let tint = color.map(|c| c / whole);
        (sum.min(1.0), if sum > 1e-6 { tint } else { [1.0; 3] })
    }

    /// Light from the picture of the sky on a surface that faces along a unit vector.
    pub(crate) fn dome_at(&self, normal: [f32; 3]) -> [f32; 3] {
        let values = harmonics(normal);
        let mut sum = [0.0; 3];
        for (color, value) in self.dome.iter().zip(values) {
            sum = std::array::from_fn(|i| sum[i] + color[i] * value);
        }
        sum.map(|v| v.max(0.0))
    }

    /// Light of a sky on a surface that faces along a unit vector and sees `open` of it.
    #[inline]
    pub(crate) fn sky_light(
        &self,
        source: &LightSource,
        normal: [f32; 3],
        open: Openness,
    ) -> SkyLight {
        // Share the light out between the sky above and the ground below.
        let is_hidden = source.sky & LightSource::HIDDEN != 0;
        let open = if is_hidden { open } else { Openness::FULL };
        let upper = ramp_coordinate(dot(normal, source.direction)).clamp(0.0, 1.0);
        let above = upper * open.above * source.intensity;
        let below = (1.0 - upper) * open.below * source.intensity;

        // Take the colour from the picture of the sky, where there is one.
        if source.sky & LightSource::PICTURE != 0 {
            let light = self.dome_at(normal);
            let strength = above + below;
            return SkyLight {
                share: dot(light, LUMA) * strength,
                color: std::array::from_fn(|i| light[i] * source.color[i] * strength),
            };
        }
        let below = below * source.ground_strength;
        SkyLight {
            share: above + below,
            color: std::array::from_fn(|i| source.color[i] * above + source.ground[i] * below),
        }
    }
}

/// Shares of the sky and of the ground below that shine on a surface, 0..1, weighted by how squarely it faces each part
/// of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Openness {
    /// Share of what lies above.
    pub above: f32,
    /// Share of what lies below.
    pub below: f32,
}

impl Openness {
    /// Sky and ground in full.
    pub const FULL: Self = Self {
        above: 1.0,
        below: 1.0,
    };
}

/// The light of a sky on a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SkyLight {
    /// What it adds to the ramp coordinate.
    pub share: f32,
    /// Colour of its light, times `share`.
    pub color: [f32; 3],
}

impl LightSource {
    /// Unit vector from a place in the world towards the light.
    #[inline]
    pub fn towards(&self, world: [f32; 3]) -> [f32; 3] {
        if self.is_far() {
            return self.direction;
        }
        unit_or_z(std::array::from_fn(|i| self.position[i] - world[i]))
    }

    /// Whether it comes from the same direction everywhere.
    #[inline]
    pub(crate) fn is_far(&self) -> bool {
        self.kind == Self::DISTANT || self.kind == Self::SKY
    }

    /// Unit vector from a place in the world towards the light, and how strong it shines there.
    #[inline]
    pub fn reach_at(&self, world: [f32; 3]) -> ([f32; 3], f32) {
        if self.is_far() {
            return (self.direction, self.intensity);
        }
        let offset: [f32; 3] = std::array::from_fn(|i| self.position[i] - world[i]);
        let distance = dot(offset, offset).sqrt();
        let towards = unit_or_z(offset);
        let mut strength = self.intensity * fading(distance, self.range);
        if self.kind == Self::SPOT {
            strength *= math::smoothstep(self.cone[0], self.cone[1], -dot(towards, self.direction));
        }
        (towards, strength)
    }

    /// What the light adds to the ramp coordinate of a surface at a place, at most `most` times its strength there.
    #[inline]
    fn share_at(&self, world: [f32; 3], normal: [f32; 3], most: f32) -> f32 {
        let (towards, strength) = self.reach_at(world);
        ramp_coordinate(dot(normal, towards)).min(most) * strength
    }
}

/// The share of a light that is left at a distance, 1 beside it and 0 from `range` on; always 1 if `range` is 0.
///
/// The window of KHR_lights_punctual without the inverse square: on a ramp of few tones, the square is either burnt out
/// or gone.
pub fn fading(distance: f32, range: f32) -> f32 {
    if range <= 0.0 {
        return 1.0;
    }
    let ratio = distance / range;
    let left = (1.0 - ratio * ratio).max(0.0);
    left * left
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(position: [f32; 3], range: f32) -> Lights {
        let mut lights = Lights::distant([0.0, 0.0, 1.0]);
        lights.sources[0] = LightSource {
            position,
            kind: LightSource::POINT,
            range,
            ..lights.sources[0]
        };
        lights
    }

    #[test]
    fn one_distant_light_is_the_published_formula() {
        let mut lights = Lights::distant([0.0, 1.0, 0.0]);
        let normals = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
        let at = |lights: &Lights, normal| lights.coordinate_at([3.0, -2.0, 9.0], normal, 0).0;
        assert_eq!(normals.map(|normal| at(&lights, normal)), [1.0, 0.5, 0.0]);
        // Another intensity scales the place on the ramp.
        lights.sources[0].intensity = 0.5;
        assert_eq!(normals.map(|normal| at(&lights, normal)), [0.5, 0.25, 0.0]);
    }

    #[test]
    fn a_shadow_holds_its_own_light_down() {
        let mut lights = Lights::distant([0.0, 1.0, 0.0]);
        lights.shadow_at = 0.25;
        lights.sources[1] = LightSource {
            kind: LightSource::SKY,
            intensity: 0.5,
            ..lights.sources[0]
        };
        let at =
            |lights: &Lights, y: f32, dark| lights.coordinate_at([0.0; 3], [0.0, y, 0.0], dark).0;
        assert_eq!([0, 1].map(|dark| at(&lights, 1.0, dark)), [1.0, 0.25]);
        assert_eq!(at(&lights, -1.0, 1), 0.0, "what faces away is darker still");
        lights.count = 2;
        assert_eq!(at(&lights, 1.0, 1), 0.75, "the sky shines into the shadow");
    }

    #[test]
    fn a_point_light_fades_to_its_range() {
        let lights = point([0.0, 2.0, 0.0], 4.0);
        let at = |y| lights.coordinate_at([0.0, y, 0.0], [0.0, 1.0, 0.0], 0).0;
        assert_eq!(at(-2.0), 0.0);
        assert!((at(0.0) - 0.5625).abs() < 1e-6, "(1 - 1/4)^2");
        assert!(at(1.0) > at(0.0));
    }

    #[test]
    fn a_sky_lights_by_how_far_a_surface_faces_up_and_fades_nowhere() {
        let mut lights = Lights::distant([0.0, 1.0, 0.0]);
        lights.sources[0].kind = LightSource::SKY;
        lights.sources[0].intensity = 0.5;
        let at = |place, normal| lights.coordinate_at(place, normal, 0).0;
        for place in [[0.0; 3], [9.0, -50.0, 3.0]] {
            let normals = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]];
            assert_eq!(normals.map(|normal| at(place, normal)), [0.5, 0.25, 0.0]);
        }
    }

    #[test]
    fn a_sky_has_a_color_above_and_another_below() {
        let mut lights = Lights::distant([0.0, 1.0, 0.0]);
        lights.sources[0] = LightSource {
            kind: LightSource::SKY,
            color: [0.5, 0.5, 1.0],
            sky: LightSource::HIDDEN,
            ground: [1.0, 0.5, 0.0],
            ground_strength: 0.4,
            ..lights.sources[0]
        };
        let at = |y: f32, open| {
            let normal = [(1.0 - y * y).sqrt(), y, 0.0];
            lights.coordinate_under([9.0; 3], normal, 0, open)
        };
        assert_eq!(at(1.0, Openness::FULL), (1.0, [0.5, 0.5, 1.0]));
        assert_eq!(at(-1.0, Openness::FULL), (0.4, [1.0, 0.5, 0.0]));
        let (x, [r, ..]) = at(0.0, Openness::FULL);
        assert!(
            (x - 0.7).abs() < 1e-6 && (r - (0.25 + 0.2) / 0.7).abs() < 1e-6,
            "{x} {r}"
        );
        let roofed = Openness {
            above: 0.0,
            below: 1.0,
        };
        assert_eq!([at(1.0, roofed).0, at(-1.0, roofed).0], [0.0, 0.4]);
        let half = Openness {
            above: 0.5,
            below: 0.0,
        };
        assert_eq!([at(1.0, half).0, at(-1.0, half).0], [0.5, 0.0]);
    }

    #[test]
    fn a_spot_lights_its_cone_alone() {
        let mut lights = point([0.0, 2.0, 0.0], 0.0);
        lights.sources[0].kind = LightSource::SPOT;
        lights.sources[0].direction = [0.0, -1.0, 0.0];
        lights.sources[0].cone = [0.8, 0.9];
        let at = |x| lights.coordinate_at([x, 0.0, 0.0], [0.0, 1.0, 0.0], 0).0;
        assert_eq!(at(0.0), 1.0);
        assert_eq!(at(2.0), 0.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn coordinates_stay_within_the_ramp(
            sources in prop::collection::vec((
                prop::array::uniform3(-5f32..5.0), 0u32..4, prop::array::uniform3(-1f32..1.0), 0f32..3.0, 0f32..9.0,
            ), 0..LIGHTS_MAX),
            world in prop::array::uniform3(-5f32..5.0), normal in prop::array::uniform3(-1f32..1.0),
            dark in 0u32..65536,
        ) {
            let mut lights = Lights { count: sources.len() as u32, ..Lights::default() };
            for (light, (position, kind, direction, intensity, range)) in lights.sources.iter_mut().zip(sources) {
                *light = LightSource {
                    position, kind, direction: unit_or_z(direction), intensity, range,
                    color: [1.0, 0.5, 0.2], cone: [0.5, 0.7], ..LightSource::default()
                };
            }
            let (x, color) = lights.coordinate_at(world, unit_or_z(normal), dark);
            prop_assert!((0.0..=1.0).contains(&x));
            prop_assert!(color.iter().all(|c| (0.199..=1.001).contains(c)), "{color:?}");
        }
    }
}
