//! Why a file was not loaded.

use crate::gltf::GltfError;
use crate::limits::LimitError;
use crate::obj::ObjError;
use crate::ply::PlyError;
use crate::resources::ResourceError;
use crate::stl::StlError;

/// Why a file was not loaded.
///
/// Messages are one line without the file's own name, which the caller puts before them.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The file, or one it refers to, was not read.
    #[error(transparent)]
    Resource(#[from] ResourceError),
    /// The file asks for more than a limit allows.
    #[error(transparent)]
    Limit(#[from] LimitError),
    /// Neither name nor content tell a known format.
    #[error("the format is none of glTF, VRM, OBJ, STL and PLY")]
    UnknownFormat,
    /// A glTF or VRM file is broken or needs what is not supported.
    #[error(transparent)]
    Gltf(#[from] GltfError),
    /// An OBJ file is broken.
    #[error(transparent)]
    Obj(#[from] ObjError),
    /// An STL file is broken.
    #[error(transparent)]
    Stl(#[from] StlError),
    /// A PLY file is broken.
    #[error(transparent)]
    Ply(#[from] PlyError),
    /// Every triangle uses a position that is not finite or out of range.
    #[error("all {triangle_count} triangles use positions that are not finite or out of range")]
    NothingFinite {
        /// How many triangles the file has.
        triangle_count: usize,
    },
    /// The file has lines and no triangles, and every line uses such a position.
    #[error("all {segment_count} line segments use positions that are not finite or out of range")]
    NoFiniteLine {
        /// How many segments the file has.
        segment_count: usize,
    },
}

impl SceneError {
    /// Whether the file may be sound but exceeds a safety limit, which an option lifts.
    pub fn is_limit(&self) -> bool {
        matches!(
            self,
            Self::Limit(_) | Self::Resource(ResourceError::TooLarge(_))
        )
    }
}
