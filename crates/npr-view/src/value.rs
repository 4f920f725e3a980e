//! Values of a style as text, and their places in a tree.

use npr_core::decoding::guard;
use toml::{Table, Value};

/// The value at a dotted key, if there is one.
pub(crate) fn at<'a>(value: &'a Value, key: &str) -> Option<&'a Value> {
    key.split('.').try_fold(value, |value, name| match value {
        Value::Array(entries) => entries.get(name.parse::<usize>().ok()?),
        _ => value.get(name),
    })
}

/// Puts a value into a table.
pub(crate) fn inserted(table: &mut Table, name: &str, value: Value) {
    table.insert(name.to_owned(), value);
}

/// A value as an override has it: text bare where it reads back as itself, numbers as short as single precision
/// allows.
pub(crate) fn text_of(value: &Value) -> String {
    match value {
        Value::String(text) if is_bare(text) => text.clone(),
        _ => inline(value),
    }
}

/// Whether a text without quotes is read as that text.
fn is_bare(text: &str) -> bool {
    let is_plain = !text.is_empty() && text.trim() == text && !text.contains(['\n', '\r']);
    let read = guard(|| text.parse::<Value>());
    is_plain && read.is_ok_and(|read| read.is_err())
}

/// A value in one line of TOML.
fn inline(value: &Value) -> String {
    match value {
        Value::Float(number) => number_text(*number),
        Value::Array(entries) => {
            let entries: Vec<String> = entries.iter().map(inline).collect();
            format!("[{}]", entries.join(", "))
        }
        Value::Table(table) => {
            let entries: Vec<String> = table
                .iter()
                .map(|(name, value)| format!("{name} = {}", inline(value)))
                .collect();
            format!("{{ {} }}", entries.join(", "))
        }
        _ => value.to_string(),
    }
}

/// A number; 0 where the value is none.
pub(crate) fn as_number(value: &Value) -> f64 {
    let whole = value.as_integer().map(|number| number as f64);
    value.as_float().or(whole).unwrap_or_default()
}

/// A number of a style: those are of single precision.
pub(crate) fn number_text(number: f64) -> String {
    format!("{}", number as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn back(text: &str) -> Value {
        guard(|| text.parse())
            .expect("no panic")
            .unwrap_or_else(|_| Value::String(text.to_owned()))
    }

    #[test]
    fn values_read_back() {
        let table = "a = [1, 2]\nb = \"x y\"\nc = { d = true }";
        let table: Table = guard(|| table.parse()).expect("no panic").expect("a table");
        let texts = [
            "#ff0000", "true", "3", "", " x", "8px", "a\nb", "it's", "\"q\"",
        ];
        let mut values: Vec<Value> = texts.map(|text| Value::String(text.to_owned())).to_vec();
        values.extend([
            Value::Table(table),
            Value::Integer(4),
            Value::Boolean(false),
        ]);
        for value in values {
            assert_eq!(back(&text_of(&value)), value, "{}", text_of(&value));
        }
        assert_eq!(text_of(&Value::String("#ff0000".to_owned())), "#ff0000");
        assert_eq!(text_of(&Value::Float(f64::from(0.012_f32))), "0.012");
    }
}
