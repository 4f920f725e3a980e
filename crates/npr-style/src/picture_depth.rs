//! How deep each pixel of a picture lies: the twin of `shade.find_depths`.

use crate::compose::Compose;
use crate::smoke::resolve::MASK;
use npr_core::window::{View, Window};
use rayon::prelude::*;

/// How much nearer to the eye than its surface ink beside it lies, in pixels for every pixel between them: a line where
/// the surface stands on a thing of the host is drawn in full width.
///
/// On a floor that is seen from 14 degrees above, depth changes by 4 pixels a pixel; less cuts lines there, more draws
/// them over things that stand close before the surface.
pub const INK_ROOM: f32 = 4.0;

/// What the depths of a picture are found from.
#[derive(Debug, Clone, Copy)]
pub struct PictureDepths<'a> {
    /// The eye.
    pub view: &'a View,
    /// The pixel grid.
    pub window: &'a Window,
    /// Samples per pixel, and which layers there are.
    pub compose: &'a Compose,
    /// How far a line reaches beyond its surface, in pixels.
    pub reach_px: u32,
    /// Reversed depths of surfaces at the colour samples, 0 without any.
    pub surfaces: &'a [f32],
    /// The same of beams; a placeholder without [`Compose::BEAMS`].
    pub beams: &'a [f32],
    /// Depths of smoke with the samples that it covers, as [`resolve`](crate::smoke::resolve::resolve) gives them; a
    /// placeholder without [`Compose::SMOKE`].
    pub smoke: &'a [u32],
    /// The picture: sRGB bytes with straight alpha.
    pub frame: &'a [u32],
}

/// Gives the reversed depth of what every pixel shows, 0 where it shows nothing.
///
/// A surface or smoke is as deep as the nearest of its samples. Light of beams has the depth of a beam where nothing
/// solid lies behind it. Ink beside a surface belongs to the nearest one within reach, the greatest depth of the first
/// square ring of pixels that has any, and lies [`INK_ROOM`] before it. O(pixels), times the squared reach for ink that
/// is near nothing.
pub fn find_depths(with: &PictureDepths<'_>, depths: &mut [f32]) {
    let width = with.window.size[0].max(1) as usize;
    let rows = depths.par_chunks_mut(width).enumerate();
    rows.for_each(|(y, row)| {
        for (x, depth) in row.iter_mut().enumerate() {
            let is_empty = with.frame[y * width + x] >> 24 == 0;
            *depth = match is_empty {
                true => 0.0,
                false => with.depth_at([x as u32, y as u32]),
            };
        }
    });
}

impl PictureDepths<'_> {
    fn depth_at(&self, pixel: [u32; 2]) -> f32 {
        let surface = self.surface_at(pixel);
        let solid = surface.max(self.smoke_at(pixel));
        if solid > 0.0 {
            return solid;
        }
        let has_beams = self.compose.flags & Compose::BEAMS != 0;
        let beam = match has_beams {
            true => self.nearest_sample(self.beams, pixel),
            false => 0.0,
        };
        if beam > 0.0 {
            return beam;
        }
        self.depth_around(pixel)
    }

    /// Depth of the nearest surface in the samples of a pixel; at the edge of a surface there is room for ink.
    fn surface_at(&self, pixel: [u32; 2]) -> f32 {
        let nearest = self.nearest_sample(self.surfaces, pixel);
        let is_edge = self
            .samples_of(self.surfaces, pixel)
            .any(|depth| depth == 0.0);
        match is_edge && nearest > 0.0 {
            true => self.inked(nearest, 1.0),
            false => nearest,
        }
    }

    /// Depth of ink that lies some pixels beside a surface.
    fn inked(&self, depth: f32, pixels: f32) -> f32 {
        let view = self.view;
        view.brought_nearer(depth, INK_ROOM * pixels * view.pixel_at(1.0))
    }

    /// The depths in the samples of a pixel.
    fn samples_of<'a>(
        &self,
        samples: &'a [f32],
        [x, y]: [u32; 2],
    ) -> impl Iterator<Item = f32> + use<'a> {
        let count = self.compose.samples;
        let width = self.window.size[0] * count;
        (0..count * count).map(move |i| {
            let row = y * count + i / count;
            samples[(row * width + x * count + i % count) as usize]
        })
    }

    /// The greatest depth in the samples of a pixel.
    fn nearest_sample(&self, samples: &[f32], pixel: [u32; 2]) -> f32 {
        self.samples_of(samples, pixel).fold(0.0, f32::max)
    }

    /// Depth of the smoke over a pixel.
    fn smoke_at(&self, [x, y]: [u32; 2]) -> f32 {
        if self.compose.flags & Compose::SMOKE == 0 {
            return 0.0;
        }
        let bits = self.smoke[(y * self.window.size[0] + x) as usize];
        if bits & MASK == 0 {
            return 0.0;
        }
        self.view
            .reversed_of(f32::from_bits(bits & !MASK))
            .clamp(0.0, 1.0)
    }

    /// Depth of the nearest surface in the first square ring of pixels around one that shows any.
    fn depth_around(&self, pixel: [u32; 2]) -> f32 {
        let [x, y] = pixel.map(|at| at as i32);
        for r in 1..=self.reach_px as i32 {
            let sides = (-r..r).flat_map(|step| [[step, -r], [r, step], [-step, r], [-r, -step]]);
            let depths = sides.map(|[dx, dy]| self.depth_within([x + dx, y + dy]));
            let nearest = depths.fold(0.0, f32::max);
            if nearest > 0.0 {
                return self.inked(nearest, (r + 1) as f32);
            }
        }
        0.0
    }

    /// Depth of the surface of a pixel, none beyond the picture.
    fn depth_within(&self, [x, y]: [i32; 2]) -> f32 {
        let [width, height] = self.window.size.map(|side| side as i32);
        if x < 0 || y < 0 || x >= width || y >= height {
            return 0.0;
        }
        self.nearest_sample(self.surfaces, [x as u32, y as u32])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::Camera;
    use proptest::prelude::*;

    const SIZE: [u32; 2] = [7, 5];

    /// The same by looking at every pixel of the picture: no surface within reach, else the nearest one by the larger
    /// of both distances, and of several the one in front.
    fn slowly(view: &View, surfaces: &[f32], reach: u32, [x, y]: [u32; 2]) -> f32 {
        let width = SIZE[0];
        let distance = |i: usize| {
            (i as u32 % width)
                .abs_diff(x)
                .max((i as u32 / width).abs_diff(y))
        };
        let shown = surfaces
            .iter()
            .enumerate()
            .filter(|(_, depth)| **depth > 0.0);
        let near: Vec<(usize, &f32)> = shown.filter(|(i, _)| distance(*i) <= reach).collect();
        let least = near.iter().map(|(i, _)| distance(*i)).min();
        let first = near.iter().filter(|(i, _)| Some(distance(*i)) == least);
        let depth = first.map(|(_, depth)| **depth).fold(0.0, f32::max);
        let beside = match least {
            Some(least @ 1..) => least as f32 + 1.0,
            _ => return depth,
        };
        let shrunk = 1.0 - INK_ROOM * beside * view.view_height / view.frame_px[1];
        depth / shrunk.max(0.5)
    }

    proptest! {
        #[test]
        fn ink_is_as_deep_as_the_nearest_surface(
            surfaces in prop::collection::vec(prop_oneof![4 => Just(0.0f32), 1 => 0.01f32..1.0], 35),
            alphas in prop::collection::vec(0u32..2, 35), reach in 0u32..8,
        ) {
            let frame: Vec<u32> = alphas.iter().map(|alpha| alpha * 0xff00_0000).collect();
            let compose = Compose { samples: 1, ..Compose::default() };
            let view = Camera::framing([-1.0; 3], [1.0; 3]).view([700, 500], ([-1.0; 3], [1.0; 3]));
            let window = Window::over([7.0, 5.0], [0.0; 2], [7.0, 5.0], SIZE);
            let with = PictureDepths {
                view: &view, window: &window, compose: &compose, reach_px: reach,
                surfaces: &surfaces, beams: &[0.0], smoke: &[0], frame: &frame,
            };
            let mut depths = vec![9.0; 35];
            find_depths(&with, &mut depths);
            for (i, depth) in depths.iter().enumerate() {
                let expected = match alphas[i] {
                    0 => 0.0,
                    _ => slowly(&view, &surfaces, reach, [i as u32 % SIZE[0], i as u32 / SIZE[0]]),
                };
                prop_assert!((depth - expected).abs() <= 1e-6, "{} is not {}", depth, expected);
            }
        }
    }

    #[test]
    fn smoke_is_as_deep_as_it_stands_and_beams_lie_behind_all_that_is_solid() {
        let camera = Camera::framing([-1.0; 3], [1.0; 3]);
        let view = camera.view([3, 1], ([-1.0; 3], [1.0; 3]));
        let window = Window::over([3.0, 1.0], [0.0; 2], [3.0, 1.0], [3, 1]);
        let compose = Compose {
            samples: 1,
            flags: Compose::SMOKE | Compose::BEAMS,
            ..Compose::default()
        };
        let far = 2.0 * view.near;
        let with = PictureDepths {
            view: &view,
            window: &window,
            compose: &compose,
            reach_px: 1,
            surfaces: &[0.3, 0.0, 0.0],
            beams: &[0.9, 0.0, 0.4],
            smoke: &[0, far.to_bits() & !MASK | 1, 0],
            frame: &[u32::MAX; 3],
        };
        let mut depths = [0.0; 3];
        find_depths(&with, &mut depths);
        assert_eq!(depths[0], 0.3, "a surface behind a beam");
        assert!(
            (depths[1] - 0.5).abs() < 1e-5,
            "smoke at twice the near distance"
        );
        assert_eq!(depths[2], 0.4, "a beam before nothing");
    }
}
