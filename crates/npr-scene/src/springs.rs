//! Springs: bones of hair and clothes that swing after what carries them [VRM spring bone 1.0].
//!
//! A [`Springs`] is what a file says, of either version of VRM. A [`Swing`] moves its joints step by step, and a
//! [`Swinging`] tells how they stand at any time of a film.

mod collider;
mod swing;
mod swinging;
mod vector;

pub use collider::Collider;
pub use swing::Swing;
pub use swinging::Swinging;

/// The springs of a scene.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Springs {
    /// The bones that swing, in rising order of their nodes, no node twice.
    pub joints: Vec<SpringJoint>,
    /// What joints have in common.
    pub chains: Vec<SpringChain>,
    /// What joints do not enter.
    pub colliders: Vec<Collider>,
}

/// A bone that swings about its node: its end lags behind, is drawn back to where it rests, and falls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringJoint {
    /// The node that turns.
    pub node: u32,
    /// Where its end rests, in the space of the node; not at its origin.
    pub end: [f32; 3],
    /// The chain that it is of.
    pub chain: u32,
    /// Radius of its end, in units of the world.
    pub radius: f32,
    /// How fast the end is drawn back to where it rests, in units of the world a second.
    pub stiffness: f32,
    /// How fast and where it falls, in units of the world a second.
    pub gravity: [f32; 3],
    /// What it loses of its speed in a step, 0 to 1.
    pub drag: f32,
}

/// What the joints of a spring have in common.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SpringChain {
    /// The colliders that it minds, in the order in which they push.
    pub colliders: Vec<u32>,
    /// The node in whose space ends keep their speed; the world without one.
    pub center: Option<u32>,
}

#[cfg(test)]
mod tests;
