//! Limbs: which way the pen leans on figures that a skeleton bends, and which of their surface is face.
//!
//! American comics hatch a leg towards where it begins, an arm towards its hand, and chest and belly towards the
//! middle line of the body [Suzuki 2004, section 2.3.1]. All of it is measured where the mesh stood when its skeleton
//! was bound to it, in the space of the mesh, so that it turns with the bones.

use glam::{Mat4, Vec3};
use npr_core::geometry::{Influence, Vertex};
use npr_scene::{Bone, Figure, Node, Scene, Skin};
use std::collections::BTreeMap;

/// How far strokes of limbs lean from the bone to the middle of the body, as a tangent: 45 degrees.
const LEAN: f32 = 1.0;

/// Length under which a unit vector's part across a bone says no direction.
const STRAIGHT: f32 = 1e-3;

/// Mean of unit directions to the children of a joint under which they leave it in all directions.
const SCATTERED: f32 = 0.5;

/// What a skeleton says of a mesh, at every vertex.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Limbs {
    /// Directions along which strokes run, in the space of the mesh; zero where no limb says any. Neither length nor
    /// sign means anything.
    pub directions: Vec<[f32; 3]>,
    /// How much of a face each vertex is, 0..1.
    pub faces: Vec<f32>,
}

/// What a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    Head,
    Trunk,
    Leg,
    Arm,
    /// Hair, skirts and tails, and all joints of a skeleton without names.
    Other,
}

impl Role {
    fn of(bone: Bone) -> Self {
        let has = |words: &[&str]| words.iter().any(|word| bone.name().contains(word));
        match bone.name() {
            "hips" | "spine" | "chest" | "upperChest" | "neck" => Self::Trunk,
            "head" | "jaw" | "leftEye" | "rightEye" => Self::Head,
            _ if has(&["Leg", "Foot", "Toes"]) => Self::Leg,
            _ => Self::Arm,
        }
    }
}

/// A joint where its skeleton was bound, in the space of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Joint {
    role: Role,
    place: Vec3,
    /// Unit vector along the bone, to its tip; zero where it has none.
    axis: Vec3,
}

impl Limbs {
    /// What the skin of a node says of its vertices, of which `influences` number the joints of the skin; nothing where
    /// no skin bends it. O(vertices + nodes + joints * depth of the tree).
    pub fn of(
        scene: &Scene,
        object: u32,
        node: &Node,
        (vertices, influences): (&[Vertex], &[Influence]),
    ) -> Self {
        let skin = node.skin.and_then(|skin| scene.skins.get(skin as usize));
        let Some(skin) = skin.filter(|skin| skin.joints.len() > 1) else {
            return Self::default();
        };
        let skeleton = Skeleton::new(scene, skin);
        let has_face = can_have_face(scene.figure.as_ref(), object);
        let places = vertices.iter().zip(influences);
        let face = |influence: &Influence| {
            if has_face {
                skeleton.face(influence)
            } else {
                0.0
            }
        };
        Self {
            directions: places
                .map(|(vertex, influence)| skeleton.direction(vertex.position.into(), influence))
                .collect(),
            faces: influences.iter().map(face).collect(),
        }
    }

    /// Adds what is known of vertices from number `first` on.
    pub fn append(&mut self, first: usize, other: Self) {
        if !other.directions.is_empty() {
            self.directions.resize(first, [0.0; 3]);
            self.directions.extend(other.directions);
            self.faces.resize(first, 0.0);
            self.faces.extend(other.faces);
        }
    }

    /// The direction at a vertex; zero where no limb says any.
    pub fn direction_at(&self, vertex: usize) -> Vec3 {
        self.directions
            .get(vertex)
            .copied()
            .unwrap_or_default()
            .into()
    }

    /// How much of a face a vertex is, 0..1.
    pub fn face_at(&self, vertex: usize) -> f32 {
        self.faces.get(vertex).copied().unwrap_or_default()
    }
}

/// Whether the mesh of a node may have a face: it is moved by an expression, where there are expressions that move any.
fn can_have_face(figure: Option<&Figure>, object: u32) -> bool {
    let mut moved = figure
        .into_iter()
        .flat_map(Figure::morphed_nodes)
        .peekable();
    moved.peek().is_none() || moved.any(|node| node == object)
}

/// The joints of a skin, and what they stand around.
struct Skeleton {
    joints: Vec<Joint>,
    /// The place that all limbs begin from.
    root: Vec3,
    /// Whether joints have roles by name.
    is_named: bool,
    /// Unit vector along the trunk; zero where the hips or the head are unknown.
    up: Vec3,
    /// Unit vector to the right or left of the body, and the width over which the trunk turns from one to the other.
    side: Vec3,
    half_width: f32,
}

impl Skeleton {
    fn new(scene: &Scene, skin: &Skin) -> Self {
        // Name the joints, and find the joint that each hangs on.
        let bones: Vec<Option<Bone>> = bones_of(scene, skin);
        let parents = parents_of(scene, skin);
        let places = places_of(skin);
        let is_named = bones.contains(&Some(Bone::HIPS));

        // Give every joint what it moves, its own or that of the limb that it hangs on, and the way of its bone.
        let mut joints: Vec<Joint> = Vec::with_capacity(bones.len());
        let axes = axes_of(&parents, &places);
        for (i, axis) in axes.into_iter().enumerate() {
            joints.push(Joint {
                role: role_of(i, &bones, &parents),
                place: places[i].unwrap_or_default(),
                axis,
            });
        }

        // Find the middle of the body, and its sides.
        let place_of = |name: &str| {
            let index = bones
                .iter()
                .position(|b| b.is_some_and(|b| b.name() == name))?;
            places[index]
        };
        let top = (0..parents.len()).find(|i| parents[*i].is_none());
        let root = place_of("hips").or(places[top.unwrap_or_default()]);
        let hips = place_of("leftUpperLeg").zip(place_of("rightUpperLeg"));
        let up = place_of("hips").zip(place_of("head"));
        let across = hips.map_or(Vec3::X, |(left, right)| left - right);
        Self {
            joints,
            root: root.unwrap_or_default(),
            is_named,
            up: up.map_or(Vec3::ZERO, |(hips, head)| (head - hips).normalize_or_zero()),
            side: across.normalize_or(Vec3::X),
            half_width: (across.length() * 0.5).max(f32::MIN_POSITIVE),
        }
    }

    /// The direction of strokes at a place of the mesh; zero where no joint says any.
    fn direction(&self, place: Vec3, influence: &Influence) -> [f32; 3] {
        let said = (0..4).filter_map(|k| {
            let joint = self.joints.get(influence.joints[k] as usize)?;
            let unit = self.lean(joint, place).normalize_or_zero();
            Some(unit * influence.weights[k]).filter(|said| said.is_finite())
        });
        // Lines of opposite signs are the same: let none take from the ones before.
        let sum = said.fold(Vec3::ZERO, |sum, said| {
            if sum.dot(said) < 0.0 {
                sum - said
            } else {
                sum + said
            }
        });
        sum.normalize_or_zero().to_array()
    }

    /// The direction that one joint gives strokes at a place of the mesh.
    fn lean(&self, joint: &Joint, place: Vec3) -> Vec3 {
        let towards_root = self.root - joint.place;
        let across = towards_root - joint.axis * joint.axis.dot(towards_root);
        let is_across = across.length() > STRAIGHT * towards_root.length();
        let inward = if is_across {
            across.normalize()
        } else {
            Vec3::ZERO
        };
        match joint.role {
            Role::Head => Vec3::ZERO,
            Role::Trunk => {
                let side = self.side.dot(place - self.root) / self.half_width;
                self.up - self.side * (LEAN * side.clamp(-1.0, 1.0))
            }
            Role::Arm => joint.axis + inward * LEAN,
            Role::Leg => inward * LEAN - joint.axis,
            Role::Other if self.is_named => joint.axis,
            Role::Other => inward * LEAN - joint.axis,
        }
    }

    /// How much of a face a vertex is, 0..1.
    fn face(&self, influence: &Influence) -> f32 {
        let is_head = |joint: u32| {
            let joint = self.joints.get(joint as usize);
            joint.is_some_and(|joint| joint.role == Role::Head)
        };
        let of_head = (0..4).filter(|k| is_head(influence.joints[*k]));
        let sum: f32 = of_head.map(|k| influence.weights[k]).sum();
        if sum.is_finite() {
            sum.clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

/// The bone that every joint of a skin is, if any.
fn bones_of(scene: &Scene, skin: &Skin) -> Vec<Option<Bone>> {
    let bones = scene.bones();
    let bone_of: BTreeMap<u32, Bone> = bones.into_iter().map(|(bone, node)| (node, bone)).collect();
    let joints = skin.joints.iter();
    joints.map(|node| bone_of.get(node).copied()).collect()
}

/// The joint that each joint hangs on, with other nodes between them or not.
fn parents_of(scene: &Scene, skin: &Skin) -> Vec<Option<usize>> {
    let mut joint_at = vec![None; scene.nodes.len()];
    for (i, node) in skin.joints.iter().enumerate() {
        if let Some(at) = joint_at.get_mut(*node as usize) {
            *at = Some(i);
        }
    }
    let parent = |node: &u32| {
        let mut at = *node;
        while let Some(parent) = scene.nodes.get(at as usize).and_then(|node| node.parent) {
            // A parent stands before its children, so this ends.
            if parent >= at {
                break;
            }
            if let Some(joint) = joint_at[parent as usize] {
                return Some(joint);
            }
            at = parent;
        }
        None
    };
    skin.joints.iter().map(parent).collect()
}

/// Where every joint was bound, in the space of the mesh; `None` where its matrix has no inverse.
fn places_of(skin: &Skin) -> Vec<Option<Vec3>> {
    let place = |i: usize| {
        let bound = Mat4::from_cols_array_2d(skin.inverse_bind.get(i)?);
        let place = bound.inverse().w_axis.truncate();
        (bound.determinant() != 0.0 && place.is_finite()).then_some(place)
    };
    (0..skin.joints.len()).map(place).collect()
}

/// The way of every joint's bone: to the middle of the joints that hang on it, or on from where it hangs.
fn axes_of(parents: &[Option<usize>], places: &[Option<Vec3>]) -> Vec<Vec3> {
    // Add up the ways to the joints that hang on each.
    let way = |from: usize, to: usize| match (places[from], places[to]) {
        (Some(from), Some(to)) => (to - from).normalize_or_zero(),
        _ => Vec3::ZERO,
    };
    let mut sums = vec![(Vec3::ZERO, 0u32); parents.len()];
    for (i, parent) in parents.iter().enumerate() {
        if let Some(parent) = *parent {
            let way = way(parent, i);
            sums[parent].0 += way;
            sums[parent].1 += u32::from(way != Vec3::ZERO);
        }
    }

    // Take their mean, unless they leave in all directions; without any, go on as the bone before does.
    let axis = |i: usize| match (sums[i], parents[i]) {
        ((_, 0), Some(parent)) => way(parent, i),
        ((_, 0), None) => Vec3::ZERO,
        ((sum, count), _) if sum.length() < SCATTERED * count as f32 => Vec3::ZERO,
        ((sum, _), _) => sum.normalize_or_zero(),
    };
    (0..parents.len()).map(axis).collect()
}

/// What joint `i` moves: what its bone does, or that of the leg or arm that it hangs on.
fn role_of(i: usize, bones: &[Option<Bone>], parents: &[Option<usize>]) -> Role {
    let mut at = Some(i);
    // No chain is longer than the joints are many.
    for _ in 0..=parents.len() {
        let Some(joint) = at else { break };
        if let Some(bone) = bones[joint] {
            let role = Role::of(bone);
            let is_limb = matches!(role, Role::Leg | Role::Arm);
            return if joint == i || is_limb {
                role
            } else {
                Role::Other
            };
        }
        at = parents[joint];
    }
    Role::Other
}

#[cfg(test)]
mod tests;
