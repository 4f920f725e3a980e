//! Layers that are shown in place of the picture: steps on the way to it.

use egui::{ComboBox, Ui};

use super::Studio;
use crate::panel::{name_it, stepped};

/// Width of the list, in points.
const WIDTH: f32 = 110.0;

/// What the list calls the picture itself.
const NONE: &str = "none";

impl Studio {
    /// Shows the list of layers, and shows the one that the user chooses.
    pub(super) fn show_layers(&mut self, ui: &mut Ui) {
        // Show the list, the picture itself first.
        let mut chosen = None;
        let now = self.layer.as_deref();
        let label = ui.label("Layer");
        let shown = ComboBox::from_id_salt("layers")
            .width(WIDTH)
            .height(420.0)
            .selected_text(now.unwrap_or(NONE))
            .show_ui(ui, |ui| {
                let none = ui.selectable_label(now.is_none(), NONE);
                if none.on_hover_text("The picture itself.").clicked() {
                    chosen = Some(0);
                }
                for (place, layer) in self.layers.iter().enumerate() {
                    let is_now = now == Some(&layer.name);
                    let entry = ui.selectable_label(is_now, &layer.name);
                    if entry.on_hover_text(&layer.text).clicked() {
                        chosen = Some(place + 1);
                    }
                }
            });
        name_it(&shown.response, "Layer");
        let hint = "a step on the way to the picture, as npr render --debug-layer shows it";
        label.on_hover_text(hint);

        // Take what was chosen, with the mouse or by arrow keys.
        let mut layers = self.layers.iter();
        let place = layers.position(|layer| now == Some(&layer.name));
        let place = place.map_or(0, |place| place + 1);
        let there = chosen.or_else(|| stepped(&shown.response, place, self.layers.len() + 1));
        if let Some(there) = there.filter(|there| *there != place) {
            let layer = there.checked_sub(1).and_then(|i| self.layers.get(i));
            self.layer = layer.map(|layer| layer.name.clone());
            self.changed(ui);
        }
    }
}
