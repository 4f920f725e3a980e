//! Chunks packed by blosc.
//!
//! A container of format 2 [Blosc 1.x, README_CHUNK_FORMAT] holds blocks of equal size, each packed on its own, each
//! either whole or split into one stream for every byte of an element; before packing, bytes or bits may be shuffled
//! so that those of equal rank lie together.

mod blosclz;
mod shuffle;
mod zstd;

use crate::cursor::Cursor;
use crate::zlib::{WRONG_SIZE, inflate};
use npr_core::decoding::guard;
use shuffle::{unshuffle_bits, unshuffle_bytes};

/// What is wrong with a container.
type Fault = &'static str;

const CUT: Fault = "its blosc container is cut off";

/// Version of the containers that blosc 1.x writes.
const FORMAT: u8 = 2;

/// Blocks are split only for elements up to this size ...
const MOST_SPLITS: usize = 16;

/// ... and only where every stream gets at least this many bytes.
const LEAST_STREAM_BYTES: usize = 128;

/// The header: how blocks are packed.
#[derive(Debug, Clone, Copy)]
struct Container {
    codec: Codec,
    shuffle: Shuffle,
    is_stored: bool,
    may_split: bool,
    element_bytes: usize,
    block_bytes: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Codec {
    BloscLz,
    Lz4,
    Zlib,
    Zstd,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shuffle {
    None,
    Bytes,
    Bits,
}

/// Unpacks the container `packed`, which must fill `bytes` exactly. `shuffled` is room for a block.
pub(crate) fn unpack(packed: &[u8], bytes: &mut [u8], shuffled: &mut Vec<u8>) -> Result<(), Fault> {
    let mut cursor = Cursor::new(packed);
    let container = Container::read(&mut cursor, packed.len(), bytes.len())?;
    if container.is_stored {
        let stored = cursor.take(bytes.len(), "").map_err(|_| CUT)?;
        bytes.copy_from_slice(stored);
        return Ok(());
    }
    for block in bytes.chunks_mut(container.block_bytes) {
        let start = cursor.u32("").map_err(|_| CUT)? as usize;
        let packed = packed.get(start..).ok_or(CUT)?;
        container.unpack_block(packed, block, shuffled)?;
    }
    Ok(())
}

impl Container {
    fn read(cursor: &mut Cursor, packed_bytes: usize, bytes: usize) -> Result<Self, Fault> {
        // Read the header, and check the sizes that it states.
        let [format, _, flags, element_bytes] = cursor.array("").map_err(|_| CUT)?;
        let mut size = || cursor.u32("").map(|size| size as usize).map_err(|_| CUT);
        let (stated_bytes, block_bytes, stated_packed_bytes) = (size()?, size()?, size()?);
        if format != FORMAT {
            return Err("its blosc container has an unknown format");
        }
        if stated_bytes != bytes || stated_packed_bytes != packed_bytes {
            return Err(WRONG_SIZE);
        }

        // Refuse blocks or elements that would take no bytes.
        let is_stored = flags & 2 != 0;
        if !is_stored && is_tiny(block_bytes, bytes) || element_bytes == 0 {
            return Err("its blosc container has blocks or elements of no size");
        }
        Ok(Self {
            codec: Codec::of_flags(flags)?,
            shuffle: Shuffle::of_flags(flags, element_bytes)?,
            is_stored,
            may_split: flags & 0x10 == 0,
            element_bytes: element_bytes.into(),
            block_bytes: block_bytes.clamp(1, bytes.max(1)),
        })
    }

    /// Unpacks the block at the beginning of `packed`.
    fn unpack_block(
        &self,
        packed: &[u8],
        block: &mut [u8],
        shuffled: &mut Vec<u8>,
    ) -> Result<(), Fault> {
        if self.shuffle == Shuffle::None {
            return self.unpack_streams(packed, block);
        }
        shuffled.clear();
        shuffled.resize(block.len(), 0);
        self.unpack_streams(packed, shuffled)?;
        match self.shuffle {
            Shuffle::Bits => unshuffle_bits(shuffled, self.element_bytes, block),
            _ => unshuffle_bytes(shuffled, self.element_bytes, block),
        }
        Ok(())
    }

    fn unpack_streams(&self, packed: &[u8], block: &mut [u8]) -> Result<(), Fault> {
        let stream_bytes = self.stream_bytes(block.len());
        let mut cursor = Cursor::new(packed);
        for stream in block.chunks_mut(stream_bytes) {
            let size = cursor.u32("").map_err(|_| CUT)? as usize;
            let packed = cursor.take(size, "").map_err(|_| CUT)?;
            // A stream that packing did not make smaller is stored.
            if size == stream.len() {
                stream.copy_from_slice(packed);
            } else {
                self.codec.unpack(packed, stream)?;
            }
        }
        Ok(())
    }

    /// Bytes of each stream of a block. The last block is split only if it is as long as the others.
    fn stream_bytes(&self, block_bytes: usize) -> usize {
        let share = block_bytes
            .checked_div(self.element_bytes)
            .unwrap_or(block_bytes);
        let is_split = self.may_split
            && self.element_bytes <= MOST_SPLITS
            && share >= LEAST_STREAM_BYTES
            && block_bytes == self.block_bytes
            && share.checked_mul(self.element_bytes) == Some(block_bytes);
        if is_split { share } else { block_bytes }
    }
}

/// Whether blocks are smaller than blosc makes them: 128 bytes, or the whole where that is less, rounded down to
/// elements.
///
/// Many tiny blocks would take far longer to unpack than the size of their container tells.
fn is_tiny(block_bytes: usize, bytes: usize) -> bool {
    block_bytes <= bytes.min(128) >> 1 && bytes > 0
}

impl Codec {
    fn of_flags(flags: u8) -> Result<Self, Fault> {
        match flags >> 5 {
            0 => Ok(Self::BloscLz),
            // LZ4HC packs harder into the same format.
            1 => Ok(Self::Lz4),
            2 => Err("it is packed by snappy, which is not read"),
            3 => Ok(Self::Zlib),
            4 => Ok(Self::Zstd),
            _ => Err("its blosc container has an unknown codec"),
        }
    }

    /// Unpacks a stream that must fill `bytes` exactly.
    fn unpack(self, packed: &[u8], bytes: &mut [u8]) -> Result<(), Fault> {
        let length = bytes.len();
        let written = match self {
            Self::BloscLz => blosclz::unpack(packed, bytes),
            Self::Lz4 => guard(|| lz4_flex::block::decompress_into(packed, bytes).ok())
                .ok()
                .flatten(),
            Self::Zlib => return inflate(packed, bytes),
            Self::Zstd => return zstd::unpack(packed, bytes),
        };
        match written {
            Some(written) if written == length => Ok(()),
            Some(_) => Err(WRONG_SIZE),
            None => Err("a stream of its blosc container is broken"),
        }
    }
}

impl Shuffle {
    /// Bytes of single-byte elements have nothing to be sorted by.
    fn of_flags(flags: u8, element_bytes: u8) -> Result<Self, Fault> {
        match (flags & 1 != 0, flags & 4 != 0) {
            (false, false) => Ok(Self::None),
            (true, false) if element_bytes == 1 => Ok(Self::None),
            (true, false) => Ok(Self::Bytes),
            (false, true) => Ok(Self::Bits),
            (true, true) => Err("its blosc container is shuffled twice"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Containers written by blosc 1.21: tests/data/README.md says how.
    const WRITTEN_BY_BLOSC: &[u8] = include_bytes!("../tests/data/blosc_chunks.bin");

    fn even(length: usize) -> Vec<u8> {
        (0..length)
            .map(|k| (k / 300 * (k % 4) + k / 17 % 3) as u8)
            .collect()
    }

    fn noise(length: usize) -> Vec<u8> {
        let mut state = 1u64;
        let mut next = || {
            state = (state * 1_103_515_245 + 12_345) & 0x7fff_ffff;
            (state >> 16) as u8
        };
        (0..length).map(|_| next()).collect()
    }

    /// What each container holds, told by its length.
    fn wanted(length: usize) -> Vec<u8> {
        match length {
            9500 => [noise(9000), noise(500)].concat(),
            200 => noise(200),
            _ => even(length),
        }
    }

    fn containers() -> Vec<&'static [u8]> {
        let mut rest = WRITTEN_BY_BLOSC;
        let mut containers = Vec::new();
        while !rest.is_empty() {
            let size = u32::from_le_bytes(rest[12..16].try_into().unwrap()) as usize;
            containers.push(&rest[..size]);
            rest = &rest[size..];
        }
        containers
    }

    fn length_of(container: &[u8]) -> usize {
        u32::from_le_bytes(container[4..8].try_into().unwrap()) as usize
    }

    #[test]
    fn containers_of_every_codec_and_shuffle_are_unpacked() {
        let (mut codecs, mut shuffles) = ([0; 5], [0; 8]);
        for container in containers() {
            let mut bytes = vec![0; length_of(container)];
            assert_eq!(unpack(container, &mut bytes, &mut Vec::new()), Ok(()));
            assert!(bytes == wanted(bytes.len()), "{:?}", &container[..16]);
            codecs[usize::from(container[2] >> 5)] += 1;
            shuffles[usize::from(container[2] & 7)] += 1;
        }
        assert!(
            [0, 1, 3, 4].iter().all(|&codec| codecs[codec] >= 15),
            "{codecs:?}"
        );
        assert!(
            [0, 1, 4].iter().all(|&kind| shuffles[kind] >= 15),
            "{shuffles:?}"
        );
    }

    #[test]
    fn tiny_blocks_are_refused_unless_nothing_is_packed() {
        let mut stored = vec![2, 1, 0x33, 4, 2, 0, 0, 0, 1, 0, 0, 0, 18, 0, 0, 0, 7, 8];
        let mut bytes = [0; 2];
        // Blosc states blocks of one byte where there is less than an element.
        assert_eq!(unpack(&stored, &mut bytes, &mut Vec::new()), Ok(()));
        assert_eq!(bytes, [7, 8]);
        stored[2] = 0x31;
        assert!(unpack(&stored, &mut bytes, &mut Vec::new()).is_err());
        let cases = [
            (0, 0, false),
            (0, 2048, true),
            (64, 2048, true),
            (65, 2048, false),
            (33, 64, false),
            (32, 64, true),
        ];
        for (block_bytes, bytes, wanted) in cases {
            assert_eq!(
                is_tiny(block_bytes, bytes),
                wanted,
                "{block_bytes} of {bytes}"
            );
        }
    }

    #[test]
    fn a_wrong_length_is_refused() {
        for container in containers() {
            for length in [0, length_of(container) - 1, length_of(container) + 1] {
                assert_eq!(
                    unpack(container, &mut vec![0; length], &mut Vec::new()),
                    Err(WRONG_SIZE)
                );
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, ..ProptestConfig::default() })]

        #[test]
        fn damaged_containers_never_panic(
            which in 0usize..1000,
            changes in prop::collection::vec((any::<usize>(), any::<u8>()), 1..4),
            cut in prop::option::weighted(0.2, any::<usize>()),
        ) {
            let containers = containers();
            let mut container = containers[which % containers.len()].to_vec();
            let length = length_of(&container);
            for (at, byte) in changes {
                let at = if byte & 1 == 0 { at % 24 } else { at % container.len() };
                container[at] = byte;
            }
            if let Some(cut) = cut {
                container.truncate(cut % container.len());
                // The stated size follows, so that what lies behind the header is tried too.
                let size = (container.len() as u32).to_le_bytes();
                container.iter_mut().skip(12).zip(size).for_each(|(byte, new)| *byte = new);
            }
            let _ = unpack(&container, &mut vec![0; length], &mut Vec::new());
        }
    }
}
