//! How far transforms carry what is drawn, so that world positions stay in range as well.

use crate::matrix;
use crate::mesh::{Mesh, POSITION_LIMIT};
use crate::notice::Notices;
use crate::scene::Scene;
use crate::shown::shown;
use crate::skin::Skin;

/// Takes out of the picture what a transform may carry beyond [`POSITION_LIMIT`].
///
/// Judged by bounds on meshes and matrices rather than by vertices: O(nodes + vertices as stored).
pub(crate) fn bound(scene: &mut Scene, notices: &mut Notices) {
    for index in carried_out_of_range(scene) {
        // Draw nothing there.
        let node = &mut scene.nodes[index];
        (node.mesh, node.skin) = (None, None);
        let name = shown(&node.name);
        notices.add(format!(
            "node '{name}' carries its mesh out of range, and nothing is drawn there"
        ));
    }
}

/// The nodes that may carry their mesh beyond [`POSITION_LIMIT`], in ascending order.
pub(crate) fn carried_out_of_range(scene: &Scene) -> Vec<usize> {
    // Measure how far meshes reach, and how far skins may carry them.
    let meshes: Vec<f32> = scene.meshes.iter().map(mesh_reach).collect();
    let skins: Vec<f32> = scene
        .skins
        .iter()
        .map(|skin| skin_gain(scene, skin))
        .collect();

    // Find the nodes that may carry a mesh too far.
    let nodes = scene.nodes.iter().enumerate();
    let carried = nodes.filter(|(_, node)| {
        let Some(reach) = node.mesh.map(|mesh| meshes[mesh as usize]) else {
            return false;
        };
        let gain = match node.skin {
            Some(skin) => skins[skin as usize].max(matrix::gain(&node.world_from_node)),
            None => matrix::gain(&node.world_from_node),
        };
        gain * reach > POSITION_LIMIT
    });
    carried.map(|(index, _)| index).collect()
}

/// Largest coordinate of a mesh, at least 1.
fn mesh_reach(mesh: &Mesh) -> f32 {
    let coordinates = mesh
        .parts
        .iter()
        .flat_map(|part| part.positions.as_flattened());
    coordinates.fold(1.0, |most, v| v.abs().max(most))
}

fn skin_gain(scene: &Scene, skin: &Skin) -> f32 {
    let worlds = scene.world_from_rest(skin);
    let gains = worlds.iter().map(matrix::gain);
    gains.fold(0.0, |most, gain| {
        if gain.is_finite() {
            gain.max(most)
        } else {
            f32::INFINITY
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Part;

    #[test]
    fn a_mesh_carried_out_of_range_is_not_drawn() {
        let part = Part {
            positions: vec![[1e12, 0.0, 0.0]],
            ..Part::default()
        };
        let mesh = Mesh {
            name: String::new(),
            parts: vec![part],
        };
        let mut scene = Scene::of_meshes(vec![mesh], Vec::new());
        let mut notices = Notices::default();
        bound(&mut scene, &mut notices);
        assert_eq!(scene.nodes[0].mesh, Some(0));

        scene.nodes[0].world_from_node = matrix::from_parts([0.0; 3], [0.0; 4], [1e9; 3]);
        bound(&mut scene, &mut notices);
        assert_eq!(scene.nodes[0].mesh, None);
        assert_eq!(notices.into_list().len(), 1);
    }
}
