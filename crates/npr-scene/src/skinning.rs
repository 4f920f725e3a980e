//! Where the vertices of a part stand in the world: at their node, or bent by a skin.

use crate::matrix::{self, Matrix};
use crate::mesh::Part;
use crate::node::Node;
use crate::scene::Scene;
use crate::skin::Skin;

impl Scene {
    /// World positions of the vertices of `part`, which is part of the mesh of `node`.
    ///
    /// A skinned part follows its joints by linear blend skinning [glTF 2.0, section 3.7.3.3]; its
    /// node's own transform plays no part then. O(vertices).
    pub fn positions_world(&self, node: &Node, part: &Part) -> Vec<[f32; 3]> {
        let skin = node.skin.map(|skin| &self.skins[skin as usize]);
        match (skin, &part.joints, &part.weights) {
            (Some(skin), Some(joints), Some(weights)) => {
                let worlds = self.world_from_rest(skin);
                let vertices = part.positions.iter().zip(joints).zip(weights);
                vertices
                    .map(|((&p, joints), weights)| bend(&worlds, p, joints, weights))
                    .collect()
            }
            _ => part
                .positions
                .iter()
                .map(|&p| matrix::transform_point(&node.world_from_node, p))
                .collect(),
        }
    }

    /// Of each joint of `skin`: the matrix that carries the mesh at rest to where the joint is now.
    pub fn world_from_rest(&self, skin: &Skin) -> Vec<Matrix> {
        let joints = skin.joints.iter().zip(&skin.inverse_bind);
        joints
            .map(|(&joint, bind)| {
                matrix::multiply(&self.nodes[joint as usize].world_from_node, bind)
            })
            .collect()
    }
}

fn bend(worlds: &[Matrix], position: [f32; 3], joints: &[u16; 4], weights: &[f32; 4]) -> [f32; 3] {
    let mut bent = [0.0; 3];
    for (&joint, &weight) in joints
        .iter()
        .zip(weights)
        .filter(|&(_, &weight)| weight > 0.0)
    {
        let moved = matrix::transform_point(&worlds[joint as usize], position);
        bent = std::array::from_fn(|axis| bent[axis] + weight * moved[axis]);
    }
    bent
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;

    #[test]
    fn a_vertex_between_two_joints_goes_half_the_way() {
        let moved = matrix::from_parts([0.0, 4.0, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0; 3]);
        let joint = Node {
            world_from_node: moved,
            ..Node::default()
        };
        let body = Node {
            mesh: Some(0),
            skin: Some(0),
            world_from_node: moved,
            ..Node::default()
        };
        let part = Part {
            positions: vec![[1.0, 0.0, 0.0]],
            joints: Some(vec![[0, 1, 0, 0]]),
            weights: Some(vec![[0.5, 0.5, 0.0, 0.0]]),
            ..Part::default()
        };
        let skin = Skin {
            joints: vec![0, 1],
            inverse_bind: vec![matrix::IDENTITY; 2],
            ..Skin::default()
        };
        let scene = Scene {
            nodes: vec![joint, Node::default(), body],
            meshes: vec![Mesh {
                name: String::new(),
                parts: vec![part],
            }],
            skins: vec![skin],
            ..Scene::default()
        };
        scene.sanity_check();
        let placed = scene.positions_world(&scene.nodes[2], &scene.meshes[0].parts[0]);
        assert_eq!(placed, [[1.0, 2.0, 0.0]]);
    }
}
