//! `npr info`.

use crate::workplace::Workplace;
use npr_scene::testing::{Sheet, glb, lines_glb, skinned_glb};

#[test]
fn every_format_is_told_with_its_counts() {
    let place = Workplace::new();
    let sheet = Sheet::new(3);
    place.put("sheet.glb", &sheet.glb());
    place.put("sheet.obj", &sheet.obj());
    place.put("sheet.stl", &sheet.stl());
    place.put("sheet.ply", &sheet.ply());
    for (name, format) in [
        ("sheet.glb", "binary glTF"),
        ("sheet.obj", "OBJ"),
        ("sheet.stl", "STL"),
        ("sheet.ply", "PLY"),
    ] {
        let outcome = place.npr(&["info", name, "--json"]);
        outcome.assert_silent_success();
        let info: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
        assert_eq!(
            (info["format"].as_str(), info["file"].as_str()),
            (Some(format), Some(name))
        );
        assert_eq!(info["triangle_count"], 18, "{name}");
        assert_eq!(info["bounds"]["max"][0], 3.0, "{name}");
        let text = place.npr(&["info", name]);
        text.assert_silent_success();
        assert!(
            text.text().contains("draws 18 triangles"),
            "{}",
            text.text()
        );
    }
}

#[test]
fn skins_and_what_is_ignored_are_told() {
    let place = Workplace::new();
    place.put("bent.glb", &skinned_glb());
    let outcome = place.npr(&["info", "bent.glb", "--json"]);
    let info: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
    assert_eq!(info["skins"][0]["joint_count"], 2);
    assert!(info["ignored"].is_array());
}

#[test]
fn lines_of_files_are_counted() {
    let place = Workplace::new();
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    place.put("ring.glb", &lines_glb(&positions, &[], &[(2, &[0, 1, 2])]));
    let info: serde_json::Value =
        serde_json::from_str(place.npr(&["info", "ring.glb", "--json"]).text()).expect("JSON");
    assert_eq!(
        (&info["triangle_count"], &info["line_segment_count"]),
        (&0.into(), &3.into())
    );
    assert_eq!(info["drawn"][0]["line_segment_count"], 3);
    assert_eq!(info["bounds"]["max"][0], 1.0);
    let text = place.npr(&["info", "ring.glb"]);
    text.assert_silent_success();
    assert!(
        text.text().contains("draws 3 line segments"),
        "{}",
        text.text()
    );
}

#[test]
fn names_are_data() {
    let names = [
        "--><script>alert(1)</script>",
        "a\u{1b}[2J\n\u{202e}b",
        "]]>\"'%!../x",
        &"x".repeat(100_000),
    ];
    let place = Workplace::new();
    for name in names {
        place.put("named.glb", &named_glb(name));
        let json = place.npr(&["info", "named.glb", "--json"]);
        json.assert_silent_success();
        let info: serde_json::Value = serde_json::from_str(json.text()).expect("JSON");
        assert_eq!(info["drawn"][0]["object"], name);

        let text = place.npr(&["info", "named.glb"]);
        text.assert_silent_success();
        let plain =
            |c: char| c == '\n' || !(c.is_control() || ('\u{202a}'..='\u{202e}').contains(&c));
        assert!(text.text().chars().all(plain));
        assert!(text.text().lines().all(|line| line.chars().count() < 400));
        place.render("named.glb", &[]).assert_silent_success();
    }
}

#[test]
fn a_broken_file_is_told_as_by_render() {
    let place = Workplace::new();
    place.put("cut.glb", &Sheet::new(2).glb()[..100]);
    let render = place.render("cut.glb", &[]);
    let info = place.npr(&["info", "cut.glb"]);
    info.assert_fault(3, "cannot read 'cut.glb': ");
    assert_eq!(info.stderr, render.stderr);
}

/// A triangle whose node has a name.
pub fn named_glb(name: &str) -> Vec<u8> {
    let name = serde_json::to_string(name).expect("JSON");
    let corners: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"name":{name},"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36}}]}}"#
    );
    glb(&json, &corners.map(f32::to_le_bytes).concat())
}
