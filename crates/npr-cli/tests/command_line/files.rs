//! Files that are read and written.

use crate::workplace::Workplace;

#[test]
fn a_picture_is_named_after_its_scene_and_lies_in_the_current_folder() {
    let place = Workplace::with_scene();
    std::fs::create_dir(place.path("models")).expect("a folder");
    place.put("models/hero.v2.obj", &place.get("scene.obj"));
    place
        .render("models/hero.v2.obj", &[])
        .assert_silent_success();
    assert_eq!(place.names(), ["hero.v2.png", "models", "scene.obj"]);
    assert!(place.get("hero.v2.png").starts_with(b"\x89PNG"));
}

#[test]
fn a_missing_scene_exits_with_1() {
    let place = Workplace::new();
    place
        .render("nowhere.glb", &[])
        .assert_fault(1, "cannot read 'nowhere.glb': No such file");
    assert!(place.names().is_empty());
}

#[test]
fn a_folder_is_no_scene() {
    let place = Workplace::new();
    std::fs::create_dir(place.path("scene.glb")).expect("a folder");
    place
        .render("scene.glb", &[])
        .assert_fault(3, "'scene.glb': it is not a regular file");
}

#[test]
fn a_missing_folder_exits_with_1() {
    let place = Workplace::with_scene();
    let outcome = place.render("scene.obj", &["-o", "no/where/out.png"]);
    outcome.assert_fault(
        1,
        "cannot write 'no/where/out.png': there is no folder 'no/where'",
    );
}

#[test]
fn a_read_only_picture_is_not_replaced() {
    let place = Workplace::with_scene();
    place.put("out.png", b"keep me");
    let path = place.path("out.png");
    let mut permissions = std::fs::metadata(&path).expect("a file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).expect("the test's own file");
    place
        .render("scene.obj", &["-o", "out.png"])
        .assert_fault(1, "read-only");
    assert_eq!(place.get("out.png"), b"keep me");
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_that_takes_no_files_exits_with_1() {
    let place = Workplace::with_scene();
    place
        .render("scene.obj", &["-o", "/proc/out.png"])
        .assert_fault(1, "cannot write '/proc/out.png': ");
}

#[test]
fn a_failed_run_leaves_the_old_picture_and_nothing_beside_it() {
    let place = Workplace::new();
    place.put("scene.obj", b"v 0 0 0\nf 1 2 3\n");
    place.put("scene.png", b"the old picture");
    place
        .render("scene.obj", &[])
        .assert_fault(3, "cannot read 'scene.obj': line 2");
    assert_eq!(place.get("scene.png"), b"the old picture");
    assert_eq!(place.names(), ["scene.obj", "scene.png"]);
}

#[test]
fn an_input_is_never_written_over() {
    let place = Workplace::new();
    let scene =
        b"mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n";
    place.put("scene.obj", scene);
    place.put("scene.mtl", b"newmtl paint\nmap_Kd scene.png\n");
    let texture = tiny_png();
    place.put("scene.png", &texture);
    // The texture bears the name that the picture would have.
    place
        .render("scene.obj", &[])
        .assert_fault(2, "scene.png': it is also an input");
    let sky = ["--background", "scene.png", "-o", "./scene.png"];
    place
        .render("scene.obj", &sky)
        .assert_fault(2, "also an input");
    assert_eq!(place.get("scene.png"), texture);
    place
        .render("scene.obj", &["-o", "other.png"])
        .assert_silent_success();
}

#[test]
#[cfg(unix)]
fn a_link_to_an_input_is_an_input() {
    let place = Workplace::with_scene();
    place.put("scene.png", &place.get("scene.obj"));
    std::os::unix::fs::symlink(place.path("scene.png"), place.path("out.png")).expect("a link");
    // The content tells that the file is an OBJ, whatever its name.
    place
        .render("scene.png", &["-o", "out.png"])
        .assert_fault(2, "also an input");
}

#[test]
#[cfg(unix)]
fn a_picture_has_the_permissions_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;

    let place = Workplace::with_scene();
    place.render("scene.obj", &[]).assert_silent_success();
    place.put("any.file", b"");
    let mode = |name: &str| {
        std::fs::metadata(place.path(name))
            .expect("a file")
            .permissions()
            .mode()
    };
    assert_eq!(mode("scene.png"), mode("any.file"));
}

#[test]
fn a_scene_reads_nothing_outside_its_folder() {
    let place = Workplace::new();
    std::fs::create_dir(place.path("inner")).expect("a folder");
    let scene = br#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"../secret.bin"}]}"#;
    place.put("inner/scene.gltf", scene);
    let corners: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    place.put("secret.bin", &corners.map(f32::to_le_bytes).concat());
    let outcome = place.render("inner/scene.gltf", &[]);
    outcome.assert_fault(
        3,
        "'../secret.bin' lies outside the scene's folder; --allow-external widens it",
    );
    place
        .render("inner/scene.gltf", &["--allow-external", "."])
        .assert_silent_success();
}

/// A picture of one grey pixel.
pub fn tiny_png() -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 1, 1);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[90, 90, 90]).expect("one pixel");
    drop(writer);
    file
}
