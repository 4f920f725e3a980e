//! The JSON Schema of a style, and the look-ups in it that checking a style needs.

use std::sync::OnceLock;

use serde_json::{Map, Value};

use crate::Style;

/// The JSON Schema of a style file: every key with its description, default, range and words.
pub fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| schemars::schema_for!(Style).to_value())
}

/// One node of the schema.
#[derive(Clone, Copy)]
pub(crate) struct Node(pub(crate) &'static Map<String, Value>);

impl Node {
    /// The node of a whole style.
    pub(crate) fn root() -> Option<Self> {
        Self::of(schema())
    }

    /// The node that `value` is, or that its `$ref` points at.
    fn of(value: &'static Value) -> Option<Self> {
        let node = value.as_object()?;
        match node.get("$ref").and_then(Value::as_str) {
            Some(reference) => schema()
                .pointer(reference.strip_prefix('#')?)?
                .as_object()
                .map(Self),
            None => Some(Self(node)),
        }
    }

    pub(crate) fn text(self, key: &str) -> Option<&'static str> {
        self.0.get(key)?.as_str()
    }

    fn list(self, key: &str) -> impl Iterator<Item = &'static Value> {
        self.0
            .get(key)
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
    }

    /// The node of a key of this table.
    pub(crate) fn property(self, key: &str) -> Option<Self> {
        Self::of(self.0.get("properties")?.get(key)?)
    }

    /// The node of a key of this table, or of an entry of this list.
    pub(crate) fn inside(self, name: &str) -> Option<Self> {
        let mut forms = self.forms().into_iter();
        forms.find_map(|form| form.property(name).or_else(|| form.items()))
    }

    /// The keys of this table.
    pub(crate) fn keys(self) -> impl Iterator<Item = &'static str> {
        self.0
            .get("properties")
            .and_then(Value::as_object)
            .into_iter()
            .flat_map(|keys| keys.keys().map(String::as_str))
    }

    /// The keys of this table that have no default.
    pub(crate) fn required(self) -> impl Iterator<Item = &'static str> {
        self.list("required").filter_map(Value::as_str)
    }

    /// The node of every entry of this list.
    pub(crate) fn items(self) -> Option<Self> {
        Self::of(self.0.get("items")?)
    }

    /// The forms that a value may take; the node itself where it has only one.
    pub(crate) fn forms(self) -> Vec<Self> {
        if self.words().is_empty() {
            let forms: Vec<_> = self
                .list("anyOf")
                .chain(self.list("oneOf"))
                .filter_map(Self::of)
                .collect();
            if !forms.is_empty() {
                return forms.into_iter().flat_map(Self::forms).collect();
            }
        }
        vec![self]
    }

    /// The words or numbers that a value must be one of; empty where any value is allowed.
    pub(crate) fn words(self) -> Vec<&'static Value> {
        let alone = self.list("enum").chain(self.0.get("const"));
        let described = self
            .list("oneOf")
            .filter_map(Self::of)
            .filter_map(|node| node.0.get("const"));
        alone.chain(described).collect()
    }

    /// The same with what each of them means, as far as that is said.
    pub(crate) fn described_words(self) -> Vec<(toml::Value, &'static str)> {
        let text = |word: &Value| {
            let described = self.list("oneOf").filter_map(Self::of);
            let mut described = described.filter(|node| node.0.get("const") == Some(word));
            described.next().and_then(|node| node.text("description"))
        };
        let words = self.words().into_iter();
        let words = words.filter_map(|word| {
            let value = toml::Value::try_from(word).ok()?;
            Some((value, text(word).unwrap_or_default()))
        });
        words.collect()
    }

    /// Whether it stands for no value.
    pub(crate) fn is_null_alone(self) -> bool {
        self.text("type") == Some("null")
    }

    /// The name of the text's format, such as `color`.
    pub(crate) fn format(self) -> Option<&'static str> {
        self.text("format")
    }

    /// Whether values are of this JSON type.
    pub(crate) fn is(self, kind: &str) -> bool {
        self.text("type") == Some(kind) || self.list("type").any(|one| one.as_str() == Some(kind))
    }

    /// Smallest and largest number allowed.
    pub(crate) fn range(self) -> (f64, f64) {
        let bound = |key| self.0.get(key).and_then(Value::as_f64);
        (
            bound("minimum").unwrap_or(f64::NEG_INFINITY),
            bound("maximum").unwrap_or(f64::INFINITY),
        )
    }

    /// Fewest and most entries allowed.
    pub(crate) fn count(self) -> (u64, u64) {
        let bound = |key| self.0.get(key).and_then(Value::as_u64);
        (
            bound("minItems").unwrap_or(0),
            bound("maxItems").unwrap_or(u64::MAX),
        )
    }
}
