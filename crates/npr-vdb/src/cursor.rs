//! A place in a file's bytes that moves on as they are read.

use crate::fault::Fault;

/// A place in the file. Numbers are little-endian, which is all that OpenVDB writes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }

    /// Bytes from the file's beginning.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// Bytes that are left.
    pub(crate) fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// Where its bytes end, from the file's beginning.
    pub(crate) fn end(&self) -> usize {
        self.bytes.len()
    }

    /// A cursor from `start` to before `end`, both from the file's beginning.
    ///
    /// # Errors
    ///
    /// [`Fault::Truncated`] unless start and end lie in order between here and the end.
    pub(crate) fn part(&self, start: usize, end: usize, what: &'static str) -> Result<Self, Fault> {
        let bytes = self.bytes.get(..end);
        let bytes = bytes.filter(|_| self.at <= start && start <= end);
        let bytes = bytes.ok_or(self.truncated(what))?;
        Ok(Self { bytes, at: start })
    }

    /// The next `count` bytes.
    ///
    /// # Errors
    ///
    /// [`Fault::Truncated`] if there are fewer; so for all that follows.
    pub(crate) fn take(&mut self, count: usize, what: &'static str) -> Result<&'a [u8], Fault> {
        let end = self.at.saturating_add(count);
        let bytes = self.bytes.get(self.at..end);
        let bytes = bytes.ok_or(self.truncated(what))?;
        self.at = end;
        Ok(bytes)
    }

    /// The next `N` bytes.
    pub(crate) fn array<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], Fault> {
        let truncated = self.truncated(what);
        self.take(N, what)?.first_chunk().copied().ok_or(truncated)
    }

    /// The next byte.
    pub(crate) fn byte(&mut self, what: &'static str) -> Result<u8, Fault> {
        let [byte] = self.array(what)?;
        Ok(byte)
    }

    /// The next byte, which must be 0 or 1.
    pub(crate) fn flag(&mut self, what: &'static str) -> Result<bool, Fault> {
        let at = self.at;
        match self.byte(what)? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(Fault::Broken {
                what,
                at,
                fault: "a flag is neither 0 nor 1",
            }),
        }
    }

    /// The next four bytes as an unsigned number.
    pub(crate) fn u32(&mut self, what: &'static str) -> Result<u32, Fault> {
        self.array(what).map(u32::from_le_bytes)
    }

    /// The next eight bytes as a signed number.
    pub(crate) fn i64(&mut self, what: &'static str) -> Result<i64, Fault> {
        self.array(what).map(i64::from_le_bytes)
    }

    /// The next count: four bytes that must not be more than what is left allows at `each` bytes or more.
    ///
    /// So nothing forged can make a list longer than the file itself.
    pub(crate) fn count(&mut self, each: usize, what: &'static str) -> Result<usize, Fault> {
        let count = self.u32(what)? as usize;
        if count.saturating_mul(each) > self.left() {
            return Err(self.truncated(what));
        }
        Ok(count)
    }

    /// The next corner of a box of voxels.
    pub(crate) fn corner(&mut self, what: &'static str) -> Result<[i32; 3], Fault> {
        let mut corner = [0; 3];
        for part in &mut corner {
            *part = self.array(what).map(i32::from_le_bytes)?;
        }
        Ok(corner)
    }

    /// The next text; bytes that are no UTF-8 become replacement characters.
    pub(crate) fn text(&mut self, what: &'static str) -> Result<String, Fault> {
        let length = self.count(1, what)?;
        let bytes = self.take(length, what)?;
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }

    fn truncated(&self, what: &'static str) -> Fault {
        Fault::Truncated {
            what,
            end: self.bytes.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_read_beyond_the_end() {
        let mut cursor = Cursor::new(&[5, 0, 0, 0, 1, 2]);
        let whole = cursor;
        assert!(cursor.take(7, "bytes").is_err());
        assert_eq!(cursor.at(), 0);
        assert!(cursor.text("a name").is_err());
        assert!(cursor.take(usize::MAX, "bytes").is_err());
        assert_eq!(cursor.left(), 2);
        assert!(whole.part(3, 2, "a part").is_err());
        assert!(whole.part(3, 7, "a part").is_err());
        assert_eq!(whole.part(2, 5, "a part").map(|part| part.left()), Ok(3));
    }

    #[test]
    fn a_flag_is_zero_or_one() {
        let mut cursor = Cursor::new(&[0, 1, 2]);
        assert_eq!(cursor.flag("a flag"), Ok(false));
        assert_eq!(cursor.flag("a flag"), Ok(true));
        assert!(cursor.flag("a flag").is_err());
    }
}
