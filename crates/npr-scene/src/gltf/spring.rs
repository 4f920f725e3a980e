//! The springs of VRM 1.0 (`VRMC_springBone`) and of VRM 0.x (`secondaryAnimation`); what is broken is left out with a
//! notice.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::collections::BTreeMap;
use std::sync::Arc;

use ::gltf::json::Root;
use serde_json::Value;

use super::look_at::{number, vector_of_0};
use super::tree::Tree;
use super::vrm::extension;
use crate::bending::RestFrames;
use crate::error::SceneError;
use crate::loading::Loading;
use crate::matrix;
use crate::node::Node;
use crate::posture::numbers;
use crate::scene::Scene;
use crate::shown::shown;
use crate::springs::{Collider, SpringChain, SpringJoint, Springs};

/// How far behind the last joint of a spring of VRM 0.x its end is, in units of its node.
const END_IN_0: f32 = 0.07;

/// Most pairs of a joint and a collider of its chain: all are looked at in every step.
const MOST_PAIRS: usize = 1_000_000;

/// Reads the springs of a scene whose nodes are placed; none where it has none.
///
/// # Errors
///
/// More of them than the memory limit. Whatever is broken has a notice.
pub(crate) fn read(
    root: &Root,
    tree: &Tree,
    scene: &Scene,
    loading: &mut Loading,
) -> Result<Option<Arc<Springs>>, SceneError> {
    // Find out of which version they are.
    let of_1 = extension(root, "VRMC_springBone");
    let of_0 = extension(root, "VRM").and_then(|vrm| vrm.get("secondaryAnimation"));
    if of_1.or(of_0).is_none() {
        return Ok(None);
    }
    let count = scene.nodes.len();
    loading.allowance.take::<[u32; 24]>("springs", count)?;
    let mut reader = Reader {
        root,
        tree,
        scene,
        rests: RestFrames::of(scene),
        subtree_ends: subtree_ends(&scene.nodes),
        joints: BTreeMap::new(),
        springs: Springs::default(),
        loading,
    };

    // Read them.
    match (of_1, of_0) {
        (Some(said), _) => reader.springs_of_1(said)?,
        (None, Some(said)) => reader.springs_of_0(said)?,
        (None, None) => {}
    }
    let mut springs = reader.springs;
    springs.joints = reader.joints.into_values().collect();

    // Leave out more than can be moved in a moment.
    let pairs = springs.joints.iter().map(|joint| {
        let chain = springs.chains.get(joint.chain as usize);
        chain.map_or(0, |chain| chain.colliders.len())
    });
    let pairs = pairs.fold(0usize, usize::saturating_add);
    if pairs > MOST_PAIRS {
        let text = format!(
            "the springs of the avatar are ignored: {pairs} pairs of joints and colliders are more than {MOST_PAIRS}"
        );
        loading.notices.add(text);
        return Ok(None);
    }
    Ok((!springs.joints.is_empty()).then(|| Arc::new(springs)))
}

struct Reader<'a, 'b> {
    root: &'a Root,
    tree: &'a Tree,
    scene: &'a Scene,
    rests: RestFrames,
    /// Of each node the number behind the last that hangs on it.
    subtree_ends: Vec<u32>,
    /// The joints, by node.
    joints: BTreeMap<u32, SpringJoint>,
    springs: Springs,
    loading: &'a mut Loading<'b>,
}

/// What a file says of a joint, but for its node and its end.
#[derive(Debug, Clone, Copy)]
struct Manner {
    radius: f32,
    stiffness: f32,
    gravity: [f32; 3],
    drag: f32,
}

impl Reader<'_, '_> {
    fn note(&mut self, what: &str, fault: &str) {
        let text = format!("{what} of the avatar is ignored: {fault}");
        self.loading.notices.add(text);
    }

    /// The node of a number in the file, or what is wrong with it.
    fn node(&self, said: Option<&Value>) -> Result<u32, String> {
        let count = self.root.nodes.len();
        let number = said.and_then(Value::as_u64);
        let number = number.and_then(|number| usize::try_from(number).ok());
        let number = number.filter(|number| *number < count);
        let number =
            number.ok_or_else(|| format!("it names no node of the {count} in the file"))?;
        let place = self.tree.place(number);
        place.ok_or_else(|| format!("it is on node {number}, which is not part of the scene"))
    }

    fn springs_of_1(&mut self, said: &Value) -> Result<(), SceneError> {
        // Read colliders, and which of them each group has.
        let mut colliders: Vec<Option<u32>> = Vec::new();
        for (index, said) in (0..).zip(list(said, "colliders")) {
            self.loading.allowance.take::<[Collider; 2]>("springs", 1)?;
            let collider = self.collider_of_1(said);
            colliders.push(self.keep(collider, &format!("collider {index} of the springs")));
        }
        let mut groups: Vec<Vec<u32>> = Vec::new();
        for (index, said) in (0..).zip(list(said, "colliderGroups")) {
            let mut group = Vec::new();
            for said in list(said, "colliders") {
                self.loading.allowance.take::<u32>("springs", 1)?;
                let number = said
                    .as_u64()
                    .and_then(|number| usize::try_from(number).ok());
                match number.and_then(|number| colliders.get(number)) {
                    Some(collider) => group.extend(*collider),
                    None => self.note(
                        &format!("a collider of group {index} of the springs"),
                        "there is no such collider",
                    ),
                }
            }
            groups.push(group);
        }

        // Read springs.
        for (index, said) in (0..).zip(list(said, "springs")) {
            let name = name_of("spring", index, said.get("name"));
            let chain = self.chain(said, &groups, &name, said.get("center"))?;
            let joints = || list(said, "joints");
            for (place, (joint, next)) in (0..).zip(joints().zip(joints().skip(1))) {
                let what = format!("joint {place} of {name}");
                let made = self.node(joint.get("node")).and_then(|node| {
                    let next = self.node(next.get("node"));
                    let next = next
                        .map_err(|fault| format!("the joint behind it cannot be found, {fault}"))?;
                    let end = self.end_at(node, next)?;
                    Ok((node, end, manner_of_1(joint)?))
                });
                self.keep_joint(made, chain, &what)?;
            }
        }
        Ok(())
    }

    fn collider_of_1(&self, said: &Value) -> Result<Collider, String> {
        let node = self.node(said.get("node"))?;
        let shape = |kind: &str| said.pointer(&format!("/shape/{kind}"));
        let place = |said: &Value, key: &str| {
            let place = said.get(key).map_or(Some([0.0; 3]), numbers::<3>);
            place.ok_or_else(|| format!("its {key} is no list of three numbers"))
        };
        let (said, from, to) = if let Some(said) = shape("sphere") {
            let from = place(said, "offset")?;
            (said, from, from)
        } else if let Some(said) = shape("capsule") {
            (said, place(said, "offset")?, place(said, "tail")?)
        } else {
            return Err("it is neither a sphere nor a capsule".to_owned());
        };
        let radius = at_least_0(said.get("radius"), 0.0, "radius")?;
        Ok(Collider {
            node,
            from,
            to,
            radius,
        })
    }

    fn springs_of_0(&mut self, said: &Value) -> Result<(), SceneError> {
        // Read colliders, which come in groups.
        let mut groups: Vec<Vec<u32>> = Vec::new();
        for (index, said) in (0..).zip(list(said, "colliderGroups")) {
            let node = self.node(said.get("node"));
            let mut group = Vec::new();
            for (place, said) in (0..).zip(list(said, "colliders")) {
                self.loading.allowance.take::<[Collider; 2]>("springs", 1)?;
                let collider = node.clone().and_then(|node| {
                    let offset = said.get("offset");
                    let offset = offset.map_or(Some([0.0; 3]), |said| vector_of_0(said, [0.0; 3]));
                    let from = offset.ok_or("its offset is no vector of three numbers")?;
                    let radius = at_least_0(said.get("radius"), 0.0, "radius")?;
                    Ok(Collider {
                        node,
                        from,
                        to: from,
                        radius,
                    })
                });
                let what = format!("collider {place} of group {index} of the springs");
                group.extend(self.keep(collider, &what));
            }
            groups.push(group);
        }

        // Read springs: all that hangs on some bones.
        for (index, said) in (0..).zip(list(said, "boneGroups")) {
            let name = name_of("spring", index, said.get("comment"));
            let center = said
                .get("center")
                .filter(|center| center.as_i64() != Some(-1));
            let chain = self.chain(said, &groups, &name, center)?;
            let manner = manner_of_0(said);
            for (place, root) in (0..).zip(list(said, "bones")) {
                let what = format!("bone {place} of {name}");
                let node = match (self.node(Some(root)), manner.clone()) {
                    (Ok(node), Ok(_)) => node,
                    (Err(fault), _) | (_, Err(fault)) => {
                        self.note(&what, &fault);
                        continue;
                    }
                };
                let end = self.subtree_ends.get(node as usize).copied();
                for node in node..end.unwrap_or(node) {
                    if self.joints.contains_key(&node) {
                        self.note(&what, "some of its bones are of another spring already");
                        break;
                    }
                    let made = manner
                        .clone()
                        .and_then(|manner| Ok((node, self.end_in_0(node)?, manner)));
                    // A last bone at the place of the one before turns about nothing.
                    if made.is_ok() {
                        self.keep_joint(made, chain, &what)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Takes a collider, or says what is wrong with it.
    fn keep(&mut self, collider: Result<Collider, String>, what: &str) -> Option<u32> {
        match collider {
            Ok(collider) => {
                let number = u32::try_from(self.springs.colliders.len()).ok()?;
                self.springs.colliders.push(collider);
                Some(number)
            }
            Err(fault) => {
                self.note(what, &fault);
                None
            }
        }
    }

    /// A chain with the colliders of the groups that a spring names, and its centre.
    fn chain(
        &mut self,
        said: &Value,
        groups: &[Vec<u32>],
        name: &str,
        center: Option<&Value>,
    ) -> Result<u32, SceneError> {
        // Gather its colliders.
        let mut chain = SpringChain::default();
        for number in list(said, "colliderGroups") {
            let number = number
                .as_u64()
                .and_then(|number| usize::try_from(number).ok());
            match number.and_then(|number| groups.get(number)) {
                Some(group) => {
                    self.loading.allowance.take::<u32>("springs", group.len())?;
                    chain.colliders.extend(group);
                }
                None => self.note(
                    &format!("a collider group of {name}"),
                    "there is no such group",
                ),
            }
        }

        // Find its centre.
        if center.is_some() {
            match self.node(center) {
                Ok(center) => chain.center = Some(center),
                Err(fault) => self.note(&format!("the center of {name}"), &fault),
            }
        }
        self.loading.allowance.take::<SpringChain>("springs", 1)?;
        let number = self.springs.chains.len();
        self.springs.chains.push(chain);
        Ok(u32::try_from(number).unwrap_or(u32::MAX))
    }

    /// Takes a joint of a node, its end and its manner, or says what is wrong with it.
    fn keep_joint(
        &mut self,
        made: Result<(u32, [f32; 3], Manner), String>,
        chain: u32,
        what: &str,
    ) -> Result<(), SceneError> {
        // Judge it.
        let node = |node: u32| self.scene.nodes.get(node as usize);
        let made = made.and_then(|made| match node(made.0).and_then(|node| node.rest) {
            None => Err("its node has a matrix and is not posed".to_owned()),
            Some(_) if self.joints.contains_key(&made.0) => {
                Err("its node is of another spring already".to_owned())
            }
            Some(_) if made.1 == [0.0; 3] => Err("its end is where it is itself".to_owned()),
            Some(_) => Ok(made),
        });

        // Take it.
        self.loading
            .allowance
            .take::<[SpringJoint; 2]>("springs", 1)?;
        match made {
            Err(fault) => self.note(what, &fault),
            Ok((node, end, manner)) => {
                let joint = SpringJoint {
                    node,
                    end,
                    chain,
                    radius: manner.radius,
                    stiffness: manner.stiffness,
                    gravity: manner.gravity,
                    drag: manner.drag,
                };
                self.joints.insert(node, joint);
            }
        }
        Ok(())
    }

    /// Where a node that hangs on another rests, in the space of that one.
    fn end_at(&self, node: u32, next: u32) -> Result<[f32; 3], String> {
        // Take the place that the file gives it, where it hangs right there.
        let below = self.scene.nodes.get(next as usize);
        if let Some(below) = below.filter(|below| below.parent == Some(node)) {
            return Ok(place_of(below));
        }

        // Go by the world.
        let end = self.subtree_ends.get(node as usize).copied().unwrap_or(0);
        if next <= node || next >= end {
            return Err("the joint behind it does not hang on it".to_owned());
        }
        let world = |node: u32| self.rests.worlds.get(node as usize);
        let back = world(node).and_then(matrix::inverse);
        let (Some([a, b, c, d]), Some([_, _, _, [x, y, z, _]])) = (back, world(next)) else {
            return Err("its node is flat".to_owned());
        };
        let [x, y, z] = [x, y, z].map(|v| f64::from(*v));
        let carried = |a: f64, b: f64, c: f64, d: f64| (a * x + b * y + c * z + d) as f32;
        let ([ax, ay, az], [bx, by, bz], [cx, cy, cz], [dx, dy, dz]) = (a, b, c, d);
        let end = [
            carried(ax, bx, cx, dx),
            carried(ay, by, cy, dy),
            carried(az, bz, cz, dz),
        ];
        let is_finite = end.iter().all(|v| v.is_finite());
        is_finite
            .then_some(end)
            .ok_or_else(|| "its end is out of range".to_owned())
    }

    /// Where the end of a joint of VRM 0.x rests: at the first node that hangs on it, or further along its own way.
    fn end_in_0(&self, node: u32) -> Result<[f32; 3], String> {
        let missing = || "there is no such node".to_owned();
        let node = self.scene.nodes.get(node as usize).ok_or_else(missing)?;
        let first = node.children.first().map(|child| *child as usize);
        if let Some(child) = first.and_then(|child| self.scene.nodes.get(child)) {
            let place = place_of(child);
            return match place == [0.0; 3] {
                true => Err("its end is where it is itself".to_owned()),
                false => Ok(place),
            };
        }
        let [x, y, z] = place_of(node);
        let far = [x, y, z].iter().map(|v| v * v).sum::<f32>().sqrt();
        let is_there = far > 0.0 && far.is_finite();
        let end = is_there.then(|| [x, y, z].map(|v| v / far * END_IN_0));
        end.ok_or_else(|| "its end is where it is itself".to_owned())
    }
}

/// Where a node rests beside its parent.
fn place_of(node: &Node) -> [f32; 3] {
    let [_, _, _, [x, y, z, _]] = node.local;
    node.rest.map_or([x, y, z], |rest| rest.translation)
}

/// How a joint of VRM 1.0 moves, or what is wrong with it.
fn manner_of_1(said: &Value) -> Result<Manner, String> {
    let direction = said.get("gravityDir");
    let direction = direction.map_or(Some([0.0, -1.0, 0.0]), numbers::<3>);
    Ok(Manner {
        radius: at_least_0(said.get("hitRadius"), 0.0, "hitRadius")?,
        stiffness: at_least_0(said.get("stiffness"), 1.0, "stiffness")?,
        gravity: gravity(said, direction)?,
        drag: drag(said, 0.5)?,
    })
}

/// How a spring of VRM 0.x moves, or what is wrong with it.
fn manner_of_0(said: &Value) -> Result<Manner, String> {
    let direction = said.get("gravityDir");
    let direction = direction.map_or(Some([0.0, -1.0, 0.0]), |said| vector_of_0(said, [0.0; 3]));
    // The whole figure is turned about to look along +z.
    let direction = direction.map(crate::transform::half_turned_move);
    Ok(Manner {
        radius: at_least_0(said.get("hitRadius"), 0.02, "hitRadius")?,
        stiffness: at_least_0(said.get("stiffiness"), 1.0, "stiffiness")?,
        gravity: gravity(said, direction)?,
        drag: drag(said, 0.4)?,
    })
}

fn gravity(said: &Value, direction: Option<[f32; 3]>) -> Result<[f32; 3], String> {
    let direction = direction.ok_or("its gravityDir is no list of three numbers")?;
    let power = said.get("gravityPower").map_or(Some(0.0), number);
    let power = power.ok_or("its gravityPower is no number")?;
    let gravity = direction.map(|v| v * power);
    let is_finite = gravity.iter().all(|v| v.is_finite());
    is_finite
        .then_some(gravity)
        .ok_or_else(|| "its gravityPower is out of range".to_owned())
}

fn drag(said: &Value, default: f32) -> Result<f32, String> {
    let drag = said.get("dragForce").map_or(Some(default), number);
    let drag = drag.filter(|drag| (0.0..=1.0).contains(drag));
    drag.ok_or_else(|| "its dragForce is no number from 0 to 1".to_owned())
}

/// A number that is not below 0.
fn at_least_0(said: Option<&Value>, default: f32, name: &str) -> Result<f32, String> {
    let value = said.map_or(Some(default), number);
    let value = value.filter(|value| *value >= 0.0);
    value.ok_or_else(|| format!("its {name} is no number from 0"))
}

/// Something by its name in the file, or else by its number.
fn name_of(kind: &str, index: usize, name: Option<&Value>) -> String {
    match name.and_then(Value::as_str).filter(|name| !name.is_empty()) {
        Some(name) => format!("{kind} '{}'", shown(name)),
        None => format!("{kind} {index}"),
    }
}

fn list<'a>(said: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    said.get(key)
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
}

/// Of each node the number behind the last that hangs on it: nodes lie in the order of a walk from parents to
/// children.
fn subtree_ends(nodes: &[Node]) -> Vec<u32> {
    let mut ends: Vec<u32> = (1u32..).take(nodes.len()).collect();
    for (index, node) in nodes.iter().enumerate().rev() {
        let end = ends.get(index).copied().unwrap_or_default();
        let above = node.parent.and_then(|parent| ends.get_mut(parent as usize));
        if let Some(above) = above {
            *above = (*above).max(end);
        }
    }
    ends
}
