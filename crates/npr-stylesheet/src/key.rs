//! Dotted keys of a style, such as `line.width.base`.

use toml::Value;

/// The key of a rule without its prefix `rule.N.`; `None` for other keys.
pub(crate) fn without_rule(key: &str) -> Option<&str> {
    let (_, key) = key.strip_prefix("rule.")?.split_once('.')?;
    Some(key)
}

/// Whether a dotted key is `outer` itself, or lies within the table or list at `outer`.
pub(crate) fn lies_in(key: &str, outer: &str) -> bool {
    let rest = key.strip_prefix(outer);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The value at a dotted key, if there is one.
pub(crate) fn at<'a>(value: &'a Value, key: &str) -> Option<&'a Value> {
    key.split('.').try_fold(value, entry)
}

/// The value that a table has under a name, or a list under a number.
pub(crate) fn entry<'a>(value: &'a Value, name: &str) -> Option<&'a Value> {
    match value {
        Value::Array(entries) => entries.get(name.parse::<usize>().ok()?),
        _ => value.get(name),
    }
}
