//! The toon material of a part, before a style is applied.

use crate::textures::Textures;
use npr_core::color::srgb_from_linear;
use npr_core::geometry::NONE;
use npr_core::{math, texture};
use npr_scene::{AlphaMode, OutlineWidth, Scene, TextureTransform, TextureUse};
use npr_style::toon::{Toon, ToonMap};

/// The toon material of a part, before a style is applied.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartToon {
    pub toon: Toon,
    /// Alpha under which a pixel is a hole; `None` where alpha is ignored.
    pub alpha_cutoff: Option<f32>,
    pub double_sided: bool,
    pub outline: Option<OutlineWidth>,
    /// Picture whose green the outline's width is multiplied by.
    pub outline_map: ToonMap,
    /// How its pictures move; `None` where they stand still.
    pub flow: Option<PartFlow>,
}

/// How the pictures of a part move in time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartFlow {
    /// Pictures that pass by in a second, and radians of turn.
    scroll: [f32; 2],
    rotation: f32,
    /// Picture whose blue both are multiplied by, at the coordinates of vertices.
    mask: ToonMap,
    /// What turns coordinates of the file into those of vertices, and back.
    laid: ToonMap,
    back: ToonMap,
}

impl PartFlow {
    /// Coordinates of a vertex after some seconds, from those at the start [VRMC_materials_mtoon-1.0, UV animation].
    pub fn uv(&self, start: [f32; 2], seconds: f32, texels: &[u32]) -> [f32; 2] {
        let share = match self.mask.texture {
            NONE => 1.0,
            mask => {
                let blue = texture::sample(texels, mask, self.mask.uv(start), 0.0)[2];
                srgb_from_linear(blue)
            }
        };
        let (gone, turn) = (seconds * share, self.rotation * seconds * share);
        let (sin, cos) = (math::sin(turn), math::cos(turn));
        let [u, v] = self.back.uv(start).map(|v| v - 0.5);
        self.laid.uv([
            cos * u + sin * v + 0.5 + self.scroll[0] * gone,
            cos * v - sin * u + 0.5 + self.scroll[1] * gone,
        ])
    }
}

impl PartToon {
    /// The toon material of a part of a mesh, its pictures packed; none where it has none.
    pub fn new(scene: &Scene, part: &npr_scene::Part, textures: &mut Textures) -> Option<Self> {
        // Pack the pictures, each with how it lies beside the base colour.
        let material = scene.materials.get(part.material? as usize)?;
        let said = material.toon.as_ref()?;
        let base = material.base_color_texture.as_ref();
        let base = base.map_or_else(TextureTransform::default, |texture| texture.transform);
        let mut map = |used: &Option<TextureUse>, below: &TextureTransform| {
            let used = used.as_ref();
            let start = used.and_then(|used| Some((used, textures.start_of(scene, used)?)));
            start.map_or(ToonMap::EMPTY, |(used, texture)| ToonMap {
                texture,
                lay: beside(&used.transform, below),
            })
        };
        let mut laid = |used: &Option<TextureUse>| match part.uvs {
            Some(_) => map(used, &base),
            None => ToonMap::EMPTY,
        };
        let [
            shade_map,
            shift_map,
            rim_map,
            emissive_map,
            outline_map,
            mask,
        ] = [
            laid(&said.shade_texture),
            laid(&said.shading_shift_texture),
            laid(&said.rim_texture),
            laid(&said.emissive_texture),
            laid(&said.outline.texture),
            laid(&said.flow.mask),
        ];
        let matcap_map = map(&said.matcap_texture, &TextureTransform::default());

        // Note the values beside them.
        let lay = |lay: [f32; 6]| ToonMap { texture: NONE, lay };
        let flow = undone(&base).map(|back| PartFlow {
            scroll: said.flow.scroll,
            rotation: said.flow.rotation,
            mask,
            laid: lay(rows(&base)),
            back: lay(back),
        });
        Some(Self {
            toon: Toon {
                shade_color: said.shade_color,
                toony: said.shading_toony,
                rim_color: said.rim_color,
                rim_power: said.rim_power,
                matcap_color: said.matcap_color,
                rim_lift: said.rim_lift,
                emissive: said.emissive,
                rim_mix: said.rim_lighting_mix,
                outline_color: said.outline.color,
                outline_mix: said.outline.lighting_mix,
                shift: said.shading_shift,
                shift_scale: said.shading_shift_scale,
                gi_equalization: said.gi_equalization,
                base_map: ToonMap::EMPTY,
                shade_map,
                shift_map,
                rim_map,
                emissive_map,
                matcap_map,
            },
            alpha_cutoff: match said.alpha {
                AlphaMode::Opaque => None,
                AlphaMode::Mask(cutoff) => Some(cutoff),
                AlphaMode::Blend => Some(0.5),
            },
            double_sided: said.double_sided,
            outline: said.outline.width,
            outline_map,
            flow: flow.filter(|_| !said.flow.is_still()),
        })
    }
}

/// The rows of a transform of coordinates: factors on u and v, and what is added.
fn rows(transform: &TextureTransform) -> [f32; 6] {
    let (sin, cos) = (math::sin(transform.rotation), math::cos(transform.rotation));
    let ([x, y], [w, h]) = (transform.offset, transform.scale);
    [cos * w, sin * h, x, -sin * w, cos * h, y]
}

/// The rows that undo a transform; `None` where that is flat.
fn undone(transform: &TextureTransform) -> Option<[f32; 6]> {
    let [a, b, x, c, d, y] = rows(transform);
    let determinant = a * d - b * c;
    if determinant.abs() < 1e-12 {
        return None;
    }
    let [p, q, r, s] = [d, -b, -c, a].map(|v| v / determinant);
    Some([p, q, -p * x - q * y, r, s, -r * x - s * y])
}

/// What turns coordinates that lie by `below` into those that lie by `transform`.
fn beside(transform: &TextureTransform, below: &TextureTransform) -> [f32; 6] {
    if transform == below {
        return ToonMap::EMPTY.lay;
    }
    let Some([p, q, u, r, s, v]) = undone(below) else {
        return ToonMap::EMPTY.lay;
    };
    let [a, b, x, c, d, y] = rows(transform);
    [
        a * p + b * r,
        a * q + b * s,
        a * u + b * v + x,
        c * p + d * r,
        c * q + d * s,
        c * u + d * v + y,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn transform(offset: [f32; 2], rotation: f32, scale: [f32; 2]) -> TextureTransform {
        TextureTransform {
            offset,
            rotation,
            scale,
        }
    }

    proptest! {
        /// The oracle applies one transform after the other.
        #[test]
        fn a_picture_lies_where_its_own_transform_has_it(
            offsets in prop::array::uniform4(-2f32..2.0), turns in prop::array::uniform2(-3f32..3.0),
            scales in prop::array::uniform4(0.2f32..3.0), uv in prop::array::uniform2(-2f32..2.0),
        ) {
            let [a, b, c, d] = offsets;
            let below = transform([a, b], turns[0], [scales[0], scales[1]]);
            let own = transform([c, d], turns[1], [scales[2], scales[3]]);
            let lay = |lay| ToonMap { texture: NONE, lay };
            let got = lay(beside(&own, &below)).uv(lay(rows(&below)).uv(uv));
            let wanted = lay(rows(&own)).uv(uv);
            prop_assert!((0..2).all(|i| (got[i] - wanted[i]).abs() < 1e-3), "{got:?}, not {wanted:?}");
        }
    }

    /// A quarter turn about the middle takes the right edge to the top, counter-clockwise in the picture.
    #[test]
    fn pictures_turn_about_their_middle_and_scroll() {
        let still = ToonMap::EMPTY;
        let mut flow = PartFlow {
            scroll: [0.0; 2],
            rotation: std::f32::consts::FRAC_PI_2,
            mask: still,
            laid: still,
            back: still,
        };
        let near = |a: [f32; 2], b: [f32; 2]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-6);
        assert!(near(flow.uv([1.0, 0.5], 1.0, &[]), [0.5, 0.0]));
        flow.rotation = 0.0;
        flow.scroll = [0.25, -0.5];
        assert!(near(flow.uv([0.5, 0.5], 2.0, &[]), [1.0, -0.5]));
    }
}
