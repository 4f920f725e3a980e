//! The sources of volumes, and the preset that suits each.

use npr_smoke::Source;
use npr_smoke::film::Numbered;
use std::path::{Path, PathBuf};

/// The preset for sources that have no preset of their own.
pub const USUAL_STYLE: &str = "smoke-cel-2";

/// The preset that suits a source.
pub fn usual_style(source: &VolumeSource) -> &'static str {
    match source {
        VolumeSource::BuiltIn(Source::Explosion) => "explosion",
        VolumeSource::BuiltIn(Source::Cloud) => "cloud",
        _ => USUAL_STYLE,
    }
}

/// The source of a volume.
#[derive(Debug, Clone, PartialEq)]
pub enum VolumeSource {
    /// The built-in simulation.
    BuiltIn(Source),
    /// One file.
    File(PathBuf),
    /// A numbered series of files.
    Series(Numbered),
    /// The name for messages, and the bytes, of a file that was read already.
    Read(String, Vec<u8>),
}

impl VolumeSource {
    /// The source that a name stands for: a built-in one, a series if there is a `#` in it, or a file.
    pub fn of(name: &Path) -> Self {
        let built_in = name.to_str().and_then(Source::of_name);
        let series = || Numbered::of(name).map(Self::Series);
        built_in
            .map(Self::BuiltIn)
            .or_else(series)
            .unwrap_or_else(|| Self::File(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_where_smoke_comes_from() {
        let of = |name: &str| VolumeSource::of(Path::new(name));
        assert_eq!(of("cloud"), VolumeSource::BuiltIn(Source::Cloud));
        assert_eq!(of("./cloud"), VolumeSource::File("./cloud".into()));
        assert_eq!(of("a.vdb"), VolumeSource::File("a.vdb".into()));
        assert!(matches!(of("a_##.vdb"), VolumeSource::Series(_)));
    }
}
