//! One control for each form that a value of a style takes.

use egui::{ComboBox, DragValue, Id, Response, RichText, Slider, TextEdit, Ui};
use npr_stylesheet::{Background, Color, Field, Form, LONGEST, Length, Unit};
use toml::{Table, Value};

use super::naming::{name_it, stepped};
use super::stops::StopForm;
use super::{Edit, Place, curve, ramp, row};
use crate::value::{as_number, at, text_of};

/// Width of sliders and of other controls, in points.
const WIDTH: f32 = 120.0;

/// Widest range that a slider covers; numbers of wider ones are dragged.
const SLIDER_MAX: f64 = 10_000.0;

/// Where the panel notes whether groups are folded out.
pub(super) const UNFOLDED: &str = "groups are folded out";

/// Units of lengths with their endings, as they are chosen.
const UNITS: [(Unit, &str); 5] = [
    (Unit::RefPx, "px of 1080"),
    (Unit::Px, "px"),
    (Unit::Mm, "mm"),
    (Unit::World, "world"),
    (Unit::FrameHeight, "% height"),
];

/// Shows the control of a key, and gives what the user changed.
pub(super) fn control(ui: &mut Ui, field: &Field, key: &str, now: Option<&Value>) -> Option<Edit> {
    // A key without a value is switched on first.
    let now = now.or(field.usual.as_ref());
    let Some(now) = now else {
        return match &field.form {
            Form::List { count, .. } if count.0 == 0 => {
                let empty = Value::Array(Vec::new());
                let changed = of_form(ui, &field.form, key, &empty);
                changed.map(|value| Edit::Set(key.to_owned(), value))
            }
            Form::Text => {
                let empty = Value::String(String::new());
                let changed = of_form(ui, &field.form, key, &empty);
                changed.map(|value| Edit::Set(key.to_owned(), value))
            }
            form => {
                let button = ui.button(RichText::new("none").weak());
                name_it(&button, key);
                let button = button.on_hover_text("there is no value; click to give one");
                button
                    .clicked()
                    .then(|| Edit::Set(key.to_owned(), form.first()))
            }
        };
    };
    of_form(ui, &field.form, key, now).map(|value| Edit::Set(key.to_owned(), value))
}

/// Shows the control of a value, and gives the value that the user made of it.
fn of_form(ui: &mut Ui, form: &Form, key: &str, now: &Value) -> Option<Value> {
    match form {
        Form::Switch => switch(ui, key, now),
        Form::Choice(words) => choice(ui, words, key, now),
        Form::Number { range, is_whole } => number(ui, (*range, *is_whole), key, now),
        Form::Length => length(ui, key, now),
        Form::Color => color(ui, key, now),
        Form::Background => background(ui, key, now),
        Form::Text => text(ui, key, now),
        Form::List { entry, count } => match &**entry {
            Form::Number { range, is_whole } if count.0 == count.1 => {
                numbers(ui, (*range, *is_whole), key, now)
            }
            entry => list(ui, entry, *count, key, now),
        },
        Form::Either(forms) => either(ui, forms, key, now),
        // Tables are groups of their own; as entries of lists they are shown by the list.
        Form::Table(_) => None,
    }
}

fn switch(ui: &mut Ui, key: &str, now: &Value) -> Option<Value> {
    let mut is_on = now.as_bool().unwrap_or_default();
    let response = ui.checkbox(&mut is_on, "");
    name_it(&response, key);
    response.changed().then_some(Value::Boolean(is_on))
}

fn choice(ui: &mut Ui, words: &[(Value, &'static str)], key: &str, now: &Value) -> Option<Value> {
    let mut chosen = None;
    let shown = ComboBox::from_id_salt(key)
        .width(WIDTH)
        .selected_text(text_of(now))
        .show_ui(ui, |ui| {
            for (word, meaning) in words {
                let mut entry = ui.selectable_label(word == now, text_of(word));
                if !meaning.is_empty() {
                    entry = entry.on_hover_text(*meaning);
                }
                if entry.clicked() && word != now {
                    chosen = Some(word.clone());
                }
            }
        });
    name_it(&shown.response, key);
    let place = words.iter().position(|(word, _)| word == now);
    let there = stepped(&shown.response, place.unwrap_or(0), words.len());
    chosen.or(there.map(|there| words[there].0.clone()))
}

/// A number as a value; fractions are of single precision.
fn number_value(number: f64, is_whole: bool) -> Value {
    match is_whole {
        true => Value::Integer(number.round() as i64),
        false => Value::Float(f64::from(number as f32)),
    }
}

/// A number without digits that single precision makes up.
fn short(number: f64) -> f64 {
    format!("{}", number as f32).parse().unwrap_or(number)
}

fn number(
    ui: &mut Ui,
    ((low, high), is_whole): ((f64, f64), bool),
    key: &str,
    now: &Value,
) -> Option<Value> {
    let mut number = short(as_number(now));
    if high - low > SLIDER_MAX {
        let response = dragged(ui, &mut number, (low, high), is_whole);
        name_it(&response, key);
        return response.changed().then(|| number_value(number, is_whole));
    }
    let mut is_changed = false;
    ui.horizontal(|ui| {
        ui.spacing_mut().slider_width = WIDTH - 20.0;
        let slider = Slider::new(&mut number, low..=high)
            .show_value(false)
            .logarithmic(low >= 0.0 && high - low > 50.0)
            .smallest_positive(0.01);
        let slider = ui.add(if is_whole { slider.integer() } else { slider });
        name_it(&slider, key);
        let value = dragged(ui, &mut number, (low, high), is_whole);
        name_it(&value, &format!("number of {key}"));
        is_changed = slider.changed() || value.changed();
    });
    is_changed.then(|| number_value(number, is_whole))
}

fn dragged(ui: &mut Ui, number: &mut f64, (low, high): (f64, f64), is_whole: bool) -> Response {
    let speed = match is_whole {
        true => 0.2,
        false => (number.abs() * 0.01).max(0.005),
    };
    let decimals = if is_whole { 0 } else { 4 };
    let drag = DragValue::new(number).range(low..=high).speed(speed);
    ui.add(drag.max_decimals(decimals))
}

/// As many numbers as there always are, side by side.
fn numbers(
    ui: &mut Ui,
    (range, is_whole): ((f64, f64), bool),
    key: &str,
    now: &Value,
) -> Option<Value> {
    let mut entries = now.as_array()?.clone();
    let mut is_changed = false;
    ui.horizontal(|ui| {
        for (i, entry) in entries.iter_mut().enumerate() {
            let mut number = short(as_number(entry));
            let response = dragged(ui, &mut number, range, is_whole);
            let name = match i {
                0 => key.to_owned(),
                _ => format!("{key}.{i}"),
            };
            name_it(&response, &name);
            if response.changed() {
                *entry = number_value(number, is_whole);
                is_changed = true;
            }
        }
    });
    is_changed.then_some(Value::Array(entries))
}

fn length(ui: &mut Ui, key: &str, now: &Value) -> Option<Value> {
    let before = match now.as_str() {
        Some(text) => text.parse().ok()?,
        None => Length::ref_px(as_number(now) as f32),
    };
    let mut length = before;
    ui.horizontal(|ui| {
        let mut number = short(f64::from(length.value));
        let speed = (number * 0.01).max(0.005);
        let drag = DragValue::new(&mut number).range(0.0..=f64::from(LONGEST));
        let response = ui.add(drag.speed(speed).max_decimals(4));
        name_it(&response, key);
        if response.changed() {
            length.value = number as f32;
        }
        let word = |unit: Unit| UNITS.iter().find(|(other, _)| *other == unit);
        let shown = ComboBox::from_id_salt((key, "unit"))
            .width(86.0)
            .selected_text(word(length.unit).map_or("", |(_, word)| word))
            .show_ui(ui, |ui| {
                for (unit, word) in UNITS {
                    ui.selectable_value(&mut length.unit, unit, word);
                }
            });
        name_it(&shown.response, &format!("unit of {key}"));
        let place = UNITS.iter().position(|(unit, _)| *unit == length.unit);
        if let Some(there) = stepped(&shown.response, place.unwrap_or(0), UNITS.len()) {
            length.unit = UNITS[there].0;
        }
    });
    (length != before).then(|| match length.unit {
        Unit::RefPx => Value::Float(f64::from(length.value)),
        _ => Value::String(length.to_string()),
    })
}

/// The colour button and the text of a colour.
fn color(ui: &mut Ui, key: &str, now: &Value) -> Option<Value> {
    let before: Color = now.as_str()?.parse().ok()?;
    let mut changed = None;
    ui.horizontal(|ui| {
        let mut rgba = [before.r, before.g, before.b, before.a];
        let response = ui.color_edit_button_srgba_unmultiplied(&mut rgba);
        name_it(&response, key);
        if response.changed() {
            let [r, g, b, a] = rgba;
            changed = Some(Color { r, g, b, a });
        }
        if let Some(text) = line_of_text(ui, &format!("text of {key}"), &before.to_string(), 78.0) {
            changed = text.parse().ok().or(changed);
        }
    });
    let changed = changed.filter(|color| *color != before)?;
    Some(Value::String(changed.to_string()))
}

fn background(ui: &mut Ui, key: &str, now: &Value) -> Option<Value> {
    let now = now.as_str()?;
    let mut changed = None;
    ui.horizontal(|ui| {
        if let Ok(Background::Color(color)) = now.parse() {
            let mut rgba = [color.r, color.g, color.b, color.a];
            let response = ui.color_edit_button_srgba_unmultiplied(&mut rgba);
            name_it(&response, &format!("colour of {key}"));
            if response.changed() {
                let [r, g, b, a] = rgba;
                changed = Some(Color { r, g, b, a }.to_string());
            }
        }
        changed = line_of_text(ui, key, now, 78.0).or(changed.take());
    });
    changed.filter(|text| text != now).map(Value::String)
}

fn text(ui: &mut Ui, key: &str, now: &Value) -> Option<Value> {
    line_of_text(ui, key, now.as_str()?, WIDTH + 10.0).map(Value::String)
}

/// A line of text that counts once it is left, or finished with Enter.
pub(crate) fn line_of_text(ui: &mut Ui, key: &str, now: &str, width: f32) -> Option<String> {
    let id = ui.make_persistent_id((key, "text"));
    let kept = ui.data(|data| data.get_temp::<String>(id));
    let mut text = kept.unwrap_or_else(|| now.to_owned());
    let response = ui.add(TextEdit::singleline(&mut text).desired_width(width));
    name_it(&response, key);
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, text));
        return None;
    }
    ui.data_mut(|data| data.remove_temp::<String>(id));
    (response.lost_focus() && text != now).then_some(text)
}

/// A value of one form or another: which form, and the control of that.
fn either(ui: &mut Ui, forms: &[Form], key: &str, now: &Value) -> Option<Value> {
    let place = forms.iter().position(|form| form.is_of(now)).unwrap_or(0);
    let mut chosen = place;
    ui.horizontal(|ui| {
        for (i, form) in forms.iter().enumerate() {
            let button = ui.selectable_value(&mut chosen, i, form_name(form));
            name_it(&button, &format!("{key} as {}", form_name(form)));
        }
    });
    let changed = of_form(ui, &forms[place], key, now);
    match chosen == place {
        true => changed,
        false => Some(forms[chosen].first()),
    }
}

fn form_name(form: &Form) -> &'static str {
    match form {
        Form::Switch => "all or none",
        Form::Choice(_) => "a choice",
        Form::Number { .. } | Form::Length => "a number",
        Form::Color | Form::Background => "a colour",
        Form::Text => "one",
        Form::List { .. } => "several",
        Form::Table(_) | Form::Either(_) => "a group",
    }
}

/// Entries below each other, each with a way to take it out, and one to add another.
fn list(
    ui: &mut Ui,
    entry: &Form,
    (fewest, most): (u64, u64),
    key: &str,
    now: &Value,
) -> Option<Value> {
    let entries = now.as_array()?;
    // Stops are taken by the hand, and their numbers stand below.
    let mut changed: Option<Vec<Value>> = None;
    if let Form::Table(fields) = entry
        && let Some(form) = StopForm::of(fields)
    {
        let count = (fewest, most);
        changed = match form {
            StopForm::Factor => curve::edit(ui, fields, count, key, entries),
            _ => ramp::edit(ui, (form, fields), count, key, entries),
        };
    }
    let count = entries.len() as u64;
    for (i, value) in entries.iter().enumerate() {
        ui.push_id(i, |ui| {
            // Show the entry.
            let below = format!("{key}.{i}");
            ui.horizontal(|ui| {
                ui.label(RichText::new(format!("{}.", i + 1)).weak());
                if !matches!(entry, Form::Table(_))
                    && let Some(value) = of_form(ui, entry, &below, value)
                {
                    changed.get_or_insert_with(|| entries.clone())[i] = value;
                }
                let button = ui.add_enabled(count > fewest, egui::Button::new("−").small());
                name_it(&button, &format!("remove {below}"));
                if button.on_hover_text("take it out").clicked() {
                    changed.get_or_insert_with(|| entries.clone()).remove(i);
                }
            });
            if let Form::Table(fields) = entry
                && let Some(value) = entry_table(ui, fields, &below, value)
            {
                changed.get_or_insert_with(|| entries.clone())[i] = value;
            }
        });
    }
    let button = ui.add_enabled(count < most, egui::Button::new("+").small());
    name_it(&button, key);
    if button.on_hover_text("add one").clicked() {
        let entries = changed.get_or_insert_with(|| entries.clone());
        entries.push(entries.last().cloned().unwrap_or_else(|| entry.first()));
    }
    changed.map(Value::Array)
}

/// The keys of a table that is an entry of a list.
fn entry_table(ui: &mut Ui, fields: &[Field], key: &str, now: &Value) -> Option<Value> {
    let unfolded = ui.data(|data| data.get_temp(Id::unique(UNFOLDED)).unwrap_or_default());
    let place = Place {
        words: Vec::new(),
        unfolded,
        is_changed: &|_| false,
        show_sample: &|_, _| (),
    };
    let start = key.len() + 1;
    let value = |below: &str| at(now, &below[start..]).cloned();
    let mut edits = Vec::new();
    for field in fields {
        let below = format!("{key}.{}", field.name);
        row(ui, &place, field, &below, &value, &mut edits);
    }
    let mut table = now.clone();
    let is_changed = !edits.is_empty();
    for edit in edits {
        match edit {
            Edit::Set(key, value) => put(&mut table, &key[start..], Some(value)),
            Edit::Reset(key) => put(&mut table, &key[start..], None),
        }
    }
    is_changed.then_some(table)
}

/// Puts a value at a dotted key below tables, or takes away what is there.
fn put(table: &mut Value, key: &str, value: Option<Value>) {
    let Some(table) = table.as_table_mut() else {
        return;
    };
    match (key.split_once('.'), value) {
        (Some((name, rest)), value) => {
            let inner = table
                .entry(name)
                .or_insert_with(|| Value::Table(Table::new()));
            put(inner, rest, value);
        }
        (None, Some(value)) => {
            table.insert(key.to_owned(), value);
        }
        (None, None) => {
            table.remove(key);
        }
    }
}
