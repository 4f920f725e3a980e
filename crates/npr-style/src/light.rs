//! The one light that tones are drawn by.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a light's direction is fixed to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LightSpace {
    /// The scene: shade stays on the same side of a thing while the camera turns around it.
    World,
    /// The camera: every view is lit alike. x points right, y up and z from the scene to the eye.
    #[default]
    Camera,
}

/// A light infinitely far away.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// Towards the light, of any length but 0; default `[-0.5, 0.7, 0.6]`, above the viewer's left shoulder.
    /// A larger z lights more of what is seen; z below 0 leaves little but rims.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub direction: [f32; 3],
    /// What the direction is fixed to; default `camera`.
    pub space: LightSpace,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            direction: [-0.5, 0.7, 0.6],
            space: LightSpace::Camera,
        }
    }
}

impl Light {
    /// The direction with length 1, or the default one where there is none to normalise.
    pub fn unit_direction(&self) -> [f32; 3] {
        normalized(self.direction)
            .or_else(|| normalized(Self::default().direction))
            .unwrap_or([0.0, 0.0, 1.0])
    }

    /// Whether the direction points anywhere.
    pub(crate) fn has_direction(&self) -> bool {
        normalized(self.direction).is_some()
    }
}

/// `v` with length 1; none where it is zero or not finite. Scales first, so that no square overflows.
fn normalized(v: [f32; 3]) -> Option<[f32; 3]> {
    let largest = v.iter().fold(0.0f32, |most, part| most.max(part.abs()));
    if !(largest > 0.0 && v.iter().all(|part| part.is_finite())) {
        return None;
    }
    let scaled = v.map(|part| part / largest);
    let length = scaled.iter().map(|part| part * part).sum::<f32>().sqrt();
    Some(scaled.map(|part| part / length))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_direction_becomes_a_unit_vector(direction in prop::array::uniform3(prop::num::f32::ANY)) {
            let light = Light { direction, ..Light::default() };
            let length = light.unit_direction().iter().map(|part| part * part).sum::<f32>().sqrt();
            prop_assert!((length - 1.0).abs() < 1e-5, "{length}");
        }
    }

    #[test]
    fn no_direction_is_noticed() {
        assert!(
            !Light {
                direction: [0.0; 3],
                ..Light::default()
            }
            .has_direction()
        );
        assert!(Light::default().has_direction());
    }
}
