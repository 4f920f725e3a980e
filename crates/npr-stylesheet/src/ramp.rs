//! The stops of a ramp of tones in a style.

use npr_style::ramp::Level;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Color, StyleError};

/// One tone of a ramp: from its place on, surfaces are lit this much.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stop {
    /// Where the tone begins, 0..1: 0 faces away from the light, 0.5 lies across it, 1 faces it.
    /// The first stop also covers everything before it. Raise a stop to spread the darker tone.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f32,
    /// How much of the surface's colour remains, 0..1.5: 0 solid ink, 0.6 a soft shade, 1 the colour
    /// as it is, above 1 a bleached highlight.
    #[schemars(range(min = 0.0, max = 1.5))]
    pub light: f32,
    /// Colour that the tone is multiplied by; default none. A cool tint in the shade and a warm one in the
    /// light look like day.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tint: Option<Color>,
}

impl Stop {
    /// A tone without tint.
    pub const fn plain(at: f32, light: f32) -> Self {
        Self {
            at,
            light,
            tint: None,
        }
    }

    /// The stop with its tint turned into linear light.
    pub fn level(&self) -> Level {
        let [r, g, b, _] = self.tint.unwrap_or(Color::WHITE).linear();
        Level {
            at: self.at,
            light: [r, g, b].map(|v| v * self.light),
        }
    }
}

/// Refuses places of the stops of `key` of which one lies before the one ahead of it.
pub(crate) fn check_order(
    key: &str,
    places: impl Iterator<Item = f32> + Clone,
) -> Result<(), StyleError> {
    let mut pairs = places.clone().zip(places.skip(1));
    match pairs.position(|(ahead, at)| at < ahead) {
        Some(i) => Err(StyleError::unfit(
            format!("{key}.{}.at", i + 1),
            "lies before the stop ahead of it",
        )),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tint_is_multiplied_in_linear_light() {
        let stop = Stop {
            at: 0.0,
            light: 0.5,
            tint: Some(Color::rgb(255, 0, 0)),
        };
        assert_eq!(stop.level().light, [0.5, 0.0, 0.0]);
    }
}
