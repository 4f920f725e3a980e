//! Springs as they swing, step by step.

use super::collider::Placed;
use super::vector::{Vector, length, minus, plus, scaled};
use super::{SpringJoint, Springs};
use crate::matrix::{self, Matrix};
use crate::pose::Pose;
use crate::quaternion::{self, NO_TURN, Quaternion};
use crate::scene::Scene;
use crate::transform::Transform;
use std::sync::Arc;

/// Way of an end from where it rests, as a share of its length, that counts as none.
const STILL: f64 = 1e-6;

/// Way of a joint in a step, as a share of the figure's size, from which it is a cut.
const LEAP_SHARE: f64 = 0.5;

/// How often the colliders of a joint push its end in a step, at most: out of one it may come into another.
const ROUNDS: usize = 8;

/// The springs of a scene at a moment: where their ends are, and where they were.
#[derive(Debug, Clone)]
pub struct Swing {
    springs: Arc<Springs>,
    /// Ends now and one step before, in the space of the centre, joint by joint.
    ends: Vec<[Vector; 2]>,
    /// Turns of the joints beside their parents.
    turns: Vec<Quaternion>,
    /// World space from node space, node by node.
    worlds: Vec<Matrix>,
    /// How far a joint moves in a step at most, in units of the world, unless it is a cut.
    leap: f64,
}

impl Swing {
    /// The springs of a scene in a pose: all joints rest, and nothing moves. O(nodes + joints).
    pub fn new(scene: &Scene, pose: &Pose) -> Self {
        let springs = scene.springs.clone().unwrap_or_default();
        let count = springs.joints.len();
        let mut swing = Self {
            springs,
            ends: vec![[[0.0; 3]; 2]; count],
            turns: vec![NO_TURN; count],
            worlds: Vec::new(),
            leap: f64::INFINITY,
        };
        swing.rest(scene, pose);
        swing
    }

    /// Lets all joints rest in a pose.
    pub fn rest(&mut self, scene: &Scene, pose: &Pose) {
        // Stand all joints upright.
        let pose = scene.followed(pose);
        for (turn, joint) in self.turns.iter_mut().zip(&self.springs.joints) {
            let rest = scene.nodes[joint.node as usize].rest;
            *turn = rest.map_or(NO_TURN, |rest| quaternion::unit(rest.rotation));
        }
        self.place(scene, &pose);

        // Put ends where they rest.
        for (number, joint) in self.springs.joints.iter().enumerate() {
            let end = place_in(&self.worlds[joint.node as usize], joint.end);
            let (_, center) = self.center(joint);
            self.ends[number] = [center.map_or(end, |center| carried(&center, end)); 2];
        }

        // Tell how large the figure is.
        let places = self.worlds.iter().map(|world| world[3]);
        let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
        for place in places {
            low = std::array::from_fn(|i| low[i].min(place[i]));
            high = std::array::from_fn(|i| high[i].max(place[i]));
        }
        let size = length(minus(high.map(f64::from), low.map(f64::from)));
        self.leap = LEAP_SHARE * size;
    }

    /// Moves on to a pose some seconds later.
    ///
    /// Ends keep their speed but for drag, are drawn to where they rest and fall, keep their distance from the joint,
    /// and are pushed out of colliders; joints turn to their ends, those of parents first [VRM spring bone 1.0,
    /// algorithm]. A joint that leaps rests anew.
    ///
    /// O(nodes + joints x colliders of their chains).
    ///
    /// Differs: the published push moves an end off its length, and bringing it back may leave it in the collider;
    /// here it comes to where many such pushes would bring it, and colliders push up to eight times. A collider
    /// that swings itself stands where it stood in the step before until its own joint has turned. What is all but at
    /// rest rests.
    pub fn step(&mut self, scene: &Scene, pose: &Pose, seconds: f64) {
        // Stand where the joints were turned last.
        let pose = scene.followed(pose);
        let before: Vec<[f32; 4]> = self.heads();
        self.place(scene, &pose);

        // Turn one joint after the other, and carry what hangs on it.
        let springs = Arc::clone(&self.springs);
        let mut joints = springs.joints.iter().enumerate().peekable();
        let mut is_moved = vec![false; scene.nodes.len()];
        for (index, node) in scene.nodes.iter().enumerate() {
            let parent = node.parent.map(|parent| parent as usize);
            let joint = joints.next_if(|(_, joint)| joint.node as usize == index);
            let is_carried = parent.is_some_and(|parent| is_moved[parent]);
            if joint.is_none() && !is_carried {
                continue;
            }
            is_moved[index] = true;
            let above = parent.map_or(matrix::IDENTITY, |parent| self.worlds[parent]);
            let posed = pose.transforms.get(&(index as u32));
            let Some((number, _)) = joint else {
                self.worlds[index] = matrix::multiply(&above, &node.local_in(posed));
                continue;
            };
            let Some(rest) = node.rest else { continue };
            let stand = posed.copied().unwrap_or(rest);
            self.turns[number] = self.turn(number, &above, [rest, stand], before[number], seconds);
            let rotation = self.turns[number];
            let local = Transform { rotation, ..stand }.matrix();
            self.worlds[index] = matrix::multiply(&above, &local);
        }
    }

    /// How the joints are turned beside their parents, in their order.
    pub fn turns(&self) -> &[Quaternion] {
        &self.turns
    }

    /// Where the joints are.
    fn heads(&self) -> Vec<[f32; 4]> {
        let joints = self.springs.joints.iter();
        joints
            .map(|joint| self.worlds[joint.node as usize][3])
            .collect()
    }

    /// Works out where all nodes stand in a pose, joints as they are turned.
    fn place(&mut self, scene: &Scene, pose: &Pose) {
        self.worlds.clear();
        let mut joints = self.springs.joints.iter().zip(&self.turns).peekable();
        for (index, node) in (0u32..).zip(&scene.nodes) {
            let posed = pose.transforms.get(&index);
            let joint = joints.next_if(|(joint, _)| joint.node == index);
            let local = match (joint, node.rest) {
                (Some((_, turn)), Some(rest)) => {
                    let stand = posed.copied().unwrap_or(rest);
                    Transform {
                        rotation: *turn,
                        ..stand
                    }
                    .matrix()
                }
                _ => node.local_in(posed),
            };
            let world = match node.parent {
                Some(parent) => matrix::multiply(&self.worlds[parent as usize], &local),
                None => local,
            };
            self.worlds.push(world);
        }
    }

    /// World space from the centre of a joint, and back; none where that is the world.
    fn center(&self, joint: &SpringJoint) -> (Option<[Vector; 4]>, Option<[Vector; 4]>) {
        let chain = &self.springs.chains[joint.chain as usize];
        let world = chain.center.map(|center| self.worlds[center as usize]);
        let back = world.and_then(|world| matrix::inverse(&world));
        let out = world
            .filter(|_| back.is_some())
            .map(|world| world.map(|[x, y, z, _]| [x, y, z].map(f64::from)));
        (out, back)
    }

    /// Moves the end of a joint on, and gives how the joint is turned then.
    fn turn(
        &mut self,
        number: usize,
        above: &Matrix,
        [rest, stand]: [Transform; 2],
        before: [f32; 4],
        seconds: f64,
    ) -> Quaternion {
        // Find where it would rest.
        let joint = self.springs.joints[number];
        let rotation = quaternion::unit(rest.rotation);
        let resting = matrix::multiply(above, &Transform { rotation, ..stand }.matrix());
        let head = place_in(&resting, [0.0; 3]);
        let resting_end = place_in(&resting, joint.end);
        let bone = minus(resting_end, head);
        let long = length(bone);
        let (out, back) = self.center(&joint);
        let into = |place: Vector| back.map_or(place, |center| carried(&center, place));
        let [now, last] = self.ends[number];
        let inverse = matrix::inverse(&resting);
        let [x, y, z, _] = before.map(f64::from);
        let leapt = length(minus(head, [x, y, z])) > self.leap;
        let (true, Some(inverse), false) = (long > 0.0, inverse, leapt) else {
            self.ends[number] = [into(resting_end); 2];
            return rotation;
        };

        // Let it keep its speed, be drawn back, and fall.
        let speed = scaled(minus(now, last), 1.0 - f64::from(joint.drag));
        let kept = plus(now, speed);
        let mut end = out.map_or(kept, |center| carried(&center, kept));
        end = plus(
            end,
            scaled(bone, f64::from(joint.stiffness) * seconds / long),
        );
        end = plus(end, scaled(joint.gravity.map(f64::from), seconds));
        let on_sphere = |place: Vector| {
            let way = minus(place, head);
            let far = length(way);
            match far > 0.0 && far.is_finite() {
                true => plus(head, scaled(way, long / far)),
                false => resting_end,
            }
        };
        end = on_sphere(end);

        // Keep it out of colliders.
        let radius = f64::from(joint.radius);
        let chain = &self.springs.chains[joint.chain as usize];
        for _ in 0..ROUNDS {
            let before = end;
            for number in &chain.colliders {
                let collider = &self.springs.colliders[*number as usize];
                let placed = Placed::new(collider, &self.worlds[collider.node as usize]);
                if let Some(pushed) = placed.pushed(end, radius, head) {
                    end = on_sphere(pushed);
                }
            }
            if length(minus(end, before)) <= STILL * long {
                break;
            }
        }

        // Turn it there.
        let is_still = length(minus(end, resting_end)) <= STILL * long;
        if is_still {
            end = resting_end;
        }
        self.ends[number] = [into(end), now];
        if is_still {
            return rotation;
        }
        let way = carried(&inverse, end).map(|v| v as f32);
        quaternion::multiply(rotation, quaternion::between(joint.end, way))
    }

    /// Asserts what every step keeps: ends as far from their joints as they rest, and finite numbers.
    ///
    /// # Panics
    ///
    /// When that is broken.
    #[cfg(any(test, feature = "testing"))]
    pub fn sanity_check(&self) {
        let finite = self.turns.iter().flatten().all(|v| v.is_finite());
        assert!(
            finite
                && self
                    .ends
                    .as_flattened()
                    .as_flattened()
                    .iter()
                    .all(|v| v.is_finite()),
            "finite"
        );
    }
}

/// A place of a node in the world.
fn place_in(world: &Matrix, place: [f32; 3]) -> Vector {
    let [a, b, c, d] = world.map(|[x, y, z, _]| [x, y, z].map(f64::from));
    carried(&[a, b, c, d], place.map(f64::from))
}

/// A place after an affine map of three columns and a way.
fn carried([a, b, c, d]: &[Vector; 4], [x, y, z]: Vector) -> Vector {
    std::array::from_fn(|i| a[i] * x + b[i] * y + c[i] * z + d[i])
}
