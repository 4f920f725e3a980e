//! The style that is being worked on: a preset or file, and what was changed of it since.

use npr_stylesheet::{Stated, Style, StyleError};
use toml::{Table, Value};

use crate::value::{at, inserted, text_of};

/// A preset or style file with overrides, as `--style` and `--set` of a command line have them.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    base_name: String,
    base: Stated,
    /// Keys with values as text, each key once, none within another.
    overrides: Vec<(String, String)>,
    style: Style,
    /// The style with every value, as a tree.
    values: Value,
}

impl Sheet {
    /// A style under a name, with overrides of the form `key.path=value`, later ones stronger.
    ///
    /// # Errors
    ///
    /// [`StyleError`] for the first override that does not fit.
    pub fn new(name: &str, base: Stated, overrides: &[String]) -> Result<Self, StyleError> {
        let mut sheet = Self {
            base_name: name.to_owned(),
            style: base.style().clone(),
            values: tree(base.style()),
            base,
            overrides: Vec::new(),
        };
        let split = |text: &String| {
            let (key, value) = text.split_once('=').unwrap_or((text, ""));
            (key.trim().to_owned(), value.trim().to_owned())
        };
        let mut all = Vec::new();
        for (key, value) in overrides.iter().map(split) {
            replace(&mut all, &key, Some(value));
        }
        sheet.take(all)?;
        Ok(sheet)
    }

    /// The same overrides over another base.
    ///
    /// # Errors
    ///
    /// As [`Sheet::new`].
    pub fn over(&self, base: Stated) -> Result<Self, StyleError> {
        Self::new(&self.base_name, base, &self.overrides())
    }

    /// The name of the preset, or the path of the file.
    pub fn name(&self) -> &str {
        &self.base_name
    }

    /// The style.
    pub fn style(&self) -> &Style {
        &self.style
    }

    /// The value at a dotted key; `None` where the style has none there.
    pub fn value(&self, key: &str) -> Option<&Value> {
        at(&self.values, key)
    }

    /// The overrides, as `--set` takes them.
    pub fn overrides(&self) -> Vec<String> {
        let text = |(key, value): &(String, String)| format!("{key}={value}");
        self.overrides.iter().map(text).collect()
    }

    /// Whether a key, or one within it, was changed since the base.
    pub fn is_changed(&self, key: &str) -> bool {
        self.overrides.iter().any(|(other, _)| lies_in(other, key))
    }

    /// Gives a key another value, or where that is the base's own, takes the override back.
    ///
    /// # Errors
    ///
    /// [`StyleError`] where the value does not fit; nothing changes then.
    pub fn set(&mut self, key: &str, value: &Value) -> Result<(), StyleError> {
        let mut all = self.overrides.clone();
        replace(&mut all, key, Some(text_of(value)));
        let own = tree(self.base.style());
        if at(&own, key) == Some(value) {
            replace(&mut all, key, None);
        }
        self.take(all)
    }

    /// Takes back what was changed of a key and within it.
    ///
    /// # Errors
    ///
    /// [`StyleError`] where what is left contradicts itself; nothing changes then.
    pub fn reset(&mut self, key: &str) -> Result<(), StyleError> {
        let mut all = self.overrides.clone();
        replace(&mut all, key, None);
        self.take(all)
    }

    /// The style as a file: what differs from the base, which it extends. Where such a file would not give the same
    /// style, as beside rules of the base that say something else, every value is spelled out instead.
    pub fn file(&self) -> String {
        self.file_over(&self.base_name)
    }

    /// The same file where the base goes by another name, as seen from the folder of the file.
    pub fn file_over(&self, base_name: &str) -> String {
        let mut differing = Table::new();
        differences(&tree(self.base.style()), &self.values, &mut differing);
        let rest = toml::to_string(&differing).unwrap_or_default();
        let name = Value::String(base_name.to_owned());
        let text = format!("extends = {name}\n{rest}");
        let base = |_: &str| {
            self.base
                .style()
                .to_toml()
                .map_err(|error| error.to_string())
        };
        match Style::from_toml(&text, &base) {
            Ok(style) if draws_alike(&style, &self.style) => text,
            _ => self.style.to_toml().unwrap_or_default(),
        }
    }

    /// Puts other overrides over the base.
    fn take(&mut self, overrides: Vec<(String, String)>) -> Result<(), StyleError> {
        let mut stated = self.base.clone();
        let texts: Vec<String> = overrides
            .iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        stated.set_all(&texts)?;
        self.style = stated.into_style();
        self.values = tree(&self.style);
        self.overrides = overrides;
        Ok(())
    }
}

/// Whether two styles differ in their title and version at most, which files have of their own.
fn draws_alike(a: &Style, b: &Style) -> bool {
    let named_as_b = Style {
        title: b.title.clone(),
        version: b.version,
        ..a.clone()
    };
    named_as_b == *b
}

/// The values of a style as a tree.
fn tree(style: &Style) -> Value {
    Value::try_from(style).unwrap_or_else(|_| Value::Table(Table::new()))
}

/// Whether a dotted key is `outer` or lies within it.
fn lies_in(key: &str, outer: &str) -> bool {
    let rest = key.strip_prefix(outer);
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Replaces what overrides say of a key and within it. An override around the key is kept, before the new one.
fn replace(overrides: &mut Vec<(String, String)>, key: &str, value: Option<String>) {
    overrides.retain(|(other, _)| !lies_in(other, key));
    overrides.extend(value.map(|value| (key.to_owned(), value)));
}

/// Adds to `found` what `now` says in another way than `before`. Lists are one value.
fn differences(before: &Value, now: &Value, found: &mut Table) {
    let Some(now) = now.as_table() else {
        return;
    };
    for (name, value) in now {
        let old = before.get(name);
        if old == Some(value) {
            continue;
        }
        match old {
            Some(old) if old.is_table() && value.is_table() => {
                let mut inner = Table::new();
                differences(old, value, &mut inner);
                inserted(found, name, Value::Table(inner));
            }
            _ => inserted(found, name, value.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(preset: &str, overrides: &[&str]) -> Sheet {
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let base = Stated::preset(preset).expect("a preset");
        Sheet::new(preset, base, &overrides).expect("they fit")
    }

    fn read(file: &str) -> Style {
        let none = |name: &str| Err(format!("no {name}"));
        Style::from_toml(file, &none).expect("a style file")
    }

    #[test]
    fn a_file_states_what_differs_and_gives_the_same_style() {
        let mut ink = sheet("ink", &["line.color=#102030"]);
        ink.set("line.width.max", &Value::Float(3.5)).expect("fits");
        let text = ink.file();
        assert_eq!(
            text,
            "extends = \"ink\"\n[line]\ncolor = \"#102030\"\n\n[line.width]\nmax = 3.5\n"
        );
        assert!(draws_alike(&read(&text), ink.style()));
    }

    #[test]
    fn every_preset_is_saved_as_itself_with_a_change_that_its_rules_speak_against() {
        for preset in npr_stylesheet::presets() {
            let changes = ["line.color=#123456", "line.opacity=0.5", "shade.mode=paper"];
            let sheet = sheet(preset.name, &changes);
            let read = read(&sheet.file());
            assert!(draws_alike(&read, sheet.style()), "{}", preset.name);
        }
    }

    #[test]
    fn what_the_rules_of_a_preset_speak_against_is_spelled_out() {
        let ink = sheet("ink", &["ink.tone=hatch"]);
        let text = ink.file();
        assert!(!text.contains("extends"), "{text}");
        assert!(draws_alike(&read(&text), ink.style()));
    }

    #[test]
    fn what_is_set_back_is_no_override() {
        let mut toon = sheet("toon", &[]);
        let before = toon.clone();
        let own = toon.value("line.color").expect("a colour").clone();
        toon.set("line.color", &Value::String("#ff0000".to_owned()))
            .expect("fits");
        assert!(toon.is_changed("line") && toon.is_changed("line.color"));
        assert!(!toon.is_changed("line.col"));
        assert_eq!(toon.overrides(), ["line.color=#ff0000"]);
        toon.set("line.color", &own).expect("fits");
        assert_eq!(toon, before);
    }

    #[test]
    fn what_does_not_fit_changes_nothing() {
        let mut toon = sheet("toon", &["line.width.max=2"]);
        let before = toon.clone();
        assert!(toon.set("line.width.max", &Value::Float(-1.0)).is_err());
        assert_eq!(toon, before);
        toon.reset("line.width").expect("fits");
        assert_eq!(toon, sheet("toon", &[]));
    }
}
