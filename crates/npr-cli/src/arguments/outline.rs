//! The arguments of `npr outline`.

use super::LimitArguments;
use clap::{Args, ValueEnum};
use npr_style::backdrop::Rule;
use npr_stylesheet::{Color, Direction, Likeness, LineBackground};
use std::path::PathBuf;
use std::str::FromStr;

/// What the user said to `npr outline`.
#[derive(Debug, Args)]
pub struct OutlineArguments {
    /// The figure, transparent where it is not: .png, .webp, .tif or .bmp, told by its content; - reads standard
    /// input.
    #[arg(value_name = "PICTURE")]
    pub picture: PathBuf,
    /// What lies behind it: a picture of the same size, also .jpg or .ppm; or a CSS colour such as teal or #204060.
    #[arg(value_name = "BACKGROUND")]
    pub background: Behind,
    /// Picture to write, .png; - writes to standard output.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Colour of lines that are seen; its alpha is the opacity of all.
    #[arg(long, value_name = "COLOUR", default_value = "black")]
    pub color: Color,
    /// By which rule it changes; names and defaults are those of the style keys line.background.*.
    #[command(flatten)]
    pub rule: OutlineRuleArguments,
    /// Show no progress and no warnings.
    #[arg(short, long)]
    pub quiet: bool,
    /// Safety limits.
    #[command(flatten)]
    pub limits: LimitArguments,
}

/// Where a line changes its colour, and how.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(next_help_heading = "Where lines change, and how")]
pub struct OutlineRuleArguments {
    /// Largest difference of any channel of RGB, 0 to 1, at which figure and background are alike; 1 leaves it out
    /// [default: 0.25].
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = share)]
    pub rgb: Option<f32>,
    /// The same of V = max(R, G, B) [default: 1].
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = share)]
    pub value: Option<f32>,
    /// The same of saturation, (max - min) / max [default: 1].
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = share)]
    pub saturation: Option<f32>,
    /// The same of hue, in degrees, 0 to 180; 180 leaves it out [default: 180].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = degrees)]
    pub hue_deg: Option<f32>,
    /// What the figure's colour is multiplied or divided by, 1 to 20 [default: 2].
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = factor)]
    pub intensity: Option<f32>,
    /// Which way lines change: auto, brighter before dark backgrounds and darker before light ones; brighter; or
    /// darker.
    #[arg(long, value_enum, value_name = "WAY", default_value_t = Way::Auto)]
    pub direction: Way,
}

/// Which way lines change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Way {
    /// By what lies behind.
    Auto,
    /// Brighter everywhere.
    Brighter,
    /// Darker everywhere.
    Darker,
}

impl OutlineRuleArguments {
    /// The rule that the arguments describe. Options that are not given have the defaults of the style keys.
    pub fn rule(&self) -> Rule {
        let usual = LineBackground::default();
        let likeness = Likeness {
            rgb: self.rgb.unwrap_or(usual.likeness.rgb),
            value: self.value.unwrap_or(usual.likeness.value),
            saturation: self.saturation.unwrap_or(usual.likeness.saturation),
            hue_deg: self.hue_deg.unwrap_or(usual.likeness.hue_deg),
        };
        let direction = match self.direction {
            Way::Auto => Direction::Auto,
            Way::Brighter => Direction::Brighter,
            Way::Darker => Direction::Darker,
        };
        let intensity = self.intensity.unwrap_or(usual.intensity);
        likeness.criteria().rule(intensity, direction.number())
    }
}

/// The background of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Behind {
    /// One colour.
    Color(Color),
    /// The path of a picture; `-` is standard input.
    Picture(PathBuf),
}

impl FromStr for Behind {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let color = text.parse().map(Self::Color);
        Ok(color.unwrap_or_else(|_| Self::Picture(PathBuf::from(text))))
    }
}

fn share(text: &str) -> Result<f32, &'static str> {
    within(text, [0.0, 1.0]).ok_or("must be a number from 0 to 1")
}

fn degrees(text: &str) -> Result<f32, &'static str> {
    within(text, [0.0, 180.0]).ok_or("must be a number of degrees from 0 to 180")
}

fn factor(text: &str) -> Result<f32, &'static str> {
    within(text, [1.0, 20.0]).ok_or("must be a number from 1 to 20")
}

/// Parses a number from `least` to `most`.
fn within(text: &str, [least, most]: [f32; 2]) -> Option<f32> {
    let number = text.parse::<f32>().ok()?;
    (least..=most).contains(&number).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        rule: OutlineRuleArguments,
    }

    fn args(line: &str) -> OutlineRuleArguments {
        let words = ["npr"].into_iter().chain(line.split_whitespace());
        Line::try_parse_from(words).expect("a right line").rule
    }

    #[test]
    fn what_is_not_said_is_as_in_styles() {
        let style = LineBackground {
            method: npr_stylesheet::BackgroundMethod::Published,
            ..LineBackground::default()
        };
        assert_eq!(args("").rule(), style.rule());
        let all =
            "--rgb 0.1 --value 0.2 --saturation 0.3 --hue-deg 36 --intensity 5 --direction darker";
        let rule = args(all).rule();
        assert_eq!(rule.thresholds, [0.1, 0.2, 0.3, 0.1]);
        assert_eq!((rule.intensity, rule.direction), (5.0, Rule::DARKER));
    }

    #[test]
    fn a_background_is_a_color_or_else_a_picture() {
        assert_eq!("teal".parse(), Ok(Behind::Color(Color::rgb(0, 128, 128))));
        assert_eq!("teal.png".parse(), Ok(Behind::Picture("teal.png".into())));
        assert_eq!("./teal".parse(), Ok(Behind::Picture("./teal".into())));
    }

    #[test]
    fn numbers_have_bounds() {
        for text in ["-1", "nan", "inf", "21", "much", ""] {
            assert!(share(text).is_err() && factor(text).is_err(), "{text}");
        }
        assert_eq!(
            (share("1"), factor("20"), degrees("180")),
            (Ok(1.0), Ok(20.0), Ok(180.0))
        );
    }
}
