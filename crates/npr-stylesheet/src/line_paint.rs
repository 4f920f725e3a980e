//! The table `line.paint` of a style: where the colour of lines comes from. [`npr_style::line_color`] does the
//! arithmetic.

use color::{AlphaColor, HueDirection, Oklab, Srgb};
use npr_core::color::{pack_rgba8, srgb_from_linear};
use npr_core::geometry::Part;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use npr_style::line_color::HUES;

use crate::error::StyleError;
use crate::overlay::style_table;
use crate::ramp::check_order;
use crate::{Color, KindColors};

/// Most stops of a ramp that is laid over lines.
pub const HUE_STOPS_MAX: usize = 16;

/// Where the colour of a line comes from, before light, depth and tint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "LineSource")]
pub enum LineColorSource {
    /// From `line.color`.
    #[default]
    Constant,
    /// From the surface at the line, as it is without light, times `factor`: a darker version of the fill.
    Surface,
    /// From the colours of its vertices, times `factor`.
    VertexColor,
    /// From `image` at the surface's texture coordinates, times `factor`.
    Texture,
}

/// What depth is counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DepthSpace {
    /// 0 where the sphere around the model is nearest to the eye, 1 where it is farthest.
    #[default]
    Model,
    /// Distance along the view axis, in the scene's unit.
    World,
}

impl DepthSpace {
    /// Places in it as distances: from the eye in the scene's unit, or from the middle of a model of a radius, whose
    /// nearest point lies one radius before it and its farthest one behind.
    pub fn counted(self, places: [f32; 2], radius: f32) -> [f32; 2] {
        match self {
            Self::Model => places.map(|share| (2.0 * share - 1.0) * radius),
            Self::World => places,
        }
    }
}

/// A colour of a row and its place on it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HueStop {
    /// Its place, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f32,
    /// What is laid over the line there; alpha is how much: `#fff0` leaves the line as it is, `#fff` makes it white.
    pub color: Color,
}

style_table! {
/// How the colour of lines changes with depth: far lines pale, or blend into snow and mist.
pub struct LineDepth;

/// What a rule changes about the colour of lines over depth; what is absent stays.
pub struct RuleLineDepth {
    /// What `near` and `far` count in; default `model`.
    #[rule = "What `near` and `far` count in."]
    pub space: DepthSpace = DepthSpace::Model,
    /// Where the ramp begins, -1e6..1e6; default 0.
    #[schemars(range(min = -1e6, max = 1e6))]
    #[rule = "Where the ramp begins, -1e6..1e6."]
    pub near: f32 = 0.0,
    /// Where it ends, -1e6..1e6, beyond `near`; default 1.
    #[schemars(range(min = -1e6, max = 1e6))]
    #[rule = "Where it ends, -1e6..1e6, beyond `near`."]
    pub far: f32 = 1.0,
    /// What is laid over lines on the way, up to 16 stops sorted by `at`; default none.
    #[schemars(length(max = 16))]
    #[rule = "What is laid over lines on the way; `[]` for nothing."]
    pub ramp: Vec<HueStop> = Vec::new(),
}
}

style_table! {
/// How lines change with the light on their surface. Its scale is that of tones: 0 faces away, 0.5 lies across, 1 faces
/// the light. Shadows that things throw play no part.
pub struct LineLight;

/// What a rule changes about lines in the light; what is absent stays.
pub struct RuleLineLight {
    /// What is laid over lines from dark to light, up to 16 stops sorted by `at`; default none.
    #[schemars(length(max = 16))]
    #[rule = "What is laid over lines from dark to light; `[]` for nothing."]
    pub ramp: Vec<HueStop> = Vec::new(),
    /// Factor on the width in the dark and in full light, 0..4 each; default `[1, 1]`. `[1.2, 0.5]` thins lines in
    /// the sun.
    #[schemars(inner(range(min = 0.0, max = 4.0)))]
    #[rule = "Factor on the width in the dark and in full light, 0..4 each."]
    pub width: [f32; 2] = [1.0; 2],
    /// Factor on the opacity in the dark and in full light, 0..1 each; default `[1, 1]`. `[1, 0]` lets light wash
    /// lines away.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    #[rule = "Factor on the opacity in the dark and in full light, 0..1 each."]
    pub opacity: [f32; 2] = [1.0; 2],
    /// How much lines take the colour of the light behind where it lights them, 0..1; default 0. That light is
    /// `highlight.back`, whether or not it brightens surfaces too.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[rule = "How much lines take the colour of the light behind, 0..1."]
    pub rim: f32 = 0.0,
}
}

style_table! {
/// Where the colour of lines comes from, for every method.
///
/// First the colour itself: of the kind, else of `source`. Then what lies over it, in this order: light, the light
/// behind, depth, tint.
pub struct LinePaint;

/// What a rule changes about the colour of lines; what is absent stays.
pub struct RulePaint {
    /// Where the colour of all others comes from; default `constant`.
    #[rule = "Where the colour of its other lines comes from."]
    pub source: LineColorSource = LineColorSource::Constant,
    /// What a surface's, vertex's or picture's colour is multiplied by, in linear light, 0..4; default 0.2.
    /// 0.05 nearly black, 0.2 a deep shade of the fill, 1 the fill itself.
    #[schemars(range(min = 0.0, max = 4.0))]
    #[rule = "What its colour is multiplied by, in linear light, 0..4."]
    pub factor: f32 = 0.2,
    /// Picture for source `texture`; default none.
    #[rule = "Its picture for source `texture`."]
    pub image: String = String::new(),
    /// Laid over all lines at last; alpha is how much. Default `#0000`, nothing.
    #[rule = "Laid over all of its lines; `#0000` for nothing."]
    pub tint: Color = Color::rgba(0, 0, 0, 0),
}
with {
    /// Colours for single kinds; they go before `source`. Default none.
    #[rule = "Colours for single kinds of its lines."]
    pub kinds: KindColors or KindColors,
    /// How colour changes with depth.
    #[rule = "How the colour of its lines changes with depth."]
    pub depth: LineDepth or RuleLineDepth,
    /// How colour, opacity and width change with light.
    #[rule = "How its lines change with light."]
    pub light: LineLight or RuleLineLight,
}
}

impl LinePaint {
    /// The bits of [`Part::line_flags`].
    pub fn flags(&self) -> u32 {
        let bit = |bit: u32, when: bool| if when { bit } else { 0 };
        let (light, depth) = (&self.light, &self.depth);
        self.kinds.set().bits()
            | match self.source {
                LineColorSource::Constant => 0,
                LineColorSource::Surface => Part::LINE_SURFACE,
                LineColorSource::VertexColor => Part::LINE_VERTEX,
                LineColorSource::Texture => Part::LINE_TEXTURE,
            }
            | bit(Part::LINE_DEPTH, !depth.ramp.is_empty())
            | bit(
                Part::LINE_FROM_MIDDLE,
                !depth.ramp.is_empty() && depth.space == DepthSpace::Model,
            )
            | bit(Part::LINE_LIGHT, !light.ramp.is_empty())
            | bit(Part::LINE_OPACITY, light.opacity != [1.0; 2])
            | bit(Part::LINE_WIDTH, light.width != [1.0; 2])
            | bit(Part::LINE_RIM, light.rim > 0.0)
            | bit(Part::LINE_TINT, self.tint.a > 0)
    }

    /// Writes the settings into a part, except for ramps and picture, whose values depend on where they are stored.
    ///
    /// `part` must have its `line_color` and `base_color`. `opacity` is that of the style, `radius` that of the sphere
    /// around the model.
    pub fn give_to(&self, part: &mut Part, opacity: f32, radius: f32) {
        let LineDepth { near, far, .. } = self.depth;
        let kind = |color: Option<Color>| {
            let [r, g, b, a] = color.map_or([0.0; 4], Color::srgb);
            pack_rgba8([r, g, b, a * opacity])
        };
        part.line_flags = self.flags();
        part.line_kinds = self.kinds.in_order().map(kind);
        part.line_factor = self.factor;
        let [start, end] = self.depth.space.counted([near, far], radius);
        part.line_depth = [start, 1.0 / (end - start).max(1e-20)];
        part.line_opacity = self.light.opacity;
        part.line_width = self.light.width;
        part.line_tint = pack_rgba8(self.tint.srgb());
        part.line_rim = self.light.rim;
        if self.source != LineColorSource::Constant {
            // This colour is for the few places where the surface is not known.
            let [r, g, b, _] = part.base_color;
            let [r, g, b] = [r, g, b].map(|light| srgb_from_linear(light * self.factor));
            part.line_color = [r, g, b, part.line_color[3]];
        }
    }

    /// Checks everything that involves more than one value.
    pub(crate) fn check(&self, key: &str) -> Result<(), StyleError> {
        // Refuse stops out of order.
        for (name, ramp) in [("depth", &self.depth.ramp), ("light", &self.light.ramp)] {
            let key = format!("{key}.{name}.ramp");
            check_order(&key, ramp.iter().map(|stop| stop.at))?;
        }

        // Refuse a ramp over depth that ends before it begins.
        if self.depth.far <= self.depth.near {
            return Err(StyleError::unfit(
                format!("{key}.depth.far"),
                "has to lie beyond near",
            ));
        }

        // Refuse a texture as the source without a picture.
        if self.source == LineColorSource::Texture && self.image.is_empty() {
            return Err(StyleError::unfit(
                format!("{key}.source"),
                format!("is texture, but {key}.image names no picture"),
            ));
        }
        Ok(())
    }
}

/// A ramp of stops as a row of [`HUES`] sRGB colours with straight alpha, for the texture store.
///
/// Between stops colours mix in OKLab with premultiplied alpha; before the first and after the last they stay. Empty
/// stops give a clear row. O([`HUES`] * stops).
pub fn hue_row(stops: &[HueStop]) -> Vec<u8> {
    let place = |i: usize| i as f32 / (HUES - 1) as f32;
    (0..HUES)
        .flat_map(|i| hue_at(stops, place(i)).map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8))
        .collect()
}

fn hue_at(stops: &[HueStop], x: f32) -> [f32; 4] {
    let next = stops.partition_point(|stop| stop.at <= x);
    let (Some(below), above) = (stops.get(next.saturating_sub(1)), stops.get(next)) else {
        return [0.0; 4];
    };
    let Some(above) = above.filter(|_| next > 0) else {
        return below.color.srgb();
    };
    let t = (x - below.at) / (above.at - below.at);
    let [a, b] =
        [below, above].map(|stop| AlphaColor::<Srgb>::new(stop.color.srgb()).convert::<Oklab>());
    if t <= 0.0 {
        return below.color.srgb();
    }
    let mixed = a.lerp(b, t, HueDirection::default());
    mixed.convert::<Srgb>().components
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;
    use npr_core::line_kind::KindSet;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<Style, StyleError> {
        Style::from_toml(text, &|_| Err(String::new()))
    }

    #[test]
    fn a_style_without_paint_sets_no_flag() {
        assert_eq!(LinePaint::default().flags(), 0);
        assert!(Style::default().line_paint_notices().is_empty());
    }

    #[test]
    fn rules_change_what_they_state_in_order() {
        let style = read(
            "line.paint = { source = 'surface', factor = 0.3, kinds = { crease = '#fff' } }\n\
             [[rule]]\nline.paint.factor = 0.5\nline.paint.kinds.boundary = '#f00'\n\
             [[rule]]\nmatch.object = 'B'\nline.paint.source = 'constant'\n\
             line.paint.depth.ramp = [{ at = 0, color = '#123' }]",
        )
        .unwrap();
        let a = style.resolve_for("", "A").line_paint;
        assert_eq!((a.source, a.factor), (LineColorSource::Surface, 0.5));
        assert_eq!(
            a.flags(),
            Part::LINE_SURFACE | KindSet::BOUNDARY | KindSet::CREASE,
            "a boundary and a crease have colours"
        );
        let b = style.resolve_for("", "B").line_paint;
        assert_eq!(
            b.flags(),
            KindSet::BOUNDARY | KindSet::CREASE | Part::LINE_DEPTH | Part::LINE_FROM_MIDDLE
        );
    }

    #[test]
    fn what_contradicts_itself_is_named() {
        let fault = |text: &str| read(text).unwrap_err().to_string();
        assert!(fault("line.paint.source = 'texture'").contains("line.paint.source"));
        assert!(fault("line.paint.depth = { near = 2, far = 1 }").contains("line.paint.depth.far"));
        let text = "[[rule]]\nline.paint.light.ramp = [{ at = 0.5, color = '#fff' }, { at = 0.2, color = '#000' }]";
        assert!(fault(text).contains("rule.0.line.paint.light.ramp.1.at"));
        assert!(fault("line.paint.light.width = [1, 9]").contains("line.paint.light.width"));
    }

    #[test]
    fn what_a_method_cannot_do_is_said_once() {
        let style = read("line.method = 'filter'\nline.paint.light.width = [1, 0]").unwrap();
        assert_eq!(style.line_paint_notices().len(), 1);
        let style = read("line.paint.light.width = [1, 0]").unwrap();
        assert!(style.line_paint_notices().is_empty());
    }

    #[test]
    fn a_row_begins_and_ends_with_its_stops() {
        let stop = |at, color: &str| HueStop {
            at,
            color: color.parse().unwrap(),
        };
        let row = hue_row(&[stop(0.25, "#10203040"), stop(0.75, "#ff8000ff")]);
        assert_eq!(row.len(), 4 * HUES);
        assert_eq!(row[..4], [0x10, 0x20, 0x30, 0x40]);
        assert_eq!(row[4 * HUES - 4..], [0xff, 0x80, 0, 0xff]);
        assert_eq!(hue_row(&[]), [0; 4 * HUES]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        /// Alpha, and colour as far as it shows, never jump between neighbours where stops lie apart.
        #[test]
        fn rows_are_continuous(colors in prop::collection::vec(any::<[u8; 4]>(), 1..6)) {
            let count = colors.len();
            let stops: Vec<HueStop> = colors.iter().enumerate().map(|(i, [r, g, b, a])| HueStop {
                at: i as f32 / count as f32,
                color: Color::rgba(*r, *g, *b, *a),
            }).collect();
            let row = hue_row(&stops);
            let shown: Vec<[f32; 4]> = row.chunks_exact(4).map(|c| {
                let a = f32::from(c[3]) / 255.0;
                [f32::from(c[0]) * a, f32::from(c[1]) * a, f32::from(c[2]) * a, f32::from(c[3])]
            }).collect();
            // 256 places over at most 6 pieces; the sRGB curve is up to 12.92 times as steep as light.
            for pair in shown.windows(2) {
                for i in 0..4 {
                    prop_assert!((pair[0][i] - pair[1][i]).abs() < 40.0, "{:?}", pair);
                }
            }
        }

        /// Stops at any positions give colours, even where several coincide.
        #[test]
        fn any_stops_give_a_row(mut stops in prop::collection::vec((0f32..=1.0, any::<[u8; 4]>()), 0..HUE_STOPS_MAX)) {
            stops.sort_by(|a, b| a.0.total_cmp(&b.0));
            let stops: Vec<HueStop> = stops.into_iter().map(|(at, [r, g, b, a])| HueStop {
                at: (at * 4.0).round() / 4.0,
                color: Color::rgba(r, g, b, a),
            }).collect();
            prop_assert_eq!(hue_row(&stops).len(), 4 * HUES);
        }
    }
}
