//! File names with a place for a number: `smoke_####.png`.

use std::path::{Path, PathBuf};

/// A path whose file name has a run of `#`, which stands for a number with leading zeros.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Numbered {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl Numbered {
    /// The pattern that a path is; none if its name has no `#`. Of several runs the last is the number.
    pub fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let end = name.rfind('#')? + 1;
        let before = name[..end].trim_end_matches('#');
        Some(Self {
            folder: path.parent().unwrap_or(Path::new("")).to_owned(),
            before: before.to_owned(),
            digits: end - before.len(),
            after: name[end..].to_owned(),
        })
    }

    /// The path with a number in it, wider than the pattern where it has more digits.
    pub fn path(&self, number: u32) -> PathBuf {
        let (before, after, digits) = (&self.before, &self.after, self.digits);
        self.folder
            .join(format!("{before}{number:0digits$}{after}"))
    }

    /// The numbers of the files that there are, lowest and highest; none where there is no file.
    pub fn found(&self) -> Option<(u32, u32)> {
        let is_named = !self.folder.as_os_str().is_empty();
        let folder = if is_named {
            &self.folder
        } else {
            Path::new(".")
        };
        let entries = std::fs::read_dir(folder).ok()?.flatten();
        let numbers = entries.filter_map(|entry| self.number_in(entry.file_name().to_str()?));
        numbers.fold(None, |range, number| {
            let (low, high) = range.unwrap_or((number, number));
            Some((low.min(number), high.max(number)))
        })
    }

    /// The number that a file of this pattern has.
    fn number_in(&self, name: &str) -> Option<u32> {
        let rest = name.strip_prefix(self.before.as_str())?;
        let digits = rest.strip_suffix(self.after.as_str())?;
        let number = digits.parse().ok()?;
        let own = self.path(number);
        (own.file_name()?.to_str()? == name).then_some(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(pattern: &str, number: u32) -> Option<PathBuf> {
        Some(Numbered::of(Path::new(pattern))?.path(number))
    }

    #[test]
    fn numbers_stand_where_the_marks_stood() {
        assert_eq!(path("a/s_####.png", 7), Some("a/s_0007.png".into()));
        assert_eq!(path("s#", 123), Some("s123".into()));
        assert_eq!(path("#1_##.vdb", 5), Some("#1_05.vdb".into()));
        assert_eq!(path("##é.vdb", 5), Some("05é.vdb".into()));
        assert_eq!(path("a##/plain.png", 1), None);
    }

    #[test]
    fn files_of_a_series_are_found_by_their_numbers() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in [
            "p_03.vdb", "p_11.vdb", "p_4.vdb", "p_x.vdb", "q_99.vdb", "p_+5.vdb",
        ] {
            std::fs::File::create_new(folder.path().join(name)).expect("made");
        }
        let found = |pattern: &str| Numbered::of(&folder.path().join(pattern))?.found();
        assert_eq!(found("p_##.vdb"), Some((3, 11)));
        assert_eq!(found("r_##.vdb"), None);
    }
}
