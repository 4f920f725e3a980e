//! What moves on its own in figures: of sound files against three-vrm, and of broken ones.

use crate::figures::parts;
use npr_scene::testing::{Eyes, Vrm, glb, puppet};
use npr_scene::{Format, Limits, MemoryResources, Pose, Scene, SceneError, load_bytes};

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
