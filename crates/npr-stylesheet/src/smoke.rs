//! How smoke looks: the table `smoke` of a style.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Hatch;
use crate::ink::{Ink, Mapping, Tone};
use crate::ramp::check_order;
use crate::{Color, Length, StyleError};
use npr_style::ramp::Level;
use npr_style::smoke::LAYERS_MAX;

/// What stands for a puff of smoke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SmokeMethod {
    /// Spheres in their own sizes, lit and smoothed [Hoshino 2004].
    #[default]
    Spheres,
    /// Comparison: discs of one size that face the view, unlit, lines from differences of depth [Selle 2004].
    Billboards,
}

/// How smoke is outlined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SmokeLines {
    /// Lines of a width, along the rims of spheres.
    #[default]
    Drawn,
    /// Comparison: differences of depth between diagonal neighbours, as published.
    Published,
    /// No lines.
    Off,
}

/// Which spheres stand for smoke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SmokeParticles {
    /// As few as cover it, which follow it from frame to frame without popping.
    #[default]
    Cover,
    /// Comparison: a constant number of particles, born at random in the smoke or where it comes from, dead where
    /// they rest or leave it, each as large as the smoke allows in every frame [Hoshino 2004, 3.1].
    Published,
}

/// Where new spheres are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SmokePlacement {
    /// Where much smoke is not covered yet, the deepest first.
    #[default]
    Cover,
    /// Anywhere in the smoke, as in the publication.
    Random,
}

/// The spheres that stand for smoke: how many there are, and how they follow it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmokePuffs {
    /// Most spheres of a volume, 1..1000000; default 200. 30 bold and simple, 2000 a busy eruption. Published
    /// particles are always as many.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub count: u32,
    /// Density up to which there is no smoke, 0..1e9; default 0.1. Lower shows thinner smoke.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub threshold: f32,
    /// Voxels along the longest side in which the shape of the smoke is seen, 1..1024; default 40. 20 a few bold
    /// puffs, 200 every wisp. Published particles see all voxels there are.
    #[schemars(range(min = 1, max = 1024))]
    pub detail: u32,
    /// Radius as a multiple of the way to where the smoke ends, 0.1..4; default 1.2. 1 keeps within the smoke, 1.4
    /// makes fat, overlapping puffs. Published particles have 1.
    #[schemars(range(min = 0.1, max = 4.0))]
    pub scale: f32,
    /// Greatest change of a radius in a 24th of a second, as a share of the larger one, 0.001..1; default 0.12. 0.05
    /// swells slowly, 0.3 is nervous, 1 follows at once, as published particles do.
    #[schemars(range(min = 0.001, max = 1.0))]
    pub ease: f32,
    /// Where new spheres are placed; default `cover`. Published particles are born as in the publication.
    pub placement: SmokePlacement,
    /// Speed up to which published particles rest and die, in units of the volume a second, 0..1e9; default 0, as
    /// published. Other spheres live on where smoke stands still.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub still: f32,
}

impl Default for SmokePuffs {
    fn default() -> Self {
        Self {
            count: 200,
            threshold: 0.1,
            detail: 40,
            scale: 1.2,
            ease: 0.12,
            placement: SmokePlacement::Cover,
            still: 0.0,
        }
    }
}

/// A colour of smoke from a tone on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SmokeStop {
    /// Where the colour begins, 0..1: 0 the darkest shade, 1 full light. The first stop also covers everything before
    /// it.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub at: f32,
    /// The colour itself.
    pub color: Color,
}

/// How smoke looks.
///
/// Used where a scene has smoke; styles without this table draw it in two tones under a dark line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmokeStyle {
    /// What stands for a puff; default `spheres`.
    pub method: SmokeMethod,
    /// Which spheres stand for smoke; default `cover`.
    pub particles: SmokeParticles,
    /// How many spheres there are, and how they follow the smoke.
    pub puffs: SmokePuffs,
    /// The tones, 1 to 8, sorted by `at`; default two, blue-grey shade and white. Three make rounder puffs, six a
    /// painting.
    #[schemars(length(min = 1, max = 8))]
    pub ramp: Vec<SmokeStop>,
    /// Width of the step between two tones, 0..0.5; default 0, cut paper. 0.1 a soft brush.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub softness: f32,
    /// How far tones are smoothed, as the deviation of a Gaussian; default 14. 0 shows every sphere, 8 is lively, 30
    /// one large shade. As published, use `"3px"`.
    pub sigma: Length,
    /// How many layers of depth are smoothed apart, 1..16; default 4. More let near puffs stand out from far ones.
    #[schemars(range(min = 1, max = 16))]
    pub layers: u32,
    /// Depth of a layer in units of the scene, 0..1e9; default 0: the smoke's depth divided by `layers`.
    #[schemars(range(min = 0.0, max = 1e9))]
    pub layer_depth: f32,
    /// Part of a layer over which puffs pass on to the next, 0..1; default 0.6. 0 as published: tones jump when a puff
    /// changes its layer.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub layer_blend: f32,
    /// How far light reaches round a puff, 0..1; default 0.3. 0 half of it, as published; 1 all of it, as on surfaces.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub wrap: f32,
    /// Light that reaches everything, 0..1; default 0.1.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub ambient: f32,
    /// How much of a tone is a puff's heat instead of light, 0..1; default 0. 0.7 for fire.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub heat: f32,
    /// How much the smoke covers, 0..1; default 1. 0.6 a haze.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub opacity: f32,
    /// Whether puffs throw shadows on one another; default true.
    pub shadow: bool,
    /// Texels of a light's picture of the smoke along a side, 64..4096; default 1024. Shadows end in circles at any
    /// size; smaller ones lose small puffs. Published: 2048.
    #[schemars(range(min = 64, max = 4096))]
    pub shadow_px: u32,
    /// Whether smoke throws shadows on surfaces, in lights that throw shadows; default true.
    pub casts: bool,
    /// Towards a light of the smoke's own, as `light.direction`; default none: the lights of the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub light: Option<[f32; 3]>,
    /// A picture whose middle row gives the tones in place of `ramp`, from shade on the left to full light on the
    /// right; default empty, none. As many tones as it has pixels, as hard as they are, or as soft as `softness`;
    /// gradients may have any shape.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub ramp_image: String,
    /// The pen's part of the shade; default none.
    pub ink: SmokeInk,
    /// How the smoke is outlined.
    pub line: SmokeLine,
}

/// The pen's part of the shade of smoke, as `ink` is of surfaces, over the tones of the ramp.
///
/// Strokes lie on a sheet that hangs in the middle of the space that smoke moves in and faces the eye: they keep
/// their distance on the picture and their place in the smoke, neither crawl over puffs that swell nor break where
/// two of them meet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmokeInk {
    /// What the shade is drawn with; default `none`. `auto` is `ink+hatch`.
    pub tone: Tone,
    /// Colour of ink and strokes; default black. Alpha is how much it covers.
    pub color: Color,
    /// Tone, 0..1, up to which the shade ramp is black; default 0.1. Raise it for more solid black.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub dark_at: f32,
    /// Tone, 0..1, from which it is white; default 0.7. Close to `dark_at` strokes are short and stubby.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub light_at: f32,
    /// Where hatch and shade together are cut, 0..1; default 0.5. Higher is blacker all over.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub threshold: f32,
    /// The strokes; their angle is that on the picture.
    pub hatch: Hatch,
}

impl Default for SmokeInk {
    fn default() -> Self {
        Self {
            tone: Tone::Off,
            color: Color::rgb(0, 0, 0),
            dark_at: 0.1,
            light_at: 0.7,
            threshold: 0.5,
            hatch: Hatch::default(),
        }
    }
}

impl SmokeInk {
    /// The pen as [`Ink`], with its strokes fixed to the picture.
    pub fn on_picture(&self) -> Ink {
        Ink {
            tone: self.tone,
            color: self.color,
            dark_at: self.dark_at,
            light_at: self.light_at,
            threshold: self.threshold,
            mapping: Mapping::Screen,
            hatch: self.hatch.clone(),
            ..Ink::default()
        }
    }
}

/// How smoke is outlined.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SmokeLine {
    /// How; default `drawn`.
    pub method: SmokeLines,
    /// Colour; default a blue black. Alpha is how much it covers.
    pub color: Color,
    /// Width of the outer line; default 3.2. 2 a pen, 6 a brush.
    pub width: Length,
    /// Part of that which lines inside the smoke have, 0..1; default 0.6. 0 only the outer line.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub inner: f32,
    /// From which jump in depth a puff is outlined before another, in radii of the puff, 0.01..10; default 0.2. Lines
    /// begin as nothing there, reach `inner` at four times the jump and the full width at sixteen times. Lower draws
    /// more lines.
    #[schemars(range(min = 0.01, max = 10.0))]
    pub jump: f32,
    /// How much lines swell away from the light, 0..1; default 0.35. 0 even.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub swell: f32,
    /// Darkness of the published line, 0..100000; default 200.
    #[schemars(range(min = 0.0, max = 100_000.0))]
    pub weight: f32,
}

impl Default for SmokeLine {
    fn default() -> Self {
        Self {
            method: SmokeLines::Drawn,
            color: Color::rgb(0x1c, 0x1e, 0x2c),
            width: Length::ref_px(3.2),
            inner: 0.6,
            jump: 0.2,
            swell: 0.35,
            weight: 200.0,
        }
    }
}

impl Default for SmokeStyle {
    fn default() -> Self {
        let stop = |at, color| SmokeStop { at, color };
        Self {
            method: SmokeMethod::Spheres,
            particles: SmokeParticles::Cover,
            puffs: SmokePuffs::default(),
            ramp: vec![
                stop(0.0, Color::rgb(0x9f, 0xa6, 0xbd)),
                stop(0.45, Color::rgb(0xf8, 0xf8, 0xfb)),
            ],
            softness: 0.0,
            sigma: Length::ref_px(14.0),
            layers: 4,
            layer_depth: 0.0,
            layer_blend: 0.6,
            wrap: 0.3,
            ambient: 0.1,
            heat: 0.0,
            opacity: 1.0,
            shadow: true,
            shadow_px: 1024,
            casts: true,
            light: None,
            ramp_image: String::new(),
            ink: SmokeInk::default(),
            line: SmokeLine::default(),
        }
    }
}

impl SmokeStyle {
    /// The tones as passes read them: the colour in linear light, then the tone at which it begins. Unused rows never
    /// begin.
    pub fn levels(&self) -> [[f32; 4]; 8] {
        let mut levels = [[1.0, 1.0, 1.0, Level::UNUSED]; 8];
        for (level, stop) in levels.iter_mut().zip(&self.ramp) {
            let [r, g, b, _] = stop.color.linear();
            *level = [r, g, b, stop.at];
        }
        levels
    }

    /// Whether the smoke is finished by the last pass, which draws with the pen or with the tones of a picture.
    pub fn is_finished_late(&self) -> bool {
        self.ink.tone != Tone::Off || !self.ramp_image.is_empty()
    }

    /// Refuses tones out of order and a light that points nowhere.
    pub(crate) fn sanity_check(&self) -> Result<(), StyleError> {
        check_order("smoke.ramp", self.ramp.iter().map(|stop| stop.at))?;
        match self.light {
            Some([0.0, 0.0, 0.0]) => Err(StyleError::unfit("smoke.light", "points nowhere")),
            _ => Ok(()),
        }
    }
}

const _: () = assert!(LAYERS_MAX == 16, "the range of `layers` says so");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Style;

    fn read(text: &str) -> Result<Style, StyleError> {
        Style::from_toml(text, &|parent| Err(format!("no '{parent}'")))
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = "[smoke]\nparticles = 'published'\npuffs = { count = 30, placement = 'random' }\n\
                    method = 'billboards'\nsigma = '3px'\nlight = [0, 1, 0]\nline.method = 'published'\n\
                    ramp = [{ at = 0.0, color = 'black' }, { at = 0.5, color = 'white' }]";
        let style = read(text).expect("a style");
        assert_eq!(style.smoke.levels()[1], [1.0, 1.0, 1.0, 0.5]);
        assert_eq!(style.smoke.levels()[2][3], Level::UNUSED);
        assert_eq!(read(&style.to_toml().expect("TOML")), Ok(style));
    }

    #[test]
    fn slips_are_told_by_name() {
        let reported = |text: &str| read(text).expect_err("a slip").to_string();
        for (text, key, fault) in [
            (
                "smoke.layers = 17",
                "smoke.layers",
                "is 17, but must lie in 1..16",
            ),
            ("smoke.light = [0, 0, 0]", "smoke.light", "points nowhere"),
            (
                "smoke.ramp = [{ at = 0.5, color = 'red' }, { at = 0.2, color = 'red' }]",
                "smoke.ramp.1.at",
                "lies before the stop ahead of it",
            ),
            (
                "smoke.puffs.ease = 0",
                "smoke.puffs.ease",
                "is 0, but must lie in 0.001..1",
            ),
            (
                "smoke.particles = 'puplished'",
                "smoke.particles",
                "is 'puplished', but must be one of cover, published",
            ),
            (
                "smoke.opacty = 1",
                "unknown key 'smoke.opacty'",
                "did you mean 'smoke.opacity'?",
            ),
        ] {
            let reported = reported(text);
            assert!(
                reported.starts_with(key) && reported.ends_with(fault),
                "{reported}"
            );
        }
    }
}
