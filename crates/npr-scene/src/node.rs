//! Nodes: where things stand.

use crate::matrix::{self, Matrix};
use crate::transform::Transform;

/// One place in the scene's tree, with what stands there.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// The node this one hangs on, always earlier in the list.
    pub parent: Option<u32>,
    /// The nodes that hang on this one.
    pub children: Vec<u32>,
    /// Where it stands beside its parent at rest, in the parts that clips replace; none where the file gives a matrix
    /// instead, or is of a format without clips. Such a node moves with its parent alone.
    pub rest: Option<Transform>,
    /// Parent space from node space, column-major, as posed.
    pub local: Matrix,
    /// World space from node space, column-major, as posed.
    pub world_from_node: Matrix,
    /// Index of the mesh drawn here.
    pub mesh: Option<u32>,
    /// Index of the skin that deforms the mesh.
    pub skin: Option<u32>,
    /// Index of the camera that looks along -Z from here.
    pub camera: Option<u32>,
    /// Index of the light that shines along -Z from here.
    pub light: Option<u32>,
}

impl Default for Node {
    fn default() -> Self {
        Self {
            name: String::new(),
            parent: None,
            children: Vec::new(),
            rest: None,
            local: matrix::IDENTITY,
            world_from_node: matrix::IDENTITY,
            mesh: None,
            skin: None,
            camera: None,
            light: None,
        }
    }
}

impl Node {
    /// Parent space from node space where a pose has it stand so, or where it rests; one with a matrix stays.
    pub(crate) fn local_in(&self, posed: Option<&Transform>) -> Matrix {
        let rest = self.rest.as_ref();
        rest.map_or(self.local, |rest| posed.unwrap_or(rest).matrix())
    }

    /// A root at the origin with one mesh.
    pub(crate) fn holding(mesh: u32, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            mesh: Some(mesh),
            ..Self::default()
        }
    }
}
