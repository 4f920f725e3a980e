//! Endings of file names.

use std::path::Path;

/// Whether the name of a file ends in a dot and `ending`, in any case.
pub fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|there| there.eq_ignore_ascii_case(ending))
}
