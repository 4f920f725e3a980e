//! The table `blend` of a style: mixes a look with another one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{StyleError, preset};

/// How a look is blended with another one: an effect for speed and impact [Suzuki 2004, chapter 5].
///
/// Both pictures are drawn and mixed in linear light, so a blend costs what both cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Blend {
    /// How much of this look is drawn, 0..1; default 1, all of it. 0 leaves the other one alone; raise it over some
    /// frames to let a blow strike home.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub amount: f32,
    /// The preset that shows through; default `plain`, ordinary soft shading without lines. Background, lights, beams
    /// and words stay those of this look.
    pub with: String,
    /// A picture over the whole frame that says where: white this look, black the other; default empty, none. A burst
    /// of rays round the blow, a gradient across the page. `amount` counts on top.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub mask: String,
}

impl Default for Blend {
    fn default() -> Self {
        Self {
            amount: 1.0,
            with: "plain".to_owned(),
            mask: String::new(),
        }
    }
}

impl Blend {
    /// Whether the other look shows anywhere.
    pub fn shows(&self) -> bool {
        self.amount < 1.0 || !self.mask.is_empty()
    }

    /// Checks that `with` names a preset.
    pub(crate) fn sanity_check(&self) -> Result<(), StyleError> {
        match preset::find(&self.with) {
            Ok(_) => Ok(()),
            Err(error) => Err(StyleError::unfit(
                "blend.with",
                format!("is wrong: {error}"),
            )),
        }
    }
}

/// Mixes a pixel of two pictures: `share`, 0..1, of the first and the rest of the second. Colours are linear light
/// times alpha.
pub fn blend(first: [f32; 4], second: [f32; 4], share: f32) -> [f32; 4] {
    std::array::from_fn(|i| second[i] + (first[i] - second[i]) * share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<Style, StyleError> {
        Style::from_toml(text, &|_| Err(String::new()))
    }

    #[test]
    fn the_other_look_keeps_background_lights_beams_and_colors() {
        let text = "extends = 'comic-light'\nbackground = 'navy'\nblend.amount = 0.5\n\
                    light.direction = [1, 0, 0]\n[[rule]]\nmatch.object = 'A'\nline.on = false\nshade.color = 'red'";
        let style = read(text).unwrap();
        let other = style.blended_with().unwrap();
        assert_eq!(
            (&other.background, &other.light),
            (&style.background, &style.light)
        );
        assert_eq!(other.line.method, crate::OutlineMethod::Off);
        assert!(!other.blend.shows() && style.blend.shows());
        let look = other.resolve_for("Beam", "A");
        assert!(look.line_on && look.beam.is_some() && look.shade_color.is_some());
    }

    #[test]
    fn what_is_no_preset_is_no_other_look() {
        let reported = read("blend.with = 'plainn'").unwrap_err().to_string();
        assert!(
            reported.starts_with("blend.with") && reported.ends_with("did you mean 'plain'?"),
            "{reported}"
        );
        assert!(
            read("blend.amount = 2")
                .unwrap_err()
                .to_string()
                .ends_with("0..1")
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn a_blend_lies_between_both(
            first in prop::array::uniform4(0f32..1.0), second in prop::array::uniform4(0f32..1.0), share in 0f32..1.0,
        ) {
            for (i, mixed) in blend(first, second, share).into_iter().enumerate() {
                let (low, high) = (first[i].min(second[i]), first[i].max(second[i]));
                prop_assert!((low - 1e-6..=high + 1e-6).contains(&mixed));
            }
            prop_assert_eq!(blend(first, second, 0.0), second);
        }
    }
}
