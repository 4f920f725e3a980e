//! The keys of the schema, and other legal values for each.

use npr_stylesheet::{Style, schema};
use serde_json::Value as Json;
use toml::Value;

/// What a key takes.
#[derive(Debug, Clone)]
enum Takes {
    Words(Vec<String>),
    Switch,
    Number {
        whole: bool,
        range: (f64, f64),
    },
    Numbers {
        count: usize,
        range: (f64, f64),
    },
    Color,
    Background,
    Length,
    /// A name or a text, by key; the values that are tried are those of [`super::enabling::TEXTS`].
    Text,
}

/// A key, entries of lists by number 0.
#[derive(Debug, Clone)]
pub struct Key {
    pub path: String,
    takes: Takes,
}

impl Key {
    /// The key as the style itself has it.
    pub fn name(&self) -> &str {
        self.path.strip_prefix("rule.0.").unwrap_or(&self.path)
    }

    /// Whether each single value has to do something.
    pub fn is_choice(&self) -> bool {
        matches!(self.takes, Takes::Words(_))
    }

    /// Whether a style states it.
    pub fn is_in(&self, style: &Style) -> bool {
        self.value_in(style).is_some()
    }

    fn value_in(&self, style: &Style) -> Option<Value> {
        let style = Value::try_from(style).unwrap();
        let within = |value: Value, name: &str| match value {
            Value::Table(mut table) => table.remove(name),
            Value::Array(entries) => entries.into_iter().nth(name.parse().ok()?),
            _ => None,
        };
        self.path.split('.').try_fold(style, within)
    }

    /// Other values than a style has, as TOML.
    pub fn values(&self, style: &Style) -> Vec<String> {
        let own = self.value_in(style);
        let quoted = |words: &[&str]| words.iter().map(|word| format!("'{word}'")).collect();
        let mut values: Vec<String> = match &self.takes {
            Takes::Words(words) => words.clone(),
            Takes::Switch => vec!["true".to_owned(), "false".to_owned()],
            Takes::Number { whole, range } => numbers(own.as_ref(), *whole, *range),
            Takes::Numbers { count, range } => lists(own.as_ref(), *count, *range),
            Takes::Color => quoted(&["#2060e0", "#e0a02080"]),
            Takes::Background => quoted(&["#406080", "transparent"]),
            Takes::Length => quoted(&["9px", "2px", "5%h"]),
            Takes::Text => super::enabling::texts(&self.path),
        };
        let own = own.map(|own| own.to_string());
        values.retain(|value| Some(value.replace('\'', "\"")) != own);
        values
    }
}

/// Numbers that differ from the one there is, the telling ones first.
fn numbers(own: Option<&Value>, whole: bool, (min, max): (f64, f64)) -> Vec<String> {
    let own = own.and_then(|own| own.as_float().or(own.as_integer().map(|own| own as f64)));
    let middle = if max - min < 1000.0 {
        (min + max) / 2.0
    } else {
        3.0
    };
    let near = own.map_or([0.3, 0.8, 2.0], |own| [own * 2.0, own * 0.5, own + 1.0]);
    let wanted = near
        .into_iter()
        .chain([middle, max.min(1000.0), min.max(-1000.0), 0.25]);
    let round = |value: f64| if whole { value.round() } else { value };
    let mut values: Vec<f64> = wanted.map(|value| round(value.clamp(min, max))).collect();
    values.retain(|value| Some(*value) != own);
    let reported = values.into_iter().map(|value| match whole {
        true => format!("{value:.0}"),
        false => format!("{value:?}"),
    });
    let mut reported: Vec<String> = reported.collect();
    reported.dedup();
    reported
}

fn lists(own: Option<&Value>, count: usize, (min, max): (f64, f64)) -> Vec<String> {
    let own: Vec<f64> = own
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
        .filter_map(Value::as_float)
        .collect();
    let patterns = [[0.9, 0.1, 0.4], [-0.3, 0.8, 0.2], [0.5, 0.25, -0.9]];
    let list = |pattern: [f64; 3]| -> Vec<f64> {
        pattern[..count]
            .iter()
            .map(|value| value.clamp(min, max))
            .collect()
    };
    let mut values: Vec<Vec<f64>> = patterns.into_iter().map(list).collect();
    values.retain(|value| *value != own);
    values.iter().map(|value| format!("{value:?}")).collect()
}

/// Every key of the schema.
pub fn keys() -> Vec<Key> {
    let mut keys = Vec::new();
    gather(schema(), "", &mut keys);
    keys
}

/// What a node is or points at.
fn resolved(node: &'static Json) -> &'static Json {
    match node.get("$ref").and_then(Json::as_str) {
        Some(place) => resolved(schema().pointer(place.strip_prefix('#').unwrap()).unwrap()),
        None => node,
    }
}

/// The forms of a value but for `null`; words are no forms.
fn forms(node: &'static Json) -> Vec<&'static Json> {
    let node = resolved(node);
    let listed = |key: &str| node.get(key).and_then(Json::as_array);
    match listed("anyOf").or(listed("oneOf")) {
        Some(forms_of) => forms_of
            .iter()
            .flat_map(forms)
            .filter(|form| !is(form, "null"))
            .collect(),
        None => vec![node],
    }
}

fn is(node: &Json, kind: &str) -> bool {
    match node.get("type") {
        Some(Json::String(one)) => one == kind,
        Some(Json::Array(many)) => many.iter().any(|one| one == kind),
        _ => false,
    }
}

fn range_of(node: &Json) -> (f64, f64) {
    let bound = |key| node.get(key).and_then(Json::as_f64);
    (
        bound("minimum").unwrap_or(-1e6),
        bound("maximum").unwrap_or(1e6),
    )
}

fn gather(node: &'static Json, path: &str, keys: &mut Vec<Key>) {
    let forms = forms(node);
    let form = forms[0];
    let add = |takes, keys: &mut Vec<Key>| {
        keys.push(Key {
            path: path.to_owned(),
            takes,
        })
    };
    let words = words_of(&forms);
    if !words.is_empty() {
        return add(Takes::Words(words), keys);
    }
    if let Some(properties) = form.get("properties").and_then(Json::as_object) {
        for (name, inner) in properties {
            let below = if path.is_empty() {
                name.clone()
            } else {
                format!("{path}.{name}")
            };
            gather(inner, &below, keys);
        }
        return;
    }
    if let Some(items) = form.get("items") {
        let inner = self::forms(items)[0];
        let count = form.get("minItems").and_then(Json::as_u64).unwrap_or(1) as usize;
        return match is(inner, "number") {
            true => add(
                Takes::Numbers {
                    count,
                    range: range_of(inner),
                },
                keys,
            ),
            false => gather(items, &format!("{path}.0"), keys),
        };
    }
    let takes = match form.get("format").and_then(Json::as_str) {
        Some("color") => Takes::Color,
        Some("background") => Takes::Background,
        Some("length") => Takes::Length,
        _ if is(form, "boolean") => Takes::Switch,
        _ if is(form, "integer") || is(form, "number") => {
            let whole = is(form, "integer");
            Takes::Number {
                whole,
                range: range_of(form),
            }
        }
        _ => Takes::Text,
    };
    add(takes, keys);
}

/// The words, or numbers, that a value has to be one of.
fn words_of(forms: &[&'static Json]) -> Vec<String> {
    let listed = forms.iter().filter_map(|form| form.get("enum")?.as_array());
    let alone = forms.iter().filter_map(|form| form.get("const"));
    let words = listed.flatten().chain(alone).filter(|word| !word.is_null());
    words.map(ToString::to_string).collect()
}
