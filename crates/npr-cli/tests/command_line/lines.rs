//! `npr lines`.

use crate::files::tiny_png;
use crate::info::named_glb;
use crate::workplace::{Outcome, Workplace};
use npr_gpu::testing::is_device_required;
use npr_scene::testing::{Sheet, glb, lines_glb};
use serde_json::Value;

/// Runs a small line drawing of a scene.
fn lines(place: &Workplace, scene: &str, more: &[&str]) -> Outcome {
    place.npr(&[&["lines", scene, "--size", "96x64"], more].concat())
}

/// The line data of a scene.
fn data(place: &Workplace, scene: &str, more: &[&str]) -> Value {
    let outcome = lines(
        place,
        scene,
        &[&["-o", "-", "--format", "json", "--quiet"], more].concat(),
    );
    outcome.assert_silent_success();
    serde_json::from_str(outcome.text()).expect("JSON")
}

fn strokes(data: &Value) -> &Vec<Value> {
    data["strokes"].as_array().expect("a list")
}

#[test]
fn a_drawing_is_named_after_its_scene_and_lies_in_the_current_folder() {
    let place = Workplace::with_scene();
    lines(&place, "scene.obj", &[]).assert_silent_success();
    lines(&place, "scene.obj", &["--format", "pdf"]).assert_silent_success();
    assert_eq!(place.names(), ["scene.obj", "scene.pdf", "scene.svg"]);
}

#[test]
fn every_format_comes_by_its_name_or_by_option() {
    let place = Workplace::with_scene();
    let starts: [(&str, &[u8]); 4] = [
        ("svg", b"<"),
        ("json", b"{"),
        ("pdf", b"%PDF-"),
        ("png", b"\x89PNG"),
    ];
    for (format, start) in starts {
        let name = format!("out.{format}");
        lines(&place, "scene.obj", &["-o", &name]).assert_silent_success();
        let outcome = lines(&place, "scene.obj", &["-o", "-", "--format", format]);
        outcome.assert_silent_success();
        assert!(outcome.stdout.starts_with(start), "{format}");
        assert_eq!(place.get(&name), outcome.stdout, "{format}");
    }
    let outcome = lines(&place, "scene.obj", &["-o", "-"]);
    assert_eq!(
        outcome.stdout,
        place.get("out.svg"),
        "svg goes without saying"
    );
}

#[test]
fn line_data_is_as_documented() {
    let place = Workplace::new();
    place.put("sheet.glb", &Sheet::new(6).glb());
    let data = data(&place, "sheet.glb", &["--hidden", "layer"]);
    assert_eq!(
        (&data["version"], &data["size"]),
        (&1.into(), &serde_json::json!([96, 64]))
    );
    assert!(!strokes(&data).is_empty());
    for stroke in strokes(&data) {
        assert!(stroke["id"].is_u64() && stroke["closed"].is_boolean());
        assert!(["visible", "hidden"].contains(&stroke["visibility"].as_str().expect("text")));
        assert_eq!(stroke["object"], "sheet");
        let (points, world) = (&stroke["points"], &stroke["world"]);
        let count = points.as_array().expect("a list").len();
        assert_eq!(count, world.as_array().expect("a list").len());
        for (point, place) in points
            .as_array()
            .into_iter()
            .flatten()
            .zip(world.as_array().into_iter().flatten())
        {
            assert_eq!(point.as_array().map(Vec::len), Some(5));
            assert_eq!(place.as_array().map(Vec::len), Some(3));
        }
    }
}

#[test]
fn wrong_options_exit_with_2_and_leave_nothing() {
    let cases: &[(&[&str], &str)] = &[
        (&["lines"], "not provided: <SCENE>"),
        (&["lines", "-"], "-o"),
        (
            &["lines", "scene.obj", "-o", "out.eps"],
            ".svg, .json, .pdf or .png",
        ),
        (
            &["lines", "scene.obj", "-o", "out"],
            ".svg, .json, .pdf or .png",
        ),
        (
            &["lines", "scene.obj", "--format", "eps"],
            "svg, json, pdf, png",
        ),
        (&["lines", "scene.obj", "--kinds", "outline"], "contour"),
        (&["lines", "scene.obj", "--kinds", ""], "contour"),
        (
            &["lines", "scene.obj", "--crease", "-1"],
            "between 0 and 180",
        ),
        (
            &["lines", "scene.obj", "--crease", "nan"],
            "between 0 and 180",
        ),
        (
            &["lines", "scene.obj", "--split", "5"],
            "between 10 and 180",
        ),
        (
            &["lines", "scene.obj", "--method", "pencil"],
            "surface, edges, potrace, image",
        ),
        (
            &["lines", "scene.obj", "--hidden", "dotted"],
            "none, layer, dashed",
        ),
        (&["lines", "scene.obj", "--smooth", "maybe"], "on, off"),
        (
            &["lines", "scene.obj", "--svg", "inline"],
            "outline, centreline",
        ),
        (&["lines", "scene.obj", "--page", "B9"], "A4"),
        (
            &["lines", "scene.obj", "--page", "A4", "-o", "x.png"],
            "only .svg and .pdf",
        ),
        (&["lines", "scene.obj", "--weld", "2"], "between 0 and 0.1"),
        (&["lines", "scene.obj", "--size", "0x5"], "leaves no pixel"),
        (&["lines", "scene.obj", "--style", "inkk"], "'ink'"),
        (
            &["lines", "scene.obj", "--set", "line.colour=red"],
            "line.color",
        ),
        (&["lines", "scene.obj", "--camera", "Top"], "it has none"),
        (&["render", "scene.obj", "-o", "x.svg"], "npr lines"),
    ];
    Workplace::with_scene().assert_refused(cases);
}

#[test]
fn limits_are_named_with_the_option_that_lifts_them() {
    let place = Workplace::with_scene();
    for (option, value) in [
        ("--max-file", "10"),
        ("--max-triangles", "0"),
        ("--memory-limit", "300"),
    ] {
        lines(&place, "scene.obj", &[option, value]).assert_fault(5, option);
    }
    let large = ["lines", "scene.obj", "--size", "32000x32000", "-o", "x.png"];
    place.npr(&large).assert_fault(5, "--memory-limit");
    place
        .npr(&["lines", "scene.obj", "--size", "40000x5"])
        .assert_fault(5, "32768");
    assert_eq!(place.names(), ["scene.obj"]);
}

#[test]
fn a_scene_comes_from_standard_input() {
    let place = Workplace::with_scene();
    let scene = place.get("scene.obj");
    let outcome = place.npr_fed(&["lines", "-", "-o", "-", "--size", "96x64"], &scene);
    outcome.assert_silent_success();
    lines(&place, "scene.obj", &[]).assert_silent_success();
    assert_eq!(outcome.stdout, place.get("scene.svg"));
}

#[test]
fn no_file_of_the_scene_is_written_over_even_if_it_is_not_read() {
    let place = Workplace::new();
    let scene =
        b"mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n";
    place.put("scene.obj", scene);
    place.put("scene.mtl", b"newmtl paint\nmap_Kd skin.png\n");
    place.put("skin.png", &tiny_png());
    for output in ["skin.png", "./skin.png"] {
        lines(&place, "scene.obj", &["-o", output]).assert_fault(2, "also an input");
    }
    for output in ["scene.obj", "scene.mtl"] {
        lines(&place, "scene.obj", &["-o", output, "--format", "svg"])
            .assert_fault(2, "also an input");
    }
    assert_eq!(place.get("skin.png"), tiny_png());
}

#[test]
fn images_of_the_scene_are_not_read() {
    let place = Workplace::new();
    place.put(
        "scene.obj",
        b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl p\nf 1 2 3\n",
    );
    place.put("m.mtl", b"newmtl p\nmap_Kd broken.png\n");
    place.put("broken.png", b"no picture");
    lines(&place, "scene.obj", &[]).assert_silent_success();
}

#[test]
fn names_are_data() {
    let names = [
        "--><script>alert(1)</script>",
        "a\u{1b}[2J\n\u{202e}b",
        "]]>\"'%!../x&amp;",
        "\u{0}\u{fffe}",
        &"x".repeat(100_000),
    ];
    let place = Workplace::new();
    for name in names {
        place.put("named.glb", &named_glb(name));
        let data = data(&place, "named.glb", &[]);
        assert_eq!(strokes(&data)[0]["object"], name);
        lines(&place, "named.glb", &["-o", "x.svg"]).assert_silent_success();
        let text = String::from_utf8(place.get("x.svg")).expect("UTF-8");
        assert!(!text.contains("<script") && !text.contains('\u{202e}'));
        check_xml(&text);
        lines(&place, "named.glb", &["-o", "x.pdf"]).assert_silent_success();
    }
}

/// Asserts that a text is well-formed XML.
fn check_xml(text: &str) {
    let mut reader = quick_xml::Reader::from_str(text);
    reader.config_mut().check_comments = true;
    loop {
        match reader.read_event().expect("well-formed XML") {
            quick_xml::events::Event::Eof => break,
            quick_xml::events::Event::Start(tag) | quick_xml::events::Event::Empty(tag) => {
                assert!(tag.attributes().all(|attribute| attribute.is_ok()));
            }
            _ => {}
        }
    }
}

#[test]
fn any_scene_and_view_gives_a_drawing() {
    let place = Workplace::new();
    place.put(
        "empty.glb",
        &glb(r#"{"asset":{"version":"2.0"},"scenes":[{}]}"#, &[]),
    );
    assert!(strokes(&data(&place, "empty.glb", &[])).is_empty());
    place.put("points.obj", b"v 0 0 0\nv 1 0 0\n");
    assert!(strokes(&data(&place, "points.obj", &[])).is_empty());

    place.put("sheet.glb", &Sheet::new(4).glb());
    let away = ["--eye", "2,9,2", "--target", "2,99,2"];
    assert!(strokes(&data(&place, "sheet.glb", &away)).is_empty());
    let views: [&[&str]; 8] = [
        &["--eye", "2,1.02,2"],
        &["--eye", "2,9,2", "--target", "2,0,2", "--up", "0,1,0"],
        &["--eye", "0,1,0", "--target", "4,1,4"],
        &["--eye", "1e30,0,0"],
        &["--eye", "1e5,0,0"],
        &["--eye", "1e-30,0,0", "--target", "0,0,0"],
        &["--eye", "-3,-4,-5", "--fov", "179"],
        &["--fov", "0.1"],
    ];
    for view in views {
        for more in [
            &["-o", "x.svg", "--hidden", "dashed", "--fill"][..],
            &["-o", "x.png"],
            &["-o", "x.pdf"],
        ] {
            let outcome = lines(&place, "sheet.glb", &[view, more].concat());
            assert_eq!(
                outcome.code,
                Some(0),
                "{view:?} {more:?}: {}",
                outcome.stderr
            );
        }
    }
    for size in ["1x1", "1x300", "300x1"] {
        let outcome = place.npr(&["lines", "sheet.glb", "--size", size, "-o", "x.svg"]);
        outcome.assert_silent_success();
    }
}

#[test]
fn degenerate_triangles_are_drawn() {
    let cases = [
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 2 2 2\n",
        "v 5 5 5\nv 5 5 5\nv 5 5 5\nf 1 2 3\n",
        "v 0 0 0\nv 1e17 0 0\nv 0 1e17 0\nf 1 2 3\n",
        "v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n",
        "v 1e9 0 0\nv 1000000064 0 0\nv 1e9 64 0\nf 1 2 3\n",
        "v 0 0 0\nv 0 1 0\nv 1 0 0\nv -1 0 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n",
    ];
    let place = Workplace::new();
    for text in cases {
        place.put("scene.obj", text.as_bytes());
        for method in ["edges", "surface", "potrace", "image"] {
            let outcome = lines(&place, "scene.obj", &["--method", method, "--fill"]);
            assert_eq!(outcome.code, Some(0), "{text}: {}", outcome.stderr);
        }
    }
}

#[test]
fn strokes_from_pixels_are_visible_ones_alone() {
    let place = Workplace::with_scene();
    for method in ["potrace", "image"] {
        let data = data(&place, "scene.obj", &["--method", method]);
        assert!(!strokes(&data).is_empty());
        for hidden in ["layer", "dashed"] {
            let more = ["--method", method, "--hidden", hidden];
            let outcome = lines(&place, "scene.obj", &more);
            assert_eq!(outcome.code, Some(2), "{}", outcome.stderr);
            let reported = format!("--method {method}");
            assert!(outcome.stderr.contains(&reported), "{}", outcome.stderr);
        }
    }
    let more = ["--method", "potrace", "--set", "line.potrace.rounds=1"];
    let outcome = lines(&place, "scene.obj", &more);
    assert_eq!(outcome.code, Some(1), "{}", outcome.stderr);
    let kinds = ["--method", "potrace", "--kinds", "intersection,boundary"];
    let outcome = lines(&place, "scene.obj", &kinds);
    assert!(
        outcome.stderr.contains("intersection"),
        "{}",
        outcome.stderr
    );
}

#[test]
fn only_the_kinds_asked_for_are_written() {
    let place = Workplace::with_scene();
    let kinds_of = |kinds: &str| {
        let data = data(&place, "scene.obj", &["--kinds", kinds]);
        let names = strokes(&data)
            .iter()
            .map(|stroke| stroke["kind"].as_str().expect("text").to_owned());
        names
            .collect::<std::collections::BTreeSet<_>>()
            .into_iter()
            .collect::<Vec<_>>()
    };
    assert_eq!(kinds_of("boundary"), ["boundary"]);
    assert!(kinds_of("crease,material,intersection").is_empty());
}

#[test]
fn strokes_are_split_by_option_or_by_style() {
    let place = Workplace::with_scene();
    let count = |more: &[&str]| strokes(&data(&place, "scene.obj", more)).len();
    assert_eq!(count(&[]), 1);
    assert_eq!(count(&["--split", "60"]), 3);
    assert_eq!(count(&["--set", "line.split_angle_deg=60"]), 3);
    let over = ["--set", "line.split_angle_deg=60", "--split", "180"];
    assert_eq!(count(&over), 1);
}

#[test]
fn a_picture_of_lines_only_can_be_svg() {
    let place = Workplace::with_scene();
    let style = ["--style", "technical"];
    place
        .render("scene.obj", &[&["-o", "r.svg"][..], &style].concat())
        .assert_silent_success();
    let same = [
        "lines",
        "scene.obj",
        "--size",
        "48x32",
        "--style",
        "technical",
        "-o",
        "l.svg",
    ];
    place.npr(&same).assert_silent_success();
    assert_eq!(place.get("r.svg"), place.get("l.svg"));
    let grey = [
        "-o",
        "r.svg",
        "--style",
        "technical",
        "--set",
        "shade.paper=#c0c0c0",
    ];
    place.render("scene.obj", &grey).assert_silent_success();
    let text = String::from_utf8(place.get("r.svg"))
        .expect("UTF-8")
        .to_lowercase();
    assert!(text.contains("#c0c0c0"), "{text}");
}

#[test]
fn a_kept_surface_changes_no_byte() {
    let place = Workplace::new();
    place.put("sheet.glb", &Sheet::new(8).glb());
    std::fs::create_dir(place.path("kept")).expect("a folder");
    lines(&place, "sheet.glb", &["-o", "fresh.svg", "--cache", "off"]).assert_silent_success();
    for run in 0..2 {
        lines(&place, "sheet.glb", &["-o", "again.svg", "--cache", "kept"]).assert_silent_success();
        assert_eq!(place.get("again.svg"), place.get("fresh.svg"), "run {run}");
        let count = std::fs::read_dir(place.path("kept"))
            .expect("a folder")
            .count();
        assert_eq!(count, 2, "bends and intersections");
    }
    lines(&place, "sheet.glb", &["--cache", "nowhere"]).assert_fault(1, "no folder 'nowhere'");
    let mut command = place.command(&["lines", "sheet.glb"]);
    let output = command
        .env("NPR_CACHE_DIR", "nowhere")
        .output()
        .expect("the command starts");
    Outcome::of(output).assert_fault(1, "no folder 'nowhere'");
}

/// A corner of a cube, with its sides.
const TETRAHEDRON: &[u8] =
    b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n";

fn with_tetrahedron() -> Workplace {
    let place = Workplace::new();
    place.put("scene.obj", TETRAHEDRON);
    place
}

/// Draws the scene on a device; `None` where there is none and none is required, which is told by exit code 4 and no
/// file.
fn drawn_on_device(place: &Workplace, options: &[&str]) -> Option<Outcome> {
    let all = [&["--backend", "gpu", "-o", "gpu.svg"], options].concat();
    let outcome = lines(place, "scene.obj", &all);
    if outcome.code != Some(4) || is_device_required() {
        return Some(outcome);
    }
    outcome.assert_fault(4, "no graphics device");
    assert_eq!(place.names(), ["scene.obj"]);
    None
}

#[test]
fn a_device_draws_the_same_bytes_or_exits_with_4() {
    let place = with_tetrahedron();
    let Some(outcome) = drawn_on_device(&place, &["--method", "edges"]) else {
        return;
    };
    outcome.assert_silent_success();
    for backend in ["cpu", "auto"] {
        let options = ["--backend", backend, "-o", "other.svg", "--method", "edges"];
        lines(&place, "scene.obj", &options).assert_silent_success();
        assert_eq!(place.get("other.svg"), place.get("gpu.svg"), "{backend}");
    }
}

#[test]
fn what_a_device_does_of_smooth_contours_is_told_once() {
    let place = with_tetrahedron();
    let Some(outcome) = drawn_on_device(&place, &["--method", "surface"]) else {
        return;
    };
    assert_eq!(outcome.code, Some(0));
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    assert!(
        outcome
            .stderr
            .contains("smooth ones are made from them on the processor")
    );
}

#[test]
fn times_of_all_steps_are_told() {
    let place = Workplace::with_scene();
    let outcome = lines(&place, "scene.obj", &["--timings", "json"]);
    let times: Value = serde_json::from_str(&outcome.stderr).expect("JSON");
    let steps = times["steps"].as_array().expect("a list");
    let names: Vec<_> = steps
        .iter()
        .map(|step| step["name"].as_str().expect("a name"))
        .collect();
    assert_eq!(names, ["load", "prepare", "draw", "encode", "write"]);
}

#[test]
fn lines_lift_before_what_is_dark() {
    let place = Workplace::with_scene();
    let contrast_cache = [
        "--set",
        "line.color=\"#000\"",
        "--set",
        "line.background.method=\"contrast\"",
    ];
    let colored = |background: &str, contrast_cache: &[&str]| {
        let drawn = data(
            &place,
            "scene.obj",
            &[&["--background", background], contrast_cache].concat(),
        );
        strokes(&drawn)
            .iter()
            .any(|stroke| stroke.get("colors").is_some())
    };
    assert!(colored("#000000", &contrast_cache) && !colored("#ffffff", &contrast_cache));
    assert!(!colored("transparent", &contrast_cache) && !colored("#000000", &[]));
    // A picture behind is minded too, as far as the frame covers it, but not drawn.
    place.put("night.png", &tiny_png());
    let arguments = [
        &["--background", "night.png", "-o", "out.svg"],
        &contrast_cache[..],
    ]
    .concat();
    let outcome = lines(&place, "scene.obj", &arguments);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("lines mind it"),
        "{}",
        outcome.stderr
    );
}

/// The same drawing from every format: a roof of two faces, and a bent line and a short one above it.
#[test]
fn lines_of_files_become_marked_strokes() {
    let place = Workplace::new();
    let positions = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [0.0, 0.0, 2.0],
        [2.0, 0.5, 2.0],
        [0.2, 1.0, 0.2],
        [1.0, 1.25, 0.5],
        [1.5, 1.0, 1.5],
        [0.5, 1.5, 1.5],
        [0.75, 1.5, 1.5],
    ];
    let faces = [[0, 2, 1], [1, 2, 3]];
    let strips: [(u32, &[u32]); 2] = [(3, &[4, 5, 6]), (1, &[7, 8])];
    place.put("roof.glb", &lines_glb(&positions, &faces, &strips));
    let vertices: String = positions
        .iter()
        .map(|[x, y, z]| format!("v {x} {y} {z}\n"))
        .collect();
    let obj = format!("{vertices}f 1 3 2\nf 2 3 4\nl 5 6 7\nl 8 9\n");
    place.put("roof.obj", obj.as_bytes());
    let vertices: String = positions
        .iter()
        .map(|[x, y, z]| format!("{x} {y} {z}\n"))
        .collect();
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\n\
         element face 2\nproperty list uchar int vertex_indices\n\
         element edge 3\nproperty int vertex1\nproperty int vertex2\n\
         end_header\n{vertices}3 0 2 1\n3 1 2 3\n4 5\n5 6\n7 8\n"
    );
    place.put("roof.ply", ply.as_bytes());
    let marked = |data: &Value| -> Vec<usize> {
        let strokes = strokes(data)
            .iter()
            .filter(|stroke| stroke["kind"] == "marked");
        strokes
            .map(|stroke| stroke["points"].as_array().expect("a list").len())
            .collect()
    };
    for scene in ["roof.glb", "roof.obj", "roof.ply"] {
        let found = data(&place, scene, &["--smooth", "off", "--kinds", "crease"]);
        let mut counts = marked(&found);
        counts.sort_unstable();
        assert_eq!(counts, [2, 3], "{scene}");
        for method in ["edges", "surface", "image"] {
            let found = data(&place, scene, &["--method", method, "--smooth", "off"]);
            let mut counts = marked(&found);
            counts.sort_unstable();
            assert_eq!(counts, [2, 3], "{scene} {method}");
        }
        let outcome = lines(&place, scene, &["-o", "-"]);
        assert!(outcome.text().contains("marked"), "a layer of {scene}");
    }
}

#[test]
fn many_and_broken_lines_end_soon() {
    let place = Workplace::new();
    let far: Vec<[f32; 3]> = (0..1000)
        .map(|i| [(i % 31) as f32, (i % 37) as f32, (i % 41) as f32])
        .collect();
    let ends: Vec<u32> = (0..1_000_000_u32)
        .map(|i| i.wrapping_mul(2_654_435_761) % 1000)
        .collect();
    place.put("many.glb", &lines_glb(&far, &[], &[(3, &ends)]));
    lines(&place, "many.glb", &["--memory-limit", "4M"]).assert_fault(5, "--memory-limit");
    place.put(
        "none.glb",
        &lines_glb(&far, &[], &[(1, &[]), (2, &[5]), (3, &[7])]),
    );
    let outcome = lines(&place, "none.glb", &["-o", "none.svg"]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("one end"), "{}", outcome.stderr);
    place.put("broken.glb", &lines_glb(&far, &[], &[(1, &[0, 1000])]));
    let fault = "line segment 0 uses vertex 1000, but the part has only 1000";
    lines(&place, "broken.glb", &["-o", "broken.svg"]).assert_fault(3, fault);
}

#[test]
fn what_can_be_mended_in_a_mesh_is_told_once() {
    let place = Workplace::new();
    // A square of two triangles, of which one is wound the wrong way and one is there twice.
    place.put(
        "square.obj",
        b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 4 3\nf 1 4 3\n",
    );
    let told = "npr: warning: the meshes have 1 face that is stored twice and drawn once; \
                1 edge whose faces are wound against each other, where contours may be wrong\n";
    assert_eq!(lines(&place, "square.obj", &[]).stderr, told);
    lines(&place, "square.obj", &["--quiet"]).assert_silent_success();
}
