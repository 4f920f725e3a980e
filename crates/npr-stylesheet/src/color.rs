//! Colours as styles write them.

use std::fmt;
use std::str::FromStr;

use npr_core::decoding::guard;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An sRGB colour with straight alpha, one byte a channel.
///
/// Read from any CSS colour (`"#1e1a18"`, `"#0008"`, `"saddlebrown"`, `"hsl(30 40% 50%)"`) and written
/// as `#rrggbb`, or `#rrggbbaa` where it is not opaque. Colours outside sRGB are clipped to it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(extend("format" = "color"))]
pub struct Color {
    /// Red, 0..255.
    pub r: u8,
    /// Green, 0..255.
    pub g: u8,
    /// Blue, 0..255.
    pub b: u8,
    /// Opacity: 0 leaves no trace, 255 covers.
    pub a: u8,
}

/// The error for a text that is no colour.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("is not a CSS colour such as #1e1a18 or saddlebrown")]
pub struct ColorError;

impl Color {
    /// Opaque black.
    pub const BLACK: Self = Self::rgb(0, 0, 0);
    /// Opaque white.
    pub const WHITE: Self = Self::rgb(255, 255, 255);

    /// An opaque colour of three sRGB bytes.
    pub const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// A colour of three sRGB bytes and a fourth one for straight alpha.
    pub const fn rgba(r: u8, g: u8, b: u8, a: u8) -> Self {
        Self { r, g, b, a }
    }

    /// The sRGB-encoded values, 0..1, alpha last.
    pub fn srgb(self) -> [f32; 4] {
        [self.r, self.g, self.b, self.a].map(|byte| f32::from(byte) / 255.0)
    }

    /// Linear light, 0..1, with straight alpha last.
    pub fn linear(self) -> [f32; 4] {
        npr_core::color::linear_rgba(self.srgb())
    }
}

impl FromStr for Color {
    type Err = ColorError;

    fn from_str(text: &str) -> Result<Self, ColorError> {
        let parsed = guard(|| color::parse_color(text.trim()));
        let parsed = parsed.ok().and_then(Result::ok).ok_or(ColorError)?;
        let bytes = parsed.to_alpha_color::<color::Srgb>().to_rgba8();
        Ok(Self {
            r: bytes.r,
            g: bytes.g,
            b: bytes.b,
            a: bytes.a,
        })
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.r, self.g, self.b)?;
        if self.a < 255 {
            write!(f, "{:02x}", self.a)
        } else {
            Ok(())
        }
    }
}

impl TryFrom<String> for Color {
    type Error = ColorError;

    fn try_from(text: String) -> Result<Self, ColorError> {
        text.parse()
    }
}

impl From<Color> for String {
    fn from(color: Color) -> Self {
        color.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn reads_what_css_reads() {
        assert_eq!("#f80".parse(), Ok(Color::rgb(255, 136, 0)));
        assert_eq!("SaddleBrown".parse(), Ok(Color::rgb(139, 69, 19)));
        assert_eq!(
            "#00000080".parse(),
            Ok(Color {
                a: 128,
                ..Color::BLACK
            })
        );
        assert_eq!("#12345".parse::<Color>(), Err(ColorError));
        assert_eq!("".parse::<Color>(), Err(ColorError));
    }

    proptest! {
        #[test]
        fn writing_and_reading_give_the_same_color(r: u8, g: u8, b: u8, a: u8) {
            let color = Color { r, g, b, a };
            prop_assert_eq!(color.to_string().parse(), Ok(color));
        }

        #[test]
        fn no_text_panics(text in ".{0,40}", name in "(rgb|hsl|oklch|lab|color)\\([a-z0-9 %,./e+-]{0,30}\\)?") {
            let _ = text.parse::<Color>();
            let _ = name.parse::<Color>();
        }
    }
}
