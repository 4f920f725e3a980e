//! The table `beam` of a rule: parts that glow, in which colours, and how far their light reaches.

use npr_core::geometry::Part;
use npr_style::beam::BEAM_STOPS_MAX;
use npr_style::ramp::Level;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Color;
use crate::overlay::rule_table;

/// What a beam does to what lies behind it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BeamOverlap {
    /// Light lies over objects, and their lines over the light.
    #[default]
    Lines,
    /// Light lies over objects and their lines.
    Covers,
    /// Objects lie over the light.
    Behind,
}

/// A colour of a beam from a place of its ramp on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BeamStop {
    /// Where the colour begins, 0..1: 0 the rim, 1 the middle.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f32,
    /// The colour; alpha is how much it covers.
    pub color: Color,
}

/// The look of a part that glows instead of being a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Beam {
    /// The order in which its light lies over objects and their lines.
    pub overlap: BeamOverlap,
    /// Width of the step between two colours, as a share of the ramp, 0..1.
    pub softness: f32,
    /// Colours from the rim to the middle, 1 to 4.
    pub ramp: Vec<BeamStop>,
    /// What its light adds to the ramp of surfaces that face it, 0..10.
    pub light: f32,
    /// How far its light reaches, in half diagonals of the box around it.
    pub light_reach: f32,
}

rule_table! {
/// What a rule says about a part that glows instead of being a surface; what is absent stays as earlier rules have it.
pub struct RuleBeam over Beam {
    /// What it does to what lies behind it; default `lines`.
    pub overlap: BeamOverlap,
    /// Width of the step between two colours, 0..1; default 0.1. 0 cut paper, 0.5 a glow.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub softness: f32,
    /// Colours from the rim to the middle, 1 to 4, sorted by `at`; default a warm glow with a white heart. A single
    /// one makes a beam of one colour; a strong rim and a clear middle, glass or plasma.
    #[schemars(length(min = 1, max = 4))]
    pub ramp: Vec<BeamStop>,
    /// What the light of the beam adds to the ramp of what faces it, 0..10; default 0, it lights nothing. 0.4 a
    /// laser, 1 an explosion that outshines the main light. It shines in the beam's own colour and throws no shadows.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub light: f32,
    /// How far its light reaches, 0.1..1000; default 4. Counted in half diagonals of the box around the beam, of a
    /// long one in those of its pieces: larger flashes reach farther.
    #[schemars(range(min = 0.1, max = 1000.0))]
    pub light_reach: f32,
}
}

impl Default for Beam {
    fn default() -> Self {
        let stop = |at, color| BeamStop { at, color };
        Self {
            overlap: BeamOverlap::Lines,
            softness: 0.1,
            ramp: vec![
                stop(0.0, Color::rgba(0xff, 0x9a, 0x1f, 0x90)),
                stop(0.35, Color::rgba(0xff, 0xe0, 0x66, 0xd8)),
                stop(0.7, Color::WHITE),
            ],
            light: 0.0,
            light_reach: 4.0,
        }
    }
}

impl Beam {
    /// Turns a part of a model into this beam.
    pub fn apply_to(&self, part: &mut Part) {
        let solid = Part::OUTLINES | Part::INK | Part::HATCH | Part::HIGHLIGHTS | Part::CUTOUT;
        part.flags = part.flags & !solid
            | Part::BEAM
            | match self.overlap {
                BeamOverlap::Lines => 0,
                BeamOverlap::Covers => Part::BEAM_COVERS,
                BeamOverlap::Behind => Part::BEAM_BEHIND,
            };
        part.softness = self.softness;
        part.ramp = [[1.0, 1.0, 1.0, Level::UNUSED]; 8];
        part.beam_alpha = [0.0; 4];
        for (i, stop) in self.ramp.iter().take(BEAM_STOPS_MAX).enumerate() {
            let [r, g, b, a] = stop.color.linear();
            part.ramp[i] = [r, g, b, stop.at];
            part.beam_alpha[i] = a;
        }
    }
}

impl Beam {
    /// Colour of the light that the beam gives off, in linear light: the mean of its colours weighted by alpha, scaled
    /// so that the greatest channel is 1. White where none of the colours shows.
    pub fn light_color(&self) -> [f32; 3] {
        let sum = self.ramp.iter().fold([0.0f32; 3], |sum, stop| {
            let [r, g, b, a] = stop.color.linear();
            [sum[0] + r * a, sum[1] + g * a, sum[2] + b * a]
        });
        let most = sum[0].max(sum[1]).max(sum[2]);
        if most > 0.0 {
            sum.map(|v| v / most)
        } else {
            [1.0; 3]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_style::beam::beam_color;

    #[test]
    fn a_beam_is_its_ramp_from_rim_to_middle() {
        let beam = Beam {
            softness: 0.0,
            ..Beam::default()
        };
        let mut part = Part {
            flags: Part::LINES | Part::DOUBLE_SIDED,
            ..Part::default()
        };
        beam.apply_to(&mut part);
        assert_eq!(part.flags, Part::BEAM | Part::DOUBLE_SIDED);
        for (t, stop) in [(0.1, 0), (0.5, 1), (1.0, 2)] {
            assert_eq!(beam_color(&part, t), beam.ramp[stop].color.linear());
        }
    }

    #[test]
    fn a_beam_gives_light_of_its_own_color() {
        let of = |colors: &[Color]| {
            let stop = |color: &Color| BeamStop {
                at: 0.0,
                color: *color,
            };
            let ramp = colors.iter().map(stop).collect();
            Beam {
                ramp,
                ..Beam::default()
            }
            .light_color()
        };
        assert_eq!(of(&[Color::rgb(255, 0, 0)]), [1.0, 0.0, 0.0]);
        assert_eq!(
            of(&[Color::rgba(0, 0, 255, 0), Color::rgb(0, 128, 0)]),
            [0.0, 1.0, 0.0]
        );
        assert_eq!(of(&[Color::rgba(9, 9, 9, 0)]), [1.0; 3]);
        let [r, g, b] = Beam::default().light_color();
        assert!(r == 1.0 && g > b && b > 0.2, "a warm light: {r} {g} {b}");
    }

    #[test]
    fn a_later_rule_changes_only_what_it_states() {
        let text = "[[rule]]\nbeam = { overlap = 'covers', softness = 0.4, ramp = [{ at = 0.0, color = '#00ff00' }] }\n\
                    [[rule]]\nbeam.light = 0.7\n[[rule]]\nmatch.object = 'Small'\n\
                    beam = { light_reach = 2.0, softness = 0.0 }";
        let style = crate::Style::from_toml(text, &|_| Err(String::new())).expect("a style");
        let green = vec![BeamStop {
            at: 0.0,
            color: Color::rgb(0, 255, 0),
        }];
        let large = Beam {
            overlap: BeamOverlap::Covers,
            softness: 0.4,
            ramp: green,
            light: 0.7,
            ..Beam::default()
        };
        let small = Beam {
            softness: 0.0,
            light_reach: 2.0,
            ..large.clone()
        };
        assert_eq!(style.resolve_for("", "Large").beam, Some(large));
        assert_eq!(style.resolve_for("", "Small").beam, Some(small));
    }

    #[test]
    fn one_color_is_one_color() {
        let mut part = Part::default();
        let beam = Beam {
            ramp: vec![BeamStop {
                at: 0.4,
                color: Color::rgb(255, 0, 0),
            }],
            ..Beam::default()
        };
        beam.apply_to(&mut part);
        assert_eq!(beam_color(&part, 0.0), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(beam_color(&part, 1.0), [1.0, 0.0, 0.0, 1.0]);
    }
}
