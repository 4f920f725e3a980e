//! Bits of large pictures.

use memmap2::{MmapMut, MmapOptions};
use std::fmt;
use std::ops::{Deref, DerefMut};

/// Bytes from which on pages of the usual size, each of which takes time to be given, are too many.
const LARGE_BYTES: usize = 1 << 18;

/// A large page: the size on x86-64 and most of aarch64. Where it is another, pages are of the usual size.
const PAGE_BYTES: usize = 1 << 21;

/// Words of 64 bits, zero at first: if they are many, in large pages where the system has them.
///
/// A system takes about as long to give a page of 4 kB as to follow 500 pixel edges, and takes it on all threads.
pub(super) struct HugeBuffer {
    memory: Memory,
    len: usize,
}

enum Memory {
    Heap(Vec<u64>),
    /// Words begin at a byte.
    Pages(MmapMut, usize),
}

impl HugeBuffer {
    /// So many zeros.
    pub fn zeros(len: usize) -> Self {
        let bytes = len.saturating_mul(size_of::<u64>());
        let pages = if bytes < LARGE_BYTES {
            None
        } else {
            pages(bytes)
        };
        let memory = pages.unwrap_or_else(|| Memory::Heap(vec![0; len]));
        Self { memory, len }
    }
}

/// Zeros from the start of a large page on; none where the system has no such memory.
fn pages(bytes: usize) -> Option<Memory> {
    let whole = bytes.checked_next_multiple_of(PAGE_BYTES)?;
    // Pages that are not used are not given.
    let map = MmapOptions::new()
        .len(whole.checked_add(PAGE_BYTES)?)
        .map_anon()
        .ok()?;
    // Without them it is memory as well.
    #[cfg(target_os = "linux")]
    let _ = map.advise(memmap2::Advice::HugePage);
    let start = map.as_ptr().align_offset(PAGE_BYTES);
    (start <= PAGE_BYTES).then_some(Memory::Pages(map, start))
}

impl Default for HugeBuffer {
    fn default() -> Self {
        Self::zeros(0)
    }
}

impl Deref for HugeBuffer {
    type Target = [u64];

    #[inline]
    fn deref(&self) -> &[u64] {
        match &self.memory {
            Memory::Heap(words) => words,
            Memory::Pages(map, start) => {
                bytemuck::cast_slice(&map[*start..*start + self.len * size_of::<u64>()])
            }
        }
    }
}

impl DerefMut for HugeBuffer {
    #[inline]
    fn deref_mut(&mut self) -> &mut [u64] {
        match &mut self.memory {
            Memory::Heap(words) => words,
            Memory::Pages(map, start) => {
                bytemuck::cast_slice_mut(&mut map[*start..*start + self.len * size_of::<u64>()])
            }
        }
    }
}

impl Clone for HugeBuffer {
    fn clone(&self) -> Self {
        let mut copy = Self::zeros(self.len);
        copy.copy_from_slice(self);
        copy
    }
}

impl PartialEq for HugeBuffer {
    fn eq(&self, other: &Self) -> bool {
        self[..] == other[..]
    }
}

impl Eq for HugeBuffer {}

impl fmt::Debug for HugeBuffer {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self[..], formatter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_words_are_as_few() {
        let limit = LARGE_BYTES / size_of::<u64>();
        for len in [
            0,
            1,
            limit - 1,
            limit,
            limit + 1,
            PAGE_BYTES / 8,
            PAGE_BYTES / 8 + 1,
        ] {
            let mut words = HugeBuffer::zeros(len);
            assert_eq!(words.len(), len);
            assert!(words.iter().all(|word| *word == 0), "{len}");
            for (number, word) in (1..).zip(words.iter_mut()) {
                *word = number;
            }
            let copy = words.clone();
            assert!(words.iter().copied().eq(1..=len as u64), "{len}");
            assert_eq!(copy, words);
            if let Some(last) = words.last_mut() {
                *last = 0;
                assert_ne!(copy, words);
            }
        }
    }
}
