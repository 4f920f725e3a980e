//! Kinds of line in line data, by their names.

use npr_vector::stroke::Kind;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, VariantAccess, Visitor};
use std::fmt;

/// Reads a kind from its name; faults are told as those of an enum.
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
