//! The arguments about the frames of a film.

use std::str::FromStr;

/// A range of frames, with both ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frames {
    /// The first frame.
    pub first: u32,
    /// The last one, not before the first.
    pub last: u32,
}

impl FromStr for Frames {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const EXPECTED: &str = "must be two frame numbers with .. between, such as 1..96, or one";
        let (first, last) = text.split_once("..").unwrap_or((text, text));
        let [first, last] = [first, last].map(|number| number.trim().parse::<u32>());
        match (first, last) {
            (Ok(first), Ok(last)) if first <= last => Ok(Self { first, last }),
            (Ok(_), Ok(_)) => Err("must not end before it begins"),
            _ => Err(EXPECTED),
        }
    }
}

/// Parses frames per second, 1 to 1000.
pub fn frame_rate(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(rate) if (1.0..=1000.0).contains(&rate) => Ok(rate),
        _ => Err("must be a number from 1 to 1000".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_begin_before_they_end() {
        let frames = |text: &str| text.parse::<Frames>().map(|f| (f.first, f.last)).ok();
        assert_eq!(frames("1..96"), Some((1, 96)));
        assert_eq!(frames("7"), Some((7, 7)));
        assert_eq!(frames("0..0"), Some((0, 0)));
        for text in ["2..1", "..", "1..", "a..b", "-1..3", "1...3", ""] {
            assert_eq!(frames(text), None, "{text}");
        }
    }

    #[test]
    fn rates_have_bounds() {
        assert_eq!(frame_rate("12"), Ok(12.0));
        for text in ["0", "-1", "nan", "inf", "fast", "1001"] {
            assert!(frame_rate(text).is_err(), "{text}");
        }
    }
}
