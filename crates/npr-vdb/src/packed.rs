//! Values of one node as files store them: without inactive ones where a few numbers say all.

use crate::chunk::{Compression, Room};
use crate::cursor::Cursor;
use crate::fault::Fault;
use crate::mask::Mask;
use crate::voxel::{Number, ValueType, Voxel};

/// From this version on a byte before each node's values says how inactive ones are left out.
pub(crate) const MASKS_VERSION: u32 = 222;

/// How a grid's values are stored.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Codec {
    /// Of the file format.
    pub(crate) version: u32,
    /// How chunks are packed.
    pub(crate) compression: Compression,
    /// What voxels hold.
    pub(crate) kind: ValueType,
    /// Whether chunks hold half floats; single values never do.
    pub(crate) is_half: bool,
}

/// How inactive values of a node are left out, as its byte says.
///
/// Without a mask all are the first one; with a mask, a set bit chooses the second.
struct Inactive<'a, V> {
    first: V,
    second: V,
    mask: Option<Mask<'a>>,
}

/// Where a node may hold other than the background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Others {
    /// At active places only.
    Active,
    /// Anywhere.
    Anywhere,
}

/// Where values are unpacked. Kept from node to node, at most some megabytes.
#[derive(Debug)]
pub(crate) struct Unpacked<V> {
    room: Room,
    numbers: Vec<f32>,
    /// The values as stored.
    pub(crate) stored: Vec<V>,
    /// All values of the node, the left out ones among them.
    pub(crate) values: Vec<V>,
}

impl<V> Default for Unpacked<V> {
    fn default() -> Self {
        Self {
            room: Room::default(),
            numbers: Vec::new(),
            stored: Vec::new(),
            values: Vec::new(),
        }
    }
}

impl Codec {
    /// Bytes of a value that stands alone.
    pub(crate) fn single_bytes<V: Voxel>(&self) -> usize {
        self.kind.number(false).bytes().saturating_mul(V::COUNT)
    }

    /// The next value that stands alone.
    pub(crate) fn single<V: Voxel>(&self, cursor: &mut Cursor) -> Result<V, Fault> {
        let bytes = cursor.take(self.single_bytes::<V>(), "a value")?;
        let (mut numbers, mut voxels) = (Vec::new(), Vec::new());
        self.kind.number(false).decode(bytes, &mut numbers);
        V::gather(&numbers, &mut voxels);
        Ok(voxels.first().copied().unwrap_or(V::ZERO))
    }

    /// The next `count` values, all of them stored, into `unpacked.stored`.
    pub(crate) fn all<V: Voxel>(
        &self,
        count: usize,
        cursor: &mut Cursor,
        unpacked: &mut Unpacked<V>,
    ) -> Result<(), Fault> {
        let number = self.kind.number(self.is_half);
        unpacked.stored.clear();
        // Of half floats nothing is written at all, where there are none; of others an empty chunk.
        if count == 0 && number == Number::Half {
            return Ok(());
        }
        let length = count
            .saturating_mul(V::COUNT)
            .saturating_mul(number.bytes());
        let bytes = self.compression.chunk(length, cursor, &mut unpacked.room)?;
        number.decode(bytes, &mut unpacked.numbers);
        V::gather(&unpacked.numbers, &mut unpacked.stored);
        Ok(())
    }

    /// The values of the next node, one for every bit of `active`, into `unpacked.values`.
    pub(crate) fn node<V: Voxel>(
        &self,
        active: Mask,
        background: V,
        cursor: &mut Cursor,
        unpacked: &mut Unpacked<V>,
    ) -> Result<Others, Fault> {
        // Read all values where none are left out.
        let inactive = match self.version < MASKS_VERSION {
            true => None,
            false => self.inactive(active.len(), background, cursor)?,
        };
        let Some(inactive) = inactive else {
            self.all(active.len(), cursor, unpacked)?;
            std::mem::swap(&mut unpacked.values, &mut unpacked.stored);
            return Ok(Others::Anywhere);
        };

        // Read the active values, and put one of two values everywhere else.
        self.all(active.count_on(), cursor, unpacked)?;
        let Unpacked { stored, values, .. } = unpacked;
        values.clear();
        values.resize(active.len(), inactive.first);
        let chosen = inactive.mask.into_iter().flat_map(Mask::places);
        let chosen = chosen.map(|place| (place, inactive.second));
        for (place, value) in chosen.chain(active.places().zip(stored.iter().copied())) {
            if let Some(slot) = values.get_mut(place) {
                *slot = value;
            }
        }

        // Tell whether anything but active values differs from the background.
        let is_plain = inactive.first.is_same(&background) && inactive.mask.is_none();
        Ok(if is_plain {
            Others::Active
        } else {
            Others::Anywhere
        })
    }

    /// How the next node leaves out inactive values; nothing where it does not.
    fn inactive<'a, V: Voxel>(
        &self,
        len: usize,
        background: V,
        cursor: &mut Cursor<'a>,
    ) -> Result<Option<Inactive<'a, V>>, Fault> {
        const WHAT: &str = "a node's values";

        // Read which two values stand for the inactive ones.
        let at = cursor.at();
        let kind = cursor.byte(WHAT)?;
        let opposite = self.opposite(background);
        let first = match kind {
            0 => background,
            1 | 3 => opposite,
            2 | 4 | 5 => self.single(cursor)?,
            6 => return Ok(None),
            _ => {
                return Err(Fault::Broken {
                    what: WHAT,
                    at,
                    fault: "there is no such way to leave out inactive ones",
                });
            }
        };
        let second = match kind {
            5 => self.single(cursor)?,
            _ => background,
        };

        // Read which of them take the second value.
        let mask = match kind {
            3..=5 => Some(Mask(cursor.take(len >> 3, WHAT)?)),
            _ => None,
        };
        let inactive = Inactive {
            first,
            second,
            mask,
        };
        Ok(Some(inactive).filter(|_| self.compression.leaves_out_inactive))
    }

    /// What inactive voxels inside of a level set hold.
    fn opposite<V: Voxel>(&self, background: V) -> V {
        match self.kind {
            ValueType::Bool => background.map(|value| 1.0 - value),
            _ => background.map(|value| -value),
        }
    }
}
