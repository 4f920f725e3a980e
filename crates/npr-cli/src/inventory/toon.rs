//! Toon materials in an inventory.

use npr_scene::OutlineWidth;
use serde::Serialize;
use std::fmt::Write;

/// How a material is drawn as a toon by styles that say `use_scene_hints = true`.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Toon {
    /// Linear light.
    shade_color: [f32; 3],
    /// Index of the image that it is multiplied by.
    shade_image: Option<u32>,
    shading_shift: f32,
    shading_toony: f32,
    rim_color: [f32; 3],
    matcap_image: Option<u32>,
    outline: Option<Outline>,
    /// Images a second along u and v.
    scroll: [f32; 2],
    /// Radians a second.
    rotation: f32,
}

/// An outline, `world` metres or `screen` heights of the picture wide.
#[derive(Debug, Clone, Serialize)]
struct Outline {
    unit: &'static str,
    width: f32,
    color: [f32; 3],
    lighting_mix: f32,
}

impl Toon {
    pub fn of(toon: &npr_scene::Toon) -> Self {
        let image = |texture: &Option<npr_scene::TextureUse>| texture.as_ref().map(|t| t.image);
        let outline = toon.outline.width.map(|width| {
            let (unit, width) = match width {
                OutlineWidth::World(width) => ("world", width),
                OutlineWidth::Screen(width) => ("screen", width),
            };
            Outline {
                unit,
                width,
                color: toon.outline.color,
                lighting_mix: toon.outline.lighting_mix,
            }
        });
        Self {
            shade_color: toon.shade_color,
            shade_image: image(&toon.shade_texture),
            shading_shift: toon.shading_shift,
            shading_toony: toon.shading_toony,
            rim_color: toon.rim_color,
            matcap_image: image(&toon.matcap_texture),
            outline,
            scroll: toon.flow.scroll,
            rotation: toon.flow.rotation,
        }
    }

    /// The marks of the material that say what it asks for.
    pub fn text(&self) -> String {
        let [r, g, b] = self.shade_color;
        let mut text = format!("toon with shade {r:.3},{g:.3},{b:.3}");
        let _ = write!(
            text,
            " from {:.2} to {:.2}",
            self.shading_toony - 1.0 - self.shading_shift,
            1.0 - self.shading_toony - self.shading_shift
        );
        if self.rim_color != [0.0; 3] {
            text.push_str(", rim");
        }
        if self.matcap_image.is_some() {
            text.push_str(", matcap");
        }
        match &self.outline {
            Some(outline) if outline.unit == "world" => {
                let _ = write!(text, ", outline {} m", outline.width);
            }
            Some(outline) => {
                let _ = write!(text, ", outline {:.3} %h", outline.width * 100.0);
            }
            None => {}
        }
        if self.scroll != [0.0; 2] || self.rotation != 0.0 {
            text.push_str(", moving");
        }
        text
    }
}
