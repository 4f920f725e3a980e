//! A humanoid whose eyes, twists, hair and skirt move on their own.

use super::figures::{BODY, Vrm};
use super::glb;
use crate::quaternion;
use crate::transform::half_turned_move;
use crate::{Eyes, Transform};

/// A node of the puppet beside the bones of its body: its name, what it hangs on, where it rests, how it is turned.
type Part = (&'static str, &'static str, [f32; 3], [f32; 4]);

/// What hangs on the body, for one that looks along +Z.
const PARTS: [Part; 13] = [
    ("leftEye", "head", [0.03, 0.05, 0.09], UPRIGHT),
    ("rightEye", "head", [-0.03, 0.05, 0.09], UPRIGHT),
    ("hair 1", "head", [0.02, 0.1, -0.1], UPRIGHT),
    ("hair 2", "hair 1", [0.0, -0.12, -0.04], UPRIGHT),
    ("hair 3", "hair 2", [0.0, -0.14, 0.0], UPRIGHT),
    ("skirt 1", "hips", [0.12, -0.05, 0.1], UPRIGHT),
    ("skirt 2", "skirt 1", [0.03, -0.2, 0.04], UPRIGHT),
    ("tail 1", "hips", [-0.05, 0.0, -0.1], UPRIGHT),
    ("tail 2", "tail 1", [0.0, -0.1, -0.15], UPRIGHT),
    (
        "twist",
        "leftLowerArm",
        [0.1, 0.0, 0.0],
        [0.3, -0.2, 0.1, 0.9],
    ),
    ("sleeve", "spine", [0.15, 0.35, 0.0], [0.0, 0.4, 0.2, 0.8]),
    ("echo", "hips", [0.3, 0.2, 0.1], [0.1, 0.1, 0.5, 0.7]),
    ("call", "spine", [-0.3, 0.2, 0.1], [0.2, 0.6, -0.1, 0.6]),
];

/// Ends of springs, which VRM 0.x adds by itself, 7 cm further.
const ENDS: [Part; 2] = [
    ("hair end", "hair 3", [0.0, -0.07, 0.0], UPRIGHT),
    (
        "skirt end",
        "skirt 2",
        [0.010_245_3, -0.068_302_1, 0.013_660_4],
        UPRIGHT,
    ),
];

const UPRIGHT: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

/// How the parts follow others: the node, its constraint, and the same for one that looks the other way.
const FOLLOWS: [(&str, &str); 4] = [
    (
        "twist",
        r#"{"roll":{"source":"leftHand","rollAxis":"X","weight":0.6}}"#,
    ),
    (
        "sleeve",
        r#"{"aim":{"source":"leftLowerArm","aimAxis":"PositiveX","weight":0.9}}"#,
    ),
    ("echo", r#"{"rotation":{"source":"call","weight":0.7}}"#),
    ("call", r#"{"rotation":{"source":"leftUpperArm"}}"#),
];

/// Nodes that draw something of their own.
const DRAWN: [&str; 10] = [
    "leftEye", "rightEye", "hair 1", "hair 2", "skirt 1", "skirt 2", "twist", "sleeve", "echo",
    "call",
];

/// A VRM file of the humanoid with eyes, hair, a skirt and nodes that follow others, drawn by small bodies. Both
/// versions are alike, but for a tail with a capsule and a centre, which swings in VRM 1.0 alone.
pub fn puppet(vrm: Vrm, eyes: Eyes) -> Vec<u8> {
    // Lay out the nodes; avatars of VRM 0.x look along -Z.
    let bones = BODY.iter().map(|(name, parent, way)| {
        let parent = parent.map_or("", |parent| BODY[parent].0);
        (*name, parent, *way, UPRIGHT)
    });
    let ends = ENDS.iter().filter(|_| vrm == Vrm::One);
    let all: Vec<Part> = bones.chain(PARTS).chain(ends.copied()).collect();
    let index = |wanted: &str| all.iter().position(|(name, ..)| *name == wanted);
    let nodes: Vec<String> = all.iter().map(|part| node(part, &all, vrm)).collect();
    let named = |text: &str| -> String {
        // Longer names come first, so that none is taken for the start of another.
        let mut text = text.to_owned();
        for (name, ..) in &all {
            let number = index(name).unwrap_or(0).to_string();
            text = text.replace(&format!("\"{name}\","), &format!("{number},"));
            text = text.replace(&format!("\"{name}\"}}"), &format!("{number}}}"));
            text = text.replace(&format!("\"{name}\"]"), &format!("{number}]"));
        }
        text
    };

    // Shape a body, and a morph for each way to look.
    let ways = [
        [0.0, 0.1, 0.0],
        [0.0, -0.1, 0.0],
        [0.1, 0.0, 0.0],
        [-0.1, 0.0, 0.0],
    ];
    let body = [
        [-0.03, -0.05, 0.0],
        [0.03, -0.05, 0.0],
        [0.0, 0.05, 0.0],
        [0.0, 0.0, 0.06],
    ];
    let tip = |way: [f32; 3]| [[0.0; 3], [0.0; 3], [0.0; 3], way];
    let shapes = [body, tip(ways[0]), tip(ways[1]), tip(ways[2]), tip(ways[3])];
    let mut bin: Vec<u8> = shapes
        .as_flattened()
        .iter()
        .flat_map(|place| {
            if vrm == Vrm::Zero {
                half_turned_move(*place)
            } else {
                *place
            }
        })
        .flat_map(f32::to_le_bytes)
        .collect();
    let triangles: [u16; 12] = [0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1];
    bin.extend(triangles.iter().flat_map(|corner| corner.to_le_bytes()));

    // Write it down.
    let accessors: Vec<String> = (0..5)
        .map(|i| {
            let start = i * 48;
            format!(r#"{{"bufferView":0,"byteOffset":{start},"componentType":5126,"count":4,"type":"VEC3"}}"#)
        })
        .collect();
    let extensions = match vrm {
        Vrm::Zero => zero(eyes),
        Vrm::One => one(eyes),
    };
    let used = match vrm {
        Vrm::Zero => r#"["VRM","VRMC_node_constraint"]"#,
        Vrm::One => r#"["VRMC_vrm","VRMC_springBone","VRMC_node_constraint"]"#,
    };
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":5}}]}},
{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":5,
"targets":[{{"POSITION":1}},{{"POSITION":2}},{{"POSITION":3}},{{"POSITION":4}}]}}]}}],
"accessors":[{},{{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteLength":240}},{{"buffer":0,"byteOffset":240,"byteLength":24}}],
"buffers":[{{"byteLength":264}}],"extensionsUsed":{used},"extensions":{{{}}}}}"#,
        named(&nodes.join(",\n")),
        accessors.join(",\n"),
        named(&extensions)
    );
    glb(&json, &bin)
}

/// A node in the file.
fn node((name, _, way, turn): &Part, all: &[Part], vrm: Vrm) -> String {
    let rest = Transform {
        translation: *way,
        rotation: quaternion::unit(*turn),
        ..Transform::default()
    };
    let [x, y, z, w] = rest.rotation;
    let (way, turn) = match vrm {
        Vrm::Zero => (half_turned_move(rest.translation), [-x, y, -z, w]),
        Vrm::One => (rest.translation, rest.rotation),
    };
    let below = all.iter().filter(|(_, parent, ..)| parent == name);
    let below: Vec<String> = below.map(|(name, ..)| format!("\"{name}\"")).collect();
    let mut said = format!(r#""name":"{name}" ,"translation":{way:?}"#);
    if turn != UPRIGHT {
        said += &format!(r#","rotation":{turn:?}"#);
    }
    if !below.is_empty() {
        said += &format!(r#","children":[{}]"#, below.join(","));
    }
    if *name == "head" || DRAWN.contains(name) || BODY.iter().any(|(bone, ..)| bone == name) {
        let mesh = u32::from(*name == "head");
        said += &format!(r#","mesh":{mesh}"#);
    }
    if let Some((_, constraint)) = FOLLOWS.iter().find(|(follower, _)| follower == name) {
        let constraint = match vrm {
            Vrm::Zero => constraint.replace("PositiveX", "NegativeX"),
            Vrm::One => (*constraint).to_owned(),
        };
        said += &format!(
            r#","extensions":{{"VRMC_node_constraint":{{"specVersion":"1.0","constraint":{constraint}}}}}"#
        );
    }
    format!("{{{said}}}")
}

/// The ways to look, as VRM 1.0 and 0.x call them.
const LOOKS: [[&str; 2]; 4] = [
    ["lookUp", "lookup"],
    ["lookDown", "lookdown"],
    ["lookLeft", "lookleft"],
    ["lookRight", "lookright"],
];

fn one(eyes: Eyes) -> String {
    let bones = BODY.iter().map(|(name, ..)| *name);
    let bones = bones.chain(
        ["leftEye", "rightEye"]
            .into_iter()
            .filter(|_| eyes == Eyes::Bones),
    );
    let bones: Vec<String> = bones
        .map(|name| format!(r#""{name}":{{"node":"{name}"}}"#))
        .collect();
    let faces = (0..).zip(LOOKS).map(|(morph, [name, _])| {
        format!(r#""{name}":{{"morphTargetBinds":[{{"node":"head","index":{morph},"weight":1}}]}}"#)
    });
    let faces: Vec<String> = faces.collect();
    let (kind, outputs) = match eyes {
        Eyes::Bones => ("bone", [8, 12, 9, 10]),
        Eyes::Expressions => ("expression", [1, 1, 1, 1]),
    };
    let map = |name: &str, most: u32, output: i32| {
        format!(r#""rangeMap{name}":{{"inputMaxValue":{most},"outputScale":{output}}}"#)
    };
    let maps = [
        map("HorizontalInner", 80, outputs[0]),
        map("HorizontalOuter", 90, outputs[1]),
        map("VerticalDown", 60, outputs[2]),
        map("VerticalUp", 70, outputs[3]),
    ];
    format!(
        r#""VRMC_vrm":{{"specVersion":"1.0","meta":{{"name":"puppet","authors":["npr"],
"licenseUrl":"https://vrm.dev/licenses/1.0/"}},"humanoid":{{"humanBones":{{{}}}}},
"expressions":{{"preset":{{"happy":{{"overrideLookAt":"blend"}},"angry":{{"overrideLookAt":"block"}},{}}}}},
"lookAt":{{"type":"{kind}","offsetFromHeadBone":[0.0,0.05,0.08],{}}}}},
"VRMC_springBone":{{"specVersion":"1.0","colliders":[
{{"node":"head","shape":{{"sphere":{{"offset":[0.0,0.05,0.0],"radius":0.11}}}}}},
{{"node":"spine","shape":{{"sphere":{{"offset":[0.0,0.4,-0.02],"radius":0.08}}}}}},
{{"node":"leftUpperLeg","shape":{{"sphere":{{"offset":[0.0,-0.15,0.02],"radius":0.07}}}}}},
{{"node":"rightUpperLeg","shape":{{"capsule":{{"offset":[0.0,0.1,-0.1],"radius":0.06,"tail":[0.1,-0.2,-0.12]}}}}}}],
"colliderGroups":[{{"name":"face","colliders":[0,1]}},{{"name":"leg","colliders":[2]}},{{"colliders":[3]}}],
"springs":[{{"name":"hair","colliderGroups":[0],"joints":[{}]}},
{{"name":"skirt","colliderGroups":[1],"joints":[{}]}},
{{"name":"tail","colliderGroups":[2],"center":"hips","joints":[{}]}}]}}"#,
        bones.join(","),
        faces.join(",\n"),
        maps.join(",\n"),
        joints(&["hair 1", "hair 2", "hair 3", "hair end"], HAIR),
        joints(&["skirt 1", "skirt 2", "skirt end"], SKIRT),
        joints(&["tail 1", "tail 2"], [0.02, 1.5, 0.2, 0.2])
    )
}

/// Radius, stiffness, gravity and drag of the hair.
const HAIR: [f32; 4] = [0.02, 0.8, 0.4, 0.3];

/// The same of the skirt.
const SKIRT: [f32; 4] = [0.03, 1.2, 0.1, 0.5];

fn joints(names: &[&str], [radius, stiffness, gravity, drag]: [f32; 4]) -> String {
    let joint = |name: &&str| {
        format!(
            r#"{{"hitRadius":{radius},"stiffness":{stiffness},"gravityPower":{gravity},"gravityDir":[0.2,-0.9,0.1],
"dragForce":{drag},"node":"{name}"}}"#
        )
    };
    names.iter().map(joint).collect::<Vec<_>>().join(",\n")
}

fn zero(eyes: Eyes) -> String {
    let bones = BODY.iter().map(|(name, ..)| *name);
    let bones = bones.chain(
        ["leftEye", "rightEye"]
            .into_iter()
            .filter(|_| eyes == Eyes::Bones),
    );
    let bones: Vec<String> = bones
        .map(|name| format!(r#"{{"bone":"{name}" ,"node":"{name}"}}"#))
        .collect();
    let faces = (0..).zip(LOOKS).map(|(morph, [_, name])| {
        format!(r#"{{"name":"{name}" ,"presetName":"{name}" ,"binds":[{{"mesh":1,"index":{morph},"weight":100}}]}}"#)
    });
    let faces: Vec<String> = faces.collect();
    let (kind, outputs) = match eyes {
        Eyes::Bones => ("Bone", [8, 12, 9, 10]),
        Eyes::Expressions => ("BlendShape", [1, 1, 1, 1]),
    };
    let map = |name: &str, most: u32, output: i32| {
        format!(r#""lookAt{name}":{{"curve":[0,0,0,1,1,1,1,0],"xRange":{most},"yRange":{output}}}"#)
    };
    let maps = [
        map("HorizontalInner", 80, outputs[0]),
        map("HorizontalOuter", 90, outputs[1]),
        map("VerticalDown", 60, outputs[2]),
        map("VerticalUp", 70, outputs[3]),
    ];
    // In vectors of VRM 0.x the figure looks along +z, and its left is -x.
    let group = |names: &str, colliders: u32, [radius, stiffness, gravity, drag]: [f32; 4]| {
        format!(
            r#"{{"hitRadius":{radius},"stiffiness":{stiffness},"gravityPower":{gravity},
"gravityDir":{{"x":-0.2,"y":-0.9,"z":0.1}},"dragForce":{drag},"center":-1,"colliderGroups":[{colliders}],
"bones":[{names}]}}"#
        )
    };
    format!(
        r#""VRM":{{"exporterVersion":"npr","humanoid":{{"humanBones":[{}]}},
"blendShapeMaster":{{"blendShapeGroups":[{}]}},
"firstPerson":{{"firstPersonBone":"head","firstPersonBoneOffset":{{"x":0.0,"y":0.05,"z":0.08}},
"lookAtTypeName":"{kind}" ,{}}},
"secondaryAnimation":{{"colliderGroups":[
{{"node":"head","colliders":[{{"offset":{{"x":0.0,"y":0.05,"z":0.0}},"radius":0.11}}]}},
{{"node":"leftUpperLeg","colliders":[{{"offset":{{"x":0.0,"y":-0.15,"z":0.02}},"radius":0.07}}]}},
{{"node":"spine","colliders":[{{"offset":{{"x":0.0,"y":0.4,"z":-0.02}},"radius":0.08}}]}}],
"boneGroups":[{},{}]}}}}"#,
        bones.join(","),
        faces.join(",\n"),
        maps.join(",\n"),
        group("\"hair 1\"", 0, HAIR).replace("[0]", "[0,2]"),
        group("\"skirt 1\"", 1, SKIRT)
    )
}
