//! The table `light` of a style: a main light, more of several kinds, and those of the file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Color, StyleError};

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

/// The main light, infinitely far away, and what shines beside it.
///
/// Every light adds to the place on the ramp, so the intensities of lights that meet should come to about 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Light {
    /// Towards the light, of any length but 0; default `[-0.5, 0.7, 0.6]`, above the viewer's left shoulder.
    /// A larger z lights more of what is seen; z below 0 leaves little but rims.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub direction: [f32; 3],
    /// What the direction is fixed to; default `camera`.
    pub space: LightSpace,
    /// What the main light adds to the ramp where it is faced, 0..10; default 1, the whole ramp. 0.5 leaves room for
    /// others beside it, 0 turns it off.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub intensity: f32,
    /// Colour of the main light; default white, which leaves tones as they are.
    pub color: Color,
    /// Whether things throw shadows in the main light and in the file's lights; default false. Turn on for scenes that
    /// stand on something, off for single figures with busy faces.
    pub shadow: bool,
    /// Place on the ramp, 0..1, that a light cannot lift a place in its shadow above; default 0.15. 0 the deepest tone,
    /// 0.4 only a hint.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub shadow_at: f32,
    /// Whether the lights of the file shine in place of the main light; default false. A file without lights keeps
    /// the main one.
    pub file: bool,
    /// More lights, at most 15; default none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 15))]
    pub extra: Vec<ExtraLight>,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            direction: [-0.5, 0.7, 0.6],
            space: LightSpace::Camera,
            intensity: 1.0,
            color: Color::WHITE,
            shadow: false,
            shadow_at: 0.15,
            file: false,
            extra: Vec::new(),
        }
    }
}

/// Shape of a light.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum LightShape {
    /// Parallel rays from one direction: a sun, a second main light.
    Distant,
    /// Rays to all sides from one place: a lamp, a flash. Throws shadows of smoke on smoke, and no others; where it
    /// stands amid the smoke, on the side of the smoke's middle.
    #[default]
    Point,
    /// Rays from one place into a cone: a torch, a stage light.
    Spot,
    /// Light from everywhere: the sky's from above, the ground's from below, or that of a picture. Fills what others
    /// leave dark, and makes no highlights.
    Sky,
}

/// A light beside the main one, fixed in the scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ExtraLight {
    /// Its shape; default `point`.
    pub kind: LightShape,
    /// Where it stands, in units of the scene, -1e9..1e9; default the origin. For `point` and `spot`.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub position: [f32; 3],
    /// Towards where its light comes from, in the scene, of any length but 0; default `[0, 1, 0]`, from above. A `spot`
    /// shines the other way; a `point` has none; of a `sky` it is the middle of the upper half.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub direction: [f32; 3],
    /// What it adds to the ramp where it is faced, 0..10; default 0.5. 0.2 a fill light, 1 a lamp that outshines the
    /// main light.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub intensity: f32,
    /// Colour of its light; default white.
    pub color: Color,
    /// Colour of the light from below, for `sky`; default a dim earth, `#6b6259`. Its brightness is its strength:
    /// black gives none, snow is nearly white.
    pub ground: Color,
    /// A picture of the whole sky and ground, for `sky`, whose light replaces both colours; default none. Twice as
    /// wide as high, straight up in its first row, with the middle towards -z. Its details do not show: surfaces take
    /// the mean of the half that they face. One light may have one.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub image: String,
    /// Distance at which it has faded to nothing, in units of the scene, 0..1e9; default 0, it never fades. For
    /// `point` and `spot`.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub range: f32,
    /// Angle from the axis of a `spot` up to which it is full, in degrees, 0..85; default 20.
    #[schemars(range(min = 0.0, max = 85.0))]
    pub inner_deg: f32,
    /// Angle from the axis of a `spot` at which it ends, in degrees, 0..85, not below `inner_deg`; default 30. Equal
    /// to it for a cut-out edge.
    #[schemars(range(min = 0.0, max = 85.0))]
    pub outer_deg: f32,
    /// Whether things throw shadows in it; default false. Of all lights of a picture the first four throw shadows. In
    /// a `sky` they hide what of it stands behind them: rooms darken inwards, and so does the ground beneath things.
    /// One sky may have that.
    pub shadow: bool,
}

impl Default for ExtraLight {
    fn default() -> Self {
        Self {
            kind: LightShape::Point,
            position: [0.0; 3],
            direction: [0.0, 1.0, 0.0],
            intensity: 0.5,
            color: Color::WHITE,
            ground: Color::rgb(0x6b, 0x62, 0x59),
            image: String::new(),
            range: 0.0,
            inner_deg: 20.0,
            outer_deg: 30.0,
            shadow: false,
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

    /// Checks that every light points somewhere and that no cone is inside out.
    pub(crate) fn sanity_check(&self) -> Result<(), StyleError> {
        if normalized(self.direction).is_none() {
            return Err(StyleError::unfit("light.direction", "points nowhere"));
        }
        for (i, extra) in self.extra.iter().enumerate() {
            if extra.kind != LightShape::Point && normalized(extra.direction).is_none() {
                let key = format!("light.extra.{i}.direction");
                return Err(StyleError::unfit(key, "points nowhere"));
            }
            if extra.inner_deg > extra.outer_deg {
                let key = format!("light.extra.{i}.inner_deg");
                return Err(StyleError::unfit(key, "is wider than outer_deg"));
            }
        }
        self.check_skies()
    }
}

impl Light {
    /// Checks that one sky at most is hidden by the scene, and that one at most has a picture.
    fn check_skies(&self) -> Result<(), StyleError> {
        // Refuse a second sky that the scene hides.
        let skies = || {
            let extra = self.extra.iter().enumerate();
            extra.filter(|(_, light)| light.kind == LightShape::Sky)
        };
        if let Some((i, _)) = skies().filter(|(_, sky)| sky.shadow).nth(1) {
            let key = format!("light.extra.{i}.shadow");
            return Err(StyleError::unfit(
                key,
                "is on in a second sky, but may be in one",
            ));
        }

        // Refuse a second picture of a sky.
        if let Some((i, _)) = skies().filter(|(_, sky)| !sky.image.is_empty()).nth(1) {
            let key = format!("light.extra.{i}.image");
            return Err(StyleError::unfit(
                key,
                "is the second picture of a sky, but there may be one",
            ));
        }
        Ok(())
    }

    /// The first sky with an intensity above 0 that the scene may hide, if there is one.
    pub fn hidden_sky(&self) -> Option<&ExtraLight> {
        let mut extra = self.extra.iter();
        extra.find(|light| light.kind == LightShape::Sky && light.shadow && light.intensity > 0.0)
    }

    /// The picture name of the first sky that has one and an intensity above 0; empty where there is none.
    pub fn sky_image(&self) -> &str {
        let mut extra = self.extra.iter();
        let is_sky = |light: &&ExtraLight| light.kind == LightShape::Sky && light.intensity > 0.0;
        let found = extra.find(|light| is_sky(light) && !light.image.is_empty());
        found.map_or("", |light| light.image.as_str())
    }
}

impl ExtraLight {
    /// The direction with length 1, or up where there is none to normalise.
    pub fn unit_direction(&self) -> [f32; 3] {
        normalized(self.direction).unwrap_or([0.0, 1.0, 0.0])
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

    fn fault_of(text: &str) -> String {
        let none = |_: &str| Err(String::new());
        crate::Style::from_toml(text, &none)
            .expect_err("a fault")
            .to_string()
    }

    #[test]
    fn lights_that_make_no_sense_are_refused_by_name() {
        for (text, key, fault) in [
            (
                "light.direction = [0, 0, 0]",
                "light.direction",
                "points nowhere",
            ),
            (
                "[[light.extra]]\nkind = 'spot'\ndirection = [0.0, 0.0, 0.0]",
                "light.extra.0.direction",
                "points nowhere",
            ),
            (
                "[[light.extra]]\nkind = 'spot'\ninner_deg = 40",
                "light.extra.0.inner_deg",
                "is wider than outer_deg",
            ),
            (
                "[[light.extra]]\nintensity = nan",
                "light.extra.0.intensity",
                "is NaN, but must lie in 0..10",
            ),
            (
                "[[light.extra]]\nkind = 'sky'\nshadow = true\n[[light.extra]]\nkind = 'sky'\nshadow = true",
                "light.extra.1.shadow",
                "is on in a second sky, but may be in one",
            ),
            (
                "[[light.extra]]\nkind = 'sky'\nimage = 'a.png'\n[[light.extra]]\nkind = 'sky'\nimage = 'b.png'",
                "light.extra.1.image",
                "is the second picture of a sky, but there may be one",
            ),
            (
                "[[light.extra]]\nkind = 'laser'",
                "light.extra.0.kind",
                "is 'laser', but must be one of distant, point, spot, sky",
            ),
        ] {
            let reported = fault_of(text);
            assert!(
                reported.starts_with(key) && reported.ends_with(fault),
                "{reported}"
            );
        }
    }

    #[test]
    fn a_flood_of_lights_is_refused() {
        let fault = fault_of(&"[[light.extra]]\n".repeat(500));
        assert!(
            fault.contains("has 500 entries, but must have 0 to 15"),
            "{fault}"
        );
    }

    #[test]
    fn a_point_light_needs_no_direction() {
        let none = |_: &str| Err(String::new());
        let text = "[[light.extra]]\nposition = [1, 2, 3]\ndirection = [0, 0, 0]";
        let style = crate::Style::from_toml(text, &none).expect("a style");
        let written = style.to_toml().expect("TOML");
        assert_eq!(crate::Style::from_toml(&written, &none), Ok(style));
    }
}
