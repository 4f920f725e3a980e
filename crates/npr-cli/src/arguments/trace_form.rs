//! The arguments of `npr trace` that choose between outlines, layers in colour and centre lines.

use clap::Args;
use npr_trace::TraceOptions;
use npr_trace::centreline::CentrelineOptions;

/// What becomes of the ink: outlines, layers in colour, or single strokes along drawn lines.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(next_help_heading = "Form")]
pub struct TraceFormArguments {
    /// Trace a picture in colour, in up to this many, 2 to 256: a layer of filled shapes for each, stacked without
    /// gaps. Transparent pixels stay empty.
    #[arg(
        long = "colours", alias = "colors", value_name = "N",
        value_parser = clap::value_parser!(u16).range(2..=256),
        conflicts_with_all = ["centreline", "blacklevel", "invert"]
    )]
    pub colors: Option<u16>,
    /// Trace the middle of drawn lines: a stroke for every line, as wide as its ink.
    #[arg(long, alias = "centerline")]
    pub centreline: bool,
    /// Cut branches that stick out of their line by less than this share of its width: 0 keeps all.
    #[arg(
        long, value_name = "N", default_value_t = 0.5, allow_hyphen_values = true, value_parser = share,
        requires = "centreline"
    )]
    pub spur: f64,
}

impl TraceFormArguments {
    /// The options for tracing centre lines. The size of specks is that of `outlines`.
    pub fn centreline_options(&self, outlines: &TraceOptions) -> CentrelineOptions {
        CentrelineOptions {
            turd_size: outlines.turd_size,
            spur: self.spur,
            ..CentrelineOptions::default()
        }
    }
}

fn share(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=10.0).contains(&value) => Ok(value),
        _ => Err("must be a number from 0 to 10".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_bounds() {
        assert_eq!((share("0"), share("1.5")), (Ok(0.0), Ok(1.5)));
        for text in ["-1", "nan", "inf", "11", "much", ""] {
            assert!(share(text).is_err(), "{text}");
        }
    }
}
