//! Reads whole files and standard input, up to a limit.

use crate::fault::{Exit, Fault};
use crate::message::quoted;
use npr_scene::LimitError;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The bytes of the regular file at `path`, at most `limit_bytes` of them.
///
/// A file that cannot be opened is a failure (exit 1); what is no file at all, such as a folder or a
/// device, is invalid input (exit 3); too large a file hits a limit (exit 5).
pub fn read_file(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, Fault> {
    read_regular(path, limit_bytes)
        .map_err(|fault| fault.while_doing(format_args!("cannot read {}", quoted(path))))
}

fn read_regular(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, Fault> {
    let (file, _) = regular_file(path)?;
    read_limited(file, limit_bytes)
}

/// Opens the regular file at `path`, and gives its length in bytes.
pub fn regular_file(path: &Path) -> Result<(File, u64), Fault> {
    // Opening a pipe would wait for its writer, so the kind is asked first.
    let about = std::fs::metadata(path)?;
    if !about.is_file() {
        return Err(Fault::new(Exit::Input, "it is not a regular file"));
    }
    Ok((File::open(path)?, about.len()))
}

/// All bytes of standard input, at most `limit_bytes` of them.
pub fn read_standard(limit_bytes: u64) -> Result<Vec<u8>, Fault> {
    read_limited(std::io::stdin().lock(), limit_bytes)
        .map_err(|fault| fault.while_doing("cannot read standard input"))
}

fn read_limited(reader: impl Read, limit_bytes: u64) -> Result<Vec<u8>, Fault> {
    let mut bytes = Vec::new();
    let value = reader
        .take(limit_bytes.saturating_add(1))
        .read_to_end(&mut bytes)? as u64;
    if value <= limit_bytes {
        return Ok(bytes);
    }
    let what = "size of a file in bytes".to_owned();
    let limit = LimitError {
        what,
        value,
        limit: limit_bytes,
        option: "--max-file",
    };
    Err(Fault::new(Exit::Limit, limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_byte_beyond_the_limit_is_refused() {
        assert_eq!(read_limited(&b"12345"[..], 5), Ok(b"12345".to_vec()));
        let fault = read_limited(&b"123456"[..], 5).expect_err("six bytes");
        assert_eq!(fault.exit, Exit::Limit);
        assert!(fault.message.contains("--max-file"), "{}", fault.message);
    }
}
