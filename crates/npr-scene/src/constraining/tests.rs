use super::*;
use crate::constraint::{Constraint, in_order};
use crate::matrix::{Matrix, turn_of};
use crate::node::Node;
use crate::transform::Transform;
use proptest::prelude::*;
use proptest::sample::select;

/// A rest: a place and a turn.
fn rest() -> impl Strategy<Value = Transform> {
    let turn = prop::array::uniform4(-1f32..1.0)
        .prop_filter("length", |q| q.iter().map(|v| v * v).sum::<f32>() > 0.01);
    (prop::array::uniform3(-2f32..2.0), turn).prop_map(|(translation, rotation)| Transform {
        translation,
        rotation,
        ..Transform::default()
    })
}

fn turn() -> impl Strategy<Value = Quaternion> {
    rest().prop_map(|rest| quaternion::unit(rest.rotation))
}

fn axis() -> impl Strategy<Value = [f32; 3]> {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    select(axes.to_vec())
}

/// Nodes on the ones that they name, which rest where they are said to.
fn scene(nodes: &[(Option<u32>, Transform)]) -> Scene {
    let mut scene = Scene::default();
    for (index, (parent, rest)) in (0u32..).zip(nodes) {
        let above = parent.map(|parent| scene.nodes[parent as usize].world_from_node);
        let above = above.unwrap_or(matrix::IDENTITY);
        if let Some(parent) = parent {
            scene.nodes[*parent as usize].children.push(index);
        }
        scene.nodes.push(Node {
            name: index.to_string(),
            parent: *parent,
            rest: Some(*rest),
            local: rest.matrix(),
            world_from_node: matrix::multiply(&above, &rest.matrix()),
            ..Node::default()
        });
    }
    scene
}

/// A scene whose node 3 follows node 2, both on node 1 on node 0, or node 2 on node 0.
fn following(rests: [Transform; 4], beside: bool, weight: f32, kind: ConstraintKind) -> Scene {
    let [root, parent, source, node] = rests;
    let above = if beside { 0 } else { 1 };
    let mut scene = scene(&[
        (None, root),
        (Some(0), parent),
        (Some(above), source),
        (Some(1), node),
    ]);
    scene.constraints = vec![Constraint {
        node: 3,
        source: 2,
        weight,
        kind,
    }];
    scene.sanity_check();
    scene
}

/// The scene with some nodes turned, beside how they rest, in their own spaces.
fn turned(scene: &Scene, turns: &[(u32, Quaternion)]) -> Scene {
    let (mut pose, mut posed) = (Pose::default(), scene.clone());
    for (node, turn) in turns {
        let mut stand = scene.nodes[*node as usize].rest.expect("a rest");
        stand.rotation = quaternion::multiply(quaternion::unit(stand.rotation), *turn);
        pose.transforms.insert(*node, stand);
    }
    posed.set_pose(&pose).expect("in range");
    posed
}

/// Cosine of half the angle between two turns, as good as 1 where they are the same.
fn same(a: Quaternion, b: Quaternion) -> f32 {
    a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>().abs()
}

fn rest_turn(scene: &Scene, node: usize) -> Quaternion {
    quaternion::unit(scene.nodes[node].rest.expect("a rest").rotation)
}

/// An axis of a node in the world.
fn in_world(world: &Matrix, axis: [f32; 3]) -> [f32; 3] {
    quaternion::turned(turn_of(world), axis)
}

fn apart(a: [f32; 3], b: [f32; 3]) -> f32 {
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

fn about(axis: [f32; 3], angle: f32) -> Quaternion {
    let [sin, cos] = [
        npr_core::math::sin(angle / 2.0),
        npr_core::math::cos(angle / 2.0),
    ];
    [axis[0] * sin, axis[1] * sin, axis[2] * sin, cos]
}

proptest! {
    #[test]
    fn a_rotation_is_done_again_in_the_space_of_the_node(
        rests in prop::array::uniform4(rest()), turn in turn(), above in turn(), beside: bool,
    ) {
        let scene = following(rests, beside, 1.0, ConstraintKind::Rotation);
        let posed = turned(&scene, &[(2, turn), (1, above)]);
        let wanted = quaternion::multiply(rest_turn(&scene, 3), turn);
        prop_assert!(same(turn_of(&posed.nodes[3].local), wanted) > 0.9999);
    }

    #[test]
    fn a_roll_turns_about_its_axis_alone(
        rests in prop::array::uniform4(rest()), axis in axis(), turn in turn(), weight in 0f32..=1.0,
    ) {
        let scene = following(rests, false, weight, ConstraintKind::Roll(axis));
        let posed = turned(&scene, &[(2, turn)]);
        let [before, after] = [&scene, &posed].map(|scene| in_world(&scene.nodes[3].local, axis));
        prop_assert!(apart(before, after) < 1e-3, "{before:?} {after:?}");
    }

    /// Where the source turns about the very axis, the node turns by as much, times the weight.
    #[test]
    fn a_roll_is_as_large_as_that_of_its_source(
        rests in prop::array::uniform4(rest()), axis in axis(), angle in -3f32..3.0, weight in 0f32..=1.0,
    ) {
        let scene = following(rests, false, weight, ConstraintKind::Roll(axis));
        let [source, node] = [2, 3].map(|node| rest_turn(&scene, node));
        let of_source = quaternion::multiply(quaternion::inverse(source), node);
        let posed = turned(&scene, &[(2, about(quaternion::turned(of_source, axis), angle))]);
        let wanted = quaternion::multiply(node, about(axis, angle * weight));
        prop_assert!(same(turn_of(&posed.nodes[3].local), wanted) > 0.9999);
    }

    #[test]
    fn an_axis_aims_at_its_source_by_the_smallest_turn(
        rests in prop::array::uniform4(rest()), axis in axis(), above in turn(), beside: bool,
    ) {
        let scene = following(rests, beside, 1.0, ConstraintKind::Aim(axis));
        let posed = turned(&scene, &[(1, above), (0, above)]);
        let [from, to] = [3, 2].map(|node| posed.nodes[node].world_from_node[3]);
        let way = [0, 1, 2].map(|i| to[i] - from[i]);
        let length = way.iter().map(|v| v * v).sum::<f32>().sqrt();
        prop_assume!(length > 0.05);
        let aimed = in_world(&posed.nodes[3].world_from_node, axis);
        prop_assert!(apart(aimed, way.map(|v| v / length)) < 1e-3);

        // The turn from how it would rest there is about an axis across both directions.
        let mut free = posed.clone();
        free.constraints.clear();
        let free = turned(&free, &[(1, above), (0, above)]);
        let resting = turn_of(&free.nodes[3].world_from_node);
        let turn = quaternion::multiply(turn_of(&posed.nodes[3].world_from_node), quaternion::inverse(resting));
        let [x, y, z] = quaternion::turned(resting, axis);
        let along = turn[0] * x + turn[1] * y + turn[2] * z;
        prop_assume!(x * way[0] + y * way[1] + z * way[2] > -0.99 * length);
        prop_assert!(along.abs() < 2e-3, "{along}");
    }

    #[test]
    fn without_weight_or_motion_it_rests(
        rests in prop::array::uniform4(rest()), axis in axis(), turn in turn(), kind in 0usize..3,
    ) {
        let kind = [ConstraintKind::Roll(axis), ConstraintKind::Rotation, ConstraintKind::Aim(axis)][kind];
        let light = turned(&following(rests, false, 0.0, kind), &[(2, turn)]);
        prop_assert!(same(turn_of(&light.nodes[3].local), rest_turn(&light, 3)) > 0.9999);
        if !matches!(kind, ConstraintKind::Aim(_)) {
            let still = turned(&following(rests, false, 1.0, kind), &[(1, turn)]);
            prop_assert!(same(turn_of(&still.nodes[3].local), rest_turn(&still, 3)) > 0.9999);
        }
    }

    /// A chain of nodes of which each follows the one above, in whatever order they are said.
    #[test]
    fn what_follows_what_follows_is_worked_out_in_order(
        rests in prop::collection::vec(rest(), 6), turn in turn(),
        order in Just((1u32..6).collect::<Vec<_>>()).prop_shuffle(), aims: bool,
    ) {
        let nodes: Vec<(Option<u32>, Transform)> = (0u32..)
            .zip(&rests)
            .map(|(index, rest)| (aims.then(|| index.checked_sub(1)).flatten(), *rest))
            .collect();
        let mut scene = scene(&nodes);
        let said = |list: &[u32]| -> Vec<Constraint> {
            let kind = if aims { ConstraintKind::Aim([1.0, 0.0, 0.0]) } else { ConstraintKind::Rotation };
            let of = |node: &u32| {
                // Those that aim look at the root, since what they hang on turns them.
                let source = if aims { 0 } else { node - 1 };
                Constraint { node: *node, source, weight: 1.0, kind }
            };
            list.iter().map(of).collect()
        };
        let mut posed = Vec::new();
        for list in [(1..6).collect::<Vec<_>>(), order] {
            let (ordered, circular) = in_order(said(&list), &scene.nodes);
            prop_assert_eq!(circular.len(), 0);
            scene.constraints = ordered;
            posed.push(turned(&scene, &[(0, turn)]));
        }
        for (a, b) in posed[0].nodes.iter().zip(&posed[1].nodes) {
            prop_assert!(a.world_from_node == b.world_from_node);
        }
        if !aims {
            let last = quaternion::multiply(rest_turn(&scene, 5), turn);
            prop_assert!(same(turn_of(&posed[0].nodes[5].local), last) > 0.999);
        }
    }
}

#[test]
fn circles_are_left_out_and_what_hangs_on_them_stays() {
    let free = vec![(None, Transform::default()); 6];
    let scene = scene(&free);
    let follow = |node, source| Constraint {
        node,
        source,
        weight: 1.0,
        kind: ConstraintKind::Rotation,
    };
    // 1 and 2 follow each other, 3 follows them, 4 follows itself, 0 is followed by 2's pair, 5 by 0.
    let said = vec![
        follow(3, 2),
        follow(1, 2),
        follow(2, 1),
        follow(4, 4),
        follow(0, 5),
    ];
    let (ordered, circular) = in_order(said, &scene.nodes);
    let nodes = |list: &[Constraint]| list.iter().map(|c| c.node).collect::<Vec<_>>();
    assert_eq!(nodes(&ordered), [3, 0]);
    assert_eq!(nodes(&circular), [1, 2, 4]);

    // A node cannot aim at what hangs on it, but roll and turn as that does.
    let chain = [
        (None, Transform::default()),
        (Some(0), Transform::default()),
    ];
    let nodes_of_chain = self::scene(&chain).nodes;
    let aim = Constraint {
        kind: ConstraintKind::Aim([1.0, 0.0, 0.0]),
        ..follow(0, 1)
    };
    assert_eq!(in_order(vec![aim], &nodes_of_chain).1.len(), 1);
    assert_eq!(in_order(vec![follow(0, 1)], &nodes_of_chain).0.len(), 1);
}

#[test]
fn a_constraint_counts_where_a_clip_turns_the_same_node() {
    let rest = Transform::default();
    let scene = following([rest; 4], true, 1.0, ConstraintKind::Rotation);
    let half = about([0.0, 1.0, 0.0], 1.0);
    let posed = turned(&scene, &[(3, half)]);
    assert!(same(turn_of(&posed.nodes[3].local), NO_TURN) > 0.9999);
    let again = turned(&turned(&posed, &[(2, half)]), &[(3, half)]);
    assert_eq!(again.nodes, posed.nodes);
}
