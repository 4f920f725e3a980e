//! The view of a frame, and pixel grids laid over parts of it.

use crate::geometry::FAR_DEPTH;
use crate::gpu_layout;
use bytemuck::{Pod, Zeroable};

/// Camera and frame, as every pass sees them.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct View {
    /// Column-major matrix to clip space, for the whole frame; reversed depth.
    pub clip_from_world: [[f32; 4]; 4],
    /// Position of the eye in the world.
    pub eye_world: [f32; 3],
    /// 1 for a perspective camera, 0 for a parallel one.
    pub perspective: f32,
    /// Unit view axis in the world.
    pub forward_world: [f32; 3],
    /// Height of the view in world units: at depth 1 in perspective, at any depth in parallel view.
    pub view_height: f32,
    /// Width and height of the whole frame.
    pub frame_px: [f32; 2],
    /// Distance of the near plane.
    pub near: f32,
    /// Keeps the size a multiple of 16 bytes.
    pub unused: f32,
}
gpu_layout!(View {
    clip_from_world,
    eye_world,
    perspective,
    forward_world,
    view_height,
    frame_px,
    near,
    unused,
});

/// Height of a view in world units at a depth.
///
/// `perspective` is 1 where rays meet at the eye and 0 where they are parallel; `height` is the view's at depth 1 in
/// perspective, at any depth else.
#[inline]
pub fn height_of_view(perspective: f32, height: f32, depth: f32) -> f32 {
    if perspective > 0.5 {
        height * depth
    } else {
        height
    }
}

/// Size of a pixel in world units at a depth of such a view, which is `height_px` pixels high.
///
/// Whoever turns lengths of the world into pixels divides by this.
#[inline]
pub fn pixel_size(perspective: f32, height: f32, depth: f32, height_px: f32) -> f32 {
    height_of_view(perspective, height, depth) / height_px
}

impl View {
    /// Height of the view in world units at a view depth.
    #[inline]
    pub fn height_at(&self, depth: f32) -> f32 {
        height_of_view(self.perspective, self.view_height, depth)
    }

    /// Size of a frame pixel in world units at a view depth.
    #[inline]
    pub fn pixel_at(&self, depth: f32) -> f32 {
        pixel_size(self.perspective, self.view_height, depth, self.frame_px[1])
    }

    /// The same for depths that may lie behind the near plane, where it is as large as on that plane; never 0.
    #[inline]
    pub fn pixel_before_eye(&self, depth: f32) -> f32 {
        self.pixel_at(depth.max(self.near)).max(1e-20)
    }

    /// Frame pixels per world unit at a view depth.
    #[inline]
    pub fn pixels_per_unit(&self, depth: f32) -> f32 {
        1.0 / self.pixel_at(depth)
    }

    /// 1 at the near plane, falling with depth to 0; a half in a parallel view, whose near plane may lie behind the
    /// eye.
    #[inline]
    pub fn nearness(&self, depth: f32) -> f32 {
        if self.perspective < 0.5 {
            0.5
        } else {
            self.near / depth.max(self.near)
        }
    }

    /// The reversed depth of a view depth: 1 on the near plane, less behind it.
    #[inline]
    pub fn reversed_of(&self, depth: f32) -> f32 {
        if self.perspective > 0.5 {
            return self.near / depth;
        }
        let [x, y, z] = self.forward_world;
        let m = &self.clip_from_world;
        let per_unit = m[0][2] * x + m[1][2] * y + m[2][2] * z;
        1.0 + per_unit * (depth - self.near)
    }

    /// A reversed depth moved towards the eye by a share of the view depth, at most half of it; in parallel view, by
    /// world units.
    #[inline]
    pub fn brought_nearer(&self, reversed: f32, room: f32) -> f32 {
        if self.perspective > 0.5 {
            return reversed / (1.0 - room.min(0.5));
        }
        reversed + self.reversed_of(self.near - room) - 1.0
    }

    /// A coordinate that changes linearly over the image of any plane: 1 / depth in perspective, depth in parallel
    /// view.
    #[inline]
    pub fn plane_coordinate(&self, depth: f32) -> f32 {
        if self.perspective > 0.5 {
            1.0 / depth
        } else {
            depth
        }
    }

    /// The depth that has a plane coordinate; [`FAR_DEPTH`] where the plane has passed the horizon.
    #[inline]
    pub fn depth_of_coordinate(&self, coordinate: f32) -> f32 {
        if self.perspective < 0.5 {
            coordinate
        } else if coordinate > 1e-30 {
            1.0 / coordinate
        } else {
            FAR_DEPTH
        }
    }

    /// Depth change over one pixel of a grid, in sizes of that pixel: the tangent of the surface's angle to the
    /// picture.
    pub fn slope_of(&self, window: &Window, depth: f32, plane_step: [f32; 2]) -> f32 {
        let step = (plane_step[0] * plane_step[0] + plane_step[1] * plane_step[1]).sqrt();
        let pixel = self.view_height * window.frame_step[1] / self.frame_px[1];
        (if self.perspective > 0.5 {
            step * depth
        } else {
            step
        }) / pixel
    }

    /// Unit vector from a point of the world towards the eye.
    #[inline]
    pub fn to_eye(&self, world: [f32; 3]) -> [f32; 3] {
        if self.perspective < 0.5 {
            return self.forward_world.map(|v| -v);
        }
        let d: [f32; 3] = std::array::from_fn(|i| self.eye_world[i] - world[i]);
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        d.map(|v| v / length.max(1e-30))
    }

    /// A pixel to the right and one down, in normalised device coordinates.
    #[inline]
    pub fn pixel_ndc(&self) -> [f32; 2] {
        [2.0 / self.frame_px[0], -2.0 / self.frame_px[1]]
    }

    /// Normalised device coordinates of a point of the frame, y up.
    #[inline]
    pub fn ndc_at(&self, frame_px: [f32; 2]) -> [f32; 2] {
        [
            2.0 * frame_px[0] / self.frame_px[0] - 1.0,
            1.0 - 2.0 * frame_px[1] / self.frame_px[1],
        ]
    }
}

/// A pixel grid laid over a rectangle of the frame: the colour samples, the mask, a tile of the output.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Window {
    /// Factor from the frame's normalised coordinates to the window's.
    pub ndc_scale: [f32; 2],
    /// Offset after that factor.
    pub ndc_offset: [f32; 2],
    /// Width and height of the grid.
    pub size: [u32; 2],
    /// Frame pixels per grid pixel.
    pub frame_step: [f32; 2],
    /// Frame position of the grid's top left corner.
    pub frame_origin: [f32; 2],
    /// Keeps the size a multiple of 16 bytes.
    pub unused: [u32; 2],
}
gpu_layout!(Window {
    ndc_scale,
    ndc_offset,
    size,
    frame_step,
    frame_origin,
    unused
});

impl Window {
    /// A grid of `size` pixels over the rectangle of the frame at `origin_px`, `extent_px` wide and high.
    pub fn over(
        frame_px: [f32; 2],
        origin_px: [f32; 2],
        extent_px: [f32; 2],
        size: [u32; 2],
    ) -> Self {
        let scale = [frame_px[0] / extent_px[0], frame_px[1] / extent_px[1]];
        let center = [
            (2.0 * origin_px[0] + extent_px[0]) / frame_px[0] - 1.0,
            1.0 - (2.0 * origin_px[1] + extent_px[1]) / frame_px[1],
        ];
        Self {
            ndc_scale: scale,
            ndc_offset: [-center[0] * scale[0], -center[1] * scale[1]],
            size,
            frame_step: [extent_px[0] / size[0] as f32, extent_px[1] / size[1] as f32],
            frame_origin: origin_px,
            unused: [0; 2],
        }
    }

    /// Clip position for this window of a clip position for the whole frame.
    #[inline]
    pub fn clip_here(&self, clip: [f32; 4]) -> [f32; 4] {
        [
            clip[0] * self.ndc_scale[0] + clip[3] * self.ndc_offset[0],
            clip[1] * self.ndc_scale[1] + clip[3] * self.ndc_offset[1],
            clip[2],
            clip[3],
        ]
    }

    /// Normalised device coordinates of the centre of a grid pixel, in the grid's own view; y up.
    #[inline]
    pub fn ndc_of(&self, x: u32, y: u32) -> [f32; 2] {
        let at = [
            (x as f32 + 0.5) / self.size[0] as f32,
            (y as f32 + 0.5) / self.size[1] as f32,
        ];
        [2.0 * at[0] - 1.0, 1.0 - 2.0 * at[1]]
    }

    /// Frame position of the centre of a grid pixel.
    #[inline]
    pub fn frame_at(&self, x: u32, y: u32) -> [f32; 2] {
        [
            self.frame_origin[0] + (x as f32 + 0.5) * self.frame_step[0],
            self.frame_origin[1] + (y as f32 + 0.5) * self.frame_step[1],
        ]
    }

    /// The grid pixel that holds a frame position, clamped to the grid.
    ///
    /// An exact load, not a filtered sample, for the reason given by Okuya 2016, section 5.3.
    pub fn pixel_at(&self, frame_px: [f32; 2]) -> [u32; 2] {
        std::array::from_fn(|i| {
            // The cast rounds down, and without the call that `floor` is on processors without an instruction for it.
            let at = (frame_px[i] - self.frame_origin[i]) / self.frame_step[i];
            at.clamp(0.0, self.size[i] as f32 - 1.0) as u32
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_pixel_centre_finds_its_own_pixel(
            x in 0u32..640, y in 0u32..360, ox in 0f32..500.0, oy in 0f32..300.0, scale in 0.5f32..6.0,
        ) {
            let size = [640, 360];
            let window = Window::over([4000.0, 2000.0], [ox, oy], [640.0 * scale, 360.0 * scale], size);
            prop_assert_eq!(window.pixel_at(window.frame_at(x, y)), [x, y]);
        }

        #[test]
        fn a_window_shows_the_same_point_as_the_frame(fx in 0f32..1920.0, fy in 0f32..1080.0, w in 0.1f32..50.0) {
            let frame = [1920.0, 1080.0];
            let view = View { frame_px: frame, ..View::default() };
            let window = Window::over(frame, [300.0, 200.0], [640.0, 480.0], [640, 480]);
            let ndc = view.ndc_at([fx, fy]);
            let here = window.clip_here([ndc[0] * w, ndc[1] * w, 0.5 * w, w]);
            let px = [(here[0] / here[3] + 1.0) * 320.0, (1.0 - here[1] / here[3]) * 240.0];
            prop_assert!((px[0] - (fx - 300.0)).abs() < 0.01 && (px[1] - (fy - 200.0)).abs() < 0.01);
        }
    }

    #[test]
    fn positions_outside_the_grid_clamp_to_it() {
        let window = Window::over([64.0, 64.0], [0.0, 0.0], [64.0, 64.0], [64, 64]);
        assert_eq!(window.pixel_at([-5.0, 70.0]), [0, 63]);
    }
}
