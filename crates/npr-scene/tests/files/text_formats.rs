//! What is read from OBJ, STL and PLY files, and what is refused.

use npr_core::color::linear_from_srgb;
use npr_scene::testing::Sheet;
use npr_scene::{AlphaMode, Limits, MemoryResources, Scene, SceneError, load_bytes};

fn load_with(bytes: &[u8], resources: &MemoryResources) -> Result<Scene, SceneError> {
    let scene = load_bytes("test", bytes, None, resources, &Limits::default())?;
    scene.sanity_check();
    Ok(scene)
}

fn load(bytes: &[u8]) -> Result<Scene, SceneError> {
    load_with(bytes, &MemoryResources::default())
}

fn fault_of(text: &str) -> String {
    load(text.as_bytes())
        .expect_err("a broken file")
        .to_string()
}

#[test]
fn every_format_gives_back_the_same_triangles() {
    let sheet = Sheet::new(4);
    let corners = |scene: &Scene| -> Vec<[f32; 3]> {
        let part = &scene.meshes[0].parts[0];
        part.triangles
            .iter()
            .flatten()
            .map(|&vertex| part.positions[vertex as usize])
            .collect()
    };
    let expected = corners(&load(&sheet.glb()).expect("a sound file"));
    let files = [
        sheet.obj(),
        sheet.stl(),
        sheet.stl_text(),
        sheet.ply(),
        sheet.ply_big_endian(),
        sheet.ply_text(),
    ];
    for (index, file) in files.iter().enumerate() {
        let scene = load(file).expect("a sound file");
        assert_eq!(corners(&scene), expected, "file {index}");
        assert!(scene.materials.iter().all(|material| material.double_sided));
    }
}

#[test]
fn groups_become_meshes_and_materials_become_parts() {
    let text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\no left\nusemtl red\nf 1 2 3\n\
        o right\nf 2 4 3\nusemtl glass\nf -3 -1 -2\no left\nusemtl red\nf 1 3 2\n";
    let library = b"newmtl red\nKd 1 0.5 0\nnewmtl glass\nd 0.25\n".to_vec();
    let resources = MemoryResources {
        files: [("a.mtl".to_owned(), library)].into(),
    };
    let scene = load_with(text.as_bytes(), &resources).expect("a sound file");
    let shape: Vec<_> = scene
        .meshes
        .iter()
        .map(|mesh| (mesh.name.as_str(), mesh.parts.len()))
        .collect();
    assert_eq!(shape, [("left", 1), ("right", 2)]);
    assert_eq!(scene.meshes[0].parts[0].triangles.len(), 2);
    assert_eq!(
        scene.materials[0].base_color,
        [1.0, linear_from_srgb(0.5), 0.0, 1.0]
    );
    assert_eq!(
        (scene.materials[1].base_color[3], scene.materials[1].alpha),
        (0.25, AlphaMode::Blend)
    );
}

#[test]
fn corners_that_differ_in_texture_or_normal_are_vertices_of_their_own() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvn 0 0 1\nf 1/1/1 2/1/1 3/2/1\nf 1/2/1 2/1/1 3/2/1\n";
    let scene = load(text.as_bytes()).expect("a sound file");
    let part = &scene.meshes[0].parts[0];
    assert_eq!(part.triangles, [[0, 1, 2], [3, 1, 2]]);
    assert_eq!(
        part.uvs.as_ref().expect("coordinates")[2],
        [1.0, 0.75],
        "v is measured from above"
    );
    assert!(part.normals.is_some());
}

#[test]
fn continued_lines_comments_and_carriage_returns_are_read() {
    let scene =
        load(b"v 0 0 0\r\nv 1 0 0 # second\r\nv 0 1 0\r\nf 1 2 \\\r\n3\r\n").expect("a sound file");
    assert_eq!(scene.triangle_count(), 1);
}

#[test]
fn faults_of_obj_files_name_line_and_face() {
    let cases = [
        ("v 0 0\n", "line 1: a vertex needs 3 numbers"),
        ("v 0 0 0\nf 1 1\n", "line 2: face 1 has only 2 corners"),
        (
            "v 0 0 0\nf 1 2 1\n",
            "line 2: face 1 uses vertex 2, but only 1 are defined so far, counted from 1",
        ),
        (
            "v 0 0 0\nf 1 x 1\n",
            "line 2: face 1 has the corner 'x', which is no index",
        ),
        (
            "v 0 0 0\nf 1 /1 1\n",
            "line 2: face 1 uses texture coordinate 1, but only 0 are defined so far, counted from 1",
        ),
    ];
    for (text, message) in cases {
        assert_eq!(fault_of(text), message);
    }
}

#[test]
fn a_missing_library_is_a_notice() {
    let scene =
        load(b"mtllib gone.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\n").expect("drawable");
    assert!(
        scene.notices[0].text.contains("'gone.mtl'"),
        "{:?}",
        scene.notices
    );
    assert_eq!(scene.materials[0].name, "x");
}

#[test]
fn ply_colors_become_linear_and_polygons_fans() {
    let text = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n\
        0 0 0 255 0 0\n1 0 0 255 0 0\n1 1 0 255 0 0\n0 1 0 255 0 0\n4 0 1 2 3\n";
    let scene = load(text.as_bytes()).expect("a sound file");
    let part = &scene.meshes[0].parts[0];
    assert_eq!(part.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(
        part.colors.as_ref().expect("colours")[0],
        [1.0, 0.0, 0.0, 1.0]
    );
    assert_eq!(
        fault_of(&text.replace("4 0 1 2 3", "3 0 1 9")),
        "face 0 uses vertex 9, but the file has only 4"
    );
    assert_eq!(
        fault_of(&text.replace("4 0 1 2 3", "9 0 1")),
        "face 0 of 1 is cut off or holds no number"
    );
}

#[test]
fn a_ply_element_without_properties_does_not_hang() {
    let text = "ply\nformat ascii 1.0\nelement dust 18446744073709551615\nend_header\n";
    assert_eq!(
        load(text.as_bytes())
            .expect("an empty scene")
            .triangle_count(),
        0
    );
}

#[test]
fn faults_of_stl_files_are_named() {
    assert_eq!(
        fault_of("solid\nvertex 0 0\n"),
        "line 2: a vertex needs three numbers"
    );
    assert_eq!(
        fault_of("solid\nvertex 0 0 0\nendloop\n"),
        "line 3: a facet has fewer than three corners"
    );
    let mut file = Sheet::new(2).stl();
    file.truncate(200);
    let fault = load_bytes(
        "x",
        &file,
        Some(npr_scene::Format::Stl),
        &MemoryResources::default(),
        &Limits::default(),
    );
    let message = "the header announces 8 triangles, but the file holds only 2";
    assert_eq!(fault.expect_err("cut").to_string(), message);
}
