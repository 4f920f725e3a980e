use super::*;
use crate::expression::{Expression, MorphBind, Override};
use crate::figure::Figure;
use crate::look_at::{LookAt, RangeMap};
use crate::matrix::turn_of;
use crate::node::Node;
use crate::quaternion::unit;
use crate::testing::{BODY_BONES, humanoid, node_of};
use crate::transform::Transform;
use proptest::prelude::*;

fn turn() -> impl Strategy<Value = Quaternion> {
    prop::array::uniform4(-1f32..1.0)
        .prop_filter("length", |q| q.iter().map(|v| v * v).sum::<f32>() > 0.01)
}

/// A map that gives what it is given, up to a right angle.
fn plain() -> RangeMap {
    RangeMap {
        most_deg: 90.0,
        output: 90.0,
        curve: Vec::new(),
    }
}

/// A humanoid with eyes, whose nodes are turned in any way.
fn seeing(turns: &[[f32; 4]; BODY_BONES], eyes: [Quaternion; 2], kind: Eyes) -> Scene {
    let mut scene = humanoid(1.0, turns);
    let head = node_of(Bone::HEAD).expect("a head");
    let mut bones = scene.bones();
    for (bone, rotation) in [Bone::LEFT_EYE, Bone::RIGHT_EYE].into_iter().zip(eyes) {
        let rest = Transform {
            translation: [0.1, 0.2, -0.1],
            rotation: unit(rotation),
            ..Transform::default()
        };
        let index = scene.nodes.len() as u32;
        let above = scene.nodes[head as usize].world_from_node;
        scene.nodes[head as usize].children.push(index);
        scene.nodes.push(Node {
            parent: Some(head),
            rest: Some(rest),
            local: rest.matrix(),
            world_from_node: matrix::multiply(&above, &rest.matrix()),
            ..Node::default()
        });
        bones.insert(bone, index);
    }
    let face = |(morph, name): (u32, &str)| Expression {
        name: name.to_owned(),
        morphs: vec![MorphBind {
            node: 0,
            morph,
            weight: 1.0,
        }],
        ..Expression::default()
    };
    let names = ["lookUp", "lookDown", "lookLeft", "lookRight"];
    let mut expressions: Vec<Expression> = (0..).zip(names).map(face).collect();
    let other = |name: &str, of_looks| Expression {
        name: name.to_owned(),
        of_looks,
        ..Expression::default()
    };
    expressions.push(other("angry", Override::Block));
    expressions.push(other("happy", Override::Blend));
    scene.figure = Some(Figure {
        bones,
        expressions,
        look_at: Some(LookAt {
            eyes: kind,
            offset: [0.02, 0.1, 0.03],
            inner: plain(),
            outer: plain(),
            down: plain(),
            up: plain(),
        }),
        ..Figure::default()
    });
    scene.sanity_check();
    scene
}

/// How far the bone of an eye is turned in a pose, in the world, from how it rests.
fn turned_by(scene: &Scene, posed: &Scene, bone: Bone) -> Quaternion {
    let node = scene.figure.as_ref().expect("a figure").bones[&bone] as usize;
    let [rest, now] = [scene, posed].map(|scene| turn_of(&scene.nodes[node].world_from_node));
    quaternion::multiply(now, quaternion::inverse(rest))
}

/// Where the point between the eyes is, and a point some way from there, in the space of a head at rest.
fn ahead(posed: &Scene, rest: &Scene, way: [f32; 3]) -> [f32; 3] {
    let head = node_of(Bone::HEAD).expect("a head") as usize;
    let offset = rest
        .figure
        .as_ref()
        .and_then(|figure| figure.look_at.as_ref())
        .expect("looks")
        .offset;
    let from = matrix::transform_point(&posed.nodes[head].world_from_node, offset);
    let [now, rest] = [posed, rest].map(|scene| turn_of(&scene.nodes[head].world_from_node));
    let turn = quaternion::multiply(now, quaternion::inverse(rest));
    let way = quaternion::turned(turn, way);
    std::array::from_fn(|i| from[i] + way[i])
}

proptest! {
    /// Where nothing limits them, eyes point at what they look at, however head and eyes are turned.
    #[test]
    fn eyes_point_along_the_look(
        turns in prop::array::uniform15(turn()), eyes in prop::array::uniform2(turn()), head in turn(),
        aside in -3f32..3.0, up in -3f32..3.0, far in 0.5f32..4.0,
    ) {
        let scene = seeing(&turns, eyes, Eyes::Bones);
        let mut pose = Pose::default();
        scene.bend(&mut pose, &Posture { turns: [(Bone::HEAD, head)].into(), hips: Some([1.0, 2.0, 3.0]) });
        let mut posed = scene.clone();
        posed.set_pose(&pose).expect("in range");
        let target = ahead(&posed, &scene, [aside, up, far]);
        pose.look_at = Some(target);
        let before = pose.clone();
        posed.set_pose(&pose).expect("in range");
        prop_assert!(pose == before);
        let from = ahead(&posed, &scene, [0.0; 3]);
        let way: [f32; 3] = std::array::from_fn(|i| target[i] - from[i]);
        let length = way.iter().map(|v| v * v).sum::<f32>().sqrt();
        for bone in [Bone::LEFT_EYE, Bone::RIGHT_EYE] {
            let front = quaternion::turned(turned_by(&scene, &posed, bone), [0.0, 0.0, 1.0]);
            for i in 0..3 {
                prop_assert!((front[i] - way[i] / length).abs() < 1e-3, "{front:?} {way:?}");
            }
        }
    }

    /// Expressions share the angles out: never both sides, and what has a share keeps it.
    #[test]
    fn expressions_share_the_look_out(aside in -3f32..3.0, up in -3f32..3.0, kept in prop::option::of(0f32..=1.0)) {
        let mut scene = seeing(&[[0.0, 0.0, 0.0, 1.0]; BODY_BONES], [[0.0, 0.0, 0.0, 1.0]; 2], Eyes::Expressions);
        let figure = scene.figure.as_mut().expect("a figure");
        let look = figure.look_at.as_mut().expect("looks");
        for map in [&mut look.down, &mut look.up, &mut look.outer] {
            map.output = 1.0;
        }
        let shares = kept.map(|share| (2, share));
        let mut pose = Pose {
            look_at: Some(ahead(&scene, &scene, [aside, up, 1.0])),
            shares: shares.into_iter().collect(),
            ..Pose::default()
        };
        scene.look(&mut pose);
        let degrees = |a: f32, b: f32| math::atan2(a, b).to_degrees() / 90.0;
        let (yaw, pitch) = (degrees(aside, 1.0), degrees(up, (1.0 + aside * aside).sqrt()));
        let wanted = [pitch.max(0.0), (-pitch).max(0.0), kept.unwrap_or(yaw.max(0.0)), (-yaw).max(0.0)];
        prop_assert_eq!(pose.shares.len(), 4);
        for (number, wanted) in (0..).zip(wanted) {
            prop_assert!((pose.shares[&number] - wanted).abs() < 1e-4, "{number}");
        }
    }

    /// Each piece of a curve is the cubic with the values and slopes of its ends.
    #[test]
    fn curves_are_splines_through_their_keys(
        keys in prop::array::uniform3(prop::array::uniform3(-2f32..2.0)), at in 0f32..1.0,
    ) {
        let curve: Vec<[f32; 4]> = keys.iter().zip([0.0, 0.4, 1.0]).map(|([v, a, b], t)| [t, *v, *a, *b]).collect();
        let map = RangeMap { most_deg: 30.0, output: 2.0, curve: curve.clone() };
        let start = curve[0][1];
        for key in &curve {
            prop_assert!((map.at(key[0] * 30.0) - 2.0 * (key[1] - start)).abs() < 1e-3);
        }
        let [from, to] = if at < 0.4 { [curve[0], curve[1]] } else { [curve[1], curve[2]] };
        // The cubic by its Bezier points [de Casteljau].
        let (span, t) = (to[0] - from[0], (at - from[0]) / (to[0] - from[0]));
        let mut points = vec![from[1], from[1] + from[3] * span / 3.0, to[1] - to[2] * span / 3.0, to[1]];
        while points.len() > 1 {
            points = points.windows(2).map(|pair| pair[0] * (1.0 - t) + pair[1] * t).collect();
        }
        prop_assert!((map.at(at * 30.0) - 2.0 * (points[0] - start)).abs() < 1e-3);
        prop_assert!((map.at(99.0) - 2.0 * (curve[2][1] - start)).abs() < 1e-6);
    }
}

#[test]
fn ranges_differ_by_side_and_height() {
    let scene = |change: &dyn Fn(&mut LookAt)| {
        let mut scene = seeing(
            &[[0.0, 0.0, 0.0, 1.0]; BODY_BONES],
            [[0.0, 0.0, 0.0, 1.0]; 2],
            Eyes::Bones,
        );
        let figure = scene.figure.as_mut().expect("a figure");
        change(figure.look_at.as_mut().expect("looks"));
        scene
    };
    // Of a right angle: how far the left and the right eye pan, and how far they tilt, in degrees.
    let angles = |scene: &Scene, way: [f32; 3], shares: &[(u32, f32)]| {
        let pose = Pose {
            look_at: Some(ahead(scene, scene, way)),
            shares: shares.iter().copied().collect(),
            ..Pose::default()
        };
        let mut posed = scene.clone();
        posed.set_pose(&pose).expect("in range");
        [Bone::LEFT_EYE, Bone::RIGHT_EYE].map(|bone| {
            let [x, y, _, w] = turned_by(scene, &posed, bone);
            [2.0 * math::atan2(y, w), 2.0 * math::atan2(x, w)].map(|v| v.to_degrees().round())
        })
    };
    let ranged = scene(&|look| {
        for (map, output) in [
            (&mut look.inner, 10.0),
            (&mut look.outer, 20.0),
            (&mut look.down, 30.0),
            (&mut look.up, 40.0),
        ] {
            map.output = output;
        }
    });
    assert_eq!(
        angles(&ranged, [1.0, 0.0, 0.0], &[]),
        [[20.0, 0.0], [10.0, 0.0]]
    );
    assert_eq!(
        angles(&ranged, [-1.0, 0.0, 0.0], &[]),
        [[-10.0, 0.0], [-20.0, 0.0]]
    );
    assert_eq!(angles(&ranged, [0.0, -1.0, 0.0], &[]), [[0.0, 30.0]; 2]);
    assert_eq!(angles(&ranged, [0.0, 1.0, 0.0], &[]), [[0.0, -40.0]; 2]);
    assert_eq!(angles(&ranged, [0.0, 0.0, 1.0], &[]), [[0.0; 2]; 2]);
    assert_eq!(angles(&ranged, [0.0; 3], &[]), [[0.0; 2]; 2]);

    // Expressions that block or blend looks do so to bones, too.
    assert_eq!(angles(&ranged, [1.0, 0.0, 0.0], &[(4, 0.3)]), [[0.0; 2]; 2]);
    assert_eq!(
        angles(&ranged, [1.0, 0.0, 0.0], &[(5, 0.5)]),
        [[10.0, 0.0], [5.0, 0.0]]
    );
    let early = scene(&|look| look.outer.most_deg = 45.0);
    assert_eq!(
        angles(&early, [1.0, 0.0, 1.0], &[]),
        [[90.0, 0.0], [45.0, 0.0]]
    );

    // Without a head, eyes or looks nothing moves.
    for lack in [Bone::HEAD, Bone::LEFT_EYE] {
        let mut blind = ranged.clone();
        let figure = blind.figure.as_mut().expect("a figure");
        figure.bones.remove(&lack);
        figure.bones.remove(&Bone::RIGHT_EYE);
        assert!(!figure.can_look());
        let mut pose = Pose {
            look_at: Some([1.0; 3]),
            ..Pose::default()
        };
        blind.look(&mut pose);
        assert_eq!(pose.transforms.len(), 0);
    }
}
