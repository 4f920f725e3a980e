//! Highlights as comics draw them: crisp spots, soft spots, light from behind and straight streaks.
//!
//! Pure functions, one per equation; `lib/gloss` repeats them for passes. All vectors are unit vectors in the world:
//! the normal N, L towards the light, E towards the eye.

use crate::compose::Layers;
use crate::corners::Corners;
use crate::lighting::LightSource;
use npr_core::geometry::Part;
use npr_core::math;
use npr_core::surface::{dot, unit_or_z};

/// Phong's term (L . R)^n with R = 2 (N . E) N - E, the view mirrored at the surface [Suzuki 2004, section 3.6].
///
/// 0 where light comes from behind. `exponent` 1..1000: 200 a small hard spot, 50 a wide one.
pub fn phong(normal: [f32; 3], light: [f32; 3], eye: [f32; 3], exponent: f32) -> f32 {
    let facing = 2.0 * dot(normal, eye);
    let mirrored: [f32; 3] = std::array::from_fn(|i| facing * normal[i] - eye[i]);
    if dot(normal, light) <= 0.0 {
        return 0.0;
    }
    power(dot(light, mirrored), exponent)
}

/// Blinn's term (N . H)^n with the half vector H: its middle is where Phong's is [Blinn 1977; Suzuki 2004, section
/// 3.6].
pub fn blinn_phong(normal: [f32; 3], half: [f32; 3], exponent: f32) -> f32 {
    power(dot(normal, half), exponent)
}

/// The unit vector half way between light and eye.
pub fn half_vector(light: [f32; 3], eye: [f32; 3]) -> [f32; 3] {
    unit_or_z(std::array::from_fn(|i| light[i] + eye[i]))
}

/// A crisp highlight: 1 where the term exceeds `threshold`, else 0.
pub fn crisp(term: f32, threshold: f32) -> f32 {
    if term > threshold { 1.0 } else { 0.0 }
}

/// A soft highlight ((I - b) (5b/2 + I)^m) / 2 for a term I over the threshold b, clamped to 0..1 [Suzuki 2004,
/// section 3.6].
///
/// Differs: the paper's expression exceeds 1 for m >= 2 and is cut off there. m 0.5 a haze, 2 a spot with a soft rim.
pub fn gradient(term: f32, threshold: f32, m: f32) -> f32 {
    if term <= threshold {
        return 0.0;
    }
    let base = 2.5 * threshold + term;
    let lift = if m == 1.0 { base } else { math::powf(base, m) };
    ((term - threshold) * lift * 0.5).clamp(0.0, 1.0)
}

/// Turns a vector given along the camera's axes into the world.
pub(crate) fn in_world(axes: &[[f32; 3]; 3], direction: [f32; 3]) -> [f32; 3] {
    let [right, up, near] = axes;
    std::array::from_fn(|i| right[i] * direction[0] + up[i] * direction[1] + near[i] * direction[2])
}

/// How much light from behind brightens a rim: a smooth step from 0 to 1 between `from` and `to`, over the ramp
/// coordinate ((L . N) + 1) / 2 of that light [Suzuki 2004, section 3.6].
pub fn back_light(normal: [f32; 3], light: [f32; 3], from: f32, to: f32) -> f32 {
    math::smoothstep(from, to, crate::ramp::ramp_coordinate(dot(normal, light)))
}

/// 1 on a straight streak and on the thin one beside it, 0 elsewhere.
///
/// `across` is a position measured across the streaks, in radii of the model, from the middle of the first; the
/// second has a third of its `width` and lies as far away as the first is wide. Light does not move them: they are
/// drawn as on glass.
pub fn streak(across: f32, width: f32) -> f32 {
    let first = across.abs() < 0.5 * width;
    let second = (across - width * 1.0).abs() < width / 6.0;
    if first || second { 1.0 } else { 0.0 }
}

/// Moves and shapes a highlight by moving the half vector at every point [Anjyo and Hiramitsu 2003].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HighlightShape {
    /// Moves the highlight along both axes; 0.3 is a clear step.
    pub shift: [f32; 2],
    /// Cosine and sine of the angle by which the axes are turned.
    pub turn: [f32; 2],
    /// Stretches the highlight along the first axis, 0..1.
    pub stretch: f32,
    /// Splits the highlight along both axes: the gap as a part of a unit vector.
    pub split: [f32; 2],
    /// Makes the highlight a square, 0..1.
    pub square: f32,
}

impl Default for HighlightShape {
    fn default() -> Self {
        Self {
            shift: [0.0; 2],
            turn: [1.0, 0.0],
            stretch: 0.0,
            split: [0.0; 2],
            square: 0.0,
        }
    }
}

/// How far a corner is pulled in so that the highlight reaches there as far as a square does: 1 - sqrt(1/2).
const SQUARE_PULL: f32 = 0.292_893_2;

/// The half vector, moved so that the highlight takes the shape; unchanged if the shape leaves it as it is.
///
/// The axes are the picture's: `right` laid onto the surface, turned, and the direction across it. The operations
/// follow one another as in the paper: move, stretch, split, square.
pub fn shaped_half(
    half: [f32; 3],
    normal: [f32; 3],
    right: [f32; 3],
    shape: &HighlightShape,
) -> [f32; 3] {
    if shape.is_none() {
        return half;
    }
    let inwards = dot(right, normal);
    let flat = unit_or_z(std::array::from_fn(|i| right[i] - normal[i] * inwards));
    let side = cross(normal, flat);
    let [cos, sin] = shape.turn;
    let u: [f32; 3] = std::array::from_fn(|i| flat[i] * cos + side[i] * sin);
    let v: [f32; 3] = std::array::from_fn(|i| side[i] * cos - flat[i] * sin);
    let moved = plus(half, u, -shape.shift[0], v, -shape.shift[1]);
    let stretched = plus(moved, u, -shape.stretch * dot(moved, u), v, 0.0);
    let gap = |axis: [f32; 3], width: f32| -width * sign(dot(stretched, axis));
    let split = plus(
        stretched,
        u,
        gap(u, shape.split[0]),
        v,
        gap(v, shape.split[1]),
    );
    if shape.square == 0.0 {
        return split;
    }
    let (along, across) = (dot(split, u), dot(split, v));
    let size = (along * along + across * across).sqrt().max(1e-6);
    // sin(2 theta) of the angle to the nearer axis: its fourth power pushes corners out and leaves sides straight.
    let corner = 2.0 * along * across / (size * size);
    let pull = shape.square * SQUARE_PULL * corner * corner * corner * corner;
    plus(split, u, -pull * along, v, -pull * across)
}

fn plus(base: [f32; 3], a: [f32; 3], by_a: f32, b: [f32; 3], by_b: f32) -> [f32; 3] {
    unit_or_z(std::array::from_fn(|i| base[i] + a[i] * by_a + b[i] * by_b))
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn sign(x: f32) -> f32 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// `base` to a power; 0 if `base` is not positive.
fn power(base: f32, exponent: f32) -> f32 {
    if base <= 0.0 {
        return 0.0;
    }
    math::powf(base.min(1.0), exponent)
}

/// Margin for rounding between the cosine of blended unit vectors and its bound.
const SPOT_ROOM: f32 = 1e-4;

/// Upper bound of N . H for one light, where N and the direction to the eye are blends of those at three corners,
/// scaled to unit length.
///
/// `swells` are the bounds from [`swell`] for the normals and for the directions to the eye.
fn highest_cosine(
    normals: [[f32; 3]; 3],
    eyes: [[f32; 3]; 3],
    swells: [f32; 2],
    light: [f32; 3],
) -> f32 {
    let sums = eyes.map(|eye| std::array::from_fn(|k| light[k] + eye[k]));
    let most = normals
        .iter()
        .flat_map(|normal| sums.iter().map(|sum| dot(*normal, *sum)))
        .fold(0.0, f32::max);
    let least = eyes.map(|eye| dot(light, eye));
    let least = least[0].min(least[1]).min(least[2]);
    let least = least.min(least * swells[1]);
    // N . (L + E) over |L + E|; E is longer than the mean of the corners' directions by up to its swell.
    let above = swells[0] * (swells[1] * most + swells[1] - 1.0);
    above / (2.0 + 2.0 * least).max(0.0).sqrt()
}

/// One over the least length that a mean of three unit vectors can have; infinite where they may cancel.
fn swell(units: [[f32; 3]; 3]) -> f32 {
    let [a, b, c] = units;
    let closest = dot(a, b).min(dot(b, c)).min(dot(c, a)).min(1.0);
    1.0 / closest.max(0.0).sqrt()
}

impl HighlightShape {
    /// Whether the shape leaves a highlight as it is; turned axes alone do nothing.
    fn is_none(&self) -> bool {
        self.shift == [0.0; 2]
            && self.stretch == 0.0
            && self.split == [0.0; 2]
            && self.square == 0.0
    }

    /// The shape of a part's highlights.
    fn of(part: &Part) -> Self {
        let ([shift_u, shift_v, stretch, square], [cos, sin, split_u, split_v]) =
            (part.highlight_shape, part.highlight_turn);
        Self {
            shift: [shift_u, shift_v],
            turn: [cos, sin],
            stretch,
            split: [split_u, split_v],
            square,
        }
    }
}

/// Exponent up to which a soft spot is so wide that one place of a pixel stands for all.
const GENTLE_EXPONENT: f32 = 100.0;

/// Whether a part's highlights change so gently that one place of a pixel stands for all.
pub(crate) fn shines_gently(part: &Part) -> bool {
    let [_, _, split_u, split_v] = part.highlight_turn;
    part.flags & Part::HIGHLIGHTS == Part::SOFT
        && part.highlight[0] <= GENTLE_EXPONENT
        && split_u == 0.0
        && split_v == 0.0
}

impl Layers<'_> {
    /// Light that a part's highlights add at a place; bits of `dark` are the lights that do not reach it.
    pub(crate) fn highlights_at(
        &self,
        part: &Part,
        world: [f32; 3],
        normal: [f32; 3],
        dark: u32,
    ) -> [f32; 3] {
        // Sum what each kind of highlight adds.
        let mut sum = [0.0; 3];
        let mut add = |color: [f32; 4], amount: f32| {
            for (sum, c) in sum.iter_mut().zip(color) {
                *sum += c * (color[3] * amount);
            }
        };

        // Add the spot.
        let eye = self.view.to_eye(world);
        if part.flags & (Part::CRISP | Part::SOFT) != 0 {
            let (term, [_, threshold, m, _]) =
                (self.term_at(part, world, normal, eye, dark), part.highlight);
            let amount = if part.flags & Part::CRISP != 0 {
                crisp(term, threshold)
            } else {
                gradient(term, threshold, m)
            };
            add(part.highlight_color, amount);
        }

        // Add the light from behind.
        let [from, to, width, facing] = part.back;
        if part.flags & Part::BACK_LIGHT != 0 {
            let behind = in_world(&self.compose.axes(), part.back_direction);
            add(part.back_color, back_light(normal, behind, from, to));
        }

        // Add the streak, where the surface faces the eye.
        if part.flags & Part::STREAK != 0 && dot(normal, eye).abs() > facing {
            let offset: [f32; 3] = std::array::from_fn(|i| world[i] - self.compose.center_world[i]);
            let [right, up] = part.streak_across;
            let aside = in_world(&self.compose.axes(), [right, up, 0.0]);
            let aside = aside.map(|axis| axis / self.compose.radius);
            let across = dot(offset, aside) - part.highlight[3];
            add(part.highlight_color, streak(across, width));
        }
        sum
    }

    /// Whether a part's highlights may show somewhere on a triangle. Only `false` is certain: shapes, streaks, Phong's
    /// term and near lights always give `true`.
    pub(crate) fn may_shine(&self, part: &Part, corners: &Corners<'_>) -> bool {
        let behind = || in_world(&self.compose.axes(), part.back_direction);
        let rim = part.flags & Part::BACK_LIGHT != 0
            && corners.range_towards(behind())[1] >= part.back[0];
        let spot =
            part.flags & (Part::CRISP | Part::SOFT) != 0 && self.spot_may_show(part, corners);
        rim || spot || part.flags & Part::STREAK != 0
    }

    /// Whether (N . H)^n may exceed the part's threshold somewhere on a triangle. The strength of a light, 1 at most,
    /// only lowers the term, so `false` stays certain.
    fn spot_may_show(&self, part: &Part, corners: &Corners<'_>) -> bool {
        if part.flags & Part::PHONG != 0 || !HighlightShape::of(part).is_none() {
            return true;
        }
        let normals = corners.posed.map(|v| v.normal.map(|n| n * corners.side));
        let eyes = corners.posed.map(|v| self.view.to_eye(v.world));
        let swells = [swell(normals), swell(eyes)];
        let lights = &self.lights.sources[..self.lights.count as usize];
        lights.iter().any(|source| {
            if source.kind == LightSource::SKY {
                return false;
            }
            let highest = highest_cosine(normals, eyes, swells, source.direction);
            // The comparison is negated so that NaN counts as a highlight that shows.
            !(source.is_far() && power(highest + SPOT_ROOM, part.highlight[0]) <= part.highlight[1])
        })
    }

    /// The greatest highlight term of all lights at a place, each scaled by its strength there; skies have none.
    ///
    /// The strength I_s of a light scales its term, as it scales the tones: a highlight ends with the cone of a spot
    /// and with the range of a lamp. Differs: a light stronger than 1 counts as 1, so terms stay within 0..1.
    fn term_at(
        &self,
        part: &Part,
        world: [f32; 3],
        normal: [f32; 3],
        eye: [f32; 3],
        dark: u32,
    ) -> f32 {
        // Leave out lights whose shadow falls here, and skies.
        let exponent = part.highlight[0];
        let shape = HighlightShape::of(part);
        let lights = &self.lights.sources[..self.lights.count as usize];
        let terms = lights.iter().enumerate().map(|(i, source)| {
            if (dark >> i) & 1 != 0 || source.kind == LightSource::SKY {
                return 0.0;
            }

            // Reflect the rest by Phong or by the shaped half vector.
            let (light, strength) = source.reach_at(world);
            let strength = strength.min(1.0);
            if part.flags & Part::PHONG != 0 {
                return phong(normal, light, eye, exponent) * strength;
            }
            if dot(normal, light) <= 0.0 {
                return 0.0;
            }
            let right = self.compose.right_world;
            let half = shaped_half(half_vector(light, eye), normal, right, &shape);
            blinn_phong(normal, half, exponent) * strength
        });
        terms.fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UP: [f32; 3] = [0.0, 0.0, 1.0];

    #[test]
    fn both_terms_are_1_where_the_eye_sees_the_mirrored_light() {
        let (light, eye) = ([0.6, 0.0, 0.8], [-0.6, 0.0, 0.8]);
        assert!((phong(UP, light, eye, 50.0) - 1.0).abs() < 1e-5);
        assert!((blinn_phong(UP, half_vector(light, eye), 50.0) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn phong_by_hand() {
        // R of an upright view is the normal, so L . R = 0.8.
        assert!((phong(UP, [0.6, 0.0, 0.8], UP, 2.0) - 0.64).abs() < 1e-6);
        assert_eq!(phong(UP, [0.6, 0.0, -0.8], UP, 2.0), 0.0);
        // No light from behind is mirrored, even where the eye is behind too.
        assert_eq!(phong(UP, [-0.6, 0.0, -0.8], [0.6, 0.0, -0.8], 2.0), 0.0);
    }

    #[test]
    fn the_soft_highlight_by_hand() {
        assert_eq!(gradient(0.5, 0.5, 2.0), 0.0);
        // (0.9 - 0.5) (1.25 + 0.9) / 2
        assert!((gradient(0.9, 0.5, 1.0) - 0.43).abs() < 1e-6);
        assert_eq!(gradient(1.0, 0.2, 4.0), 1.0);
    }

    #[test]
    fn a_crisp_highlight_has_no_rim() {
        assert_eq!(
            [0.49, 0.5, 0.51].map(|term| crisp(term, 0.5)),
            [0.0, 0.0, 1.0]
        );
    }

    #[test]
    fn light_from_behind_reaches_the_rim() {
        let behind = [0.0, 0.6, -0.8];
        assert_eq!(back_light(UP, behind, 0.6, 0.7), 0.0);
        assert_eq!(back_light(behind, behind, 0.6, 0.7), 1.0);
    }

    #[test]
    fn the_ramp_of_light_from_behind_rises_softly() {
        let at = |x: f32| {
            // L . N of a ramp coordinate.
            let cosine = 2.0 * x - 1.0;
            let normal = [(1.0 - cosine * cosine).sqrt(), 0.0, cosine];
            back_light(normal, UP, 0.6, 0.8)
        };
        let row: Vec<f32> = (0..=100).map(|i| at(i as f32 / 100.0)).collect();
        assert!(row[..60].iter().all(|v| *v == 0.0) && row[81..].iter().all(|v| *v == 1.0));
        assert!((row[70] - 0.5).abs() < 1e-3, "half way: {}", row[70]);
        assert!(
            row.windows(2)
                .all(|pair| (0.0..0.1).contains(&(pair[1] - pair[0]))),
            "{row:?}"
        );
    }

    #[test]
    fn a_streak_has_a_thin_one_beside_it() {
        let at = [0.0, 0.09, 0.14, 0.2, 0.25].map(|x| streak(x, 0.2));
        assert_eq!(at, [1.0, 1.0, 0.0, 1.0, 0.0]);
    }

    #[test]
    fn a_shape_of_nothing_leaves_the_half_vector() {
        let half = half_vector([0.6, 0.0, 0.8], UP);
        let same = shaped_half(half, UP, [1.0, 0.0, 0.0], &HighlightShape::default());
        assert!((0..3).all(|i| (half[i] - same[i]).abs() < 1e-6), "{same:?}");
    }

    #[test]
    fn a_square_reaches_farther_at_its_corners() {
        let shape = HighlightShape {
            square: 1.0,
            ..HighlightShape::default()
        };
        let term = |x: f32, y: f32| {
            let normal = unit_or_z([x, y, 1.0]);
            blinn_phong(
                normal,
                shaped_half(UP, normal, [1.0, 0.0, 0.0], &shape),
                50.0,
            )
        };
        let side = term(0.2, 0.0);
        assert!((term(0.19, 0.19) - side).abs() < 0.1, "the corner");
        assert!((term(0.2, 0.1) - side).abs() < 0.1, "along the side");
    }

    #[test]
    fn splitting_leaves_a_gap_in_the_middle() {
        let shape = HighlightShape {
            split: [0.3, 0.0],
            ..HighlightShape::default()
        };
        let term = |x: f32| {
            let normal = unit_or_z([x, 0.0, 1.0]);
            blinn_phong(
                normal,
                shaped_half(UP, normal, [1.0, 0.0, 0.0], &shape),
                50.0,
            )
        };
        assert!(term(0.0) < 0.2, "the middle");
        assert!(term(0.3) > 0.9 && term(-0.3) > 0.9, "both halves");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn terms_and_highlights_stay_within_0_and_1(
            vectors in prop::array::uniform3(prop::array::uniform3(-1f32..1.0)),
            exponent in 1f32..1000.0, threshold in 0f32..1.0, m in 0f32..8.0,
            shift in prop::array::uniform2(-1f32..1.0), split in prop::array::uniform2(0f32..1.0),
            stretch in 0f32..1.0, square in 0f32..1.0,
        ) {
            let [normal, light, eye] = vectors.map(unit_or_z);
            let shape = HighlightShape { shift, split, stretch, square, turn: [0.6, 0.8] };
            let half = shaped_half(half_vector(light, eye), normal, [1.0, 0.0, 0.0], &shape);
            for term in [phong(normal, light, eye, exponent), blinn_phong(normal, half, exponent)] {
                prop_assert!((0.0..=1.0).contains(&term), "{term}");
                prop_assert!((0.0..=1.0).contains(&gradient(term, threshold, m)));
            }
        }

        #[test]
        fn a_smaller_exponent_never_shrinks_a_highlight(cos in 0f32..1.0, exponent in 1f32..500.0, less in 0f32..1.0) {
            let normal = unit_or_z([(1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos]);
            prop_assert!(blinn_phong(normal, UP, exponent * less) >= blinn_phong(normal, UP, exponent) - 1e-6);
        }
    }
}
