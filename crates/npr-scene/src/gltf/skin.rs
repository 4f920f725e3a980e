//! Skins: joints and their rest positions.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::Index;
use ::gltf::json::skin::Skin as JsonSkin;

use super::accessor::Accessors;
use super::error::{GltfError, Item};
use super::tree::Tree;
use crate::error::SceneError;
use crate::loading::Loading;
use crate::matrix::{self, Matrix};
use crate::mesh::Mesh;
use crate::node::Node;
use crate::pool::Pool;
use crate::scene::Scene;
use crate::shown::shown;
use crate::skin::Skin;

/// Reads the skins that kept nodes use. A skin that cannot bend its mesh is left out with a notice.
///
/// # Errors
///
/// A skin or node that does not exist, or bind matrices that cannot be read.
pub(crate) fn read(
    accessors: &Accessors,
    tree: &Tree,
    scene: &mut Scene,
    loading: &mut Loading,
) -> Result<(), SceneError> {
    // Note which joints meshes name before those without weight are dropped.
    let highest: Vec<Option<Highest>> = scene.meshes.iter().map(Highest::of).collect();
    scene.meshes.iter_mut().for_each(drop_idle_joints);

    // Give every node its skin, unless its mesh names joints that the skin lacks.
    let mut skins: Pool<usize, Skin> = Pool::default();
    for (node_index, source, node) in tree.nodes_with_source(accessors.root, scene) {
        let Some(index) = source.skin.as_ref().map(Index::value) else {
            continue;
        };
        let user = Item::new("node", node_index);
        let place = skins.place(index, || read_skin(accessors, tree, index, user, loading))?;
        let Some(skin) = place.and_then(|place| skins.items.get(place as usize)) else {
            continue;
        };
        let fits = fits(node, skin, &highest, loading);
        node.skin = place.filter(|_| fits);
    }
    scene.skins = skins.items;
    Ok(())
}

/// The highest joints that vertices of a mesh name.
#[derive(Debug, Clone, Copy, Default)]
struct Highest {
    /// Among those that a vertex follows.
    followed: u16,
    /// Among all, those without weight too.
    named: u16,
}

impl Highest {
    /// The highest joints of `mesh`; none where a part follows no joints.
    fn of(mesh: &Mesh) -> Option<Self> {
        let mut highest = Self::default();
        for part in &mesh.parts {
            let (joints, weights) = (part.joints.as_ref()?, part.weights.as_ref()?);
            for (joint, weight) in joints.as_flattened().iter().zip(weights.as_flattened()) {
                highest.named = highest.named.max(*joint);
                if *weight > 0.0 {
                    highest.followed = highest.followed.max(*joint);
                }
            }
        }
        Some(highest)
    }
}

/// Lets vertices name the first joint wherever they follow none, since files leave anything there.
fn drop_idle_joints(mesh: &mut Mesh) {
    for part in &mut mesh.parts {
        let (Some(joints), Some(weights)) = (&mut part.joints, &part.weights) else {
            continue;
        };
        let joints = joints.as_flattened_mut().iter_mut();
        for (joint, weight) in joints.zip(weights.as_flattened()) {
            // What is no number is no weight.
            if weight.is_nan() || *weight <= 0.0 {
                *joint = 0;
            }
        }
    }
}

/// Whether every joint that the mesh of `node` follows is in `skin`; says which is not.
fn fits(node: &Node, skin: &Skin, highest: &[Option<Highest>], loading: &mut Loading) -> bool {
    // Find the highest joints that the mesh names.
    let Some(mesh) = node.mesh else {
        return false;
    };
    let (name, count) = (shown(&node.name), skin.joints.len());
    let has = |joint: u16| usize::from(joint) < count;
    let Some(highest) = highest.get(mesh as usize).copied().flatten() else {
        loading.notices.add(format!(
            "the mesh of node '{name}' names no joints of its skin and is drawn at rest"
        ));
        return false;
    };

    // Say which joint is missing: one that is followed matters, one without weight does not.
    let Highest { followed, named } = highest;
    if !has(followed) {
        loading.notices.add(format!(
            "the mesh of node '{name}' follows joint {followed}, but its skin has only {count}: it is drawn at rest"
        ));
    } else if !has(named) {
        loading.notices.add(format!(
            "the mesh of node '{name}' names joint {named} without weight, but its skin has only {count}"
        ));
    }
    has(followed)
}

fn read_skin(
    accessors: &Accessors,
    tree: &Tree,
    index: usize,
    user: Item,
    loading: &mut Loading,
) -> Result<Option<Skin>, SceneError> {
    // Leave out a skin that has no joints, or some that are not drawn.
    let item = Item::new("skin", index);
    let skins = &accessors.root.skins;
    let source = skins.get(index).ok_or(GltfError::Missing {
        user,
        item,
        count: skins.len(),
    })?;
    if source.joints.is_empty() {
        loading.notices.add(format!(
            "{item} has no joints, and its meshes are drawn at rest"
        ));
        return Ok(None);
    }
    let Some(joints) = joints(accessors, tree, source, item)? else {
        loading.notices.add(format!(
            "{item} has joints outside the scene, and its meshes are drawn at rest"
        ));
        return Ok(None);
    };

    // Leave out a skin that would carry its mesh out of range.
    let inverse_bind = inverse_bind(accessors, source, item, loading)?;
    if !inverse_bind.iter().all(matrix::is_sound) {
        loading.notices.add(format!(
            "{item} has bind matrices out of range, and its meshes are drawn at rest"
        ));
        return Ok(None);
    }
    Ok(Some(Skin {
        name: source.name.clone().unwrap_or_default(),
        joints,
        inverse_bind,
    }))
}

/// Where the joints are among the kept nodes; none where one of them is not.
fn joints(
    accessors: &Accessors,
    tree: &Tree,
    source: &JsonSkin,
    user: Item,
) -> Result<Option<Vec<u32>>, GltfError> {
    // Refuse a joint that does not exist.
    let count = accessors.root.nodes.len();
    let missing = source
        .joints
        .iter()
        .map(Index::value)
        .find(|&joint| joint >= count);
    if let Some(index) = missing {
        return Err(GltfError::Missing {
            user,
            item: Item::new("node", index),
            count,
        });
    }

    // Find the joints among the nodes that are kept.
    Ok(source
        .joints
        .iter()
        .map(|joint| tree.place(joint.value()))
        .collect())
}

fn inverse_bind(
    accessors: &Accessors,
    source: &JsonSkin,
    user: Item,
    loading: &mut Loading,
) -> Result<Vec<Matrix>, SceneError> {
    // Bind every joint where it stands, unless the file says otherwise.
    let wanted = source.joints.len();
    loading.allowance.take::<Matrix>("bind matrices", wanted)?;
    let Some(index) = source.inverse_bind_matrices.as_ref().map(Index::value) else {
        return Ok(vec![matrix::IDENTITY; wanted]);
    };

    // Refuse fewer matrices than joints.
    let count = accessors.count(index, user)?;
    if count < wanted {
        return Err(GltfError::Count {
            user,
            accessor: index,
            count,
            wanted,
        }
        .into());
    }

    // Make columns of the numbers, one matrix for each joint.
    let numbers = accessors.floats::<16>(index, user, &mut loading.allowance)?;
    let columns = |flat: [f32; 16]| {
        let (columns, _) = flat.as_chunks::<4>();
        std::array::from_fn(|i| columns.get(i).copied().unwrap_or_default())
    };
    Ok(numbers.into_iter().take(wanted).map(columns).collect())
}
