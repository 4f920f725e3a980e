//! The errors of styles.

use std::fmt;

/// A position in a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SourceLocation {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
}

impl fmt::Display for SourceLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// What is wrong with the value of a key.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The value has another type than the key takes.
    #[error("is {found}, but must be {expected}")]
    WrongType {
        /// The types that the key takes, in words.
        expected: String,
        /// The type of the value, in words.
        found: &'static str,
    },
    /// The value is a number outside its range.
    #[error("is {}, but must {}", number(*value), within(*min, *max))]
    OutOfRange {
        /// The number as read.
        value: f64,
        /// Smallest allowed.
        min: f64,
        /// Largest allowed.
        max: f64,
    },
    /// The value is none of the words or numbers that the key takes.
    #[error("is {value}, but must be one of {allowed}")]
    NotOneOf {
        /// The value as read.
        value: String,
        /// All allowed values, with commas between.
        allowed: String,
    },
    /// The value is a list of the wrong length.
    #[error("has {count} entries, but must have {min} to {max}")]
    Count {
        /// Entries as read.
        count: u64,
        /// Fewest allowed.
        min: u64,
        /// Most allowed.
        max: u64,
    },
    /// The value is a table that lacks a key without a default.
    #[error("lacks '{missing}'")]
    Lacks {
        /// The absent key.
        missing: String,
    },
    /// The value is a text that cannot be read, or it contradicts another value.
    #[error("{reason}")]
    Unfit {
        /// A predicate for the key: "is not a CSS colour".
        reason: String,
    },
}

/// Why a style was rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StyleError {
    /// The text is too long to be a style.
    #[error("style has {bytes} bytes, but may have at most {limit_bytes}")]
    TooLarge {
        /// Length of the text.
        bytes: usize,
        /// Longest allowed.
        limit_bytes: usize,
    },
    /// The text is not TOML.
    #[error("not TOML{}: {message}", at(*place))]
    Syntax {
        /// Where reading stopped.
        place: Option<SourceLocation>,
        /// What the reader expected there.
        message: String,
    },
    /// No style has this key.
    #[error("unknown key '{}'{}{}", brief(key), at(*place), hint(nearest.as_deref()))]
    UnknownKey {
        /// The key from the top, with dots.
        key: String,
        /// Position of the key, if it is in the text that was read.
        place: Option<SourceLocation>,
        /// The valid key most like it.
        nearest: Option<String>,
    },
    /// A key's value does not fit.
    #[error("{}{} {problem}", brief(key), at(*place))]
    Value {
        /// The key from the top, with dots.
        key: String,
        /// Position of the key, if it is in the text that was read.
        place: Option<SourceLocation>,
        /// What is wrong with it.
        problem: Problem,
    },
    /// No preset has this name.
    #[error("no preset is called '{}'{}", brief(name), hint(nearest.as_deref()))]
    UnknownPreset {
        /// The name asked for.
        name: String,
        /// The preset most like it.
        nearest: Option<String>,
    },
    /// The preset exists, but not in this version.
    #[error("preset '{name}' has no version {}, only {newest}", brief(asked))]
    PresetVersion {
        /// The preset.
        name: &'static str,
        /// The text after the `@`.
        asked: String,
        /// The newest version.
        newest: u32,
    },
    /// A parent named in `extends` could not be read.
    #[error("cannot read parent style '{}': {reason}", brief(parent))]
    Load {
        /// The parent as named.
        parent: String,
        /// The reason that the caller's loader gave.
        reason: String,
    },
    /// A parent named in `extends` is itself wrong.
    #[error("in parent style '{}': {source}", brief(parent))]
    InParent {
        /// The parent as named.
        parent: String,
        /// What is wrong with it.
        source: Box<StyleError>,
    },
    /// A style extends itself, directly or through others.
    #[error("style '{}' extends itself", brief(parent))]
    Cycle {
        /// The parent that came up again.
        parent: String,
    },
    /// The style has too many parents, parents of parents included.
    #[error("style extends more than {limit} others")]
    TooManyParents {
        /// Most allowed.
        limit: usize,
    },
    /// An override is not of the form `key.path=value`.
    #[error("override '{}' is not of the form key.path=value", brief(text))]
    Assignment {
        /// The override as given.
        text: String,
    },
    /// An override names an entry that a list does not have.
    #[error(
        "'{}' has {}, so there is no '{}': write {}", brief(list), entries(*count), brief(&format!("{list}.{entry}")),
        form_of_entry(list, *count)
    )]
    NoEntry {
        /// The list.
        list: String,
        /// The text in place of the entry's number.
        entry: String,
        /// Number of entries of the list.
        count: usize,
    },
}

impl StyleError {
    /// The error about `key`, without its position.
    pub(crate) fn value(key: impl Into<String>, problem: Problem) -> Self {
        Self::Value {
            key: key.into(),
            place: None,
            problem,
        }
    }

    /// The error about `key` that says why it does not fit.
    pub(crate) fn unfit(key: impl Into<String>, reason: impl Into<String>) -> Self {
        Self::value(
            key,
            Problem::Unfit {
                reason: reason.into(),
            },
        )
    }

    /// The error with the position that `find` gives for its key, where the error is about a key.
    pub(crate) fn placed(mut self, find: impl FnOnce(&str) -> Option<SourceLocation>) -> Self {
        if let Self::UnknownKey { key, place, .. } | Self::Value { key, place, .. } = &mut self {
            *place = find(key);
        }
        self
    }
}

fn at(place: Option<SourceLocation>) -> String {
    place.map_or_else(String::new, |place| format!(" at {place}"))
}

/// A number of entries, in words.
fn entries(count: usize) -> String {
    match count {
        0 => "no entries".to_owned(),
        1 => "one entry".to_owned(),
        _ => format!("{count} entries"),
    }
}

/// An example of an override that names an entry of a list, or fills an empty list.
fn form_of_entry(list: &str, count: usize) -> String {
    let example = match list {
        "rule" => "{ match = { material = 'Skin*' }, line = { on = false } }",
        _ => "...",
    };
    match count {
        0 => format!("{}=[{example}]", brief(list)),
        1 => format!("{}.0.key=value", brief(list)),
        _ => format!(
            "{list}.N.key=value with N from 0 to {}",
            count - 1,
            list = brief(list)
        ),
    }
}

/// A number as short text, in scientific form where it is very large or small.
fn number(value: f64) -> String {
    // Styles hold single precision: a value of 1.3 must not be printed as 1.2999999523162842.
    let single = value as f32;
    let [plain, scientific] = match f64::from(single) == value {
        true => [single.to_string(), format!("{single:e}")],
        false => [value.to_string(), format!("{value:e}")],
    };
    let size = value.abs();
    let is_plain = size == 0.0 || (1e-6..1e6).contains(&size) || !size.is_finite();
    match is_plain || plain.len() <= scientific.len() {
        true => plain,
        false => scientific,
    }
}

/// The predicate for a number within bounds, such as `lie in 0..1`. An infinite bound is left out.
fn within(min: f64, max: f64) -> String {
    match (min.is_finite(), max.is_finite()) {
        (true, true) => format!("lie in {}..{}", number(min), number(max)),
        (true, false) => format!("be {} or more", number(min)),
        (false, true) => format!("be {} or less", number(max)),
        (false, false) => "be finite".to_owned(),
    }
}

fn hint(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |nearest| {
        format!("; did you mean '{nearest}'?")
    })
}

/// At most 60 characters of text from outside, with control characters spelled out.
pub(crate) fn brief(text: &str) -> String {
    const SHOWN: usize = 60;
    let mut shown: String = text
        .chars()
        .take(SHOWN)
        .flat_map(char::escape_debug)
        .collect();
    if text.chars().nth(SHOWN).is_some() {
        shown.push_str("...");
    }
    shown
}
