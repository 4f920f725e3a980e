//! Lengths in the units that drawings are measured in.

use std::fmt;
use std::str::FromStr;

/// The frame height, in pixels, at which a reference pixel is one pixel.
pub const REFERENCE_HEIGHT_PX: f32 = 1080.0;

/// Longest length that a style may name, in its own unit.
pub const LONGEST: f32 = 100_000.0;

const MM_PER_INCH: f32 = 25.4;

/// What a length is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Pixels at a frame height of 1080, so that a picture looks the same at every size.
    RefPx,
    /// Pixels of the frame as rendered.
    Px,
    /// Millimetres on paper, by the frame's dots per inch.
    Mm,
    /// Units of the scene: lines shrink with distance.
    World,
    /// Hundredths of the frame height.
    FrameHeight,
}

/// Every unit with its ending. Longer endings stand before those they end with.
const ENDINGS: [(&str, Unit); 5] = [
    ("ref_px", Unit::RefPx),
    ("px", Unit::Px),
    ("mm", Unit::Mm),
    ("world", Unit::World),
    ("%h", Unit::FrameHeight),
];

/// A length of 0..100000 units.
///
/// A plain number is in reference pixels; other units are strings: `"3px"`, `"0.5mm"`, `"0.01world"`,
/// `"0.3%h"`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)
)]
#[cfg_attr(feature = "serde", serde(try_from = "Written", into = "Written"))]
pub struct Length {
    /// How many units; finite and never negative.
    pub value: f32,
    /// What is counted.
    pub unit: Unit,
}

/// A length as a style file holds it: a plain number is in reference pixels.
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)
)]
#[cfg_attr(feature = "serde", serde(untagged))]
enum Written {
    Number(#[cfg_attr(feature = "serde", schemars(range(min = 0.0, max = 100_000.0)))] f32),
    Text(#[cfg_attr(feature = "serde", schemars(extend("format" = "length")))] String),
}

/// Why a text is no length.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LengthError {
    /// No number with a known unit.
    #[error("is not a length such as 3, 3px, 0.5mm, 0.01world or 0.3%h")]
    Malformed,
    /// Negative, not finite or beyond [`LONGEST`].
    #[error("is a length outside 0..100000")]
    OutOfRange,
}

impl Length {
    /// A length in reference pixels.
    pub const fn ref_px(value: f32) -> Self {
        Self {
            value,
            unit: Unit::RefPx,
        }
    }

    /// The length in pixels of a frame `frame_height_px` high, printed at `dpi` dots per inch.
    ///
    /// `world_px` is how many pixels one unit of the scene covers at the place in question; only
    /// [`Unit::World`] uses it.
    pub fn to_px(self, frame_height_px: f32, dpi: f32, world_px: f32) -> f32 {
        match self.unit {
            Unit::RefPx => self.value * frame_height_px / REFERENCE_HEIGHT_PX,
            Unit::Px => self.value,
            Unit::Mm => self.value * dpi / MM_PER_INCH,
            Unit::World => self.value * world_px,
            Unit::FrameHeight => self.value * frame_height_px / 100.0,
        }
    }

    /// Checks the value and makes a length of it.
    fn checked(value: f32, unit: Unit) -> Result<Self, LengthError> {
        if (0.0..=LONGEST).contains(&value) {
            Ok(Self { value, unit })
        } else {
            Err(LengthError::OutOfRange)
        }
    }
}

impl FromStr for Length {
    type Err = LengthError;

    fn from_str(text: &str) -> Result<Self, LengthError> {
        let text = text.trim();
        let (number, unit) = ENDINGS
            .iter()
            .find_map(|(ending, unit)| Some((text.strip_suffix(ending)?, *unit)))
            .unwrap_or((text, Unit::RefPx));
        let value = number.trim().parse().map_err(|_| LengthError::Malformed)?;
        Self::checked(value, unit)
    }
}

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ending = ENDINGS
            .iter()
            .find(|(_, unit)| *unit == self.unit)
            .map_or("", |(ending, _)| *ending);
        write!(f, "{}{ending}", self.value)
    }
}

impl TryFrom<Written> for Length {
    type Error = LengthError;

    fn try_from(written: Written) -> Result<Self, LengthError> {
        match written {
            Written::Number(value) => Self::checked(value, Unit::RefPx),
            Written::Text(text) => text.parse(),
        }
    }
}

impl From<Length> for Written {
    fn from(length: Length) -> Self {
        match length.unit {
            Unit::RefPx => Self::Number(length.value),
            _ => Self::Text(length.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_unit_in_pixels_of_a_4k_frame_at_254_dpi() {
        let px = |text: &str| {
            text.parse::<Length>()
                .expect("a length")
                .to_px(2160.0, 254.0, 50.0)
        };
        assert_eq!(px("3"), 6.0);
        assert_eq!(px("3ref_px"), 6.0);
        assert_eq!(px("3px"), 3.0);
        assert_eq!(px("0.5mm"), 5.0);
        assert_eq!(px("0.1 world"), 5.0);
        assert_eq!(px("0.5%h"), 10.8);
    }

    #[test]
    fn what_is_no_length_is_refused() {
        for text in ["", "px", "3em", "3 4px", "mm3"] {
            assert_eq!(
                text.parse::<Length>(),
                Err(LengthError::Malformed),
                "{text}"
            );
        }
        for text in ["-1px", "inf", "nan", "1e9mm"] {
            assert_eq!(
                text.parse::<Length>(),
                Err(LengthError::OutOfRange),
                "{text}"
            );
        }
    }

    proptest! {
        #[test]
        fn writing_and_reading_give_the_same_length(value in 0.0f32..=LONGEST, which in 0usize..5) {
            let length = Length { value, unit: ENDINGS[which].1 };
            prop_assert_eq!(length.to_string().parse(), Ok(length));
        }

        #[test]
        fn a_reference_length_grows_with_the_frame(value in 0.0f32..100.0, height in 1.0f32..10_000.0) {
            let px = |height: f32| Length::ref_px(value).to_px(height, 96.0, 1.0);
            let (once, twice) = (px(height), px(2.0 * height));
            prop_assert!((twice - 2.0 * once).abs() <= 1e-3 * once.max(1.0));
        }
    }
}
