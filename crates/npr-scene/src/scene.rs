//! A loaded scene: plain data whose indices are all in range.

use crate::camera::Camera;
use crate::clip::{Clip, Property};
use crate::constraint::Constraint;
use crate::figure::Figure;
use crate::image::Image;
use crate::light::Light;
use crate::material::Material;
use crate::mesh::{Mesh, POSITION_LIMIT, Part};
use crate::node::Node;
use crate::notice::Notice;
use crate::skin::Skin;
use crate::springs::Springs;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Everything of a file that can be drawn.
///
/// Every index names an element that exists, every position is finite and within
/// [`POSITION_LIMIT`], and every transform is finite. Y is up and a character
/// looks along +Z, as in glTF.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scene {
    /// Name of the drawn scene, or of the file where it has none.
    pub name: String,
    /// Nodes of the default scene; a parent always precedes its children.
    pub nodes: Vec<Node>,
    /// Meshes that nodes use. A mesh with two sets of morph weights appears twice, and one whose weights a clip moves
    /// once for every such node.
    pub meshes: Vec<Mesh>,
    /// Materials of the file; those that no part uses come without their image.
    pub materials: Vec<Material>,
    /// Decoded images of base colours and of toon materials.
    pub images: Vec<Image>,
    /// Cameras that nodes use.
    pub cameras: Vec<Camera>,
    /// Lights that nodes use.
    pub lights: Vec<Light>,
    /// Skins that nodes use.
    pub skins: Vec<Skin>,
    /// Movements of nodes, in the order of the file.
    pub clips: Vec<Clip>,
    /// Nodes that follow others, each behind those that it depends on; no node has two.
    pub constraints: Vec<Constraint>,
    /// Bones that swing in films; none where nothing does.
    pub springs: Option<Arc<Springs>>,
    /// What VRM says of the avatar, or of the motion; none where the file is no VRM.
    pub figure: Option<Figure>,
    /// What was ignored or mended, each thing once.
    pub notices: Vec<Notice>,
    /// Names of the glTF extensions that the file says it uses.
    pub extensions_used: Vec<String>,
    /// The program that wrote the file, by its own account.
    pub generator: Option<String>,
    /// Size of the file itself in bytes, without the files it refers to.
    pub file_bytes: u64,
}

impl Scene {
    /// Triangles as stored: an instanced mesh counts once.
    pub fn triangle_count(&self) -> usize {
        self.parts().map(|part| part.triangles.len()).sum()
    }

    /// Segments of lines as stored: an instanced mesh counts once.
    pub fn segment_count(&self) -> usize {
        self.parts().map(|part| part.segments.len()).sum()
    }

    /// Vertices as stored: an instanced mesh counts once.
    pub fn vertex_count(&self) -> usize {
        self.parts().map(|part| part.positions.len()).sum()
    }

    /// Lowest and highest corner of all drawn vertices in world space, as it is posed; none
    /// where nothing is drawn. O(corners of triangles and ends of lines).
    pub fn bounds_world(&self) -> Option<([f32; 3], [f32; 3])> {
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for (node, part) in self.drawn_parts() {
            let placed = self.positions_world(node, part);
            let corners = part.triangles.iter().flatten();
            let used = corners.chain(part.segments.iter().flatten());
            for position in used.map(|&vertex| placed[vertex as usize]) {
                low = std::array::from_fn(|axis| low[axis].min(position[axis]));
                high = std::array::from_fn(|axis| high[axis].max(position[axis]));
            }
        }
        (low[0] <= high[0]).then_some((low, high))
    }

    /// Every part as often as it is drawn, with the node that draws it, in node order.
    pub fn drawn_parts(&self) -> impl Iterator<Item = (&Node, &Part)> {
        self.nodes.iter().flat_map(|node| {
            let mesh = node.mesh.map(|mesh| &self.meshes[mesh as usize]);
            mesh.into_iter()
                .flat_map(move |mesh| mesh.parts.iter().map(move |part| (node, part)))
        })
    }

    fn parts(&self) -> impl Iterator<Item = &Part> {
        self.meshes.iter().flat_map(|mesh| &mesh.parts)
    }

    /// A scene with one node per mesh, all at the origin.
    pub(crate) fn of_meshes(meshes: Vec<Mesh>, materials: Vec<Material>) -> Self {
        let nodes = (0u32..)
            .zip(&meshes)
            .map(|(index, mesh)| Node::holding(index, &mesh.name))
            .collect();
        Self {
            nodes,
            meshes,
            materials,
            ..Self::default()
        }
    }

    /// Asserts what the type promises: ordered nodes, indices in range, finite numbers.
    ///
    /// # Panics
    ///
    /// When a promise is broken, naming it. Tests and fuzz targets call it on every scene they load.
    pub fn sanity_check(&self) {
        // Check nodes, and where their meshes stand.
        for (index, node) in self.nodes.iter().enumerate() {
            self.check_node(index, node);
        }
        if let Some((low, high)) = self.bounds_world() {
            let is_sound = |v: &f32| v.abs() <= POSITION_LIMIT;
            assert!(
                low.iter().chain(&high).all(is_sound),
                "sound world position"
            );
        }

        // Check parts and materials.
        for part in self.parts() {
            part.sanity_check();
            assert_in(part.material, self.materials.len(), "material");
        }
        for material in &self.materials {
            let of_toon = material.toon.iter().flat_map(|toon| toon.textures());
            for texture in material.base_color_texture.iter().chain(of_toon) {
                assert_in(Some(texture.image), self.images.len(), "image");
            }
        }

        // Check skins.
        for skin in &self.skins {
            assert_eq!(
                skin.joints.len(),
                skin.inverse_bind.len(),
                "one bind matrix per joint"
            );
            skin.joints
                .iter()
                .for_each(|&joint| assert_in(Some(joint), self.nodes.len(), "joint"));
        }

        // Check clips.
        for channel in self.clips.iter().flat_map(|clip| &clip.channels) {
            channel.sanity_check();
            let count = match channel.property {
                Property::Share => self.expressions().len(),
                _ => self.nodes.len(),
            };
            assert_in(Some(channel.node), count, "what a channel moves");
        }
        self.check_constraints();
        self.springs
            .iter()
            .for_each(|springs| self.check_springs(springs));
        self.figure
            .iter()
            .for_each(|figure| self.check_figure(figure));
    }

    fn check_constraints(&self) {
        let mut nodes = BTreeSet::new();
        for constraint in &self.constraints {
            for node in [constraint.node, constraint.source] {
                assert_in(Some(node), self.nodes.len(), "node of a constraint");
            }
            assert!(nodes.insert(constraint.node), "one constraint a node");
            assert!((0.0..=1.0).contains(&constraint.weight), "a weight");
        }
    }

    fn check_springs(&self, springs: &Springs) {
        let joints = &springs.joints;
        assert!(
            joints.is_sorted_by(|a, b| a.node < b.node),
            "joints in order"
        );
        for joint in joints {
            assert_in(Some(joint.node), self.nodes.len(), "node of a spring");
            assert_in(Some(joint.chain), springs.chains.len(), "chain of a joint");
            assert!(joint.end != [0.0; 3] && joint.radius >= 0.0, "an end");
            assert!((0.0..=1.0).contains(&joint.drag), "a share of speed");
            let numbers = [
                joint.end,
                joint.gravity,
                [joint.radius, joint.stiffness, 0.0],
            ];
            assert!(
                numbers.as_flattened().iter().all(|v| v.is_finite()),
                "finite springs"
            );
        }
        for chain in &springs.chains {
            assert_in(chain.center, self.nodes.len(), "centre of a spring");
            let colliders = chain.colliders.iter();
            colliders.for_each(|collider| {
                assert_in(Some(*collider), springs.colliders.len(), "collider")
            });
        }
        for collider in &springs.colliders {
            assert_in(Some(collider.node), self.nodes.len(), "node of a collider");
            let numbers = [collider.from, collider.to];
            assert!(
                numbers.as_flattened().iter().all(|v| v.is_finite()) && collider.radius >= 0.0,
                "a ball"
            );
        }
    }

    fn check_figure(&self, figure: &Figure) {
        let shares = figure.share_nodes.iter().map(|(_, node)| *node);
        for node in figure
            .bones
            .values()
            .copied()
            .chain(shares)
            .chain(figure.morphed_nodes())
        {
            assert_in(Some(node), self.nodes.len(), "node of a figure");
        }
        for expression in &figure.expressions {
            assert!(
                expression.morphs.iter().all(|bind| bind.weight.is_finite()),
                "finite weights"
            );
            let colors = expression.colors.iter().map(|bind| bind.material);
            for material in colors.chain(expression.textures.iter().map(|bind| bind.material)) {
                assert_in(
                    Some(material),
                    self.materials.len(),
                    "material of an expression",
                );
            }
        }
    }

    fn check_node(&self, index: usize, node: &Node) {
        // Check what the node refers to.
        assert_in(node.parent, index, "parent before child");
        assert_in(node.mesh, self.meshes.len(), "mesh");
        assert_in(node.skin, self.skins.len(), "skin");
        assert_in(node.camera, self.cameras.len(), "camera");
        assert_in(node.light, self.lights.len(), "light");

        // Check that children agree with their parent.
        for &child in &node.children {
            let child = &self.nodes[child as usize];
            assert_eq!(
                child.parent,
                Some(index as u32),
                "children name their parent"
            );
        }

        // Check that the node stands in range, and that its mesh follows joints of its skin.
        assert!(
            node.world_from_node.iter().flatten().all(|v| v.is_finite()),
            "finite transform"
        );
        if let (Some(mesh), Some(skin)) = (node.mesh, node.skin) {
            let joint_count = self.skins[skin as usize].joints.len();
            let joints = self.meshes[mesh as usize]
                .parts
                .iter()
                .filter_map(|part| part.joints.as_ref());
            assert!(
                joints
                    .flatten()
                    .flatten()
                    .all(|&joint| usize::from(joint) < joint_count),
                "joints of the skin"
            );
        }
    }
}

fn assert_in(index: Option<u32>, count: usize, what: &str) {
    assert!(
        index.is_none_or(|index| (index as usize) < count),
        "{what} {index:?} of {count}"
    );
}
