//! The arguments about the camera.

use super::point::{Point, direction};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use npr_core::standard_view::StandardView;

/// What the user said about the camera.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Camera")]
pub struct CameraArguments {
    /// Where the eye is, in the world; by default the whole scene is framed from three quarters above.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub eye: Option<Point>,
    /// The point that the eye looks at [default: the middle of the scene].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub target: Option<Point>,
    /// Which way is up in the picture [default: 0,1,0].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = direction)]
    pub up: Option<Point>,
    /// Vertical field of view in degrees, above 0 and below 180 [default: 40].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = field_of_view)]
    pub fov: Option<f32>,
    /// Look at the whole scene from a side: +z is the front, +x the right, +y the top; iso from all three.
    #[arg(
        long, value_name = "SIDE", value_parser = side(), conflicts_with_all = ["eye", "target", "up"]
    )]
    pub view: Option<StandardView>,
    /// Parallel view, without perspective: what lies at the target keeps its size. With --eye, --target and --fov the
    /// frame is as high as theirs is at the target.
    #[arg(long)]
    pub ortho: bool,
    /// A camera of the file instead, by its name or its number from 0.
    #[arg(
        long, value_name = "NAME|INDEX", allow_negative_numbers = true,
        conflicts_with_all = ["eye", "target", "up", "fov", "view", "ortho"]
    )]
    pub camera: Option<String>,
}

/// Parses the name of a standard view.
fn side() -> impl TypedValueParser<Value = StandardView> {
    let names = StandardView::ALL.map(StandardView::name);
    PossibleValuesParser::new(names).try_map(|name| StandardView::of(&name).ok_or("no side"))
}

/// Parses a field of view, 0.01 to 179.9 degrees.
fn field_of_view(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(degrees) if (0.01..=179.9).contains(&degrees) => Ok(degrees),
        Ok(_) => Err("must lie between 0.01 and 179.9 degrees".to_owned()),
        Err(_) => Err("must be a number of degrees".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_of_view_is_an_open_angle() {
        assert_eq!(field_of_view("40"), Ok(40.0));
        for text in ["0", "180", "-5", "nan", "inf", "wide"] {
            assert!(field_of_view(text).is_err(), "{text}");
        }
    }
}
