//! Constraints: nodes that turn as other nodes do [VRMC_node_constraint 1.0].
//!
//! They count after everything else that turns a node, and are worked out from the pose alone.

mod order;

pub(crate) use order::in_order;

/// A node whose turn follows another node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// The node that is turned.
    pub node: u32,
    /// The node that it follows.
    pub source: u32,
    /// How far it goes from where it rests to where the constraint has it, 0 to 1, along the shorter arc.
    pub weight: f32,
    /// How it follows.
    pub kind: ConstraintKind,
}

/// How a node follows another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstraintKind {
    /// It rolls about an axis of its own, a unit vector, as its source does: twists of arms and legs.
    Roll([f32; 3]),
    /// It turns no more than it must for an axis of its own, a unit vector, to point at its source.
    Aim([f32; 3]),
    /// It turns beside how it rests as its source does, each in its own space.
    Rotation,
}
