//! Why words cannot be set, and the limits they are held to.

/// Longest text in characters: words over a picture, no pages.
pub const TEXT_MAX: usize = 400;

/// Most curves of all letters together.
pub(super) const CURVES_MAX: usize = 400_000;

/// Why words could not be set.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LetteringError {
    /// The bytes are no font that can be read.
    #[error("it is not a TrueType, OpenType or Type 1 font")]
    NotAFont,
    /// The font holds no outlines, only pictures or nothing.
    #[error("the font has no outlines")]
    NoOutlines,
    /// The font's grid has no sensible number of units.
    #[error("the font has {units} units per em, but must have 16 to 16384")]
    Units {
        /// Units per em as the font states them.
        units: u16,
    },
    /// A letter's outline cannot be drawn.
    #[error("the font's outline of '{letter}' is broken")]
    BrokenLetter {
        /// The character that asked for it.
        letter: char,
    },
    /// The text is too long.
    #[error("the text has {count} characters, but may have at most {TEXT_MAX}")]
    TooLong {
        /// Characters of the text.
        count: usize,
    },
    /// The letters have too many curves.
    #[error("the letters have more than {CURVES_MAX} curves")]
    TooComplex,
}
