//! The libraries that shaders share.

use crate::Features;

/// Text that shaders share.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Library {
    /// Its path below the folder of shaders, without the extension.
    path: &'static str,
    /// Its text.
    text: &'static str,
    /// The features any of which needs it; without a feature it is there always.
    pub serves: Features,
    /// The text in its place where no feature needs it.
    without: &'static str,
}

impl Library {
    /// Its text in a shader for `features`.
    pub fn text_for(&self, features: Features) -> &'static str {
        match self.serves.serve(features) {
            true => self.text,
            false => self.without,
        }
    }
}

/// A library that every frame needs.
macro_rules! always {
    ($name:literal) => {
        Library {
            path: concat!("lib/", $name),
            text: include_str!(concat!("../lib/", $name, ".wgsl")),
            serves: Features::NONE,
            without: "",
        }
    };
}

/// A library that only frames with a feature need; others take what stands below `lib/none/`.
macro_rules! serving {
    ($features:expr, $name:literal) => {
        Library {
            path: concat!("lib/", $name),
            text: include_str!(concat!("../lib/", $name, ".wgsl")),
            serves: $features,
            without: include_str!(concat!("../lib/none/", $name, ".wgsl")),
        }
    };
}

/// All libraries.
const LIBRARIES: &[Library] = &[
    always!("adapt"),
    serving!(Features::BACK_LIGHT, "back_light"),
    always!("backdrop"),
    serving!(Features::COLORS, "base_color"),
    serving!(Features::BEAMS, "beam"),
    serving!(Features::BEAMS, "beam_ids"),
    serving!(Features::BRUSHES, "brush"),
    always!("color"),
    always!("compose"),
    serving!(Features::BACKDROP, "contrast"),
    always!("curve"),
    serving!(Features::EVEN_TONES, "cut_tone"),
    serving!(Features::CUTOUTS, "cutout"),
    always!("depth_map"),
    always!("edge_flags"),
    serving!(Features::EVEN_TONES, "even_tones"),
    always!("four"),
    always!("geometry"),
    serving!(Features::GLOSS, "gloss"),
    serving!(Features::GLOSS, "gloss_bound"),
    always!("grain"),
    serving!(Features::ANGLES, "grazing"),
    always!("grid"),
    always!("holder"),
    serving!(Features::HULLS, "hull"),
    always!("ink"),
    always!("ink_point"),
    serving!(Features::INK, "ink_level"),
    serving!(Features::INK, "ink_tone"),
    serving!(Features::INK, "inking"),
    serving!(Features::BACKDROP, "left_out"),
    always!("lighting"),
    always!("line_color"),
    always!("line_kind"),
    always!("line_place"),
    always!("line_tint"),
    always!("list"),
    always!("looped"),
    serving!(Features::LIGHTS.or(Features::SHADOWS), "many_lights"),
    always!("outline"),
    serving!(Features::OVERLAY, "overlay_layer"),
    serving!(Features::PAINT, "paint"),
    serving!(Features::GRAIN, "paper"),
    always!("pixel"),
    always!("pose"),
    always!("random"),
    always!("ribbon"),
    always!("ribbon_quad"),
    serving!(Features::RIBBONS, "ribbon_layer"),
    always!("samples"),
    serving!(Features::TEXTURES, "sampling"),
    always!("scenery"),
    serving!(Features::SECOND_LAYER, "second_layer"),
    serving!(Features::EVEN_TONES, "settled_tone"),
    serving!(Features::SHADOWS, "shadow"),
    serving!(Features::SHAPED_GLOSS, "shaped_gloss"),
    serving!(Features::SKY, "sky"),
    always!("smoke"),
    serving!(Features::SMOKE, "smoke_cover"),
    serving!(Features::SMOKE, "smoke_depth"),
    serving!(Features::SMOKE, "smoke_layer"),
    always!("smoke_line"),
    serving!(Features::SMOKE_PEN, "smoke_pen"),
    serving!(Features::SMOKE_SHADOWS, "smoke_shadow"),
    always!("sphere"),
    always!("spine"),
    always!("stamp"),
    always!("step"),
    serving!(Features::STREAKS, "streak"),
    always!("stretch"),
    always!("surface"),
    always!("surface_color"),
    always!("surface_light"),
    serving!(Features::HULLS.or(Features::ANGLES), "surface_line"),
    always!("texture"),
    serving!(Features::TINTS, "tints"),
    always!("tone_range"),
    always!("ink_step"),
    always!("tone_word"),
    serving!(Features::TONE_ROWS, "tone_row"),
    serving!(Features::TOON, "toon"),
    always!("triangle_constants"),
    always!("unit"),
    always!("varying"),
    always!("window"),
];

/// The library of that name.
pub(crate) fn library(name: &str) -> &'static Library {
    let found = LIBRARIES.iter().find(|library| library.path == name);
    found.unwrap_or_else(|| panic!("a shader uses '{name}', which is no library"))
}
