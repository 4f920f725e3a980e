//! Materials, as far as drawings use them.

/// How a surface looks before a style changes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// Base colour in linear light with straight alpha, multiplied with the texture.
    pub base_color: [f32; 4],
    /// Image of the base colour; none where there is none or it could not be decoded.
    pub base_color_texture: Option<TextureUse>,
    /// 0 a dielectric, 1 a metal; half of the file's factor where a texture, which is not read, decides.
    pub metallic: f32,
    /// 0 a mirror, 1 chalk; halved likewise.
    pub roughness: f32,
    /// Light the surface gives off, linear, strength worked in; may exceed 1.
    pub emissive: [f32; 3],
    /// Whether back faces are drawn.
    pub double_sided: bool,
    /// What alpha means.
    pub alpha: AlphaMode,
    /// Whether the file asks for the base colour without shading.
    pub unlit: bool,
    /// Whether the file asks for a line wherever this material meets another: `extras.npr.lines` of a glTF material.
    pub marked: bool,
}

impl Default for Material {
    /// The material of a surface that names none in glTF, except that it is rough and not metallic.
    fn default() -> Self {
        Self {
            name: String::new(),
            base_color: [1.0; 4],
            base_color_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            emissive: [0.0; 3],
            double_sided: false,
            alpha: AlphaMode::Opaque,
            unlit: false,
            marked: false,
        }
    }
}

/// What a material's alpha means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Pixels below this alpha are not drawn, the others are opaque.
    Mask(f32),
    /// Alpha is coverage.
    Blend,
}

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
