//! Overrides by `key.path=value`.

use npr_core::decoding::guard;
use toml::{Table, Value};

use crate::error::StyleError;
use crate::former::name_of_today;
use crate::key::entry;
use crate::schema::Node;
use crate::{Style, check, layers, scene_hints};

/// Longest override, in bytes, and deepest key.
const TEXT_BYTES_MAX: usize = 1 << 16;
const DEPTH_MAX: usize = 16;

/// A parsed override.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Assignment<'a> {
    /// The override as the user wrote it.
    text: &'a str,
    /// The names that make up the key.
    pub(crate) path: Vec<&'a str>,
    /// The new value of the key.
    pub(crate) value: Value,
    /// The key as the user wrote it, where that is a former key.
    pub(crate) former: Option<String>,
}

impl<'a> Assignment<'a> {
    /// Parses a text of the form `key.path=value`.
    pub(crate) fn of(text: &'a str) -> Result<Self, StyleError> {
        // Split the text into key and value, and refuse a malformed one.
        let malformed = || StyleError::Assignment {
            text: text.to_owned(),
        };
        let (key, value) = text.split_once('=').ok_or_else(malformed)?;
        let mut path: Vec<&str> = key.trim().split('.').collect();
        if text.len() > TEXT_BYTES_MAX
            || path.len() > DEPTH_MAX
            || path.iter().any(|name| name.is_empty())
        {
            return Err(malformed());
        }

        // Replace a former name by the current one.
        let value = parse(value.trim());
        let today = name_of_today(&path);
        let former = today.map(|_| path.join("."));
        if let (Some(today), Some(last)) = (today, path.last_mut()) {
            *last = today;
        }
        Ok(Self {
            text,
            path,
            value,
            former,
        })
    }

    /// Replaces the value in the table of a style.
    fn apply(&self, table: &mut Table) -> Result<(), StyleError> {
        self.check_lists(table)?;
        yield_rules(table, &self.path);
        scene_hints::yield_to(table, &self.path);
        insert(table, &self.path, self.value.clone()).ok_or_else(|| StyleError::Assignment {
            text: self.text.to_owned(),
        })?;
        check::check(table)
    }

    /// Refuses list entries that do not exist, and names in place of their numbers.
    fn check_lists(&self, table: &Table) -> Result<(), StyleError> {
        // Walk down the key, in the schema and in the style at once.
        let mut node = Node::root();
        let mut value = None;
        for (depth, name) in self.path.iter().enumerate() {
            let is_list = node.is_some_and(|node| node.forms().iter().any(|form| form.is("array")));

            // Refuse an entry that the list does not have.
            if is_list {
                let entries = value.and_then(Value::as_array);
                let count = entries.map_or(0, Vec::len);
                let number = name.parse::<usize>().ok();
                if number.is_none_or(|number| number >= count) {
                    return Err(StyleError::NoEntry {
                        list: self.path[..depth].join("."),
                        entry: (*name).to_owned(),
                        count,
                    });
                }
            }
            node = node.and_then(|node| node.inside(name));
            value = match depth {
                0 => table.get(*name),
                _ => value.and_then(|value| entry(value, name)),
            };
        }
        Ok(())
    }
}

/// `style` with all values replaced. Contradictions are checked only after the last one; see [`Style::set`].
pub(crate) fn assign(style: &Style, assignments: &[Assignment<'_>]) -> Result<Style, StyleError> {
    let mut table = Table::try_from(style).map_err(|error| StyleError::Syntax {
        place: None,
        message: error.to_string(),
    })?;
    for assignment in assignments {
        match (&assignment.path[..], &assignment.value) {
            (["strokes"], Value::String(preset)) => table = layers::with_strokes(table, preset)?,
            _ => assignment.apply(&mut table)?,
        }
    }
    layers::from_table(table)
}

/// Parses a TOML value. A text that is not TOML becomes a string.
fn parse(text: &str) -> Value {
    let deep = text.matches(['.', '[', '{']).count() > 1000;
    let parse = || guard(|| text.parse::<Value>()).ok()?.ok();
    let parsed = if deep { None } else { parse() };
    parsed.unwrap_or_else(|| Value::String(text.to_owned()))
}

/// Puts `value` at `path`, making tables on the way; `None` where the path leads through a plain value.
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

/// Removes the value at `path` from every rule, so that the override wins. Keys have the same names in rules.
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
