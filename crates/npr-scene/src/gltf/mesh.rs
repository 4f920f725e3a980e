//! Meshes, read once for every set of morph weights they are used with.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::{Index, scene};

use super::accessor::Accessors;
use super::clip;
use super::error::{GltfError, Item};
use super::primitive::{self, PrimitiveLocation};
use super::tree::Tree;
use crate::error::SceneError;
use crate::figure::Figure;
use crate::loading::Loading;
use crate::mesh::Mesh;
use crate::pool::Pool;
use crate::scene::Scene;

/// A mesh of the file, the bits of the weights that a node sets for it, if it does, and the node whose weights a clip
/// or an expression moves, if one does.
type Key = (usize, Option<Vec<u32>>, Option<usize>);

/// Reads the meshes that kept nodes use.
///
/// # Errors
///
/// A broken mesh, or one that exceeds a limit.
pub(crate) fn read(
    accessors: &Accessors,
    tree: &Tree,
    scene: &mut Scene,
    loading: &mut Loading,
) -> Result<(), SceneError> {
    // Read each mesh once for every set of morph weights that nodes give it, and for every node that clips or
    // expressions give others.
    let mut weighted = clip::weighted_nodes(&scene.clips);
    weighted.extend(scene.figure.iter().flat_map(Figure::morphed_nodes));
    let is_weighted = |index: usize| {
        tree.place(index)
            .is_some_and(|node| weighted.contains(&node))
    };
    let mut meshes: Pool<Key, Mesh> = Pool::default();
    for (node_index, source, node) in tree.nodes_with_source(accessors.root, scene) {
        let Some(index) = source.mesh.as_ref().map(Index::value) else {
            continue;
        };
        let weights = weights(accessors, node_index, index, source)?;
        let own_weights = source.weights.as_ref();
        let bits = own_weights.map(|list| list.iter().map(|weight| weight.to_bits()).collect());
        let own = Some(node_index).filter(|index| is_weighted(*index));
        node.mesh = meshes.place((index, bits, own), || {
            read_mesh(accessors, index, weights, loading).map(Some)
        })?;
    }
    scene.meshes = meshes.items;
    Ok(())
}

/// Default morph weights: those of the node, else those of the mesh.
fn weights<'a>(
    accessors: &Accessors<'a>,
    node_index: usize,
    index: usize,
    node: &'a scene::Node,
) -> Result<&'a [f32], GltfError> {
    let user = Item::new("node", node_index);
    let item = Item::new("mesh", index);
    let count = accessors.root.meshes.len();
    let mesh = accessors
        .root
        .meshes
        .get(index)
        .ok_or(GltfError::Missing { user, item, count })?;
    Ok(node
        .weights
        .as_deref()
        .or(mesh.weights.as_deref())
        .unwrap_or_default())
}

fn read_mesh(
    accessors: &Accessors,
    index: usize,
    weights: &[f32],
    loading: &mut Loading,
) -> Result<Mesh, SceneError> {
    // Plan the memory of its name before it is copied.
    let Some(source) = accessors.root.meshes.get(index) else {
        return Ok(Mesh::default());
    };
    loading
        .allowance
        .take::<u8>("names", source.name.as_ref().map_or(0, String::len))?;
    let mut mesh = Mesh {
        name: source.name.clone().unwrap_or_default(),
        parts: Vec::new(),
    };

    // Read its parts, leaving out those with nothing to draw.
    for (part, primitive) in source.primitives.iter().enumerate() {
        let place = PrimitiveLocation { mesh: index, part };
        mesh.parts.extend(primitive::read(
            accessors, primitive, place, weights, loading,
        )?);
    }
    Ok(mesh)
}
