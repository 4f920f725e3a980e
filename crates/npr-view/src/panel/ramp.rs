//! Ramps of colours and tones: a bar with a handle at every stop.

use egui::color_picker::{Alpha, color_picker_color32};
use egui::{Color32, Popup, PopupCloseBehavior, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};
use npr_core::color::srgb_from_linear;
use npr_stylesheet::{Color, Field, HueStop, Stop, hue_row};
use toml::Value;

use super::stops::{
    Done, HANDLE, StopForm, bounds, clicked_twice, handle, number_of, place_among, put_color,
    put_number, square,
};

/// Height of the bar, in points.
const HEIGHT: f32 = 18.0;

/// Width of the bar, in points.
const WIDTH: f32 = 200.0;

/// Pieces that the bar is painted in.
const PIECES: usize = 100;

/// Shows stops as a bar, and gives the stops that the user made of them.
pub(super) fn edit(
    ui: &mut Ui,
    (form, fields): (StopForm, &[Field]),
    (fewest, most): (u64, u64),
    key: &str,
    stops: &[Value],
) -> Option<Vec<Value>> {
    // Paint the bar.
    let width = WIDTH.min(ui.available_width() - HANDLE).max(40.0);
    let room = vec2(width + HANDLE, HEIGHT + HANDLE);
    let (whole, _) = ui.allocate_exact_size(room, Sense::hover());
    let bar = Rect::from_min_size(whole.min + vec2(0.5 * HANDLE, 0.0), vec2(width, HEIGHT));
    let row = Row::new(form, key, stops);
    row.paint(ui, bar);

    // Add a stop where the bar is clicked twice.
    let count = stops.len() as u64;
    let mut changed = None;
    if let Some(pointer) = clicked_twice(ui, (key, "bar"), bar)
        && count < most
    {
        let at = ((pointer.x - bar.left()) / width).clamp(0.0, 1.0);
        changed = Some(with_stop(&row, (form, fields), stops, at));
    }

    // Show the handles below, and follow what is done to them.
    for (i, stop) in stops.iter().enumerate() {
        let x = bar.left() + number_of(stop, "at").clamp(0.0, 1.0) * width;
        let place = square(x, bar.bottom() + 0.5 * HANDLE);
        let (response, done) = handle(ui, (key, i), place, vec2(width, HEIGHT));
        let color = opaque(color_of(form, stop));
        let is_active = response.hovered() || response.has_focus() || response.dragged();
        paint_handle(ui, place, color, is_active);
        match done {
            Some(Done::Removed) if count > fewest => {
                changed.get_or_insert_with(|| stops.to_vec()).remove(i);
            }
            Some(Done::Moved(by)) => {
                let (low, high) = bounds(stops, i);
                let at = (number_of(stop, "at") + by.x).clamp(low, high);
                put_number(
                    &mut changed.get_or_insert_with(|| stops.to_vec())[i],
                    "at",
                    at,
                );
            }
            _ => {}
        }

        // Choose its colour in a window of its own.
        let key = if form == StopForm::Tone {
            "tint"
        } else {
            "color"
        };
        let popup = Popup::from_toggle_button_response(&response)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside);
        let picked = popup.show(|ui| {
            let mut now = color_of_key(stop, key).unwrap_or(Color32::WHITE);
            color_picker_color32(ui, &mut now, Alpha::OnlyBlend).then_some(now)
        });
        if let Some(color) = picked.and_then(|shown| shown.inner) {
            let stops = changed.get_or_insert_with(|| stops.to_vec());
            if let Some(stop) = stops.get_mut(i) {
                put_color(stop, key, color);
            }
        }
    }
    changed
}

/// Stops with another one at a place, which looks as the bar does there.
fn with_stop(
    row: &Row<'_>,
    (form, fields): (StopForm, &[Field]),
    stops: &[Value],
    at: f32,
) -> Vec<Value> {
    let place = place_among(stops, at);
    let near = stops.get(place.saturating_sub(1));
    let first = || npr_stylesheet::Form::Table(fields.to_vec()).first();
    let mut stop = near.cloned().unwrap_or_else(first);
    put_number(&mut stop, "at", at);
    if form == StopForm::Color && !stops.is_empty() {
        put_color(&mut stop, "color", row.at(at));
    }
    let mut all = stops.to_vec();
    all.insert(place, stop);
    all
}

/// What a bar shows.
struct Row<'a> {
    form: StopForm,
    stops: &'a [Value],
    /// Colours that mix from stop to stop, as the style mixes them; none where each lasts until the next.
    mixed: Option<Vec<u8>>,
}

impl<'a> Row<'a> {
    fn new(form: StopForm, key: &str, stops: &'a [Value]) -> Self {
        // Of all ramps those of the colour of lines mix.
        let mixes = form == StopForm::Color && key.contains("line.paint.");
        let hue = |stop: &Value| HueStop {
            at: number_of(stop, "at"),
            color: text_color(stop, "color").unwrap_or(Color::WHITE),
        };
        let hues = || stops.iter().map(hue).collect::<Vec<_>>();
        Self {
            form,
            stops,
            mixed: mixes.then(|| hue_row(&hues())),
        }
    }

    /// The colour at a place of 0..1.
    fn at(&self, place: f32) -> Color32 {
        if let Some(row) = &self.mixed {
            let count = row.len() / 4;
            let i = (place * (count - 1) as f32).round() as usize * 4;
            let [r, g, b, a] = [row[i], row[i + 1], row[i + 2], row[i + 3]];
            return Color32::from_rgba_unmultiplied(r, g, b, a);
        }
        let i = place_among(self.stops, place).saturating_sub(1);
        let stop = self.stops.get(i);
        stop.map_or(Color32::TRANSPARENT, |stop| color_of(self.form, stop))
    }

    fn paint(&self, ui: &Ui, bar: Rect) {
        let painter = ui.painter_at(bar.expand(1.0));
        painter.rect_filled(bar, 0.0, Color32::WHITE);
        let wide = bar.width() / PIECES as f32;
        for i in 0..PIECES {
            let left = bar.left() + i as f32 * wide;
            let piece = Rect::from_min_max(
                pos2(left, bar.top()),
                pos2(left + wide + 0.5, bar.bottom()).min(bar.max),
            );
            let color = self.at((i as f32 + 0.5) / PIECES as f32);
            painter.rect_filled(piece, 0.0, color);
        }
        let edge = ui.visuals().widgets.noninteractive.fg_stroke;
        painter.rect_stroke(bar, 0.0, edge, egui::StrokeKind::Outside);
    }
}

/// The colour that a stop stands for; a tone shows what remains of white.
fn color_of(form: StopForm, stop: &Value) -> Color32 {
    if form != StopForm::Tone {
        return color_of_key(stop, "color").unwrap_or(Color32::WHITE);
    }
    let tone = Stop {
        at: 0.0,
        light: number_of(stop, "light"),
        tint: text_color(stop, "tint"),
    };
    let [r, g, b] = tone.level().light.map(|light| {
        let light = srgb_from_linear(light.clamp(0.0, 1.0));
        (light * 255.0 + 0.5) as u8
    });
    Color32::from_rgb(r, g, b)
}

fn text_color(stop: &Value, key: &str) -> Option<Color> {
    stop.get(key)?.as_str()?.parse().ok()
}

fn color_of_key(stop: &Value, key: &str) -> Option<Color32> {
    let Color { r, g, b, a } = text_color(stop, key)?;
    Some(Color32::from_rgba_unmultiplied(r, g, b, a))
}

fn opaque(color: Color32) -> Color32 {
    let [r, g, b, _] = color.to_srgba_unmultiplied();
    Color32::from_rgb(r, g, b)
}

/// A handle that points up at its place.
fn paint_handle(ui: &Ui, place: Rect, color: Color32, is_active: bool) {
    let visuals = match is_active {
        true => &ui.visuals().widgets.hovered,
        false => &ui.visuals().widgets.inactive,
    };
    let edge = Stroke::new(if is_active { 2.0 } else { 1.0 }, visuals.fg_stroke.color);
    let middle = place.center();
    let corners = vec![
        pos2(middle.x, place.top()),
        pos2(place.right(), middle.y),
        place.right_bottom(),
        place.left_bottom(),
        pos2(place.left(), middle.y),
    ];
    ui.painter()
        .add(Shape::convex_polygon(corners, color, edge));
}
