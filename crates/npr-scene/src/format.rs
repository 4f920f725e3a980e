//! Which format a file has.

use std::path::Path;

/// A file format of scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// glTF 2.0 in one binary file; also VRM 0.x and 1.0, and VRM animations.
    Glb,
    /// glTF 2.0 as JSON text.
    Gltf,
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography, binary or text.
    Stl,
    /// Polygon file format, binary or text.
    Ply,
}

/// Words that open a line of an OBJ file, with the space that must follow.
const OBJ_WORDS: [&[u8]; 8] = [
    b"v ", b"vn ", b"vt ", b"f ", b"o ", b"g ", b"mtllib ", b"usemtl ",
];

impl Format {
    /// The format that the extension of `path` names, if any.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "glb" | "vrm" | "vrma" => Some(Self::Glb),
            "gltf" => Some(Self::Gltf),
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            _ => None,
        }
    }

    /// The format that the first bytes suggest, if any.
    pub fn of_content(bytes: &[u8]) -> Option<Self> {
        let text = bytes.trim_ascii_start();
        if bytes.starts_with(b"glTF") {
            Some(Self::Glb)
        } else if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Some(Self::Ply)
        } else if crate::stl::binary::is_binary(bytes) || text.starts_with(b"solid") {
            Some(Self::Stl)
        } else if text.starts_with(b"{") {
            Some(Self::Gltf)
        } else {
            looks_like_obj(bytes).then_some(Self::Obj)
        }
    }
}

/// Whether the first line that is neither blank nor a comment opens with a word of OBJ.
fn looks_like_obj(bytes: &[u8]) -> bool {
    let lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    let first = lines
        .take(1000)
        .find(|line| !line.is_empty() && !line.starts_with(b"#"));
    first.is_some_and(|line| OBJ_WORDS.iter().any(|word| line.starts_with(word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_are_known_in_either_case() {
        assert_eq!(Format::of_path(Path::new("a/b.VRM")), Some(Format::Glb));
        assert_eq!(Format::of_path(Path::new("b.obj")), Some(Format::Obj));
        assert_eq!(Format::of_path(Path::new("glb")), None);
    }

    #[test]
    fn content_tells_formats_apart() {
        let cases: [(&[u8], Option<Format>); 7] = [
            (b"glTF\x02\0\0\0", Some(Format::Glb)),
            (b"  {\"asset\":{}}", Some(Format::Gltf)),
            (b"ply\nformat ascii 1.0\n", Some(Format::Ply)),
            (b"solid cube\nfacet", Some(Format::Stl)),
            (b"# made by hand\n\nv 0 0 0\n", Some(Format::Obj)),
            (b"OFF\n3 1 0\n", None),
            (b"", None),
        ];
        for (bytes, format) in cases {
            assert_eq!(Format::of_content(bytes), format, "{bytes:?}");
        }
    }
}
