//! Surfaces shaded by their ramps, lines over them, background behind: the twin of `shade.compose_frame`.

use bytemuck::{Pod, Zeroable};
use npr_core::color::SrgbEncoder;
use npr_core::geometry::NONE;
use npr_core::gpu_layout;

mod composer;
mod known;
mod layers;

pub use crate::luminance::LUMA;
pub use crate::triangle_constants::TriangleConstants;
pub use composer::{compose, encoded, fill};
pub use known::know_triangles;
pub use layers::Layers;
pub(crate) use layers::Samples;

/// Settings of the last pass.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct Compose {
    /// Background colour, linear light, straight alpha.
    pub background: [f32; 4],
    /// Colour of lines drawn straight from the mask, sRGB, straight alpha.
    pub line_color: [f32; 4],
    /// Header of the background texture, or [`NONE`].
    pub background_texture: u32,
    /// Bits of [`Compose::RIBBONS`] to [`Compose::BARE`].
    pub flags: u32,
    /// Strength of surface colours: 0 grey, 1 as they are.
    pub saturation: f32,
    /// Samples per pixel along each axis, 1 or 2.
    pub samples: u32,
    /// Unit vector to the right of the picture, in the world: the first axis of shaped highlights.
    pub right_world: [f32; 3],
    /// Texels along a side of the lights' depth pictures of the smoke; 0 if it throws no shadow on surfaces.
    pub smoke_shadow_side: u32,
    /// Unit vector up the picture, in the world.
    pub up_world: [f32; 3],
    /// Radius of the model, in which places of streaks are measured.
    pub radius: f32,
    /// Unit vector from the picture towards the eye, in the world.
    pub near_world: [f32; 3],
    /// How softly the line of the surface-angle method ends, as a part of its band, 0..1.
    pub angle_softness: f32,
    /// Middle of the model.
    pub center_world: [f32; 3],
    /// Number of the part whose ramp and ink finish the smoke, with [`Compose::SMOKE_PEN`].
    pub smoke_part: u32,
    /// Colour of the smoke's outline, linear light.
    pub smoke_line: [f32; 4],
    /// Where the sheet with the smoke's strokes is fixed, in frame pixels.
    pub smoke_anchor_px: [f32; 2],
    /// Hatch tiles of that sheet to a frame pixel.
    pub smoke_tiles: f32,
    /// The background as sRGB bytes with straight alpha, where it has one colour.
    pub background_texel: u32,
}
gpu_layout!(Compose {
    background,
    line_color,
    background_texture,
    flags,
    saturation,
    samples,
    right_world,
    smoke_shadow_side,
    up_world,
    radius,
    near_world,
    angle_softness,
    center_world,
    smoke_part,
    smoke_line,
    smoke_anchor_px,
    smoke_tiles,
    background_texel,
});

impl Compose {
    /// Settings for a picture before a background of one colour, linear light with straight alpha.
    pub fn before(background: [f32; 4]) -> Self {
        let [r, g, b, a] = background;
        Self {
            background,
            background_texture: NONE,
            background_texel: encoded(&SrgbEncoder::new(), [r * a, g * a, b * a, a]),
            saturation: 1.0,
            ..Self::default()
        }
    }

    /// The camera's axes in the world: to the right, up, and towards the eye.
    pub fn axes(&self) -> [[f32; 3]; 3] {
        [self.right_world, self.up_world, self.near_world]
    }
}

impl Compose {
    /// Lays the ribbons over the surfaces.
    pub const RIBBONS: u32 = 1;
    /// Lays the overlay over the surfaces: stamps, or the mask itself.
    pub const OVERLAY: u32 = 2;
    /// Lays beams of light over the surfaces.
    pub const BEAMS: u32 = 4;
    /// Lays smoke over what lies behind it.
    pub const SMOKE: u32 = 8;
    /// Finishes the smoke: its picture still holds tones and lines, see [`crate::smoke::pen`].
    pub const SMOKE_PEN: u32 = 16;
    /// Blends lines by their sRGB values, as viewers of SVG do: a hair line over two rows of pixels looks as dark as
    /// over one.
    pub const LINES_IN_SRGB: u32 = 32;
    /// Adapts lines to the colours on both of their sides, [`Layers::fronts`] and [`Layers::backs`].
    pub const BACKDROP: u32 = 64;
    /// Composes the picture without any lines, and only in the tiles that [`Layers::fronts`] marks.
    pub const BARE: u32 = 128;
}

/// Texture coordinates of a frame position in a centred picture that covers the whole frame and is cut at two sides,
/// and the size of a frame pixel in texture coordinates.
pub fn cover(frame_px: [f32; 2], frame: [f32; 2], size: [f32; 2]) -> ([f32; 2], f32) {
    let zoom = (frame[0] / size[0]).max(frame[1] / size[1]);
    let uv = std::array::from_fn(|i| (frame_px[i] - 0.5 * frame[i]) / (size[i] * zoom) + 0.5);
    (uv, 1.0 / (size[0].max(size[1]) * zoom))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backdrop::Rules;
    use crate::lighting::Lights;
    use npr_core::texture::TextureStore;
    use npr_core::window::{View, Window};

    /// A frame of 4x4 pixels without triangles.
    fn empty_frame(compose_settings: &Compose, ribbons: &[u32]) -> Vec<u32> {
        let view = View {
            frame_px: [4.0; 2],
            ..View::default()
        };
        let window = Window::over([4.0; 2], [0.0; 2], [4.0; 2], [4, 4]);
        let store = TextureStore::new();
        let (lights, rules) = (Lights::default(), Rules::default());
        let layers = Layers {
            ids: &[0; 64],
            ribbons,
            texels: store.words(),
            ..Layers::empty(&view, &window, compose_settings, &lights, &rules)
        };
        let (mut frame, mut list) = (vec![0; 16], vec![0; 17]);
        fill(&layers, &mut frame, &mut list);
        compose(&layers, &list, &mut frame);
        frame
    }

    fn plain(background: [f32; 4]) -> Compose {
        Compose {
            samples: 2,
            ..Compose::before(background)
        }
    }

    #[test]
    fn nothing_shows_the_background() {
        assert_eq!(
            empty_frame(&plain([1.0, 0.0, 0.0, 1.0]), &[0; 16]),
            [0xff00_00ff; 16]
        );
        assert_eq!(empty_frame(&plain([0.0; 4]), &[0; 16]), [0; 16]);
    }

    /// Middle lies on middle, two sides of the picture on two of the frame, and the other two beyond it.
    #[test]
    fn pictures_cover_frames_middle_on_middle() {
        // A frame of 200 x 100 and a picture of 50 x 50: four pixels a texel, and half of the rows show.
        let wide = |x: f32, y: f32| cover([x, y], [200.0, 100.0], [50.0; 2]);
        assert_eq!(wide(100.0, 50.0), ([0.5; 2], 0.005));
        assert_eq!(
            [wide(0.0, 0.0).0, wide(200.0, 100.0).0],
            [[0.0, 0.25], [1.0, 0.75]]
        );
        // A frame of 100 x 100 and a picture of 80 x 20: five pixels a texel, and a quarter of the columns shows.
        let long = |x: f32, y: f32| cover([x, y], [100.0; 2], [80.0, 20.0]);
        assert_eq!(long(50.0, 50.0), ([0.5; 2], 0.0025));
        assert_eq!(
            [long(0.0, 0.0).0, long(100.0, 100.0).0],
            [[0.375, 0.0], [0.625, 1.0]]
        );
    }

    #[test]
    fn a_line_over_nothing_keeps_its_own_coverage() {
        let settings = Compose {
            flags: Compose::RIBBONS,
            ..plain([0.0; 4])
        };
        assert_eq!(
            empty_frame(&settings, &[0x8010_2030; 16]),
            [0x8010_2030; 16]
        );
    }
}
