//! In which order constraints are worked out, and which of them go round in circles.

use super::{Constraint, ConstraintKind};
use crate::node::Node;
use std::collections::{BTreeMap, VecDeque};

/// The constraints, each behind those that it depends on, and those that are left out since they depend on themselves.
///
/// The turn of a source, and for those that aim also all turns above the source and above the node itself, must be
/// known before. Constraints that only depend on such a circle stay. O(nodes + constraints).
pub(crate) fn in_order(
    constraints: Vec<Constraint>,
    nodes: &[Node],
) -> (Vec<Constraint>, Vec<Constraint>) {
    // Say what comes before what: first places of all nodes in the world, then the turns that constraints give.
    let of_node: BTreeMap<u32, usize> = (nodes.len()..)
        .zip(&constraints)
        .map(|(step, constraint)| (constraint.node, step))
        .collect();
    let mut edges = Vec::new();
    for (place, node) in nodes.iter().enumerate() {
        let turn = of_node.get(&(place as u32)).copied();
        let above = node.parent.map(|parent| parent as usize);
        edges.extend(turn.into_iter().chain(above).map(|before| [before, place]));
    }
    for (turn, constraint) in (nodes.len()..).zip(&constraints) {
        let before = match constraint.kind {
            ConstraintKind::Aim(_) => {
                let above = nodes[constraint.node as usize].parent;
                [
                    Some(constraint.source as usize),
                    above.map(|above| above as usize),
                ]
            }
            _ => [of_node.get(&constraint.source).copied(), None],
        };
        edges.extend(before.into_iter().flatten().map(|before| [before, turn]));
    }

    // Leave out what neither comes after a beginning nor before an end.
    let count = nodes.len() + constraints.len();
    let mut in_circle = vec![true; count];
    for step in sorted(count, &edges) {
        in_circle[step] = false;
    }
    if in_circle.contains(&true) {
        let backward: Vec<[usize; 2]> = edges.iter().map(|[a, b]| [*b, *a]).collect();
        for step in sorted(count, &backward) {
            in_circle[step] = false;
        }
        in_circle[..nodes.len()].fill(false);
        edges.retain(|[a, b]| !in_circle[*a] && !in_circle[*b]);
    }

    // Put the others in order.
    let steps = sorted(count, &edges).into_iter();
    let turns = steps.filter(|step| *step >= nodes.len() && !in_circle[*step]);
    let ordered = turns.map(|step| constraints[step - nodes.len()]).collect();
    let circular = constraints.iter().zip(&in_circle[nodes.len()..]);
    let circular = circular.filter(|(_, in_circle)| **in_circle);
    (
        ordered,
        circular.map(|(constraint, _)| *constraint).collect(),
    )
}

/// Steps in an order in which the first of every pair comes before the second; those in circles, and what comes after
/// them, are left out [Kahn 1962].
fn sorted(count: usize, edges: &[[usize; 2]]) -> Vec<usize> {
    // List what comes after each.
    let (mut waits_for, mut starts) = (vec![0usize; count], vec![0usize; count + 1]);
    for [before, after] in edges {
        waits_for[*after] += 1;
        starts[before + 1] += 1;
    }
    for step in 0..count {
        starts[step + 1] += starts[step];
    }
    let (mut ends, mut after) = (starts.clone(), vec![0; edges.len()]);
    for [before, step] in edges {
        after[ends[*before]] = *step;
        ends[*before] += 1;
    }

    // Take what waits for nothing any more.
    let mut ready: VecDeque<usize> = (0..count).filter(|step| waits_for[*step] == 0).collect();
    let mut order = Vec::with_capacity(count);
    while let Some(step) = ready.pop_front() {
        order.push(step);
        for next in &after[starts[step]..starts[step + 1]] {
            waits_for[*next] -= 1;
            if waits_for[*next] == 0 {
                ready.push_back(*next);
            }
        }
    }
    order
}
