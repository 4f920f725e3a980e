//! Broken files give an error or a sound scene, soon, and never a panic.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use npr_scene::{LoadOptions, load};

/// Extensions of scenes, and one of a format that is not read.
const EXTENSIONS: [&str; 7] = ["gltf", "glb", "vrm", "obj", "stl", "ply", "off"];

/// Files that cannot be drawn, and a piece of the message that says why.
const REFUSED: &[(&str, &str)] = &[
    ("assimp/BoxWithInfinites.glb", "not finite"),
    (
        "assimp/IndexOutOfRange.gltf",
        "cannot read 'IndexOutOfRange.bin'",
    ),
    ("assimp/NoScene.gltf", "only 0 scenes"),
    ("assimp/OutOfMemory.off", "format"),
    ("assimp/RecursiveNodes.gltf", "nodes must form a tree"),
    ("assimp/badArray.gltf", "line"),
    ("assimp/badNumber.gltf", "line"),
    (
        "assimp/missing_bin_BoxTextured.gltf",
        "cannot read 'BoxTextured0.bin'",
    ),
    ("assimp/sceneWrongType.gltf", "line"),
    ("gltf/asset/1_0_version.gltf", "version"),
    ("gltf/asset/min_version_invalid.gltf", "version"),
    ("gltf/buffer/not_found.gltf", "cannot read"),
    ("gltf/glb/chunk_too_big.glb", "ends at byte"),
    ("gltf/glb/invalid_magic.glb", "glTF"),
    ("gltf/glb/invalid_version.glb", "version"),
    ("gltf/glb/no_header.glb", ""),
    ("gltf/glb/truncated_chunk_data.glb", "ends at byte"),
    ("gltf/glb/truncated_chunk_header.glb", "ends at byte"),
    ("gltf/glb/two_empty_json_chunks.glb", "JSON"),
    ("gltf/glb/zero_length.glb", "ends at byte"),
    ("gltf/node/node_loop_scene.gltf", "nodes must form a tree"),
    ("made/obj_index_out_of_range.obj", "line"),
    ("made/obj_zero_index.obj", "line"),
    ("made/ply_truncated.ply", "cut off"),
    (
        "made/stl_count_too_large.stl",
        "announces 4294967295 triangles, but the file holds only 4",
    ),
    ("made/stl_truncated_facet.stl", ""),
    ("trimesh/notenoughindices.obj", "line"),
    (
        "assimp/crash-30d6d0f7c529b3b66b4131700b7a4580cd7082df.ply",
        "",
    ),
    ("gltf/root/undefined_used_extensions.gltf", "required"),
    ("gltf/mesh_data/index_buffer_oob.gltf", "uses vertex"),
];

/// Files with faults that do not keep them from being drawn.
const TOLERATED: &[&str] = &[
    "trimesh/negative_indices.obj",
    "trimesh/nancolor.obj",
    "trimesh/obj_wireframe.obj",
    "trimesh/ply_empty_header.ply",
    "trimesh/stl_empty_bin.stl",
    "made/vrm1_bone_node_out_of_range.vrm",
    "made/vrm1_expression_bad_morph_index.vrm",
    "made/vrm1_missing_humanoid.vrm",
];

fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/malformed");
    if !folder.is_dir() {
        eprintln!("skipped: the shared malformed files are not beside this checkout");
        return None;
    }
    Some(folder)
}

fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path)
            } else {
                files.push(path)
            }
        }
    }
    files.sort();
    files
}

fn is_scene(path: &Path) -> bool {
    path.extension()
        .is_some_and(|extension| EXTENSIONS.iter().any(|known| extension == *known))
}

#[test]
fn every_file_ends_in_a_short_error_or_a_sound_scene() {
    let Some(folder) = folder() else { return };
    for path in files_below(&folder)
        .into_iter()
        .filter(|path| is_scene(path))
    {
        let start = Instant::now();
        match load(&path, &LoadOptions::default()) {
            Ok(scene) => scene.sanity_check(),
            Err(fault) => {
                let text = fault.to_string();
                assert!(
                    text.len() < 300 && !text.contains('\n') && !text.ends_with('.'),
                    "{text}"
                );
                assert!(!text.contains("::") && !text.contains("usize"), "{text}");
            }
        }
        assert!(
            start.elapsed() < Duration::from_secs(5),
            "{} took too long",
            path.display()
        );
    }
}

#[test]
fn files_that_cannot_be_drawn_say_why() {
    let Some(folder) = folder() else { return };
    for (name, reason) in REFUSED {
        let fault = load(&folder.join(name), &LoadOptions::default());
        let text = fault
            .err()
            .unwrap_or_else(|| panic!("{name} was loaded"))
            .to_string();
        assert!(text.contains(reason), "{name}: {text}");
    }
}

#[test]
fn files_that_can_be_drawn_are() {
    let Some(folder) = folder() else { return };
    for name in TOLERATED {
        let scene = load(&folder.join(name), &LoadOptions::default());
        if let Err(fault) = scene {
            panic!("{name}: {fault}");
        }
    }
}
