//! Files that are dropped on the window.

use super::*;
use egui::DroppedFile;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Debug)]
struct Dropped(PathBuf);

impl DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("only the path counts".to_owned())
    }
}

/// A studio that shows a scene of a name, and its host.
fn showing(scene: &str) -> (Harness<'static, Studio>, Easel) {
    let (mut harness, easel) = studio([1000.0, 640.0], &[]);
    let news = News::Scene(scene.to_owned(), Box::default());
    easel.0.borrow_mut().news.push(news);
    harness.run();
    (harness, easel)
}

fn drop_files(harness: &mut Harness<'_, Studio>, paths: &[&str]) {
    for path in paths {
        let file = Arc::new(Dropped(PathBuf::from(path)));
        harness.input_mut().dropped_files.push(file);
    }
    harness.run();
}

fn click(harness: &mut Harness<'_, Studio>, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    harness.run();
}

#[test]
fn a_picture_is_what_the_user_says() {
    for (label, key) in [
        ("Background", "background"),
        ("Brush of lines", "line.brush.image"),
        ("Hatching", "ink.hatch.image"),
        ("Ramp of tones", "shade.ramp_image"),
    ] {
        let (mut harness, easel) = showing("a.glb");
        drop_files(&mut harness, &["/b/my sky.png"]);
        click(&mut harness, label);
        let orders = |easel: &Easel| easel.0.borrow().orders.last().unwrap().overrides.clone();
        assert_eq!(orders(&easel), [format!("{key}=/b/my sky.png")]);

        // It is a change as any other.
        harness.get_by_label("Undo").click();
        harness.run();
        assert_eq!(orders(&easel), [""; 0]);
        assert_eq!(easel.0.borrow().opened, [""; 0]);
        assert!(harness.query_by_label("Cancel").is_none());
    }
}

#[test]
fn smoke_stands_in_the_scene_until_it_is_taken_out() {
    let (mut harness, easel) = showing("a.glb");
    drop_files(&mut harness, &["/b/a.vdb", "/b/c.vdb"]);
    click(&mut harness, "Smoke in this scene");
    click(&mut harness, "Smoke in this scene");
    let volumes = |easel: &Easel| easel.0.borrow().orders.last().unwrap().pose.volumes.clone();
    assert_eq!(volumes(&easel), ["/b/a.vdb", "/b/c.vdb"]);
    let command = easel.command(&harness.state().order());
    assert!(
        command.ends_with("--volume=/b/a.vdb --volume=/b/c.vdb"),
        "{command}"
    );

    // Take one out, and bring it back.
    harness.get_by_label("Smoke in the scene").click();
    harness.run();
    click(&mut harness, "take out /b/a.vdb");
    assert_eq!(volumes(&easel), ["/b/c.vdb"]);
    for (label, wanted) in [
        ("Undo", &["/b/a.vdb", "/b/c.vdb"][..]),
        ("Undo", &["/b/a.vdb"]),
        ("Undo", &[]),
        ("Redo", &["/b/a.vdb"]),
    ] {
        click(&mut harness, label);
        assert_eq!(volumes(&easel), wanted);
    }

    // Another scene has none of it.
    let news = News::Scene("b.glb".to_owned(), Box::default());
    easel.0.borrow_mut().news.push(news);
    harness.run();
    assert_eq!(volumes(&easel), [""; 0]);
    assert_eq!(easel.0.borrow().opened, [""; 0]);
}

#[test]
fn smoke_is_a_scene_of_its_own_where_the_user_says_so_or_there_is_no_other() {
    let (mut harness, easel) = showing("a.glb");
    drop_files(&mut harness, &["/b/a.vdb"]);
    click(&mut harness, "A scene of its own");
    assert_eq!(easel.0.borrow().opened, ["/b/a.vdb"]);
    let (mut harness, easel) = showing("a.vdb");
    drop_files(&mut harness, &["/b/c.vdb", "/b/d.glb"]);
    assert_eq!(easel.0.borrow().opened, ["/b/c.vdb", "/b/d.glb"]);
}

#[test]
fn nothing_is_done_with_a_file_that_is_left() {
    for by_key in [false, true] {
        let (mut harness, easel) = showing("a.glb");
        let before = easel.0.borrow().orders.len();
        drop_files(&mut harness, &["/b/a.png"]);
        match by_key {
            true => {
                harness.key_press(Key::Escape);
                harness.run();
            }
            false => click(&mut harness, "Cancel"),
        }
        assert!(harness.query_by_label("Cancel").is_none());
        assert_eq!(easel.0.borrow().orders.len(), before);
    }
}

#[test]
fn smoke_without_a_file_stands_beside_what_the_view_turns_about() {
    let (mut harness, easel) = showing("a.glb");
    harness.get_by_label("Smoke in the scene").click();
    harness.run();
    harness.get_by_label("Add smoke").click();
    harness.run();
    harness.get_by_label("plume").click();
    harness.run();
    let volumes = |easel: &Easel| easel.0.borrow().orders.last().unwrap().pose.volumes.clone();
    // The view is 3.64 high there.
    assert_eq!(volumes(&easel), ["plume@1.27,-0.91,0*1.82"]);

    // What it is and where it stands is a text to change.
    harness.get_by_label("smoke in the scene 1").focus();
    harness.run();
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text("cloud@0,0,0".to_owned()));
    harness.run();
    assert_eq!(volumes(&easel), ["plume@1.27,-0.91,0*1.82"]);
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(volumes(&easel), ["cloud@0,0,0"]);
    click(&mut harness, "Undo");
    assert_eq!(volumes(&easel), ["plume@1.27,-0.91,0*1.82"]);
}

#[test]
fn smoke_alone_takes_no_other_smoke() {
    for (scene, count) in [("a.vdb", 0), ("a.glb", 1)] {
        let (mut harness, _) = showing(scene);
        harness.state_mut().search("volume source");
        harness.run();
        assert_eq!(harness.query_all_by_label("Add smoke").count(), count);
    }
}
