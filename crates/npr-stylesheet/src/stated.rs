//! A style, with the keys that its user stated.

use std::collections::BTreeSet;

use toml::Value;

use crate::error::StyleError;
use crate::key::{at, lies_in, without_rule};
use crate::set::{self, Assignment};
use crate::{Style, layers};

/// Lists whose entries are tables with keys of their own; other lists are one value.
const LISTS_OF_TABLES: [&str; 4] = ["rule", "id_map", "lettering", "extra"];

/// A style, and the keys that its user stated in style files, in their parents except presets, and in overrides.
///
/// Who chooses a preset does not ask for its single keys, so keys of presets that have no effect need no notice. A key
/// of a style file that has its default value does not count as stated either, because dumped styles have every key.
///
/// ```
/// use npr_stylesheet::Stated;
///
/// let mut stated = Stated::preset("ink")?;
/// stated.set_all(&["line.width.min=5", "line.width.max=9"])?;
/// assert_eq!(stated.style().line.width.max, 9.0);
/// assert_eq!(stated.keys().collect::<Vec<_>>(), ["line.width.max", "line.width.min"]);
/// # Ok::<(), npr_stylesheet::StyleError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Stated {
    style: Style,
    keys: BTreeSet<String>,
    /// Keys that were stated under former names.
    former: Vec<String>,
}

impl Stated {
    /// Reads a style file, as [`Style::from_toml`] does.
    ///
    /// # Errors
    ///
    /// As [`Style::from_toml`].
    pub fn from_toml(
        text: &str,
        load: &dyn Fn(&str) -> Result<String, String>,
    ) -> Result<Self, StyleError> {
        // Read the file over its parents.
        let layers::Read {
            style,
            stated,
            former,
        } = layers::read(text, load)?;

        // Keep the keys whose values differ from the defaults.
        let mut keys = BTreeSet::new();
        gather(&Value::Table(stated), "", &mut keys);
        if let Ok(usual) = Value::try_from(Style::default()) {
            let own = Value::try_from(&style).ok();
            keys.retain(|key| own.as_ref().and_then(|own| at(own, key)) != at(&usual, key));
        }
        Ok(Self {
            style,
            keys,
            former,
        })
    }

    /// The style of a preset, without stated keys.
    ///
    /// # Errors
    ///
    /// As [`Style::preset`].
    pub fn preset(name: &str) -> Result<Self, StyleError> {
        let style = Style::preset(name)?;
        Ok(Self {
            style,
            ..Self::default()
        })
    }

    /// Overrides values one after the other, as [`Style::set`] does, but checks for contradictions only after the
    /// last. The order of overrides that need each other does not matter.
    ///
    /// # Errors
    ///
    /// [`StyleError`] for the first override that is wrong by itself, else for a contradiction. Nothing changes then.
    pub fn set_all<T: AsRef<str>>(&mut self, overrides: &[T]) -> Result<(), StyleError> {
        let overrides = overrides.iter().map(|text| Assignment::of(text.as_ref()));
        let overrides: Vec<Assignment<'_>> = overrides.collect::<Result<_, _>>()?;
        self.style = set::assign(&self.style, &overrides)?;
        for Assignment {
            path,
            value,
            former,
            ..
        } in &overrides
        {
            self.former.extend(former.clone());
            let key = path.join(".");
            self.forget(&key);
            gather(value, &key, &mut self.keys);
        }
        Ok(())
    }

    /// The style.
    pub fn style(&self) -> &Style {
        &self.style
    }

    /// The style alone.
    pub fn into_style(self) -> Style {
        self.style
    }

    /// The keys that were stated under former names.
    pub(crate) fn former(&self) -> &[String] {
        &self.former
    }

    /// The stated keys from the top, with dots, entries of lists by their numbers; sorted.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.keys.iter().map(String::as_str)
    }

    /// Removes the stated keys that a new value of `key` replaces: the key itself, keys within it, and the same keys
    /// of rules.
    fn forget(&mut self, key: &str) {
        let is_of = |stated: &str| lies_in(stated, key);
        self.keys
            .retain(|stated| !is_of(stated) && !without_rule(stated).is_some_and(is_of));
    }
}

/// Adds the keys of all plain values at `key` and below.
fn gather(value: &Value, key: &str, keys: &mut BTreeSet<String>) {
    // Name the keys below this one.
    let below = |name: &str| match key {
        "" => name.to_owned(),
        _ => format!("{key}.{name}"),
    };
    let name = key.rsplit('.').next().unwrap_or(key);

    // Descend into tables and lists of tables; anything else is one value.
    match value {
        Value::Table(table) => {
            for (name, value) in table {
                gather(value, &below(name), keys);
            }
        }
        Value::Array(entries) if LISTS_OF_TABLES.contains(&name) => {
            for (i, value) in entries.iter().enumerate() {
                gather(value, &below(&i.to_string()), keys);
            }
        }
        _ => {
            keys.insert(key.to_owned());
        }
    }
}
