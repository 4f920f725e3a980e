//! Files that a strict reader refuses: what is sound in them is drawn, and each fault is told once, by name.

use npr_scene::testing::glb;
use npr_scene::{Format, Limits, MemoryResources, Scene, load_bytes};

fn load(bytes: &[u8], format: Format) -> Result<Scene, String> {
    let scene = load_bytes(
        "test",
        bytes,
        Some(format),
        &MemoryResources::default(),
        &Limits::default(),
    )
    .map_err(|fault| fault.to_string())?;
    scene.sanity_check();
    Ok(scene)
}

fn notices(scene: &Scene) -> Vec<&str> {
    scene
        .notices
        .iter()
        .map(|notice| notice.text.as_str())
        .collect()
}

/// A file whose node 0 is a triangle that follows joints 0 and 1, changed in one place.
struct Figure<'a> {
    nodes: &'a str,
    /// Behind the attributes of the triangle.
    primitive: &'a str,
    /// Within the accessor of its positions.
    positions: &'a str,
    /// Behind the accessors, and behind the buffer views.
    accessors: &'a str,
    views: &'a str,
    joints: [u8; 4],
    weights: [f32; 4],
    /// Behind all else; may hold skins of its own.
    rest: &'a str,
}

impl Default for Figure<'_> {
    fn default() -> Self {
        Self {
            nodes: r#"{"name":"leg","mesh":0,"skin":0},{},{}"#,
            primitive: "",
            positions: "",
            accessors: "",
            views: "",
            joints: [0, 1, 0, 0],
            weights: [0.5, 0.5, 0.0, 0.0],
            rest: "",
        }
    }
}

impl Figure<'_> {
    fn glb(&self) -> Vec<u8> {
        let positions = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.];
        let mut bin: Vec<u8> = positions.into_iter().flat_map(f32::to_le_bytes).collect();
        bin.extend([self.joints; 3].as_flattened());
        bin.extend(
            [self.weights; 3]
                .as_flattened()
                .iter()
                .copied()
                .flat_map(f32::to_le_bytes),
        );
        let skins = if self.rest.contains("\"skins\"") {
            ""
        } else {
            r#","skins":[{"joints":[1,2]}]"#
        };
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0,1,2]}}],"nodes":[{}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}{}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"{}}},
            {{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"}},
            {{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"}}{}],
            "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":12}},
            {{"buffer":0,"byteOffset":48,"byteLength":48}}{}],"buffers":[{{"byteLength":96}}]{skins}{}}}"#,
            self.nodes, self.primitive, self.positions, self.accessors, self.views, self.rest
        );
        glb(&json, &bin)
    }

    fn load(&self) -> Scene {
        load(&self.glb(), Format::Glb).expect("a file that can be drawn")
    }

    /// Asserts that the triangle is there, bent or at rest, and that this is all that is said.
    #[track_caller]
    fn assert_drawn(&self, is_bent: bool, wanted: &[&str]) {
        let scene = self.load();
        assert_eq!(notices(&scene), wanted);
        assert_eq!(scene.triangle_count(), 1);
        assert_eq!(scene.nodes[0].skin.is_some(), is_bent);
    }
}

#[test]
fn a_sound_figure_is_drawn_without_a_word() {
    Figure::default().assert_drawn(true, &[]);
}

#[test]
fn a_view_past_its_buffer_that_nothing_uses_is_told_of() {
    let past = Figure {
        views: r#",{"buffer":0,"byteOffset":90,"byteLength":7},{"buffer":0,"byteLength":96}"#,
        ..Figure::default()
    };
    let reported =
        "buffer view 3 ends at byte 97, but buffer 0 has only 96; nothing that is drawn uses it";
    past.assert_drawn(true, &[reported]);
}

#[test]
fn bounds_that_are_no_numbers_are_told_of_and_not_used() {
    let of = |positions| Figure {
        positions,
        ..Figure::default()
    };
    let reported = |name| {
        format!("accessor 0 has a {name} that is no number for each component; it is not used")
    };
    of(r#","min":"0 0 0","max":[1,1,0]"#).assert_drawn(true, &[&reported("min")]);
    of(r#","min":[0,0],"max":["1",1,0]"#).assert_drawn(true, &[&reported("min"), &reported("max")]);
    of(r#","min":[0,0,0],"max":[1,1,0]"#).assert_drawn(true, &[]);
}

#[test]
fn a_skin_without_joints_is_told_of_whether_it_is_used_or_not() {
    let used = Figure {
        rest: r#","skins":[{"joints":[]}]"#,
        ..Figure::default()
    };
    used.assert_drawn(
        false,
        &["skin 0 has no joints, and its meshes are drawn at rest"],
    );
    let idle = Figure {
        rest: r#","skins":[{"joints":[1,2]},{"joints":[]}]"#,
        ..Figure::default()
    };
    idle.assert_drawn(
        true,
        &["skin 1 has no joints; nothing that is drawn uses it"],
    );
}

#[test]
fn a_joint_that_is_not_there_is_told_of_by_number() {
    let of = |joint: u8, weight: f32| Figure {
        joints: [0, 1, joint, 0],
        weights: [0.5, 0.5, weight, 0.0],
        ..Figure::default()
    };
    let followed =
        "the mesh of node 'leg' follows joint 200, but its skin has only 2: it is drawn at rest";
    of(200, 0.1).assert_drawn(false, &[followed]);
    let idle = "the mesh of node 'leg' names joint 200 without weight, but its skin has only 2";
    of(200, 0.0).assert_drawn(true, &[idle]);
    of(1, 0.1).assert_drawn(true, &[]);
}

#[test]
fn a_part_of_an_unknown_mode_is_left_out_by_name() {
    let unknown = Figure {
        nodes: r#"{"mesh":0},{},{}"#,
        primitive: r#"},{"mode":99,"attributes":{"POSITION":0}"#,
        ..Figure::default()
    };
    let reported = "mesh 0 has a part of a mode that glTF does not know, which is not drawn";
    unknown.assert_drawn(false, &[reported]);
}

#[test]
fn broken_animations_are_told_of_by_what_is_wrong() {
    let sampler = r#""samplers":[{"input":3,"output":4}]"#;
    let channel =
        |target: &str| format!(r#""channels":[{{"sampler":0,"target":{target}}}],{sampler}"#);
    let turn = r#"{"node":0,"path":"rotation"}"#;
    let cases = [
        (channel(turn), None),
        (
            format!(r#""channels":[{{"sampler":7,"target":{turn}}}],{sampler}"#),
            Some("channel 0 uses sampler 7, but there are only 1"),
        ),
        (
            channel(r#"{"node":30,"path":"rotation"}"#),
            Some("channel 0 moves node 30, but there are only 3"),
        ),
        (
            channel(r#"{"node":0,"path":"colour"}"#),
            Some("channel 0 moves something that glTF does not know"),
        ),
        (
            channel(r#"{"node":0,"path":"scale"}"#),
            Some("channel 0 needs values of 3 numbers"),
        ),
        (
            r#""channels":[],"samplers":[{"input":3,"output":99}]"#.to_string(),
            Some("sampler 0 uses accessor 99, but the file has only 5"),
        ),
        (
            r#""channels":[],"samplers":[{"input":4,"output":4}]"#.to_string(),
            Some("sampler 0 has times that are no single numbers"),
        ),
        (
            channel(turn).replace(
                "\"output\":4",
                "\"output\":4,\"interpolation\":\"CUBICSPLINE\"",
            ),
            Some("channel 0 has 2 values where 6 are needed"),
        ),
        (
            channel(turn).replace("\"output\":4", "\"output\":4,\"interpolation\":\"BOUNCE\""),
            Some("sampler 0 has an interpolation that glTF does not know"),
        ),
    ];
    for (animation, fault) in cases {
        let rest = format!(r#","animations":[{{{animation}}}]"#);
        // Two times, 0 and 1, and two turns.
        let accessors = r#",{"bufferView":0,"byteOffset":8,"componentType":5126,"count":2,"type":"SCALAR"},
            {"bufferView":2,"componentType":5126,"count":2,"type":"VEC4"}"#;
        let figure = Figure {
            accessors,
            rest: &rest,
            ..Figure::default()
        };
        let scene = figure.load();
        let broken = fault.map(|fault| format!("animation 0 is broken: {fault}"));
        let wanted: Vec<&str> = broken.as_deref().into_iter().collect();
        assert_eq!(notices(&scene), wanted, "{animation}");
        let counts: Vec<usize> = scene.clips.iter().map(|clip| clip.channels.len()).collect();
        assert_eq!(counts, [usize::from(fault.is_none())], "{animation}");
    }
}

#[test]
fn text_in_utf_16_is_read_and_told_of() {
    let text = "# Größe\no Würfel\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let reported = "the text is in UTF-16, where OBJ files are in ASCII or UTF-8";
    let units: Vec<u16> = text.encode_utf16().collect();
    let marked: Vec<u16> = [0xfeff].into_iter().chain(units.iter().copied()).collect();
    for units in [units, marked] {
        for order in [u16::to_le_bytes, u16::to_be_bytes] {
            let bytes: Vec<u8> = units.iter().copied().flat_map(order).collect();
            let scene = load(&bytes, Format::Obj).expect("a sound file");
            assert_eq!(
                (notices(&scene), scene.triangle_count()),
                (vec![reported], 1)
            );
            assert_eq!(scene.meshes[0].name, "Würfel");
        }
    }
    // A mark of UTF-8 is no part of the first word.
    let marked = [
        b"\xef\xbb\xbf",
        &text.as_bytes()["# Größe\no Würfel\n".len()..],
    ]
    .concat();
    let scene = load(&marked, Format::Obj).expect("a sound file");
    assert_eq!((notices(&scene), scene.triangle_count()), (vec![], 1));
}

#[test]
fn files_of_gltf_1_name_their_version_and_a_converter() {
    let first = |asset: &str| {
        let json = format!(
            r#"{{{asset}"scenes":{{"main":{{"nodes":["n"]}}}},"nodes":{{"n":{{}}}},"meshes":{{}},"buffers":{{}}}}"#
        );
        load(json.as_bytes(), Format::Gltf).expect_err("an old file")
    };
    let reported = |version| {
        format!("glTF version '{version}' is not supported, only 2.0 is; gltf-pipeline converts it")
    };
    assert_eq!(first(r#""asset":{"version":"1.0"},"#), reported("1.0"));
    assert_eq!(first(r#""asset":{"version":1.1},"#), reported("1.1"));
    assert_eq!(first(""), reported("1.0"));
    // Broken files of version 2 are told of as before, and later versions have no converter.
    let broken = first(r#""asset":{"version":"2.0"},"#);
    assert!(
        broken.ends_with("a value is missing or of the wrong kind"),
        "{broken}"
    );
    let later = load(br#"{"asset":{"version":"3.0"}}"#, Format::Gltf).expect_err("a later file");
    assert_eq!(later, "glTF version '3.0' is not supported, only 2.0 is");
    let container =
        load(b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0", Format::Glb).expect_err("an old file");
    assert_eq!(
        container,
        "the container has version 1, and only 2 is supported; gltf-pipeline converts it"
    );
}
