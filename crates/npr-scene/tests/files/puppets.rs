//! What moves on its own in figures: of sound files against three-vrm, and of broken ones.

use crate::figures::{list, number, parts};
use crate::models::{loaded, models};
use npr_scene::testing::{Vrm, glb, puppet};
use npr_scene::{
    Bone, Eyes, Figure, Format, Limits, MemoryResources, Pose, Posture, Scene, SceneError,
    load_bytes,
};
use serde_json::Value;

/// What `three_puppets.mjs` wrote.
const OF_THREE: &str = include_str!("../data/three_puppets.json");

/// The puppet that it moved.
const PUPPET: &[u8] = include_bytes!("../data/puppet.vrm");

/// Most that a number of a turn may differ, and a share.
const MOST: f64 = 2e-4;

fn load_within(bytes: &[u8], limits: &Limits) -> Result<Scene, SceneError> {
    let resources = MemoryResources::default();
    let scene = load_bytes("test", bytes, Some(Format::Glb), &resources, limits)?;
    scene.sanity_check();
    Ok(scene)
}

fn load(bytes: &[u8]) -> Scene {
    load_within(bytes, &Limits::default()).expect("a file that can be drawn")
}

/// A puppet of VRM 1.0 with some of its text replaced, and what is said of it.
#[track_caller]
fn mended(vrm: Vrm, from: &str, to: &str) -> (Scene, Vec<String>) {
    let (text, bin) = parts(&puppet(vrm, Eyes::Bones));
    assert!(text.contains(from), "{from}");
    let scene = load(&glb(&text.replacen(from, to, 1), &bin));
    let told = scene.notices.iter().map(|notice| notice.text.clone());
    let told = told.filter(|text| !text.contains("spring"));
    (scene.clone(), told.collect())
}

fn of_three() -> Value {
    serde_json::from_str(OF_THREE).expect("JSON")
}

/// The node of a name.
fn node_of(scene: &Scene, name: &str) -> u32 {
    let place = scene.nodes.iter().position(|node| node.name == name);
    place.expect("a node") as u32
}

/// Asserts that a node is turned beside its parent as three-vrm has it; a turn and its negative are the same.
#[track_caller]
fn assert_turn(scene: &Scene, node: u32, wanted: &Value, what: &str) {
    let columns = scene.nodes[node as usize].local;
    let [x, y, z, w] = <[f64; 4]>::try_from(list(wanted).iter().map(number).collect::<Vec<_>>())
        .expect("a quaternion");
    let wanted = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + z * w),
            2.0 * (x * z - y * w),
        ],
        [
            2.0 * (x * y - z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + x * w),
        ],
    ];
    for (column, wanted) in columns.iter().zip(wanted) {
        for (found, wanted) in column.iter().zip(wanted) {
            let apart = (f64::from(*found) - wanted).abs();
            assert!(apart < MOST, "{what}, node {node}: {apart}");
        }
    }
}

#[test]
fn the_puppet_that_three_vrm_moved_is_the_one_of_tests() {
    assert!(PUPPET == puppet(Vrm::One, Eyes::Bones));
}

/// Only what no model of others has to be there for.
#[test]
fn constraints_turn_nodes_as_three_vrm_does() {
    let (of_three, rest) = (of_three(), load(PUPPET));
    let mut count = 0;
    for moment in list(&of_three["follows"]) {
        let mut pose = Pose::default();
        for (name, turn) in moment["turns"].as_object().expect("turns") {
            let node = node_of(&rest, name);
            let mut stand = rest.nodes[node as usize].rest.expect("a rest");
            let turn: Vec<f32> = list(turn).iter().map(|v| number(v) as f32).collect();
            stand.rotation = turn.try_into().expect("a quaternion");
            pose.transforms.insert(node, stand);
        }
        let mut posed = rest.clone();
        posed.set_pose(&pose).expect("in range");
        for told in list(&moment["told"]) {
            let node = node_of(&rest, told["node"].as_str().expect("a name"));
            assert_turn(&posed, node, &told["turn"], "constraints");
            count += 1;
        }
    }
    assert_eq!(count, 2 * 4);
}

#[test]
fn eyes_look_as_those_of_three_vrm_do() {
    let Some(folder) = models() else { return };
    let (of_three, mut counts) = (of_three(), [0, 0]);
    for model in list(&of_three["looks"]) {
        // Take its curves out, as the script does.
        let name = model["name"].as_str().expect("a name");
        let mut rest = match name {
            "puppet.vrm" => load(PUPPET),
            _ => loaded(&folder, name),
        };
        let figure = rest.figure.as_mut().expect("an avatar");
        let look = figure.look_at.as_mut().expect("looks");
        for map in [
            &mut look.inner,
            &mut look.outer,
            &mut look.down,
            &mut look.up,
        ] {
            map.curve.clear();
        }
        let figure = rest.figure.clone().expect("an avatar");

        // Look at each point.
        for moment in list(&model["moments"]) {
            let target: Vec<f32> = list(&moment["target"])
                .iter()
                .map(|v| number(v) as f32)
                .collect();
            let mut pose = Pose {
                look_at: Some(target.try_into().expect("a point")),
                ..Pose::default()
            };
            if moment["bent"] == true {
                let head = figure.bones[&Bone::HEAD];
                let mut stand = rest.nodes[head as usize].rest.expect("a rest");
                assert_eq!(stand.rotation, [0.0, 0.0, 0.0, 1.0]);
                stand.rotation = [0.1, -0.2, 0.05, 0.9];
                pose.transforms.insert(head, stand);
            }
            let mut posed = rest.clone();
            posed.set_pose(&pose).expect("in range");
            let what = format!("{name} looks at {target:?}", target = moment["target"]);
            for (bone, turn) in [Bone::LEFT_EYE, Bone::RIGHT_EYE]
                .iter()
                .zip(list(&moment["turns"]))
            {
                if !turn.is_null() {
                    assert_turn(&posed, figure.bones[bone], turn, &what);
                    counts[0] += 1;
                }
            }

            // Shares show as weights of the morphs that they bind.
            for (number_of, share) in figure.looks().into_iter().zip(list(&moment["shares"])) {
                let face = number_of.map(|number| &figure.expressions[number as usize]);
                let Some(bind) = face.and_then(|face| face.morphs.first()) else {
                    continue;
                };
                let mesh = posed.nodes[bind.node as usize].mesh.expect("a mesh");
                let morph = &posed.meshes[mesh as usize].parts[0].morphs[bind.morph as usize];
                let wanted = number(share).clamp(0.0, 1.0) * f64::from(bind.weight);
                let apart = (f64::from(morph.applied_weight) - wanted).abs();
                assert!(apart < MOST, "{what}: {apart}");
                counts[1] += 1;
            }
        }
    }
    assert_eq!(counts, [2 * 2 * 12, 3 * 4 * 12]);
}

/// Both versions of VRM, and both kinds of eyes.
#[test]
fn both_versions_look_and_follow_alike() {
    let posture = br#"{"pose":{"head":{"rotation":[0.1,0.3,0,0.9]},"leftUpperArm":{"rotation":[0.2,-0.1,-0.6,0.8]},
        "leftLowerArm":{"rotation":[0.5,0.4,0,0.7]},"leftHand":{"rotation":[0.6,0.2,0.1,0.7]}}}"#;
    let (posture, _) = Posture::read(posture, &Limits::default()).expect("a posture");
    for eyes in [Eyes::Bones, Eyes::Expressions] {
        let places = |vrm, look_at| {
            let mut scene = load(&puppet(vrm, eyes));
            assert!(scene.figure.as_ref().is_some_and(Figure::can_look));
            let mut pose = Pose {
                look_at,
                ..Pose::default()
            };
            scene.bend(&mut pose, &posture);
            scene.set_pose(&pose).expect("in range");
            let parts = scene.drawn_parts();
            let places = parts.flat_map(|(node, part)| scene.positions_world(node, part));
            places.collect::<Vec<_>>()
        };
        let mut seen = Vec::new();
        for look_at in [None, Some([1.0, 2.0, 3.0]), Some([-2.0, 0.5, 1.0])] {
            let [old, new] = [Vrm::Zero, Vrm::One].map(|vrm| places(vrm, look_at));
            assert_eq!(old.len(), new.len());
            let pairs = old.as_flattened().iter().zip(new.as_flattened());
            let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(apart < 1e-5, "{look_at:?}: {apart}");
            assert!(!seen.contains(&new));
            seen.push(new);
        }
    }
}

#[test]
fn broken_looks_count_as_the_usual_ones_and_are_told() {
    let usual = "is no number that can be used; the usual one counts";
    let of = |vrm, from: &str, to: &str, what: &str| {
        let (scene, said) = mended(vrm, from, to);
        assert_eq!(said, [format!("{what} of the avatar {usual}")], "{to}");
        let figure = scene.figure.expect("an avatar");
        assert!(figure.can_look());
        figure.look_at.expect("looks")
    };
    let most = r#""inputMaxValue":80"#;
    for value in ["\"80\"", "null", "[80]", "1e300"] {
        let to = most.replace("80", value);
        let look = of(Vrm::One, most, &to, "'inputMaxValue' of how it looks");
        assert_eq!((look.inner.most_deg, look.inner.output), (90.0, 8.0));
    }
    let offset = r#""offsetFromHeadBone":[0.0,0.05,0.08]"#;
    for value in ["[0.0,0.05]", "7", "[0.0,0.05,\"0\"]", "[1e300,0,0]"] {
        let to = format!(r#""offsetFromHeadBone":{value}"#);
        let look = of(Vrm::One, offset, &to, "the offset of looks from the head");
        assert_eq!(look.offset, [0.0, 0.06, 0.0]);
    }
    let curve = r#""curve":[0,0,0,1,1,1,1,0],"xRange":80"#;
    for value in [
        "[0,0,0]",
        "[1,0,0,1,1,1,1,0]",
        "[0,0,0,null,1,1,1,0]",
        "[0,0,0,1e300,1,1,1,0]",
    ] {
        let to = format!(r#""curve":{value},"xRange":80"#);
        let look = of(Vrm::Zero, curve, &to, "a curve of how it looks");
        assert_eq!(look.inner.curve.len(), 0);
    }
    let offset = r#""z":0.08}"#;
    let look = of(
        Vrm::Zero,
        offset,
        r#""z":"0"}"#,
        "the offset of looks from the head",
    );
    assert_eq!(look.offset, [0.0, 0.06, 0.0]);

    // What is not said at all is nothing to tell of.
    let (scene, said) = mended(Vrm::One, "\"lookAt\"", "\"lookBy\"");
    assert_eq!(said, [""; 0]);
    assert!(!scene.figure.expect("an avatar").can_look());
    let (scene, said) = mended(Vrm::One, "\"inputMaxValue\":80", "\"inputMaxValue\":-3");
    assert_eq!(said, [""; 0]);
    let look = scene.figure.and_then(|figure| figure.look_at);
    assert!(look.is_some_and(|look| look.inner.most_deg > 0.0));
}

#[test]
fn sound_puppets_are_told_nothing_of() {
    for vrm in [Vrm::Zero, Vrm::One] {
        let (scene, told) = mended(vrm, "mesh", "mesh");
        assert_eq!(told, [""; 0], "{vrm:?}");
        assert_eq!(scene.constraints.len(), 4);
    }
}

#[test]
fn broken_constraints_are_left_out_and_told() {
    let of = |from: &str, to: &str, told: &str| {
        let (scene, said) = mended(Vrm::One, from, to);
        assert_eq!(said, [told], "{to}");
        let mut posed = scene.clone();
        posed.set_pose(&Pose::default()).expect("in range");
        scene.constraints.len()
    };
    let told =
        |node: &str, fault: &str| format!("the constraint of node '{node}' is ignored: {fault}");
    let roll = r#""roll":{"source":11,"rollAxis":"X","weight":0.6}"#;
    for source in ["30", "-1", "1.5", "\"11\"", "null", "[11]", "1e300"] {
        let to = roll.replace("11", source);
        let fault = "it names no node of the 30 in the file";
        assert_eq!(of(roll, &to, &told("twist", fault)), 3);
    }
    for axis in ["\"x\"", "\"PositiveX\"", "1", "null"] {
        let to = roll.replace("\"X\"", axis);
        assert_eq!(of(roll, &to, &told("twist", "it names no axis")), 3);
    }
    for weight in ["\"1\"", "null", "1.01", "-0.5", "1e300"] {
        let to = roll.replace("0.6", weight);
        let fault = "its weight is no number from 0 to 1";
        assert_eq!(of(roll, &to, &told("twist", fault)), 3);
    }
    let none = told("twist", "it is none of roll, aim and rotation");
    assert_eq!(of(roll, "\"rool\":{}", &none), 3);
    assert_eq!(
        of(
            "\"PositiveX\"",
            "\"X\"",
            &told("sleeve", "it names no axis")
        ),
        3
    );
    let itself = told("twist", "it follows itself");
    assert_eq!(of("\"source\":11", "\"source\":24", &itself), 3);
    let circle = "the constraints of 2 nodes, 'echo' among them, are ignored: they follow each other in circles";
    assert_eq!(of("\"source\":9", "\"source\":26", circle), 2);

    // A node that is placed by a matrix, and one that is not in the scene.
    let (text, _) = parts(&puppet(Vrm::One, Eyes::Bones));
    let start = text.find(r#""name":"twist""#).expect("the node");
    let end = start + text[start..].find(r#","mesh""#).expect("its mesh");
    let matrix = r#""name":"twist","matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,1,0,1]"#;
    let fault = told("twist", "the node has a matrix and is not posed");
    assert_eq!(of(&text[start..end], matrix, &fault), 3);
}

#[test]
fn constraints_count_towards_the_memory_limit() {
    let (text, bin) = parts(&puppet(Vrm::One, Eyes::Bones));
    let node =
        r#"{"extensions":{"VRMC_node_constraint":{"constraint":{"rotation":{"source":0}}}}}"#;
    let many = format!("{},\n{{\"name\":\"hips\"", [node; 20_000].join(","));
    let from = "{\"name\":\"hips\"";
    assert!(text.contains(from));
    let text = text
        .replacen(from, &many, 1)
        .replacen("\"scenes\":[{\"nodes\":[0]}],", "", 1);
    let file = glb(&text, &bin);
    assert!(load(&file).constraints.len() >= 19_999);
    let limits = Limits {
        memory_bytes: 400_000,
        ..Limits::default()
    };
    let fault = load_within(&file, &limits).expect_err("too many");
    assert!(
        fault.is_limit() && fault.to_string().contains("constraints"),
        "{fault}"
    );
}
