//! An entry of the table.

use super::super::case::Case;
use crate::BackgroundMethod;
use npr_core::geometry::Part;

/// Keys that have no effect under a condition.
pub struct Entry {
    /// The keys, without the prefix `rule.N.` for keys of rules. A table or list covers all keys within it. A `*` at
    /// the end covers all keys that begin with what stands before.
    pub keys: &'static [&'static str],
    /// The condition under which they have no effect.
    pub is_idle: fn(&Case<'_>) -> bool,
    /// The reason, as the notice states it.
    pub why: Why,
}

/// The reason why a key has no effect.
pub enum Why {
    /// This text.
    Told(&'static str),
    /// The line methods of the frame do not use it; the text names them.
    Methods,
}

pub const fn entry(
    keys: &'static [&'static str],
    is_idle: fn(&Case<'_>) -> bool,
    why: &'static str,
) -> Entry {
    Entry {
        keys,
        is_idle,
        why: Why::Told(why),
    }
}

/// Keys that only some line methods of frames use.
pub const fn of_methods(keys: &'static [&'static str], is_idle: fn(&Case<'_>) -> bool) -> Entry {
    Entry {
        keys,
        is_idle,
        why: Why::Methods,
    }
}

pub const OFF: BackgroundMethod = BackgroundMethod::Off;
pub const PUBLISHED: BackgroundMethod = BackgroundMethod::Published;
pub const CONTRAST: BackgroundMethod = BackgroundMethod::Contrast;

/// The flags of `line.paint` that depend on light.
pub const LIT: u32 = Part::LINE_LIGHT | Part::LINE_OPACITY | Part::LINE_WIDTH;
