//! What is the same all over each triangle, found once a frame so that its pixels need not.
//!
//! The twin of `shade.know_triangles`. It changes no picture: a constant of a triangle is what shading would find at
//! each of its pixels.

use super::{Layers, encoded};
use crate::corners::Corners;
use crate::tone::inked;
use crate::triangle_constants::TriangleConstants;
use npr_core::color::SrgbEncoder;
use npr_core::geometry::{NONE, Part, Triangle};
use rayon::prelude::*;

/// Finds the constants of every triangle. O(triangles), parallel.
///
/// Of `layers`, `view`, `compose`, `lights` and what surfaces are made of are read.
pub fn know_triangles(layers: &Layers<'_>, known: &mut [TriangleConstants]) {
    let triangles = layers.triangles.par_iter().with_min_len(1024);
    let pairs = known.par_iter_mut().zip(triangles);
    let encoder = SrgbEncoder::new();
    pairs.for_each(|(known, triangle)| *known = layers.known(triangle, &encoder));
}

impl Layers<'_> {
    /// The constants of a triangle; none if only its back is seen and that is not drawn.
    fn known(&self, triangle: &Triangle, encoder: &SrgbEncoder) -> TriangleConstants {
        // Leave out backs that nobody sees.
        let part = &self.parts[triangle.part as usize];
        let corners = self.corners_of(triangle);
        let mut known = TriangleConstants {
            corners: triangle.corners,
            part: triangle.part,
            ..TriangleConstants::default()
        };
        if corners.side < 0.0 && part.flags & Part::DOUBLE_SIDED == 0 {
            return known;
        }

        // Find light and ink where they are the same all over.
        let (light, ink) = (
            self.even_light(part, &corners),
            self.ink_all_over(part, &corners),
        );
        let white = |v: &u32| self.vertices[*v as usize].is_white();
        let is_plain = part.flags & Part::PLAIN != 0
            || part.texture == NONE && triangle.corners.iter().all(white);
        let is_matt = !self.may_shine(part, &corners);

        // Note them, and multiply colour and light where both are known.
        known.learn(TriangleConstants::PLAIN, is_plain);
        known.learn(TriangleConstants::EVEN, light.is_some());
        known.learn(TriangleConstants::MATT, is_matt);
        known.learn(TriangleConstants::BARE, ink == Some(0.0));
        known.learn(TriangleConstants::SOLID, ink == Some(1.0));
        let light = light.unwrap_or([1.0; 3]);
        known.color = if is_plain {
            let [r, g, b, _] = part.base_color;
            let base = self.strengthened([r, g, b]);
            std::array::from_fn(|i| base[i] * light[i])
        } else {
            light
        };

        // Lay the ink over them if nothing else is left to find.
        if let (Some(ink), true) = (ink, is_plain && known.is_even() && is_matt) {
            known.color = inked(part, known.color, ink);
            let [r, g, b] = known.color;
            known.complete(encoded(encoder, [r, g, b, 1.0]));
        }
        known
    }

    /// Ink that is the same all over a triangle, if no shadow falls on it.
    fn ink_all_over(&self, part: &Part, corners: &Corners<'_>) -> Option<f32> {
        if self.lights.shadow_side != 0 && part.flags & (Part::INK | Part::HATCH) != 0 {
            return None;
        }
        self.even_ink(part, corners, 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backdrop::{ContrastCache, Rules};
    use crate::compose::Compose;
    use crate::lighting::Lights;
    use crate::ramp::Level;
    use npr_core::geometry::{PosedVertex, Vertex};
    use npr_core::surface::unit_or_z;
    use npr_core::window::{View, Window};
    use proptest::prelude::*;

    /// A triangle round the middle of a frame of 8x8 pixels, seen from the front.
    fn posed(normals: [[f32; 3]; 3]) -> [PosedVertex; 3] {
        let places = [[-0.9, -0.8], [0.9, -0.7], [0.1, 0.9]];
        std::array::from_fn(|i| PosedVertex {
            clip: [places[i][0], places[i][1], 0.5, 1.0],
            world: [places[i][0], places[i][1], 0.0],
            normal: unit_or_z(normals[i]),
            ..PosedVertex::default()
        })
    }

    fn part(
        flags: u32,
        softness: f32,
        steps: [f32; 2],
        highlight: [f32; 2],
        back_direction: [f32; 3],
    ) -> Part {
        let mut ramp = [[1.0, 1.0, 1.0, Level::UNUSED]; 8];
        ramp[0] = [0.2, 0.3, 0.4, 0.0];
        ramp[1] = [0.5, 0.6, 0.5, steps[0].min(steps[1])];
        ramp[2] = [1.0, 0.9, 0.8, steps[0].max(steps[1])];
        Part {
            flags,
            softness,
            ramp,
            texture: NONE,
            base_color: [0.9, 0.7, 0.5, 1.0],
            highlight: [highlight[0], highlight[1], 1.0, 0.0],
            highlight_color: [1.0, 0.9, 0.8, 0.7],
            highlight_turn: [1.0, 0.0, 0.0, 0.0],
            back_color: [0.3, 0.4, 0.5, 0.6],
            back: [0.6, 0.8, 0.0, 0.0],
            back_direction,
            ..Part::default()
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        /// The oracle is the same shading without anything known.
        #[test]
        fn what_is_known_changes_no_color(
            normal in prop::array::uniform3(-1f32..1.0),
            bends in prop::array::uniform3(prop::array::uniform3(-0.2f32..0.2)),
            light in prop::array::uniform3(-1f32..1.0), back in prop::array::uniform3(-1f32..1.0),
            flags in prop::sample::select(vec![
                0, Part::UNLIT, Part::SOFT, Part::CRISP, Part::SOFT | Part::BACK_LIGHT, Part::UNLIT | Part::CRISP,
            ]),
            softness in prop::sample::select(vec![0.0f32, 0.05, 0.5]), steps in prop::array::uniform2(0.05f32..0.95),
            exponent in 1f32..200.0, threshold in 0f32..1.0, members in 1u32..16, perspective in 0u32..2,
        ) {
            let posed = posed(bends.map(|bend| std::array::from_fn(|i| normal[i] + bend[i])));
            // Spots too sharp to be looked at once a pixel, which is as near as shading gets, not the same.
            let exponent = if flags == Part::SOFT { exponent + 100.0 } else { exponent };
            let parts = [part(flags, softness, steps, [exponent, threshold], unit_or_z(back))];
            let view = View {
                frame_px: [8.0; 2],
                perspective: perspective as f32,
                eye_world: [0.2, 0.1, 3.0],
                forward_world: [0.0, 0.0, -1.0],
                ..View::default()
            };
            let compose = Compose {
                saturation: 1.0, samples: 2,
                right_world: [1.0, 0.0, 0.0], up_world: [0.0, 1.0, 0.0], near_world: [0.0, 0.0, 1.0],
                ..Compose::default()
            };
            let triangles = [Triangle { corners: [0, 1, 2], part: 0 }];
            let vertices = [Vertex { color: u32::MAX, ..Vertex::default() }; 3];
            let store = npr_core::texture::TextureStore::new();
            let (window, lights, rules) =
                (Window::default(), Lights::distant(unit_or_z(light)), Rules::default());
            let layers = Layers {
                posed: &posed, vertices: &vertices, triangles: &triangles, parts: &parts, texels: store.words(),
                ..Layers::empty(&view, &window, &compose, &lights, &rules)
            };
            let known = layers.known(&triangles[0], &SrgbEncoder::new());
            let corners = layers.corners_of(&triangles[0]);
            let shade = |known: &TriangleConstants| {
                let contrast_cache = &mut ContrastCache::default();
                layers.shade(1, members, [4.5, 3.5], known, &corners, contrast_cache)
            };
            let with = known.whole().unwrap_or_else(|| shade(&known));
            let without = shade(&TriangleConstants::default());
            prop_assert!((0..3).all(|i| (with[i] - without[i]).abs() < 1e-4), "{with:?}, not {without:?}: {known:?}");
        }
    }
}
