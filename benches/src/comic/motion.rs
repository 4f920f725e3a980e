//! How still strokes lie on a surface while the camera goes round it.
//!
//! A frame's ink is carried over to the next frame by the surface itself: every pixel's point in the world is looked
//! up where the frame before showed it. Geometry comes from [`Soup`] and [`Viewpoint`], which share no code with the
//! renderer. What the carried ink and the next frame's differ by is the work of the hatching alone.

use glam::DVec3;
use npr_core::camera::Camera;
use npr_core::color::linear_from_srgb;
use npr_render::Frame;

use super::shift::shifts;
use crate::lines::soup::Soup;
use crate::lines::viewpoint::Viewpoint;

/// How much nearer a point may lie than what a pixel shows, as a part of its depth, and still be that surface.
const SAME_DEPTH: f64 = 0.01;

/// A frame's ink and what of the surface each pixel shows.
#[derive(Debug, Clone)]
pub struct Inked {
    viewpoint: Viewpoint,
    width: usize,
    height: usize,
    /// How much of every pixel is inked, 0..1.
    ink: Vec<f64>,
    /// Point of the surface at every pixel's centre, with its depth; none where there is only paper.
    surface: Vec<Option<(DVec3, f64)>>,
}

/// How ink changes from a frame to the next.
#[derive(Debug, Clone, Default)]
pub struct Change {
    /// Pixels that show a surface that the frame before shows too.
    pub pixels: usize,
    /// Those of them that went from ink to paper or back, by more than half of a pixel.
    pub flips: usize,
    /// How far the surface itself moved in the picture, in pixels, by pixel.
    pub moves: Vec<f64>,
    /// How far the ink moved against the surface, in pixels, by square.
    pub shifts: Vec<f64>,
}

impl Inked {
    /// The ink of a frame, black on white paper, that shows `soup` through a camera.
    pub fn new(frame: &Frame, soup: &Soup, camera: &Camera) -> Self {
        let [width, height] = frame.size.map(|side| side as usize);
        let viewpoint = Viewpoint::new(camera, frame.size);
        let ink = frame.rgba.chunks_exact(4);
        let ink = ink.map(|pixel| 1.0 - f64::from(linear_from_srgb(f32::from(pixel[1]) / 255.0)));
        let mut inked = Self {
            surface: vec![None; width * height],
            ink: ink.collect(),
            viewpoint,
            width,
            height,
        };
        for face in 0..soup.faces.len() {
            inked.show(soup.corners(face));
        }
        inked
    }

    /// Writes a triangle wherever it is nearest; triangles that reach behind the eye are left out.
    fn show(&mut self, corners: [DVec3; 3]) {
        // Leave out what reaches behind the eye, and what shows no area.
        let depths = corners.map(|corner| self.viewpoint.depth(corner));
        if depths.iter().any(|depth| *depth <= 0.0) {
            return;
        }
        let [a, b, c] = corners.map(|corner| self.viewpoint.project(corner));
        let area = cross(a, b, c);
        if area == 0.0 {
            return;
        }

        // Visit the pixels whose centres lie in the triangle.
        let range = |i: usize, side: usize| {
            let low = (a[i].min(b[i]).min(c[i]) - 0.5).ceil().max(0.0);
            let high = (a[i].max(b[i]).max(c[i]) + 0.5)
                .floor()
                .clamp(0.0, side as f64);
            low as usize..high as usize
        };
        for y in range(1, self.height) {
            for x in range(0, self.width) {
                let p = [x as f64 + 0.5, y as f64 + 0.5];
                let shares = [cross(b, c, p), cross(c, a, p), cross(a, b, p)].map(|s| s / area);
                if shares.iter().any(|share| *share < 0.0) {
                    continue;
                }

                // Keep the nearest point, found by shares that are true in perspective.
                let weights: [f64; 3] = std::array::from_fn(|i| shares[i] / depths[i]);
                let depth = 1.0 / (weights[0] + weights[1] + weights[2]);
                let pixel = &mut self.surface[y * self.width + x];
                if pixel.is_none_or(|(_, before)| depth < before) {
                    let point = corners[0] * weights[0] + corners[1] * weights[1];
                    *pixel = Some(((point + corners[2] * weights[2]) * depth, depth));
                }
            }
        }
    }

    /// Ink between pixel centres; none outside the picture.
    fn ink_at(&self, [x, y]: [f64; 2]) -> Option<f64> {
        let (x, y) = (x - 0.5, y - 0.5);
        if x < 0.0 || y < 0.0 || x >= (self.width - 1) as f64 || y >= (self.height - 1) as f64 {
            return None;
        }
        let (left, top) = (x as usize, y as usize);
        let (tx, ty) = (x - left as f64, y - top as f64);
        let at = |dx: usize, dy: usize| self.ink[(top + dy) * self.width + left + dx];
        let upper = at(0, 0) * (1.0 - tx) + at(1, 0) * tx;
        let lower = at(0, 1) * (1.0 - tx) + at(1, 1) * tx;
        Some(upper * (1.0 - ty) + lower * ty)
    }

    /// Ink of a point of the surface, and where it shows; none where something hides it.
    fn ink_of(&self, point: DVec3) -> Option<(f64, [f64; 2])> {
        let place = self.viewpoint.project(point);
        let [x, y] = place;
        if !(x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64) {
            return None;
        }
        let (_, depth) = self.surface[y as usize * self.width + x as usize]?;
        let seen = self.viewpoint.depth(point) < depth * (1.0 + SAME_DEPTH);
        seen.then(|| self.ink_at(place).map(|ink| (ink, place)))?
    }

    /// How ink changes from this frame to `next`; shifts only where asked, they take most of the time.
    pub fn change_to(&self, next: &Self, with_shifts: bool) -> Change {
        // Carry the ink to the next frame by the points of the surface.
        let carried: Vec<Option<f64>> = (next.surface.iter())
            .map(|seen| self.ink_of(seen.as_ref()?.0).map(|(ink, _)| ink))
            .collect();
        let mut change = Change::default();
        for (i, ink) in carried.iter().enumerate() {
            let Some(ink) = ink else { continue };
            change.pixels += 1;
            change.flips += usize::from((ink - next.ink[i]).abs() > 0.5);
        }

        // Measure how far the surface itself moves, at some of its pixels.
        let middle = next.surface.iter().enumerate().step_by(97);
        change.moves = middle
            .filter_map(|(i, seen)| {
                let (_, [x, y]) = self.ink_of(seen.as_ref()?.0)?;
                let (column, row) = (i % self.width, i / self.width);
                Some((column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y))
            })
            .collect();

        // Measure how far the strokes move against it.
        if with_shifts {
            change.shifts = shifts([next.width, next.height], &next.ink, &carried);
        }
        change
    }
}

/// Twice the area of a triangle of the picture, above 0 where its corners run clockwise on screen.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [96, 96];

    /// A square plane 2 units wide, 3 units before the camera, and a camera moved sideways.
    fn plane_and_camera(aside: f32) -> (Soup, Camera) {
        let corners = [
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
            [-1.0, 1.0, 0.0],
        ];
        let camera = Camera {
            eye: [aside, 0.0, 3.0],
            target: [aside, 0.0, 0.0],
            ..Camera::framing([-1.0; 3], [1.0; 3])
        };
        (Soup::of_mesh(&corners, &[[0, 1, 2], [0, 2, 3]]), camera)
    }

    /// Upright stripes 8 pixels apart, moved to the right.
    fn stripes(by: u32) -> Frame {
        let pixels = (0..SIZE[0] * SIZE[1]).flat_map(|i| {
            let dark = (i % SIZE[0] + 80 - by) % 8 < 4;
            [if dark { 0 } else { 255 }; 4]
        });
        Frame {
            size: SIZE,
            rgba: pixels.collect(),
            ..Frame::default()
        }
    }

    #[test]
    fn ink_that_stays_on_a_still_surface_does_not_change() {
        let (soup, camera) = plane_and_camera(0.0);
        let inked = Inked::new(&stripes(0), &soup, &camera);
        let change = inked.change_to(&inked, true);
        assert!(change.pixels > 1000 && change.flips == 0);
        assert!(!change.shifts.is_empty() && change.shifts.iter().all(|shift| shift.abs() < 0.05));
    }

    #[test]
    fn ink_that_moves_on_a_still_surface_is_found() {
        let (soup, camera) = plane_and_camera(0.0);
        let [before, after] = [0, 2].map(|by| Inked::new(&stripes(by), &soup, &camera));
        let change = before.change_to(&after, true);
        assert!(change.shifts.iter().all(|shift| (shift - 2.0).abs() < 0.1));
        let share = change.flips as f64 / change.pixels as f64;
        assert!((share - 0.5).abs() < 0.02, "{share}");
    }

    #[test]
    fn ink_that_moves_with_the_surface_stays_on_it() {
        // A pixel is this wide on the plane; the camera goes left by two, so the plane goes right by two.
        let (soup, camera) = plane_and_camera(0.0);
        let viewpoint = Viewpoint::new(&camera, SIZE);
        let [x, _] = viewpoint.project(DVec3::X);
        let pixel = 1.0 / (x - 48.0);
        let (_, moved) = plane_and_camera(-2.0 * pixel as f32);
        let before = Inked::new(&stripes(0), &soup, &camera);
        let after = Inked::new(&stripes(2), &soup, &moved);
        let change = before.change_to(&after, true);
        assert_eq!(change.flips, 0);
        assert!(change.moves.iter().all(|by| (by - 2.0).abs() < 1e-3));
        assert!(change.shifts.iter().all(|shift| shift.abs() < 0.05));
    }
}
