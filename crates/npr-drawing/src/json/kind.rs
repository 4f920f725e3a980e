//! Kinds of line in line data, by their names.

use npr_vector::stroke::Kind;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, VariantAccess, Visitor};
use std::fmt;

/// Reads a kind from its name; errors are those of an enum.
pub(super) fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Kind, D::Error> {
    from.deserialize_enum("Kind", &Kind::NAMES, KindReader)
}

struct KindReader;

impl<'de> Visitor<'de> for KindReader {
    type Value = Kind;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("enum Kind")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, named: A) -> Result<Kind, A::Error> {
        let (kind, content) = named.variant_seed(NameReader)?;
        content.unit_variant()?;
        Ok(kind)
    }
}

struct NameReader;

impl<'de> DeserializeSeed<'de> for NameReader {
    type Value = Kind;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<Kind, D::Error> {
        from.deserialize_identifier(self)
    }
}

impl Visitor<'_> for NameReader {
    type Value = Kind;

    fn expecting(&self, text: &mut fmt::Formatter<'_>) -> fmt::Result {
        text.write_str("variant identifier")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Kind, E> {
        Kind::named(name).ok_or_else(|| E::unknown_variant(name, &Kind::NAMES))
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    /// Three of the kinds as an enum that serde reads by itself.
    mod derived {
        #[derive(Debug, serde::Deserialize)]
        #[serde(rename_all = "lowercase")]
        pub enum Kind {
            Contour,
            Crease,
            Marked,
        }
    }

    #[derive(Debug, Deserialize)]
    struct Ours {
        #[serde(deserialize_with = "super::read")]
        kind: super::Kind,
    }

    #[derive(Debug, Deserialize)]
    struct Derived {
        kind: derived::Kind,
    }

    #[test]
    fn faults_are_those_of_an_enum() {
        for value in [
            "\"contour\"",
            "\"marked\"",
            "\"Contour\"",
            "\"\"",
            "3",
            "null",
            "[]",
            "{}",
            "{\"crease\": null}",
            "{\"crease\": 1}",
            "{\"none\": null}",
            "{\"crease\": null, \"marked\": null}",
            "tru",
            "\"crea",
        ] {
            let text = format!("{{\"kind\": {value}}}");
            let ours = serde_json::from_str::<Ours>(&text).map(|read| read.kind.name().to_owned());
            let derived = serde_json::from_str::<Derived>(&text)
                .map(|read| format!("{:?}", read.kind).to_lowercase());
            let listed = |names: &[&str]| format!("`{}`", names.join("`, `"));
            let all = listed(&super::Kind::NAMES);
            let told = |fault: serde_json::Error| {
                fault
                    .to_string()
                    .replace(&listed(&["contour", "crease", "marked"]), &all)
            };
            assert_eq!(ours.map_err(told), derived.map_err(told), "{value}");
        }
        assert!(serde_json::from_str::<Ours>("{}").is_err());
    }
}
