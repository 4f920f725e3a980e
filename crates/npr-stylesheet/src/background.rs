//! The key `background` of a style: what lies behind the scene.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Color;

/// What the picture shows where no surface is.
///
/// One string: `"transparent"`, a CSS colour, or the path of a `.png`, `.jpg` or `.jpeg` image.
/// Paths are kept as written; whoever renders decides which folder they may reach.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(with = "String", extend("format" = "background"))]
pub enum Background {
    /// Nothing: alpha 0 behind the drawing.
    Transparent,
    /// One colour.
    Color(Color),
    /// An image file, which covers the frame, centred: where its shape is another, two sides are cut.
    Image(String),
}

/// The error for a text that names no background.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("is neither a CSS colour, nor 'transparent', nor the path of a .png, .jpg or .jpeg image")]
pub struct BackgroundError;

impl Default for Background {
    fn default() -> Self {
        Self::Color(Color::WHITE)
    }
}

impl FromStr for Background {
    type Err = BackgroundError;

    fn from_str(text: &str) -> Result<Self, BackgroundError> {
        if text == "transparent" {
            return Ok(Self::Transparent);
        }
        if let Ok(color) = text.parse() {
            return Ok(Self::Color(color));
        }
        if is_image_path(text) {
            Ok(Self::Image(text.to_owned()))
        } else {
            Err(BackgroundError)
        }
    }
}

/// Whether a path ends like an image that can be read, whatever the case of its letters.
fn is_image_path(path: &str) -> bool {
    let lower = path.to_ascii_lowercase();
    [".png", ".jpg", ".jpeg"]
        .iter()
        .any(|ending| lower.len() > ending.len() && lower.ends_with(ending))
}

impl fmt::Display for Background {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transparent => f.write_str("transparent"),
            Self::Color(color) => color.fmt(f),
            Self::Image(path) => f.write_str(path),
        }
    }
}

impl TryFrom<String> for Background {
    type Error = BackgroundError;

    fn try_from(text: String) -> Result<Self, BackgroundError> {
        text.parse()
    }
}

impl From<Background> for String {
    fn from(background: Background) -> Self {
        background.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_the_three_forms_apart() {
        assert_eq!("transparent".parse(), Ok(Background::Transparent));
        assert_eq!("navy".parse(), Ok(Background::Color(Color::rgb(0, 0, 128))));
        assert_eq!(
            "skies/dawn.PNG".parse(),
            Ok(Background::Image("skies/dawn.PNG".to_owned()))
        );
    }

    #[test]
    fn a_mistyped_color_is_no_path() {
        assert_eq!("bleu".parse::<Background>(), Err(BackgroundError));
        assert_eq!(".png".parse::<Background>(), Err(BackgroundError));
    }
}
