//! `cargo xtask snapshots bless FILTER`: makes what is drawn now the reference, for snapshots whose name holds the
//! filter.

use std::path::Path;

use anyhow::{Result, ensure};

use crate::packages::cargo;

/// Draws the snapshots anew and overwrites those that differ and whose name contains `filter`; each is named.
///
/// There is no way to bless all at once: the filter must not be empty.
pub fn bless(root: &Path, filter: &str) -> Result<()> {
    ensure!(!filter.is_empty(), "name what to bless");
    let status = cargo(root)
        .args(["test", "--package", "npr-tests", "--test", "frames"])
        .args(["--", "snapshots::", "--show-output"])
        .env("NPR_BLESS", filter)
        .status()?;
    ensure!(
        status.success(),
        "other snapshots differ, or the tests do not build"
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_filter_blesses_nothing() {
        assert!(bless(Path::new("."), "").is_err());
    }
}
