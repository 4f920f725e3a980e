//! What is costly to prepare, kept in files between runs.
//!
//! Four things cost most of a start: how surfaces bend, where they cut each other, how strokes of hatching lie on them,
//! and how far their normals are calmed. Each is a list of numbers computed from an input; it is kept in a file that is
//! named after the content of this input, so that any change makes it anew. Nothing in a file is trusted: it has to
//! announce its own kind, version, key and length, its checksum has to fit, and the numbers have to be what the program
//! could have made.
//!
//! A header of 64 bytes, its numbers little-endian, then the rows as this machine has them:
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `NPRKEPT` and 0 |
//! | 4, 4 | [`VERSION`], bytes of a row |
//! | 8, 8 | number of rows, 0 |
//! | 16 | key of the input |
//! | 16 | digest of everything else |

use bytemuck::Pod;
use npr_mesh::content_hash::ContentHash;
use std::convert::Infallible;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// Counts up with every change of the layout, or of what is made from the same input.
pub(crate) const VERSION: u32 = 3;

const MAGIC: [u8; 8] = *b"NPRKEPT\0";
const HEADER: usize = 64;
/// Most bytes of a file that are read: a longer one counts as damaged.
const LARGEST: u64 = 1 << 30;

const DIGEST: std::ops::Range<usize> = 48..64;

/// A folder where what is costly to prepare is kept between runs, or none: the default.
///
/// Files are named after the content that they were made from, `KEY.nprcache`; a changed scene gets others. What
/// cannot be read, is damaged or comes from another version is made anew; what cannot be written is not kept. Files
/// appear whole or not at all, and none is ever removed: the folder may be emptied at any time. No drawing depends on
/// it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Cache {
    folder: Option<PathBuf>,
}

impl Cache {
    /// Keeps everything in a folder, where there is one.
    pub fn of(folder: Option<&Path>) -> Self {
        let folder = folder.map(Path::to_owned);
        Self { folder }
    }

    /// Rows that were kept under a key, where they are sound; else what `make` gives, kept from now on.
    ///
    /// `input` hashes everything that `make` reads; it is only called where there is a folder.
    pub fn rows<T: Pod>(
        &self,
        input: impl FnOnce() -> ContentHash,
        is_sound: impl Fn(&[T]) -> bool,
        make: impl FnOnce() -> Vec<T>,
    ) -> Vec<T> {
        let sound = |rows: Vec<T>| is_sound(&rows).then_some(rows);
        let made = self.value(input, sound, Vec::clone, || Ok::<_, Infallible>(make()));
        made.unwrap_or_else(|never| match never {})
    }

    /// As [`Cache::rows`], for a value that is stored as rows and may fail to be made; a failure is not kept.
    ///
    /// `of_rows` reads a value from rows where they are sound, and `to_rows` gives its rows.
    ///
    /// # Errors
    ///
    /// Those of `make`.
    pub fn value<T: Pod, V, E>(
        &self,
        input: impl FnOnce() -> ContentHash,
        of_rows: impl Fn(Vec<T>) -> Option<V>,
        to_rows: impl FnOnce(&V) -> Vec<T>,
        make: impl FnOnce() -> Result<V, E>,
    ) -> Result<V, E> {
        let Some(folder) = &self.folder else {
            return make();
        };
        let key = input().finish();
        let path = folder.join(format!("{key:032x}.nprcache"));
        let kept = read(&path).ok();
        let kept = kept.and_then(|bytes| decode(&bytes, key));
        if let Some(value) = kept.and_then(&of_rows) {
            return Ok(value);
        }
        let value = make()?;
        let rows = to_rows(&value);
        let bytes = encode(&rows, key);
        if of_rows(rows).is_some() {
            // A cache that cannot be written costs time, and nothing else.
            let _ = write(folder, &path, &bytes);
        }
        Ok(value)
    }
}

/// Starts the hash of an input, with what is made from it and the version of the program that makes it.
pub(crate) fn input_of(what: &str) -> ContentHash {
    let mut hash = ContentHash::new();
    // Rows lie as this machine has its numbers.
    hash.numbers(&[VERSION, u32::from_ne_bytes([1, 2, 3, 4])]);
    hash.bytes(what.as_bytes());
    hash
}

/// The content of a file that keeps rows under a key.
fn encode<T: Pod>(rows: &[T], key: u128) -> Vec<u8> {
    let body: &[u8] = bytemuck::cast_slice(rows);
    let mut bytes = Vec::with_capacity(HEADER + body.len());
    bytes.extend_from_slice(&MAGIC);
    bytes.extend_from_slice(&VERSION.to_le_bytes());
    bytes.extend_from_slice(&(size_of::<T>() as u32).to_le_bytes());
    bytes.extend_from_slice(&(rows.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&[0; 8]);
    bytes.extend_from_slice(&key.to_le_bytes());
    bytes.extend_from_slice(&[0; 16]);
    bytes.extend_from_slice(body);
    let digest = digest(&bytes);
    bytes[DIGEST].copy_from_slice(&digest.to_le_bytes());
    bytes
}

/// The rows of a file that is what [`encode`] writes under this key; none of any other.
fn decode<T: Pod>(bytes: &[u8], key: u128) -> Option<Vec<T>> {
    let (head, body) = bytes.split_at_checked(HEADER)?;
    let count = body.len().checked_div(size_of::<T>())?;
    let announced = [
        &MAGIC[..],
        &VERSION.to_le_bytes(),
        &(size_of::<T>() as u32).to_le_bytes(),
        &(count as u64).to_le_bytes(),
        &[0; 8],
        &key.to_le_bytes(),
        &digest(bytes).to_le_bytes(),
    ];
    let is_whole = count * size_of::<T>() == body.len();
    (is_whole && head == announced.concat()).then(|| bytemuck::pod_collect_to_vec(body))
}

/// Digest of all bytes but its own. A single changed byte always changes it.
fn digest(bytes: &[u8]) -> u128 {
    let mut hash = ContentHash::new();
    hash.bytes(&bytes[..DIGEST.start]);
    hash.bytes(&bytes[DIGEST.end..]);
    hash.finish()
}

/// The content of a file, at most [`LARGEST`] bytes of it; an error for what is no file.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    // Opening a pipe would wait for its writer.
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::ErrorKind::InvalidInput.into());
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(LARGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Writes a file beside its place and renames it when whole.
fn write(folder: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = tempfile::Builder::new()
        .prefix(".npr-")
        .tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}

#[cfg(test)]
mod tests;
