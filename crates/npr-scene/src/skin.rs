//! Skins: the joints that bend a mesh.

use crate::matrix::Matrix;

/// Joints of a mesh with their rest positions.
///
/// A vertex in world space is the weighted sum over its joints of `world_from_node` of the joint
/// times `inverse_bind` times the position; the mesh's own node plays no part.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Skin {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// Nodes of the joints.
    pub joints: Vec<u32>,
    /// Joint space from mesh space at rest, one per joint, column-major.
    pub inverse_bind: Vec<Matrix>,
}
