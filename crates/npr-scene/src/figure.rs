//! Figures: what VRM says of an avatar besides its shape.

use crate::bone::Bone;
use crate::expression::{self, Expression};
use crate::look_at::LookAt;
use std::collections::BTreeMap;

/// What VRM says of an avatar, or of a motion for avatars.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Figure {
    /// The nodes that are its bones.
    pub bones: BTreeMap<Bone, u32>,
    /// What its face can do, in the order of the file.
    pub expressions: Vec<Expression>,
    /// Of a motion: expressions by name, each with the node whose way along x is its share.
    pub share_nodes: Vec<(String, u32)>,
    /// How it looks somewhere; none where it cannot.
    pub look_at: Option<LookAt>,
    /// Whether a motion says where to look.
    pub has_looks: bool,
}

impl Figure {
    /// The number of the expression of this name, or of what VRM 0.x or the file call it, in any letter case.
    pub fn expression(&self, name: &str) -> Option<u32> {
        expression::find(&self.expressions, name)
    }

    /// The nodes whose morphs its expressions move, a node as often as they do.
    pub fn morphed_nodes(&self) -> impl Iterator<Item = u32> {
        let morphs = self.expressions.iter().flat_map(|face| &face.morphs);
        morphs.map(|bind| bind.node)
    }
}
