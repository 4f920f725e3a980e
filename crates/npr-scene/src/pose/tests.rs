use super::*;
use crate::clip::{Channel, Interpolation};
use crate::mesh::{Mesh, Part};
use crate::morph::{Morph, Unmorphed};
use crate::node::Node;
use proptest::prelude::*;

/// A chain of nodes that rest at the places of `rests`, each on the one before; the last one draws a triangle with two
/// morphs, the second of which has no normals.
fn chain(rests: &[Transform]) -> Scene {
    let mut nodes: Vec<Node> = Vec::new();
    for (index, rest) in (0u32..).zip(rests) {
        let parent = index.checked_sub(1);
        if let Some(parent) = parent {
            nodes[parent as usize].children.push(index);
        }
        let local = rest.matrix();
        let world = parent.map(|parent| nodes[parent as usize].world_from_node);
        nodes.push(Node {
            parent,
            rest: Some(*rest),
            local,
            world_from_node: world.map_or(local, |world| matrix::multiply(&world, &local)),
            ..Node::default()
        });
    }
    if let Some(node) = nodes.last_mut() {
        node.mesh = Some(0);
    }
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let normals = Some(vec![[0.0, 0.0, 1.0]; 3]);
    let moved = Morph {
        positions: Some(vec![[0.0; 3], [0.0; 3], [0.0, 0.0, 1.0]]),
        ..Morph::default()
    };
    let turned = Morph {
        normals: Some(vec![[1.0, 0.0, 0.0]; 3]),
        ..moved.clone()
    };
    let part = Part {
        positions: positions.clone(),
        normals: normals.clone(),
        triangles: vec![[0, 1, 2]],
        morphs: vec![turned, moved],
        unmorphed: Some(Box::new(Unmorphed { positions, normals })),
        ..Part::default()
    };
    let mesh = Mesh {
        name: "sail".to_owned(),
        parts: vec![part],
    };
    let scene = Scene {
        nodes,
        meshes: vec![mesh],
        ..Scene::default()
    };
    scene.sanity_check();
    scene
}

fn place() -> impl Strategy<Value = Transform> {
    let moved = prop::array::uniform3(-3f32..3.0);
    let turned = prop::array::uniform4(-1f32..1.0);
    let parts = (moved, turned, prop::array::uniform3(0.3f32..2.0));
    parts.prop_map(|(translation, rotation, scale)| Transform {
        translation,
        rotation,
        scale,
    })
}

fn poses() -> impl Strategy<Value = Pose> {
    let transforms = prop::collection::btree_map(0u32..5, place(), 0..5);
    let weights =
        prop::collection::btree_map(0u32..5, prop::collection::vec(-1f32..2.0, 0..3), 0..5);
    (transforms, weights).prop_map(|(transforms, weights)| Pose {
        transforms,
        weights,
        ..Pose::default()
    })
}

proptest! {
    #[test]
    fn a_pose_does_not_depend_on_the_one_before(
        rests in prop::collection::vec(place(), 4), first in poses(), second in poses(),
    ) {
        let rest = chain(&rests);
        let (mut walked, mut straight) = (rest.clone(), rest.clone());
        walked.set_pose(&first).expect("in range");
        walked.sanity_check();
        walked.set_pose(&second).expect("in range");
        straight.set_pose(&second).expect("in range");
        prop_assert_eq!(&walked, &straight);
        walked.set_pose(&Pose::default()).expect("in range");
        prop_assert_eq!(&walked, &rest);
    }

    #[test]
    fn every_node_stands_beside_its_parent(rests in prop::collection::vec(place(), 4), pose in poses()) {
        let mut scene = chain(&rests);
        scene.set_pose(&pose).expect("in range");
        let mut world = matrix::IDENTITY;
        for (index, (node, rest)) in scene.nodes.iter().zip(&rests).enumerate() {
            let place = pose.transforms.get(&(index as u32)).unwrap_or(rest);
            world = matrix::multiply(&world, &place.matrix());
            prop_assert_eq!(node.world_from_node, world);
        }
    }

    #[test]
    fn the_order_of_channels_plays_no_part(values in prop::collection::vec(-1f32..1.0, 20), time in 0f32..1.0) {
        let channel = |property, range: std::ops::Range<usize>| Channel {
            node: 1,
            property,
            interpolation: Interpolation::Linear,
            times: [0.0, 1.0].into(),
            values: values[range].into(),
        };
        let mut clip = Clip {
            name: String::new(),
            channels: vec![
                channel(Property::Translation, 0..6),
                channel(Property::Rotation, 6..14),
                channel(Property::Scale, 14..20),
                channel(Property::Weights, 2..6),
            ],
        };
        let scene = chain(&[Transform::default(); 3]);
        let pose = scene.pose_at(&clip, time);
        clip.channels.reverse();
        prop_assert_eq!(scene.pose_at(&clip, time), pose);
    }
}

#[test]
fn a_channel_replaces_one_part_and_leaves_the_others_at_rest() {
    let rest = Transform {
        translation: [1.0, 2.0, 3.0],
        rotation: [0.0, 1.0, 0.0, 0.0],
        scale: [2.0; 3],
    };
    let scene = chain(&[rest]);
    let clip = Clip {
        name: String::new(),
        channels: vec![Channel {
            node: 0,
            property: Property::Scale,
            interpolation: Interpolation::Step,
            times: [0.0].into(),
            values: [5.0, 6.0, 7.0].into(),
        }],
    };
    let posed = Transform {
        scale: [5.0, 6.0, 7.0],
        ..rest
    };
    assert_eq!(scene.pose_at(&clip, 9.0).transforms[&0], posed);
}

/// The scene of one node with these weights.
fn morphed(weights: &[f32]) -> Part {
    let mut scene = chain(&[Transform::default()]);
    let pose = Pose {
        weights: BTreeMap::from([(0, weights.to_vec())]),
        ..Pose::default()
    };
    scene.set_pose(&pose).expect("in range");
    scene.sanity_check();
    scene.meshes[0].parts.remove(0)
}

#[test]
fn weights_move_vertices_and_normals_follow() {
    // Normals of the morph itself are blended.
    let of_file = morphed(&[1.0]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    assert_eq!(of_file.positions[2], [0.0, 1.0, 1.0]);
    assert_eq!(of_file.morphs[0].applied_weight, 1.0);
    let normal = of_file.normals.expect("normals")[0];
    assert!((normal[0] - half).abs() < 1e-6 && (normal[2] - half).abs() < 1e-6);

    // Without any the normals turn with the face, which leans back by 45 degrees.
    let turned = morphed(&[0.0, 1.0]);
    assert_eq!(turned.positions, of_file.positions);
    for normal in turned.normals.expect("normals") {
        let wanted = [0.0, -half, half];
        assert!(
            (0..3).all(|i| (normal[i] - wanted[i]).abs() < 1e-6),
            "{normal:?}"
        );
    }

    // What is no weight counts as none.
    assert_eq!(morphed(&[f32::NAN, f32::INFINITY]), morphed(&[]));
}

#[test]
fn what_is_carried_out_of_range_is_refused_and_nothing_changes() {
    let mut scene = chain(&[Transform::default(); 2]);
    let before = scene.clone();
    for scale in [1e30, 1e18 * 2.0, f32::INFINITY, f32::NAN] {
        let far = Transform {
            scale: [scale; 3],
            ..Transform::default()
        };
        let pose = Pose {
            transforms: BTreeMap::from([(0, far)]),
            weights: BTreeMap::from([(1, vec![1.0])]),
            ..Pose::default()
        };
        assert!(scene.set_pose(&pose).is_err(), "{scale}");
        assert_eq!(scene, before);
    }
    let pose = Pose {
        weights: BTreeMap::from([(1, vec![1e30])]),
        ..Pose::default()
    };
    let fault = scene.set_pose(&pose).expect_err("out of range");
    assert_eq!(
        fault.to_string(),
        "the morph weights of mesh 'sail' carry it out of range"
    );
    assert_eq!(scene, before);
}

#[test]
fn a_mesh_that_is_carried_out_of_range_is_refused_and_nothing_changes() {
    // Make a scene whose nodes stay where they may stand, while its mesh is too large for them.
    let mut scene = chain(&[Transform::default(); 2]);
    let part = &mut scene.meshes[0].parts[0];
    part.morphs.clear();
    part.unmorphed = None;
    part.positions
        .as_flattened_mut()
        .iter_mut()
        .for_each(|v| *v *= 1e12);
    scene.nodes[1].name = "mast".to_owned();
    let before = scene.clone();

    // Scale it a little, and too much.
    let scaled = |scale| Pose {
        transforms: BTreeMap::from([(
            1,
            Transform {
                scale: [scale; 3],
                ..Transform::default()
            },
        )]),
        ..Pose::default()
    };
    let fault = scene.set_pose(&scaled(1e7)).expect_err("out of range");
    assert_eq!(
        fault.to_string(),
        "the pose carries node 'mast' out of range"
    );
    assert_eq!(scene, before);
    scene.set_pose(&scaled(1e3)).expect("in range");
}

#[test]
fn what_the_scene_lacks_is_left_alone() {
    let mut scene = chain(&[Transform::default()]);
    scene.nodes[0].rest = None;
    let before = scene.clone();
    let moved = Transform {
        translation: [1.0; 3],
        ..Transform::default()
    };
    let pose = Pose {
        transforms: BTreeMap::from([(0, moved), (7, moved)]),
        weights: BTreeMap::from([(9, vec![1.0])]),
        shares: BTreeMap::from([(0, 1.0)]),
        ..Pose::default()
    };
    scene.set_pose(&pose).expect("nothing to do");
    assert_eq!(scene, before);
}
