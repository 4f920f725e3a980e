//! The arguments about volumes of smoke.

use super::Point;
use clap::{Args, ValueEnum};
use npr_smoke::Birthplace;
use npr_stylesheet::{SmokeParticles, SmokeStyle};
use std::path::PathBuf;
use std::str::FromStr;

/// What the user said about volumes of smoke.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Smoke")]
pub struct VolumeArguments {
    /// Smoke inside the scene, from a .vdb or .npy file or a built-in source (plume, puff, explosion, cloud);
    /// repeatable. It lies where the file puts it; with @x,y,z the middle of its lowest plane stands there, and
    /// *scale makes it larger.
    #[arg(long = "volume", value_name = "FILE[@X,Y,Z[*SCALE]]")]
    pub volumes: Vec<PlacedVolume>,
    /// Which spheres stand for smoke [default: the style's, cover unless it says otherwise].
    #[arg(long, value_enum)]
    pub particles: Option<ParticlesName>,
    /// Where smoke of a file comes from, for published particles: a point of the file's own world, and a radius round
    /// it; they are born there [default: where the built-in simulation smokes, anywhere in a file's smoke].
    #[arg(long, value_name = "X,Y,Z*RADIUS", allow_hyphen_values = true)]
    pub emitter: Option<Emitter>,
    /// Most spheres that a volume is drawn with: 30 bold and simple, 2000 a busy eruption; published particles are
    /// always as many [default: the style's, 200 unless it says otherwise].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub spheres: Option<u32>,
    /// Density up to which there is no smoke [default: the style's, 0.1 unless it says otherwise].
    #[arg(long, value_name = "DENSITY", value_parser = threshold)]
    pub threshold: Option<f32>,
    /// Voxels along the longest side in which the shape of smoke is seen: 20 a few bold puffs, 200 every wisp
    /// [default: the style's, 40 unless it says otherwise].
    #[arg(long, value_name = "VOXELS", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub detail: Option<u32>,
    /// The grid of densities in .vdb files [default: density, or the only one].
    #[arg(long, value_name = "NAME")]
    pub density: Option<String>,
    /// The grid of velocities, or those of their three components [default: velocity, vel or v].
    #[arg(long, value_name = "NAME[,NAME,NAME]", value_delimiter = ',')]
    pub velocity: Vec<String>,
    /// The grid of temperatures [default: temperature, heat or temp].
    #[arg(long, value_name = "NAME")]
    pub heat: Option<String>,
    /// Which axis of volume files points up: z in those of Blender.
    #[arg(long, value_enum, default_value_t)]
    pub volume_up: VolumeUp,
    /// Other numbers give other smoke of the same kind.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u32,
}

impl VolumeArguments {
    /// The style of smoke with the arguments in place of its own values.
    pub fn over(&self, style: &SmokeStyle) -> SmokeStyle {
        let mut style = style.clone();
        if let Some(particles) = self.particles {
            style.particles = match particles {
                ParticlesName::Cover => SmokeParticles::Cover,
                ParticlesName::Published => SmokeParticles::Published,
            };
        }
        style.puffs.count = self.spheres.unwrap_or(style.puffs.count);
        style.puffs.threshold = self.threshold.unwrap_or(style.puffs.threshold);
        style.puffs.detail = self.detail.unwrap_or(style.puffs.detail);
        style
    }
}

/// Which spheres stand for smoke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ParticlesName {
    /// As few as cover it, which follow it without popping.
    Cover,
    /// For comparison, as published in 2004: a constant number, born and dying at random, each as large as the smoke
    /// allows.
    Published,
}

/// The sphere that smoke comes from, in the file's own world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Emitter {
    center: Point,
    radius: f32,
}

impl FromStr for Emitter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (center, radius) = text
            .split_once('*')
            .ok_or("must be a point and a radius, such as 0,1,0*0.2")?;
        match radius.trim().parse::<f32>() {
            Ok(radius) if radius > 0.0 && radius.is_finite() => Ok(Self {
                center: center.parse()?,
                radius,
            }),
            _ => Err("the radius behind * must be a number above 0".to_owned()),
        }
    }
}

impl From<Emitter> for Birthplace {
    fn from(emitter: Emitter) -> Self {
        Self::Emitter {
            center: emitter.center.0.into(),
            radius: emitter.radius,
        }
    }
}

/// Which axis points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum VolumeUp {
    /// As in the scene.
    #[default]
    Y,
    /// As in Blender.
    Z,
}

/// A volume as the user names it, with its placement.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedVolume {
    /// A file, a series, or a built-in source.
    pub name: PathBuf,
    /// Position of the middle of its lowest plane, and factor on its size. `None` leaves the volume where its file
    /// puts it.
    pub place: Option<(Point, f32)>,
}

impl FromStr for PlacedVolume {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let is_place = |text: &str| {
            let mut bytes = text.bytes();
            !text.is_empty() && bytes.all(|byte| b"0123456789+-.,*eE ".contains(&byte))
        };
        // File names may contain an @ too.
        match text.rsplit_once('@') {
            Some((name, place)) if is_place(place) => Ok(Self {
                name: PathBuf::from(name),
                place: Some(placement(place)?),
            }),
            _ => Ok(Self {
                name: PathBuf::from(text),
                place: None,
            }),
        }
    }
}

/// Parses `x,y,z` or `x,y,z*scale`.
fn placement(text: &str) -> Result<(Point, f32), String> {
    let (point, scale) = text.split_once('*').unwrap_or((text, "1"));
    let point = point
        .parse()
        .map_err(|reason| format!("the place behind @ {reason}"))?;
    match scale.trim().parse::<f32>() {
        Ok(scale) if scale > 0.0 && scale.is_finite() => Ok((point, scale)),
        _ => Err("the scale behind * must be a number above 0".to_owned()),
    }
}

/// Parses a density, 0 or more.
fn threshold(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(density) if density >= 0.0 && density.is_finite() => Ok(density),
        _ => Err("must be a number, 0 or more".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A name, a place and a scale.
    type Placed = (String, Option<([f32; 3], f32)>);

    fn placed(text: &str) -> Result<Placed, String> {
        let volume: PlacedVolume = text.parse()?;
        let place = volume.place.map(|(point, scale)| (point.0, scale));
        Ok((volume.name.to_string_lossy().into_owned(), place))
    }

    #[test]
    fn a_place_stands_behind_the_last_sign() {
        let at = |name: &str, place| Ok((name.to_owned(), place));
        assert_eq!(placed("a.vdb"), at("a.vdb", None));
        assert_eq!(
            placed("a.vdb@1,-2,.5"),
            at("a.vdb", Some(([1.0, -2.0, 0.5], 1.0)))
        );
        assert_eq!(
            placed("a@b.vdb@0,0,0*2e-1"),
            at("a@b.vdb", Some(([0.0; 3], 0.2)))
        );
        assert_eq!(placed("me@home.vdb"), at("me@home.vdb", None));
    }

    #[test]
    fn a_place_that_is_none_is_refused() {
        for text in [
            "a@1,2",
            "a@1,2,3*0",
            "a@1,2,3*-1",
            "a@1,2,3*",
            "a@1,2,3,4",
            "a@1e99,0,0",
            "a@*2",
        ] {
            assert!(placed(text).is_err(), "{text}");
        }
    }

    #[test]
    fn an_emitter_is_a_point_and_a_radius() {
        let emitter = |text: &str| text.parse::<Emitter>().map(|e| (e.center.0, e.radius));
        assert_eq!(emitter("1,-2,.5*2"), Ok(([1.0, -2.0, 0.5], 2.0)));
        for text in ["1,2,3", "1,2*3", "1,2,3*0", "1,2,3*nan", "*1", ""] {
            assert!(emitter(text).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_said_wins_over_the_style() {
        let mut style = SmokeStyle::default();
        style.puffs.count = 7;
        assert_eq!(VolumeArguments::default().over(&style), style);
        let args = VolumeArguments {
            particles: Some(ParticlesName::Published),
            threshold: Some(0.3),
            ..VolumeArguments::default()
        };
        let styled = args.over(&style);
        assert_eq!(styled.particles, SmokeParticles::Published);
        assert_eq!((styled.puffs.count, styled.puffs.threshold), (7, 0.3));
    }

    #[test]
    fn a_threshold_is_no_less_than_nothing() {
        assert_eq!(threshold("0"), Ok(0.0));
        for text in ["-0.1", "nan", "inf", "thick"] {
            assert!(threshold(text).is_err(), "{text}");
        }
    }
}
