//! Figures of VRM files: bones, expressions, postures and motions, against three-vrm and of broken files.

use crate::models::{loaded, models};
use npr_scene::testing::{Vrm, avatar, gesture, glb};
use npr_scene::{Format, Limits, MemoryResources, Pose, Posture, Scene, SceneError, load_bytes};
use serde_json::Value;
use std::path::Path;

/// Most that a place may differ, as a share of the model's size, and a weight.
const MOST: f64 = 1e-4;

/// What `three_figures.mjs` wrote.
const OF_THREE: &str = include_str!("../data/three_figures.json");

/// The motion that it played.
const GESTURE: &[u8] = include_bytes!("../data/gesture.vrma");

fn load_within(bytes: &[u8], limits: &Limits) -> Result<Scene, SceneError> {
    let resources = MemoryResources::default();
    let scene = load_bytes("test", bytes, Some(Format::Glb), &resources, limits)?;
    scene.sanity_check();
    Ok(scene)
}

fn load(bytes: &[u8]) -> Scene {
    load_within(bytes, &Limits::default()).expect("a file that can be drawn")
}

pub fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The JSON text and the bytes behind it.
pub fn parts(file: &[u8]) -> (String, Vec<u8>) {
    let length = u32::from_le_bytes(file[12..16].try_into().expect("4 bytes")) as usize;
    let text = String::from_utf8(file[20..20 + length].to_vec()).expect("text");
    let rest = file.get(28 + length..).unwrap_or_default();
    (text.trim_end().to_owned(), rest.to_vec())
}

/// Asserts that the bones of a scene stand where three-vrm has them.
fn assert_places(scene: &Scene, wanted: &Value, [size, step]: [f64; 2], what: &str) {
    let bones = &scene.figure.as_ref().expect("an avatar").bones;
    let wanted = wanted.as_object().expect("bones");
    assert_eq!(bones.len(), wanted.len(), "{what}");
    for (bone, node) in bones {
        let [x, y, z, _] = scene.nodes[*node as usize].world_from_node[3];
        let place = list(&wanted[bone.name()]).iter().map(number);
        for (found, wanted) in [x, y, z].into_iter().zip(place) {
            let apart = (f64::from(found) - wanted * step).abs() / size;
            assert!(apart < MOST, "{what}, {bone}: {apart} of its size");
        }
    }
}

/// Asserts that morphs have the weights of three-vrm, node by node; those of the file come in its order.
fn assert_weights(scene: &Scene, wanted: &Value, what: &str) {
    let wanted = wanted.as_object().expect("nodes");
    let mut found: Vec<Vec<f32>> = Vec::new();
    for node in &scene.nodes {
        let mesh = node.mesh.map(|mesh| &scene.meshes[mesh as usize]);
        let morphs = mesh.map_or(&[][..], |mesh| &mesh.parts[0].morphs);
        if !morphs.is_empty() {
            found.push(morphs.iter().map(|morph| morph.applied_weight).collect());
        }
    }
    assert_eq!(found.len(), wanted.len(), "{what}");
    for (found, wanted) in found.iter().zip(wanted.values()) {
        let wanted = list(wanted);
        assert_eq!(found.len(), wanted.len(), "{what}");
        for (found, wanted) in found.iter().zip(wanted) {
            let apart = (f64::from(*found) - number(wanted)).abs();
            assert!(apart < MOST, "{what}: {found} and {wanted}");
        }
    }
}

#[test]
fn the_motion_that_three_vrm_played_is_the_one_of_tests() {
    assert!(GESTURE == gesture());
}

#[test]
fn bones_and_morphs_are_those_of_three_vrm() {
    let Some(folder) = models() else { return };
    let poses = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/poses");
    let of_three: Value = serde_json::from_str(OF_THREE).expect("JSON");
    let motion = load(GESTURE);
    let mut counts = [0, 0];
    for model in list(&of_three["models"]) {
        // At rest.
        let name = model["name"].as_str().expect("a name");
        let size = number(&model["size"]);
        let scale = [size, size / number(&of_three["steps"])];
        let rest = loaded(&folder, name);
        assert_places(&rest, &model["rest"], scale, name);
        let stand = |pose: &Pose, of: &Scene| {
            let mut posed = of.clone();
            posed.set_pose(pose).expect("in range");
            posed
        };

        // In poses.
        assert_eq!(list(&model["poses"]).len(), 3);
        for said in list(&model["poses"]) {
            let file = poses.join(format!("{}.json", said["pose"].as_str().expect("a name")));
            let bytes = std::fs::read(file).expect("a pose");
            let (posture, faults) = Posture::read(&bytes, &Limits::default()).expect("a posture");
            assert_eq!(faults, []);
            let mut pose = Pose::default();
            rest.bend(&mut pose, &posture);
            let what = format!("{name}, {}", said["pose"]);
            assert_places(&stand(&pose, &rest), &said["places"], scale, &what);
        }

        // With expressions.
        let figure = rest.figure.as_ref().expect("an avatar");
        counts[0] += figure.expressions.len();
        assert_eq!(
            list(&model["expressions"]).len(),
            3 * figure.expressions.len()
        );
        for said in list(&model["expressions"]) {
            let number_of = said["expression"]
                .as_str()
                .and_then(|name| figure.expression(name));
            let share = number(&said["share"]) as f32;
            let pose = Pose {
                shares: [(number_of.expect("an expression"), share)].into(),
                ..Pose::default()
            };
            let what = format!("{name}, {} at {share}", said["expression"]);
            assert_weights(&stand(&pose, &rest), &said["weights"], &what);
        }

        // In a motion.
        let clips = rest
            .clips_of(&motion, &Limits::default())
            .expect("a motion")
            .clips;
        for moment in list(&model["moments"]) {
            let time = number(&moment["time"]) as f32;
            let posed = stand(&rest.pose_at(&clips[0], time), &rest);
            let what = format!("{name} at {time} s");
            assert_places(&posed, &moment["places"], scale, &what);
            assert_weights(&posed, &moment["weights"], &what);
            counts[1] += 1;
        }
    }
    assert_eq!(counts, [17 + 17 + 18, 12]);
}

/// Asserts that a file with a word of its text replaced is drawn, and what is said of it beside what is ignored
/// anyway.
#[track_caller]
fn assert_told(file: &[u8], from: &str, to: &str, told: &[&str]) -> Scene {
    let (text, bin) = parts(file);
    assert!(text.contains(from), "{from}");
    let scene = load(&glb(&text.replacen(from, to, 1), &bin));
    let said = scene.notices.iter().map(|notice| notice.text.as_str());
    let said: Vec<&str> = said
        .filter(|text| !text.starts_with("look-at and springs"))
        .collect();
    assert_eq!(said, told);
    scene
}

#[test]
fn sound_files_have_all_their_bones_and_expressions() {
    for vrm in [Vrm::Zero, Vrm::One] {
        let scene = assert_told(&avatar(vrm), "Face", "Face", &[]);
        let figure = scene.figure.expect("an avatar");
        assert_eq!((figure.bones.len(), figure.expressions.len()), (15, 4));
    }
    let scene = assert_told(&gesture(), "Wave", "Wave", &[]);
    let figure = scene.figure.expect("a motion");
    assert_eq!((figure.bones.len(), figure.share_nodes.len()), (15, 2));
    assert!(figure.has_looks && figure.expressions.is_empty());
    assert!(load(&npr_scene::testing::wing()).figure.is_none());
}

#[test]
fn broken_bones_are_left_out_and_told() {
    let of = |vrm, from: &str, to: &str, told: &[&str]| {
        let scene = assert_told(&avatar(vrm), from, to, told);
        scene.figure.map_or(0, |figure| figure.bones.len())
    };
    let lacks = "the avatar lacks bones that VRM requires: head";
    let head = [r#""head":{"node":2}"#, r#"{"bone":"head","node":2}"#];
    let none = "bone 'head' of the avatar names no node of the 15 in the file";
    for node in [
        "15",
        "-1",
        "2.5",
        "\"2\"",
        "18446744073709551616",
        "null",
        "[2]",
    ] {
        let broken = head[0].replace('2', node);
        assert_eq!(of(Vrm::One, head[0], &broken, &[none, lacks]), 14, "{node}");
    }
    assert_eq!(
        of(
            Vrm::Zero,
            head[1],
            &head[1].replace('2', "99"),
            &[none, lacks]
        ),
        14
    );
    assert_eq!(
        of(Vrm::Zero, head[1], &head[1].replace('2', "-1"), &[lacks]),
        14
    );
    let unknown = "bone 'haed' of the avatar is none that VRM knows";
    assert_eq!(
        of(Vrm::One, "\"head\":{", "\"haed\":{", &[unknown, lacks]),
        14
    );
    let twice = "bone 'spine' of the avatar is named twice; the first one counts";
    assert_eq!(
        of(
            Vrm::Zero,
            "\"bone\":\"head\"",
            "\"bone\":\"spine\"",
            &[twice, lacks]
        ),
        14
    );
    let shared = "bone 'head' of the avatar is node 1, which is bone 'spine' already";
    assert_eq!(
        of(
            Vrm::Zero,
            head[1],
            &head[1].replace('2', "1"),
            &[shared, lacks]
        ),
        14
    );
    let matrix = "bone 'head' of the avatar is node 2, which has a matrix and is not posed";
    let from = r#""name":"head","mesh":1,"translation":[0.0, 0.5, 0.0]"#;
    let to = r#""name":"head","mesh":1,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,1,0,1]"#;
    assert_eq!(of(Vrm::One, from, to, &[matrix, lacks]), 14);
    let gone = "the avatar has no humanoid, which VRM 1.0 requires";
    assert_eq!(
        of(Vrm::One, "\"humanBones\":", "\"humanBonez\":", &[gone]),
        0
    );
    let gone = "the avatar has no humanoid, which VRM 0.x requires";
    assert_eq!(
        of(Vrm::Zero, "\"humanBones\":[", "\"humanBonez\":[", &[gone]),
        0
    );
}

#[test]
fn broken_expressions_are_left_out_and_told() {
    let binds = |vrm, from: &str, to: &str, told: &[&str]| {
        let scene = assert_told(&avatar(vrm), from, to, told);
        let figure = scene.figure.as_ref().expect("an avatar");
        let happy = figure
            .expression("happy")
            .map(|number| &figure.expressions[number as usize]);
        happy.map(|happy| [happy.morphs.len(), happy.colors.len()])
    };
    let bind = r#"{"node":2,"index":0,"weight":0.5}"#;
    let missing = "expression 'happy' of the avatar binds a morph target that does not exist";
    for broken in [
        r#"{"node":15,"index":0}"#,
        r#"{"node":2,"index":2}"#,
        r#"{"node":1,"index":0}"#,
        r#"{"node":-1,"index":0}"#,
        r#"{"index":0}"#,
        "7",
    ] {
        assert_eq!(
            binds(Vrm::One, bind, broken, &[missing]),
            Some([0, 1]),
            "{broken}"
        );
    }
    let weight =
        "expression 'happy' of the avatar binds a morph target by a weight that is no number";
    for broken in ["\"1\"", "null", "[]", "1e300"] {
        let to = bind.replace("0.5", broken);
        assert_eq!(
            binds(Vrm::One, bind, &to, &[weight]),
            Some([0, 1]),
            "{broken}"
        );
    }
    let missing = "expression 'Joy' of the avatar binds a morph target that does not exist";
    for broken in [
        "\"mesh\":2,\"index\":0",
        "\"mesh\":0,\"index\":0",
        "\"mesh\":1,\"index\":9",
    ] {
        let found = binds(Vrm::Zero, "\"mesh\":1,\"index\":0", broken, &[missing]);
        assert_eq!(found, Some([0, 1]), "{broken}");
    }

    // Colours.
    let color =
        "expression 'happy' of the avatar binds a material that does not exist, or by no colour";
    for broken in ["\"material\":1", "\"material\":\"Face\""] {
        assert_eq!(
            binds(
                Vrm::One,
                "\"material\":0,\"type\"",
                &format!("{broken},\"type\""),
                &[color]
            ),
            Some([1, 0])
        );
    }
    for broken in ["[1,0]", "[1,0,0,\"1\"]", "7", "[1,0,0,1e300]"] {
        assert_eq!(
            binds(Vrm::One, "[1,0,0,1]", broken, &[color]),
            Some([1, 0]),
            "{broken}"
        );
    }
    let other = "expressions change only base colours of the avatar, and no other ones";
    assert_eq!(
        binds(
            Vrm::One,
            "\"type\":\"color\"",
            "\"type\":\"rimColor\"",
            &[other]
        ),
        Some([1, 0])
    );
    assert_eq!(
        binds(Vrm::Zero, "_Color", "_RimColor", &[other]),
        Some([1, 0])
    );

    // Names.
    let unknown = "preset expression 'hppy' of the avatar is none that VRM 1.0 knows";
    assert_eq!(binds(Vrm::One, "\"happy\":", "\"hppy\":", &[unknown]), None);
    let taken = "custom expression 'sad' of the avatar has a name of VRM's own";
    assert_eq!(
        binds(Vrm::One, "\"Wink\":", "\"sad\":", &[taken]),
        Some([1, 1])
    );
    let twice = "expression 'happy' of the avatar is there twice; the first one counts";
    assert_eq!(
        binds(
            Vrm::Zero,
            "\"presetName\":\"a\"",
            "\"presetName\":\"joy\"",
            &[twice]
        ),
        Some([1, 1])
    );
    let nameless = "an expression of the avatar has no name";
    assert_eq!(
        binds(Vrm::Zero, "\"Wink\"", "\"\"", &[nameless]),
        Some([1, 1])
    );
}

#[test]
fn binds_count_towards_the_memory_limit() {
    let (text, bin) = parts(&avatar(Vrm::One));
    let bind = r#"{"node":2,"index":0,"weight":0.5}"#;
    let many = [bind; 20_000].join(",");
    let file = glb(&text.replacen(bind, &many, 1), &bin);
    assert_eq!(load(&file).figure.expect("an avatar").expressions.len(), 4);
    let limits = Limits {
        memory_bytes: 100_000,
        ..Limits::default()
    };
    let fault = load_within(&file, &limits).expect_err("too many");
    assert!(
        fault.is_limit() && fault.to_string().contains("expressions"),
        "{fault}"
    );
}

#[test]
fn both_versions_stand_alike() {
    let posture = br#"{"pose":{"hips":{"position":[0.1,-0.2,0.3],"rotation":[0.1,0.2,0.3,0.9]},
        "leftUpperArm":{"rotation":[0.2,-0.1,-0.6,0.8]},"head":{"rotation":[0,0.4,0,0.9]}}}"#;
    let (posture, _) = Posture::read(posture, &Limits::default()).expect("a posture");
    let motion = load(GESTURE);
    let places = |vrm, time: Option<f32>| {
        let mut scene = load(&avatar(vrm));
        let pose = match time {
            Some(time) => {
                let clips = scene
                    .clips_of(&motion, &Limits::default())
                    .expect("a motion")
                    .clips;
                // Overrides of expressions came with VRM 1.0.
                let mut pose = scene.pose_at(&clips[0], time);
                pose.shares.clear();
                pose
            }
            None => {
                let mut pose = Pose::default();
                scene.bend(&mut pose, &posture);
                pose
            }
        };
        scene.set_pose(&pose).expect("in range");
        let parts = scene.drawn_parts();
        let places = parts.flat_map(|(node, part)| scene.positions_world(node, part));
        places.collect::<Vec<_>>()
    };
    for time in [None, Some(0.0), Some(0.8), Some(1.7)] {
        let [old, new] = [Vrm::Zero, Vrm::One].map(|vrm| places(vrm, time));
        assert_eq!(old.len(), new.len());
        let apart = old
            .as_flattened()
            .iter()
            .zip(new.as_flattened())
            .map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f32::max) < 1e-5, "{time:?}");
    }
}
