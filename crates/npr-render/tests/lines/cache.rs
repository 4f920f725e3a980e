//! What is costly to prepare, kept between runs: how surfaces bend, where they cut each other, how strokes of hatching
//! lie.

use crate::scenes::{SIZE, add, camera_at, model_of, scene_of};
use npr_gpu::processor::Processor;
use npr_mesh::testing::{cube, icosphere, mapped};
use npr_render::{
    Drawing, LineModel, LineModelOptions, LineOptions, Model, Renderer, RendererOptions,
};
use npr_scene::Scene;
use npr_stylesheet::Style;
use std::path::{Path, PathBuf};

fn cached(scene: &Scene, folder: &Path) -> Drawing {
    let model = LineModel::cached(scene, &LineModelOptions::default(), folder).expect("small");
    draw(&model)
}

fn draw(model: &LineModel) -> Drawing {
    let options = LineOptions::new(SIZE);
    model
        .draw(&camera_at([3.0, 2.0, 5.0]), &Style::default(), &options)
        .expect("drawn")
}

fn files_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    paths
}

#[test]
fn a_kept_surface_draws_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut scene = scene_of(&icosphere(3));
    add(
        &mut scene,
        "box",
        &mapped(&cube(), |[x, y, z]| [x + 1.0, y, z]),
    );
    let fresh = draw(&model_of(&scene));
    assert_eq!(cached(&scene, folder.path()), fresh);
    let files = files_in(folder.path());
    assert_eq!(files.len(), 2, "bends and intersections");
    for file in &files {
        assert_eq!(file.extension().expect("an ending"), "nprcache");
    }
    assert_eq!(cached(&scene, folder.path()), fresh);
    assert_eq!(files_in(folder.path()), files);

    // What is not part of the surface may change without making it anew.
    scene.nodes[0].name = "renamed".to_owned();
    scene.materials[0].base_color = [0.5; 4];
    let renamed = cached(&scene, folder.path());
    assert_eq!(renamed.surfaces[0].object, "renamed");
    assert_eq!(files_in(folder.path()), files);

    scene.meshes[0].parts[0].positions[0][0] += 0.5;
    cached(&scene, folder.path());
    assert_eq!(files_in(folder.path()).len(), 4);
}

#[test]
#[expect(clippy::disallowed_methods, reason = "damages its own file")]
fn a_damaged_file_is_made_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene_of(&icosphere(2));
    let fresh = cached(&scene, folder.path());
    let files = files_in(folder.path());
    assert_eq!(files.len(), 2);
    for file in files {
        let sound = std::fs::read(&file).expect("the file");
        let flips = (0..sound.len()).step_by(1 + sound.len() / 50).map(|at| {
            let mut flipped = sound.clone();
            flipped[at] ^= 0x10;
            flipped
        });
        let cuts = [0, 8, 64, sound.len() / 2].map(|length| sound[..length].to_vec());
        for damaged in flips.chain(cuts) {
            std::fs::write(&file, damaged).expect("the test's own file");
            assert_eq!(cached(&scene, folder.path()), fresh);
            assert_eq!(std::fs::read(&file).expect("the file"), sound);
        }
    }
}

#[test]
fn frames_keep_bends_and_the_charts_of_their_hatching() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene_of(&icosphere(3));
    let style = Style::preset("crosshatch").expect("a preset");
    let frame = |folder: Option<&Path>| {
        let model = Model::cached(&scene, folder).expect("small");
        let options = RendererOptions::new(SIZE);
        let mut renderer = Renderer::new(&Processor, &model, &style, &options).expect("prepared");
        renderer
            .draw(&camera_at([3.0, 2.0, 5.0]))
            .expect("drawn")
            .rgba
    };
    let fresh = frame(None);
    assert!(frame(Some(folder.path())) == fresh);
    let files = files_in(folder.path());
    assert_eq!(files.len(), 3, "bends, calm normals and charts");
    assert!(frame(Some(folder.path())) == fresh);
    assert_eq!(files_in(folder.path()), files);
}

#[test]
fn a_folder_that_does_not_work_spoils_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = scene_of(&cube());
    let fresh = draw(&model_of(&scene));
    assert_eq!(cached(&scene, &folder.path().join("missing")), fresh);
    assert_eq!(cached(&scene, Path::new("/proc")), fresh);
    assert!(files_in(folder.path()).is_empty());
}
