//! Toon materials: how a file asks for light to be drawn as two flat colours, with rims and outlines.
//!
//! The terms are those of MToon [VRMC_materials_mtoon-1.0]; values of VRM 0.x are converted to them.

use crate::alpha::AlphaMode;
use crate::laid::TextureUse;

/// How a material is drawn as a toon, beside its base colour. All colours are linear light.
#[derive(Debug, Clone, PartialEq)]
pub struct Toon {
    /// Colour where no light falls, in place of the base colour.
    pub shade_color: [f32; 3],
    /// Image that the shade colour is multiplied by.
    pub shade_texture: Option<TextureUse>,
    /// Moves the border between light and shade: added to the cosine between normal and light.
    pub shading_shift: f32,
    /// Image whose red, as a number 0..1, times `shading_shift_scale` is added to the shift.
    pub shading_shift_texture: Option<TextureUse>,
    /// Factor on that image.
    pub shading_shift_scale: f32,
    /// How hard the border is, 0..1: 0 as soft as on chalk, 1 cut out.
    pub shading_toony: f32,
    /// How much light from everywhere is the same on all sides, 0..1.
    pub gi_equalization: f32,
    /// Factor on the light of `matcap_texture`.
    pub matcap_color: [f32; 3],
    /// Image of light that lies over the surface by the direction in which it faces in the picture.
    pub matcap_texture: Option<TextureUse>,
    /// Light that is added where the surface turns from the eye.
    pub rim_color: [f32; 3],
    /// Image that both lights are multiplied by.
    pub rim_texture: Option<TextureUse>,
    /// Exponent of the rim: greater is narrower.
    pub rim_power: f32,
    /// Widens the rim.
    pub rim_lift: f32,
    /// How much of rim and matcap is multiplied by the light that falls on the surface, 0..1.
    pub rim_lighting_mix: f32,
    /// Light that the surface gives off.
    pub emissive: [f32; 3],
    /// Image that this light is multiplied by.
    pub emissive_texture: Option<TextureUse>,
    /// Its outline.
    pub outline: ToonOutline,
    /// Place among blending materials, -9..9: lower ones are drawn first.
    pub render_queue_offset: i32,
    /// Whether it hides what lies behind it though it blends.
    pub blends_with_depth: bool,
    /// What alpha means.
    pub alpha: AlphaMode,
    /// Whether back faces are drawn.
    pub double_sided: bool,
    /// How its images move.
    pub flow: UvFlow,
}

impl Default for Toon {
    /// The values of a material that states none.
    fn default() -> Self {
        Self {
            shade_color: [0.0; 3],
            shade_texture: None,
            shading_shift: 0.0,
            shading_shift_texture: None,
            shading_shift_scale: 1.0,
            shading_toony: 0.9,
            gi_equalization: 0.9,
            matcap_color: [1.0; 3],
            matcap_texture: None,
            rim_color: [0.0; 3],
            rim_texture: None,
            rim_power: 5.0,
            rim_lift: 0.0,
            rim_lighting_mix: 1.0,
            emissive: [0.0; 3],
            emissive_texture: None,
            outline: ToonOutline::default(),
            render_queue_offset: 0,
            blends_with_depth: false,
            alpha: AlphaMode::Opaque,
            double_sided: false,
            flow: UvFlow::default(),
        }
    }
}

impl Toon {
    /// The images that lie on the surface or are looked up by it, in the order of the fields.
    pub fn textures(&self) -> impl Iterator<Item = &TextureUse> {
        let all = [
            &self.shade_texture,
            &self.shading_shift_texture,
            &self.matcap_texture,
            &self.rim_texture,
            &self.emissive_texture,
            &self.outline.texture,
            &self.flow.mask,
        ];
        all.into_iter().flatten()
    }
}

/// The outline of a toon: backs of a hull around it.
#[derive(Debug, Clone, PartialEq)]
pub struct ToonOutline {
    /// How wide it is; none where there is no outline.
    pub width: Option<OutlineWidth>,
    /// Image whose green, as a number 0..1, the width is multiplied by.
    pub texture: Option<TextureUse>,
    /// Its colour, linear light.
    pub color: [f32; 3],
    /// How much of the colour is multiplied by what the surface shows, 0..1.
    pub lighting_mix: f32,
}

impl Default for ToonOutline {
    fn default() -> Self {
        Self {
            width: None,
            texture: None,
            color: [0.0; 3],
            lighting_mix: 1.0,
        }
    }
}

/// Width of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OutlineWidth {
    /// In metres: it narrows with the distance.
    World(f32),
    /// As a share of the height of the picture, at any distance.
    Screen(f32),
}

/// How the images of a surface move in time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct UvFlow {
    /// Images that pass by in a second, along u and v.
    pub scroll: [f32; 2],
    /// Radians in a second by which coordinates turn about the middle of the image, counter-clockwise.
    pub rotation: f32,
    /// Image whose blue, as a number 0..1, both are multiplied by.
    pub mask: Option<TextureUse>,
}

impl UvFlow {
    /// Whether nothing moves.
    pub fn is_still(&self) -> bool {
        self.scroll == [0.0; 2] && self.rotation == 0.0
    }
}
