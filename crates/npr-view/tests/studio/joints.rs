//! The joints of a figure: they are folded in, searched for, turned, undone and saved.

use super::timeline::{last, opened, stage};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use npr_view::{Cast, Host, Pose};

fn figure() -> Cast {
    Cast {
        bones: vec!["head".to_owned(), "leftUpperArm".to_owned()],
        ..Cast::default()
    }
}

#[test]
fn joints_are_folded_in_and_found_by_name() {
    let (mut harness, _) = stage([1000.0, 700.0], Pose::default(), figure());
    harness.run_steps(8);
    assert!(harness.query_by_label("joint head x").is_none());
    harness.get_by_label("Figure").click();
    harness.run_steps(8);
    assert!(harness.query_by_label("joint head x").is_none());
    harness.get_by_label("Joints").click();
    harness.run_steps(8);
    for axis in ["x", "y", "z"] {
        for bone in ["head", "leftUpperArm"] {
            let name = format!("joint {bone} {axis}");
            assert!(harness.query_by_label(&name).is_some(), "{name}");
        }
    }
    harness.state_mut().search("upper arm");
    harness.run_steps(8);
    assert!(harness.query_by_label("joint leftUpperArm z").is_some());
    assert!(harness.query_by_label("joint head z").is_none());
}

#[test]
fn a_joint_is_turned_by_keys_undone_and_lies_in_a_file_where_a_command_needs_it() {
    let asked = Pose {
        bones: Some("bow.json".to_owned()),
        ..Pose::default()
    };
    let (mut harness, easel) = stage([1000.0, 700.0], asked, figure());
    harness.state_mut().search("joint");
    harness.run_steps(8);
    let disabled = |label: &str, harness: &egui_kittest::Harness<'static, super::Studio>| {
        harness.get_by_label(label).accesskit_node().is_disabled()
    };
    assert!(disabled("Save pose", &harness));

    // Turn it by keys.
    harness.get_by_label("joint head y").focus();
    harness.run_steps(2);
    for _ in 0..3 {
        harness.key_press(Key::ArrowUp);
        harness.run_steps(2);
    }
    harness.run_steps(8);
    let turns = last(&easel).pose.turns;
    assert_eq!(turns, [("head".to_owned(), [0.0, 3.0, 0.0])]);
    assert!(!last(&easel).is_draft);

    // A command names a file of it, which is written once.
    for _ in 0..2 {
        harness.get_by_label("Copy command").click();
        harness.run_steps(3);
        let poses = easel.0.borrow().poses.clone();
        assert_eq!(poses.len(), 1);
        assert_eq!(poses[0].turn("head"), Some([0.0, 3.0, 0.0]));
        assert_eq!(poses[0].bones.as_deref(), Some("bow.json"));
        let told = harness.state().told().unwrap_or_default();
        assert!(told.contains("clipboard"), "{told}");
    }
    harness.get_by_label("Save pose").click();
    harness.run_steps(3);
    assert_eq!(harness.state().told(), Some("'pose2.json' holds the pose"));

    // Take it back.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(6);
    assert!(last(&easel).pose.turns.is_empty());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    harness.run_steps(6);
    assert_eq!(last(&easel).pose.turns, turns);
    harness.get_by_label("reset joint head").click();
    harness.run_steps(6);
    assert!(last(&easel).pose.turns.is_empty());
    let said = easel.command(&last(&easel));
    assert!(said.ends_with("--pose=bow.json"), "{said}");

    // Another scene has another figure.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    easel.0.borrow_mut().news = vec![opened("b.vrm", Cast::default())];
    harness.run_steps(6);
    assert!(last(&easel).pose.turns.is_empty());
    assert!(harness.query_by_label("joint head y").is_none());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    harness.run_steps(6);
    assert!(last(&easel).pose.turns.is_empty());
}
