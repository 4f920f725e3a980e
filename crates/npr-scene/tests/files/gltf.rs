//! What is read from glTF files, and what is refused, one small file per point.

use npr_scene::testing::{Sheet, glb, skinned_glb, sparse_glb};
use npr_scene::{
    AlphaMode, Format, LightKind, Limits, MemoryResources, Projection, Scene, SceneError, Wrap,
    load_bytes,
};

fn load(bytes: &[u8]) -> Result<Scene, SceneError> {
    let scene = load_bytes(
        "test",
        bytes,
        None,
        &MemoryResources::default(),
        &Limits::default(),
    )?;
    scene.sanity_check();
    Ok(scene)
}

fn load_json(rest: &str) -> Result<Scene, SceneError> {
    load(format!(r#"{{"asset":{{"version":"2.0"}},{rest}}}"#).as_bytes())
}

fn fault_of(rest: &str) -> String {
    load_json(rest).expect_err("a broken file").to_string()
}

/// A triangle of 36 bytes, with `mesh` properties of its primitive and further properties of the file.
fn load_triangle(primitive: &str, rest: &str) -> Result<Scene, SceneError> {
    let bin: Vec<u8> = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.]
        .into_iter()
        .flat_map(f32::to_le_bytes)
        .collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}{primitive}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36}}]{rest}}}"#
    );
    load(&glb(&json, &bin))
}

#[test]
fn a_sheet_comes_back_as_it_was_made() {
    let sheet = Sheet::new(5);
    let scene = load(&sheet.glb()).expect("a sound file");
    assert_eq!(scene.meshes[0].parts[0].positions, sheet.positions);
    assert_eq!(scene.meshes[0].parts[0].triangles, sheet.triangles);
    assert_eq!(
        (scene.name.as_str(), scene.nodes[0].name.as_str()),
        ("test", "sheet")
    );
    assert_eq!(scene.bounds_world().expect("drawn").0, [0.0, 1.0, 0.0]);
}

#[test]
fn a_skin_finds_its_joints_and_weights_sum_to_one() {
    let scene = load(&skinned_glb()).expect("a sound file");
    let part = &scene.meshes[0].parts[0];
    assert_eq!(
        part.weights.as_ref().expect("weights")[0],
        [0.25, 0.75, 0.0, 0.0]
    );
    assert_eq!(scene.skins[0].joints, [1, 2]);
    assert_eq!(
        part.positions[0],
        [0.0, 0.0, 1.0],
        "half of the morph target"
    );
    assert_eq!(
        scene.positions_world(&scene.nodes[0], part)[0],
        [0.0, 0.75, 1.0]
    );
}

#[test]
fn sparse_elements_replace_those_of_the_view() {
    let scene = load(&sparse_glb()).expect("a sound file");
    assert_eq!(scene.meshes[0].parts[0].positions[1], [9.0; 3]);
}

#[test]
fn quantised_and_interleaved_positions_are_read() {
    // Two bytes of filler follow each vertex of three normalised signed bytes and one of padding.
    let bin = [
        0i8, 0, 0, 0, 9, 9, 127, 0, 0, 0, 9, 9, 0, -127, -128, 0, 9, 9,
    ]
    .map(|v| v as u8);
    let json = r#"{"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],
        "scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5120,"normalized":true,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":18,"byteStride":6}],"buffers":[{"byteLength":18}]}"#;
    let scene = load(&glb(json, &bin)).expect("a sound file");
    assert_eq!(
        scene.meshes[0].parts[0].positions,
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, -1.0, -1.0]]
    );
}

#[test]
fn bounds_of_accessors_views_and_buffers_are_kept() {
    let view = r#","materials":[],"bufferViews":[{"buffer":0,"byteLength":40}]"#;
    let fault = load_triangle("", &view.replace("bufferViews", "ignored"));
    assert!(fault.is_ok());
    let cases = [
        (
            r#""byteLength":36}],"buffers""#,
            r#""byteLength":40}],"buffers""#,
            "buffer view 0 ends at byte 40, but buffer 0 has only 36",
        ),
        (
            r#""count":3"#,
            r#""count":4"#,
            "accessor 0 ends at byte 48, but buffer view 0 has only 36",
        ),
        (
            r#""buffers":[{"byteLength":36}]"#,
            r#""buffers":[{"byteLength":99}]"#,
            "buffer 0 should have 99 bytes, but only 36 are there",
        ),
        (
            r#""mesh":0"#,
            r#""mesh":7"#,
            "node 0 uses mesh 7, but the file has only 1",
        ),
        (
            r#""nodes":[0]}"#,
            r#""nodes":[5]}"#,
            "scene 0 uses node 5, but the file has only 1",
        ),
        (
            r#""type":"VEC3""#,
            r#""type":"VEC2""#,
            "mesh 0 needs numbers from accessor 0, which holds something else",
        ),
    ];
    let sound = concat!(
        r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"#,
        r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"#,
        r#""accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"#,
        r#""bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}"#,
    );
    for (from, to, message) in cases {
        let fault = load(&glb(&sound.replace(from, to), &[0; 36])).expect_err(message);
        assert_eq!(fault.to_string(), message);
        assert!(!fault.is_limit());
    }
}

#[test]
fn a_chain_of_200000_nodes_is_walked() {
    let count = 200_000;
    let links = (1..count).map(|child| format!(r#"{{"children":[{child}]}},"#));
    let nodes: String = links.chain(["{}".to_owned()]).collect();
    let scene = load_json(&format!(r#""scenes":[{{"nodes":[0]}}],"nodes":[{nodes}]"#))
        .expect("a sound file");
    assert_eq!(scene.nodes.len(), count);
}

#[test]
fn cycles_and_shared_children_are_refused() {
    let cycle = fault_of(r#""scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}]"#);
    assert_eq!(cycle, "node 0 is reached twice: nodes must form a tree");
    let shared =
        fault_of(r#""scenes":[{"nodes":[0,1]}],"nodes":[{"children":[2]},{"children":[2]},{}]"#);
    assert_eq!(shared, "node 2 is reached twice: nodes must form a tree");
}

#[test]
fn only_the_default_scene_is_loaded() {
    let scenes = concat!(
        r#""scene":1,"scenes":[{"nodes":[0]},{"name":"second","nodes":[1]}],"#,
        r#""nodes":[{"name":"a"},{"name":"b"}]"#,
    );
    let scene = load_json(scenes).expect("a sound file");
    assert_eq!(
        (
            scene.name.as_str(),
            scene.nodes.len(),
            scene.nodes[0].name.as_str()
        ),
        ("second", 1, "b")
    );
}

#[test]
fn a_transform_out_of_range_draws_nothing() {
    let nodes = r#""scenes":[{"nodes":[0]}],"nodes":[{"scale":[1e30,1,1],"children":[1]},{"scale":[1e30,1,1]}]"#;
    let scene = load_json(nodes).expect("a sound file");
    assert!(
        scene.notices[0].text.contains("transform out of range"),
        "{:?}",
        scene.notices
    );
}

#[test]
fn cameras_and_lights_stand_at_their_nodes() {
    let scene = load_json(
        r#""scenes":[{"nodes":[0,1,2]}],"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}},
        {"type":"perspective","perspective":{"yfov":9,"znear":0.1}}],
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{"outerConeAngle":0.5}}]}},
        "nodes":[{"camera":0},{"extensions":{"KHR_lights_punctual":{"light":0}}},{"camera":1}]"#,
    );
    let scene = scene.expect("a sound file");
    let camera = &scene.cameras[scene.nodes[0].camera.expect("a camera") as usize];
    assert_eq!(
        camera.projection,
        Projection::Perspective {
            yfov: 0.5,
            znear: 0.1,
            zfar: None,
            aspect: None
        }
    );
    let light = &scene.lights[scene.nodes[1].light.expect("a light") as usize];
    assert_eq!(
        light.kind,
        LightKind::Spot {
            inner: 0.0,
            outer: 0.5
        }
    );
    assert_eq!(
        scene.nodes[2].camera, None,
        "a field of view of 9 radians is none"
    );
}

#[test]
fn materials_keep_color_alpha_and_texture() {
    let pixel = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGAhKmMIQAAAABJRU5ErkJggg==";
    let rest = format!(
        r#","images":[{{"uri":"data:image/png;base64,{pixel}"}},{{"uri":"normal.png"}}],
        "samplers":[{{"wrapS":33071,"wrapT":33648}}],"textures":[{{"source":0,"sampler":0}},{{"source":1}}],
        "materials":[{{"alphaMode":"MASK","normalTexture":{{"index":1}},
        "pbrMetallicRoughness":{{"baseColorFactor":[1,0.5,0,1],"baseColorTexture":{{"index":0,
        "extensions":{{"KHR_texture_transform":{{"scale":[2,3]}}}}}}}}}}]"#
    );
    let scene = load_triangle(r#","material":0"#, &rest).expect("a sound file");
    let material = &scene.materials[0];
    assert_eq!(
        (material.base_color, material.alpha),
        ([1.0, 0.5, 0.0, 1.0], AlphaMode::Mask(0.5))
    );
    let texture = material.base_color_texture.as_ref().expect("a texture");
    assert_eq!(
        (texture.wrap, texture.transform.scale),
        ([Wrap::Clamp, Wrap::Mirror], [2.0, 3.0])
    );
    assert_eq!((scene.images.len(), scene.images[0].width), (1, 1));
}

#[test]
fn a_texture_that_says_what_is_metal_leaves_factors_open() {
    let material = |metal: &str| {
        let factors = format!(r#""metallicFactor":1,"roughnessFactor":0.8{metal}"#);
        let rest =
            format!(r#","textures":[{{}}],"materials":[{{"pbrMetallicRoughness":{{{factors}}}}}]"#);
        let scene = load_triangle(r#","material":0"#, &rest).expect("a sound file");
        (scene.materials[0].metallic, scene.materials[0].roughness)
    };
    assert_eq!(material(""), (1.0, 0.8));
    assert_eq!(
        material(r#","metallicRoughnessTexture":{"index":0}"#),
        (0.5, 0.4)
    );
}

#[test]
fn a_broken_image_leaves_the_factor() {
    let rest = r#","images":[{"uri":"data:image/png;base64,AAAA"}],"textures":[{"source":0}],
        "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0,1,0,1],"baseColorTexture":{"index":0}}}]"#;
    let scene = load_triangle(r#","material":0"#, rest).expect("a file that can be drawn");
    assert_eq!(scene.materials[0].base_color_texture, None);
    assert!(
        scene
            .notices
            .iter()
            .any(|notice| notice.text.starts_with("image 0")),
        "{:?}",
        scene.notices
    );
}

#[test]
fn external_buffers_come_from_resources_and_from_nowhere_else() {
    let json = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":2,"uri":"a%20b.bin"}]}"#;
    let mut resources = MemoryResources::default();
    let load = |json: &str, resources: &MemoryResources| {
        load_bytes(
            "test",
            json.as_bytes(),
            Some(Format::Gltf),
            resources,
            &Limits::default(),
        )
    };
    assert_eq!(
        load(json, &resources).expect_err("absent").to_string(),
        "cannot read 'a b.bin': no such file"
    );
    resources.files.insert("a b.bin".to_owned(), vec![1, 2]);
    assert!(load(json, &resources).is_ok());
    let remote = json.replace("a%20b.bin", "https://example.com/a.bin");
    assert!(
        load(&remote, &resources)
            .expect_err("remote")
            .to_string()
            .contains("no relative path")
    );
}

#[test]
fn limits_are_told_apart_from_faults() {
    let sheet = Sheet::new(10).glb();
    let cases = [
        Limits {
            triangles: 100,
            ..Limits::default()
        },
        Limits {
            nodes: 0,
            ..Limits::default()
        },
        Limits {
            json_bytes: 100,
            ..Limits::default()
        },
        Limits {
            file_bytes: 100,
            ..Limits::default()
        },
        Limits {
            memory_bytes: 100,
            ..Limits::default()
        },
    ];
    for limits in cases {
        let fault = load_bytes("sheet", &sheet, None, &MemoryResources::default(), &limits);
        let fault = fault.expect_err("over a limit");
        assert!(
            fault.is_limit() && fault.to_string().contains("--"),
            "{fault}"
        );
    }
}

#[test]
fn an_empty_file_of_each_kind_is_told_so() {
    assert_eq!(load(b"").expect_err("nothing"), SceneError::UnknownFormat);
    let scene = load_json(r#""scenes":[{}],"scene":0"#).expect("an empty scene");
    assert!(scene.nodes.is_empty() && scene.bounds_world().is_none());
}

#[test]
fn the_user_marks_vertices_and_materials_for_lines() {
    let corners = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.];
    let bin: Vec<u8> = corners
        .into_iter()
        .chain([1.0, 0.0, 0.6])
        .flat_map(f32::to_le_bytes)
        .collect();
    let json = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"_NPR_LINE":1,"_OTHER":1},"material":1}]}],
        "materials":[{"extras":{"npr":{"lines":1}}},{"extras":{"npr":{"lines":true}}},{"extras":[5]},{"extras":"x"}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
            {"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12}],
        "buffers":[{"byteLength":48}]}"#;
    let scene = load(&glb(json, &bin)).expect("a sound file");
    let marks = scene.meshes[0].parts[0].marks.as_deref();
    assert_eq!(marks, Some(&[true, false, true][..]));
    let marked: Vec<bool> = scene.materials.iter().map(|m| m.marked).collect();
    assert_eq!(marked, [false, true, false, false]);

    let short = json.replace(
        r#""count":3,"type":"SCALAR""#,
        r#""count":2,"type":"SCALAR""#,
    );
    assert!(load(&glb(&short, &bin)).is_err());
}

#[test]
fn directions_of_strokes_are_read_and_unsound_ones_left_out() {
    let corners = [0f32, 0., 0., 1., 0., 0., 0., 1., 0.];
    let json = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"_DIRECTION":1}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},
            {"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36}],
        "buffers":[{"byteLength":72}]}"#;
    let directions_of = |directions: [f32; 9]| {
        let floats = corners.into_iter().chain(directions);
        let bin: Vec<u8> = floats.flat_map(f32::to_le_bytes).collect();
        let scene = load(&glb(json, &bin)).expect("a sound file");
        scene.meshes[0].parts[0].directions.clone()
    };
    let painted = [0., 1., 0., 0., 0., 2., 0., 0., 0.];
    let wanted = vec![[0., 1., 0.], [0., 0., 2.], [0.; 3]];
    assert_eq!(directions_of(painted), Some(wanted));
    assert_eq!(directions_of([f32::NAN; 9]), None);
}

#[test]
fn images_stay_closed_where_nobody_wants_them() {
    #[derive(Default)]
    struct Heard(std::cell::RefCell<Vec<String>>);
    impl npr_scene::Resources for Heard {
        fn read(&self, name: &str, _: u64) -> Result<Vec<u8>, npr_scene::ResourceError> {
            panic!("'{name}' is read");
        }
        fn mention(&self, name: &str) {
            self.0.borrow_mut().push(name.to_owned());
        }
    }
    let limits = Limits {
        decode_images: false,
        images_bytes: 0,
        ..Limits::default()
    };
    let bin: Vec<u8> = [0f32; 9].into_iter().flat_map(f32::to_le_bytes).collect();
    let json = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
        "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
        "textures":[{"source":0}],"images":[{"uri":"skin%20a.png"}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}"#;
    let heard = Heard::default();
    let scene = load_bytes("test", &glb(json, &bin), None, &heard, &limits).expect("a sound file");
    scene.sanity_check();
    assert!(scene.images.is_empty() && scene.notices.is_empty());
    assert_eq!(heard.0.into_inner(), ["skin a.png"]);
}
