use super::*;
use npr_mesh::testing::Random;
use npr_scene::{Expression, MorphBind, Transform};
use std::collections::BTreeMap;

/// The joints of a standing figure in T-pose: name, the joint that it hangs on, and its place.
const FIGURE: [(&str, Option<u32>, [f32; 3]); 11] = [
    ("hips", None, [0.0, 1.0, 0.0]),
    ("spine", Some(0), [0.0, 1.2, 0.0]),
    ("head", Some(1), [0.0, 1.7, 0.0]),
    ("leftUpperLeg", Some(0), [0.1, 0.9, 0.0]),
    ("leftLowerLeg", Some(3), [0.1, 0.5, 0.0]),
    ("rightUpperLeg", Some(0), [-0.1, 0.9, 0.0]),
    ("leftUpperArm", Some(1), [0.2, 1.5, 0.0]),
    ("leftLowerArm", Some(6), [0.5, 1.5, 0.0]),
    ("hair", Some(2), [0.0, 1.9, -0.1]),
    ("braid", Some(8), [0.0, 1.5, -0.2]),
    ("twist", Some(6), [0.3, 1.5, 0.0]),
];

/// A scene with a skin of joints at these places, turned as a whole by `turn`, hung on node 0; nodes of joints follow.
fn skinned(joints: &[(&str, Option<u32>, [f32; 3])], turn: Mat4) -> Scene {
    let mut nodes = vec![Node {
        skin: Some(0),
        ..Node::default()
    }];
    nodes.extend(joints.iter().map(|(name, parent, _)| Node {
        name: (*name).to_owned(),
        parent: parent.map(|parent| parent + 1),
        rest: Some(Transform::default()),
        ..Node::default()
    }));
    let bind = |place: [f32; 3]| (turn * Mat4::from_translation(place.into())).inverse();
    Scene {
        nodes,
        skins: vec![Skin {
            name: String::new(),
            joints: (1..=joints.len() as u32).collect(),
            inverse_bind: joints
                .iter()
                .map(|j| bind(j.2).to_cols_array_2d())
                .collect(),
        }],
        ..Scene::default()
    }
}

/// What a scene says of a vertex at a place that one joint moves.
fn said(scene: &Scene, joint: u32, place: [f32; 3]) -> (Vec3, f32) {
    let vertex = Vertex {
        position: place,
        ..Vertex::default()
    };
    let influence = Influence {
        joints: [joint, 0, 0, 0],
        weights: [1.0, 0.0, 0.0, 0.0],
    };
    let limbs = Limbs::of(scene, 0, &scene.nodes[0], (&[vertex], &[influence]));
    (limbs.direction_at(0), limbs.face_at(0))
}

/// Whether two directions lie along the same line.
fn same_line(a: Vec3, b: [f32; 3]) -> bool {
    a.cross(Vec3::from(b).normalize()).length() < 1e-3 && a.length() > 0.5
}

#[test]
fn strokes_lean_as_in_american_comics() {
    let figure = skinned(&FIGURE, Mat4::IDENTITY);
    let direction = |joint, place| said(&figure, joint, place).0;
    // On legs to where they begin, and inwards.
    let leg = direction(3, [0.15, 0.7, 0.0]);
    assert!(same_line(leg, [-1.0, 1.0, 0.0]), "{leg}");
    let right = direction(5, [-0.15, 0.7, 0.0]);
    assert!(
        right.x * right.y > 0.0,
        "mirrored on the other leg: {right}"
    );
    // On arms to the hand, and down to the middle of the body; what hangs between two bones of it too.
    let arm = direction(6, [0.3, 1.5, 0.05]);
    assert!(same_line(arm, [1.0, -1.0, 0.0]), "{arm}");
    let twist = direction(10, [0.3, 1.5, 0.05]);
    assert!(same_line(twist, [1.0, -1.0, 0.0]), "{twist}");
    // On the trunk to its middle line.
    let [left, middle, right] = [0.2, 0.0, -0.2].map(|x| direction(0, [x, 1.1, 0.1]));
    assert!(
        left.x * left.y < 0.0 && right.x * right.y > 0.0,
        "{left} {right}"
    );
    assert!(middle.x.abs() < 1e-3, "{middle}");
    // Hair runs along its own joints.
    let hair = direction(8, [0.0, 1.8, -0.1]);
    assert!(same_line(hair, [0.0, -0.4, -0.1]), "{hair}");
    assert_eq!(
        direction(2, [0.0, 1.8, 0.1]),
        Vec3::ZERO,
        "the head has no limb"
    );
}

#[test]
fn faces_are_what_the_head_moves() {
    let mut figure = skinned(&FIGURE, Mat4::IDENTITY);
    let face = |figure: &Scene, joint| said(figure, joint, [0.0, 1.8, 0.1]).1;
    assert_eq!(
        [2, 1, 8, 3].map(|joint| face(&figure, joint)),
        [1.0, 0.0, 0.0, 0.0]
    );

    // Where expressions move meshes, only those have faces.
    for (node, share) in [(0, 1.0), (1, 0.0)] {
        let bones = FIGURE.iter().zip(1..);
        let bones: BTreeMap<Bone, u32> = bones
            .filter_map(|((name, ..), node)| Some((Bone::named(name)?, node)))
            .collect();
        figure.figure = Some(Figure {
            bones,
            expressions: vec![Expression {
                morphs: vec![MorphBind {
                    node,
                    morph: 0,
                    weight: 1.0,
                }],
                ..Expression::default()
            }],
            ..Figure::default()
        });
        assert_eq!(face(&figure, 2), share, "expressions move node {node}");
    }
}

#[test]
fn limbs_without_names_lean_to_where_they_begin() {
    let chain = [
        ("a", None, [0.0, 1.0, 0.0]),
        ("b", Some(0), [0.3, 0.9, 0.0]),
        ("c", Some(1), [0.3, 0.4, 0.0]),
        ("d", Some(0), [-0.3, 0.9, 0.0]),
        ("e", Some(0), [0.0, 2.0, 0.0]),
    ];
    let scene = skinned(&chain, Mat4::IDENTITY);
    let (direction, face) = said(&scene, 1, [0.3, 0.6, 0.1]);
    assert!(same_line(direction, [-1.0, 1.0, 0.0]), "{direction}");
    assert_eq!(face, 0.0);
    let (scattered, _) = said(&scene, 0, [0.0, 1.0, 0.1]);
    assert_eq!(scattered, Vec3::ZERO, "limbs leave it in all directions");
}

#[test]
fn directions_turn_with_the_mesh() {
    let mut random = Random::new(11);
    let still = skinned(&FIGURE, Mat4::IDENTITY);
    for _ in 0..200 {
        let mut unit = || random.unit() * 2.0 - 1.0;
        let turn = glam::Quat::from_scaled_axis(Vec3::new(unit(), unit(), unit()) * 3.0);
        let place = Vec3::new(unit(), unit() + 1.0, unit());
        let turned = skinned(&FIGURE, Mat4::from_quat(turn));
        for joint in 0..FIGURE.len() as u32 {
            let expected = turn * said(&still, joint, place.to_array()).0;
            let (got, _) = said(&turned, joint, (turn * place).to_array());
            let error = (got - expected).length().min((got + expected).length());
            assert!(error < 1e-3, "joint {joint}: {got} is not {expected}");
        }
    }
}

#[test]
fn broken_skins_say_nothing() {
    let mut scene = skinned(&FIGURE, Mat4::IDENTITY);
    scene.skins[0].inverse_bind = vec![[[0.0; 4]; 4]; 3];
    for joint in [0, 3, 6, 99] {
        let (direction, face) = said(&scene, joint, [0.1, 0.7, 0.0]);
        assert!(
            direction.is_finite() && face.is_finite(),
            "{direction} {face}"
        );
    }
    scene.skins[0].inverse_bind = vec![[[f32::NAN; 4]; 4]; FIGURE.len()];
    assert_eq!(said(&scene, 3, [0.1, 0.7, 0.0]).0, Vec3::ZERO);
    let influence = Influence {
        joints: [2; 4],
        weights: [f32::NAN; 4],
    };
    let vertex = (&[Vertex::default()][..], &[influence][..]);
    let limbs = Limbs::of(&scene, 0, &scene.nodes[0], vertex);
    assert_eq!((limbs.direction_at(0), limbs.face_at(0)), (Vec3::ZERO, 0.0));
    let rigid = Limbs::of(&scene, 0, &Node::default(), vertex);
    assert_eq!(rigid, Limbs::default(), "no skin bends it");
}
