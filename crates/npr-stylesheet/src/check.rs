//! Checks TOML values against the schema, so that every fault has a key and a place.

use toml::{Table, Value};

use crate::error::{Problem, StyleError, brief};
use crate::nearest::nearest;
use crate::schema::Node;
use crate::{Background, Color, Length};

/// Checks every key and value of a style, whole or partial.
///
/// # Errors
///
/// The first unknown key or value that does not fit, in the order of keys, without its position in the text.
pub(crate) fn check(table: &Table) -> Result<(), StyleError> {
    Node::root().map_or(Ok(()), |root| check_table(root, table, ""))
}

/// The key `name` within the table at `path`.
fn join(path: &str, name: &str) -> String {
    if path.is_empty() {
        name.to_owned()
    } else {
        format!("{path}.{name}")
    }
}

fn check_table(node: Node, table: &Table, path: &str) -> Result<(), StyleError> {
    for (name, value) in table {
        let inner = node
            .property(name)
            .ok_or_else(|| unknown(node, path, name))?;
        check_value(inner, value, &join(path, name))?;
    }
    match node.required().find(|name| !table.contains_key(*name)) {
        Some(missing) => Err(StyleError::value(
            path,
            Problem::Lacks {
                missing: missing.to_owned(),
            },
        )),
        None => Ok(()),
    }
}

fn unknown(node: Node, path: &str, name: &str) -> StyleError {
    let nearest = nearest(name, node.keys()).map(|sibling| join(path, sibling));
    StyleError::UnknownKey {
        key: join(path, name),
        place: None,
        nearest,
    }
}

/// Checks `value` against the form of `node` that is of its type.
fn check_value(node: Node, value: &Value, path: &str) -> Result<(), StyleError> {
    // Choose the form that a value of this type can have.
    let forms = node.forms();
    let Some(form) = forms.iter().find(|form| has_type(**form, value)) else {
        let expected = forms
            .iter()
            .filter_map(|form| type_name(*form))
            .collect::<Vec<_>>()
            .join(" or ");
        return Err(StyleError::value(
            path,
            Problem::WrongType {
                expected,
                found: found_name(value),
            },
        ));
    };

    // Check the value itself.
    check_words(*form, value, path)?;
    match value {
        Value::Table(table) => check_table(*form, table, path),
        Value::Array(entries) => check_list(*form, entries, path),
        Value::String(text) => check_text(*form, text, path),
        Value::Integer(number) => check_number(*form, *number as f64, path),
        Value::Float(number) => check_number(*form, *number, path),
        Value::Boolean(_) | Value::Datetime(_) => Ok(()),
    }
}

fn has_type(form: Node, value: &Value) -> bool {
    match value {
        Value::String(_) => form.is("string") || form.words().iter().any(|word| word.is_string()),
        Value::Integer(_) => form.is("integer") || form.is("number"),
        Value::Float(_) => form.is("number"),
        Value::Boolean(_) => form.is("boolean"),
        Value::Array(_) => form.is("array"),
        Value::Table(_) => form.is("object"),
        Value::Datetime(_) => false,
    }
}

/// The type of value that a form takes, in words.
fn type_name(form: Node) -> Option<&'static str> {
    let names = [
        ("integer", "a whole number"),
        ("number", "a number"),
        ("boolean", "true or false"),
        ("array", "a list"),
        ("object", "a table"),
    ];
    let plain = names
        .iter()
        .find(|(kind, _)| form.is(kind))
        .map(|(_, name)| *name);
    plain.or_else(|| (form.is("string") || !form.words().is_empty()).then_some("text"))
}

fn found_name(value: &Value) -> &'static str {
    match value {
        Value::String(_) => "text",
        Value::Integer(_) => "a whole number",
        Value::Float(_) => "a number",
        Value::Boolean(_) => "true or false",
        Value::Datetime(_) => "a date",
        Value::Array(_) => "a list",
        Value::Table(_) => "a table",
    }
}

fn check_words(form: Node, value: &Value, path: &str) -> Result<(), StyleError> {
    // Accept the allowed words, and any value where no words are listed.
    let words = form.words();
    let is_value = |word: &&serde_json::Value| match value {
        Value::String(text) => word.as_str() == Some(text),
        Value::Integer(number) => word.as_i64() == Some(*number),
        _ => false,
    };
    if words.is_empty() || words.iter().any(is_value) {
        return Ok(());
    }

    // List the allowed words.
    let allowed = words
        .iter()
        .map(|word| plain(word))
        .collect::<Vec<_>>()
        .join(", ");
    let value = value
        .as_str()
        .map_or_else(|| value.to_string(), |text| format!("'{}'", brief(text)));
    Err(StyleError::value(
        path,
        Problem::NotOneOf { value, allowed },
    ))
}

/// The text of an allowed word without quotes, or of an allowed number.
fn plain(word: &serde_json::Value) -> String {
    word.as_str()
        .map_or_else(|| word.to_string(), str::to_owned)
}

fn check_list(form: Node, entries: &[Value], path: &str) -> Result<(), StyleError> {
    let ((min, max), count) = (form.count(), entries.len() as u64);
    if !(min..=max).contains(&count) {
        return Err(StyleError::value(path, Problem::Count { count, min, max }));
    }
    let Some(node) = form.items() else {
        return Ok(());
    };
    entries
        .iter()
        .enumerate()
        .try_for_each(|(i, entry)| check_value(node, entry, &join(path, &i.to_string())))
}

/// Checks that a number lies in its range, which NaN and infinity never do.
fn check_number(form: Node, value: f64, path: &str) -> Result<(), StyleError> {
    let (min, max) = form.range();
    if value.is_finite() && (min..=max).contains(&value) {
        return Ok(());
    }
    Err(StyleError::value(
        path,
        Problem::OutOfRange { value, min, max },
    ))
}

fn check_text(form: Node, text: &str, path: &str) -> Result<(), StyleError> {
    let reason = match form.format() {
        Some("color") => text.parse::<Color>().err().map(|e| e.to_string()),
        Some("background") => text.parse::<Background>().err().map(|e| e.to_string()),
        Some("length") => text.parse::<Length>().err().map(|e| e.to_string()),
        _ => None,
    };
    reason.map_or(Ok(()), |reason| {
        Err(StyleError::unfit(
            path,
            format!("'{}' {reason}", brief(text)),
        ))
    })
}
