//! References from a glTF file to other data: data URIs and relative paths.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use npr_core::decoding::guard;
use percent_encoding::percent_decode_str;

use crate::resources::{ResourceError, Resources};

/// Standard base64 whose padding may be missing, as some exporters leave it out.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// The bytes that `uri` stands for.
pub(crate) fn read(
    uri: &str,
    resources: &dyn Resources,
    limit_bytes: u64,
) -> Result<Vec<u8>, ResourceError> {
    match uri.strip_prefix("data:") {
        Some(data) => decode_data(data),
        None => resources.read(&relative_path(uri)?, limit_bytes),
    }
}

/// Tells `resources` of the file that `uri` leads to, without reading it.
pub(crate) fn mention(uri: &str, resources: &dyn Resources) {
    if !uri.starts_with("data:")
        && let Ok(path) = relative_path(uri)
    {
        resources.mention(&path);
    }
}

fn decode_data(data: &str) -> Result<Vec<u8>, ResourceError> {
    let (kind, payload) = data.split_once(',').ok_or(ResourceError::BadData)?;
    if kind.ends_with(";base64") {
        let decoded = guard(|| BASE64.decode(payload));
        return decoded
            .ok()
            .and_then(Result::ok)
            .ok_or(ResourceError::BadData);
    }
    Ok(percent_decode_str(payload).collect())
}

/// The path that `uri` spells, without its percent escapes.
fn relative_path(uri: &str) -> Result<String, ResourceError> {
    let path = percent_decode_str(uri).decode_utf8();
    let path = path.map_err(|_| ResourceError::BadEscape {
        name: uri.to_owned(),
    })?;
    // A colon before the first slash makes a scheme or a drive letter; a backslash is a slash on some
    // systems, and no system keeps files with a zero byte in their name.
    let head = path.split('/').next().unwrap_or_default();
    if head.contains(':') || path.starts_with("//") || path.contains(['\\', '\0']) {
        return Err(ResourceError::Remote {
            name: uri.to_owned(),
        });
    }
    Ok(path.into_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resources::MemoryResources;

    fn read_from_nowhere(uri: &str) -> Result<Vec<u8>, ResourceError> {
        read(uri, &MemoryResources::default(), 100)
    }

    #[test]
    fn data_uris_are_decoded_with_and_without_padding() {
        for uri in [
            "data:application/octet-stream;base64,AQI=",
            "data:;base64,AQI",
            "data:,%01%02",
        ] {
            assert_eq!(read_from_nowhere(uri), Ok(vec![1, 2]), "{uri}");
        }
        assert_eq!(
            read_from_nowhere("data:;base64,*"),
            Err(ResourceError::BadData)
        );
        assert_eq!(
            read_from_nowhere("data:nothing"),
            Err(ResourceError::BadData)
        );
    }

    #[test]
    fn schemes_and_drives_are_refused_behind_escapes_too() {
        for uri in [
            "http://a/b",
            "file:///etc/passwd",
            "C:/x",
            "//host/x",
            "file%3a///x",
            "..%5cx",
            "a%00",
        ] {
            assert!(
                matches!(read_from_nowhere(uri), Err(ResourceError::Remote { .. })),
                "{uri}"
            );
        }
        assert!(matches!(
            read_from_nowhere("a%ff"),
            Err(ResourceError::BadEscape { .. })
        ));
    }

    #[test]
    fn escapes_are_undone_before_the_folder_is_asked() {
        assert_eq!(relative_path("my%20mesh.bin"), Ok("my mesh.bin".to_owned()));
        assert_eq!(relative_path("%2e%2e/x"), Ok("../x".to_owned()));
        assert_eq!(relative_path("100%"), Ok("100%".to_owned()));
    }
}
