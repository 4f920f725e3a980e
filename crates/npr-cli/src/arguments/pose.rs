//! The arguments about how a scene stands.

use clap::Args;

/// What the user said about the moment that is drawn.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Pose")]
pub struct PoseArguments {
    /// A clip of the file, by its name or its number from 0, at its start or at --time [default: the first, where
    /// --time is given; else the scene rests].
    #[arg(long, value_name = "NAME|INDEX", allow_negative_numbers = true)]
    pub clip: Option<String>,
    /// The time in the clip, in seconds; before its start and after its end it stands still.
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = time)]
    pub time: Option<f32>,
}

/// Parses a time in seconds, any finite number.
fn time(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        _ => Err("must be a number of seconds".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_a_finite_number() {
        assert_eq!((time("0.25"), time("-3")), (Ok(0.25), Ok(-3.0)));
        for text in ["nan", "inf", "-inf", "1e99", "soon", ""] {
            assert!(time(text).is_err(), "{text}");
        }
    }
}
