//! Toon materials of a scene, for styles that use its hints.

use crate::look;
use crate::model::Model;
use crate::options::RendererOptions;
use crate::part_info::PartInfo;
use crate::textures::Textures;
use npr_core::color::srgb_from_linear;
use npr_core::geometry::{NONE, Part};
use npr_core::math;
use npr_core::texture::{self, TextureStore};
use npr_scene::{AlphaMode, OutlineWidth, Scene, TextureTransform, TextureUse};
use npr_style::toon::{Toon, ToonMap};
use npr_stylesheet::{OutlineMethod, SceneHint, Style, Unit, Width};

/// The toon material of a part, before a style is applied.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartToon {
    toon: Toon,
    /// Alpha under which a pixel is a hole; `None` where alpha is ignored.
    alpha_cutoff: Option<f32>,
    double_sided: bool,
    outline: Option<OutlineWidth>,
    /// Picture whose green the outline's width is multiplied by.
    outline_map: ToonMap,
    /// How its pictures move; `None` where they stand still.
    flow: Option<PartFlow>,
}

/// How the pictures of a part move in time.
#[derive(Debug, Clone, PartialEq)]
struct PartFlow {
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
    fn uv(&self, start: [f32; 2], seconds: f32, texels: &[u32]) -> [f32; 2] {
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

impl Model {
    /// Whether pictures on surfaces move in time, as toon materials say.
    pub fn has_flow(&self) -> bool {
        let toons = self.parts.iter().filter_map(|info| info.toon.as_ref());
        toons.into_iter().any(|toon| toon.flow.is_some())
    }

    /// Moves the pictures of toon materials to where they are after some seconds; 0 is where the file lays them. The
    /// same time gives the same model, whatever time it had before. Masks of the movement are looked up at vertices.
    /// O(vertices).
    pub fn flow_textures(&mut self, seconds: f32) {
        if !self.has_flow() || !seconds.is_finite() {
            return;
        }
        let still = self.still_uvs.get_or_insert_with(|| {
            let uvs = self.vertices.iter().map(|vertex| vertex.uv);
            uvs.collect()
        });
        for (vertex, start) in self.vertices.iter_mut().zip(still) {
            let info = self.parts.get(vertex.part as usize);
            let toon = info.and_then(|info| info.toon.as_ref());
            if let Some(flow) = toon.and_then(|toon| toon.flow.as_ref()) {
                vertex.uv = flow.uv(*start, seconds, self.textures.words());
            }
        }
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

/// Whether a style lets the toon material of a part decide its outline.
fn has_outline(info: &PartInfo, style: &Style) -> bool {
    let look = info.look(style);
    let has_hull = matches!(
        look.line_method,
        OutlineMethod::Hull | OutlineMethod::FilterHull
    );
    style.use_scene_hints.uses(SceneHint::Outline) && look.line_on && has_hull
}

/// Whether lines have no width of their own, but those that toon materials give them: their width is then counted in
/// pixels, and other parts have no hulls.
pub(crate) fn has_toon_widths_alone(style: &Style) -> bool {
    let base = style.line.scaled(style.line.width.base);
    style.use_scene_hints.uses(SceneHint::Outline) && base.value <= 0.0
}

/// Gives parts the toon materials that the scene has for them, as far as the style uses its hints.
pub(crate) fn add_toons(
    model: &Model,
    style: &Style,
    options: &RendererOptions,
    parts: &mut [Part],
    textures: &mut TextureStore,
) {
    if !style.use_scene_hints.is_on() {
        return;
    }
    for (info, part) in model.parts.iter().zip(parts) {
        let Some(of_part) = &info.toon else {
            if has_toon_widths_alone(style) {
                part.flags &= !Part::HULL;
            }
            continue;
        };
        if part.flags & Part::BEAM != 0 {
            continue;
        }
        if style.use_scene_hints.uses(SceneHint::Shade) {
            shade(info, style, of_part, part);
        }
        let toon = textured(style, &of_part.toon, part.texture);
        let Some(start) = textures.add_words(bytemuck::cast_slice(&[toon])) else {
            part.flags &= !Part::TOON;
            continue;
        };
        part.toon = start;
        if has_outline(info, style) {
            outline((model, style, options), of_part, part);
        }
    }
}

/// A toon with the picture of its base colour, and without those that a style does without.
fn textured(style: &Style, toon: &Toon, texture: u32) -> Toon {
    let base_map = ToonMap {
        texture,
        ..ToonMap::EMPTY
    };
    if style.shade.use_textures {
        return Toon { base_map, ..*toon };
    }
    Toon {
        base_map,
        shade_map: ToonMap::EMPTY,
        emissive_map: ToonMap::EMPTY,
        ..*toon
    }
}

/// Lets a part be lit as its toon material says.
fn shade(info: &PartInfo, style: &Style, of_part: &PartToon, part: &mut Part) {
    // Take the material's own colour, whatever the mode of the style, unless a rule gives another.
    if info.look(style).shade_color.is_none() {
        part.base_color = info.base_color;
        part.texture = match style.shade.use_textures {
            true => info.texture,
            false => NONE,
        };
    }

    // Light it.
    part.flags &= !(Part::UNLIT | Part::PLAIN | Part::TONE_ROW | Part::CUTOUT | Part::DOUBLE_SIDED);
    part.flags |= Part::TOON;
    if of_part.double_sided {
        part.flags |= Part::DOUBLE_SIDED;
    }
    if let Some(cutoff) = of_part.alpha_cutoff {
        part.flags |= Part::CUTOUT;
        part.alpha_cutoff = cutoff;
    }
}

/// Gives a part with a hull the outline of its toon material, or none.
fn outline(
    (model, style, options): (&Model, &Style, &RendererOptions),
    of_part: &PartToon,
    part: &mut Part,
) {
    // Measure the outline by the style's line.
    let height = options.size[1];
    let outline = look::outline(style, model.radius(), height, options.dpi, 0);
    let is_in_world = style.line.width.base.unit == Unit::World && !has_toon_widths_alone(style);
    let width = match of_part.outline {
        Some(OutlineWidth::World(width)) => {
            part.flags |= Part::WORLD_LINE;
            Some(width)
        }
        Some(OutlineWidth::Screen(share)) if !is_in_world => Some(share * height as f32),
        Some(OutlineWidth::Screen(_)) | None => None,
    };

    // Draw it, or none.
    match width {
        Some(width) if outline.base_width > 0.0 => {
            part.width_factor = width / outline.base_width;
            part.flags |= Part::TOON_LINE;
        }
        _ => part.flags &= !Part::HULL,
    }
}

/// Share of the way from the least to the greatest width factor at which vertex `i` has the width that the outline of
/// its toon material has there; `None` where no toon material decides it.
pub(crate) fn outline_share(model: &Model, style: &Style, i: usize) -> Option<f32> {
    let vertex = &model.vertices[i];
    let info = model.parts.get(vertex.part as usize)?;
    let of_part = info.toon.as_ref()?;
    if !has_outline(info, style) {
        return None;
    }
    let map = &of_part.outline_map;
    let factor = match map.texture {
        NONE => 1.0,
        start => {
            let green = texture::sample(model.textures.words(), start, map.uv(vertex.uv), 0.0)[1];
            srgb_from_linear(green)
        }
    };
    let Width { min, max, .. } = style.line.width;
    Some((factor - min) / (max - min).max(1e-6))
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
