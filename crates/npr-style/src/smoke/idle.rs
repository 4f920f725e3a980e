//! Keys of smoke that cannot act beside others.

use super::{SmokeLines, SmokeMethod, SmokeParticles, SmokeStyle};
use std::fmt;
use toml::{Table, Value};

/// What smoke is drawn as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SmokeOutput {
    /// Pictures, pixel by pixel.
    Frame,
    /// Curves.
    Lines,
}

/// Keys of the table `smoke` that do nothing, and the key whose value is the reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IdleKeys {
    /// Whole keys, such as `smoke.sigma`.
    pub keys: Vec<&'static str>,
    /// What stands against them, a whole sentence.
    pub reason: &'static str,
}

impl fmt::Display for IdleKeys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let does = if self.keys.len() == 1 { "does" } else { "do" };
        write!(
            f,
            "{} {does} nothing: {}",
            self.keys.join(", "),
            self.reason
        )
    }
}

/// Lengths and shares of drawn outlines.
const DRAWN_LINE: [&str; 4] = [
    "smoke.line.width",
    "smoke.line.inner",
    "smoke.line.jump",
    "smoke.line.swell",
];

impl SmokeStyle {
    /// The keys that cannot act with the methods that this style chooses, whatever their values, by reason.
    pub fn idle_keys(&self, output: SmokeOutput) -> Vec<IdleKeys> {
        let mut idle = vec![self.idle_of_particles()];
        match output {
            SmokeOutput::Frame => idle.extend([self.idle_of_method(), self.idle_of_line()]),
            SmokeOutput::Lines => idle.push(IdleKeys {
                keys: vec!["smoke.line.weight"],
                reason: "drawings have outlines of a width, not the published ones",
            }),
        }
        idle.retain(|idle| !idle.keys.is_empty());
        idle
    }

    /// Those of them that have another value than usual, so that a user may wonder.
    pub fn idle_notices(&self, output: SmokeOutput) -> Vec<String> {
        let mut idle = self.idle_keys(output);
        for idle in &mut idle {
            idle.keys.retain(|key| !self.has_usual(key));
        }
        let told = idle.iter().filter(|idle| !idle.keys.is_empty());
        told.map(ToString::to_string).collect()
    }

    fn idle_of_particles(&self) -> IdleKeys {
        match self.particles {
            SmokeParticles::Published => IdleKeys {
                keys: vec![
                    "smoke.puffs.detail",
                    "smoke.puffs.scale",
                    "smoke.puffs.ease",
                    "smoke.puffs.placement",
                ],
                reason: "smoke.particles is published",
            },
            SmokeParticles::Cover => IdleKeys {
                keys: vec!["smoke.puffs.still"],
                reason: "smoke.particles is cover",
            },
        }
    }

    /// Billboards are lit by nothing: their tone is full light, or heat, and smoothing finds nothing to smooth.
    fn idle_of_method(&self) -> IdleKeys {
        let mut keys = Vec::new();
        if self.method == SmokeMethod::Billboards {
            keys.extend(["smoke.wrap", "smoke.ambient", "smoke.shadow", "smoke.light"]);
            if self.heat == 0.0 {
                keys.extend([
                    "smoke.sigma",
                    "smoke.layers",
                    "smoke.layer_depth",
                    "smoke.layer_blend",
                ]);
            }
        }
        IdleKeys {
            keys,
            reason: "smoke.method is billboards",
        }
    }

    fn idle_of_line(&self) -> IdleKeys {
        let drawn = DRAWN_LINE.to_vec();
        let (keys, reason) = match (self.method, self.line.method) {
            (_, SmokeLines::Off) => (
                [drawn, vec!["smoke.line.weight", "smoke.line.color"]].concat(),
                "smoke.line.method is off",
            ),
            (SmokeMethod::Billboards, _) => (drawn, "smoke.method is billboards"),
            (_, SmokeLines::Published) => (drawn, "smoke.line.method is published"),
            (_, SmokeLines::Drawn) => (vec!["smoke.line.weight"], "smoke.line.method is drawn"),
        };
        IdleKeys { keys, reason }
    }

    /// Whether a key has the value that it has in a style that does not name it.
    fn has_usual(&self, key: &str) -> bool {
        self.value_of(key) == Self::default().value_of(key)
    }

    /// The value of a whole key of the table `smoke`.
    fn value_of(&self, key: &str) -> Option<Value> {
        let mut names = key.split('.').skip(1);
        let table = Table::try_from(self).ok()?;
        let first = table.get(names.next()?)?;
        let value = names.try_fold(first, |value, name| value.get(name));
        value.cloned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;

    fn smoke(settings: &[&str]) -> SmokeStyle {
        let mut style = Style::default();
        for setting in settings {
            style.set(setting).expect("a setting");
        }
        style.smoke
    }

    #[test]
    fn what_cannot_act_is_named_with_the_reason_where_it_was_changed() {
        let told = |settings: &[&str], output| smoke(settings).idle_notices(output);
        let nothing: [&str; 0] = [];
        assert_eq!(told(&[], SmokeOutput::Frame), nothing);
        assert_eq!(
            told(&["smoke.method=billboards"], SmokeOutput::Frame),
            nothing
        );
        let changed = [
            "smoke.method=billboards",
            "smoke.sigma=3px",
            "smoke.shadow=false",
            "smoke.light=[0,1,0]",
            "smoke.line.width=9",
        ];
        assert_eq!(
            told(&changed, SmokeOutput::Frame),
            [
                "smoke.shadow, smoke.light, smoke.sigma do nothing: smoke.method is billboards",
                "smoke.line.width does nothing: smoke.method is billboards",
            ]
        );
        let published = ["smoke.particles=published", "smoke.puffs.ease=0.5"];
        for output in [SmokeOutput::Frame, SmokeOutput::Lines] {
            assert_eq!(
                told(&published, output),
                ["smoke.puffs.ease does nothing: smoke.particles is published"]
            );
        }
        assert_eq!(
            told(&["smoke.line.weight=7"], SmokeOutput::Lines),
            [
                "smoke.line.weight does nothing: drawings have outlines of a width, not the published ones"
            ]
        );
    }

    #[test]
    fn heat_is_smoothed_on_billboards_too() {
        let heated = ["smoke.method=billboards", "smoke.heat=1", "smoke.sigma=3px"];
        assert!(smoke(&heated).idle_notices(SmokeOutput::Frame).is_empty());
    }

    /// A slip in a name would be told never, or always.
    #[test]
    fn every_key_named_is_one() {
        let styles = ["spheres", "billboards"].into_iter().flat_map(|method| {
            let lines = ["drawn", "published", "off"].into_iter();
            lines.flat_map(move |line| {
                let particles = ["cover", "published"].into_iter();
                particles.map(move |particles| [method, line, particles])
            })
        });
        for [method, line, particles] in styles {
            let style = smoke(&[
                &format!("smoke.method={method}"),
                &format!("smoke.line.method={line}"),
                &format!("smoke.particles={particles}"),
                "smoke.light=[0,1,0]",
            ]);
            for output in [SmokeOutput::Frame, SmokeOutput::Lines] {
                for key in style.idle_keys(output).iter().flat_map(|idle| &idle.keys) {
                    assert!(style.value_of(key).is_some(), "{key}");
                }
            }
        }
    }

    #[test]
    fn presets_say_nothing() {
        for preset in crate::presets() {
            let style = Style::preset(preset.name).expect("a preset");
            for output in [SmokeOutput::Frame, SmokeOutput::Lines] {
                assert!(
                    style.smoke.idle_notices(output).is_empty(),
                    "{}",
                    preset.name
                );
            }
        }
    }
}
