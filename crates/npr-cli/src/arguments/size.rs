//! Parses picture sizes.

use std::fmt;
use std::str::FromStr;

/// Width and height in pixels, neither of them 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl FromStr for Size {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const EXPECTED: &str = "must be width and height in pixels, such as 1280x720";
        let (width, height) = text.split_once(['x', 'X']).ok_or(EXPECTED)?;
        let [width, height] = [width, height].map(|side| side.trim().parse::<u32>());
        match (width, height) {
            (Ok(0), Ok(_)) | (Ok(_), Ok(0)) => Err("leaves no pixel"),
            (Ok(width), Ok(height)) => Ok(Self { width, height }),
            _ => Err(EXPECTED),
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_it_writes() {
        let size = Size {
            width: 1280,
            height: 720,
        };
        assert_eq!(size.to_string().parse(), Ok(size));
    }

    #[test]
    fn empty_and_malformed_sizes_are_refused() {
        for text in [
            "0x9",
            "9x0",
            "9",
            "9x",
            "x9",
            "-1x9",
            "1.5x9",
            "9x9x9",
            "99999999999x1",
        ] {
            assert!(text.parse::<Size>().is_err(), "{text}");
        }
    }
}
