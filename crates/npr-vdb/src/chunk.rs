//! Runs of bytes, stored plainly or packed.

use crate::blosc;
use crate::cursor::Cursor;
use crate::fault::Fault;
use crate::zlib::{WRONG_SIZE, inflate};

/// How chunks of a grid are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Compression {
    packing: Packing,
    /// Whether inactive values are left out where a few of them say all.
    pub(crate) leaves_out_inactive: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Packing {
    Plain,
    Zip,
    Blosc,
}

/// Bits of the flags that a file states for each grid.
const ZIP: u32 = 1;
const ACTIVE_MASK: u32 = 2;
const BLOSC: u32 = 4;

impl Compression {
    /// What the flags of a grid say; nothing if one of them is unknown. Blosc goes before zip where both are set.
    pub(crate) fn of_flags(flags: u32) -> Option<Self> {
        let packing = match flags {
            _ if flags & BLOSC != 0 => Packing::Blosc,
            _ if flags & ZIP != 0 => Packing::Zip,
            _ => Packing::Plain,
        };
        let known = flags & !(ZIP | ACTIVE_MASK | BLOSC) == 0;
        known.then_some(Self {
            packing,
            leaves_out_inactive: flags & ACTIVE_MASK != 0,
        })
    }

    /// What files before version 222 say for all their grids.
    pub(crate) fn of_whole_file(is_zipped: bool) -> Self {
        Self {
            packing: if is_zipped {
                Packing::Zip
            } else {
                Packing::Plain
            },
            leaves_out_inactive: false,
        }
    }

    /// The next chunk, which holds `length` bytes once it is unpacked; `room` is where they may be put.
    pub(crate) fn chunk<'s, 'a: 's>(
        self,
        length: usize,
        cursor: &mut Cursor<'a>,
        room: &'s mut Room,
    ) -> Result<&'s [u8], Fault> {
        const WHAT: &str = "a chunk of values";
        if self.packing == Packing::Plain {
            return cursor.take(length, WHAT);
        }
        let at = cursor.at();
        let broken = |fault| Fault::Broken {
            what: WHAT,
            at,
            fault,
        };
        // A size that is not positive says that packing did not pay.
        let stated = cursor.i64(WHAT)?;
        let size = usize::try_from(stated.unsigned_abs()).unwrap_or(usize::MAX);
        if stated <= 0 {
            let fits = size == length;
            return if fits {
                cursor.take(length, WHAT)
            } else {
                Err(broken(WRONG_SIZE))
            };
        }
        let packed = cursor.take(size, WHAT)?;
        room.unpacked.clear();
        room.unpacked.resize(length, 0);
        match self.packing {
            Packing::Blosc => blosc::unpack(packed, &mut room.unpacked, &mut room.shuffled),
            _ => inflate(packed, &mut room.unpacked),
        }
        .map_err(broken)?;
        Ok(&room.unpacked)
    }
}

/// Where chunks are unpacked: at most the values of one node, some hundred kilobytes.
#[derive(Debug, Default)]
pub(crate) struct Room {
    unpacked: Vec<u8>,
    shuffled: Vec<u8>,
}
