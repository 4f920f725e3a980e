//! Overrides by `key.path=value`.

use npr_core::decoding::guard;
use toml::{Table, Value};

use crate::error::StyleError;
use crate::{Style, check, layers};

/// Longest override, in bytes, and deepest key.
const TEXT_BYTES_MAX: usize = 1 << 16;
const DEPTH_MAX: usize = 16;

/// `style` with one value replaced; see [`Style::set`].
pub(crate) fn assign(style: &Style, assignment: &str) -> Result<Style, StyleError> {
    let malformed = || StyleError::Assignment {
        text: assignment.to_owned(),
    };
    let (key, value) = assignment.split_once('=').ok_or_else(malformed)?;
    let path: Vec<&str> = key.trim().split('.').collect();
    if assignment.len() > TEXT_BYTES_MAX
        || path.len() > DEPTH_MAX
        || path.iter().any(|name| name.is_empty())
    {
        return Err(malformed());
    }
    let mut table = Table::try_from(style).map_err(|_| malformed())?;
    yield_rules(&mut table, &path);
    insert(&mut table, &path, parse(value.trim())).ok_or_else(malformed)?;
    check::check(&table)?;
    layers::from_table(table)
}

/// The TOML value of a text; what is no TOML is text itself.
fn parse(text: &str) -> Value {
    let deep = text.matches(['.', '[', '{']).count() > 1000;
    let parse = || guard(|| text.parse::<Value>()).ok()?.ok();
    let parsed = if deep { None } else { parse() };
    parsed.unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Puts `value` at `path`, making tables on the way; none where the path leads through a plain value.
fn insert(table: &mut Table, path: &[&str], value: Value) -> Option<()> {
    let (name, rest) = path.split_first()?;
    if rest.is_empty() {
        table.insert((*name).to_owned(), value);
        return Some(());
    }
    let inner = table
        .entry(*name)
        .or_insert_with(|| Value::Table(Table::new()));
    insert_into(inner, rest, value)
}

/// Puts `value` at `path` inside a table or a list.
fn insert_into(holder: &mut Value, path: &[&str], value: Value) -> Option<()> {
    match holder {
        Value::Table(table) => insert(table, path, value),
        Value::Array(entries) => {
            let (index, rest) = path.split_first()?;
            let entry = entries.get_mut(index.parse::<usize>().ok()?)?;
            if rest.is_empty() {
                *entry = value;
                return Some(());
            }
            insert_into(entry, rest, value)
        }
        _ => None,
    }
}

/// Removes the value at `path` from every rule: rules name keys as the style does, and overrides win.
fn yield_rules(table: &mut Table, path: &[&str]) {
    let Some(Value::Array(rules)) = table.get_mut("rule") else {
        return;
    };
    for rule in rules.iter_mut().filter_map(Value::as_table_mut) {
        remove(rule, path);
    }
}

fn remove(table: &mut Table, path: &[&str]) {
    match path {
        [name] => {
            table.remove(*name);
        }
        [name, rest @ ..] => {
            if let Some(inner) = table.get_mut(*name).and_then(Value::as_table_mut) {
                remove(inner, rest);
            }
        }
        [] => {}
    }
}
