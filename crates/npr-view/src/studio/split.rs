//! The picture with the style as it was at first, beside the present one.

use egui::{
    Align2, Color32, CursorIcon, FontId, Rect, Sense, Stroke, TextureHandle, Ui, pos2, vec2,
};

use super::Studio;
use super::canvas::fitted;
use crate::host::Order;
use crate::panel::{arrows, name_it};

/// Width of the handle between both pictures, in points.
const HANDLE: f32 = 12.0;

/// What an arrow key moves the handle by, as a share of the picture.
const STEP: f32 = 0.01;

impl Studio {
    /// The order of the present view in the style at first.
    fn first_order(&self) -> Order {
        let first = &self.split.first;
        Order {
            change: 0,
            style: first.name().to_owned(),
            overrides: first.overrides(),
            ..self.order()
        }
    }

    /// The picture that is missing left of the handle, while the full picture of the present style is shown.
    pub(super) fn missing_first(&mut self) -> Option<Order> {
        if !self.split.is_on {
            return None;
        }
        let wanted = self.first_order();
        let is_shown = |(order, _): &(Order, TextureHandle)| *order == wanted;
        if self.split.shown.as_ref().is_some_and(is_shown) {
            return None;
        }

        // A picture of the present style is one of that at first, where nothing was changed.
        if let Some((picture, texture)) = &self.shown {
            let order = Order {
                change: 0,
                ..picture.order.clone()
            };
            if order == wanted {
                self.split.shown = Some((order, texture.clone()));
                return None;
            }
        }
        Some(wanted)
    }

    /// Takes a picture that was drawn beside the present one, if it is that of the style at first; gives whether it is.
    pub(super) fn take_first(&mut self, order: &Order, texture: &TextureHandle) -> bool {
        let is_first = self.split.is_on && *order == self.first_order();
        if is_first {
            self.split.shown = Some((order.clone(), texture.clone()));
        }
        is_first
    }

    /// Where the handle is in a room, and the picture left of it with its place, while both pictures show one view.
    pub(super) fn first_in(&self, room: Rect) -> Option<(f32, Rect, TextureHandle)> {
        let (order, texture) = self.split.shown.as_ref().filter(|_| self.split.is_on)?;
        let now = &self.shown.as_ref()?.0.order;
        let is_same = *order == self.first_order()
            && now.viewpoint == order.viewpoint
            && now.pose == order.pose;
        let place = fitted(room, order.size);
        let x = place.left() + place.width() * self.split.share;
        is_same.then(|| (x, place, texture.clone()))
    }

    /// Shows the handle over a picture at `place`, and moves it.
    pub(super) fn show_handle(&mut self, ui: &Ui, place: Rect, is_ready: bool) {
        if !self.split.is_on {
            return;
        }
        // Move it by mouse and keys.
        let x = place.left() + place.width() * self.split.share;
        let room = Rect::from_center_size(pos2(x, place.center().y), vec2(HANDLE, place.height()));
        let id = ui.make_persistent_id("before and after");
        let response = ui.interact(room, id, Sense::click_and_drag());
        name_it(&response, "Before and after");
        let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
        let pointer = response.interact_pointer_pos();
        if let Some(pointer) = pointer.filter(|_| response.dragged()) {
            self.split.share = (pointer.x - place.left()) / place.width().max(1.0);
        }
        let [right, _] = arrows(&response);
        self.split.share = (self.split.share + right as f32 * STEP).clamp(0.0, 1.0);

        // Draw it, with a name for either side.
        let painter = ui.painter().with_clip_rect(place);
        let color = match response.has_focus() || response.hovered() || response.dragged() {
            true => ui.visuals().selection.bg_fill,
            false => Color32::from_gray(70),
        };
        painter.vline(x, place.y_range(), Stroke::new(3.0, Color32::WHITE));
        painter.vline(x, place.y_range(), Stroke::new(1.5, color));
        let knob = Rect::from_center_size(pos2(x, place.center().y), vec2(HANDLE, 3.0 * HANDLE));
        painter.rect_filled(knob, 4.0, Color32::WHITE);
        painter.rect_filled(knob.shrink(1.5), 3.0, color);
        let before = match is_ready {
            true => "before: as opened",
            false => "before: drawn when still",
        };
        for (text, side, align) in [
            (before, -1.0, Align2::RIGHT_TOP),
            ("now", 1.0, Align2::LEFT_TOP),
        ] {
            let at = pos2(x + side * HANDLE, place.top() + 8.0);
            let font = FontId::proportional(13.0);
            let text = painter.layout_no_wrap(text.to_owned(), font, Color32::WHITE);
            let room = align.anchor_size(at, text.size());
            painter.rect_filled(room.expand(4.0), 4.0, Color32::from_black_alpha(150));
            painter.galley(room.min, text, Color32::WHITE);
        }
    }
}
