//! Cast shadows with exact edges: the twin of `lib/shadow`.
//!
//! A shadow image holds triangle numbers, not depths. A place looks at the nine texels around it and tests each
//! triangle found there itself, so the edge of a shadow is the outline of what throws it, whatever the size of a
//! texel. The nearest relatives are irregular shadow maps [Johnson et al. 2005], which keep all triangles of a texel
//! instead of one.
//!
//! Limits: a shadow image has [`SHADOW_SIDE`] texels a side, so what is thinner than a texel may throw no shadow, and
//! where many triangles lie in a texel, the shadow's edge is that of texels, rounded.

use npr_core::cutout::Cutout;
use npr_core::surface::{apply_point, blend3, cross, dot, weights_at};

use crate::compose::Layers;
use crate::corners::Corners;
use crate::lighting::LightSource;

pub use crate::lighting::SHADOWS_MAX;

/// Texels of a shadow image along a side.
pub const SHADOW_SIDE: u32 = 2048;

/// Height in texels below which a triangle counts as fine: its neighbours may have no texel of their own.
const FINE_TEXELS: f32 = 2.0;

/// Least cosine between normal and light used for the slope of a surface.
const GRAZING: f32 = 0.1;

/// A distance beyond the reach of any scene.
const ENDLESS: f32 = 1e30;

/// A place that a light may reach.
struct ShadowPoint {
    /// The triangle that it lies on, plus one.
    own: u32,
    world: [f32; 3],
    /// Unit vector towards the light, and the distance to it.
    towards: [f32; 3],
    distance: f32,
    /// Cosine between `towards` and the surface's normal.
    facing: f32,
    /// Position as the light sees it: normalised device coordinates, and texels from the top left corner.
    ndc: [f32; 2],
    texel: [f32; 2],
    /// Size of a texel there, in the world.
    texel_world: f32,
    /// Index of the shadow image.
    map: usize,
}

impl Layers<'_> {
    /// The lights whose shadow falls on a place of triangle `id`, one bit each. O(lights).
    ///
    /// Only lights that the smooth surface faces: elsewhere the tone is dark without a shadow.
    pub(crate) fn shadowed(&self, id: u32, corners: &Corners<'_>, weights: [f32; 3]) -> u32 {
        // Lift the place onto the smooth surface, so that facets do not shade each other.
        if self.lights.shadow_side == 0 {
            return 0;
        }
        let normal = corners.normal(weights);
        let world = corners.lifted(weights);

        // Ask every light that the surface faces.
        let mut dark = 0;
        for (i, source) in self.lights.sources[..self.lights.count as usize]
            .iter()
            .enumerate()
        {
            if source.shadow == 0 {
                continue;
            }
            let towards = source.towards(world);
            let facing = dot(normal, towards);
            if facing > 0.0
                && (self.is_dark(id, source, world, towards, facing)
                    || self.is_behind_smoke(source.shadow as usize - 1, world))
            {
                dark |= 1 << i;
            }
        }
        dark
    }

    /// Whether something stands between a place and a light.
    fn is_dark(
        &self,
        own: u32,
        source: &LightSource,
        world: [f32; 3],
        towards: [f32; 3],
        facing: f32,
    ) -> bool {
        // Find the place in the picture that the light has of the scene.
        let map = source.shadow as usize - 1;
        let m = &self.lights.shadows[map];
        let clip = apply_point(m, world);
        let side = self.lights.shadow_side as f32;
        let ndc = [clip[0] / clip[3], clip[1] / clip[3]];
        let texel = [(ndc[0] + 1.0) * 0.5 * side, (1.0 - ndc[1]) * 0.5 * side];
        let is_inside = |x: f32| x >= 0.0 && x < side;
        if !(clip[3] > 0.0 && is_inside(texel[0]) && is_inside(texel[1])) {
            return false;
        }

        // Describe the place as the light sees it.
        let offset: [f32; 3] = std::array::from_fn(|i| source.position[i] - world[i]);
        let is_spot = source.kind == LightSource::SPOT;
        let row = [m[0][0], m[1][0], m[2][0]];
        let place = ShadowPoint {
            own,
            world,
            towards,
            distance: if is_spot {
                dot(offset, offset).sqrt()
            } else {
                ENDLESS
            },
            facing,
            ndc,
            texel,
            texel_world: 2.0 * clip[3] / (dot(row, row).sqrt() * side),
            map,
        };

        // Test the triangles seen around it.
        let seen = std::array::from_fn(|k| self.seen_near(&place, k as u32));
        self.is_covered(&place, seen)
    }

    /// The triangle plus one in one of the nine texels around a place; 0 if there is none.
    fn seen_near(&self, place: &ShadowPoint, k: u32) -> u32 {
        let side = self.lights.shadow_side;
        let near = |at: f32, step: u32| (at as u32 + step).saturating_sub(1).min(side - 1);
        let (x, y) = (near(place.texel[0], k % 3), near(place.texel[1], k / 3));
        self.shadows[place.map][(y * side + x) as usize]
    }

    /// Whether something covers a place, by the triangles that the light sees around it.
    ///
    /// If one triangle fills all nine texels, it alone decides; of several, each is tested. If they are finer than
    /// texels, none of the nine may be the one that covers the place, and the texels vote.
    fn is_covered(&self, place: &ShadowPoint, seen: [u32; 9]) -> bool {
        let mut distinct = 0;
        for k in 0..9 {
            if seen[..k].contains(&seen[k]) {
                continue;
            }
            distinct += 1;
            if self.covers(place, seen[k]) {
                return true;
            }
        }
        distinct > 1 && self.vote(place, seen)
    }

    /// Whether triangle `id` lies between a place and the light.
    fn covers(&self, place: &ShadowPoint, id: u32) -> bool {
        if id == 0 || id == place.own {
            return false;
        }
        let (world, clip) = self.as_lit(place, id);
        let weights = weights_at(clip, place.ndc);
        let is_inside = weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0;
        if !is_inside {
            return false;
        }
        self.is_between(place, world, weights, self.lights.bias_world)
            && !self.cutout().is_hole_at(id - 1, weights)
    }

    /// The corners of triangle `id` in the world and as the light of a place sees them.
    fn as_lit(&self, place: &ShadowPoint, id: u32) -> ([[f32; 3]; 3], [[f32; 4]; 3]) {
        let corners = self.triangles[(id - 1) as usize].corners;
        let world = corners.map(|v| self.posed[v as usize].world);
        let m = &self.lights.shadows[place.map];
        (world, world.map(|p| apply_point(m, p)))
    }

    /// Whether a point of a triangle is nearer to the light than a place by more than `gap_world`, and not behind the
    /// light.
    fn is_between(
        &self,
        place: &ShadowPoint,
        world: [[f32; 3]; 3],
        weights: [f32; 3],
        gap_world: f32,
    ) -> bool {
        let point = blend3(weights, world);
        let offset = std::array::from_fn(|i| point[i] - place.world[i]);
        let gap = dot(offset, place.towards);
        gap > gap_world && gap < place.distance
    }

    /// Whether the texels around a place vote for a shadow: all nine, or, of fine triangles, more than half of the
    /// nearest four, weighted by nearness. Only texels clearly nearer to the light count; on slopes they must be nearer
    /// still.
    fn vote(&self, place: &ShadowPoint, seen: [u32; 9]) -> bool {
        // Ask for a wider gap on slopes, where a texel spans more depth.
        let side = self.lights.shadow_side as f32;
        let facing = place.facing.max(GRAZING);
        let slope = (1.0 - facing * facing).max(0.0).sqrt() / facing;
        let gap_world = place.texel_world * (2.0 + 2.0 * slope) + self.lights.bias_world;

        // Count the texels whose triangles stand between place and light; weigh fine ones by nearness.
        let corner = place.texel.map(f32::floor);
        let (mut count, mut share) = (0, 0.0);
        for (k, id) in seen.into_iter().enumerate() {
            if id == 0 || id == place.own {
                continue;
            }
            let center = [
                corner[0] + (k % 3) as f32 - 0.5,
                corner[1] + (k / 3) as f32 - 0.5,
            ];
            let ndc = [2.0 * center[0] / side - 1.0, 1.0 - 2.0 * center[1] / side];
            let (world, clip) = self.as_lit(place, id);
            if !self.is_between(place, world, weights_at(clip, ndc), gap_world) {
                continue;
            }
            count += 1;
            if is_fine(clip, side) {
                share += (1.0 - (center[0] - place.texel[0]).abs()).max(0.0)
                    * (1.0 - (center[1] - place.texel[1]).abs()).max(0.0);
            }
        }
        count == 9 || share > 0.5
    }

    fn cutout(&self) -> Cutout<'_> {
        Cutout {
            posed: self.posed,
            vertices: self.vertices,
            triangles: self.triangles,
            parts: self.parts,
            texels: self.texels,
        }
    }
}

/// Whether a triangle is thinner than two texels as the light sees it.
fn is_fine(clip: [[f32; 4]; 3], side: f32) -> bool {
    if clip.iter().any(|v| v[3] <= 0.0) {
        return false;
    }
    let [a, b, c] = clip.map(|v| [v[0] / v[3] * 0.5 * side, v[1] / v[3] * 0.5 * side]);
    let edges = [minus(b, a), minus(c, b), minus(a, c)];
    let area = cross(edges[0], edges[1]).abs();
    let longest = edges.map(|e| e[0] * e[0] + e[1] * e[1]);
    let longest = longest[0].max(longest[1]).max(longest[2]).sqrt();
    area < FINE_TEXELS * longest
}

fn minus(a: [f32; 2], b: [f32; 2]) -> [f32; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose::Compose;
    use crate::lighting::Lights;
    use npr_core::geometry::{Part, PosedVertex, Triangle, Vertex};
    use npr_core::light_view::{distant_view, spot_view};
    use npr_core::raster::{Fill, Sides, fill_triangles};
    use npr_core::surface::unit_or_z;
    use npr_core::window::{View, Window};
    use proptest::prelude::*;
    use std::f32::consts::PI;

    const SIDE: u32 = 256;

    /// Triangles in one light, with what that sees.
    struct Lit {
        posed: Vec<PosedVertex>,
        triangles: Vec<Triangle>,
        lights: Lights,
        image: Vec<u32>,
    }

    impl Lit {
        /// Vertices as position and normal; three make a triangle.
        fn new(vertices: &[[[f32; 3]; 2]], mut lights: Lights) -> Self {
            let side = SIDE as f32;
            (lights.shadow_side, lights.bias_world) = (SIDE, 1e-3);
            lights.sources[0].shadow = 1;
            let posed = vertices.iter().map(|[world, normal]| PosedVertex {
                clip: [world[0], world[1], 0.5, 1.0],
                world: *world,
                normal: *normal,
                ..PosedVertex::default()
            });
            let triangles = (0..vertices.len() as u32 / 3).map(|i| Triangle {
                corners: [3 * i, 3 * i + 1, 3 * i + 2],
                part: 0,
            });
            let mut lit = Self {
                posed: posed.collect(),
                triangles: triangles.collect(),
                lights,
                image: vec![0; (SIDE * SIDE) as usize],
            };
            let fill = Fill {
                window: &Window::over([side; 2], [0.0; 2], [side; 2], [SIDE; 2]),
                triangles: &lit.triangles,
                parts: &[Part::default()],
                sides: Sides::Both,
                id_bits: 0,
                clip_of: |v| apply_point(&lit.lights.shadows[0], lit.posed[v as usize].world),
                keep: |_, _, _| true,
            };
            let mut depths = vec![0; lit.image.len()];
            fill_triangles(&fill, &mut lit.image, &mut depths);
            lit
        }

        /// Which lights a place of triangle `own` lies in the shadow of.
        fn shadowed(&self, own: usize, weights: [f32; 3]) -> u32 {
            let vertices = vec![Vertex::default(); self.posed.len()];
            let (view, window) = (View::default(), Window::default());
            let (compose, rules) = (Compose::default(), crate::backdrop::Rules::default());
            let layers = Layers {
                posed: &self.posed,
                vertices: &vertices,
                triangles: &self.triangles,
                parts: &[Part::default()],
                shadows: [&self.image, &[], &[], &[]],
                ..Layers::empty(&view, &window, &compose, &self.lights, &rules)
            };
            let posed = self.triangles[own].corners.map(|v| &self.posed[v as usize]);
            let corners = Corners {
                posed,
                clip: posed.map(|v| v.clip),
                side: 1.0,
            };
            layers.shadowed(own as u32 + 1, &corners, weights)
        }
    }

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    /// Straight from above, over the square of -1..1.
    fn from_above() -> Lights {
        let mut lights = Lights::distant(UP);
        let reach = [[-1.0, 0.0, -1.0], [1.0, 1.0, 1.0], [-1.0, 0.0, 1.0]];
        lights.shadows[0] = distant_view(UP, &reach, &reach);
        lights
    }

    /// A floor of one triangle that holds the square of -1..1, and weights of a place on it.
    const FLOOR: [[f32; 3]; 3] = [[-9.0, 0.0, -9.0], [9.0, 0.0, -9.0], [0.0, 0.0, 18.0]];

    fn weights_on_floor(x: f32, z: f32) -> [f32; 3] {
        let c = (z + 9.0) / 27.0;
        let b = (x + 9.0 - 9.0 * c) / 18.0;
        [1.0 - b - c, b, c]
    }

    fn over_floor(caster: [[f32; 3]; 3]) -> Vec<[[f32; 3]; 2]> {
        FLOOR.iter().chain(&caster).map(|p| [*p, UP]).collect()
    }

    #[test]
    fn a_square_throws_its_shadow_below_itself_alone() {
        let caster = [[-0.5, 0.4, -0.5], [0.5, 0.4, -0.5], [-0.5, 0.4, 0.5]];
        let lit = Lit::new(&over_floor(caster), from_above());
        let at = |x, z| lit.shadowed(0, weights_on_floor(x, z));
        assert_eq!([at(-0.2, -0.2), at(0.2, 0.2), at(-0.6, 0.0)], [1, 0, 0]);
        // A texel is 1/128 wide; the edge is that of the triangle.
        assert_eq!([at(-0.4999, 0.0), at(-0.5001, 0.0)], [1, 0]);
        assert_eq!(lit.shadowed(1, [0.4, 0.3, 0.3]), 0, "none on itself");
    }

    #[test]
    fn a_spot_throws_shadows_and_only_ahead() {
        let mut lights = Lights::distant(UP);
        lights.sources[0].kind = LightSource::SPOT;
        lights.sources[0].position = [0.0, 2.0, 0.0];
        lights.sources[0].direction = [0.0, -1.0, 0.0];
        lights.shadows[0] = spot_view([0.0, 2.0, 0.0], [0.0, -1.0, 0.0], 0.7, 0.01);
        let caster = [[-0.2, 1.0, -0.2], [0.2, 1.0, -0.2], [0.0, 1.0, 0.2]];
        let lit = Lit::new(&over_floor(caster), lights);
        let at = |x, z| lit.shadowed(0, weights_on_floor(x, z));
        // Half way up, it is twice as large on the floor.
        assert_eq!([at(0.0, 0.0), at(0.35, -0.39), at(0.35, -0.41)], [1, 1, 0]);
        let behind = [[-9.0, 3.0, -9.0], [9.0, 3.0, -9.0], [0.0, 3.0, 9.0]];
        let lit = Lit::new(&over_floor(behind), lights);
        assert_eq!(lit.shadowed(0, weights_on_floor(0.0, 0.0)), 0);
    }

    /// A ball of smooth normals: facets must not shade one another, however coarse they are.
    #[test]
    fn what_is_convex_throws_no_shadow_on_itself() {
        for (rings, sectors) in [(4, 6), (12, 24), (60, 120)] {
            let at = |i: u32, j: u32| {
                let (a, b) = (
                    PI * i as f32 / rings as f32,
                    2.0 * PI * j as f32 / sectors as f32,
                );
                let n = [
                    npr_core::math::sin(a) * npr_core::math::cos(b),
                    npr_core::math::cos(a),
                    npr_core::math::sin(a) * npr_core::math::sin(b),
                ];
                [n, n]
            };
            let mut vertices = Vec::new();
            for (i, j) in (0..rings).flat_map(|i| (0..sectors).map(move |j| (i, j))) {
                let quad = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
                vertices.extend([0, 1, 2, 0, 2, 3].map(|k| quad[k]));
            }
            let towards = unit_or_z([0.3, 0.8, 0.5]);
            let mut lights = Lights::distant(towards);
            let corners = [[-1.0; 3], [1.0; 3], [-1.0, 1.0, 1.0], [1.0, -1.0, -1.0]];
            let more = [
                [1.0, 1.0, -1.0],
                [-1.0, -1.0, 1.0],
                [1.0, -1.0, 1.0],
                [-1.0, 1.0, -1.0],
            ];
            let all = [corners, more].concat();
            lights.shadows[0] = distant_view(towards, &all, &all);
            let lit = Lit::new(&vertices, lights);
            let places = [[0.34, 0.33, 0.33], [0.8, 0.1, 0.1], [0.02, 0.49, 0.49]];
            for own in 0..lit.triangles.len() {
                for weights in places {
                    assert_eq!(
                        lit.shadowed(own, weights),
                        0,
                        "{rings} rings, {own} {weights:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn hostile_places_are_lit() {
        let lit = Lit::new(&over_floor([[0.0, f32::NAN, 0.0]; 3]), from_above());
        assert_eq!(lit.shadowed(0, weights_on_floor(0.0, 0.0)), 0);
        assert_eq!(lit.shadowed(0, [f32::NAN; 3]), 0);
        assert_eq!(
            lit.shadowed(0, weights_on_floor(5.0, 0.0)),
            0,
            "beside the image"
        );
        assert_eq!(lit.shadowed(1, [0.3; 3]), 0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        /// The oracle is which side of an edge a place lies on.
        #[test]
        fn edges_of_shadows_are_those_of_triangles(
            px in prop::array::uniform3(prop::array::uniform2(-0.9f32..0.9)), height in 0.05f32..0.9,
            along in 0.3f32..0.7, texels in prop_oneof![-1f32..-0.02, 0.02f32..1.0], edge in 0usize..3,
        ) {
            let [a, b, c] = [px[edge], px[(edge + 1) % 3], px[(edge + 2) % 3]];
            let length = |v: [f32; 2]| (v[0] * v[0] + v[1] * v[1]).sqrt();
            let minus = |a: [f32; 2], b: [f32; 2]| [a[0] - b[0], a[1] - b[1]];
            let (ab, ac) = (minus(b, a), minus(c, a));
            let area = cross(ab, ac);
            let longest = length(ab).max(length(ac)).max(length(minus(c, b)));
            // Edges and heights of many texels, so that what is beside an edge is away from the others.
            prop_assume!(area.abs() / longest > 0.2 && length(ab) > 0.2);
            let inwards = area.signum() * texels / 128.0 / length(ab);
            let place = [
                a[0] + ab[0] * along - ab[1] * inwards,
                a[1] + ab[1] * along + ab[0] * inwards,
            ];
            let caster = px.map(|[x, z]| [x, height, z]);
            let lit = Lit::new(&over_floor(caster), from_above());
            let dark = lit.shadowed(0, weights_on_floor(place[0], place[1]));
            prop_assert_eq!(dark == 1, texels > 0.0);
        }
    }
}
