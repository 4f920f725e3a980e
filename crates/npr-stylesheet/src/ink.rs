//! The table `ink` of a style: shade that is drawn with the pen, as solid ink, hatching, both or none.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::overlay::{rule_table, style_table};
use crate::{Color, Hatch, Length, Pattern};

/// What the shade of a surface is drawn with [Suzuki 2004, figure 2.3].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// Nothing: the tones of the fill alone.
    #[default]
    #[serde(rename = "none")]
    Off,
    /// Solid ink up to one hard edge.
    Ink,
    /// Strokes that leave paper between them even in the dark.
    Hatch,
    /// Strokes that swell into solid ink.
    #[serde(rename = "ink+hatch")]
    InkHatch,
    /// By the material: ink on metal and on what is polished, ink and hatch on everything else.
    Auto,
}

/// What strokes are fixed to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Mapping {
    /// The surface and its bends: strokes stay on it while the camera moves.
    #[default]
    Surface,
    /// The UV coordinates of the file. Parts without any take `surface`.
    Uv,
    /// The picture: one direction everywhere, as cut from a sheet of screen tone.
    Screen,
}

/// What strokes on a surface run along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Follow {
    /// The limbs of figures that a skeleton bends: on legs strokes lean to where the leg begins, on arms to the hand,
    /// on the trunk to its middle line [Suzuki 2004, section 2.3.1]; hair and tails take strokes along. What no limb
    /// moves takes `around`.
    #[default]
    Limbs,
    /// Round the form: the direction in which the surface bends most.
    Around,
    /// Along the form: the direction in which it bends least.
    Along,
    /// From the dark to the strongest light, so strokes turn as that moves.
    Light,
    /// The vertex attribute `_DIRECTION` of glTF files: painted by hand, part by part. Without one, `around`.
    Attribute,
    /// The vertex colours as directions: red along x, green y, blue z, from -1 at 0 to 1 at full linear light, as
    /// normal maps have them. White says nothing, as does middle grey; without any, `around`.
    VertexColor,
}

/// What a direction of strokes is fixed to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StrokeSpace {
    /// The scene.
    #[default]
    World,
    /// The object: the direction turns with it, and with the bones of what bends.
    Object,
}

/// Roughness under which a material counts as polished for [`Tone::Auto`].
const POLISHED: f32 = 0.3;

style_table! {
/// The pen's part of the shade.
///
/// The light on a surface gives a shade ramp, black up to `dark_at` and white from `light_at`; hatching is added to
/// it and the sum cut at `threshold` [Suzuki 2004, section 3.3]. Solid ink ends a quarter of the way between the two
/// places, the last stroke three quarters.
pub struct Ink {
    /// What the shade is drawn with; default `none`.
    pub tone: Tone = Tone::Off,
    /// Colour of ink and strokes; default black. Alpha is how much it covers.
    pub color: Color = Color::rgb(0, 0, 0),
    /// Place on the ramp, 0..1, up to which the shade ramp is black; default 0.2. Raise it for more solid black: 0
    /// leaves strokes alone, 0.5 blackens everything that faces away.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub dark_at: f32 = 0.2,
    /// Place on the ramp, 0..1, from which it is white; default 0.75. Close to `dark_at` strokes are short and
    /// stubby, far from it long and tapered.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub light_at: f32 = 0.75,
    /// Where the sum is cut, 0..1; default 0.5. Higher is blacker all over.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub threshold: f32 = 0.5,
    /// How much the colour of a surface darkens its shade, 0..1; default 0, not at all. On paper it keeps painted
    /// eyes, stripes and dark leather: black paint is solid ink at any value, middle tones take strokes, 0.5 few, 1
    /// as many as they are dark.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub paint: f32 = 0.0,
    /// What strokes are fixed to; default `surface`.
    pub mapping: Mapping = Mapping::Surface,
    /// How much of their hatched shade the faces of figures keep, 0..1; default 0.25: hatching suits bodies, and ages
    /// faces [Suzuki 2004, section 2.3.2]. A face is what the bone of the head moves; where expressions move meshes, it
    /// lies on those alone. 1 treats faces as all else, 0 leaves them as white as paint lets them.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub faces: f32 = 0.25,
    /// For mapping `surface`: what strokes run along; default `limbs`. On mapping `screen` too, `light` turns them.
    /// With a light that is fixed to the camera, `light` lays strokes anew in every view: for films take `light.space
    /// = "world"`.
    pub follow: Follow = Follow::Limbs,
    /// For mapping `surface`: a direction that strokes follow instead; default none. `[0, 1, 0]` lets them fall like
    /// cloth.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub direction: Option<[f32; 3]> = None,
    /// What `direction` is fixed to; default `world`. `object` for limbs that move.
    pub direction_space: StrokeSpace = StrokeSpace::World,
    /// The strokes.
    pub hatch: Hatch = Hatch::default(),
}
}

rule_table! {
/// What a rule changes about ink and hatching; what is absent stays.
pub struct RuleInk over Ink {
    /// What the shade is drawn with.
    pub tone: Tone,
    /// Colour of ink and strokes.
    pub color: Color,
    /// Place on the ramp, 0..1, up to which the shade ramp is black.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub dark_at: f32,
    /// Place on the ramp, 0..1, from which it is white.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub light_at: f32,
    /// How much its colour darkens its shade, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub paint: f32,
    /// What strokes are fixed to.
    pub mapping: Mapping,
    /// How much of their hatched shade faces keep, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub faces: f32,
    /// What strokes on the surface run along; without a `direction` beside it the style's own gives way.
    pub follow: Follow,
    /// A direction that strokes on the surface follow.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    #[yields_to(follow)]
    pub direction: [f32; 3],
    /// What the direction is fixed to.
    pub direction_space: StrokeSpace,
}
with {
    /// Its strokes.
    pub hatch: RuleHatch,
}
}

rule_table! {
/// What a rule changes about strokes; what is absent stays.
pub struct RuleHatch over Hatch {
    /// What shadows are drawn with.
    pub pattern: Pattern,
    /// A picture that shadows are drawn with; empty for `pattern` after all. A pattern beside it gives way.
    #[yields_to(pattern)]
    pub image: String,
    /// Distance between strokes or dots on screen.
    pub spacing: Length,
    /// Length of a stroke in spacings, 1..200.
    #[schemars(range(min = 1.0, max = 200.0))]
    pub length: f32,
    /// Direction of strokes against that of the surface, in degrees, -180..180.
    #[schemars(range(min = -180.0, max = 180.0))]
    pub angle_deg: f32,
}
}

impl Tone {
    /// Whether there is solid ink, and whether there are strokes, on a material of this metalness and roughness, 0..1.
    pub fn ink_and_hatch(self, metallic: f32, roughness: f32) -> [bool; 2] {
        match self {
            Self::Off => [false, false],
            Self::Ink => [true, false],
            Self::Hatch => [false, true],
            Self::InkHatch => [true, true],
            Self::Auto => [true, metallic <= 0.5 && roughness >= POLISHED],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metal_is_inked_and_cloth_is_hatched() {
        assert_eq!(Tone::Auto.ink_and_hatch(1.0, 0.8), [true, false]);
        assert_eq!(Tone::Auto.ink_and_hatch(0.0, 0.1), [true, false]);
        assert_eq!(Tone::Auto.ink_and_hatch(0.0, 0.9), [true, true]);
    }
}
