//! Materials, as far as drawings use them.

use crate::alpha::AlphaMode;
use crate::laid::TextureUse;
use crate::toon::Toon;

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
    /// How the file asks for it to be drawn as a toon: `VRMC_materials_mtoon`, or `VRM/MToon` of VRM 0.x.
    pub toon: Option<Box<Toon>>,
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
            toon: None,
        }
    }
}
