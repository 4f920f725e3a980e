//! The binary container: a header of 12 bytes and chunks [glTF 2.0, section 4].
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use super::error::GltfError;

const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// The two chunks that matter.
#[derive(Debug, PartialEq)]
pub(crate) struct Container<'a> {
    /// The JSON text.
    pub(crate) json: &'a [u8],
    /// The first buffer, where the file holds it.
    pub(crate) bin: Option<&'a [u8]>,
}

impl<'a> Container<'a> {
    /// Splits `file`; bytes after its stated length and chunks of other kinds are skipped.
    pub(crate) fn parse(file: &'a [u8]) -> Result<Self, GltfError> {
        let (magic, rest) = file.split_first_chunk::<4>().ok_or(GltfError::NotGlb)?;
        if magic != b"glTF" {
            return Err(GltfError::NotGlb);
        }
        let (version, rest) = take_u32(rest).ok_or_else(|| truncated("the header", 12, file))?;
        let (length, _) = take_u32(rest).ok_or_else(|| truncated("the header", 12, file))?;
        if version != 2 {
            return Err(GltfError::ContainerVersion { version });
        }
        let whole = file.get(..length as usize);
        let whole = whole.ok_or_else(|| truncated("the container", u64::from(length), file))?;
        let chunks = whole
            .get(12..)
            .ok_or_else(|| truncated("the header", 12, whole))?;
        Self::of_chunks(chunks, whole)
    }

    fn of_chunks(chunks: &'a [u8], whole: &'a [u8]) -> Result<Self, GltfError> {
        let (first, mut rest) = Chunk::split(chunks, whole)?;
        if first.kind != JSON {
            return Err(GltfError::NoJson);
        }
        let mut bin = None;
        while !rest.is_empty() && bin.is_none() {
            let (chunk, after) = Chunk::split(rest, whole)?;
            bin = (chunk.kind == BIN).then_some(chunk.bytes);
            rest = after;
        }
        Ok(Self {
            json: first.bytes,
            bin,
        })
    }
}

struct Chunk<'a> {
    kind: u32,
    bytes: &'a [u8],
}

impl<'a> Chunk<'a> {
    /// The first chunk of `bytes`, which end where `whole` ends, and what follows it.
    fn split(bytes: &'a [u8], whole: &[u8]) -> Result<(Self, &'a [u8]), GltfError> {
        let start = (whole.len() as u64).saturating_sub(bytes.len() as u64);
        let cut = |part, size: u64| truncated(part, start.saturating_add(size), whole);
        let header = take_u32(bytes).and_then(|(length, rest)| Some((length, take_u32(rest)?)));
        let (length, (kind, rest)) = header.ok_or_else(|| cut("a chunk's header", 8))?;
        let split = rest.split_at_checked(length as usize);
        let (bytes, after) =
            split.ok_or_else(|| cut("a chunk", u64::from(length).saturating_add(8)))?;
        Ok((Self { kind, bytes }, after))
    }
}

fn take_u32(bytes: &[u8]) -> Option<(u32, &[u8])> {
    let (number, rest) = bytes.split_first_chunk::<4>()?;
    Some((u32::from_le_bytes(*number), rest))
}

fn truncated(part: &'static str, end: u64, file: &[u8]) -> GltfError {
    GltfError::Truncated {
        part,
        end,
        file_bytes: file.len() as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{glb, glb_chunk};

    #[test]
    fn both_chunks_are_found() {
        let file = glb("{}", b"1234");
        let container = Container::parse(&file).expect("a sound container");
        assert_eq!(container.json, b"{}  ");
        assert_eq!(container.bin, Some(&b"1234"[..]));
    }

    #[test]
    fn every_cut_is_an_error_and_none_a_panic() {
        let file = glb("{}", b"1234");
        for end in 0..file.len() {
            assert!(
                Container::parse(file.get(..end).expect("in range")).is_err(),
                "cut at {end}"
            );
        }
    }

    #[test]
    fn the_message_says_where_a_chunk_would_end() {
        let mut file = b"glTF\x02\0\0\0\x18\0\0\0".to_vec();
        file.extend(glb_chunk(JSON, b"1234"));
        file.splice(12..16, 100u32.to_le_bytes());
        let fault = Container::parse(&file).expect_err("the chunk is too long");
        assert_eq!(
            fault.to_string(),
            "a chunk ends at byte 120, but the file has only 24"
        );
    }

    #[test]
    fn a_file_of_version_1_is_refused() {
        let mut file = glb("{}", b"");
        file.splice(4..8, 1u32.to_le_bytes());
        assert_eq!(
            Container::parse(&file),
            Err(GltfError::ContainerVersion { version: 1 })
        );
    }
}
