//! Shapes kept in files between runs.

use super::assembly::{Assembly, Placed};
use super::options::LineModelOptions;
use npr_core::shape::{Shape, Surface};
use npr_mesh::shape::PlacedMesh;
use npr_mesh::shape_cache::{decode, encode, shape_key};
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

/// The shape of an assembly: from the folder where a sound file for it lies there, else by `build`, and kept.
pub(crate) fn shape(
    assembly: &Assembly,
    options: &LineModelOptions,
    folder: &Path,
    build: impl FnOnce(Vec<Surface>) -> Shape,
) -> Shape {
    // Names and colours change no geometry.
    let surfaces = assembly.plain_surfaces();
    let meshes: Vec<PlacedMesh<'_>> = assembly.meshes.iter().map(Placed::view).collect();
    let key = shape_key(&surfaces, &meshes, options.weld);
    let path = folder.join(format!("{key:032x}.nprcache"));
    let kept = read(&path, options.memory_limit).ok();
    if let Some(shape) = kept.and_then(|bytes| decode(&bytes, key).ok()) {
        return shape;
    }
    let shape = build(surfaces);
    // A cache that cannot be written costs time, and nothing else.
    let _ = write(folder, &path, &encode(&shape, key));
    shape
}

/// The content of a file, unless it is beyond a limit or no file.
fn read(path: &Path, limit_bytes: u64) -> io::Result<Vec<u8>> {
    // Opening a pipe would wait for its writer.
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::ErrorKind::InvalidInput.into());
    }
    let mut bytes = Vec::new();
    File::open(path)?
        .take(limit_bytes)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Writes a file beside its place and renames it when whole.
fn write(folder: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = tempfile::Builder::new()
        .prefix(".npr-")
        .tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path)?;
    Ok(())
}
