//! How many tones of a picture of smoke change without cause from a frame to the next.
//!
//! What moves with good reason is taken out first. Both frames know the spheres that stand for the smoke, whatever a
//! style draws in their place: the first surface of them along a pixel's ray is what that pixel *truly* shows. Its
//! point is carried to the frame before with its own sphere, which may have moved and swelled, and through that
//! frame's camera: once as paint on the sphere, once as part of the sphere's image, for outlines stay on rims while
//! surfaces turn below them. A pixel beside another sphere also shows something of that one's outline: it is carried
//! with the image of every sphere seen within a pixel in either frame. Any of these may explain a tone.
//!
//! Where the frame before truly shows the same sphere within a pixel of there, the two pictures are held against each
//! other. A tone *differs* where it lies farther than [`STEP`] from the tone at its place before, read between
//! pixels. It *jumps* where besides no tone within a pixel of its place before, and none within a pixel of it now,
//! comes that near: so edges that crawl from pixel to pixel differ, and what comes or goes at once jumps. What comes
//! into view or is born counts for nothing.
//!
//! Both pictures are read softened by a pixel, so that reading between pixels changes nothing: a sharp edge drawn
//! well half a pixel on differs by a quarter of its height from what is read there, softened by a sixteenth.
//!
//! Light is no cause: where a shadow of smoke passes over smoke, tones count as changed. That is so for every style.

use std::collections::BTreeMap;

use npr_core::camera::Camera;
use npr_core::smoke::{Sphere, SphereView, ViewSphere};
use npr_core::window::Window;
use npr_render::Frame;
use npr_smoke::Sphere as Puff;
use npr_style::smoke::draw::{draw_spheres, project_spheres};

use crate::tones::{brightness, softened};

/// Differences of tone up to this are none: half of what parts the two tones of paint, a sixth of what parts line and
/// paint.
pub const STEP: f32 = 0.16;

/// A picture of smoke and what it truly shows.
#[derive(Debug, Clone)]
pub struct Shown {
    size: [u32; 2],
    window: Window,
    /// Brightness of every pixel as the eye takes it, softened, 0..1.
    tones: Vec<f32>,
    lens: SphereView,
    spheres: Vec<Sphere>,
    balls: Vec<ViewSphere>,
    /// Which sphere a pixel truly shows: its place in the list plus one.
    ids: Vec<u32>,
    /// Place in the list by the name that a sphere keeps from frame to frame.
    places: BTreeMap<u32, u32>,
    names: Vec<u32>,
}

/// Tones that were compared, and those that changed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Change {
    /// Pixels that truly show what the frame before shows too.
    pub compared: usize,
    /// Those of them whose tone differs without cause.
    pub differing: usize,
    /// Those of them whose tone jumps.
    pub jumping: usize,
}

impl Change {
    /// Differing and jumping pixels among those compared, 0..1.
    pub fn shares(&self) -> [f64; 2] {
        let share = |count: usize| count as f64 / self.compared.max(1) as f64;
        [share(self.differing), share(self.jumping)]
    }

    /// Both together.
    pub fn and(self, other: Self) -> Self {
        Self {
            compared: self.compared + other.compared,
            differing: self.differing + other.differing,
            jumping: self.jumping + other.jumping,
        }
    }
}

impl Shown {
    /// A frame that shows `puffs` through a camera, in any style. O(pixels + spheres).
    pub fn new(frame: &Frame, camera: &Camera, puffs: &[Puff]) -> Self {
        // Draw the spheres as the frame's camera sees them.
        let size = frame.size;
        let lens = SphereView::of_view(&camera.view(size, around(puffs)));
        let extent = size.map(|side| side as f32);
        let window = Window::over(extent, [0.0; 2], extent, size);
        let sphere = |puff: &Puff| Sphere::new(puff.center.to_array(), puff.radius);
        let spheres: Vec<Sphere> = puffs.iter().map(sphere).collect();
        let mut balls = vec![ViewSphere::default(); spheres.len()];
        project_spheres(&lens, &spheres, &mut balls);
        let mut ids = vec![0; frame.rgba.len() / 4];
        let mut depths = ids.clone();
        draw_spheres(&lens, &window, &balls, &mut ids, &mut depths);

        // Keep the frame's tones beside them.
        let names: Vec<u32> = puffs.iter().map(|puff| puff.id).collect();
        Self {
            size,
            window,
            tones: softened(size, frame.rgba.chunks_exact(4).map(brightness)),
            lens,
            spheres,
            balls,
            ids,
            places: names.iter().copied().zip(0..).collect(),
            names,
        }
    }

    /// What changes from `before` to this frame without cause.
    pub fn change_since(&self, before: &Self) -> Change {
        let mut change = Change::default();
        for y in 0..self.size[1] {
            for x in 0..self.size[0] {
                // Find where the frame before showed the same.
                let Some(places) = self.places_before(before, [x, y]) else {
                    continue;
                };
                change.compared += 1;

                // Count tones that no such place explains.
                let tone = self.tones[(y * self.size[0] + x) as usize];
                let is_same = |place: &[f32; 2]| (tone - before.tone_at(*place)).abs() <= STEP;
                if places.iter().any(is_same) {
                    continue;
                }
                change.differing += 1;

                // Count those that nothing near explains either.
                let here = [x as i32, y as i32];
                let is_near = places.iter().any(|place| {
                    let there = place.map(|px| px.floor() as i32);
                    self.is_near(before, here, there) && before.is_near(self, there, here)
                });
                change.jumping += usize::from(!is_near);
            }
        }
        change
    }

    /// Where the frame before shows what a pixel of this one truly shows: as paint on its sphere, as part of that
    /// sphere's image, and as part of the images of spheres within a pixel now or then; none where it does not show
    /// the pixel's own sphere.
    fn places_before(&self, before: &Self, [x, y]: [u32; 2]) -> Option<Vec<[f32; 2]>> {
        // Carry the pixel as paint on its own sphere.
        let frame_px = self.window.frame_at(x, y);
        let own = self.ids[(y * self.size[0] + x) as usize];
        let at = own.checked_sub(1)? as usize;
        let earlier = *before.places.get(&self.names[at])? as usize;
        let painted = self.painted_before(before, [at, earlier], frame_px);
        if !before.shows(earlier, painted) {
            return None;
        }

        // Carry it as part of the images of spheres around.
        let mut places = vec![painted, self.image_before(before, [at, earlier], frame_px)];
        let mut carried = vec![self.names[at]];
        let now = self.names_around(frame_px);
        for name in now.chain(before.names_around(painted)) {
            if carried.contains(&name) {
                continue;
            }
            carried.push(name);
            if let (Some(at), Some(earlier)) = (self.places.get(&name), before.places.get(&name)) {
                let pair = [*at as usize, *earlier as usize];
                places.push(self.image_before(before, pair, frame_px));
            }
        }
        Some(places)
    }

    /// The names of the spheres truly shown within a pixel of a place.
    fn names_around(&self, place: [f32; 2]) -> impl Iterator<Item = u32> {
        let ids = self.around(place.map(|px| px.floor() as i32));
        let at = ids.filter_map(|texel| self.ids[texel].checked_sub(1));
        at.map(|at| self.names[at as usize])
    }

    /// Whether a sphere is truly shown within a pixel of a place.
    fn shows(&self, sphere: usize, place: [f32; 2]) -> bool {
        self.around(place.map(|px| px.floor() as i32))
            .any(|texel| self.ids[texel] as usize == sphere + 1)
    }

    /// Where the frame before has the point of a sphere that lies at `frame_px` in this one; `at` and `earlier` are the
    /// sphere's places in the two lists.
    fn painted_before(
        &self,
        before: &Self,
        [at, earlier]: [usize; 2],
        frame_px: [f32; 2],
    ) -> [f32; 2] {
        let (ball, sphere) = (&self.balls[at], &self.spheres[at]);
        let then = &before.spheres[earlier];
        // Find the point on its sphere, as a direction from the middle.
        let ray = self.lens.ray(frame_px);
        let place = self.lens.place_at(ray, self.lens.depth_of(ball, ray));
        let out: [f32; 3] = std::array::from_fn(|i| (place[i] - ball.center[i]) / sphere.radius);
        let normal = self.lens.direction_in_world(out);
        // Look where it was.
        let world: [f32; 3] = std::array::from_fn(|i| {
            then.center[i] + normal[i] * then.radius - before.lens.eye_world[i]
        });
        let axes = [
            before.lens.right_world,
            before.lens.up_world,
            before.lens.forward_world,
        ];
        let seen = axes.map(|axis| (0..3).map(|i| axis[i] * world[i]).sum::<f32>());
        before.lens.frame_of(seen)
    }

    /// Where the frame before has the part of a sphere's image that lies at `frame_px` in this one, or beside it.
    fn image_before(
        &self,
        before: &Self,
        [at, earlier]: [usize; 2],
        frame_px: [f32; 2],
    ) -> [f32; 2] {
        let (ball, then) = (&self.balls[at], &before.balls[earlier]);
        let [middle, middle_then] = [(&self.lens, ball), (&before.lens, then)]
            .map(|(lens, ball)| lens.frame_of(ball.center));
        let size =
            |lens: &SphereView, ball: &ViewSphere| ball.radius / lens.pixel_at(ball.center[2]);
        let grown = size(&before.lens, then) / size(&self.lens, ball);
        std::array::from_fn(|i| middle_then[i] + (frame_px[i] - middle[i]) * grown)
    }

    /// The tone at a place between pixels; beyond the picture its border goes on.
    fn tone_at(&self, place: [f32; 2]) -> f32 {
        let last = self.size.map(|side| side as f32 - 1.0);
        let at: [f32; 2] = std::array::from_fn(|i| (place[i] - 0.5).clamp(0.0, last[i]));
        let low = at.map(f32::floor);
        let texel = |dx: f32, dy: f32| {
            let (x, y) = ((low[0] + dx).min(last[0]), (low[1] + dy).min(last[1]));
            self.tones[y as usize * self.size[0] as usize + x as usize]
        };
        let (tx, ty) = (at[0] - low[0], at[1] - low[1]);
        let upper = texel(0.0, 0.0) * (1.0 - tx) + texel(1.0, 0.0) * tx;
        let lower = texel(0.0, 1.0) * (1.0 - tx) + texel(1.0, 1.0) * tx;
        upper * (1.0 - ty) + lower * ty
    }

    /// Whether the tone of a pixel is found near a pixel of another frame.
    fn is_near(&self, other: &Self, [x, y]: [i32; 2], there: [i32; 2]) -> bool {
        let inside = |v: i32, i: usize| v.clamp(0, self.size[i] as i32 - 1) as u32;
        let tone = self.tones[(inside(y, 1) * self.size[0] + inside(x, 0)) as usize];
        let tones = other.around(there).map(|texel| other.tones[texel]);
        let (low, high) = tones.fold((f32::MAX, f32::MIN), |(low, high), tone| {
            (low.min(tone), high.max(tone))
        });
        tone > low - STEP && tone < high + STEP
    }

    /// The pixels within one of a place, those in the picture.
    fn around(&self, [x, y]: [i32; 2]) -> impl Iterator<Item = usize> {
        let [width, height] = self.size.map(|side| side as i32);
        let near = (-1..=1).flat_map(move |dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
        near.filter(move |[x, y]| (0..width).contains(x) && (0..height).contains(y))
            .map(move |[x, y]| (y * width + x) as usize)
    }
}

/// The box around spheres.
fn around(puffs: &[Puff]) -> ([f32; 3], [f32; 3]) {
    let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
    for puff in puffs {
        for (i, middle) in puff.center.to_array().into_iter().enumerate() {
            low[i] = low[i].min(middle - puff.radius);
            high[i] = high[i].max(middle + puff.radius);
        }
    }
    if puffs.is_empty() {
        return ([-1.0; 3], [1.0; 3]);
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use npr_core::camera::Projection;

    const SIZE: [u32; 2] = [120, 100];

    fn camera(aside: f32) -> Camera {
        Camera {
            eye: [aside, 0.0, 6.0],
            target: [aside, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Parallel { height: 4.0 },
        }
    }

    fn puff(x: f32, radius: f32, id: u32) -> Puff {
        Puff {
            center: Vec3::new(x, 0.0, 0.0),
            radius,
            id,
            age: 0,
            temperature: 0.0,
        }
    }

    /// A picture of tones, each the mean of 16 x 16 places in its pixel: as well as it can be drawn.
    fn drawn(tone_at: impl Fn([f32; 2]) -> f32) -> Frame {
        let part = |i: u32| (i as f32 + 0.5) / 16.0;
        let pixels = (0..SIZE[0] * SIZE[1]).flat_map(|i| {
            let [x, y] = [i % SIZE[0], i / SIZE[0]].map(|v| v as f32);
            let places = (0..256).map(|k| [x + part(k % 16), y + part(k / 16)]);
            let byte = (places.map(&tone_at).sum::<f32>() / 256.0 * 255.0) as u8;
            [byte, byte, byte, 255]
        });
        Frame {
            size: SIZE,
            rgba: pixels.collect(),
            ..Frame::default()
        }
    }

    /// Stripes of 20 pixels, moved to the right.
    fn stripes(by: f32) -> Frame {
        drawn(|[x, _]| f32::from(u8::from((x - by).rem_euclid(20.0) >= 10.0)))
    }

    /// A front sphere over one behind it, each with a line as wide as asked for inside its rim: as a perfect style
    /// has them.
    fn outlined(front: f32, behind: f32, [line, line_behind]: [f32; 2]) -> Shown {
        let spheres = [(front, 0.5, line, 1.0), (behind, 1.0, line_behind, -1.0)];
        let tone_at = |[x, y]: [f32; 2]| {
            for (middle, radius, line, _) in spheres {
                let [x, y] = [(x - 60.0) * 0.04 - middle, (y - 50.0) * 0.04];
                let inside_px = (radius - (x * x + y * y).sqrt()) / 0.04;
                if inside_px >= 0.0 {
                    return f32::from(u8::from(inside_px >= line));
                }
            }
            1.0
        };
        let puffs = [0, 1].map(|i: usize| {
            let (x, radius, _, z) = spheres[i];
            let mut puff = puff(x, radius, i as u32);
            puff.center.z = z;
            puff
        });
        Shown::new(&drawn(tone_at), &camera(0.0), &puffs)
    }

    /// Change where stripes move by `by` pixels, the sphere by `moved`, the camera by `aside`.
    fn change(by: f32, moved: f32, aside: f32) -> Change {
        let before = Shown::new(&stripes(0.0), &camera(0.0), &[puff(0.0, 1.0, 7)]);
        let after = Shown::new(&stripes(by), &camera(aside), &[puff(moved, 1.0, 7)]);
        after.change_since(&before)
    }

    #[test]
    fn what_moves_with_the_smoke_or_the_camera_does_not_change() {
        // A pixel is 0.04 wide.
        let halves = [(0.5, 0.02, 0.0), (2.3, 0.0, -0.092), (7.75, 0.31, 0.0)];
        for (by, moved, aside) in [(0.0, 0.0, 0.0), (5.0, 0.2, 0.0), (5.0, 0.0, -0.2)]
            .into_iter()
            .chain(halves)
        {
            let change = change(by, moved, aside);
            assert!(change.compared > 1500, "{change:?}");
            assert_eq!(change.differing, 0, "{by} {moved} {aside}");
        }
    }

    #[test]
    fn what_slips_by_a_pixel_differs_but_does_not_jump() {
        let [differing, jumping] = change(1.0, 0.0, 0.0).shares();
        // Beside each edge, where softening halves the step, too.
        assert!((0.08..0.4).contains(&differing), "{differing}");
        assert_eq!(jumping, 0.0);
    }

    #[test]
    fn what_slides_over_the_smoke_changes() {
        // Of each 10 pixels 5 are new. None of them is taken for slipped: beside an edge of one frame there is none
        // of the other.
        for (by, moved, aside) in [(5.0, 0.0, 0.0), (0.0, 0.2, 0.0), (0.0, 0.0, -0.2)] {
            // Both ways to carry a tone agree: the sphere does not turn.
            let [differing, jumping] = change(by, moved, aside).shares();
            // Softened edges count on both sides.
            assert!((0.5..0.75).contains(&differing), "{differing}");
            assert!((0.3..=differing).contains(&jumping), "{jumping}");
        }
    }

    #[test]
    fn outlines_that_slide_over_smoke_behind_do_not_change_it() {
        let lines = [3.0, 3.0];
        for moved in [0.008, 0.02, 0.07, 0.13] {
            let before = outlined(0.1, 0.0, lines);
            let change = outlined(0.1 + moved, 0.01, lines).change_since(&before);
            assert!(change.compared > 1500, "{change:?}");
            assert!(change.differing < 8, "{moved}: {change:?}");
        }
    }

    #[test]
    fn lines_that_come_or_go_at_once_are_seen_moving_or_not() {
        // Around the front sphere, 25 pixels wide, a line has some 75 pixels for each of its width.
        for (from, to, least) in [
            (0.0, 3.0, 180),
            (3.0, 0.0, 180),
            (0.0, 1.0, 60),
            (1.0, 0.0, 60),
        ] {
            for moved in [0.0, 0.02, 0.07] {
                let before = outlined(0.1, 0.0, [from, 3.0]);
                let change = outlined(0.1 + moved, 0.01, [to, 3.0]).change_since(&before);
                assert!(change.differing > least, "{from} {to} {moved}: {change:?}");
                assert!(
                    2 * change.jumping > least,
                    "{from} {to} {moved}: {change:?}"
                );
            }
        }
    }

    #[test]
    fn what_was_not_there_is_not_compared() {
        let before = Shown::new(&stripes(0.0), &camera(0.0), &[puff(0.0, 1.0, 7)]);
        let other = Shown::new(&stripes(5.0), &camera(0.0), &[puff(0.0, 1.0, 8)]);
        assert_eq!(other.change_since(&before), Change::default());
        let none = Shown::new(&stripes(5.0), &camera(0.0), &[]);
        assert_eq!(none.change_since(&before).compared, 0);
        assert_eq!(before.change_since(&none).compared, 0);
    }

    #[test]
    fn a_sphere_that_swells_carries_its_tones() {
        let small = Shown::new(&stripes(0.0), &camera(0.0), &[puff(0.0, 0.5, 7)]);
        let large = Shown::new(&stripes(0.0), &camera(0.0), &[puff(0.0, 1.0, 7)]);
        let change = large.change_since(&small);
        assert!(
            change.differing > 200,
            "stripes stand while smoke swells: {change:?}"
        );
    }
}
