use super::*;
use crate::testing::{BODY_BONES, gesture, humanoid, node_of};
use crate::{Format, MemoryResources, Node, Transform, load_bytes};
use proptest::prelude::*;

fn turns() -> impl Strategy<Value = [[f32; 4]; BODY_BONES]> {
    prop::array::uniform15(prop::array::uniform4(0.1f32..1.0))
}

/// Keys of a clip of the humanoid: turns of some of its bones, and places of its hips.
fn clip(scene: &Scene, interpolation: Interpolation, numbers: &[f32]) -> Clip {
    let times: Arc<[f32]> = [0.0, 1.0].into();
    let count = times.len() * interpolation.knots();
    let mut numbers = numbers.iter().copied().cycle();
    let mut channel = |node: u32, property, width: usize, rest: &[f32]| Channel {
        node,
        property,
        interpolation,
        times: times.clone(),
        values: (0..count * width)
            .map(|i| rest[i % width] + numbers.next().unwrap_or(0.0))
            .collect(),
    };
    let rest = scene.nodes[0].rest.expect("hips");
    let mut channels = vec![channel(0, Property::Translation, 3, &rest.translation)];
    for bone in ["hips", "spine", "leftUpperArm", "leftHand", "rightLowerLeg"] {
        let node = node_of(Bone::named(bone).expect("a bone")).expect("a node");
        let rest = scene.nodes[node as usize].rest.expect("a bone");
        channels.push(channel(node, Property::Rotation, 4, &rest.rotation));
    }
    Clip {
        name: "Sway".to_owned(),
        channels,
    }
}

/// Where all nodes stand at a time of the first clip.
fn places(scene: &Scene, time_s: f32) -> Vec<[f32; 3]> {
    let mut posed = scene.clone();
    posed
        .set_pose(&scene.pose_at(&scene.clips[0], time_s))
        .expect("in range");
    let place = |node: &Node| {
        let [x, y, z, _] = node.world_from_node[3];
        [x, y, z]
    };
    posed.nodes.iter().map(place).collect()
}

/// A humanoid that hangs on a node which is moved, turned and scaled, and stands where it stood.
fn hung(mut scene: Scene, root: Transform) -> Scene {
    // Put the node before all others.
    for node in &mut scene.nodes {
        node.parent = Some(node.parent.map_or(0, |parent| parent + 1));
        node.children.iter_mut().for_each(|child| *child += 1);
    }
    let hook = Node {
        children: vec![1],
        rest: Some(root),
        ..Node::default()
    };
    scene.nodes.insert(0, hook);

    // Let the hips stand where they stood.
    let back = matrix::inverse(&root.matrix()).expect("no flat node");
    let hips = scene.nodes[1].rest.as_mut().expect("hips");
    let [x, y, z] = hips.translation.map(f64::from);
    hips.translation = std::array::from_fn(|i| {
        (back[0][i] * x + back[1][i] * y + back[2][i] * z + back[3][i]) as f32
    });
    let turn = quaternion::unit(root.rotation);
    hips.rotation = quaternion::multiply(quaternion::inverse(turn), hips.rotation);
    hips.scale = root.scale.map(|scale| 1.0 / scale);
    scene.set_pose(&crate::Pose::default()).expect("in range");
    scene
}

fn played(scene: &Scene, motion: &Scene) -> (Scene, Vec<Notice>) {
    let motions = scene
        .clips_of(motion, &Limits::default())
        .expect("a motion");
    let scene = Scene {
        clips: motions.clips,
        ..scene.clone()
    };
    scene.sanity_check();
    (scene, motions.notices)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Two humanoids of one shape do the same in the world, however their nodes are turned; a larger one does it
    /// larger.
    #[test]
    fn a_motion_looks_the_same_on_any_humanoid_of_the_shape(
        from in turns(), to in turns(), size in 0.3f32..4.0, time in -0.5f32..1.5,
        numbers in prop::collection::vec(-0.3f32..0.3, 37), kind in 0usize..3,
        translation in prop::array::uniform3(-2f32..2.0), rotation in prop::array::uniform4(0.1f32..1.0),
        scale in 0.3f32..3.0,
    ) {
        let kinds = [Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline];
        let mut motion = humanoid(1.0, &from);
        motion.clips = vec![clip(&motion, kinds[kind], &numbers)];
        let root = Transform { translation, rotation, scale: [scale; 3] };
        let (scene, notices) = played(&hung(humanoid(size, &to), root), &motion);
        prop_assert_eq!(notices, vec![]);
        prop_assert_eq!(scene.clips[0].channels.len(), 6);
        for (a, b) in places(&motion, time).into_iter().zip(places(&scene, time).into_iter().skip(1)) {
            for i in 0..3 {
                prop_assert!((a[i] * size - b[i]).abs() < 2e-4 * size, "{a:?} x {size} and {b:?}");
            }
        }
    }
}

#[test]
fn what_cannot_move_is_said() {
    let straight = [[0.0, 0.0, 0.0, 1.0]; BODY_BONES];
    let (mut scene, nobody) = (humanoid(1.0, &straight), Scene::default());
    let fault = |scene: &Scene, motion: &Scene| {
        let limits = Limits {
            memory_bytes: 100,
            ..Limits::default()
        };
        scene.clips_of(motion, &limits).expect_err("no motion")
    };
    assert_eq!(fault(&nobody, &scene), MotionError::NoBones);
    assert_eq!(fault(&scene, &nobody), MotionError::NoBonesInMotion);
    assert_eq!(fault(&scene, &scene), MotionError::NoClips);
    scene.clips = vec![clip(&scene, Interpolation::Linear, &[0.1])];
    assert!(matches!(fault(&scene, &scene), MotionError::Limit(_)));

    // Hips at the ground have no height to measure by.
    let mut sunk = humanoid(1.0, &straight);
    sunk.nodes[0].rest = Some(Transform::default());
    let (played, notices) = played(&sunk, &scene);
    assert_eq!(played.clips[0].channels.len(), 5);
    assert!(
        notices[0].text.contains("they rest at the ground"),
        "{notices:?}"
    );
}

#[test]
fn expressions_of_a_motion_become_shares() {
    let resources = MemoryResources::default();
    let motion = load_bytes(
        "gesture",
        &gesture(),
        Some(Format::Glb),
        &resources,
        &Limits::default(),
    );
    let motion = motion.expect("a VRM animation");
    motion.sanity_check();
    assert_eq!(motion.notices, vec![]);
    let mut scene = humanoid(1.0, &[[0.0, 0.0, 0.0, 1.0]; BODY_BONES]);
    let happy = crate::Expression {
        name: "happy".to_owned(),
        ..Default::default()
    };
    scene.figure = Some(crate::Figure {
        expressions: vec![happy],
        ..Default::default()
    });
    let (scene, notices) = played(&scene, &motion);
    let said: Vec<&str> = notices.iter().map(|notice| notice.text.as_str()).collect();
    let wanted = [
        "expression 'blink' of the motion is none of the scene",
        "where the figure of the motion looks is not used",
    ];
    assert_eq!(said, wanted);
    let shares = |time| scene.pose_at(&scene.clips[0], time).shares;
    assert_eq!(shares(0.25), [(0, 0.25)].into());
    assert_eq!(shares(2.0), [(0, 0.5)].into());
}
