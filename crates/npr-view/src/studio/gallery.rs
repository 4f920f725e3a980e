//! The list of presets, with a picture of the scene in each.

use egui::{Atom, Button, Color32, Rect, TextureHandle, Ui, Vec2, pos2, vec2};
use npr_stylesheet::presets;

use super::Studio;
use super::canvas::fitted;
use crate::host::Order;
use crate::panel::{name_it, stepped};

/// Most pixels that a picture of the list has to a side.
const SIDE: f32 = 160.0;

/// Room of a picture in the list, in points.
const ROOM: Vec2 = vec2(104.0, 78.0);

/// An order without what it says of the style.
fn without_style(order: Order) -> Order {
    Order {
        style: String::new(),
        overrides: Vec::new(),
        ..order
    }
}

impl Studio {
    /// The first picture that is missing in the list, while it is open.
    pub(super) fn missing_preset(&mut self) -> Option<Order> {
        if !self.gallery.is_open {
            return None;
        }
        // Pictures of another view are of no use any more.
        let view = without_style(self.small_order());
        if self.gallery.view.as_ref() != Some(&view) {
            self.gallery.pictures.clear();
            self.gallery.view = Some(view.clone());
        }
        let is_missing = |name: &str| self.gallery.picture(name).is_none();
        let missing = presets().iter().find(|preset| is_missing(preset.name))?;
        Some(Order {
            style: missing.name.to_owned(),
            ..view
        })
    }

    /// The order of a picture in the list, of the present view, whatever layer is shown: a draft, so that its strokes
    /// are those of the full picture, made smaller.
    fn small_order(&self) -> Order {
        let order = self.order();
        let [width, height] = order.size.map(|side| side as f32);
        let scale = (SIDE / width.max(height)).min(1.0);
        Order {
            change: 0,
            layer: None,
            size: [width, height].map(|side| ((side * scale).round() as u32).max(1)),
            is_draft: true,
            ..order
        }
    }

    /// Takes a picture that was drawn beside the present one, or that there is none, if it belongs into the list.
    pub(super) fn take_preset(&mut self, order: &Order, texture: Option<TextureHandle>) -> bool {
        let is_listed = self.gallery.view == Some(without_style(order.clone()));
        if is_listed && self.gallery.picture(&order.style).is_none() {
            let picture = (order.style.clone(), texture);
            self.gallery.pictures.push(picture);
        }
        is_listed
    }

    /// Shows the presets as a list with pictures, and gives the name of one that the user chose.
    pub(super) fn show_gallery(&mut self, ui: &mut Ui) -> Option<&'static str> {
        // The list takes what is left, however long the name: a row that is too wide widens the panel.
        let mut chosen = None;
        self.gallery.is_open = false;
        let gallery = &mut self.gallery;
        let own = self.sheet.name();
        let shown = egui::ComboBox::from_id_salt("presets")
            .width(ui.available_width())
            .height(420.0)
            .truncate()
            .selected_text(own)
            .show_ui(ui, |ui| {
                gallery.is_open = true;
                for preset in presets() {
                    let is_own = preset.name == own;
                    let picture = gallery.picture(preset.name).cloned().flatten();
                    let picture = Atom::paint(ROOM, move |ui, args| {
                        paint(ui, args.rect, picture.as_ref());
                    });
                    let button = Button::selectable(is_own, (picture, preset.name));
                    if ui.add(button).clicked() && !is_own {
                        chosen = Some(preset.name);
                    }
                }
            });
        name_it(&shown.response, "Style");
        let place = presets().iter().position(|preset| preset.name == own);
        let there = stepped(&shown.response, place.unwrap_or(0), presets().len());
        chosen.or(there.map(|there| presets()[there].name))
    }
}

/// Paints a picture into its room; a grey one while there is none.
fn paint(ui: &Ui, room: Rect, picture: Option<&TextureHandle>) {
    let Some(picture) = picture else {
        ui.painter()
            .rect_filled(room, 3.0, ui.visuals().faint_bg_color);
        return;
    };
    let [width, height] = picture.size().map(|side| side as u32);
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    let place = fitted(room, [width, height]);
    ui.painter()
        .image(picture.id(), place, whole, Color32::WHITE);
}
