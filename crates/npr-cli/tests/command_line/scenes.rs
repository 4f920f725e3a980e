//! Degenerate scenes and views: a picture or a clear refusal.

use crate::workplace::Workplace;
use npr_scene::testing::{Sheet, glb};

/// Scenes without anything to see give the background.
const EMPTY: [(&str, &str); 3] = [
    (
        "no meshes",
        r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"name":"alone"}]}"#,
    ),
    ("no nodes", r#"{"asset":{"version":"2.0"},"scenes":[{}]}"#),
    ("no scene", r#"{"asset":{"version":"2.0"}}"#),
];

#[test]
fn an_empty_scene_gives_an_empty_picture() {
    let place = Workplace::new();
    for (case, json) in EMPTY {
        place.put("empty.glb", &glb(json, &[]));
        let outcome = place.render("empty.glb", &[]);
        assert_eq!(outcome.code, Some(0), "{case}: {}", outcome.stderr);
        assert!(place.get("empty.png").starts_with(b"\x89PNG"));
    }
    place.put("points.obj", b"v 0 0 0\nv 1 0 0\n");
    assert_eq!(place.render("points.obj", &[]).code, Some(0));
}

#[test]
fn degenerate_triangles_are_drawn_or_refused() {
    let cases = [
        (
            "no area",
            "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 2 2 2\n",
            0,
        ),
        ("one point", "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n", 0),
        ("huge", "v 0 0 0\nv 1e17 0 0\nv 0 1e17 0\nf 1 2 3\n", 0),
        ("tiny", "v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n", 0),
        (
            "far away",
            "v 1e9 0 0\nv 1000000064 0 0\nv 1e9 64 0\nf 1 2 3\n",
            0,
        ),
        (
            "all NaN",
            "v nan nan nan\nv nan nan nan\nv nan nan nan\nf 1 2 3\n",
            3,
        ),
        (
            "all infinite",
            "v inf 0 0\nv 1e99 0 0\nv 0 -inf 0\nf 1 2 3\n",
            3,
        ),
        (
            "index out of range",
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
            3,
        ),
        (
            "two faces on one edge three times",
            "v 0 0 0\nv 0 1 0\nv 1 0 0\nv -1 0 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n",
            0,
        ),
    ];
    let place = Workplace::new();
    for (case, text, code) in cases {
        place.put("scene.obj", text.as_bytes());
        for style in [
            "toon",
            "ink",
            "technical",
            "okuya",
            "filter",
            "hull",
            "filter-hull",
        ] {
            let outcome = place.render("scene.obj", &["--style", style, "-o", "out.png"]);
            assert_eq!(
                outcome.code,
                Some(code),
                "{case} in {style}: {}",
                outcome.stderr
            );
            let was_drawn = std::fs::remove_file(place.path("out.png")).is_ok();
            assert_eq!(was_drawn, code == 0, "{case} in {style}");
        }
    }
}

#[test]
fn one_broken_position_spoils_only_its_triangles() {
    let place = Workplace::new();
    let mut sheet = Sheet::new(2);
    sheet.positions[4] = [f32::NAN, 0.0, f32::INFINITY];
    place.put("sheet.stl", &sheet.stl());
    let outcome = place.render("sheet.stl", &[]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert!(
        outcome.stderr.starts_with("npr: warning: "),
        "{}",
        outcome.stderr
    );
}

#[test]
fn any_eye_gives_a_picture() {
    let place = Workplace::new();
    place.put("sheet.glb", &Sheet::new(4).glb());
    let views: [&[&str]; 8] = [
        &["--eye", "2,1.02,2"],
        &["--eye", "2,9,2", "--target", "2,99,2"],
        &["--eye", "2,9,2", "--target", "2,0,2", "--up", "0,1,0"],
        &["--eye", "0,1,0", "--target", "4,1,4"],
        &["--eye", "1e30,0,0"],
        &["--eye", "1e-30,0,0", "--target", "0,0,0"],
        &["--eye", "-3,-4,-5", "--fov", "179"],
        &["--fov", "0.1"],
    ];
    for view in views {
        for style in ["toon", "okuya", "hull"] {
            let outcome = place.render("sheet.glb", &[view, &["--style", style]].concat());
            assert_eq!(outcome.code, Some(0), "{view:?}: {}", outcome.stderr);
        }
    }
}

#[test]
fn any_size_gives_a_picture() {
    let place = Workplace::new();
    place.put("sheet.glb", &Sheet::new(4).glb());
    for size in ["1x1", "1x300", "300x1", "2x2", "63x65"] {
        let outcome = place.npr(&["render", "sheet.glb", "--size", size, "--backend", "cpu"]);
        outcome.assert_silent_success();
    }
}

#[test]
fn cameras_of_the_file_are_found_by_name_and_by_number() {
    let place = Workplace::new();
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/two_balls.glb");
    place
        .render(assets, &["-o", "name.png", "--camera", "Camera"])
        .assert_silent_success();
    place
        .render(assets, &["-o", "number.png", "--camera", "0"])
        .assert_silent_success();
    assert_eq!(place.get("name.png"), place.get("number.png"));
    place
        .render(assets, &["--camera", "camera"])
        .assert_fault(2, "no camera 'camera'; it has 'Camera'");
    place
        .render(assets, &["--camera", "1"])
        .assert_fault(2, "no camera '1'");
}
