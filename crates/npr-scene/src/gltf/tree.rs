//! The node tree of the default scene, walked without recursion.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use ::gltf::json::{Index, Root, scene};

use super::error::{GltfError, Item};
use crate::error::SceneError;
use crate::limits;
use crate::loading::Loading;
use crate::matrix::{self, Matrix};
use crate::node::Node;
use crate::scene::Scene;
use crate::shown::shown;
use crate::transform::Transform;

/// Which nodes of the file the scene keeps, in what order.
pub(crate) struct Tree {
    /// Of each kept node: its index in the file and its kept parent. Parents come first.
    kept: Vec<(usize, Option<u32>)>,
    /// Of each node of the file: its place in `kept`.
    places: Vec<Option<u32>>,
    scene: Option<usize>,
}

impl Tree {
    /// Walks the default scene, the first one where none is named, or all roots where there is none.
    ///
    /// # Errors
    ///
    /// A node that does not exist, that is reached twice, or more nodes than the limit.
    pub(crate) fn walk(root: &Root, loading: &mut Loading) -> Result<Self, SceneError> {
        // Refuse more nodes than the limit.
        let count = root.nodes.len() as u64;
        limits::check(
            "node count",
            count,
            loading.allowance.limits.nodes,
            "--max-nodes",
        )?;

        // Find where the tree begins.
        let scene = default_scene(root)?;
        let roots = match scene.and_then(|index| root.scenes.get(index)) {
            Some(scene) => scene.nodes.iter().map(Index::value).collect(),
            None => parentless_nodes(root, loading),
        };

        // Keep what is reached from there.
        let mut tree = Self {
            kept: Vec::new(),
            places: vec![None; root.nodes.len()],
            scene,
        };
        let user = Item::new("scene", scene.unwrap_or(0));
        tree.visit(root, roots, user)?;
        Ok(tree)
    }

    fn visit(&mut self, root: &Root, roots: Vec<usize>, user: Item) -> Result<(), GltfError> {
        // The stack holds what is still to visit, last first, so that siblings keep their order.
        let mut stack: Vec<_> = roots
            .into_iter()
            .rev()
            .map(|index| (index, None, user))
            .collect();
        while let Some((index, parent, user)) = stack.pop() {
            let item = Item::new("node", index);
            let missing = GltfError::Missing {
                user,
                item,
                count: root.nodes.len(),
            };
            let node = root.nodes.get(index).ok_or_else(|| missing.clone())?;
            let place = self.kept.len() as u32;
            let slot = self.places.get_mut(index).ok_or(missing)?;
            if slot.replace(place).is_some() {
                return Err(GltfError::NodeReachedTwice { node: index });
            }
            self.kept.push((index, parent));
            stack.extend(children(node).rev().map(|child| (child, Some(place), item)));
        }
        Ok(())
    }

    /// Where node `index` of the file is among the kept ones.
    pub(crate) fn place(&self, index: usize) -> Option<u32> {
        self.places.get(index).copied().flatten()
    }

    /// The kept nodes of `scene` with what the file says of them.
    pub(crate) fn nodes_with_source<'a>(
        &'a self,
        root: &'a Root,
        scene: &'a mut Scene,
    ) -> impl Iterator<Item = (usize, &'a scene::Node, &'a mut Node)> {
        let sources = self
            .kept
            .iter()
            .filter_map(|&(index, _)| Some((index, root.nodes.get(index)?)));
        sources
            .zip(&mut scene.nodes)
            .map(|((index, source), node)| (index, source, node))
    }

    /// Names, links and local transforms of the kept nodes.
    pub(crate) fn nodes(&self, root: &Root, loading: &mut Loading) -> Vec<Node> {
        let mut nodes: Vec<Node> = Vec::with_capacity(self.kept.len());
        for (place, &(index, parent)) in (0u32..).zip(&self.kept) {
            let Some(source) = root.nodes.get(index) else {
                continue;
            };
            if let Some(parent) = parent.and_then(|parent| nodes.get_mut(parent as usize)) {
                parent.children.push(place);
            }
            let name = source.name.clone().unwrap_or_default();
            nodes.push(Node {
                name,
                parent,
                rest: rest(source),
                local: local(source, loading),
                ..Node::default()
            });
        }
        nodes
    }

    /// Name of the scene that is drawn; empty where it has none.
    pub(crate) fn scene_name(&self, root: &Root) -> String {
        let scene = self.scene.and_then(|index| root.scenes.get(index));
        scene
            .and_then(|scene| scene.name.clone())
            .unwrap_or_default()
    }
}

fn default_scene(root: &Root) -> Result<Option<usize>, GltfError> {
    let count = root.scenes.len();
    match root.scene.map(|scene| scene.value()) {
        Some(scene) if scene >= count => Err(GltfError::NoScene { scene, count }),
        None if count == 0 => Ok(None),
        named => Ok(Some(named.unwrap_or(0))),
    }
}

fn parentless_nodes(root: &Root, loading: &mut Loading) -> Vec<usize> {
    if root.nodes.len() > 1 {
        loading
            .notices
            .add("the file has no scene, so all its nodes are drawn");
    }
    let mut has_parent = vec![false; root.nodes.len()];
    for child in root.nodes.iter().flat_map(children) {
        if let Some(flag) = has_parent.get_mut(child) {
            *flag = true;
        }
    }
    has_parent
        .iter()
        .enumerate()
        .filter(|&(_, has)| !has)
        .map(|(index, _)| index)
        .collect()
}

fn children(node: &scene::Node) -> impl DoubleEndedIterator<Item = usize> + '_ {
    node.children.iter().flatten().map(Index::value)
}

fn local(node: &scene::Node, loading: &mut Loading) -> Matrix {
    if let Some(matrix) = node.matrix {
        if node.translation.is_some() || node.rotation.is_some() || node.scale.is_some() {
            loading.notices.add(
                "a node has a matrix besides its translation, rotation or scale; the matrix counts",
            );
        }
        let (columns, _) = matrix.as_chunks::<4>();
        return std::array::from_fn(|i| columns.get(i).copied().unwrap_or_default());
    }
    rest(node).unwrap_or_default().matrix()
}

/// Where a node stands beside its parent, unless it has a matrix.
fn rest(node: &scene::Node) -> Option<Transform> {
    let rest = Transform {
        translation: node.translation.unwrap_or_default(),
        rotation: node.rotation.unwrap_or_default().0,
        scale: node.scale.unwrap_or([1.0; 3]),
    };
    node.matrix.is_none().then_some(rest)
}

/// Works out where every node stands in the world, and takes what stands nowhere out of the picture.
pub(crate) fn place(scene: &mut Scene, loading: &mut Loading) {
    // Multiply transforms from parents to children.
    let mut worlds: Vec<Matrix> = Vec::with_capacity(scene.nodes.len());
    for node in &scene.nodes {
        let parent = node.parent.and_then(|parent| worlds.get(parent as usize));
        worlds.push(parent.map_or(node.local, |parent| matrix::multiply(parent, &node.local)));
    }

    // Draw nothing at a node that stands out of range.
    for (node, world) in scene.nodes.iter_mut().zip(worlds) {
        if matrix::is_sound(&world) {
            node.world_from_node = world;
            continue;
        }
        let name = shown(&node.name);
        loading.notices.add(format!(
            "node '{name}' has a transform out of range, and nothing is drawn there"
        ));
        *node = Node {
            mesh: None,
            skin: None,
            camera: None,
            light: None,
            rest: None,
            local: matrix::IDENTITY,
            ..node.clone()
        };
    }
}
