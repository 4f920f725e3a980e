//! A small humanoid, and a motion for it.

use super::glb;
use crate::matrix;
use crate::quaternion::{self, NO_TURN, Quaternion};
use crate::{Bone, Node, Scene, Transform};

/// The bones of the humanoid: each with the one that it hangs on and how far from it, for one that looks along +Z.
pub(super) const BODY: [(&str, Option<usize>, [f32; 3]); 15] = [
    ("hips", None, [0.0, 1.0, 0.05]),
    ("spine", Some(0), [0.0, 0.1, 0.0]),
    ("head", Some(1), [0.0, 0.5, 0.0]),
    ("leftUpperLeg", Some(0), [0.1, -0.05, 0.0]),
    ("leftLowerLeg", Some(3), [0.0, -0.45, 0.0]),
    ("leftFoot", Some(4), [0.0, -0.45, 0.0]),
    ("rightUpperLeg", Some(0), [-0.1, -0.05, 0.0]),
    ("rightLowerLeg", Some(6), [0.0, -0.45, 0.0]),
    ("rightFoot", Some(7), [0.0, -0.45, 0.0]),
    ("leftUpperArm", Some(1), [0.2, 0.35, 0.0]),
    ("leftLowerArm", Some(9), [0.3, 0.0, 0.0]),
    ("leftHand", Some(10), [0.25, 0.0, 0.0]),
    ("rightUpperArm", Some(1), [-0.2, 0.35, 0.0]),
    ("rightLowerArm", Some(12), [-0.3, 0.0, 0.0]),
    ("rightHand", Some(13), [-0.25, 0.0, 0.0]),
];

/// How many bones [`humanoid`] has.
pub const BODY_BONES: usize = BODY.len();

/// A version of VRM.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Vrm {
    /// VRM 0.x.
    Zero,
    /// VRM 1.0.
    One,
}

/// The nodes of a humanoid of some size, whose bones stand at the same places of the world however their nodes are
/// turned there.
fn nodes(
    size: f32,
    turns: &[[f32; 4]; BODY_BONES],
) -> Vec<(&'static str, Option<usize>, Transform)> {
    let turn = |index: usize| quaternion::unit(turns[index]);
    let place = |(index, (name, parent, way)): (usize, (&'static str, Option<usize>, [f32; 3]))| {
        let back = quaternion::inverse(parent.map_or(NO_TURN, turn));
        let undo = matrix::from_parts([0.0; 3], back, [size; 3]);
        let rest = Transform {
            translation: matrix::transform_point(&undo, way),
            rotation: quaternion::multiply(back, turn(index)),
            ..Transform::default()
        };
        (name, parent, rest)
    };
    BODY.into_iter().enumerate().map(place).collect()
}

/// A humanoid of 15 bones without a shape: `size` m high at the hips, with nodes that are turned in the world by
/// quaternions of any length. It has no figure; its nodes are named as VRM names bones.
pub fn humanoid(size: f32, turns: &[[f32; 4]; BODY_BONES]) -> Scene {
    let mut scene = Scene::default();
    for (index, (name, parent, rest)) in nodes(size, turns).into_iter().enumerate() {
        let local = rest.matrix();
        let world = parent.map(|parent| scene.nodes[parent].world_from_node);
        if let Some(parent) = parent {
            scene.nodes[parent].children.push(index as u32);
        }
        scene.nodes.push(Node {
            name: name.to_owned(),
            parent: parent.map(|parent| parent as u32),
            rest: Some(rest),
            local,
            world_from_node: world.map_or(local, |world| matrix::multiply(&world, &local)),
            ..Node::default()
        });
    }
    scene
}

/// A VRM file of the humanoid, with a small body at every bone and a face of two morphs.
///
/// Expressions: `happy` moves the first morph by half and turns the face red, `blink` is binary and moves the second,
/// `aa` moves the first; `happy` blocks blinks and blends mouths, but in VRM 0.x, which has no overrides. `Wink` is
/// the file's own.
pub fn avatar(vrm: Vrm) -> Vec<u8> {
    // Stand it up; avatars of VRM 0.x look along -Z.
    let turns = [NO_TURN; BODY_BONES];
    let front = |[x, y, z]: [f32; 3]| match vrm {
        Vrm::Zero => [-x, y, -z],
        Vrm::One => [x, y, z],
    };
    let all = nodes(1.0, &turns);
    let node = |(index, (name, _, rest)): (usize, &(&str, Option<usize>, Transform))| {
        let below = all.iter().enumerate();
        let below = below.filter(|(_, (_, parent, _))| *parent == Some(index));
        let children: Vec<usize> = below.map(|(child, _)| child).collect();
        let children = match children.is_empty() {
            true => String::new(),
            false => format!(r#","children":{children:?}"#),
        };
        let mesh = u32::from(*name == "head");
        let place = front(rest.translation);
        format!(r#"{{"name":"{name}","mesh":{mesh},"translation":{place:?}{children}}}"#)
    };
    let nodes: Vec<String> = all.iter().enumerate().map(node).collect();

    // Shape a body, and morphs that widen it and that raise its tip.
    let tip = front([0.0, 0.05, 0.12]);
    let body = [
        front([-0.07, -0.06, 0.0]),
        front([0.07, -0.06, 0.0]),
        front([0.0, 0.1, 0.0]),
        tip,
    ];
    let widen = [
        front([-0.2, 0.0, 0.0]),
        front([0.2, 0.0, 0.0]),
        [0.0; 3],
        [0.0; 3],
    ];
    let raise = [[0.0; 3], [0.0; 3], [0.0; 3], [0.0, 0.3, 0.0]];
    let numbers = [body, widen, raise];
    let mut bin: Vec<u8> = numbers
        .as_flattened()
        .as_flattened()
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let triangles: [u16; 12] = [0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1];
    bin.extend(triangles.iter().flat_map(|corner| corner.to_le_bytes()));

    // Write it down.
    let extension = match vrm {
        Vrm::Zero => zero(),
        Vrm::One => one(),
    };
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{}],
        "materials":[{{"name":"Face","pbrMetallicRoughness":{{"baseColorFactor":[0.2,0.6,0.5,1]}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":3}}]}},
        {{"primitives":[{{"attributes":{{"POSITION":0}},"indices":3,"material":0,
        "targets":[{{"POSITION":1}},{{"POSITION":2}}]}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
        {{"bufferView":0,"byteOffset":48,"componentType":5126,"count":4,"type":"VEC3"}},
        {{"bufferView":0,"byteOffset":96,"componentType":5126,"count":4,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":144}},{{"buffer":0,"byteOffset":144,"byteLength":24}}],
        "buffers":[{{"byteLength":168}}],{extension}}}"#,
        nodes.join(",")
    );
    glb(&json, &bin)
}

fn one() -> String {
    let bones: Vec<String> = BODY
        .iter()
        .enumerate()
        .map(|(index, (name, ..))| format!(r#""{name}":{{"node":{index}}}"#))
        .collect();
    format!(
        r#""extensionsUsed":["VRMC_vrm"],"extensions":{{"VRMC_vrm":{{"specVersion":"1.0",
        "humanoid":{{"humanBones":{{{}}}}},"expressions":{{"preset":{{
        "happy":{{"overrideBlink":"block","overrideMouth":"blend",
        "morphTargetBinds":[{{"node":2,"index":0,"weight":0.5}}],
        "materialColorBinds":[{{"material":0,"type":"color","targetValue":[1,0,0,1]}}]}},
        "blink":{{"isBinary":true,"morphTargetBinds":[{{"node":2,"index":1}}]}},
        "aa":{{"morphTargetBinds":[{{"node":2,"index":0,"weight":1}}]}}}},
        "custom":{{"Wink":{{"morphTargetBinds":[{{"node":2,"index":1,"weight":0.7}}]}}}}}}}}}}"#,
        bones.join(",")
    )
}

fn zero() -> String {
    let bones: Vec<String> = BODY
        .iter()
        .enumerate()
        .map(|(index, (name, ..))| format!(r#"{{"bone":"{name}","node":{index}}}"#))
        .collect();
    format!(
        r#""extensionsUsed":["VRM"],"extensions":{{"VRM":{{"humanoid":{{"humanBones":[{},
        {{"bone":"jaw","node":-1}}]}},"blendShapeMaster":{{"blendShapeGroups":[
        {{"name":"Joy","presetName":"joy","binds":[{{"mesh":1,"index":0,"weight":50}}],
        "materialValues":[{{"materialName":"Face","propertyName":"_Color","targetValue":[1,0,0,1]}}]}},
        {{"name":"Blink","presetName":"blink","isBinary":true,"binds":[{{"mesh":1,"index":1,"weight":100}}]}},
        {{"name":"A","presetName":"a","binds":[{{"mesh":1,"index":0,"weight":100}}]}},
        {{"name":"Wink","presetName":"unknown","binds":[{{"mesh":1,"index":1,"weight":70}}]}}]}}}}}}"#,
        bones.join(",")
    )
}

/// How the nodes of [`gesture`] are turned in the world, for each bone another way.
fn crooked(index: usize) -> Quaternion {
    let v = index as f32;
    quaternion::unit([
        0.3 - 0.1 * v,
        0.2 + 0.05 * v,
        0.4 - 0.07 * v,
        0.5 + 0.03 * v,
    ])
}

/// A VRM animation of two seconds, `Wave`, of a humanoid of 1.6 times the size whose nodes are turned in odd ways: it
/// sways, lifts its left arm, bends a leg and the head, smiles and blinks, and looks somewhere.
pub fn gesture() -> Vec<u8> {
    // Lay out nodes: bones first, then those of expressions and of the look.
    let turns = std::array::from_fn(crooked);
    let all = nodes(1.6, &turns);
    let named = |wanted: &str| {
        BODY.iter()
            .position(|(name, ..)| *name == wanted)
            .unwrap_or(0)
    };
    let node = |(index, (name, _, rest)): (usize, &(&str, Option<usize>, Transform))| {
        let below = all.iter().enumerate();
        let below = below.filter(|(_, (_, parent, _))| *parent == Some(index));
        let children: Vec<usize> = below.map(|(child, _)| child).collect();
        let children = match children.is_empty() {
            true => String::new(),
            false => format!(r#","children":{children:?}"#),
        };
        let (place, turn) = (rest.translation, rest.rotation);
        format!(r#"{{"name":"{name}","translation":{place:?},"rotation":{turn:?}{children}}}"#)
    };
    let mut nodes: Vec<String> = all.iter().enumerate().map(node).collect();
    nodes.extend(["happy", "blink", "look"].map(|name| format!(r#"{{"name":"{name}"}}"#)));

    // Turn bones beside how they rest, along axes of their own.
    let turned = |bone: &str, ways: [Quaternion; 3]| -> (usize, &str, Vec<f32>) {
        let index = named(bone);
        let rest = all[index].2.rotation;
        let keys = ways.map(|way| quaternion::multiply(rest, quaternion::unit(way)));
        (index, "rotation", keys.as_flattened().to_vec())
    };
    let [x, y, z] = all[0].2.translation;
    let ways = [[x, y, z], [x + 0.1, y - 0.2, z], [x, y, z + 0.3]];
    let shares = |all: [f32; 3]| all.map(|share| [share, 0.0, 0.0]).as_flattened().to_vec();
    let mut channels = vec![
        (0, "translation", ways.as_flattened().to_vec()),
        turned(
            "hips",
            [
                [0.0, 0.0, 0.0, 1.0],
                [0.1, 0.2, 0.0, 1.0],
                [0.0, -0.2, 0.1, 1.0],
            ],
        ),
        turned(
            "spine",
            [
                [0.0, 0.1, 0.0, 1.0],
                [0.2, 0.0, 0.1, 1.0],
                [0.0, 0.0, 0.0, 1.0],
            ],
        ),
        turned(
            "head",
            [
                [0.3, 0.0, 0.0, 1.0],
                [0.0, 0.4, 0.0, 1.0],
                [0.0, 0.0, -0.3, 1.0],
            ],
        ),
        turned(
            "leftUpperArm",
            [
                [0.0, 0.0, 0.0, 1.0],
                [0.4, -0.3, 0.9, 1.0],
                [0.1, 0.7, -0.2, 1.0],
            ],
        ),
        turned(
            "leftLowerArm",
            [
                [0.5, 0.0, 0.2, 1.0],
                [0.0, 0.8, 0.1, 1.0],
                [0.3, 0.3, 0.3, 1.0],
            ],
        ),
        turned(
            "rightUpperLeg",
            [
                [0.0, 0.0, 0.0, 1.0],
                [0.6, 0.2, 0.0, 1.0],
                [-0.3, 0.0, 0.2, 1.0],
            ],
        ),
        turned(
            "rightLowerLeg",
            [
                [0.2, 0.0, 0.0, 1.0],
                [-0.6, 0.0, 0.3, 1.0],
                [0.0, 0.0, 0.0, 1.0],
            ],
        ),
    ];
    channels.push((BODY_BONES, "translation", shares([0.0, 1.0, 0.5])));
    channels.push((BODY_BONES + 1, "translation", shares([0.0, 0.8, 0.0])));

    // Write it down: three keys each, the times first.
    let mut bin: Vec<u8> = [0.0f32, 1.0, 2.0]
        .iter()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let mut accessors =
        vec![r#"{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}"#.to_owned()];
    let (mut samplers, mut targets) = (Vec::new(), Vec::new());
    for (index, (node, path, values)) in channels.iter().enumerate() {
        let (start, kind) = (bin.len(), if values.len() == 12 { "VEC4" } else { "VEC3" });
        accessors.push(format!(
            r#"{{"bufferView":0,"byteOffset":{start},"componentType":5126,"count":3,"type":"{kind}"}}"#
        ));
        samplers.push(format!(r#"{{"input":0,"output":{}}}"#, index + 1));
        targets.push(format!(
            r#"{{"sampler":{index},"target":{{"node":{node},"path":"{path}"}}}}"#
        ));
        bin.extend(values.iter().flat_map(|v| v.to_le_bytes()));
    }
    let bones: Vec<String> = BODY
        .iter()
        .enumerate()
        .map(|(index, (name, ..))| format!(r#""{name}":{{"node":{index}}}"#))
        .collect();
    let [happy, blink, look] = [0, 1, 2].map(|i| BODY_BONES + i);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,{happy},{blink},{look}]}}],"nodes":[{}],
        "accessors":[{}],"bufferViews":[{{"buffer":0,"byteLength":{}}}],"buffers":[{{"byteLength":{}}}],
        "animations":[{{"name":"Wave","samplers":[{}],"channels":[{}]}}],
        "extensionsUsed":["VRMC_vrm_animation"],"extensions":{{"VRMC_vrm_animation":{{"specVersion":"1.0",
        "humanoid":{{"humanBones":{{{}}}}},"expressions":{{"preset":{{"happy":{{"node":{happy}}},
        "blink":{{"node":{blink}}}}}}},"lookAt":{{"node":{look}}}}}}}}}"#,
        nodes.join(","),
        accessors.join(","),
        bin.len(),
        bin.len(),
        samplers.join(","),
        targets.join(","),
        bones.join(",")
    );
    glb(&json, &bin)
}

/// The node of [`humanoid`] that is a bone.
pub fn node_of(bone: Bone) -> Option<u32> {
    let index = BODY.iter().position(|(name, ..)| *name == bone.name());
    index.map(|index| index as u32)
}
