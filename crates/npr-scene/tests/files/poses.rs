//! Poses of the shared models against those of three.js, by the places of their nodes and of some vertices.

use crate::models::{loaded, models};
use npr_scene::Scene;
use serde_json::Value;

/// Most that a place may differ, as a share of the model's size.
const MOST: f64 = 1e-4;

/// What `three_poses.mjs` wrote.
const OF_THREE: &str = include_str!("../data/three_poses.json");

/// Places of all nodes, then of some vertices of each surface, in the order of the file's tree.
fn places(scene: &Scene, vertex_count: usize) -> Vec<f64> {
    let nodes = scene.nodes.iter().map(|node| {
        let [x, y, z, _] = node.world_from_node[3];
        [x, y, z]
    });
    let vertices = scene.drawn_parts().flat_map(|(node, part)| {
        let world = scene.positions_world(node, part);
        let vertex = |k: usize| (2 * k + 1) * world.len() / (2 * vertex_count);
        (0..vertex_count)
            .map(|k| world[vertex(k)])
            .collect::<Vec<_>>()
    });
    nodes.chain(vertices).flatten().map(f64::from).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

#[test]
fn nodes_and_vertices_stand_where_three_js_has_them() {
    let Some(folder) = models() else { return };
    let of_three: Value = serde_json::from_str(OF_THREE).expect("JSON");
    let vertex_count = number(&of_three["vertices"]) as usize;
    let mut clip_count = 0;
    for model in list(&of_three["models"]) {
        let name = model["name"].as_str().expect("a name");
        let size = number(&model["size"]);
        let step = size / number(&of_three["steps"]);
        let mut scene = loaded(&folder, name);
        assert_eq!(scene.clips.len(), list(&model["clips"]).len(), "{name}");
        for (index, clip) in list(&model["clips"]).iter().enumerate() {
            clip_count += 1;
            let duration = f64::from(scene.clips[index].duration_s());
            assert!(
                (duration - number(&clip["duration"])).abs() < 1e-6,
                "{name}: {duration} s"
            );
            assert_eq!(list(&clip["moments"]).len(), 20);
            let mut wanted = Vec::new();
            for moment in list(&clip["moments"]) {
                // Stand there.
                let time = number(&moment["time"]) as f32;
                let pose = scene.pose_at(&scene.clips[index], time);
                scene.set_pose(&pose).expect("in range");
                let found = places(&scene, vertex_count);

                // Compare.
                let moved = list(&moment["places"]);
                assert_eq!(found.len(), moved.len(), "{name}");
                wanted.resize(found.len(), 0.0);
                for ((place, found), moved) in wanted.iter_mut().zip(found).zip(moved) {
                    *place += number(moved);
                    let apart = (*place * step - found).abs() / size;
                    assert!(
                        apart < MOST,
                        "{name}, clip {index} at {time} s: {apart} of its size"
                    );
                }
            }
        }
    }
    assert_eq!(clip_count, 22);
}
