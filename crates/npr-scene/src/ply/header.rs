//! The header of a PLY file: which elements follow, and how they are written.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use super::PlyError;
use crate::words::words;

/// Most elements and properties a header may name; real files have a handful.
const ENTRY_LIMIT: usize = 1000;

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    fn parse(word: &[u8]) -> Option<Self> {
        match word {
            b"char" | b"int8" => Some(Self::I8),
            b"uchar" | b"uint8" => Some(Self::U8),
            b"short" | b"int16" => Some(Self::I16),
            b"ushort" | b"uint16" => Some(Self::U16),
            b"int" | b"int32" => Some(Self::I32),
            b"uint" | b"uint32" => Some(Self::U32),
            b"float" | b"float32" => Some(Self::F32),
            b"double" | b"float64" => Some(Self::F64),
            _ => None,
        }
    }

    /// The value that stands for 1 where the number is a fraction.
    pub(crate) fn most(self) -> f64 {
        match self {
            Self::I8 => f64::from(i8::MAX),
            Self::U8 => f64::from(u8::MAX),
            Self::I16 => f64::from(i16::MAX),
            Self::U16 => f64::from(u16::MAX),
            Self::I32 => f64::from(i32::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// What a property holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Single(Number),
    List { length: Number, item: Number },
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Property {
    pub(crate) name: String,
    pub(crate) kind: Kind,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Element {
    pub(crate) name: String,
    pub(crate) count: u64,
    pub(crate) properties: Vec<Property>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Header {
    pub(crate) encoding: Encoding,
    pub(crate) elements: Vec<Element>,
}

impl Header {
    /// The header of `file` and the bytes after it.
    pub(crate) fn parse(file: &[u8]) -> Result<(Self, &[u8]), PlyError> {
        let mut header = Self {
            encoding: Encoding::Text,
            elements: Vec::new(),
        };
        let mut rest = file;

        // Read line by line until the header ends.
        for line in 1..=ENTRY_LIMIT {
            let fail = |fault| PlyError::Header { line, fault };
            let Some((text, after)) = split_line(rest) else {
                return Err(fail("the header has no end"));
            };
            rest = after;
            let mut words = words(text);
            match words.next() {
                Some(b"ply") if line == 1 => {}
                _ if line == 1 => return Err(fail("the file does not begin with 'ply'")),
                Some(b"end_header") => return Ok((header, rest)),
                Some(b"format") => {
                    header.encoding = encoding(words.next()).ok_or(fail("the format is unknown"))?
                }
                Some(b"element") => header
                    .elements
                    .push(element(words).ok_or(fail("an element needs a name and a count"))?),
                Some(b"property") => header
                    .add_property(words)
                    .ok_or(fail("a property needs a type and a name"))?,
                _ => {}
            }
        }
        Err(PlyError::Header {
            line: ENTRY_LIMIT,
            fault: "the header is too long",
        })
    }

    fn add_property<'a>(&mut self, mut words: impl Iterator<Item = &'a [u8]>) -> Option<()> {
        let first = words.next()?;
        let kind = if first == b"list" {
            Kind::List {
                length: Number::parse(words.next()?)?,
                item: Number::parse(words.next()?)?,
            }
        } else {
            Kind::Single(Number::parse(first)?)
        };
        let name = String::from_utf8_lossy(words.next()?).into_owned();
        self.elements
            .last_mut()?
            .properties
            .push(Property { name, kind });
        Some(())
    }
}

fn split_line(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = bytes.iter().position(|&byte| byte == b'\n')?;
    let (line, rest) = bytes.split_at_checked(end)?;
    Some((line, rest.get(1..)?))
}

fn encoding(word: Option<&[u8]>) -> Option<Encoding> {
    match word? {
        b"ascii" => Some(Encoding::Text),
        b"binary_little_endian" => Some(Encoding::LittleEndian),
        b"binary_big_endian" => Some(Encoding::BigEndian),
        _ => None,
    }
}

fn element<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Option<Element> {
    let name = String::from_utf8_lossy(words.next()?).into_owned();
    let count = str::from_utf8(words.next()?).ok()?.parse().ok()?;
    Some(Element {
        name,
        count,
        properties: Vec::new(),
    })
}
