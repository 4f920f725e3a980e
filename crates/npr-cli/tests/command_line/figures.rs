//! Figures: expressions, poses and motions by their names and files, and what is said of them.

use crate::workplace::{Outcome, Workplace};
use npr_scene::Eyes;
use npr_scene::testing::{Vrm, avatar, gesture, glb, picture, puppet, wing};

const BOW: &[u8] = br#"{"pose":{"spine":{"rotation":[0.5,0,0,0.8]}}}"#;

/// A workplace with avatars of both versions, a motion, and a pose.
fn place() -> Workplace {
    let place = Workplace::with_scene();
    place.put("zero.vrm", &avatar(Vrm::Zero));
    place.put("one.vrm", &avatar(Vrm::One));
    place.put("wave.vrma", &gesture());
    place.put("bow.json", BOW);
    place
}

/// The drawing of a scene with options, and what was said of it.
fn drawn(place: &Workplace, command: &str, scene: &str, more: &[&str]) -> (Vec<u8>, String) {
    let file = if command == "lines" { "a.svg" } else { "a.png" };
    let line = [
        command,
        scene,
        "-o",
        file,
        "--size",
        "64x96",
        "--backend",
        "cpu",
    ];
    let outcome: Outcome = place.npr(&[&line, more].concat());
    assert_eq!(outcome.code, Some(0), "{more:?}: {}", outcome.stderr);
    let said: Vec<&str> = outcome.stderr.lines().collect();
    (place.get(file), said.join("\n"))
}

#[test]
fn both_versions_are_drawn_alike() {
    let place = place();
    let cases: [&[&str]; 6] = [
        &[],
        &["--expression", "happy=0.6"],
        &["--expression", "blink"],
        &["--pose", "bow.json"],
        &["--motion", "wave.vrma", "--time", "0.3"],
        &[
            "--motion",
            "wave.vrma",
            "--time",
            "1.6",
            "--pose",
            "bow.json",
            "--expression",
            "Wink=0.5",
        ],
    ];
    let mut seen = Vec::new();
    for more in cases {
        let (picture, said) = drawn(&place, "render", "one.vrm", more);
        assert_eq!(
            drawn(&place, "render", "zero.vrm", more),
            (picture.clone(), said),
            "{more:?}"
        );
        assert!(!seen.contains(&picture), "{more:?}");
        seen.push(picture);
    }
}

#[test]
fn expressions_are_named_in_any_letter_case_and_the_last_share_counts() {
    let place = place();
    for command in ["render", "lines"] {
        let picture = |scene, more: &[&str]| {
            let (picture, said) = drawn(&place, command, scene, more);
            assert_eq!(said, "", "{more:?}");
            picture
        };
        let happy = picture("one.vrm", &["--expression", "happy"]);
        for name in ["HAPPY=1", "joy", "Happy=1.0"] {
            assert_eq!(picture("one.vrm", &["--expression", name]), happy, "{name}");
        }
        let twice = [
            "--expression",
            "aa",
            "--expression",
            "happy=0",
            "--expression",
            "Happy",
            "--expression",
            "aa=0",
        ];
        assert_eq!(picture("one.vrm", &twice), happy);
        let rest = picture("one.vrm", &[]);
        assert_ne!(rest, happy);
        assert_eq!(picture("one.vrm", &["--expression", "blink=0.5"]), rest);
        assert_ne!(picture("one.vrm", &["--expression", "blink=0.51"]), rest);
    }
}

#[test]
fn what_there_is_none_of_is_refused() {
    let place = place();
    place.put("wing.glb", &wing());
    place.put("broken.json", b"{\"pose\":{]");
    place.put("other.json", b"{\"pose\":[1]}");
    place.put("other.vrma", b"no motion");
    let names = place.names();
    let refused =
        |code, arguments: &[&str], text: &str| place.npr(arguments).assert_fault(code, text);
    for command in ["render", "lines", "animate"] {
        let of = |scene, option, value| [command, scene, option, value];
        let told = "the scene has no expression 'hppy'; it has 'happy', 'aa', 'Wink', 'blink'";
        refused(2, &of("one.vrm", "--expression", "hppy"), told);
        refused(
            2,
            &of("scene.obj", "--expression", "happy"),
            "no expression 'happy'; it has none",
        );
        refused(
            2,
            &of("one.vrm", "--expression", "happy=2"),
            "a share from 0 to 1",
        );
        refused(
            2,
            &of("scene.obj", "--motion", "wave.vrma"),
            "the scene has no bones",
        );
        refused(
            3,
            &of("one.vrm", "--motion", "wing.glb"),
            "cannot play 'wing.glb': the motion has no bones",
        );
        refused(
            3,
            &of("one.vrm", "--motion", "one.vrm"),
            "cannot play 'one.vrm': the motion has no clips",
        );
        refused(
            3,
            &of("one.vrm", "--motion", "other.vrma"),
            "cannot read 'other.vrma'",
        );
        refused(
            1,
            &of("one.vrm", "--motion", "none.vrma"),
            "cannot read 'none.vrma'",
        );
        if command == "animate" {
            continue;
        }
        refused(
            2,
            &of("scene.obj", "--pose", "bow.json"),
            "the scene has no bones",
        );
        refused(
            3,
            &of("one.vrm", "--pose", "broken.json"),
            "'broken.json': line 1, column 10: this is not JSON",
        );
        refused(
            3,
            &of("one.vrm", "--pose", "other.json"),
            "cannot read 'other.json': it holds no bones",
        );
        refused(
            1,
            &of("one.vrm", "--pose", "none.json"),
            "cannot read 'none.json'",
        );
        let unknown = [
            command,
            "one.vrm",
            "--motion",
            "wave.vrma",
            "--clip",
            "Walk",
        ];
        refused(2, &unknown, "the scene has no clip 'Walk'; it has 'Wave'");
    }
    refused(
        2,
        &["smoke", "puff", "--expression", "happy"],
        "it has none",
    );
    assert_eq!(place.names(), names);
}

#[test]
fn what_a_run_reads_is_not_written_over() {
    let place = place();
    let line = ["lines", "one.vrm", "--pose", "bow.json", "-o", "bow.json"];
    place.npr(&line).assert_fault(2, "bow.json");
    assert_eq!(place.get("bow.json"), BOW);
    place.put("wave.svg", &gesture());
    let line = ["lines", "one.vrm", "--motion", "wave.svg", "-o", "wave.svg"];
    place.npr(&line).assert_fault(2, "wave.svg");
    assert!(place.get("wave.svg") == gesture());
}

#[test]
fn an_expression_changes_colours_too() {
    let place = place();
    let red = |scene, more: &[&str]| {
        let (picture, _) = drawn(&place, "render", scene, more);
        let picture = image::load_from_memory(&picture)
            .expect("a picture")
            .to_rgb8();
        let is_red = |pixel: &&image::Rgb<u8>| pixel[0] > 100 && pixel[1] < 20 && pixel[2] < 20;
        picture.pixels().filter(is_red).count()
    };
    for scene in ["zero.vrm", "one.vrm"] {
        assert_eq!(red(scene, &[]), 0);
        assert_eq!(red(scene, &["--expression", "aa"]), 0);
        assert!(red(scene, &["--expression", "happy"]) > 20);
    }
}

#[test]
fn figures_look_at_points_and_at_the_camera() {
    let place = place();
    let view = ["--eye", "0.4,1.8,1.2", "--target", "0,1.6,0"];
    for eyes in [Eyes::Bones, Eyes::Expressions] {
        place.put("zero.vrm", &puppet(Vrm::Zero, eyes));
        place.put("one.vrm", &puppet(Vrm::One, eyes));
        for command in ["render", "lines"] {
            let look = |scene, more: &[&str]| {
                let (picture, said) = drawn(&place, command, scene, &[&view, more].concat());
                assert_eq!(said, "", "{more:?}");
                picture
            };
            let rest = look("one.vrm", &[]);
            let aside = look("one.vrm", &["--look-at", "3,1.6,1"]);
            let back = look("one.vrm", &["--look-at", "0.4,1.8,1.2"]);
            assert!(aside != rest && back != rest && aside != back);
            assert_eq!(look("one.vrm", &["--look-at", "camera"]), back);
            assert_eq!(look("zero.vrm", &["--look-at", "camera"]), back);

            // What is said of an expression counts.
            if eyes == Eyes::Expressions {
                let mut said = vec!["--look-at", "camera"];
                for none in ["lookLeft=0", "lookRight=0", "lookUp=0", "lookDown=0"] {
                    said.extend(["--expression", none]);
                }
                assert_eq!(look("one.vrm", &said), rest);
            }
        }
    }
}

#[test]
fn eyes_follow_the_camera_of_a_film() {
    let place = place();
    place.put("one.vrm", &puppet(Vrm::One, Eyes::Expressions));
    let film = |name: &str, more: &[&str]| {
        let file = format!("{name}_#.png");
        let line = [
            "animate",
            "one.vrm",
            "-o",
            &file,
            "--size",
            "64x96",
            "--backend",
            "cpu",
        ];
        let turn = ["--turntable", "--length", "4"];
        let outcome = place.npr(&[&line, &turn[..], more].concat());
        let mut said = outcome.stderr.lines();
        let of_motion = |line: &str| line.contains("of the motion");
        assert_eq!(outcome.code, Some(0), "{more:?}");
        assert!(said.all(of_motion), "{}", outcome.stderr);
        let frames = (0..4).filter(|number| place.path(&format!("{name}_{number}.png")).exists());
        let frames = frames.map(|number| place.get(&format!("{name}_{number}.png")));
        frames.collect::<Vec<_>>()
    };
    let still = film("a", &[]);
    let looking = film("b", &["--look-at", "camera"]);
    assert_eq!((still.len(), looking.len()), (4, 4));
    assert_eq!(
        film("c", &["--look-at", "camera", "--frames", "2..3"]),
        looking[2..]
    );
    let moved = still.iter().zip(&looking).filter(|(a, b)| a != b).count();
    assert!(moved >= 2, "{moved}");

    // While a clip plays, too.
    let wave = ["--motion", "wave.vrma", "--frames", "2..3"];
    let plain = film("d", &wave);
    assert_ne!(
        film("e", &[&wave[..], &["--look-at", "camera"]].concat()),
        plain
    );
}

/// A puppet whose springs have another name, so that nothing swings.
fn stiff() -> Vec<u8> {
    let (mut file, name) = (puppet(Vrm::One, Eyes::Bones), b"VRMC_springBone");
    while let Some(at) = file.windows(name.len()).position(|bytes| bytes == name) {
        file[at..at + name.len()].copy_from_slice(b"VRMC_materials_");
    }
    file
}

#[test]
fn springs_swing_by_the_time_alone() {
    let place = place();
    place.put("hair.vrm", &puppet(Vrm::One, Eyes::Bones));
    place.put("stiff.vrm", &stiff());
    let view = "--size 64x96 --backend cpu -q --style speed --eye 1.5,1.7,-3 --target 0,1.1,0 --motion wave.vrma";
    let run = |line: &str| {
        let words: Vec<&str> = line.split(' ').chain(view.split(' ')).collect();
        let outcome = place.npr(&words);
        assert_eq!(
            (outcome.code, outcome.stderr.as_str()),
            (Some(0), ""),
            "{line}"
        );
    };
    run("animate hair.vrm --fps 12 --frames 0..11 -o whole_##.png");
    run("animate stiff.vrm --fps 12 --frames 0..11 -o stiff_##.png");
    let frames = |name: &str| {
        let file = |number: u32| place.get(&format!("{name}_{number:02}.png"));
        (0..12).map(file).collect::<Vec<_>>()
    };
    let whole = frames("whole");
    let swung = whole
        .iter()
        .zip(&frames("stiff"))
        .filter(|(a, b)| a != b)
        .count();
    assert!(swung >= 10, "{swung}");
    assert_eq!(frames("stiff")[0], whole[0]);

    // Parts, later frames first; frames that go on; other rates; stills.
    run("animate hair.vrm --fps 12 --frames 6..11 -o part_##.png");
    run("animate hair.vrm --fps 12 --frames 0..5 -o part_##.png");
    assert!(frames("part") == whole);
    std::fs::remove_file(place.path("part_07.png")).expect("a frame");
    run("animate hair.vrm --fps 12 --frames 0..11 --resume -o part_##.png");
    assert!(frames("part") == whole);
    run(
        "animate hair.vrm --hold off --fps 24 --frames 18 --set motion.shutter=0.08333333 -o fast.png",
    );
    run("render hair.vrm --time 0.75 --set motion.shutter=0.08333333 -o still.png");
    run(
        "animate hair.vrm --hold off --fps 12 --frames 9 --set motion.shutter=0.08333333 -o slow.png",
    );
    assert!(place.get("fast.png") == place.get("slow.png"));
    assert!(place.get("still.png") == place.get("slow.png"));
    run("lines hair.vrm --time 0.75 -o still.svg");
    run("lines stiff.vrm --time 0.75 -o stiff.svg");
    assert!(place.get("still.svg") != place.get("stiff.svg"));
}

#[test]
fn what_still_swings_leaves_speed_lines() {
    let place = place();
    place.put("hair.vrm", &puppet(Vrm::One, Eyes::Bones));
    place.put("stiff.vrm", &stiff());
    // The clip ends at 2 s; what moves a little later is what swings.
    let look = |scene: &str, follow: &str| {
        let line = format!(
            "render {scene} --motion wave.vrma --time 2.1 --style speed --set motion.follow={follow} \
             --set motion.least=\"0.1px\" --set motion.shutter=0.03 --eye 0.4,1.8,-1.2 --target 0,1.4,0 \
             --size 300x300 --backend cpu -q -o a.png"
        );
        let outcome = place.npr(&line.split_whitespace().collect::<Vec<_>>());
        assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""));
        place.get("a.png")
    };
    assert!(look("stiff.vrm", "2") == look("stiff.vrm", "0"));
    assert!(look("hair.vrm", "2") != look("hair.vrm", "0"));
}

#[test]
fn figures_that_stand_do_not_swing() {
    let place = place();
    place.put("hair.vrm", &puppet(Vrm::One, Eyes::Bones));
    place.put("stiff.vrm", &stiff());
    let film = |scene: &str, more: &[&str]| {
        let turn = [
            "animate",
            scene,
            "--turntable",
            "--length",
            "3",
            "-q",
            "-o",
            "f#.png",
        ];
        let view = ["--size", "64x96", "--backend", "cpu"];
        let outcome = place.npr(&[&turn[..], &view, more].concat());
        assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""));
        [0, 1, 2].map(|number| place.get(&format!("f{number}.png")))
    };
    for more in [&[][..], &["--pose", "bow.json"]] {
        assert!(film("hair.vrm", more) == film("stiff.vrm", more));
    }
    // A moment of a clip is held as it swings then.
    let held = ["--motion", "wave.vrma", "--time", "0.9"];
    assert!(film("hair.vrm", &held) != film("stiff.vrm", &held));
}

#[test]
fn who_cannot_look_is_told_and_nonsense_is_refused() {
    let place = place();
    let told = "npr: warning: --look-at is ignored: the scene has no figure with eyes that look";
    for scene in ["one.vrm", "scene.obj"] {
        let (rest, before) = drawn(&place, "render", scene, &[]);
        let (picture, said) = drawn(&place, "render", scene, &["--look-at", "camera"]);
        assert_eq!((picture, before.as_str(), said.as_str()), (rest, "", told));
    }
    for nonsense in ["here", "1,2", "nan,0,0"] {
        let line = ["render", "one.vrm", "--look-at", nonsense];
        place.npr(&line).assert_fault(2, "or 'camera'");
    }
    let outcome = place.npr(&["smoke", "puff", "--size", "32x32", "--look-at", "camera"]);
    assert!(
        outcome
            .stderr
            .contains("--look-at is ignored: there is no scene")
    );
}

#[test]
fn what_of_a_pose_is_not_used_is_told() {
    let place = place();
    let (rest, _) = drawn(&place, "render", "one.vrm", &[]);
    place.put(
        "odd.json",
        br#"{"pose":{"leftUprArm":{},"head":{"rotation":[0,0,0]},"spine":{"position":[1,0,0]}}}"#,
    );
    let (picture, said) = drawn(&place, "render", "one.vrm", &["--pose", "odd.json"]);
    assert_eq!(picture, rest);
    let mut said: Vec<&str> = said.lines().collect();
    said.sort_unstable();
    let of = "npr: warning: pose 'odd.json': ";
    let wanted = [
        "the position of 'spine' is ignored: the hips alone are moved",
        "the rotation of 'head' is ignored: it is no list of four numbers that turn something",
        "there is no bone 'leftUprArm': did you mean 'leftUpperArm'?",
    ];
    assert_eq!(said, wanted.map(|text| format!("{of}{text}")));

    // A hundred faults are not a hundred lines.
    let many: Vec<String> = (0..100).map(|i| format!("\"bone {i}\":{{}}")).collect();
    place.put(
        "odd.json",
        format!("{{\"pose\":{{{}}}}}", many.join(",")).as_bytes(),
    );
    let (_, said) = drawn(&place, "render", "one.vrm", &["--pose", "odd.json"]);
    assert!(
        said.lines().count() == 6 && said.ends_with("95 more are ignored"),
        "{said}"
    );
}

#[test]
fn what_of_a_motion_is_not_used_is_told_once() {
    let place = place();
    let (_, said) = drawn(&place, "render", "one.vrm", &["--motion", "wave.vrma"]);
    let of = "npr: warning: motion 'wave.vrma': ";
    let wanted = [
        "where the figure of the motion looks is not used",
        "expressions of motions change no colours",
    ];
    assert_eq!(said, wanted.map(|text| format!("{of}{text}")).join("\n"));

    // A motion plays on any scene whose nodes are named as bones, one of VRM 1.0 on one of VRM 0.x too.
    let line = [
        "animate",
        "zero.vrm",
        "--motion",
        "wave.vrma",
        "--frames",
        "0..2",
        "--fps",
        "1",
        "-o",
        "f#.png",
    ];
    let outcome = place.npr(&[&line[..], &["--size", "48x64", "--backend", "cpu", "-q"]].concat());
    outcome.assert_silent_success();
    let [first, second, third] = [0, 1, 2].map(|i| place.get(&format!("f{i}.png")));
    assert!(first != second && second != third);
}

#[test]
fn bones_and_expressions_are_listed() {
    let place = place();
    let outcome = place.npr(&["info", "one.vrm", "--json"]);
    outcome.assert_silent_success();
    let info: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
    assert_eq!(info["bones"].as_array().map(Vec::len), Some(15));
    assert_eq!(
        info["bones"][0],
        serde_json::json!({"name": "hips", "node": "hips"})
    );
    let happy = serde_json::json!({
        "name": "happy", "file_name": "happy", "binary": false,
        "morphs": [{"node": "head", "morph": 0, "weight": 0.5}], "colors": ["Face"], "textures": [],
        "overrides": {"blinks": "block", "looks": "none", "mouths": "blend"},
    });
    assert_eq!(info["expressions"][2], happy);
    let listed = |file, line: &str| {
        let text = place.npr(&["info", file]);
        assert!(
            text.text().contains(&format!("\n  {line}\n")),
            "{}",
            text.text()
        );
    };
    listed("one.vrm", "bone leftUpperArm 'leftUpperArm'");
    listed(
        "one.vrm",
        "expression 'happy' binds 1 morph, 1 colour, blocks blinks, blends mouths",
    );
    listed(
        "zero.vrm",
        "expression 'blink' (in the file 'Blink') binds 1 morph, binary",
    );
    listed("wave.vrma", "expression 'blink' moves with the clips");
}

/// A triangle whose picture passes by once a second.
fn flowing() -> Vec<u8> {
    let places = [[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    let uvs = [[0f32, 0.], [1., 0.], [0., 1.]];
    let numbers = places.as_flattened().iter().chain(uvs.as_flattened());
    let mut bin: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
    let png = picture([2, 1], &[[200, 40, 40, 255], [40, 40, 200, 255]]);
    let length = png.len();
    bin.extend(png);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"flag","mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":24}},
        {{"buffer":0,"byteOffset":60,"byteLength":{length}}}],
        "buffers":[{{"byteLength":{}}}],"images":[{{"bufferView":2,"mimeType":"image/png"}}],
        "textures":[{{"source":0}}],"extensionsUsed":["VRMC_materials_mtoon"],
        "materials":[{{"doubleSided":true,"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}},
        "extensions":{{"VRMC_materials_mtoon":{{"specVersion":"1.0","shadeColorFactor":[1,1,1],
        "shadeMultiplyTexture":{{"index":0}},"uvAnimationScrollXSpeedFactor":1}}}}}}]}}"#,
        bin.len()
    );
    glb(&json, &bin)
}

#[test]
fn pictures_that_move_do_so_in_styles_that_let_them() {
    let place = place();
    place.put("flag.glb", &flowing());
    let at = |time: &str, style: &str| {
        let more = ["--style", style, "--time", time];
        drawn(&place, "render", "flag.glb", &more)
    };
    let (start, said) = at("0", "mtoon");
    assert_eq!(said, "");
    assert_ne!(at("0.5", "mtoon").0, start, "half a picture later");
    assert_eq!(at("1", "mtoon").0, start, "the picture again");
    let (still, said) = at("0.5", "toon");
    assert_eq!(
        said,
        "npr: warning: --time is ignored: the scene has no clips"
    );
    assert_eq!(still, at("0", "toon").0);

    // Films of them need no clip, and a time holds them.
    let film = |more: &[&str]| {
        let line = [
            "animate",
            "flag.glb",
            "-o",
            "f_#.png",
            "--frames",
            "0..1",
            "--fps",
            "2",
            "--size",
            "64x96",
            "--backend",
            "cpu",
        ];
        place.npr(&[&line, more].concat())
    };
    let outcome = film(&["--style", "mtoon"]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert_ne!(place.get("f_0.png"), place.get("f_1.png"));
    for more in [
        &["--style", "toon"][..],
        &["--style", "mtoon", "--time", "0"],
    ] {
        let outcome = film(more);
        assert_eq!(outcome.code, Some(2), "{more:?}");
        assert!(
            outcome.stderr.contains("nothing moves"),
            "{}",
            outcome.stderr
        );
    }
}
