//! From a file to a scene.

use std::path::{Path, PathBuf};

use crate::constraining;
use crate::error::SceneError;
use crate::format::Format;
use crate::limits::{self, Allowance, Limits};
use crate::loading::Loading;
use crate::notice::Notices;
use crate::resources::{FolderResources, Resources, read_regular};
use crate::scene::Scene;
use crate::{gltf, obj, ply, soundness, stl};

/// How to load a file.
#[derive(Debug, Clone, Default)]
pub struct LoadOptions {
    /// How large the scene may be.
    pub limits: Limits,
    /// A second folder from which files may be read, besides the scene's own.
    pub allow_external: Option<PathBuf>,
}

/// The scene in the file at `path`.
///
/// The extension names the format; where it is unknown, the content does. Files that the scene refers
/// to must lie below its folder. O(bytes); nothing is read twice.
///
/// # Errors
///
/// [`SceneError`] where the file cannot be read, is broken beyond mending, or exceeds a limit.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Scene, SceneError> {
    let name = path
        .file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy();
    let bytes = read_regular(path, &name, options.limits.file_bytes)?;
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let resources = FolderResources::new(folder, options.allow_external.as_deref())?;
    load_bytes(
        &name,
        &bytes,
        Format::of_path(path),
        &resources,
        &options.limits,
    )
}

/// The scene in `bytes`, whose `name` is used where the file has none of its own.
///
/// Without a `format`, the content decides.
///
/// # Errors
///
/// As [`load`].
pub fn load_bytes(
    name: &str,
    bytes: &[u8],
    format: Option<Format>,
    resources: &dyn Resources,
    limits: &Limits,
) -> Result<Scene, SceneError> {
    // Refuse a file that is too large, or of no known format.
    limits::check(
        "size of a file in bytes",
        bytes.len() as u64,
        limits.file_bytes,
        "--max-file",
    )?;
    let format = format
        .or_else(|| Format::of_content(bytes))
        .ok_or(SceneError::UnknownFormat)?;

    // Read the scene in its own format.
    let mut loading = Loading {
        resources,
        allowance: Allowance::new(*limits),
        notices: Notices::default(),
    };
    let mut scene = match format {
        Format::Glb => gltf::read_glb(bytes, &mut loading)?,
        Format::Gltf => gltf::read_json(bytes, &mut loading)?,
        Format::Obj => obj::read(bytes, &mut loading)?,
        Format::Stl => stl::read(bytes, &mut loading)?,
        Format::Ply => ply::read(bytes, &mut loading)?,
    };

    // Mend what numbers may break, and say what the file is.
    soundness::mend(&mut scene, &mut loading.notices)?;
    constraining::follow(&mut scene, &mut loading.notices);
    if scene.name.is_empty() {
        name.clone_into(&mut scene.name);
    }
    scene.file_bytes = bytes.len() as u64;
    scene.notices = loading.notices.into_list();
    Ok(scene)
}
