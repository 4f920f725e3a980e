//! How many tones of a picture of smoke change without cause from a frame to the next.
//!
//! What moves with good reason is taken out first. Both frames know the spheres that stand for the smoke, whatever a style
//! draws in their place: the first surface of them along a pixel's ray is what that pixel *truly* shows. Its point is
//! carried to the frame before with its own sphere, which may have moved and swelled, and through that frame's camera:
//! once as paint on the sphere, once as part of the sphere's image, for outlines stay on rims while surfaces turn below
//! them. Either may explain a tone. Where the frame before truly shows the same sphere within a pixel of there, the two pictures are held against each
//! other. A tone *differs* where it lies farther than [`STEP`] from the tone at its place before, read between pixels. It
//! *jumps* where besides no tone within a pixel of its place before, and none within a pixel of it now, comes that near: so
//! edges that crawl from pixel to pixel differ, and what comes or goes at once jumps. What comes into view or is born
//! counts for nothing.
//!
//! Light is no cause: where a shadow of smoke passes over smoke, tones count as changed. That is so for every style.

use std::collections::BTreeMap;

use npr_core::camera::Camera;
use npr_core::smoke::{Ball, Lens, Sphere};
use npr_core::window::Window;
use npr_render::Frame;
use npr_smoke::Sphere as Puff;
use npr_style::smoke::draw::{draw_spheres, project_spheres};

/// Differences of tone up to this are none: half of what parts the two tones of paint, a sixth of what parts line and paint.
pub const STEP: f32 = 0.16;

/// A picture of smoke and what it truly shows.
#[derive(Debug, Clone)]
pub struct Shown {
    size: [u32; 2],
    window: Window,
    /// Brightness of every pixel as the eye takes it, 0..1.
    tones: Vec<f32>,
    lens: Lens,
    spheres: Vec<Sphere>,
    balls: Vec<Ball>,
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
        let size = frame.size;
        let lens = Lens::of_view(&camera.view(size, around(puffs)));
        let extent = size.map(|side| side as f32);
        let window = Window::over(extent, [0.0; 2], extent, size);
        let sphere = |puff: &Puff| Sphere::new(puff.center.to_array(), puff.radius);
        let spheres: Vec<Sphere> = puffs.iter().map(sphere).collect();
        let mut balls = vec![Ball::default(); spheres.len()];
        project_spheres(&lens, &spheres, &mut balls);
        let mut ids = vec![0; frame.rgba.len() / 4];
        let mut depths = ids.clone();
        draw_spheres(&lens, &window, &balls, &mut ids, &mut depths);
        let names: Vec<u32> = puffs.iter().map(|puff| puff.id).collect();
        Self {
            size,
            window,
            tones: frame.rgba.chunks_exact(4).map(brightness).collect(),
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
                let Some(places) = self.places_before(before, [x, y]) else {
                    continue;
                };
                change.compared += 1;
                let tone = self.tones[(y * self.size[0] + x) as usize];
                let is_same = |place: [f32; 2]| (tone - before.tone_at(place)).abs() <= STEP;
                if places.into_iter().any(is_same) {
                    continue;
                }
                change.differing += 1;
                let here = [x as i32, y as i32];
                let is_near = places.into_iter().any(|place| {
                    let there = place.map(|px| px.floor() as i32);
                    self.is_near(before, here, there) && before.is_near(self, there, here)
                });
                change.jumping += usize::from(!is_near);
            }
        }
        change
    }

    /// Where the frame before shows what a pixel of this one truly shows, as paint on its sphere and as part of that sphere's
    /// image; none where it does not.
    fn places_before(&self, before: &Self, [x, y]: [u32; 2]) -> Option<[[f32; 2]; 2]> {
        let id = self.ids[(y * self.size[0] + x) as usize];
        let at = id.checked_sub(1)? as usize;
        let (ball, sphere) = (&self.balls[at], &self.spheres[at]);
        let earlier = *before.places.get(&self.names[at])?;
        let then = &before.spheres[earlier as usize];
        // Find the point on its sphere, as a direction from the middle.
        let ray = self.lens.ray(self.window.frame_at(x, y));
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
        let px = before.lens.frame_of(seen);
        let is_shown = before
            .around(px.map(|px| px.floor() as i32))
            .any(|texel| before.ids[texel] == earlier + 1);
        // An outline stays on the image of its sphere, not on its surface.
        let (then, frame_px) = (&before.balls[earlier as usize], self.window.frame_at(x, y));
        let [middle, middle_then] = [(&self.lens, ball), (&before.lens, then)]
            .map(|(lens, ball)| lens.frame_of(ball.center));
        let size = |lens: &Lens, ball: &Ball| ball.radius / lens.pixel_at(ball.center[2]);
        let grown = size(&before.lens, then) / size(&self.lens, ball);
        let in_image = std::array::from_fn(|i| middle_then[i] + (frame_px[i] - middle[i]) * grown);
        is_shown.then_some([px, in_image])
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

/// Brightness of an sRGB pixel over white, by the shares of its bytes that television uses.
fn brightness(pixel: &[u8]) -> f32 {
    let [r, g, b, a] = [pixel[0], pixel[1], pixel[2], pixel[3]].map(|byte| f32::from(byte) / 255.0);
    (0.2126 * r + 0.7152 * g + 0.0722 * b) * a + 1.0 - a
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

    /// Stripes of 20 pixels, moved to the right.
    fn stripes(by: i32) -> Frame {
        let pixels = (0..SIZE[0] * SIZE[1]).flat_map(|i| {
            let dark = ((i % SIZE[0]) as i32 - by).rem_euclid(20) < 10;
            let byte = if dark { 0 } else { 255 };
            [byte, byte, byte, 255]
        });
        Frame {
            size: SIZE,
            rgba: pixels.collect(),
            times: Vec::new(),
            notices: Vec::new(),
        }
    }

    /// Change where stripes move by `by` pixels, the sphere by `moved`, the camera by `aside`.
    fn change(by: i32, moved: f32, aside: f32) -> Change {
        let before = Shown::new(&stripes(0), &camera(0.0), &[puff(0.0, 1.0, 7)]);
        let after = Shown::new(&stripes(by), &camera(aside), &[puff(moved, 1.0, 7)]);
        after.change_since(&before)
    }

    #[test]
    fn what_moves_with_the_smoke_or_the_camera_does_not_change() {
        // A pixel is 0.04 wide.
        for (by, moved, aside) in [(0, 0.0, 0.0), (5, 0.2, 0.0), (5, 0.0, -0.2)] {
            let change = change(by, moved, aside);
            assert!(change.compared > 1500, "{change:?}");
            assert_eq!(change.differing, 0, "{by} {moved} {aside}");
        }
    }

    #[test]
    fn what_slips_by_a_pixel_differs_but_does_not_jump() {
        let [differing, jumping] = change(1, 0.0, 0.0).shares();
        assert!((differing - 0.1).abs() < 0.02, "{differing}");
        assert_eq!(jumping, 0.0);
    }

    #[test]
    fn what_slides_over_the_smoke_changes() {
        // Of each 10 pixels 5 are new. None of them is taken for slipped: beside an edge of one frame there is none of the other.
        for (by, moved, aside) in [(5, 0.0, 0.0), (0, 0.2, 0.0), (0, 0.0, -0.2)] {
            // Both ways to carry a tone agree: the sphere does not turn.
            let [differing, jumping] = change(by, moved, aside).shares();
            assert!((differing - 0.5).abs() < 0.05, "{differing}");
            assert!((0.4..=differing).contains(&jumping), "{jumping}");
        }
    }

    #[test]
    fn what_was_not_there_is_not_compared() {
        let before = Shown::new(&stripes(0), &camera(0.0), &[puff(0.0, 1.0, 7)]);
        let other = Shown::new(&stripes(5), &camera(0.0), &[puff(0.0, 1.0, 8)]);
        assert_eq!(other.change_since(&before), Change::default());
        let none = Shown::new(&stripes(5), &camera(0.0), &[]);
        assert_eq!(none.change_since(&before).compared, 0);
        assert_eq!(before.change_since(&none).compared, 0);
    }

    #[test]
    fn a_sphere_that_swells_carries_its_tones() {
        let small = Shown::new(&stripes(0), &camera(0.0), &[puff(0.0, 0.5, 7)]);
        let large = Shown::new(&stripes(0), &camera(0.0), &[puff(0.0, 1.0, 7)]);
        let change = large.change_since(&small);
        assert!(
            change.differing > 200,
            "stripes stand while smoke swells: {change:?}"
        );
    }
}
