//! Toon materials of a scene, for styles that use its hints.

use crate::model::Model;
use crate::part_info::PartInfo;
use crate::part_toon::PartToon;
use npr_core::color::srgb_from_linear;
use npr_core::geometry::{NONE, Part};
use npr_core::texture::{self, TextureStore};
use npr_scene::OutlineWidth;
use npr_style::toon::{Toon, ToonMap};
use npr_stylesheet::{OutlineMethod, SceneHint, Style, Unit, Width};

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

/// What widths of outlines are measured by.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LineMeasure {
    /// Height of the frame in pixels.
    pub height_px: f32,
    /// Width of the style's lines, as passes have it.
    pub base_width: f32,
}

/// Gives parts the toon materials that the scene has for them, as far as the style uses its hints.
pub(crate) fn add_toons(
    model: &Model,
    style: &Style,
    measure: LineMeasure,
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
            outline(style, &measure, of_part, part);
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
fn outline(style: &Style, measure: &LineMeasure, of_part: &PartToon, part: &mut Part) {
    // Measure the outline by the style's line.
    let is_in_world = style.line.width.base.unit == Unit::World && !has_toon_widths_alone(style);
    let width = match of_part.outline {
        Some(OutlineWidth::World(width)) => {
            part.flags |= Part::WORLD_LINE;
            Some(width)
        }
        Some(OutlineWidth::Screen(share)) if !is_in_world => Some(share * measure.height_px),
        Some(OutlineWidth::Screen(_)) | None => None,
    };

    // Draw it, or none.
    match width {
        Some(width) if measure.base_width > 0.0 => {
            part.width_factor = width / measure.base_width;
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
