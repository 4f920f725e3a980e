//! The picture, and the mouse on it.

use egui::{ColorImage, Context, PointerButton, Rect, Sense, TextureHandle, TextureOptions, Ui};

use super::Studio;
use crate::host::Picture;

/// Side of a square of the pattern behind pictures that are transparent, in points.
const SQUARE: f32 = 8.0;

/// What a wheel zooms by for a point that it scrolls.
const ZOOM: f32 = 0.0015;

/// A picture as a texture; one that is larger than a texture may be is shown by every second pixel, or fewer.
pub(super) fn texture(ctx: &Context, picture: &Picture) -> TextureHandle {
    let most = ctx.input(|input| input.max_texture_side).max(1);
    let [width, height] = picture.order.size.map(|side| side as usize);
    let step = width.max(height).div_ceil(most).max(1);
    let image = match step {
        1 => ColorImage::from_rgba_unmultiplied([width, height], &picture.rgba),
        _ => {
            let size = [width.div_ceil(step), height.div_ceil(step)];
            let rows = (0..height).step_by(step);
            let places =
                rows.flat_map(|y| (0..width).step_by(step).map(move |x| (y * width + x) * 4));
            let bytes: Vec<u8> = places
                .flat_map(|place| picture.rgba[place..place + 4].iter().copied())
                .collect();
            ColorImage::from_rgba_unmultiplied(size, &bytes)
        }
    };
    ctx.load_texture("picture", image, TextureOptions::LINEAR)
}

impl Studio {
    /// Shows the picture in the room that is left, and lets the mouse turn, move and zoom it.
    pub(super) fn show_canvas(&mut self, ui: &mut Ui) {
        // Say how large a full picture is now.
        let room = ui.available_rect_before_wrap();
        let scale = ui.ctx().pixels_per_point();
        let pixels = (room.size() * scale).max(egui::Vec2::splat(1.0));
        let size = self
            .fixed_size
            .unwrap_or([pixels.x.round() as u32, pixels.y.round() as u32]);
        if size != self.size {
            self.size = size;
            self.changed(ui);
        }
        // Keys of the camera go to it where no control has them.
        let response = ui.allocate_rect(room, Sense::CLICK | Sense::DRAG);
        if response.clicked() || response.drag_started() {
            response.request_focus();
            ui.memory_mut(|memory| memory.surrender_focus(response.id));
        }

        // Draw the picture, as large as its shape allows.
        let place = fitted(room, size);
        let first = self.first_in(room);
        if let Some((picture, texture)) = &self.shown {
            let place = fitted(room, picture.order.size);
            if picture.rgba.chunks_exact(4).any(|pixel| pixel[3] < 255) {
                draw_squares(ui, place);
            }
            let whole = Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            let image = |clip: Rect, texture: &TextureHandle, place: Rect| {
                let painter = ui.painter().with_clip_rect(clip.intersect(ui.clip_rect()));
                painter.image(texture.id(), place, whole, egui::Color32::WHITE);
            };
            match &first {
                None => image(room, texture, place),
                Some((x, before, first)) => {
                    let (mut left, mut right) = (room, room);
                    left.max.x = *x;
                    right.min.x = *x;
                    image(left, first, *before);
                    image(right, texture, place);
                }
            }
        }
        self.show_handle(ui, place, first.is_some());
        self.show_lights(ui, place);

        // Say why a line is there that is clicked, or place guide points.
        if let Some(pointer) = response
            .interact_pointer_pos()
            .filter(|_| response.clicked())
        {
            self.click(pointer, place, ui);
        }
        if self.places_guides {
            self.show_guides(ui, place);
        }
        self.show_why(ui, room, place);

        // Follow the mouse.
        let height = place.height().max(1.0);
        let drag = response.drag_delta();
        let drag = [drag.x / height, drag.y / height];
        if drag != [0.0; 2] {
            let is_shifted = ui.input(|input| input.modifiers.shift);
            let is_left = response.dragged_by(PointerButton::Primary);
            match is_left && !is_shifted {
                true => self.move_camera(ui, |point| point.orbit(drag)),
                false => self.move_camera(ui, |point| point.pan(drag)),
            }
        }
        let scrolled = ui.input(|input| input.smooth_scroll_delta().y);
        if let Some(pointer) = response.hover_pos()
            && scrolled != 0.0
        {
            let from_middle = (pointer - place.center()) / height;
            let factor = (-scrolled * ZOOM).clamp(-1.0, 1.0);
            let factor = npr_core::math::exp(factor);
            self.move_camera(ui, |point| {
                point.zoom(factor, [from_middle.x, from_middle.y])
            });
        }
    }
}

/// The largest rectangle of a picture's shape in the middle of a room.
pub(super) fn fitted(room: Rect, size: [u32; 2]) -> Rect {
    let [width, height] = size.map(|side| side.max(1) as f32);
    let scale = (room.width() / width).min(room.height() / height);
    Rect::from_center_size(room.center(), egui::vec2(width, height) * scale)
}

/// Draws the pattern that shows through where a picture is transparent.
fn draw_squares(ui: &Ui, place: Rect) {
    let painter = ui.painter().with_clip_rect(place);
    painter.rect_filled(place, 0.0, egui::Color32::from_gray(200));
    let columns = (place.width() / SQUARE).ceil() as usize;
    let rows = (place.height() / SQUARE).ceil() as usize;
    for row in 0..rows {
        for column in (row % 2..columns).step_by(2) {
            let corner = place.min + egui::vec2(column as f32, row as f32) * SQUARE;
            let square = Rect::from_min_size(corner, egui::Vec2::splat(SQUARE));
            painter.rect_filled(square, 0.0, egui::Color32::from_gray(170));
        }
    }
}
