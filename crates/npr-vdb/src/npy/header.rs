//! The text at the beginning of a `.npy` file: a Python dictionary of three entries.

use super::NpyFault;

/// What every file begins with.
const MAGIC: &[u8] = b"\x93NUMPY";

/// Most bytes of the text: what NumPy itself trusts.
const MOST_TEXT_BYTES: usize = 10_000;

/// Most sides of a shape that are read before it is refused.
const MOST_SIDES: usize = 32;

/// A real number's precision.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Real {
    Half,
    Single,
    Double,
}

/// How an array is stored.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) real: Real,
    pub(super) is_big_endian: bool,
    /// Whether the first axis runs fastest.
    pub(super) is_fortran: bool,
    shape: Vec<u64>,
}

impl Header {
    /// The header, and the bytes that follow it.
    pub(super) fn read(bytes: &[u8]) -> Result<(Self, &[u8]), NpyFault> {
        // Tell the version, and with it how the text's length is written.
        let rest = bytes.strip_prefix(MAGIC).ok_or(NpyFault::NotNpy)?;
        let (&[major, minor], rest) = rest.split_first_chunk().ok_or(NpyFault::NotNpy)?;
        let cut = NpyFault::Header {
            at: 0,
            fault: "it is cut off",
        };
        let length = match (major, minor) {
            (1, 0) => rest
                .split_first_chunk()
                .map(|(&length, rest)| (usize::from(u16::from_le_bytes(length)), rest)),
            (2 | 3, 0) => rest
                .split_first_chunk()
                .map(|(&length, rest)| (u32::from_le_bytes(length) as usize, rest)),
            _ => return Err(NpyFault::Version { major, minor }),
        };

        // Read the text, unless it is longer than any real one.
        let (length, rest) = length.ok_or(cut.clone())?;
        if length > MOST_TEXT_BYTES {
            return Err(NpyFault::Header {
                at: 0,
                fault: "it is longer than 10000 bytes",
            });
        }
        let (text, data) = rest.split_at_checked(length).ok_or(cut)?;
        Ok((Text { bytes: text, at: 0 }.header()?, data))
    }

    /// The three sides of the volume, and whether it holds vectors.
    pub(super) fn sides(&self) -> Result<([usize; 3], bool), NpyFault> {
        let (sides, is_vector) = match *self.shape.as_slice() {
            [x, y, z] => ([x, y, z], false),
            [x, y, z, 3] => ([x, y, z], true),
            _ => {
                return Err(NpyFault::Shape {
                    shape: self.shape.clone(),
                });
            }
        };
        // An array without places is empty, however long its other sides are said to be.
        if sides.contains(&0) {
            return Ok(([0; 3], is_vector));
        }
        // A side beyond the address space is refused with the length, which no data can have.
        let sides = sides.map(|side| usize::try_from(side).unwrap_or(usize::MAX));
        Ok((sides, is_vector))
    }
}

/// The text as it is read.
struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Text<'a> {
    /// The dictionary, and nothing but blanks behind it.
    fn header(&mut self) -> Result<Header, NpyFault> {
        // Read the three entries in any order, each once.
        let (mut descr, mut is_fortran, mut shape) = (None, None, None);
        self.expect(b'{')?;
        while !self.accept(b'}') {
            let at = self.at;
            let is_new = match self.quoted()? {
                b"descr" => {
                    self.expect(b':')?;
                    descr.replace(self.quoted()?).is_none()
                }
                b"fortran_order" => {
                    self.expect(b':')?;
                    is_fortran.replace(self.truth()?).is_none()
                }
                b"shape" => {
                    self.expect(b':')?;
                    shape.replace(self.shape()?).is_none()
                }
                _ => false,
            };
            if !is_new {
                return Err(fault(at, "an entry is unknown or stands twice"));
            }
            if !self.accept(b',') {
                self.expect(b'}')?;
                break;
            }
        }

        // Refuse a dictionary that is followed by more, or that lacks an entry.
        self.skip_blanks();
        let missing = fault(self.at, "an entry is missing");
        if self.at < self.bytes.len() {
            return Err(fault(self.at, "something stands behind its end"));
        }
        let (real, is_big_endian) = real(descr.ok_or(missing.clone())?)?;
        Ok(Header {
            real,
            is_big_endian,
            is_fortran: is_fortran.ok_or(missing.clone())?,
            shape: shape.ok_or(missing)?,
        })
    }

    fn skip_blanks(&mut self) {
        let rest = self.rest();
        let blanks = rest.len().saturating_sub(rest.trim_ascii_start().len());
        self.at = self.at.saturating_add(blanks);
    }

    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// Moves on behind blanks and `word`, if it stands there.
    fn accept_word(&mut self, word: &[u8]) -> bool {
        self.skip_blanks();
        let is_there = self.rest().starts_with(word);
        if is_there {
            self.at = self.at.saturating_add(word.len());
        }
        is_there
    }

    fn accept(&mut self, byte: u8) -> bool {
        self.accept_word(&[byte])
    }

    fn expect(&mut self, byte: u8) -> Result<(), NpyFault> {
        match self.accept(byte) {
            true => Ok(()),
            false => Err(fault(self.at, "it is no dictionary as NumPy writes it")),
        }
    }

    /// A text in quotes of either kind, without escapes, which no sound header needs.
    fn quoted(&mut self) -> Result<&'a [u8], NpyFault> {
        self.skip_blanks();
        let broken = fault(self.at, "a quoted text should stand here");
        let (&quote, rest) = self.rest().split_first().ok_or(broken.clone())?;
        let length = rest.iter().position(|&byte| byte == quote || byte == b'\\');
        let length = length.filter(|_| quote == b'\'' || quote == b'"');
        let (text, rest) = length
            .and_then(|length| rest.split_at_checked(length))
            .ok_or(broken.clone())?;
        if rest.first() != Some(&quote) {
            return Err(broken);
        }
        self.at = self.at.saturating_add(text.len()).saturating_add(2);
        Ok(text)
    }

    fn truth(&mut self) -> Result<bool, NpyFault> {
        let is_true = self.accept_word(b"True");
        if is_true || self.accept_word(b"False") {
            return Ok(is_true);
        }
        Err(fault(self.at, "True or False should stand here"))
    }

    /// Whole numbers in brackets; a single one needs a comma behind it, as in Python.
    fn shape(&mut self) -> Result<Vec<u64>, NpyFault> {
        let mut sides = Vec::new();
        self.expect(b'(')?;
        while !self.accept(b')') {
            if sides.len() == MOST_SIDES {
                return Err(fault(self.at, "the shape has too many sides"));
            }
            sides.push(self.side()?);
            if !self.accept(b',') {
                self.expect(b')')?;
                break;
            }
        }
        Ok(sides)
    }

    fn side(&mut self) -> Result<u64, NpyFault> {
        self.skip_blanks();
        let rest = self.rest();
        let length = rest.iter().position(|byte| !byte.is_ascii_digit());
        let digits = rest.get(..length.unwrap_or(rest.len())).unwrap_or_default();
        let side = std::str::from_utf8(digits)
            .ok()
            .and_then(|digits| digits.parse().ok());
        let side = side.ok_or(fault(self.at, "a side's length should stand here"))?;
        self.at = self.at.saturating_add(digits.len());
        Ok(side)
    }
}

fn fault(at: usize, fault: &'static str) -> NpyFault {
    NpyFault::Header { at, fault }
}

/// Precision, and whether the most significant byte comes first.
fn real(descr: &[u8]) -> Result<(Real, bool), NpyFault> {
    let unknown = || NpyFault::Type {
        descr: String::from_utf8_lossy(descr).into_owned(),
    };
    let (&order, kind) = descr.split_first().ok_or_else(unknown)?;
    let real = match kind {
        b"f2" => Real::Half,
        b"f4" => Real::Single,
        b"f8" => Real::Double,
        _ => return Err(unknown()),
    };
    match order {
        b'<' => Ok((real, false)),
        b'>' => Ok((real, true)),
        _ => Err(unknown()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Result<Header, NpyFault> {
        let bytes = text.as_bytes();
        Text { bytes, at: 0 }.header()
    }

    #[test]
    fn entries_stand_in_any_order() {
        let wanted = Header {
            real: Real::Double,
            is_big_endian: true,
            is_fortran: true,
            shape: vec![2, 3, 4],
        };
        for text in [
            "{'descr': '>f8', 'fortran_order': True, 'shape': (2, 3, 4), }          \n",
            "{\"shape\":(2,3,4,),\"fortran_order\":True,\"descr\":\">f8\"}",
        ] {
            assert_eq!(header(text), Ok(wanted.clone()));
        }
    }

    #[test]
    fn what_numpy_does_not_write_is_refused() {
        let faults = [
            ("", "it is no dictionary as NumPy writes it"),
            ("{'descr': '<f4'", "it is no dictionary as NumPy writes it"),
            ("{'descr': '<f4'}", "an entry is missing"),
            (
                "{'descr': '<f4', 'descr': '<f4'}",
                "an entry is unknown or stands twice",
            ),
            ("{'title': 1}", "an entry is unknown or stands twice"),
            ("{'descr': <f4}", "a quoted text should stand here"),
            ("{'descr': '<f4", "a quoted text should stand here"),
            ("{'fortran_order': 0}", "True or False should stand here"),
            ("{'shape': (-1, 2)}", "a side's length should stand here"),
            (
                "{'shape': (99999999999999999999,)}",
                "a side's length should stand here",
            ),
            ("{'shape': (1 2)}", "it is no dictionary as NumPy writes it"),
            ("{} x", "something stands behind its end"),
        ];
        for (text, wanted) in faults {
            match header(text) {
                Err(NpyFault::Header { fault, .. }) => assert_eq!(fault, wanted, "{text}"),
                other => panic!("{text}: {other:?}"),
            }
        }
        let long = format!("{{'shape': ({})}}", "1, ".repeat(40));
        assert!(header(&long).is_err());
    }

    #[test]
    fn a_long_text_is_not_read() {
        let mut file = b"\x93NUMPY\x02\0".to_vec();
        file.extend(u32::MAX.to_le_bytes());
        assert!(Header::read(&file).is_err());
    }
}
