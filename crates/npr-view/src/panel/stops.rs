//! Stops of lists, taken by the hand: they are moved, added and removed.

use egui::{Color32, Key, Pos2, Rect, Response, Sense, Ui, Vec2, pos2, vec2};
use npr_stylesheet::{Color, Field, Form};
use toml::Value;

use super::naming::{arrows, name_it};
use crate::value::as_number;

/// Side of a handle, in points.
pub(super) const HANDLE: f32 = 11.0;

/// What an arrow key moves a stop by, as a share of the whole.
const STEP: f32 = 0.01;

/// What stops have beside their place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum StopForm {
    /// A colour.
    Color,
    /// How much light remains, and a tint.
    Tone,
    /// A factor.
    Factor,
}

impl StopForm {
    /// The form of stops with these keys; `None` where they are no stops.
    pub fn of(fields: &[Field]) -> Option<Self> {
        let has = |name: &str| fields.iter().any(|field| field.name == name);
        let forms = [
            ("color", Self::Color),
            ("light", Self::Tone),
            ("factor", Self::Factor),
        ];
        // Words have a place and a colour, too: theirs is no number.
        let is_place =
            |field: &Field| field.name == "at" && matches!(field.form, Form::Number { .. });
        let found = forms.into_iter().find(|(name, _)| has(name));
        let found = found.map(|(_, form)| form);
        found.filter(|_| fields.iter().any(is_place))
    }
}

/// The range of a number that every stop has.
pub(super) fn range_of(fields: &[Field], name: &str) -> (f64, f64) {
    let field = fields.iter().find(|field| field.name == name);
    match field.map(|field| &field.form) {
        Some(Form::Number { range, .. }) => *range,
        _ => (0.0, 1.0),
    }
}

/// The number of a stop under a name.
pub(super) fn number_of(stop: &Value, name: &str) -> f32 {
    stop.get(name).map_or(0.0, |value| as_number(value) as f32)
}

/// Gives a stop a number, with three digits after the point.
pub(super) fn put_number(stop: &mut Value, name: &str, number: f32) {
    let short = (number * 1000.0).round() / 1000.0;
    if let Some(table) = stop.as_table_mut() {
        table.insert(name.to_owned(), Value::Float(f64::from(short)));
    }
}

/// Gives a stop a colour.
pub(super) fn put_color(stop: &mut Value, name: &str, color: Color32) {
    let [r, g, b, a] = color.to_srgba_unmultiplied();
    if let Some(table) = stop.as_table_mut() {
        let text = Color { r, g, b, a }.to_string();
        table.insert(name.to_owned(), Value::String(text));
    }
}

/// What was done to a stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Done {
    /// It was moved by shares of the whole, to the right and up.
    Moved(Vec2),
    /// It was taken out.
    Removed,
}

/// Where the bar or graph of a key's stops is clicked twice, which adds one.
pub(super) fn clicked_twice(ui: &Ui, (key, what): (&str, &str), rect: Rect) -> Option<Pos2> {
    let id = ui.make_persistent_id((key, what));
    let response = ui.interact(rect, id, Sense::click());
    name_it(&response, &format!("{what} of {key}"));
    let response = response.on_hover_text("double click to add a stop");
    let pointer = response.interact_pointer_pos();
    pointer.filter(|_| response.double_clicked())
}

/// A handle in the middle of `rect`, which a share of the whole covers so many points of: drag it, move it by arrow
/// keys, take it out with a right click, Delete or Backspace.
pub(super) fn handle(
    ui: &Ui,
    (key, number): (&str, usize),
    rect: Rect,
    whole: Vec2,
) -> (Response, Option<Done>) {
    let id = ui.make_persistent_id((key, "stop", number));
    let response = ui.interact(rect, id, Sense::click_and_drag());
    name_it(&response, &format!("stop {} of {key}", number + 1));
    let hint = "drag to move; right click or Delete takes it out";
    let response = response.on_hover_text(hint);

    // Take it out.
    let is_focused = response.has_focus();
    let is_deleted = is_focused
        && ui.input(|input| input.key_pressed(Key::Delete) || input.key_pressed(Key::Backspace));
    if response.secondary_clicked() || is_deleted {
        return (response, Some(Done::Removed));
    }

    // Move it with the mouse, or by keys.
    let pointer = response
        .interact_pointer_pos()
        .filter(|_| response.dragged() && response.drag_delta() != Vec2::ZERO);
    let mut by = pointer.map_or(Vec2::ZERO, |pointer| {
        let apart = pointer - rect.center();
        vec2(apart.x, -apart.y) / whole
    });
    let [right, up] = arrows(&response);
    by += vec2(right as f32, up as f32) * STEP;
    let done = (by != Vec2::ZERO).then_some(Done::Moved(by));
    (response, done)
}

/// Where a stop may lie: not before the one ahead of it, nor behind the one that follows.
pub(super) fn bounds(stops: &[Value], number: usize) -> (f32, f32) {
    let before = number.checked_sub(1).map(|i| number_of(&stops[i], "at"));
    let after = stops.get(number + 1).map(|stop| number_of(stop, "at"));
    let low = before.unwrap_or(0.0);
    (low, after.unwrap_or(1.0).max(low))
}

/// Where a stop that is added at a place stands among the others.
pub(super) fn place_among(stops: &[Value], at: f32) -> usize {
    stops.partition_point(|stop| number_of(stop, "at") <= at)
}

/// The square of a handle around a point.
pub(super) fn square(x: f32, y: f32) -> Rect {
    Rect::from_center_size(pos2(x, y), Vec2::splat(HANDLE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_stylesheet::fields;
    use std::collections::BTreeMap;

    /// Notes the form of stops of every list in some fields, by its key.
    fn note(fields: &[Field], path: &str, found: &mut BTreeMap<String, StopForm>) {
        for field in fields {
            let key = format!("{path}{}", field.name);
            match &field.form {
                Form::Table(inner) => note(inner, &format!("{key}."), found),
                Form::List { entry, .. } => {
                    if let Form::Table(inner) = &**entry {
                        found.extend(StopForm::of(inner).map(|form| (key.clone(), form)));
                        note(inner, &format!("{key}."), found);
                    }
                }
                _ => {}
            }
        }
    }

    #[test]
    fn ramps_and_curves_have_stops_and_nothing_else_has() {
        let mut found = BTreeMap::new();
        note(&fields(), "", &mut found);
        assert_eq!(found.get("shade.ramp"), Some(&StopForm::Tone));
        let is_row = |key: &String| {
            let name = key.rsplit('.').next().unwrap_or_default();
            ["ramp", "pressure", "curve"].contains(&name)
        };
        let others: Vec<&String> = found.keys().filter(|key| !is_row(key)).collect();
        assert!(others.is_empty(), "{others:?}");
        assert!(found.len() > 5, "{found:?}");
    }
}
