//! A figure: sliders of its expressions, what it looks at, and its joints.

use egui::{Button, CollapsingHeader, ComboBox, RichText, Slider, Ui};

use super::Studio;
use crate::panel::name_it;
use crate::pose::{Face, LookAt};

/// Width of the names of expressions, in points.
const NAME_WIDTH: f32 = 118.0;

/// What searches find the group by, besides the names of expressions.
const WORDS: &str = "figure face expression look at";

impl Studio {
    /// Shows expressions, what the figure looks at, and its joints, where the scene has such a figure.
    pub(super) fn show_figure(&mut self, ui: &mut Ui) {
        // Find what is searched for.
        let is_hit = |name: &str| self.panel.finds(&[WORDS, name]);
        let cast = &self.timeline.cast;
        let names = cast.expressions.iter().filter(|name| is_hit(name));
        let names: Vec<String> = names.cloned().collect();
        let can_look = cast.can_look && is_hit("eyes");
        let bones = self.searched_bones();
        if names.is_empty() && !can_look && bones.is_empty() {
            return;
        }

        // Show it.
        let mut face = self.pose.face.clone();
        let mut touched = None;
        let title = RichText::new("Figure").strong().size(15.0);
        let is_open = (!self.panel.search.is_empty()).then_some(true);
        CollapsingHeader::new(title).open(is_open).show(ui, |ui| {
            if can_look && show_look(ui, &mut face) {
                touched = Some("look-at".to_owned());
            }
            for name in &names {
                if show_share(ui, name, &mut face) {
                    touched = Some(name.clone());
                }
            }
            self.show_joints(ui, &bones);
        });
        if let Some(what) = touched
            && face != self.pose.face
        {
            self.history.note_face(&self.pose.face, &what);
            self.pose.face = face;
            self.hold_camera();
            self.changed(ui);
        }
    }
}

/// Shows an expression, and gives whether the user changed how much of it shows.
fn show_share(ui: &mut Ui, name: &str, face: &mut Face) -> bool {
    let said = face.share(name);
    let mut share = said.unwrap_or(0.0);
    let mut is_changed = false;
    ui.horizontal(|ui| {
        // Write the name in a column of its own.
        let text = match said {
            Some(_) => RichText::new(name).strong(),
            None => RichText::new(name),
        };
        let size = egui::vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(
            size,
            egui::Layout::left_to_right(egui::Align::Center),
            |ui| {
                ui.set_min_width(NAME_WIDTH);
                ui.add(egui::Label::new(text).truncate());
            },
        );

        // Show the slider, and the way back.
        let slider = ui.add(Slider::new(&mut share, 0.0..=1.0).max_decimals(2));
        name_it(&slider, &format!("expression {name}"));
        if slider.changed() {
            face.set_share(name, Some(share));
            is_changed = true;
        }
        if said.is_some() {
            let back = ui.add(Button::new("×").frame(false));
            name_it(&back, &format!("reset expression {name}"));
            let back = back.on_hover_text("as clip and file have it");
            if back.clicked() {
                face.set_share(name, None);
                is_changed = true;
            }
        }
    });
    is_changed
}

/// Shows what the figure looks at, and gives whether the user changed it.
fn show_look(ui: &mut Ui, face: &mut Face) -> bool {
    let before = face.look_at;
    let text = |look_at: Option<LookAt>| match look_at {
        None => "as they are".to_owned(),
        Some(LookAt::Camera) => "at the camera".to_owned(),
        Some(LookAt::Place([x, y, z])) => format!("at {x}, {y}, {z}"),
    };
    let mut choices = vec![None, Some(LookAt::Camera)];
    if matches!(before, Some(LookAt::Place(_))) {
        choices.push(before);
    }
    ui.horizontal(|ui| {
        ui.label("Eyes");
        let shown = ComboBox::from_id_salt("look-at")
            .selected_text(text(before))
            .show_ui(ui, |ui| {
                for choice in choices {
                    ui.selectable_value(&mut face.look_at, choice, text(choice));
                }
            });
        name_it(&shown.response, "Eyes look");
    });
    face.look_at != before
}
