//! glTF 2.0 and VRM files.
//!
//! The JSON text is deserialised into the types of the `gltf` crate, then every index, range and
//! number is checked here; that crate's own readers panic on damaged files.

pub(crate) mod accessor;
pub(crate) mod buffers;
pub(crate) mod clip;
pub(crate) mod constraint;
pub(crate) mod container;
pub(crate) mod document;
pub(crate) mod error;
pub(crate) mod figure;
pub(crate) mod light;
pub(crate) mod look_at;
pub(crate) mod material;
pub(crate) mod mesh;
pub(crate) mod primitive;
pub(crate) mod skin;
pub(crate) mod spring;
pub(crate) mod texture;
pub(crate) mod toon;
pub(crate) mod toon_0;
pub(crate) mod topology;
pub(crate) mod tree;
pub(crate) mod unused;
pub(crate) mod viewpoint;
pub(crate) mod vrm;

pub use error::{GltfError, Item};

use ::gltf::json::scene::Node;
use ::gltf::json::{Index, Root};

use crate::error::SceneError;
use crate::loading::Loading;
use crate::scene::Scene;
use crate::shown::shown;
use accessor::Accessors;
use buffers::Buffers;
use container::Container;
use tree::Tree;

/// Reads a binary glTF or VRM file.
pub(crate) fn read_glb(bytes: &[u8], loading: &mut Loading) -> Result<Scene, SceneError> {
    let container = Container::parse(bytes)?;
    read_document(container.json, container.bin, loading)
}

/// Reads a glTF file of JSON text.
pub(crate) fn read_json(bytes: &[u8], loading: &mut Loading) -> Result<Scene, SceneError> {
    read_document(bytes, None, loading)
}

fn read_document(
    json: &[u8],
    bin: Option<&[u8]>,
    loading: &mut Loading,
) -> Result<Scene, SceneError> {
    let mut root = parse(json, loading)?;
    stand_up_meshes(&mut root, loading);
    let tree = Tree::walk(&root, loading)?;
    let buffers = Buffers::read(&root, bin, loading)?;
    let accessors = Accessors {
        root: &root,
        buffers: &buffers,
    };

    // Each step fills its own lists and sets the indices in the nodes that refer to them.
    let mut scene = Scene {
        nodes: tree.nodes(&root, loading),
        ..Scene::default()
    };
    scene.clips = clip::read(&accessors, &tree, &scene.nodes, loading)?;
    scene.constraints = constraint::read(&root, &tree, &scene.nodes, loading)?;
    scene.figure = figure::read(&root, &tree, &scene.nodes, loading)?;
    mesh::read(&accessors, &tree, &mut scene, loading)?;
    skin::read(&accessors, &tree, &mut scene, loading)?;
    viewpoint::read(&root, &tree, &mut scene, loading);
    light::read(&root, &tree, &mut scene, loading);
    material::read(&accessors, &mut scene, loading)?;
    vrm::turn_to_front(&root, &mut scene);
    tree::place(&mut scene, loading);
    scene.springs = spring::read(&root, &tree, &scene, loading)?;

    unused::note(&accessors, loading);
    note_what_is_ignored(&root, loading);
    describe(root, &tree, &mut scene);
    Ok(scene)
}

/// The document; without its animations, and with a notice, where only those cannot be read.
fn parse(json: &[u8], loading: &mut Loading) -> Result<Root, SceneError> {
    let limits = &loading.allowance.limits;
    document::parse(json, limits).or_else(|fault| {
        let SceneError::Gltf(GltfError::Json { .. }) = fault else {
            return Err(fault);
        };
        let root = document::parse_without_animations(json).ok_or(fault)?;
        loading
            .notices
            .add("the animations of the file cannot be read, and nothing moves");
        Ok(root)
    })
}

/// Gives every mesh of a file without nodes one at the origin, since such files are libraries of meshes.
fn stand_up_meshes(root: &mut Root, loading: &mut Loading) {
    if !root.nodes.is_empty() || !root.scenes.is_empty() || root.meshes.is_empty() {
        return;
    }
    let meshes = (0u32..).take(root.meshes.len());
    root.nodes = meshes
        .map(|mesh| Node {
            mesh: Some(Index::new(mesh)),
            ..Node::default()
        })
        .collect();
    loading
        .notices
        .add("the file has no nodes, so its meshes are drawn at the origin");
}

fn describe(root: Root, tree: &Tree, scene: &mut Scene) {
    scene.name = tree.scene_name(&root);
    scene.generator = root.asset.generator;
    scene.extensions_used = root.extensions_used;
}

fn note_what_is_ignored(root: &Root, loading: &mut Loading) {
    for name in root
        .extensions_used
        .iter()
        .filter(|name| !document::is_supported(name))
    {
        loading
            .notices
            .add(format!("extension '{}' is ignored", shown(name)));
    }
}
