//! The arguments about how a scene stands.

use super::point::Point;
use clap::Args;
use npr_scene::Posture;
use std::path::PathBuf;

/// What the user said about the moment that is drawn.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Pose")]
pub struct PoseArguments {
    /// A clip of the file, or of the motion, by its name or its number from 0, at its start or at --time [default: the
    /// first, where --time or --motion is given; else the scene rests].
    #[arg(long, value_name = "NAME|INDEX", allow_negative_numbers = true)]
    pub clip: Option<String>,
    /// The time in the clip, in seconds; before its start and after its end it stands still. Pictures of toon
    /// materials that move are drawn at that time too, in styles that use the scene's hints.
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = time)]
    pub time: Option<f32>,
    /// A file whose clips the figure plays instead of its own: a VRM animation (.vrma), or a .glb or .vrm with bones.
    #[arg(long, value_name = "FILE")]
    pub motion: Option<PathBuf>,
    /// A file of bones by their VRM names, each with its rotation, which counts where a clip turns the same bone
    /// (.json).
    #[arg(long, value_name = "FILE")]
    pub pose: Option<PathBuf>,
    /// Bones that are turned by hand, in a window; they count before those of the file.
    #[arg(skip)]
    pub turned: Posture,
    /// An expression of a VRM by its name, and how much it shows, 0 to 1 [default share: 1]; repeatable.
    #[arg(long = "expression", value_name = "NAME[=SHARE]", value_parser = expression)]
    pub expressions: Vec<ExpressionShare>,
    /// What the figure of a VRM looks at: a point of the world, or the eye of the camera, which it follows in films
    /// [default: nothing; the eyes stay as they are].
    #[arg(long, value_name = "X,Y,Z|camera", allow_hyphen_values = true, value_parser = looked_at)]
    pub look_at: Option<LookedAt>,
}

/// What a figure looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LookedAt {
    /// The eye of the camera.
    Camera,
    /// A point of the world.
    Place(Point),
}

/// An expression, and how much of it shows.
#[derive(Debug, Clone, PartialEq)]
pub struct ExpressionShare {
    /// Its name, as the user types it.
    pub name: String,
    /// 0 to 1.
    pub share: f32,
}

/// Parses a time in seconds, any finite number.
fn time(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        _ => Err("must be a number of seconds".to_owned()),
    }
}

/// Parses what a figure looks at.
fn looked_at(text: &str) -> Result<LookedAt, String> {
    match text {
        "camera" => Ok(LookedAt::Camera),
        _ => text
            .parse()
            .map(LookedAt::Place)
            .map_err(|fault: &str| format!("{fault}, or 'camera'")),
    }
}

/// Parses the name of an expression with its share, or alone.
fn expression(text: &str) -> Result<ExpressionShare, String> {
    let (name, share) = match text.rsplit_once('=') {
        Some((name, share)) => (name, share.parse::<f32>().ok()),
        None => (text, Some(1.0)),
    };
    match share.filter(|share| (0.0..=1.0).contains(share)) {
        Some(share) if !name.is_empty() => Ok(ExpressionShare {
            name: name.to_owned(),
            share,
        }),
        _ => Err("must be a name, or a name and a share from 0 to 1, such as happy=0.8".to_owned()),
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

    #[test]
    fn a_figure_looks_at_a_point_or_the_camera() {
        assert_eq!(looked_at("camera"), Ok(LookedAt::Camera));
        let place = LookedAt::Place(Point([0.0, 1.5, -3.0]));
        assert_eq!(looked_at("0,1.5,-3"), Ok(place));
        for text in ["", "Camera", "0,1", "0,nan,1", "head"] {
            let fault = looked_at(text).expect_err("nothing to look at");
            assert!(fault.ends_with("or 'camera'"), "{fault}");
        }
    }

    #[test]
    fn an_expression_shows_whole_unless_it_has_a_share() {
        let share = |name: &str, share| {
            let name = name.to_owned();
            Ok(ExpressionShare { name, share })
        };
        assert_eq!(expression("happy"), share("happy", 1.0));
        assert_eq!(expression("Big grin=0.25"), share("Big grin", 0.25));
        assert_eq!(expression("a=b=0"), share("a=b", 0.0));
        for text in [
            "",
            "=1",
            "happy=",
            "happy=2",
            "happy=-0.1",
            "happy=nan",
            "happy=much",
        ] {
            assert!(expression(text).is_err(), "{text}");
        }
    }
}
