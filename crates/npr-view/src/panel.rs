//! The panel: a control for every key of a style, made from its schema.

mod controls;
mod curve;
mod naming;
mod ramp;
mod samples;
mod stops;

use std::cell::RefCell;

use egui::collapsing_header::CollapsingState;
use egui::{Id, RichText, Ui};
use npr_stylesheet::{Field, Form, fields};
use toml::Value;

use crate::beside::Swatches;
use crate::sheet::Sheet;
pub(crate) use controls::line_of_text;
use controls::{UNFOLDED, control};
pub(crate) use naming::{arrows, name_it, stepped};
pub(crate) use samples::{SAMPLE_WIDTH, SAMPLES, Sample};

/// Width of the names of keys, in points.
const NAME_WIDTH: f32 = 118.0;

/// A change that was made in the panel.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Edit {
    /// A key gets a value.
    Set(String, Value),
    /// A key gets its value of the base back.
    Reset(String),
}

impl Edit {
    /// The key that changes.
    pub fn key(&self) -> &str {
        match self {
            Self::Set(key, _) | Self::Reset(key) => key,
        }
    }
}

/// The panel with what is searched in it.
pub(crate) struct Panel {
    fields: Vec<Field>,
    /// Which keys are shown: those whose name or description holds these words.
    pub search: String,
    /// Whether groups are folded out that nobody touched yet, and how often that was chosen.
    unfolded: (bool, u32),
}

/// Where a row stands, and what it may ask of the style.
struct Place<'a> {
    /// Words in lower case that are searched; none for all keys.
    words: Vec<String>,
    unfolded: (bool, u32),
    /// Whether a key differs from the base.
    is_changed: &'a dyn Fn(&str) -> bool,
    /// Shows the sample of a table, where it has one.
    show_sample: &'a dyn Fn(&mut Ui, &str),
}

impl Default for Panel {
    fn default() -> Self {
        Self {
            fields: fields(),
            search: String::new(),
            unfolded: (false, 0),
        }
    }
}

impl Panel {
    /// Folds all groups out or in.
    pub fn fold(&mut self, is_open: bool) {
        self.unfolded = (is_open, self.unfolded.1 + 1);
    }

    /// Whether some texts hold, between them, every word that is searched for.
    pub fn finds(&self, texts: &[&str]) -> bool {
        let (search, text) = (self.search.to_lowercase(), texts.join(" ").to_lowercase());
        search.split_whitespace().all(|word| text.contains(word))
    }

    /// Shows the controls of a style with samples beside some, and gives what the user changed.
    pub fn show(&mut self, ui: &mut Ui, sheet: &Sheet, samples: &mut Swatches) -> Vec<Edit> {
        samples.in_sight.clear();
        let seen = RefCell::new(samples);
        let search = self.search.to_lowercase();
        let place = Place {
            words: search.split_whitespace().map(str::to_owned).collect(),
            unfolded: self.unfolded,
            is_changed: &|key| sheet.is_changed(key),
            show_sample: &|ui, table| samples::show(ui, table, &mut seen.borrow_mut()),
        };
        ui.data_mut(|data| data.insert_temp(Id::unique(UNFOLDED), self.unfolded));
        let mut edits = Vec::new();

        // Show the plain keys of the style as a group of their own.
        let is_table = |field: &&Field| matches!(field.form, Form::Table(_));
        let plain: Vec<&Field> = self
            .fields
            .iter()
            .filter(|field| !is_table(field))
            .collect();
        let value = |key: &str| sheet.value(key).cloned();
        let shown = plain.iter().any(|field| place.shows(field, field.name));
        if shown {
            let changed = plain.iter().any(|field| sheet.is_changed(field.name));
            group(ui, &place, ("general", "General", ""), changed, |ui| {
                for field in plain {
                    row(ui, &place, field, field.name, &value, &mut edits);
                }
            });
        }

        // Show every table.
        for field in self.fields.iter().filter(is_table) {
            row(ui, &place, field, field.name, &value, &mut edits);
        }
        edits
    }
}

impl Place<'_> {
    /// Whether a key, or one within it, is searched for.
    fn shows(&self, field: &Field, key: &str) -> bool {
        if self.words.is_empty() || self.is_hit(field, key) {
            return true;
        }
        let inner = match &field.form {
            Form::Table(fields) => fields,
            _ => return false,
        };
        let mut inner = inner.iter();
        inner.any(|field| self.shows(field, &format!("{key}.{}", field.name)))
    }

    /// Whether key or description hold every word.
    fn is_hit(&self, field: &Field, key: &str) -> bool {
        let text = format!("{key} {} {}", plain_name(field.name), field.text).to_lowercase();
        self.words.iter().all(|word| text.contains(word))
    }

    /// The same place below a key that is hit itself: all of it is shown.
    fn below(&self, field: &Field, key: &str) -> Place<'_> {
        let is_hit = !self.words.is_empty() && self.is_hit(field, key);
        Place {
            words: if is_hit {
                Vec::new()
            } else {
                self.words.clone()
            },
            unfolded: (is_hit || self.unfolded.0, self.unfolded.1),
            is_changed: self.is_changed,
            show_sample: self.show_sample,
        }
    }
}

/// Shows a key: a table as a group, anything else as a line with its name, its control and a way back.
fn row(
    ui: &mut Ui,
    place: &Place<'_>,
    field: &Field,
    key: &str,
    value: &dyn Fn(&str) -> Option<Value>,
    edits: &mut Vec<Edit>,
) {
    if !place.shows(field, key) {
        return;
    }
    let name = plain_name(field.name);
    let changed = (place.is_changed)(key);
    let now = value(key);
    let Form::Table(inner) = &field.form else {
        line(ui, place, (field, key, &name), now, edits);
        return;
    };
    let below = place.below(field, key);
    group(ui, place, (key, &name, field.text), changed, |ui| {
        // A table that may be missing can be taken away and brought back.
        if field.usual.is_none() && !field.is_required && is_optional(field, now.as_ref()) {
            let mut is_there = now.is_some();
            let switch = ui.checkbox(&mut is_there, "there is one");
            name_it(&switch, key);
            if switch.changed() {
                edits.push(match is_there {
                    true => Edit::Set(key.to_owned(), field.form.first()),
                    false => Edit::Reset(key.to_owned()),
                });
            }
            if !is_there {
                return;
            }
        }
        (place.show_sample)(ui, key);
        for field in inner {
            let key = format!("{key}.{}", field.name);
            row(ui, &below, field, &key, value, edits);
        }
    });
}

/// Whether a table may have no value: it has none, or its keys demand some.
fn is_optional(field: &Field, now: Option<&Value>) -> bool {
    let Form::Table(inner) = &field.form else {
        return false;
    };
    now.is_none() || inner.iter().any(|field| field.is_required)
}

/// A group of keys that folds.
fn group(
    ui: &mut Ui,
    place: &Place<'_>,
    (key, name, text): (&str, &str, &str),
    is_changed: bool,
    add: impl FnOnce(&mut Ui),
) {
    let is_open = place.unfolded.0 || !place.words.is_empty();
    let id = ui.make_persistent_id(("group", key, is_open, place.unfolded.1));
    let state = CollapsingState::load_with_default_open(ui.ctx(), id, is_open);
    let mut title = RichText::new(name);
    if !key.contains('.') {
        title = title.strong().size(15.0);
    }
    let mut is_clicked = false;
    let mut header = state.show_header(ui, |ui| {
        // The arrow before it has the keys for both.
        let title = egui::Label::new(title).sense(egui::Sense::CLICK);
        let mut response = ui.add(title);
        if !text.is_empty() {
            response = response.on_hover_text(text);
        }
        if is_changed {
            ui.label(
                RichText::new("•")
                    .color(ui.visuals().selection.bg_fill)
                    .size(16.0),
            )
            .on_hover_text("changed");
        }
        is_clicked = response.clicked();
    });
    if is_clicked {
        header.toggle();
    }
    let (fold, ..) = header.body(|ui| add(ui));
    name_it(&fold, &format!("fold {key}"));
}

/// A key in a line: its name, its control, and a button that takes a change back.
fn line(
    ui: &mut Ui,
    place: &Place<'_>,
    (field, key, name): (&Field, &str, &str),
    now: Option<Value>,
    edits: &mut Vec<Edit>,
) {
    ui.push_id(key, |ui| {
        let is_changed = (place.is_changed)(key);
        let is_wide = match &field.form {
            Form::List { entry, .. } => matches!(**entry, Form::Table(_)),
            _ => false,
        };
        let mut edit = None;
        ui.horizontal_top(|ui| {
            // Write the name in a column of its own.
            let indent = ui.cursor().left() - ui.clip_rect().left();
            let width = (NAME_WIDTH + 24.0 - indent).max(60.0);
            let height = ui.spacing().interact_size.y;
            let hint = format!("{}\n\n{key}", field.text);
            let text = match is_changed {
                true => RichText::new(name).strong(),
                false => RichText::new(name),
            };
            ui.allocate_ui_with_layout(
                egui::vec2(width, height),
                egui::Layout::left_to_right(egui::Align::Center),
                |ui| {
                    ui.set_min_width(width);
                    ui.add(egui::Label::new(text).truncate())
                        .on_hover_text(hint);
                },
            );

            // Show the control beside it.
            if !is_wide {
                ui.vertical(|ui| edit = control(ui, field, key, now.as_ref()));
            }
        });

        // Show a list of tables below, and the way back.
        if is_wide {
            ui.indent(key, |ui| edit = control(ui, field, key, now.as_ref()));
        }
        if is_changed {
            // Lay it over the right end of the line.
            let row = ui.min_rect();
            let side = ui.spacing().interact_size.y;
            let corner = egui::pos2(ui.max_rect().right() - side, row.top());
            let place = egui::Rect::from_min_size(corner, egui::vec2(side, side));
            let back = ui.put(place, egui::Button::new("×").frame(false));
            name_it(&back, &format!("reset {key}"));
            if back
                .on_hover_text("back to the style's own value")
                .clicked()
            {
                edits.push(Edit::Reset(key.to_owned()));
            }
        }
        edits.extend(edit);
    });
}

/// The name of a key in plain words: `width_factor` is "Width factor".
pub(crate) fn plain_name(name: &str) -> String {
    let name = name.replace('_', " ");
    let mut letters = name.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}
