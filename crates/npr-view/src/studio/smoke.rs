//! Smoke in the scene: where it comes from and where it stands.

use egui::{Button, CollapsingHeader, ComboBox, RichText, Ui};
use npr_core::math;

use super::Studio;
use crate::panel::{line_of_text, name_it};
use crate::value::number_text;
use crate::viewpoint::Viewpoint;

/// What searches find the section by, besides what the smoke is.
const WORDS: &str = "smoke volume source";

/// Width of what the smoke is, in points.
const WIDTH: f32 = 236.0;

/// Size of smoke that is added, as a share of the height of the view at the point that it turns about.
const SIZE: f32 = 0.5;

/// How far to the right of that point it stands, and below, as shares of the same height.
const ASIDE: [f32; 2] = [0.35, 0.25];

impl Studio {
    /// Lists the smoke that stands in a scene of surfaces, as `--volume` says it, and adds more.
    pub(super) fn show_smoke(&mut self, ui: &mut Ui) {
        // Find what is searched for.
        let texts: Vec<&str> = self.pose.volumes.iter().map(String::as_str).collect();
        let is_hit = self.panel.finds(&[&[WORDS], &texts[..]].concat());
        if !is_hit || !self.holds_surfaces() {
            return;
        }

        // Show it.
        let mut volumes = self.pose.volumes.clone();
        let mut added = None;
        let title = RichText::new("Smoke in the scene").strong().size(15.0);
        let is_open = (!self.panel.search.is_empty()).then_some(true);
        CollapsingHeader::new(title).open(is_open).show(ui, |ui| {
            show_list(ui, &mut volumes);
            let shown = ComboBox::from_id_salt("add smoke")
                .selected_text("Add smoke")
                .show_ui(ui, |ui| {
                    for name in self.host.smokes() {
                        if ui.selectable_label(false, &name).clicked() {
                            added = Some(name);
                        }
                    }
                });
            name_it(&shown.response, "Add smoke");
        });
        let point = self
            .viewpoint
            .or(self.picture().map(|picture| picture.viewpoint));
        let placed = |name: String| point.map_or(name.clone(), |point| beside(&name, &point));
        volumes.extend(added.map(placed));
        if volumes != self.pose.volumes {
            self.take_volumes(volumes, ui);
        }
    }

    /// Lets other smoke stand in the scene, which is a step to undo.
    pub(super) fn take_volumes(&mut self, volumes: Vec<String>, ui: &Ui) {
        self.history.close();
        self.history.note_volumes(&self.pose);
        self.history.close();
        self.pose.volumes = volumes;
        self.changed(ui);
    }
}

/// Shows what smoke there is, to be changed or taken out.
fn show_list(ui: &mut Ui, volumes: &mut Vec<String>) {
    let mut removed = None;
    for (number, text) in volumes.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            let name = format!("smoke in the scene {}", number + 1);
            if let Some(other) = line_of_text(ui, &name, text, WIDTH) {
                *text = other;
            }
            let out = ui.add(Button::new("×").frame(false));
            name_it(&out, &format!("take out {text}"));
            if out.on_hover_text("take it out of the scene").clicked() {
                removed = Some(number);
            }
        });
    }
    if let Some(number) = removed {
        volumes.remove(number);
    }
}

/// Built-in smoke of a name, which is one unit large, beside what a view turns about.
fn beside(name: &str, point: &Viewpoint) -> String {
    let away = [0, 1, 2].map(|i| point.eye[i] - point.target[i]);
    let distance = away.map(|v| v * v).iter().sum::<f32>().sqrt();
    let height = 2.0 * distance * math::tan(point.fov_deg.to_radians() * 0.5);
    let [right, up, _] = point.camera().axes();
    let foot = [0, 1, 2].map(|i| {
        let aside = right[i] * ASIDE[0] - up[i] * ASIDE[1];
        short_text(point.target[i] + aside * height)
    });
    format!("{name}@{}*{}", foot.join(","), short_text(SIZE * height))
}

/// A number with three digits that count.
fn short_text(value: f32) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(0.0);
    number_text(rounded + 0.0)
}
