//! Outlines of spheres, found from the spheres' silhouettes.
//!
//! For a pixel of a sphere, the nearest point of the silhouette is known, and the picture just beyond it says whether
//! it is an outline: nothing lies there, or smoke far behind. So lines are as smooth as circles and as wide as wanted.
//!
//! No line appears or ends at once. Its width grows from nothing with the jump in depth; where the picture beyond the
//! silhouette changes, it runs out along the silhouette like the stroke of a brush.

use npr_core::geometry::FAR_DEPTH;
use npr_core::math;
use npr_core::smoke::{SphereView, ViewSphere};
use npr_core::surface::{dot, unit_or_z};

use super::SmokeLook;
use super::resolve::Resolving;

/// Distance beyond a silhouette at which the picture is looked at, in pixels: so far that the middle of that pixel lies
/// beyond it too.
const BEYOND_PX: f32 = 1.25;

/// Length over which lines run out along the silhouette, in line widths.
const TAPER: f32 = 3.0;

/// Looks beyond the silhouette on each side of a place, over the length in which lines run out.
const LOOKS: u32 = 8;

/// Greatest width of a puff's line, in radii of the puff: a speck that swells does not start as a blot.
const THICKEST: f32 = 0.2;

/// Multiple of the least jump at which a line is as wide as lines inside the smoke get.
const INNER_JUMP: f32 = 4.0;

/// Multiple of the least jump at which a line is as wide as the outer line.
const OUTER_JUMP: f32 = 16.0;

/// A point of a sphere's silhouette.
#[derive(Debug, Clone, Copy)]
struct Silhouette {
    /// Frame position.
    px: [f32; 2],
    /// Unit vector away from the sphere, in the frame.
    outward: [f32; 2],
    /// View depth.
    depth: f32,
}

/// The silhouette of a ball in a direction.
struct Disc {
    /// Unit vector to the middle, and two across it; the first of these leads towards the ray that was asked for.
    axes: [[f32; 3]; 3],
    /// Distance of the silhouette along the axis; its radius across follows.
    along: f32,
    across: f32,
    middle_px: [f32; 2],
}

impl Disc {
    fn new(lens: &SphereView, ball: &ViewSphere, ray: [f32; 2]) -> Self {
        let (axis, towards, along, across);
        if lens.perspective > 0.5 && lens.discs < 0.5 {
            let square = dot(ball.center, ball.center);
            let distance = square.sqrt();
            axis = ball.center.map(|v| v / distance);
            towards = [ray[0], ray[1], 1.0];
            // Rays from the eye touch the sphere in a circle a little nearer and narrower than its own.
            let shrunk = (1.0 - ball.radius * ball.radius / square).max(0.0);
            along = distance * shrunk;
            across = ball.radius * shrunk.sqrt();
        } else {
            axis = [0.0, 0.0, 1.0];
            let place = lens.place_at(ray, ball.center[2]);
            towards = [place[0] - ball.center[0], place[1] - ball.center[1], 0.0];
            along = ball.center[2];
            across = ball.radius;
        }
        let part = dot(towards, axis);
        let first = unit_or_z(std::array::from_fn(|i| towards[i] - axis[i] * part));
        let second = [
            axis[1] * first[2] - axis[2] * first[1],
            axis[2] * first[0] - axis[0] * first[2],
            axis[0] * first[1] - axis[1] * first[0],
        ];
        Self {
            axes: [axis, first, second],
            along,
            across,
            middle_px: lens.frame_of(ball.center),
        }
    }

    /// The point of the silhouette at an angle from the ray, given by its sine and cosine.
    fn silhouette(&self, lens: &SphereView, ball: &ViewSphere, [sin, cos]: [f32; 2]) -> Silhouette {
        let [axis, first, second] = self.axes;
        let middle = if lens.perspective > 0.5 && lens.discs < 0.5 {
            axis.map(|v| v * self.along)
        } else {
            ball.center
        };
        let place =
            std::array::from_fn(|i| middle[i] + (first[i] * cos + second[i] * sin) * self.across);
        let px = lens.frame_of(place);
        let out = [px[0] - self.middle_px[0], px[1] - self.middle_px[1]];
        let length = (out[0] * out[0] + out[1] * out[1]).sqrt().max(1e-12);
        Silhouette {
            px,
            outward: [out[0] / length, out[1] / length],
            depth: place[2],
        }
    }
}

impl Resolving<'_> {
    /// How much the outline of sphere `id` covers of a position of the frame within its image, 0..1.
    pub(super) fn line_at(&self, id: u32, frame_px: [f32; 2]) -> f32 {
        let ball = &self.balls[(id - 1) as usize];
        let widest = self.look.line_px * (1.0 + self.look.swell);
        let ray = self.lens.ray(frame_px);
        if self.is_far_inside(ball, ray, widest + 0.5) {
            return 0.0;
        }
        let disc = Disc::new(self.lens, ball, ray);
        let silhouette = disc.silhouette(self.lens, ball, [0.0, 1.0]);
        let away = inside_by(&silhouette, frame_px).max(0.0);
        let radius_px = distance(silhouette.px, disc.middle_px);
        let whole = self.look.whole_width(silhouette.outward, radius_px);
        let mut part = self.part_beyond(ball, &silhouette);
        // Let lines nearby run out to here.
        let step = TAPER * self.look.line_px / ((LOOKS + 1) as f32 * radius_px.max(1.0));
        for k in 1..=LOOKS {
            let left = 1.0 - k as f32 / (LOOKS + 1) as f32;
            // Usual case: even the widest line adds nothing from here on.
            if left <= part || whole * left + 0.5 <= away {
                break;
            }
            let sin = (k as f32 * step).min(0.7);
            for sin in [-sin, sin] {
                let silhouette = disc.silhouette(self.lens, ball, [sin, (1.0 - sin * sin).sqrt()]);
                part = part.max(left * self.part_beyond(ball, &silhouette));
            }
        }
        coverage(whole * part, away)
    }

    /// Whether a ray certainly passes farther than `reach_px` inside the silhouette of a ball.
    fn is_far_inside(&self, ball: &ViewSphere, ray: [f32; 2], reach_px: f32) -> bool {
        let room = self.lens.pixel_at(ball.center[2] + ball.radius) * reach_px;
        let start = self.lens.place_at(ray, 0.0);
        let towards = self.lens.place_at(ray, 1.0);
        let towards: [f32; 3] = std::array::from_fn(|i| towards[i] - start[i]);
        let offset: [f32; 3] = std::array::from_fn(|i| ball.center[i] - start[i]);
        let middle = dot(offset, towards) / dot(towards, towards);
        let beside: [f32; 3] = std::array::from_fn(|i| offset[i] - towards[i] * middle);
        let inner = (ball.radius - room).max(0.0);
        dot(beside, beside) < inner * inner
    }

    /// Width of a sphere's outline at a point of its silhouette, as a part of the whole, by the picture beyond; 0 if
    /// that point is hidden.
    fn part_beyond(&self, ball: &ViewSphere, silhouette: &Silhouette) -> f32 {
        let beyond = std::array::from_fn(|i| {
            silhouette.px[i] + silhouette.outward[i] * BEYOND_PX * self.window.frame_step[i]
        });
        let [x, y] = self.window.pixel_at(beyond);
        let depth = self.pixels[(y * self.window.size[0] + x) as usize].depth;
        self.look.part_at((depth - silhouette.depth) / ball.radius)
    }

    /// The published line: 1 where depths of diagonal neighbours differ [Hoshino 2004, section 3.5].
    ///
    /// Depths run from 0 at the front of the smoke to 1 at its back and behind it. The result is the darkness 1 - l.
    pub(super) fn published_line(&self, x: u32, y: u32) -> f32 {
        let d = |dx: i32, dy: i32| {
            let depth = self.pixels[self.texel_near(x, y, dx, dy)].depth;
            let place = (depth - self.look.depth_start) / self.look.depth_size;
            if depth >= FAR_DEPTH {
                1.0
            } else {
                place.clamp(0.0, 1.0)
            }
        };
        let (a, b) = (d(-1, 1) - d(1, -1), d(-1, -1) - d(1, 1));
        (self.look.line_weight * (a * a + b * b)).clamp(0.0, 1.0)
    }
}

impl SmokeLook {
    /// Width of a puff's outline in frame pixels where the next smoke lies `jump` radii behind it; 0 if the jump is too
    /// small.
    ///
    /// Full where nothing lies behind; inside the smoke it grows from nothing with the jump in depth. `outward` is
    /// the unit vector away from the puff in the picture, y down: lines swell away from the light.
    pub fn line_width(&self, jump: f32, outward: [f32; 2], radius_px: f32) -> f32 {
        self.whole_width(outward, radius_px) * self.part_at(jump)
    }

    /// Width of the outer line of a puff in frame pixels.
    fn whole_width(&self, outward: [f32; 2], radius_px: f32) -> f32 {
        let towards = self.towards_light;
        let facing = outward[0] * towards[0] - outward[1] * towards[1];
        self.line_px.min(THICKEST * radius_px) * (1.0 - self.swell * facing)
    }

    /// Width of a line at a jump in depth, in radii, as a part of the whole.
    fn part_at(&self, jump: f32) -> f32 {
        let from = self.line_from;
        let inner = math::smoothstep(from, from * INNER_JUMP, jump);
        let outer = math::smoothstep(from * INNER_JUMP, from * OUTER_JUMP, jump);
        if jump <= 0.0 {
            return 0.0;
        }
        self.line_inner * inner + (1.0 - self.line_inner) * outer
    }
}

/// Distance of a position inwards from its silhouette, in pixels; negative outside.
fn inside_by(silhouette: &Silhouette, frame_px: [f32; 2]) -> f32 {
    (silhouette.px[0] - frame_px[0]) * silhouette.outward[0]
        + (silhouette.px[1] - frame_px[1]) * silhouette.outward[1]
}

fn distance(a: [f32; 2], b: [f32; 2]) -> f32 {
    let d = [a[0] - b[0], a[1] - b[1]];
    (d[0] * d[0] + d[1] * d[1]).sqrt()
}

/// How much of a pixel a line covers that reaches inwards from the silhouette by `width`, where the pixel's middle lies
/// `away` from it.
fn coverage(width: f32, away: f32) -> f32 {
    (width - away + 0.5).clamp(0.0, 1.0) * width.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::smoke::SmokeLook;
    use crate::smoke::resolve::resolve;
    use npr_core::color::{linear_from_srgb, srgb_from_linear};
    use npr_core::smoke::SmokePixel;
    use npr_core::window::Window;
    use proptest::prelude::*;

    const SIDE: u32 = 5;

    /// Depths of a picture in parts of the smoke's depth; `None` where nothing is seen.
    type Depths = [[Option<f32>; SIDE as usize]; SIDE as usize];

    const GREY: f32 = 0.5;
    const LINE: [f32; 4] = [0.25, 0.0, 0.125, 1.0];

    /// A look of one grey tone under published lines, for smoke from depth 10 to 30.
    fn look(weight: f32) -> SmokeLook {
        let mut ramp = [[1.0, 1.0, 1.0, 2.0]; 8];
        ramp[0] = [GREY, GREY, GREY, 0.0];
        SmokeLook {
            flags: SmokeLook::PUBLISHED,
            depth_start: 10.0,
            depth_size: 20.0,
            line_weight: weight,
            line_color: LINE,
            alpha: 1.0,
            samples: 1,
            ramp,
            ..SmokeLook::default()
        }
    }

    /// What is asked of a picture of these depths.
    fn with_picture<T>(depths: &Depths, weight: f32, ask: impl FnOnce(&Resolving<'_>) -> T) -> T {
        let pixel = |part: &Option<f32>| SmokePixel {
            depth: part.map_or(FAR_DEPTH, |part| 10.0 + 20.0 * part),
            ..SmokePixel::default()
        };
        let pixels: Vec<SmokePixel> = depths.iter().flatten().map(pixel).collect();
        let ids = depths.iter().flatten();
        let ids: Vec<u32> = ids.map(|part| u32::from(part.is_some())).collect();
        let extent = [SIDE as f32; 2];
        ask(&Resolving {
            lens: &SphereView::default(),
            window: &Window::over(extent, [0.0; 2], extent, [SIDE; 2]),
            look: &look(weight),
            ids: &ids,
            balls: &[ViewSphere::default()],
            tones: &vec![1.0; pixels.len()],
            pixels: &pixels,
        })
    }

    /// Equations of section 3.5 as they stand: l' from the depth image d, 1 where nothing is seen, and l = 1 - w l',
    /// not below 0. Beyond the picture its border goes on.
    fn published(depths: &Depths, w: f64, x: i64, y: i64) -> f64 {
        let d = |x: i64, y: i64| {
            let last = i64::from(SIDE) - 1;
            let part = depths[y.clamp(0, last) as usize][x.clamp(0, last) as usize];
            part.map_or(1.0, |part| f64::from(part).clamp(0.0, 1.0))
        };
        let l_prime = (d(x - 1, y + 1) - d(x + 1, y - 1)).powi(2)
            + (d(x - 1, y - 1) - d(x + 1, y + 1)).powi(2);
        (1.0 - w * l_prime).max(0.0)
    }

    #[test]
    fn differences_between_diagonal_neighbours_make_the_line() {
        let mut depths: Depths = [[Some(0.5); 5]; 5];
        (depths[3][1], depths[1][3]) = (Some(0.75), Some(0.25));
        (depths[1][1], depths[3][3]) = (Some(0.5), Some(0.375));
        // l' = (0.75 - 0.25)^2 + (0.5 - 0.375)^2 = 0.265625 in the middle.
        for (weight, darkness) in [(0.0, 0.0), (1.0, 0.265_625), (2.0, 0.531_25), (4.0, 1.0)] {
            let line = with_picture(&depths, weight, |picture| picture.published_line(2, 2));
            assert!((line - darkness).abs() < 1e-6, "{weight}: {line}");
        }
        // Beside itself a pixel does not count, nor do those right beside it.
        depths[2] = [Some(0.0); 5];
        let line = with_picture(&depths, 1.0, |picture| picture.published_line(2, 2));
        assert!((line - 0.265_625).abs() < 1e-6, "{line}");
    }

    #[test]
    fn nothing_counts_as_the_back_of_the_smoke() {
        let mut depths: Depths = [[None; 5]; 5];
        let empty = with_picture(&depths, 100.0, |picture| picture.published_line(2, 2));
        assert_eq!(empty, 0.0);
        depths[1][1] = Some(0.5);
        let beside = with_picture(&depths, 1.0, |picture| picture.published_line(2, 2));
        assert!((beside - 0.25).abs() < 1e-6);
        depths[1][1] = Some(1.0);
        let back = with_picture(&depths, 100.0, |picture| picture.published_line(2, 2));
        assert_eq!(back, 0.0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// However the jump, the rule and the place are chosen, a line that is not there begins as nothing, and a small
        /// change of the jump is a small change of what it covers.
        #[test]
        fn lines_grow_from_nothing_without_a_leap(
            from in 0.01f32..10.0, inner in 0f32..=1.0, times in 0f32..20.0, more in 0f32..0.05, away in 0f32..8.0,
            radius_px in 0f32..60.0, outward in prop::sample::select(vec![[1.0f32, 0.0], [0.0, -1.0], [-0.6, 0.8]]),
        ) {
            let look = SmokeLook {
                line_px: 3.2, line_inner: inner, line_from: from, swell: 0.35, towards_light: [0.6, 0.8, 0.0],
                ..SmokeLook::default()
            };
            prop_assert_eq!(look.line_width(from, outward, radius_px), 0.0);
            let [thin, wide] = [times, times + more].map(|times| look.line_width(from * times, outward, radius_px));
            prop_assert!(thin <= wide + 1e-5 && wide <= THICKEST * radius_px * 1.36 && wide <= 3.2 * 1.36);
            // The steepest: half the width while the jump grows by what it began with.
            prop_assert!(wide - thin <= 0.5 * 3.2 * 1.36 * more + 1e-4, "{} to {}", thin, wide);
            prop_assert!(coverage(wide, away) - coverage(thin, away) <= 2.0 * (wide - thin) + 1e-5);
            prop_assert_eq!(coverage(0.0, away), 0.0);
            prop_assert_eq!(look.line_width(FAR_DEPTH, outward, 1e4), look.whole_width(outward, 1e4));
        }

        #[test]
        fn lines_are_the_published_formula(
            depths in prop::array::uniform5(prop::array::uniform5(prop::option::weighted(0.8, -0.2f32..1.2))),
            weight in 0f32..50.0, x in 0..SIDE, y in 0..SIDE,
        ) {
            let line = with_picture(&depths, weight, |picture| picture.published_line(x, y));
            let expected = 1.0 - published(&depths, f64::from(weight), i64::from(x), i64::from(y));
            prop_assert!((f64::from(line) - expected).abs() < 1e-4, "{line} instead of {expected}");
        }

        /// Over smoke the darkness mixes paint and line; beside it the line stands alone, as much as it covers.
        #[test]
        fn the_line_goes_into_alpha_and_lies_over_the_tones(
            depths in prop::array::uniform5(prop::array::uniform5(prop::option::weighted(0.7, 0f32..1.0))),
            weight in 0f32..4.0, x in 1..SIDE - 1, y in 1..SIDE - 1,
        ) {
            let mut colors = vec![0; (SIDE * SIDE) as usize];
            let mut bits = colors.clone();
            with_picture(&depths, weight, |picture| resolve(picture, &mut colors, &mut bits));
            let darkness = 1.0 - published(&depths, f64::from(weight), i64::from(x), i64::from(y));
            let drawn = colors[(y * SIDE + x) as usize].to_le_bytes();
            let is_smoke = depths[y as usize][x as usize].is_some();
            let alpha = if is_smoke { 1.0 } else { darkness };
            prop_assert!((f64::from(drawn[3]) / 255.0 - alpha).abs() < 0.0025, "{drawn:?}");
            prop_assume!(alpha > 0.05);
            for (byte, line) in drawn.into_iter().zip(&LINE[..3]) {
                let part = if is_smoke { darkness } else { 1.0 };
                let light = f64::from(GREY) + (f64::from(*line) - f64::from(GREY)) * part;
                let wanted = srgb_from_linear(light as f32) * 255.0;
                prop_assert!((f32::from(byte) - wanted).abs() < 1.0, "{byte} instead of {wanted}");
                prop_assert!(linear_from_srgb(f32::from(byte) / 255.0) <= 0.51);
            }
        }
    }
}
