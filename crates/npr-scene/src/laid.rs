//! How images lie on surfaces.

/// An image as a material uses it.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureUse {
    /// Index into the scene's images.
    pub image: u32,
    /// Which coordinate set of the file it uses; [`Part::uvs`](crate::Part::uvs) is that set.
    pub uv_set: u32,
    /// What happens outside 0..1, along u and along v.
    pub wrap: [Wrap; 2],
    /// Change of the coordinates before the image is looked up.
    pub transform: TextureTransform,
}

/// What a texture shows outside 0..1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    Repeat,
    /// The image mirrored in every second tile.
    Mirror,
    /// The colour of the nearest edge.
    Clamp,
}

/// Scale, then rotation, then offset of texture coordinates (`KHR_texture_transform`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureTransform {
    /// Added last, in widths and heights of the image.
    pub offset: [f32; 2],
    /// Counter-clockwise turn of the coordinates, in radians.
    pub rotation: f32,
    /// Factors applied first.
    pub scale: [f32; 2],
}

impl Default for TextureTransform {
    fn default() -> Self {
        Self {
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
        }
    }
}
