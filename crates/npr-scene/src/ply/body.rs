//! The numbers after the header of a PLY file.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use super::PlyError;
use super::header::{Element, Encoding, Kind, Number};

/// One element's values: single numbers and lists, each at the index of its property.
pub(crate) struct Row<'a> {
    pub(crate) singles: &'a [f64],
    pub(crate) lists: &'a [Vec<f64>],
}

/// What is left to read.
pub(crate) struct Body<'a> {
    encoding: Encoding,
    rest: &'a [u8],
}

impl<'a> Body<'a> {
    pub(crate) fn new(encoding: Encoding, rest: &'a [u8]) -> Self {
        Self { encoding, rest }
    }

    /// Hands every row of `element` to `visit`.
    ///
    /// # Errors
    ///
    /// [`PlyError::Row`] at the first row that is cut off.
    pub(crate) fn rows(
        &mut self,
        element: &Element,
        mut visit: impl FnMut(Row),
    ) -> Result<(), PlyError> {
        // Without properties a row takes no bytes, and nothing would bound the loop.
        if element.properties.is_empty() {
            return Ok(());
        }
        let mut singles = vec![0.0; element.properties.len()];
        let mut lists = vec![Vec::new(); element.properties.len()];
        for row in 0..element.count {
            let cut = || PlyError::Row {
                element: element.name.clone(),
                row,
                count: element.count,
            };
            self.row(element, &mut singles, &mut lists)
                .ok_or_else(cut)?;
            visit(Row {
                singles: &singles,
                lists: &lists,
            });
        }
        Ok(())
    }

    fn row(
        &mut self,
        element: &Element,
        singles: &mut [f64],
        lists: &mut [Vec<f64>],
    ) -> Option<()> {
        for ((property, single), list) in element.properties.iter().zip(singles).zip(lists) {
            match property.kind {
                Kind::Single(number) => *single = self.number(number)?,
                Kind::List { length, item } => self.list(length, item, list)?,
            }
        }
        Some(())
    }

    fn list(&mut self, length: Number, item: Number, list: &mut Vec<f64>) -> Option<()> {
        let length = self.number(length)?;
        // Every item takes at least a byte.
        if !(length >= 0.0 && length <= self.rest.len() as f64) {
            return None;
        }
        list.clear();
        for _ in 0..length as u64 {
            list.push(self.number(item)?);
        }
        Some(())
    }

    fn number(&mut self, number: Number) -> Option<f64> {
        if self.encoding == Encoding::Text {
            return self.word();
        }
        match number {
            Number::I8 => self.bytes().map(|b| f64::from(i8::from_le_bytes(b))),
            Number::U8 => self.bytes().map(|b| f64::from(u8::from_le_bytes(b))),
            Number::I16 => self.bytes().map(|b| f64::from(i16::from_le_bytes(b))),
            Number::U16 => self.bytes().map(|b| f64::from(u16::from_le_bytes(b))),
            Number::I32 => self.bytes().map(|b| f64::from(i32::from_le_bytes(b))),
            Number::U32 => self.bytes().map(|b| f64::from(u32::from_le_bytes(b))),
            Number::F32 => self.bytes().map(|b| f64::from(f32::from_le_bytes(b))),
            Number::F64 => self.bytes().map(f64::from_le_bytes),
        }
    }

    /// The next bytes in little-endian order.
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (&bytes, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        let mut bytes: [u8; N] = bytes;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Some(bytes)
    }

    fn word(&mut self) -> Option<f64> {
        let text = self.rest.trim_ascii_start();
        let end = text
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(text.len());
        let (word, rest) = text.split_at_checked(end)?;
        self.rest = rest;
        str::from_utf8(word).ok()?.parse().ok()
    }
}
