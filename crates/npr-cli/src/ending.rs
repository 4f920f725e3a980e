//! Extensions of file names.

use std::path::Path;

/// Whether the extension of `path` is `ending`, in upper or lower case.
pub fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|there| there.eq_ignore_ascii_case(ending))
}
