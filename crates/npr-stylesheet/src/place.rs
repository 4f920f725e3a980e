//! Positions of keys in a text.

use npr_core::decoding::guard;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::SourceLocation;

/// Line and column of a byte of `text`.
pub(crate) fn of_byte(text: &str, byte: usize) -> SourceLocation {
    let before = text.get(..byte).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    SourceLocation {
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
    }
}

/// The position of the dotted key `key` in a TOML text; for an absent key, the position of its table.
pub(crate) fn of_key(text: &str, key: &str) -> Option<SourceLocation> {
    let document = guard(|| DeTable::parse(text)).ok()?.ok()?;
    let mut found = None;
    let mut table = document.get_ref();
    let mut rest = Some(key);
    while let Some((name, value, after)) = step(table, rest?) {
        found = Some(name);
        let (inner, after) = enter_list(value, after, &mut found);
        let DeValue::Table(next) = inner.get_ref() else {
            break;
        };
        (table, rest) = (next, after);
        if rest.is_none() {
            break;
        }
    }
    found.map(|byte| of_byte(text, byte))
}

/// The entry of `table` that the path `rest` begins with: its first byte, its value, and the path that is left.
///
/// Keys may hold dots themselves, so names are compared with the path and not with its parts.
fn step<'t, 'i, 'k>(
    table: &'t DeTable<'i>,
    rest: &'k str,
) -> Option<(usize, &'t Spanned<DeValue<'i>>, Option<&'k str>)> {
    table.iter().find_map(|(name, value)| {
        let after = rest.strip_prefix(name.get_ref().as_ref())?;
        let after = if after.is_empty() {
            None
        } else {
            Some(after.strip_prefix('.')?)
        };
        Some((name.span().start, value, after))
    })
}

/// Follows list indices at the front of `rest`, moving `found` to the entry.
fn enter_list<'t, 'i, 'k>(
    mut value: &'t Spanned<DeValue<'i>>,
    mut rest: Option<&'k str>,
    found: &mut Option<usize>,
) -> (&'t Spanned<DeValue<'i>>, Option<&'k str>) {
    while let (DeValue::Array(entries), Some(path)) = (value.get_ref(), rest) {
        let (index, after) = path
            .split_once('.')
            .map_or((path, None), |(index, after)| (index, Some(after)));
        let Some(entry) = index.parse().ok().and_then(|i: usize| entries.get(i)) else {
            break;
        };
        *found = Some(entry.span().start);
        (value, rest) = (entry, after);
    }
    (value, rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_keys_in_tables_lists_and_inline() {
        let text =
            "title = 'x'\n[line]\n  opacity = 1\nwidth.gain = 2\n[[rule]]\nline = { on = true }\n";
        let place = |key| of_key(text, key).map(|p| (p.line, p.column));
        assert_eq!(place("title"), Some((1, 1)));
        assert_eq!(place("line.opacity"), Some((3, 3)));
        assert_eq!(place("line.width.gain"), Some((4, 7)));
        assert_eq!(place("rule.0.line.on"), Some((6, 10)));
        assert_eq!(place("shade.mode"), None);
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(of_byte("é = 1", 3), SourceLocation { line: 1, column: 3 });
    }
}
