//! Every model of the shared assets loads, is sound, and has the triangles its list says.

use std::path::{Path, PathBuf};

use npr_scene::{LoadOptions, Scene, load};

/// Triangles as stored, from the list that comes with the models.
const TRIANGLE_COUNTS: [(&str, usize); 30] = [
    ("animated_morph_cube.glb", 12),
    ("bridge_garden_scene.glb", 21_883),
    ("cad_feature_plate.glb", 3_476),
    ("cad_tray.glb", 4_520),
    ("cycloidal_drive.glb", 43_368),
    ("debug_robot_vrm1.vrm", 36),
    ("flight_helmet.glb", 94_722),
    ("fox.glb", 576),
    ("godette_vrm0.vrm", 3_439),
    ("godette_vrm1.vrm", 3_439),
    ("human_body.glb", 20_908),
    ("ingenuity_helicopter.glb", 9_060),
    ("kenney_alien.glb", 292),
    ("morph_stress_test.glb", 2_412),
    ("mtoon_uv_animation_vrm1.vrm", 6),
    ("nefertiti_70k.glb", 70_000),
    ("plane_open_boundary.glb", 16_747),
    ("rigged_figure.glb", 256),
    ("robot_animated.glb", 3_238),
    ("shader_ball.glb", 63_856),
    ("skull_400k.glb", 400_008),
    ("spot_textured.glb", 5_856),
    ("stanford_bunny.glb", 69_451),
    ("suzanne.glb", 3_936),
    ("utah_teapot.glb", 6_320),
    ("water_bottle.glb", 4_510),
    ("wingnut_flat.glb", 6_090),
    ("formats/cad_feature_plate_binary.stl", 3_476),
    ("formats/cycloidal_drive_binary.ply", 43_368),
    ("formats/spot_control_mesh_quads.obj", 372),
];

pub fn models() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/models");
    if !folder.is_dir() {
        eprintln!("skipped: the shared models are not beside this checkout");
        return None;
    }
    Some(folder)
}

pub fn loaded(folder: &Path, name: &str) -> Scene {
    let scene = load(&folder.join(name), &LoadOptions::default());
    let scene = scene.unwrap_or_else(|fault| panic!("{name}: {fault}"));
    scene.sanity_check();
    scene
}

#[test]
fn triangles_are_as_many_as_listed() {
    let Some(folder) = models() else { return };
    for (name, count) in TRIANGLE_COUNTS {
        assert_eq!(loaded(&folder, name).triangle_count(), count, "{name}");
    }
}

#[test]
fn the_list_leaves_no_model_out() {
    let Some(folder) = models() else { return };
    let entries = [folder.clone(), folder.join("formats")]
        .into_iter()
        .flat_map(|folder| {
            std::fs::read_dir(folder)
                .expect("a folder")
                .map(|entry| entry.expect("an entry").path())
        });
    for path in entries.filter(|path| path.is_file()) {
        let name = path
            .strip_prefix(&folder)
            .expect("below the folder")
            .to_string_lossy()
            .into_owned();
        assert!(
            TRIANGLE_COUNTS.iter().any(|(listed, _)| *listed == name),
            "{name} is not listed"
        );
    }
}

#[test]
fn both_versions_of_an_avatar_face_the_same_way() {
    let Some(folder) = models() else { return };
    let [old, new] = ["godette_vrm0.vrm", "godette_vrm1.vrm"].map(|name| loaded(&folder, name));
    let (old, new) = (
        old.bounds_world().expect("drawn"),
        new.bounds_world().expect("drawn"),
    );
    for (a, b) in [(old.0, new.0), (old.1, new.1)] {
        assert!(
            a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3),
            "{a:?} and {b:?}"
        );
    }
}

#[test]
fn only_base_color_images_are_decoded() {
    let Some(folder) = models() else { return };
    let helmet = loaded(&folder, "flight_helmet.glb");
    assert_eq!(helmet.images.len(), 5, "of fifteen in the file");
    assert!(
        helmet
            .images
            .iter()
            .all(|image| image.rgba.len() == (image.width * image.height * 4) as usize)
    );
    assert!(
        loaded(&folder, "suzanne.glb").materials[0]
            .base_color_texture
            .is_some()
    );
}

#[test]
fn an_instanced_mesh_is_stored_once() {
    let Some(folder) = models() else { return };
    let robot = loaded(&folder, "debug_robot_vrm1.vrm");
    let drawn = robot.nodes.iter().filter_map(|node| node.mesh);
    let triangles = drawn
        .flat_map(|mesh| &robot.meshes[mesh as usize].parts)
        .map(|part| part.triangles.len());
    assert_eq!(triangles.sum::<usize>(), 792);
}

#[test]
fn clips_and_skins_are_found() {
    let Some(folder) = models() else { return };
    let fox = loaded(&folder, "fox.glb");
    assert_eq!(fox.skins[0].joints.len(), 24);
    let clips = fox
        .clips
        .iter()
        .map(|clip| (clip.name.as_str(), clip.channels.len()));
    let wanted = [("Survey", 21), ("Walk", 21), ("Run", 21)];
    assert_eq!(clips.collect::<Vec<_>>(), wanted);
    assert_eq!(fox.notices, []);
    let cube = loaded(&folder, "animated_morph_cube.glb");
    assert_eq!(cube.meshes[0].parts[0].morphs.len(), 2);
}
