//! The bones of a figure: three angles each, by which they are turned from rest.

use egui::{Button, CollapsingHeader, DragValue, Label, RichText, Ui};

use super::Studio;
use crate::host::Order;
use crate::panel::{name_it, plain_name};
use crate::pose::Pose;

/// Width of the names of bones, in points.
const NAME_WIDTH: f32 = 118.0;

/// What searches find the group by, besides the names of bones.
const WORDS: &str = "figure joint bone pose turn";

/// The angles in the order of [`Pose::turns`].
const AXES: [&str; 3] = ["x", "y", "z"];

/// What of a pose lies in a file of bones.
fn of_bones(pose: &Pose) -> Pose {
    Pose {
        bones: pose.bones.clone(),
        turns: pose.turns.clone(),
        ..Pose::default()
    }
}

/// The name of a bone in plain words: `leftUpperArm` is "Left upper arm".
fn bone_name(bone: &str) -> String {
    let words = bone.chars().flat_map(|letter| {
        let gap = letter.is_uppercase().then_some('_');
        gap.into_iter().chain(letter.to_lowercase())
    });
    plain_name(&words.collect::<String>())
}

impl Studio {
    /// Bones of the scene that are searched for.
    pub(super) fn searched_bones(&self) -> Vec<String> {
        let is_hit = |bone: &&String| self.panel.finds(&[WORDS, bone, &bone_name(bone)]);
        let bones = self.timeline.cast.bones.iter();
        bones.filter(is_hit).cloned().collect()
    }

    /// Shows the angles of bones, folded in where nothing is searched, and a button that saves the pose.
    pub(super) fn show_joints(&mut self, ui: &mut Ui, bones: &[String]) {
        if bones.is_empty() {
            return;
        }
        let is_open = (!self.panel.search.is_empty()).then_some(true);
        let mut pose = self.pose.clone();
        let mut touched = None;
        CollapsingHeader::new("Joints")
            .open(is_open)
            .show(ui, |ui| {
                let save = ui.add_enabled(!pose.turns.is_empty(), Button::new("Save pose"));
                let save = save.on_hover_text("a file of the bones, as --pose reads it");
                if save.clicked() {
                    self.save_pose();
                }
                for bone in bones {
                    if show_bone(ui, bone, &mut pose) {
                        touched = Some(bone.clone());
                    }
                }
            });
        if let Some(bone) = touched
            && pose != self.pose
        {
            self.history.note_turns(&self.pose, &bone);
            self.pose = pose;
            self.hold_camera();
            self.changed(ui);
        }
    }

    /// Writes the bones into a file and tells its name, which it gives too; none where it cannot be written.
    fn save_pose(&mut self) -> Option<String> {
        let bones = of_bones(&self.pose);
        match self.host.save_pose(&bones) {
            Ok(path) => {
                self.told = Some((format!("'{path}' holds the pose"), false));
                self.saved_pose = Some((bones, path.clone()));
                Some(path)
            }
            Err(text) => {
                self.tell_fault(text);
                None
            }
        }
    }

    /// An order as a command line can say it: bones that are turned lie in a file, which is written where it is not
    /// there yet. None where it cannot be written.
    pub(super) fn told_order(&mut self, order: Order) -> Option<Order> {
        if order.pose.turns.is_empty() {
            return Some(order);
        }
        let saved = self.saved_pose.as_ref();
        let saved = saved.filter(|(pose, _)| *pose == of_bones(&order.pose));
        let path = match saved {
            Some((_, path)) => path.clone(),
            None => self.save_pose()?,
        };
        let pose = Pose {
            bones: Some(path),
            turns: Vec::new(),
            ..order.pose
        };
        Some(Order { pose, ..order })
    }
}

/// Shows a bone, and gives whether the user turned it.
fn show_bone(ui: &mut Ui, bone: &str, pose: &mut Pose) -> bool {
    let said = pose.turn(bone);
    let mut angles = said.unwrap_or_default();
    let mut is_changed = false;
    ui.horizontal(|ui| {
        // Write the name in a column of its own.
        let text = match said {
            Some(_) => RichText::new(bone_name(bone)).strong(),
            None => RichText::new(bone_name(bone)),
        };
        let size = egui::vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        let layout = egui::Layout::left_to_right(egui::Align::Center);
        ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_width(NAME_WIDTH);
            ui.add(Label::new(text).truncate());
        });

        // Show the angles, and the way back.
        for (angle, axis) in angles.iter_mut().zip(AXES) {
            let value = DragValue::new(angle)
                .range(-180.0..=180.0)
                .speed(1.0)
                .max_decimals(1)
                .suffix("°");
            let value = ui.add(value);
            name_it(&value, &format!("joint {bone} {axis}"));
            let value = value.on_hover_text(format!("about the axis {axis} of the world"));
            is_changed |= value.changed();
        }
        if is_changed {
            pose.set_turn(bone, Some(angles));
        }
        if said.is_some() {
            let back = ui.add(Button::new("×").frame(false));
            name_it(&back, &format!("reset joint {bone}"));
            if back.on_hover_text("as clip and file have it").clicked() {
                pose.set_turn(bone, None);
                is_changed = true;
            }
        }
    });
    is_changed
}
