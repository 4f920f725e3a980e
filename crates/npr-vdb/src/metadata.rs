//! What a file says about itself and its grids.

use crate::cursor::Cursor;
use crate::fault::Fault;

/// A value that a file states under a name.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MetaValue {
    /// `string`.
    Text(String),
    /// `bool`.
    Flag(bool),
    /// `int32` or `int64`.
    Integer(i64),
    /// `float` or `double`.
    Real(f64),
    /// `vec2i`, `vec3i` or `vec4i`.
    Integers(Vec<i32>),
    /// Vectors and matrices of `float` (`s`) or `double` (`d`) components; matrices row by row.
    Reals(Vec<f64>),
    /// Any other type, whose bytes are skipped.
    Other {
        /// Type as the file names it.
        type_name: String,
        /// How many bytes were skipped.
        bytes: usize,
    },
}

/// Named values in the order of the file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Metadata(Vec<(String, MetaValue)>);

/// Bytes of the shortest entry: three lengths.
const ENTRY_BYTES: usize = 12;

impl Metadata {
    /// The first value of this name.
    pub fn get(&self, name: &str) -> Option<&MetaValue> {
        let entry = self.0.iter().find(|(known, _)| known == name);
        entry.map(|(_, value)| value)
    }

    /// The text of this name, if it is a text.
    pub fn text(&self, name: &str) -> Option<&str> {
        match self.get(name)? {
            MetaValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// All names and values in the order of the file.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &MetaValue)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    pub(crate) fn read(cursor: &mut Cursor) -> Result<Self, Fault> {
        let count = cursor.count(ENTRY_BYTES, "metadata")?;
        let mut entries = Vec::new();
        for _ in 0..count {
            let name = cursor.text("a name in metadata")?;
            let type_name = cursor.text("a type in metadata")?;
            entries.push((name, MetaValue::read(type_name, cursor)?));
        }
        Ok(Self(entries))
    }
}

impl MetaValue {
    fn read(type_name: String, cursor: &mut Cursor) -> Result<Self, Fault> {
        const WHAT: &str = "a value in metadata";
        let at = cursor.at();
        let length = cursor.count(1, WHAT)?;
        let bytes = cursor.take(length, WHAT)?;
        let wrong = Fault::Broken {
            what: WHAT,
            at,
            fault: "its size does not fit its type",
        };
        Self::of_bytes(type_name, bytes).ok_or(wrong)
    }

    /// Nothing if the size does not fit the type.
    fn of_bytes(type_name: String, bytes: &[u8]) -> Option<Self> {
        Some(match type_name.as_str() {
            "string" => Self::Text(String::from_utf8_lossy(bytes).into_owned()),
            "bool" => Self::Flag(one(bytes, |[byte]| byte != 0)?),
            "int32" => Self::Integer(one(bytes, |b| i64::from(i32::from_le_bytes(b)))?),
            "int64" => Self::Integer(one(bytes, i64::from_le_bytes)?),
            "float" => Self::Real(one(bytes, |b| f64::from(f32::from_le_bytes(b)))?),
            "double" => Self::Real(one(bytes, f64::from_le_bytes)?),
            "vec2i" => Self::Integers(many(bytes, 2, i32::from_le_bytes)?),
            "vec3i" => Self::Integers(many(bytes, 3, i32::from_le_bytes)?),
            "vec4i" => Self::Integers(many(bytes, 4, i32::from_le_bytes)?),
            known => match real_count(known) {
                Some((count, 's')) => {
                    Self::Reals(many(bytes, count, |b| f32::from_le_bytes(b).into())?)
                }
                Some((count, _)) => Self::Reals(many(bytes, count, f64::from_le_bytes)?),
                None => Self::Other {
                    bytes: bytes.len(),
                    type_name,
                },
            },
        })
    }
}

/// How many components a vector or matrix of this type has, and the letter of their precision.
fn real_count(type_name: &str) -> Option<(usize, char)> {
    let letter = type_name
        .chars()
        .last()
        .filter(|letter| "sd".contains(*letter))?;
    let count = match type_name.strip_suffix(letter)? {
        "vec2" => 2,
        "vec3" => 3,
        "vec4" => 4,
        "mat3" => 9,
        "mat4" => 16,
        _ => return None,
    };
    Some((count, letter))
}

fn one<const N: usize, T>(bytes: &[u8], number: impl Fn([u8; N]) -> T) -> Option<T> {
    Some(number(bytes.try_into().ok()?))
}

fn many<const N: usize, T>(
    bytes: &[u8],
    count: usize,
    number: impl Fn([u8; N]) -> T,
) -> Option<Vec<T>> {
    let (numbers, rest) = bytes.as_chunks::<N>();
    let fits = numbers.len() == count && rest.is_empty();
    fits.then(|| numbers.iter().map(|&bytes| number(bytes)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(type_name: &str, bytes: &[u8]) -> Option<MetaValue> {
        MetaValue::of_bytes(type_name.to_owned(), bytes)
    }

    #[test]
    fn known_types_are_read() {
        let real = 0.5f64.to_le_bytes();
        assert_eq!(value("bool", &[1]), Some(MetaValue::Flag(true)));
        assert_eq!(
            value("int64", &7i64.to_le_bytes()),
            Some(MetaValue::Integer(7))
        );
        assert_eq!(value("double", &real), Some(MetaValue::Real(0.5)));
        assert_eq!(
            value("vec2d", &real.repeat(2)),
            Some(MetaValue::Reals(vec![0.5; 2]))
        );
        assert_eq!(
            value("mat4d", &real.repeat(16)),
            Some(MetaValue::Reals(vec![0.5; 16]))
        );
        assert_eq!(
            value("vec3i", &[1, 0, 0, 0].repeat(3)),
            Some(MetaValue::Integers(vec![1; 3]))
        );
    }

    #[test]
    fn a_size_that_does_not_fit_is_refused() {
        for type_name in ["bool", "int32", "float", "vec3i", "vec4s", "mat4s"] {
            assert_eq!(value(type_name, &[0; 5]), None, "{type_name}");
        }
    }

    #[test]
    fn unknown_types_are_skipped_by_their_size() {
        let other = MetaValue::Other {
            type_name: "__delayedload".to_owned(),
            bytes: 3,
        };
        assert_eq!(value("__delayedload", &[1, 2, 3]), Some(other));
        assert!(matches!(value("vec5s", &[]), Some(MetaValue::Other { .. })));
        assert!(matches!(value("", &[]), Some(MetaValue::Other { .. })));
    }
}
