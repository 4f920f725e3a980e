//! Colour of one triangle under a pixel: the shading half of `shade.compose_frame`.
//!
//! Constants of a triangle are found once a frame (`compose/known.rs`). What changes gently is found once a pixel, at
//! the middle of the samples that show the triangle, and what has edges at every sample.

use crate::backdrop::ContrastCache;
use crate::compose::{Compose, Layers};
use crate::corners::Corners;
use crate::gloss::shines_gently;
use crate::ink_step::Evened;
use crate::inking::{ink_over, length};
use crate::lighting::Openness;
use crate::line_color::LinePoint;
use crate::ramp::{Level, ramp_light};
use crate::tone_row::{row_is_even, row_light};
use crate::toon::ToonPaint;
use crate::triangle_constants::TriangleConstants;
use npr_core::geometry::Part;
use npr_core::math;
use npr_core::raster::ID_MASK;
use npr_core::surface::{blend, dot, weights_around, weights_at};
use npr_core::window::View;

/// Widest line of the surface-angle method, in line widths: a surface that turns more slowly counts as flat.
const ANGLE_WIDTHS: f32 = 6.0;

/// The one-dimensional texture of the surface-angle method over N . E: dark where a surface is seen from the side,
/// fading round `threshold` over `softness` of it [Suzuki 2004, section 3.2.2].
pub fn angle_ramp(facing: f32, threshold: f32, softness: f32) -> f32 {
    let half = 0.5 * softness * threshold;
    1.0 - math::smoothstep(threshold - half, threshold + half, facing.abs())
}

/// 1 within `widest_px` of the contour of a surface, else 0, at a place where N . E is `facing` and changes by `change`
/// per pixel.
///
/// Near a contour, N . E grows with the root of the distance, so the distance is half of `facing` over `change`. On
/// flat faces nothing changes, and they lie infinitely far from any contour.
pub fn not_flat(facing: f32, change: f32, widest_px: f32) -> f32 {
    let distance = facing.max(0.0) * 0.5 / change.max(1e-9);
    (widest_px - distance + 0.5).clamp(0.0, 1.0)
}

/// Width of a tone step, in ramp coordinate, from which it is so gentle that one place of a pixel stands for all.
const GENTLE: f32 = 0.25;

/// A lit surface with the share `share` of ink over it, 0..1.
#[inline]
pub(crate) fn inked(part: &Part, lit: [f32; 3], share: f32) -> [f32; 3] {
    let ink = part.ink_color;
    std::array::from_fn(|i| lit[i] + (ink[i] - lit[i]) * (share * ink[3]))
}

/// The surface of a triangle under a position of the frame: the weights of its corners, its place, its normal.
#[inline]
pub(crate) fn surface_at(
    view: &View,
    corners: &Corners<'_>,
    frame_px: [f32; 2],
) -> ([f32; 3], [f32; 3], [f32; 3]) {
    let weights = weights_at(corners.clip, view.ndc_at(frame_px));
    (weights, corners.world(weights), corners.normal(weights))
}

/// Samples of a pixel that show one triangle.
#[derive(Debug, Clone, Copy)]
struct Group {
    /// The triangle's number.
    id: u32,
    /// A bit for each of the pixel's samples.
    members: u32,
    /// Middle of the pixel in the frame; the middle of the samples follows.
    frame_px: [f32; 2],
    center: [f32; 2],
    /// The part's tone in the pixel, where it is evened.
    evened: Option<Evened>,
}

impl Group {
    /// Ink of the group if it is the same all over, by its evened tone or by what is known of its triangle.
    fn known_ink(&self, known: &TriangleConstants) -> Option<f32> {
        self.evened.and_then(|tone| tone.ink).or(known.ink())
    }
}

/// The sums over a group's samples.
#[derive(Debug, Clone, Copy, Default)]
struct Sampled {
    /// Factor on the surface's colour; of a toon its light.
    light: [f32; 3],
    /// Share of it that is inked, 0..1.
    ink: f32,
    /// Light that highlights add.
    gloss: [f32; 3],
    /// Share that the line of the surface-angle method covers.
    line: f32,
}

/// Ink of a surface, summed over samples: samples in the same shadows share one value.
#[derive(Debug, Clone, Copy)]
struct Inked {
    /// The lights whose shadow fell on the last sample, and the ink there.
    dark: u32,
    last: f32,
    first: f32,
    mean: f32,
}

impl Inked {
    /// Adds one of `count` samples; its ink is that of the last one unless other shadows fall on it.
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

impl Layers<'_> {
    /// Light of a triangle that is lit in one tone all over, whatever its ink and its highlights; else `None`.
    pub(crate) fn even_light(&self, part: &Part, corners: &Corners<'_>) -> Option<[f32; 3]> {
        if part.flags & (Part::ANGLE | Part::TOON) != 0 {
            return None;
        }
        let in_shadow = Part::INK | Part::HATCH | Part::HIGHLIGHTS;
        if part.flags & Part::UNLIT != 0 {
            let is_even = self.lights.shadow_side == 0 || part.flags & in_shadow == 0;
            return is_even.then_some([1.0; 3]);
        }
        if self.lights.shadow_side != 0 {
            return None;
        }
        let range = self.coordinate_range(corners)?;
        if !self.one_step(part, range) {
            return None;
        }
        let normal = corners.posed[0].normal.map(|n| n * corners.side);
        let at = (corners.posed[0].world, normal);
        Some(self.light_of((part, None), at, 0, Openness::FULL))
    }

    /// Whether a part's ramp has one tone for all coordinates in `range`.
    fn one_step(&self, part: &Part, range: [f32; 2]) -> bool {
        if part.flags & Part::TONE_ROW != 0 {
            return row_is_even(self.texels, part.tone_row, range);
        }
        let reach = part.softness * 0.5;
        !part.ramp[1..]
            .iter()
            .any(|stop| stop[3] > range[0] - reach && stop[3] <= range[1] + reach)
    }

    /// Whether light changes so gently over a part that one place of a pixel stands for all.
    fn is_gentle(&self, part: &Part) -> bool {
        self.lights.shadow_side == 0
            && (part.softness >= GENTLE || part.ramp[1][3] >= Level::UNUSED)
            && part.flags & (Part::ANGLE | Part::TONE_ROW | Part::TOON) == 0
    }

    /// Whether the light of a group is evened and nothing else has edges within it.
    fn is_quiet(&self, group: &Group, part: &Part) -> bool {
        group.evened.is_some() && self.lights.shadow_side == 0 && part.flags & Part::ANGLE == 0
    }

    /// Light of triangle `id`, which the samples in `members` show.
    ///
    /// `known` holds the triangle's constants; `contrast_cache` holds recent answers for lines.
    pub(crate) fn shade(
        &self,
        id: u32,
        members: u32,
        frame_px: [f32; 2],
        known: &TriangleConstants,
        corners: &Corners<'_>,
        contrast_cache: &mut ContrastCache,
    ) -> [f32; 3] {
        // Find the colour of the surface.
        let triangle = &self.triangles[((id & ID_MASK) - 1) as usize];
        let part = &self.parts[triangle.part as usize];
        let evened = self.evened_tone(triangle.part, frame_px);
        let group = self.group(id, members, frame_px, evened);
        let known = &match evened {
            Some(_) => known.without_light(),
            None => *known,
        };
        let is_toon = part.flags & Part::TOON != 0;
        let paint = is_toon.then(|| self.toon_paint(triangle, part, corners, group.center));
        let color = if is_toon {
            [1.0; 3]
        } else if known.is_plain() {
            known.color
        } else {
            let color = self.plain_color(triangle, part, corners, group.center);
            self.strengthened(color)
        };

        // Light it, and lay ink and highlights over it.
        let sampled = self.sampled(&group, (part, paint.as_ref()), corners, known);
        let light = sampled.light;
        let drawn = inked(
            part,
            std::array::from_fn(|i| color[i] * light[i]),
            sampled.ink,
        );
        let drawn: [f32; 3] = std::array::from_fn(|i| drawn[i] + sampled.gloss[i]);

        // Draw the line of the surface-angle method over all.
        if sampled.line == 0.0 {
            return drawn;
        }
        let place = LinePoint {
            px: group.center,
            step_px: [1.0; 2],
            is_hull: false,
        };
        let line = self.line_light(triangle, part, corners, &place);
        let line = self.contrasted(contrast_cache, line, frame_px);
        std::array::from_fn(|i| drawn[i] + (line[i] - drawn[i]) * sampled.line)
    }

    fn group(&self, id: u32, members: u32, frame_px: [f32; 2], evened: Option<Evened>) -> Group {
        let count = members.count_ones() as f32;
        let mut center = frame_px;
        for i in (0..4).filter(|i| members & (1 << i) != 0) {
            let offset = self.sample_offset(i);
            center = [center[0] + offset[0] / count, center[1] + offset[1] / count];
        }
        Group {
            id,
            members,
            frame_px,
            center,
            evened,
        }
    }

    /// Light, ink and highlights of a group: light and ink at its middle if no edge goes through it, all else at its
    /// samples.
    fn sampled(
        &self,
        group: &Group,
        (part, paint): (&Part, Option<&ToonPaint>),
        corners: &Corners<'_>,
        known: &TriangleConstants,
    ) -> Sampled {
        // Look at every sample where an edge of the light may go through the group.
        let is_even = known.is_even();
        if !is_even && !self.is_gentle(part) && !self.is_quiet(group, part) {
            return self.at_samples(group, (part, paint), corners, known);
        }

        // Find the surface at the middle, once for light and highlights.
        let shines = !known.is_matt();
        let middle = (!is_even || shines && shines_gently(part)).then(|| {
            let (_, world, normal) = surface_at(self.view, corners, group.center);
            (world, normal)
        });

        // Take what is the same all over, or what is there.
        let light = match middle {
            Some((world, normal)) if !is_even => {
                let open = self.openness(corners, group.center).at([0.0; 2]);
                self.light_of((part, group.evened), (world, normal), 0, open)
            }
            _ if known.is_plain() => [1.0; 3],
            _ => known.color,
        };
        let ink = group
            .known_ink(known)
            .unwrap_or_else(|| self.ink_at(group.id, part, corners, group.center, 0));
        let gloss = match middle {
            _ if !shines => [0.0; 3],
            Some((world, normal)) if shines_gently(part) => {
                self.highlights_at(part, world, normal, 0)
            }
            _ => self.mean_gloss(group, part, corners),
        };
        Sampled {
            light,
            ink,
            gloss,
            line: 0.0,
        }
    }

    /// Light that highlights add to the samples of a group that lies in no shadow.
    fn mean_gloss(&self, group: &Group, part: &Part, corners: &Corners<'_>) -> [f32; 3] {
        let count = group.members.count_ones() as f32;
        let mut sum = [0.0; 3];
        for (_, weights) in self.weights_of(group, corners) {
            let (world, normal) = (corners.world(weights), corners.normal(weights));
            let gloss = self.highlights_at(part, world, normal, 0);
            sum = std::array::from_fn(|k| sum[k] + gloss[k] / count);
        }
        sum
    }

    /// The samples of a group, and the weights of a triangle's corners there.
    fn weights_of(
        &self,
        group: &Group,
        corners: &Corners<'_>,
    ) -> impl Iterator<Item = (u32, [f32; 3])> {
        let (group, clip) = (*group, corners.clip);
        (0..4)
            .filter(move |i| group.members & (1 << i) != 0)
            .map(move |i| {
                let at = self.sample_px(&group, i);
                (i, weights_at(clip, self.view.ndc_at(at)))
            })
    }

    /// Where sample `i` of a group lies in the frame.
    fn sample_px(&self, group: &Group, i: u32) -> [f32; 2] {
        let ([x, y], offset) = (group.frame_px, self.sample_offset(i));
        [x + offset[0], y + offset[1]]
    }

    /// The mean of a group's samples.
    fn at_samples(
        &self,
        group: &Group,
        (part, paint): (&Part, Option<&ToonPaint>),
        corners: &Corners<'_>,
        known: &TriangleConstants,
    ) -> Sampled {
        // Prepare what the samples share.
        let count = group.members.count_ones() as f32;
        let shines = part.flags & Part::HIGHLIGHTS != 0 && !known.is_matt();
        let mut sum = Sampled::default();
        let mut ink = None;
        let open = self.openness(corners, group.center);
        for (i, weights) in self.weights_of(group, corners) {
            // Light the sample, with the shadows that fall there.
            let (world, normal) = (corners.world(weights), corners.normal(weights));
            let dark = self.shadowed(group.id, corners, weights);
            let px = self.sample_px(group, i);
            let open = open.at([px[0] - group.center[0], px[1] - group.center[1]]);
            let light = match paint {
                Some(paint) => self.toon_light(part, paint, (world, normal), dark, open),
                None => self.light_of((part, group.evened), (world, normal), dark, open),
            };
            sum.light = std::array::from_fn(|k| sum.light[k] + light[k] / count);
            sum.line += self.grazing(part, corners, px) / count;

            // Add its highlights, and its ink where other shadows fall than on the last.
            if shines {
                let gloss = self.highlights_at(part, world, normal, dark);
                sum.gloss = std::array::from_fn(|k| sum.gloss[k] + gloss[k] / count);
            }
            ink = Some(Inked::with(ink, dark, count, || {
                group
                    .known_ink(known)
                    .or_else(|| self.even_ink_in_shadow(part, corners, dark))
                    .unwrap_or_else(|| self.ink_at(group.id, part, corners, group.center, dark))
            }));
        }
        sum.ink = ink.map_or(0.0, |ink| ink.mean);
        sum
    }

    /// How dark the surface-angle method's line is at a place of a surface, 0..1.
    fn grazing(&self, part: &Part, corners: &Corners<'_>, px: [f32; 2]) -> f32 {
        if part.flags & Part::ANGLE == 0 || self.compose.flags & Compose::BARE != 0 {
            return 0.0;
        }
        let around = weights_around(corners.clip, self.view.ndc_at(px), self.view.pixel_ndc());
        // Keep the eye of the place: so only the normal turns, and on flat faces nothing does.
        let eye = self.view.to_eye(corners.world(around[0]));
        let [here, right, down] = around.map(|weights| dot(corners.normal(weights), eye));
        let change = length([right - here, down - here]);
        let half_width = blend(around[0], corners.posed.map(|v| v.half_width));
        let widest_px = ANGLE_WIDTHS * 2.0 * half_width;
        let softness = self.compose.angle_softness;
        angle_ramp(here, part.facing_threshold, softness) * not_flat(here, change, widest_px)
    }

    /// [`even_ink`](Self::even_ink) if shadows make ink differ from place to place; `None` in frames without shadows,
    /// where it is in the triangle's constants.
    fn even_ink_in_shadow(&self, part: &Part, corners: &Corners<'_>, dark: u32) -> Option<f32> {
        if self.lights.shadow_side == 0 {
            return None;
        }
        self.even_ink(part, corners, dark)
    }

    /// Ink of a triangle where it is the same all over, inside the shadow of the lights in `dark` or outside of it: a
    /// shadow changes no ink beside it.
    pub(crate) fn even_ink(&self, part: &Part, corners: &Corners<'_>, dark: u32) -> Option<f32> {
        if part.flags & (Part::INK | Part::HATCH) == 0 {
            return Some(0.0);
        }
        let range = self.coordinate_range(corners)?;
        let most = if dark != 0 {
            self.lights.shadow_at
        } else {
            1.0
        };
        ink_over(part, range.map(|x| x.min(most)))
    }

    /// Light on a surface at a place with a normal, in the shadow of the lights in `dark`, that sees `open` of the sky;
    /// by its part's ramp, or by the light of it that was evened.
    fn light_of(
        &self,
        (part, evened): (&Part, Option<Evened>),
        (world, normal): ([f32; 3], [f32; 3]),
        dark: u32,
        open: Openness,
    ) -> [f32; 3] {
        if part.flags & Part::UNLIT != 0 {
            return [1.0; 3];
        }
        let (x, color) = self.lights.coordinate_under(world, normal, dark, open);
        let light = evened.map_or_else(|| self.ramp_of(part, x), |tone| tone.light);
        std::array::from_fn(|i| light[i] * color[i])
    }

    /// Factor on the light of a surface from a part's ramp at coordinate `x`.
    pub(crate) fn ramp_of(&self, part: &Part, x: f32) -> [f32; 3] {
        if part.flags & Part::TONE_ROW != 0 {
            row_light(self.texels, part.tone_row, x)
        } else {
            ramp_light(bytemuck::cast_slice(&part.ramp), part.softness, x)
        }
    }

    /// Lowest and highest ramp coordinate on a triangle, if the normal alone decides; else `None`.
    fn coordinate_range(&self, corners: &Corners<'_>) -> Option<[f32; 2]> {
        Some(corners.range_towards(self.lights.only_distant()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backdrop::Rules;
    use crate::compose::Compose;
    use crate::lighting::Lights;
    use npr_core::geometry::{NONE, PosedVertex, Triangle, Vertex};
    use npr_core::surface::unit_or_z;
    use npr_core::window::{View, Window};
    use proptest::prelude::*;

    /// Smooth normals may turn away from the eye just before a contour.
    #[test]
    fn surfaces_turned_a_little_away_are_as_dark_as_those_turned_a_little_towards() {
        for facing in [0.01f32, 0.2, 0.28, 0.32, 0.5] {
            let dark = angle_ramp(facing, 0.3, 0.2);
            assert_eq!(angle_ramp(-facing, 0.3, 0.2), dark);
        }
        assert_eq!(
            [angle_ramp(-0.2, 0.3, 0.2), angle_ramp(-0.5, 0.3, 0.2)],
            [1.0, 0.0]
        );
    }

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
            let (view, window) = (View::default(), Window::default());
            let (lights, rules) = (Lights::distant(unit_or_z(light)), Rules::default());
            let layers = Layers {
                posed: &posed, vertices: &[Vertex::default(); 3], triangles: &[triangle], parts: &[part],
                ..Layers::empty(&view, &window, &compose, &lights, &rules)
            };
            let corners = layers.corners_of(&triangle);
            if let Some(light) = layers.even_light(&part, &corners) {
                let sum: f32 = weights.iter().sum();
                let normal = corners.normal(weights.map(|w| w / sum));
                let inside = layers.light_of((&part, None), ([0.0; 3], normal), 0, Openness::FULL);
                prop_assert_eq!(light, inside);
            }
        }
    }
}
