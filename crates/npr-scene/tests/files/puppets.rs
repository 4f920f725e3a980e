//! What moves on its own in figures: of sound files against three-vrm, and of broken ones.

use crate::figures::{list, number, parts};
use crate::models::{loaded, models};
use npr_scene::testing::{Vrm, glb, puppet};
use npr_scene::{
    Bone, Eyes, Figure, Format, Limits, MemoryResources, Pose, Posture, Scene, SceneError, Springs,
    Swinging, load_bytes,
};
use serde_json::Value;

/// What `three_puppets.mjs` wrote.
const OF_THREE: &str = include_str!("../data/three_puppets.json");

/// The motion that it played.
const GESTURE: &[u8] = include_bytes!("../data/gesture.vrma");

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

/// Most that the end of a spring may lie from where three-vrm has it, in units of the world: a figure is 1 to 2 high.
const APART: f64 = 5e-4;

#[test]
fn springs_swing_as_those_of_three_vrm_do() {
    let Some(folder) = models() else { return };
    let (of_three, motion) = (of_three(), load(GESTURE));
    let mut counts = [0, 0];
    for model in list(&of_three["swings"]) {
        let name = model["name"].as_str().expect("a name");
        let rest = match name {
            "puppet.vrm" => load(PUPPET),
            _ => loaded(&folder, name),
        };
        let clips = rest
            .clips_of(&motion, &Limits::default())
            .expect("a motion")
            .clips;
        let mut swinging = Swinging::default();
        for moment in list(&model["moments"]) {
            let time = (number(&moment["step"]) / 60.0) as f32;
            let mut pose = rest.pose_at(&clips[0], time);
            let stiff = pose.clone();
            pose.swings = swinging.at(&rest, time, |time| rest.pose_at(&clips[0], time));
            let [stood, stiff] = [&pose, &stiff].map(|pose| {
                let mut posed = rest.clone();
                posed.set_pose(pose).expect("in range");
                posed
            });
            for told in list(&moment["places"]) {
                let node = node_of(&rest, told[0].as_str().expect("a name")) as usize;
                let wanted = [1, 2, 3].map(|i| number(&told[i]));
                let apart = |scene: &Scene| {
                    let [x, y, z, _] = scene.nodes[node].world_from_node[3].map(f64::from);
                    let [a, b, c] = wanted;
                    ((x - a) * (x - a) + (y - b) * (y - b) + (z - c) * (z - c)).sqrt()
                };
                let what = format!("{name}, {} at {time} s", told[0]);
                assert!(apart(&stood) < APART, "{what}: {}", apart(&stood));
                counts[0] += 1;
                counts[1] += i32::from(apart(&stiff) > 4.0 * APART);
            }
        }
    }
    // Most ends would lie far off if they did not swing.
    assert_eq!(counts[0], 8 * 14);
    assert!(counts[1] > 60, "{counts:?}");
}

#[test]
fn both_versions_swing_alike() {
    let motion = load(GESTURE);
    let places = |vrm, time: f32| {
        let mut scene = load(&puppet(vrm, Eyes::Bones));
        let clips = scene
            .clips_of(&motion, &Limits::default())
            .expect("a motion")
            .clips;
        let mut pose = scene.pose_at(&clips[0], time);
        pose.shares.clear();
        pose.swings = Swinging::default().at(&scene, time, |time| scene.pose_at(&clips[0], time));
        // The tail swings in VRM 1.0 alone.
        pose.swings.remove(&node_of(&scene, "tail 1"));
        scene.set_pose(&pose).expect("in range");
        let parts = scene.drawn_parts();
        let places = parts.flat_map(|(node, part)| scene.positions_world(node, part));
        places.collect::<Vec<_>>()
    };
    for time in [0.0, 0.3, 1.0, 1.9] {
        let [old, new] = [Vrm::Zero, Vrm::One].map(|vrm| places(vrm, time));
        assert_eq!(old.len(), new.len());
        let pairs = old.as_flattened().iter().zip(new.as_flattened());
        let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(apart < 1e-4, "{time}: {apart}");
    }
}

#[test]
fn broken_springs_are_left_out_and_told() {
    // How many joints and colliders are left, and how many of these the hair minds.
    let of = |vrm, from: &str, to: &str, told: &str| {
        let (scene, said) = mended(vrm, from, to);
        assert_eq!(said, [told], "{to}");
        let springs = scene.springs.expect("springs");
        [
            springs.joints.len(),
            springs.colliders.len(),
            springs.chains[0].colliders.len(),
        ]
    };
    let ignored = |what: &str, fault: &str| format!("{what} of the avatar is ignored: {fault}");
    let (scene, said) = mended(Vrm::One, "mesh", "mesh");
    assert_eq!(
        (
            said.len(),
            scene.springs.map(|springs| springs.joints.len())
        ),
        (0, Some(6))
    );
    let (scene, said) = mended(Vrm::Zero, "mesh", "mesh");
    assert_eq!(
        (
            said.len(),
            scene.springs.map(|springs| springs.joints.len())
        ),
        (0, Some(5))
    );

    // Numbers of joints.
    let joint = r#""hitRadius":0.02,"stiffness":0.8,"gravityPower":0.4"#;
    let first = "joint 0 of spring 'hair'";
    for (key, name, fault) in [
        ("0.02", "hitRadius", "no number from 0"),
        ("0.8", "stiffness", "no number from 0"),
        ("0.4", "gravityPower", "no number"),
    ] {
        for value in ["\"1\"", "null", "[]", "1e300", "-1"] {
            if (name, value) == ("gravityPower", "-1") {
                continue;
            }
            let to = joint.replace(key, value);
            let told = ignored(first, &format!("its {name} is {fault}"));
            assert_eq!(of(Vrm::One, joint, &to, &told), [5, 4, 2]);
        }
    }
    for value in ["1.01", "-0.1", "null"] {
        let told = ignored(first, "its dragForce is no number from 0 to 1");
        let to = format!("\"dragForce\":{value}");
        assert_eq!(of(Vrm::One, "\"dragForce\":0.3", &to, &told), [5, 4, 2]);
    }
    let told = ignored(first, "its gravityDir is no list of three numbers");
    assert_eq!(
        of(Vrm::One, "\"gravityDir\":[0.2,", "\"gravityDir\":[", &told),
        [5, 4, 2]
    );

    // Nodes of joints: 17, 18, 19 and 28 are the hair, 20 and 21 the skirt.
    let none = "it names no node of the 30 in the file";
    for node in ["30", "-1", "1.5", "null", "\"17\""] {
        let told = ignored(first, none);
        assert_eq!(
            of(
                Vrm::One,
                "\"node\":17}",
                &format!("\"node\":{node}}}"),
                &told
            ),
            [5, 4, 2]
        );
    }
    let twice = ignored(
        "joint 0 of spring 'skirt'",
        "its node is of another spring already",
    );
    let away = ignored(
        "joint 1 of spring 'hair'",
        "the joint behind it does not hang on it",
    );
    let (scene, said) = mended(Vrm::One, "\"node\":19}", "\"node\":20}");
    // 18 to 20 is no way down; 20 to 28 neither.
    let further = ignored(
        "joint 2 of spring 'hair'",
        "the joint behind it does not hang on it",
    );
    assert_eq!(said, [away, further]);
    assert_eq!(scene.springs.expect("springs").joints.len(), 4);
    let (scene, said) = mended(
        Vrm::One,
        "\"node\":28}]",
        "\"node\":28},{\"node\":20},{\"node\":21}]",
    );
    let beyond = ignored(
        "joint 3 of spring 'hair'",
        "the joint behind it does not hang on it",
    );
    assert_eq!(said, [beyond, twice]);
    assert_eq!(scene.springs.expect("springs").joints.len(), 6);

    // A circle of joints is no way down either.
    let (scene, said) = mended(Vrm::One, "\"node\":28}]", "\"node\":17}]");
    let told = ignored(
        "joint 2 of spring 'hair'",
        "the joint behind it does not hang on it",
    );
    assert_eq!(said, [told]);
    assert_eq!(scene.springs.expect("springs").joints.len(), 5);

    // Skipping a node is fine.
    let (scene, said) = mended(Vrm::One, "\"node\":19}", "\"node\":28}");
    assert_eq!(
        said,
        [ignored(
            "joint 2 of spring 'hair'",
            "the joint behind it does not hang on it"
        )]
    );
    let springs = scene.springs.expect("springs");
    let end = springs
        .joints
        .iter()
        .find(|joint| joint.node == node_of_hair(&springs, 1))
        .expect("a joint")
        .end;
    assert!((end[1] + 0.14 + 0.07).abs() < 1e-5, "{end:?}");

    // Colliders and their groups.
    let sphere = r#""sphere":{"offset":[0.0,0.05,0.0],"radius":0.11}"#;
    let of_sphere = |to: &str, fault: &str| {
        let told = ignored("collider 0 of the springs", fault);
        assert_eq!(of(Vrm::One, sphere, to, &told), [6, 3, 1]);
    };
    for radius in ["-0.1", "null", "1e300", "\"1\""] {
        of_sphere(
            &sphere.replace("0.11", radius),
            "its radius is no number from 0",
        );
    }
    of_sphere(
        &sphere.replace("[0.0,", "["),
        "its offset is no list of three numbers",
    );
    of_sphere("\"plane\":{}", "it is neither a sphere nor a capsule");
    let told = ignored("collider 0 of the springs", none);
    assert_eq!(
        of(
            Vrm::One,
            "{\"node\":2,\"shape\"",
            "{\"node\":99,\"shape\"",
            &told
        ),
        [6, 3, 1]
    );
    let told = ignored(
        "a collider of group 0 of the springs",
        "there is no such collider",
    );
    assert_eq!(
        of(
            Vrm::One,
            "\"colliders\":[0,1]",
            "\"colliders\":[0,7]",
            &told
        ),
        [6, 4, 1]
    );
    let told = ignored(
        "a collider group of spring 'hair'",
        "there is no such group",
    );
    assert_eq!(
        of(
            Vrm::One,
            "\"colliderGroups\":[0]",
            "\"colliderGroups\":[9]",
            &told
        ),
        [6, 4, 0]
    );
    let told = ignored("the center of spring 'tail'", none);
    assert_eq!(
        of(Vrm::One, "\"center\":0", "\"center\":-1", &told),
        [6, 4, 2]
    );

    // VRM 0.x.
    let told = ignored("bone 0 of spring 0", "its stiffiness is no number from 0");
    assert_eq!(
        of(
            Vrm::Zero,
            "\"stiffiness\":0.8",
            "\"stiffiness\":null",
            &told
        ),
        [2, 3, 2]
    );
    let told = ignored(
        "bone 0 of spring 0",
        "it names no node of the 28 in the file",
    );
    assert_eq!(
        of(Vrm::Zero, "\"bones\":[17]", "\"bones\":[77]", &told),
        [2, 3, 2]
    );
    let told = ignored(
        "bone 1 of spring 0",
        "some of its bones are of another spring already",
    );
    assert_eq!(
        of(Vrm::Zero, "\"bones\":[17]", "\"bones\":[17,18]", &told),
        [5, 3, 2]
    );
    let told = ignored(
        "collider 0 of group 0 of the springs",
        "its radius is no number from 0",
    );
    assert_eq!(
        of(Vrm::Zero, "\"radius\":0.11", "\"radius\":-1", &told),
        [5, 2, 1]
    );
    let told = ignored(
        "collider 0 of group 0 of the springs",
        "it names no node of the 28 in the file",
    );
    assert_eq!(
        of(
            Vrm::Zero,
            "{\"node\":2,\"colliders\"",
            "{\"node\":-2,\"colliders\"",
            &told
        ),
        [5, 2, 1]
    );
}

/// The node of a joint of the hair.
fn node_of_hair(springs: &Springs, place: usize) -> u32 {
    let hair = springs.joints.iter().filter(|joint| joint.chain == 0);
    hair.map(|joint| joint.node).nth(place).expect("hair")
}

#[test]
fn springs_count_towards_the_memory_limit_and_have_a_limit_of_their_own() {
    let (text, bin) = parts(&puppet(Vrm::One, Eyes::Bones));
    let from = "\"colliders\":[0,1]";
    let many = format!("\"colliders\":[{}0]", "0,".repeat(400_000));
    let file = glb(&text.replacen(from, &many, 1), &bin);
    let scene = load(&file);
    assert!(scene.springs.is_none());
    let told = "the springs of the avatar are ignored: 1200006 pairs of joints and colliders are more than 1000000";
    assert!(
        scene.notices.iter().any(|notice| notice.text == told),
        "{:?}",
        scene.notices
    );
    let limits = Limits {
        memory_bytes: 1_000_000,
        ..Limits::default()
    };
    let fault = load_within(&file, &limits).expect_err("too many");
    assert!(
        fault.is_limit() && fault.to_string().contains("springs"),
        "{fault}"
    );
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
