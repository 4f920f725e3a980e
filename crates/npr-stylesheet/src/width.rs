//! Line width: a base length times a factor that something on the surface decides.
//!
//! Every source gives a share `s` of 0..1; `factor = min + (max - min) * s`; the line reaches
//! `base * factor / 2` to either side. What "share" means is up to the source, as the published
//! method leaves the formula free [Okuya et al. 2016, section 3.2].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::overlay::{rule_table, style_table};
use crate::{DepthSpace, Length, RuleTaper, Taper};

/// What decides a line's width along the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WidthSource {
    /// Nothing: every line has the full factor, `max`.
    Constant,
    /// Curvature of the surface: tight bends swell wherever the camera stands.
    #[default]
    Curvature,
    /// Curvature of the line as seen: tips and turns swell, long flat runs thin out, and between ribs and folds there
    /// is room.
    ProjectedCurvature,
    /// A channel of the vertex colours, as painted in the modelling tool.
    VertexColor,
    /// A grey image over the surface's texture coordinates.
    Texture,
    /// Points placed in the scene that swell or thin the lines around them.
    ControlPoints,
}

/// A channel of a vertex colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Channel {
    /// Red.
    #[default]
    R,
    /// Green.
    G,
    /// Blue.
    B,
    /// Alpha.
    A,
}

impl Channel {
    /// Index of the channel in an RGBA colour, 0..3.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A place that swells or thins the lines around it [Matsuo 2011].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ControlPoint {
    /// Where it lies, in units of the scene, -1e9..1e9.
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub position: [f32; 3],
    /// How far it reaches, in units of the scene, 0..1e9. Its pull fades to nothing there.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub radius: f32,
    /// The width factor at its centre, 0..10: 0 lifts the pen, 3 presses it down.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub factor: f32,
}

/// A factor on the width of strokes, and its place on a curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WidthStop {
    /// Its place, 0..1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f32,
    /// What the width is multiplied by there, 0..10: 0 lifts the pen, 2 presses it down.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub factor: f32,
}

style_table! {
/// How the width of strokes changes with depth.
pub struct WidthDepth {
    /// What `near` and `far` count in; default `model`.
    pub space: DepthSpace = DepthSpace::Model,
    /// Where the curve begins, -1e6..1e6; default 0.
    #[schemars(range(min = -1e6, max = 1e6))]
    pub near: f32 = 0.0,
    /// Where it ends, -1e6..1e6, beyond `near`; default 1.
    #[schemars(range(min = -1e6, max = 1e6))]
    pub far: f32 = 1.0,
    /// Factors from near to far, up to 16 sorted by `at`; default none, even at all depths.
    #[schemars(length(max = 16))]
    pub curve: Vec<WidthStop> = Vec::new(),
}
}

/// How wide lines are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Width {
    /// Width where the factor is 1; default 3. 1 a technical pen, 3 a comic nib, 8 a marker.
    pub base: Length,
    /// What varies the width; default `curvature`.
    pub source: WidthSource,
    /// Factor where the source gives nothing, 0..10; default 0.5. 0 lets lines run out to a hair.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub min: f32,
    /// Factor where the source gives all, 0..10, not below `min`; default 1.5. 1.2 calm, 3 a loaded brush.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub max: f32,
    /// How soon curvature swells a line, 0..10; default 0.5. 0.1 only at tips, 5 nearly everywhere.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub gain: f32,
    /// Channel that source `vertex-color` reads; default `r`.
    pub channel: Channel,
    /// Path of the grey image that source `texture` reads; default none. Black is `min`, white `max`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
    /// Points that source `control-points` reads, at most 64; default none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 64))]
    pub control_points: Vec<ControlPoint>,
    /// Length under which a line that meets no other thins out; half as long it is gone; default 0, which draws all. 12
    /// clears scans of specks, 40 keeps long lines alone.
    pub short: Length,
    /// Share of the way to a line beside it that ink may take, 0..1; default 0.6. 0 leaves widths alone, 0.4 keeps
    /// springs and railings airy. Of methods `strokes` and `potrace` and of drawings as curves, by points of
    /// smoothed lines; not with `line.visibility` sampled.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub room: f32,
    /// How lines thin out towards their ends.
    pub taper: Taper,
    /// Factors along strokes, from their start to their end, up to 16 sorted by `at`, joined by a smooth curve; default
    /// none, even. Rings have no start, and keep their width.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 16))]
    pub pressure: Vec<WidthStop>,
    /// How width changes with depth.
    pub depth: WidthDepth,
}

rule_table! {
/// What a rule changes about the width of strokes; what is absent stays.
pub struct RuleWidth over Width {
    /// Factors along strokes, from their start to their end, up to 16 sorted by `at`; [] for even strokes after all.
    #[schemars(length(max = 16))]
    pub pressure: Vec<WidthStop>,
}
with {
    /// How lines thin out towards their ends.
    pub taper: RuleTaper,
}
}

impl Default for Width {
    fn default() -> Self {
        Self {
            base: Length::ref_px(3.0),
            source: WidthSource::Curvature,
            min: 0.5,
            max: 1.5,
            gain: 0.5,
            channel: Channel::R,
            texture: None,
            control_points: Vec::new(),
            short: Length::ref_px(0.0),
            room: 0.6,
            taper: Taper::default(),
            pressure: Vec::new(),
            depth: WidthDepth::default(),
        }
    }
}

impl Width {
    /// The name of the picture that widths come from; `None` where their source is another one.
    pub fn picture(&self) -> Option<&str> {
        let is_source = self.source == WidthSource::Texture;
        self.texture.as_deref().filter(|_| is_source)
    }

    /// The width factor that the control points give at `position`, kept within `min..max`.
    pub fn factor_at(&self, position: [f32; 3]) -> f32 {
        control_factor(&self.control_points, position)
            .max(self.min)
            .min(self.max)
    }
}

/// The width factor that `points` give at `position`, both in units of the scene.
///
/// A blend of the points' factors and of 1, weighted by each point's pull `(1 - d^2 / r^2)^2`; what
/// the pulls leave of 1 goes to factor 1. Continuous, and 1 beyond every radius. O(points).
///
/// Differs: Matsuo 2011 places points to steer the hull's offset; the falloff here is Wyvill's.
pub fn control_factor(points: &[ControlPoint], position: [f32; 3]) -> f32 {
    let (mut pull_sum, mut factor_sum) = (0.0, 0.0);
    for point in points {
        let pull = pull(point, position);
        pull_sum += pull;
        factor_sum += pull * point.factor;
    }
    let rest = (1.0f32 - pull_sum).max(0.0);
    (factor_sum + rest) / (pull_sum + rest)
}

/// Weight of one control point at `position`: 1 at its centre, 0 from its radius on.
fn pull(point: &ControlPoint, position: [f32; 3]) -> f32 {
    let d2: f32 = (0..3)
        .map(|i| (position[i] - point.position[i]) * (position[i] - point.position[i]))
        .sum();
    let r2 = point.radius * point.radius;
    if d2 < r2 {
        let left = 1.0 - d2 / r2;
        left * left
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_control_point_rules_its_centre_and_nothing_beyond_its_radius() {
        let points = [ControlPoint {
            position: [0.0; 3],
            radius: 2.0,
            factor: 3.0,
        }];
        assert_eq!(control_factor(&points, [0.0; 3]), 3.0);
        assert_eq!(control_factor(&points, [2.0, 0.0, 0.0]), 1.0);
        assert_eq!(control_factor(&[], [0.0; 3]), 1.0);
    }

    fn points() -> impl Strategy<Value = Vec<ControlPoint>> {
        let point = (
            prop::array::uniform3(-2.0f32..2.0),
            0.0f32..3.0,
            0.0f32..10.0,
        )
            .prop_map(|(position, radius, factor)| ControlPoint {
                position,
                radius,
                factor,
            });
        prop::collection::vec(point, 0..8)
    }

    proptest! {
        #[test]
        fn factors_stay_within_their_bounds(
            min in 0.0f32..10.0, span in 0.0f32..5.0, points in points(),
            position in prop::array::uniform3(-3.0f32..3.0),
        ) {
            let width = Width { min, max: min + span, control_points: points, ..Width::default() };
            let factor = width.factor_at(position);
            prop_assert!(width.min <= factor && factor <= width.max, "{factor}");
        }

        #[test]
        fn the_order_of_control_points_hardly_matters(
            points in points(), position in prop::array::uniform3(-3.0f32..3.0),
        ) {
            let reversed: Vec<_> = points.iter().rev().cloned().collect();
            let difference = control_factor(&points, position) - control_factor(&reversed, position);
            prop_assert!(difference.abs() < 1e-4);
        }
    }
}
