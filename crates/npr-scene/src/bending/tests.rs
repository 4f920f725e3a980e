use super::*;
use crate::figure::Figure;
use crate::quaternion::unit;
use crate::testing::{BODY_BONES, humanoid, node_of};
use proptest::prelude::*;

fn turns() -> impl Strategy<Value = [[f32; 4]; BODY_BONES]> {
    prop::array::uniform15(
        prop::array::uniform4(-1f32..1.0)
            .prop_filter("length", |q| q.iter().map(|v| v * v).sum::<f32>() > 0.01),
    )
}

fn bone(name: &str) -> Bone {
    Bone::named(name).expect("a bone")
}

/// The scene as the posture has it.
fn posed(scene: &Scene, posture: &Posture) -> Scene {
    let (mut pose, mut posed) = (Pose::default(), scene.clone());
    scene.bend(&mut pose, posture);
    posed.set_pose(&pose).expect("in range");
    posed
}

/// What lies between two matrices: the greatest difference of their numbers.
fn apart(a: &Matrix, b: &Matrix) -> f32 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

fn turning(turn: [f32; 4]) -> Matrix {
    matrix::from_parts([0.0; 3], unit(turn), [1.0; 3])
}

/// A matrix without its place.
fn axes(mut m: Matrix) -> Matrix {
    m[3] = [0.0, 0.0, 0.0, 1.0];
    m
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Along the axes of the world, whatever those of the nodes are; bones further out go with it.
    #[test]
    fn bones_turn_along_the_axes_of_the_world(
        turns in turns(), arm in prop::array::uniform4(0.1f32..1.0), hand in prop::array::uniform4(-1f32..-0.1),
    ) {
        let rest = humanoid(1.3, &turns);
        let names = ["leftUpperArm", "leftLowerArm", "leftHand"].map(bone);
        let posture = Posture { turns: [(names[0], arm), (names[2], hand)].into(), hips: None };
        let bent = posed(&rest, &posture);
        let [upper, lower, palm] = names.map(|bone| node_of(bone).expect("a node") as usize);
        let turned = [
            (upper, turning(arm)),
            (lower, turning(arm)),
            (palm, matrix::multiply(&turning(arm), &turning(hand))),
        ];
        for (node, turn) in turned {
            let wanted = matrix::multiply(&turn, &axes(rest.nodes[node].world_from_node));
            prop_assert!(apart(&wanted, &axes(bent.nodes[node].world_from_node)) < 1e-5, "{node}");
        }
        let lag = |scene: &Scene, node: usize| -> [f32; 3] {
            let [from, to] = [upper, node].map(|node| scene.nodes[node].world_from_node[3]);
            std::array::from_fn(|i| to[i] - from[i])
        };
        let wanted = matrix::transform_point(&turning(arm), lag(&rest, palm));
        let found = lag(&bent, palm);
        prop_assert!(wanted.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-5));

        // Nothing else moves.
        for (node, (before, after)) in rest.nodes.iter().zip(&bent.nodes).enumerate() {
            if ![upper, lower, palm].contains(&node) {
                prop_assert!(before.world_from_node == after.world_from_node, "{node}");
            }
        }
    }

    #[test]
    fn hips_carry_all_of_it_along_the_axes_of_the_world(
        turns in turns(), way in prop::array::uniform3(-2f32..2.0), root in prop::array::uniform4(0.2f32..1.0),
    ) {
        // Hang it on a node that is turned and scaled.
        let mut rest = humanoid(1.0, &turns);
        let mut hung = rest.clone();
        let stand = Transform { translation: [1.0, 2.0, 3.0], rotation: root, scale: [0.5; 3] };
        hung.nodes.push(crate::Node { rest: Some(stand), local: stand.matrix(), ..Default::default() });
        hung.nodes.rotate_right(1);
        for (index, node) in hung.nodes.iter_mut().enumerate().skip(1) {
            node.parent = Some(node.parent.map_or(0, |parent| parent + 1));
            node.children.iter_mut().for_each(|child| *child += 1);
            if index == 1 { node.parent = Some(0); }
        }
        hung.nodes[0].children = vec![1];
        let pose = Pose { transforms: [(0, Transform { translation: [9.0; 3], ..stand })].into(), ..Pose::default() };
        hung.set_pose(&pose).expect("in range");
        hung.set_pose(&Pose::default()).expect("in range");
        for scene in [&mut rest, &mut hung] {
            let moved = posed(scene, &Posture { hips: Some(way), ..Posture::default() });
            let first = scene.nodes.len() - BODY_BONES;
            for (before, after) in scene.nodes.iter().zip(&moved.nodes).skip(first) {
                let [before, after] = [before, after].map(|node| node.world_from_node[3]);
                let apart = (0..3).map(|i| (before[i] + way[i] - after[i]).abs()).fold(0.0, f32::max);
                prop_assert!(apart < 2e-5, "{apart}");
            }
        }
    }
}

#[test]
fn an_empty_posture_changes_nothing() {
    let scene = humanoid(1.0, &[[0.1, 0.2, 0.3, 0.9]; BODY_BONES]);
    let mut pose = Pose::default();
    scene.bend(&mut pose, &Posture::default());
    assert_eq!(pose, Pose::default());
    let ring = bone("leftRingDistal");
    let lacking = Posture {
        turns: [(ring, [1.0, 0.0, 0.0, 1.0])].into(),
        hips: None,
    };
    scene.bend(&mut pose, &lacking);
    assert_eq!(pose, Pose::default());
}

#[test]
fn a_posture_counts_where_a_clip_turns_the_same_bone() {
    let scene = humanoid(1.0, &[[0.0, 0.0, 0.0, 1.0]; BODY_BONES]);
    let head = bone("head");
    let node = node_of(head).expect("a node");
    let by_clip = Transform {
        translation: [0.0, 7.0, 0.0],
        rotation: [1.0, 0.0, 0.0, 1.0],
        scale: [2.0; 3],
    };
    let mut pose = Pose {
        transforms: [(node, by_clip)].into(),
        ..Pose::default()
    };
    let turn = [0.0, 0.0, 1.0, 0.0];
    let posture = Posture {
        turns: [(head, turn)].into(),
        hips: None,
    };
    scene.bend(&mut pose, &posture);
    let wanted = Transform {
        rotation: turn,
        ..by_clip
    };
    assert_eq!(pose.transforms, [(node, wanted)].into());
}

#[test]
fn nodes_are_bones_by_their_names_where_no_figure_names_them() {
    let mut scene = humanoid(1.0, &[[0.0, 0.0, 0.0, 1.0]; BODY_BONES]);
    assert_eq!(scene.bones().len(), BODY_BONES);
    scene.nodes[1].name = "mixamorig:Spine".to_owned();
    scene.nodes[2].name = "HIPS".to_owned();
    scene.nodes[3].rest = None;
    let bones = scene.bones();
    assert_eq!((bones[&Bone::HIPS], bones[&bone("spine")]), (0, 1));
    assert!(!bones.contains_key(&bone("head")) && !bones.contains_key(&bone("leftUpperLeg")));
    scene.figure = Some(Figure {
        bones: [(Bone::HIPS, 5)].into(),
        ..Figure::default()
    });
    assert_eq!(scene.bones(), [(Bone::HIPS, 5)].into());
}
