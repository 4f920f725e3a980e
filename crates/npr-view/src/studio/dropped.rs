//! Files that are dropped on the window: styles and scenes are opened, and of pictures and smoke it is asked what they
//! are for.

use egui::{Button, Id, Modal, RichText, Ui};
use toml::Value;

use super::Studio;
use crate::host::FileKind;
use crate::panel::Edit;

/// What a picture can be for: the key that takes its path, and its words.
const PICTURE_USES: [(&str, &str); 4] = [
    ("background", "Background"),
    ("line.brush.image", "Brush of lines"),
    ("ink.hatch.image", "Hatching"),
    ("shade.ramp_image", "Ramp of tones"),
];

/// What is done with a file.
enum Choice {
    /// Its path becomes the value of a key.
    Key(&'static str),
    /// It is smoke in the scene.
    Smoke,
    /// It is opened in place of the scene.
    Open,
    /// Nothing.
    Leave,
}

impl Studio {
    /// Takes files that are dropped on the window.
    pub(super) fn take_dropped(&mut self, ui: &Ui) {
        let dropped = ui.input(|input| input.raw.dropped_files.clone());
        for file in dropped {
            let path = file.path().to_string_lossy().into_owned();
            match self.host.kind(&path) {
                FileKind::Style => self.take_style(&path, ui),
                FileKind::Picture => self.dropped.push((path, FileKind::Picture)),
                FileKind::Volume if self.holds_surfaces() => {
                    self.dropped.push((path, FileKind::Volume));
                }
                FileKind::Volume | FileKind::Scene => self.host.open(&path),
            }
        }
    }

    /// Whether a scene is shown that is no smoke alone.
    pub(super) fn holds_surfaces(&self) -> bool {
        !self.scene.is_empty() && self.host.kind(&self.scene) != FileKind::Volume
    }

    /// Asks what the first of the dropped files is for, and does it.
    pub(super) fn show_dropped(&mut self, ui: &Ui) {
        // Ask.
        let Some((path, kind)) = self.dropped.first().cloned() else {
            return;
        };
        let mut chosen = None;
        let modal = Modal::new(Id::unique("dropped file")).show(ui.ctx(), |ui| {
            let name = path.rsplit(['/', '\\']).next().unwrap_or(&path);
            ui.label(RichText::new(format!("Use {name} as")).strong());
            ui.add_space(4.0);
            let mut offer = |ui: &mut Ui, text: &str, choice: Choice| {
                if ui
                    .add(Button::new(text).min_size(egui::vec2(180.0, 0.0)))
                    .clicked()
                {
                    chosen = Some(choice);
                }
            };
            match kind {
                FileKind::Picture => {
                    for (key, text) in PICTURE_USES {
                        offer(ui, text, Choice::Key(key));
                    }
                }
                _ => {
                    offer(ui, "Smoke in this scene", Choice::Smoke);
                    offer(ui, "A scene of its own", Choice::Open);
                }
            }
            ui.add_space(4.0);
            offer(ui, "Cancel", Choice::Leave);
        });
        if modal.should_close() {
            chosen = Some(Choice::Leave);
        }

        // Do what is chosen.
        let Some(choice) = chosen else {
            return;
        };
        self.dropped.remove(0);
        match choice {
            Choice::Key(key) => self.edit(&Edit::Set(key.to_owned(), Value::String(path)), ui),
            Choice::Smoke => {
                let volumes = [&self.pose.volumes[..], &[path]].concat();
                self.take_volumes(volumes, ui);
            }
            Choice::Open => self.host.open(&path),
            Choice::Leave => {}
        }
        self.history.close();
    }
}
