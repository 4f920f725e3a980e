//! Nodes that follow others: where constraints have them turn in a pose.

use crate::constraint::ConstraintKind;
use crate::matrix;
use crate::notice::Notices;
use crate::pose::Pose;
use crate::quaternion::{self, NO_TURN, Quaternion};
use crate::scene::Scene;
use crate::standing::Standing;

impl Scene {
    /// Gives nodes the turns that constraints have them take in a pose; where they stand and how large they are stays.
    ///
    /// O(constraints + nodes above those that aim), times a logarithm.
    pub(crate) fn constrain(&self, pose: &mut Pose) {
        let mut standing = Standing::new(self);
        for constraint in &self.constraints {
            let node = &self.nodes[constraint.node as usize];
            let Some(rest) = node.rest else { continue };
            let from = quaternion::unit(rest.rotation);
            let to = match constraint.kind {
                ConstraintKind::Roll(axis) => self.rolled(constraint.source, pose, from, axis),
                ConstraintKind::Aim(axis) => {
                    let above = node.parent.map(|parent| standing.world(parent, pose));
                    let above = above.unwrap_or(matrix::IDENTITY);
                    let target = standing.world(constraint.source, pose)[3];
                    let local = node.local_in(pose.transforms.get(&constraint.node));
                    let here = matrix::multiply(&above, &local)[3];
                    let way = [0, 1, 2].map(|i| target[i] - here[i]);
                    aimed(matrix::turn_of(&above), from, axis, way)
                }
                ConstraintKind::Rotation => {
                    let [rest, now] = self.turns(constraint.source, pose);
                    let beside = quaternion::multiply(quaternion::inverse(rest), now);
                    quaternion::multiply(from, beside)
                }
            };
            let stand = pose.transforms.entry(constraint.node).or_insert(rest);
            stand.rotation = quaternion::on_arc(from, to, constraint.weight);
        }
    }

    /// How a node is turned beside its parent at rest, and in a pose.
    fn turns(&self, node: u32, pose: &Pose) -> [Quaternion; 2] {
        let rest = self.nodes[node as usize].rest;
        let rest = rest.map(|rest| rest.rotation);
        let now = pose.transforms.get(&node).map(|stand| stand.rotation);
        let now = now.filter(|_| rest.is_some()).or(rest);
        [rest, now].map(|turn| turn.map_or(NO_TURN, quaternion::unit))
    }

    /// The turn of a node that rests at `from` and rolls about an axis as its source does.
    fn rolled(&self, source: u32, pose: &Pose, from: Quaternion, axis: [f32; 3]) -> Quaternion {
        // Take how the source is turned beside how it rests into the space of the node at rest.
        let [rest, now] = self.turns(source, pose);
        let in_parent = quaternion::multiply(now, quaternion::inverse(rest));
        let turn = quaternion::multiply(quaternion::inverse(from), in_parent);
        let turn = quaternion::multiply(turn, from);

        // Leave out what it turns the axis itself by.
        let back = quaternion::between(quaternion::turned(turn, axis), axis);
        quaternion::multiply(from, quaternion::multiply(back, turn))
    }
}

/// Lets a scene at rest follow its constraints; without them, and with a notice, where that carries something out of
/// range.
pub(crate) fn follow(scene: &mut Scene, notices: &mut Notices) {
    if scene.constraints.is_empty() {
        return;
    }
    if let Err(fault) = scene.set_pose(&Pose::default()) {
        notices.add(format!("the constraints of the file are ignored: {fault}"));
        scene.constraints.clear();
    }
}

/// The turn of a node that rests at `from` below a node that is turned by `above`, and points along a way in the
/// world.
fn aimed(above: Quaternion, from: Quaternion, axis: [f32; 3], way: [f32; 3]) -> Quaternion {
    let resting = quaternion::multiply(above, from);
    let turn = quaternion::between(quaternion::turned(resting, axis), way);
    let turned = quaternion::multiply(turn, resting);
    quaternion::multiply(quaternion::inverse(above), turned)
}

#[cfg(test)]
mod tests;
