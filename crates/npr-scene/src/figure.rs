//! Figures: what VRM says of an avatar besides its shape.

use crate::bone::Bone;
use crate::expression::{self, Expression};
use crate::look_at::{Eyes, LookAt};
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

    /// Whether it can look somewhere: it has a head, and what moves.
    pub fn can_look(&self) -> bool {
        let has = |bone| self.bones.contains_key(&bone);
        let moves = |look: &LookAt| match look.eyes {
            Eyes::Bones => has(Bone::LEFT_EYE) || has(Bone::RIGHT_EYE),
            Eyes::Expressions => self.looks().iter().any(Option::is_some),
        };
        has(Bone::HEAD) && self.look_at.as_ref().is_some_and(moves)
    }

    /// The expressions that look up, down, left and right, by number.
    pub fn looks(&self) -> [Option<u32>; 4] {
        ["lookUp", "lookDown", "lookLeft", "lookRight"].map(|name| {
            let mut names = (0u32..).zip(&self.expressions);
            names.find_map(|(number, face)| (face.name == name).then_some(number))
        })
    }
}
