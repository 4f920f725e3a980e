use super::vector::{Vector, length, minus, plus, scaled};
use super::*;
use crate::matrix;
use crate::node::Node;
use crate::pose::Pose;
use crate::quaternion::{self, Quaternion};
use crate::scene::Scene;
use crate::transform::Transform;
use proptest::prelude::*;
use std::sync::Arc;

/// Seconds of a step.
const STEP_S: f64 = 1.0 / 60.0;

fn turn() -> impl Strategy<Value = Quaternion> {
    let turn = prop::array::uniform4(-1f32..1.0);
    turn.prop_filter("length", |q| q.iter().map(|v| v * v).sum::<f32>() > 0.01)
        .prop_map(quaternion::unit)
}

/// A step beside the parent, long enough for a bone.
fn way() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(-0.4f32..0.4).prop_filter("length", |way| {
        way.iter().map(|v| v * v).sum::<f32>() > 0.01
    })
}

fn joint() -> impl Strategy<Value = SpringJoint> {
    (
        0f32..4.0,
        prop::array::uniform3(-1f32..1.0),
        0f32..=1.0,
        0f32..0.05,
    )
        .prop_map(|(stiffness, gravity, drag, radius)| SpringJoint {
            node: 0,
            end: [0.0; 3],
            chain: 0,
            radius,
            stiffness,
            gravity,
            drag,
        })
}

/// A root, nodes that hang one on the other behind it, all of which swing but the last, and a node beside them.
fn strand(rests: &[([f32; 3], Quaternion)], joints: &[SpringJoint]) -> Scene {
    let mut scene = Scene::default();
    let root = ([0.0, 1.0, 0.0], quaternion::NO_TURN);
    let all = [root].into_iter().chain(rests.iter().copied());
    for (index, (translation, rotation)) in (0u32..).zip(all) {
        let parent = index.checked_sub(1);
        let rest = Transform {
            translation,
            rotation,
            ..Transform::default()
        };
        let above = parent.map(|parent| scene.nodes[parent as usize].world_from_node);
        let above = above.unwrap_or(matrix::IDENTITY);
        if let Some(parent) = parent {
            scene.nodes[parent as usize].children.push(index);
        }
        scene.nodes.push(Node {
            parent,
            rest: Some(rest),
            local: rest.matrix(),
            world_from_node: matrix::multiply(&above, &rest.matrix()),
            ..Node::default()
        });
    }
    scene.nodes.push(Node {
        rest: Some(Transform::default()),
        ..Node::default()
    });
    let count = rests.len().saturating_sub(1);
    let joints = (1u32..)
        .zip(joints)
        .take(count)
        .map(|(node, joint)| SpringJoint {
            node,
            end: rests[node as usize].0,
            ..*joint
        });
    scene.springs = Some(Arc::new(Springs {
        joints: joints.collect(),
        chains: vec![SpringChain::default()],
        colliders: Vec::new(),
    }));
    scene.sanity_check();
    scene
}

fn change(scene: &mut Scene, change: impl FnOnce(&mut Springs)) {
    let springs = scene.springs.as_mut().expect("springs");
    change(Arc::make_mut(springs));
    scene.sanity_check();
}

/// The pose in which the root of a strand is moved and turned.
fn carried(scene: &Scene, way: [f32; 3], turn: Quaternion) -> Pose {
    let rest = scene.nodes[0].rest.expect("a rest");
    let stand = Transform {
        translation: std::array::from_fn(|i| rest.translation[i] + way[i]),
        rotation: turn,
        ..rest
    };
    Pose {
        transforms: [(0, stand)].into(),
        ..Pose::default()
    }
}

/// The scene in a pose, with its joints as they swing.
fn posed(scene: &Scene, pose: &Pose, swing: &Swing) -> Scene {
    let joints = &scene.springs.as_ref().expect("springs").joints;
    let mut pose = pose.clone();
    let nodes = joints.iter().map(|joint| joint.node);
    pose.swings = nodes.zip(swing.turns().iter().copied()).collect();
    let mut posed = scene.clone();
    posed.set_pose(&pose).expect("in range");
    posed
}

fn in_world(scene: &Scene, node: u32, place: [f32; 3]) -> Vector {
    let world = &scene.nodes[node as usize].world_from_node;
    matrix::transform_point(world, place).map(f64::from)
}

/// A walk of the root: where it is, and how it is turned, at every step.
fn walk() -> impl Strategy<Value = Vec<([f32; 3], Quaternion)>> {
    let leg = (prop::array::uniform3(-0.02f32..0.02), turn());
    prop::collection::vec(leg, 1..4).prop_map(|legs| {
        let (mut walk, mut at, mut last) = (Vec::new(), [0.0f32; 3], quaternion::NO_TURN);
        for (way, turn) in legs {
            for step in 1..=12 {
                at = std::array::from_fn(|i| at[i] + way[i]);
                walk.push((at, quaternion::on_arc(last, turn, step as f32 / 12.0)));
            }
            last = turn;
        }
        walk
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases.max(64), ..ProptestConfig::default() })]

    /// The published text, for one joint after the other, in the world and without colliders.
    #[test]
    fn joints_swing_as_published(
        rests in prop::collection::vec((way(), turn()), 4), joints in prop::collection::vec(joint(), 3), walk in walk(),
    ) {
        let scene = strand(&rests, &joints);
        let mut swing = Swing::new(&scene, &Pose::default());
        let joints = scene.springs.as_ref().expect("springs").joints.clone();
        let rest = |joint: &SpringJoint| [in_world(&scene, joint.node, joint.end); 2];
        let mut ends: Vec<[Vector; 2]> = joints.iter().map(rest).collect();
        for (way, turn) in walk {
            let pose = carried(&scene, way, turn);
            swing.step(&scene, &pose, STEP_S);
            swing.sanity_check();

            // Go from the first joint to the last, each in a scene in which those before are turned.
            let mut wanted = pose.clone();
            for (joint, [now, last]) in joints.iter().zip(&mut ends) {
                let mut stood = scene.clone();
                stood.set_pose(&wanted).expect("in range");
                let (head, rest) = (in_world(&stood, joint.node, [0.0; 3]), in_world(&stood, joint.node, joint.end));
                let long = length(minus(rest, head));
                let inertia = scaled(minus(*now, *last), 1.0 - f64::from(joint.drag));
                let stiffness = scaled(minus(rest, head), f64::from(joint.stiffness) * STEP_S / long);
                let gravity = scaled(joint.gravity.map(f64::from), STEP_S);
                let next = plus(plus(plus(*now, inertia), stiffness), gravity);
                let way = minus(next, head);
                let next = plus(head, scaled(way, long / length(way)));
                (*last, *now) = (*now, next);

                // Turn it by hand.
                let back = matrix::inverse(&stood.nodes[joint.node as usize].world_from_node).expect("no flat node");
                let [a, b, c, d] = back;
                let local: [f32; 3] = std::array::from_fn(|i| {
                    (a[i] * next[0] + b[i] * next[1] + c[i] * next[2] + d[i]) as f32
                });
                let stand = scene.nodes[joint.node as usize].rest.expect("a rest");
                let rotation = quaternion::multiply(stand.rotation, quaternion::between(joint.end, local));
                wanted.transforms.insert(joint.node, Transform { rotation, ..stand });
            }
            let (found, mut by_hand) = (posed(&scene, &pose, &swing), scene.clone());
            by_hand.set_pose(&wanted).expect("in range");
            for joint in &joints {
                let [a, b] = [&found, &by_hand].map(|scene| in_world(scene, joint.node, joint.end));
                prop_assert!(length(minus(a, b)) < 2e-4, "{a:?} {b:?}");
            }
        }
    }

    /// Bones neither grow nor shrink, whatever pushes them, and joints point at their ends.
    #[test]
    fn bones_keep_their_length_outside_of_colliders(
        rests in prop::collection::vec((way(), turn()), 3), joints in prop::collection::vec(joint(), 2), walk in walk(),
        from in way(), to in way(), radius in 0.01f32..0.05,
    ) {
        // Carry a capsule beside the strand, away from its joints.
        let mut scene = strand(&rests, &joints);
        change(&mut scene, |springs| {
            springs.colliders = vec![Collider { node: 0, from, to, radius }];
            springs.chains[0].colliders = vec![0];
        });
        let springs = Arc::clone(scene.springs.as_ref().expect("springs"));
        let mut swing = Swing::new(&scene, &Pose::default());
        for (way, turn) in walk {
            let pose = carried(&scene, way, turn);
            swing.step(&scene, &pose, STEP_S);
            let found = posed(&scene, &pose, &swing);
            let [from, to] = [from, to].map(|place| in_world(&found, 0, place));
            for (joint, rest) in springs.joints.iter().zip(&rests[1..]) {
                let (head, end) = (in_world(&found, joint.node, [0.0; 3]), in_world(&found, joint.node, joint.end));
                let long = rest.0.iter().map(|v| v * v).sum::<f32>().sqrt();
                prop_assert!((length(minus(end, head)) - f64::from(long)).abs() < 1e-5);

                // Nearest place on the capsule, looked for step by step.
                let far = |place: Vector| {
                    let steps = (0..=400).map(|i| f64::from(i) / 400.0);
                    let on = steps.map(|share| plus(from, scaled(minus(to, from), share)));
                    on.map(|on| length(minus(place, on))).fold(f64::MAX, f64::min)
                };
                let wanted = f64::from(radius + joint.radius);
                // A joint that touches it itself, or hardly does not, may have nowhere to go.
                if far(head) > wanted + 0.5 * f64::from(long) {
                    prop_assert!(far(end) > wanted - 2e-3, "{} of {wanted}", far(end));
                }
            }
        }
    }

    /// What rests stays to the bit, in the pose at rest and in others.
    #[test]
    fn nothing_moves_where_nothing_moves_it(
        rests in prop::collection::vec((way(), turn()), 4), joints in prop::collection::vec(joint(), 3),
        way in way(), turn in turn(),
    ) {
        let mut scene = strand(&rests, &joints);
        change(&mut scene, |springs| springs.joints.iter_mut().for_each(|joint| joint.gravity = [0.0; 3]));
        let pose = carried(&scene, way, turn);
        let mut swing = Swing::new(&scene, &pose);
        let rest = swing.turns().to_vec();
        for _ in 0..40 {
            swing.step(&scene, &pose, STEP_S);
        }
        prop_assert_eq!(swing.turns(), &rest[..]);
        for (found, (_, wanted)) in rest.iter().zip(&rests) {
            prop_assert!(found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6));
        }
    }

    /// Without gravity they come back to rest, and with it no more moves after a while.
    #[test]
    fn what_swings_comes_to_rest(
        rests in prop::collection::vec((way(), turn()), 3), joints in prop::collection::vec(joint(), 2), turn in turn(),
    ) {
        let mut scene = strand(&rests, &joints);
        change(&mut scene, |springs| springs.joints.iter_mut().for_each(|joint| {
            (joint.drag, joint.stiffness) = (joint.drag.max(0.3), joint.stiffness.max(1.0));
            joint.gravity = joint.gravity.map(|v| 0.2 * v);
        }));
        let mut free = scene.clone();
        change(&mut free, |springs| springs.joints.iter_mut().for_each(|joint| joint.gravity = [0.0; 3]));
        for (scene, falls) in [(&scene, true), (&free, false)] {
            let mut swing = Swing::new(scene, &Pose::default());
            let rest = swing.turns().to_vec();
            let pose = carried(scene, [0.0; 3], turn);
            for _ in 0..900 {
                swing.step(scene, &pose, STEP_S);
            }
            let before = swing.turns().to_vec();
            swing.step(scene, &pose, STEP_S);
            for ((now, before), rest) in swing.turns().iter().zip(&before).zip(&rest) {
                let same = |a: &Quaternion, b: &Quaternion| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>().abs();
                prop_assert!(same(now, before) > 0.99999);
                prop_assert!(falls || same(now, rest) > 0.999, "{now:?} {rest:?}");
            }
        }
    }

    /// What carries the centre of a spring does not swing it.
    #[test]
    fn a_centre_takes_its_own_motion_away(
        rests in prop::collection::vec((way(), turn()), 3), joints in prop::collection::vec(joint(), 2), walk in walk(),
    ) {
        let mut scene = strand(&rests, &joints);
        change(&mut scene, |springs| springs.joints.iter_mut().for_each(|joint| joint.gravity = [0.0; 3]));
        let mut centred = scene.clone();
        change(&mut centred, |springs| springs.chains[0].center = Some(0));
        let mut swings = [&scene, &centred].map(|scene| Swing::new(scene, &Pose::default()));
        let rest = swings[0].turns().to_vec();
        for (way, turn) in walk {
            let pose = carried(&scene, way, turn);
            swings[0].step(&scene, &pose, STEP_S);
            swings[1].step(&centred, &pose, STEP_S);
        }
        let apart = |swing: &Swing| {
            let pairs = swing.turns().as_flattened().iter().zip(rest.as_flattened());
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
        };
        prop_assert!(apart(&swings[1]) < 1e-3, "{}", apart(&swings[1]));
    }

    /// A time of a film looks the same, whichever times were asked for before.
    #[test]
    fn times_stand_for_themselves(
        rests in prop::collection::vec((way(), turn()), 3), joints in prop::collection::vec(joint(), 2),
        times in prop::collection::vec(-0.1f32..1.2, 1..8), turn in turn(),
    ) {
        let scene = strand(&rests, &joints);
        let pose_at = |time: f32| {
            let share = (time / 0.7).clamp(0.0, 1.0);
            carried(&scene, [share, 0.0, 0.0], quaternion::on_arc(quaternion::NO_TURN, turn, share))
        };
        let mut all = Swinging::default();
        for time in times {
            let alone = Swinging::default().at(&scene, time, pose_at);
            prop_assert_eq!(alone.len(), 2);
            prop_assert_eq!(all.at(&scene, time, pose_at), alone);
        }
    }
}

/// A strand of one bone that hangs down from the root.
fn plumb(joint: SpringJoint) -> Scene {
    let rests = [
        ([0.1, 0.0, 0.0], quaternion::NO_TURN),
        ([0.0, -0.3, 0.0], quaternion::NO_TURN),
    ];
    strand(&rests, &[joint])
}

const PLUMB: SpringJoint = SpringJoint {
    node: 0,
    end: [0.0; 3],
    chain: 0,
    radius: 0.0,
    stiffness: 1.0,
    gravity: [0.0; 3],
    drag: 0.4,
};

#[test]
fn ends_lag_behind_and_cuts_begin_anew() {
    let scene = plumb(PLUMB);
    let mut swing = Swing::new(&scene, &Pose::default());
    let rest = swing.turns().to_vec();
    let lag = |swing: &Swing, pose: &Pose| {
        let stood = posed(&scene, pose, swing);
        in_world(&stood, 1, [0.0, -0.3, 0.0])[0] - in_world(&stood, 1, [0.0; 3])[0]
    };
    let mut pose = Pose::default();
    for step in 1..=20 {
        pose = carried(&scene, [0.02 * step as f32, 0.0, 0.0], quaternion::NO_TURN);
        swing.step(&scene, &pose, STEP_S);
        assert!(lag(&swing, &pose) < 0.0, "{step}");
    }
    assert!(lag(&swing, &pose) < -0.02);

    // The figure is 1.1 high: a way of 2 in a step is a cut, and what comes after is as if it had rested.
    let pose = carried(&scene, [2.5, 0.0, 0.0], quaternion::NO_TURN);
    swing.step(&scene, &pose, STEP_S);
    assert_eq!(swing.turns(), rest);
    swing.step(&scene, &pose, STEP_S);
    assert_eq!(swing.turns(), rest);
}

#[test]
fn what_swung_rests_to_the_bit() {
    // Carried away for a while, then left where it is: it swings back, and stands as if it had never swung.
    let stiff = SpringJoint {
        stiffness: 4.0,
        ..PLUMB
    };
    let scene = plumb(stiff);
    let mut swing = Swing::new(&scene, &Pose::default());
    let rest = swing.turns().to_vec();
    for step in 1..=20 {
        let pose = carried(&scene, [0.02 * step as f32, 0.0, 0.0], quaternion::NO_TURN);
        swing.step(&scene, &pose, STEP_S);
    }
    assert_ne!(swing.turns(), rest);
    let pose = carried(&scene, [0.4, 0.0, 0.0], quaternion::NO_TURN);
    for _ in 0..600 {
        swing.step(&scene, &pose, STEP_S);
    }
    assert_eq!(swing.turns(), rest);
}

#[test]
fn between_steps_joints_stand_between_their_turns() {
    let scene = plumb(SpringJoint {
        gravity: [0.5, 0.0, 0.0],
        ..PLUMB
    });
    let at = |time: f32| Swinging::default().at(&scene, time, |_| Pose::default())[&1];
    let [from, to, half] = [at(10.0 / 60.0), at(11.0 / 60.0), at(10.5 / 60.0)];
    assert_ne!(from, to);
    assert_eq!(half, quaternion::on_arc(from, to, 0.5));
    assert_eq!(at(-3.0), at(0.0));
    assert_eq!(at(f32::NAN), at(0.0));

    // Frames of 12, 24 and 60 a second show the same.
    for frame in 0..8u32 {
        let seconds = |fps: u32, frame: u32| (f64::from(frame) / f64::from(fps)) as f32;
        assert_eq!(at(seconds(12, frame)), at(seconds(24, 2 * frame)));
        assert_eq!(at(seconds(12, frame)), at(seconds(60, 5 * frame)));
    }

    // Every hour they rest anew.
    let mut swinging = Swinging::default();
    let later = swinging.at(&scene, 3600.0 + 10.0 / 60.0, |_| Pose::default());
    let apart = later[&1]
        .iter()
        .zip(from)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max);
    assert!(apart < 1e-3, "{apart}");
}

#[test]
fn a_scene_without_springs_has_nothing_that_swings() {
    let scene = Scene::default();
    assert!(
        Swinging::default()
            .at(&scene, 5.0, |_| Pose::default())
            .is_empty()
    );
}
