//! The card that says why a line is there, and the mark on the line.

use egui::{Color32, Pos2, Rect, RichText, Stroke, Ui};
use toml::{Table, Value};

use super::Studio;
use crate::host::Question;
use crate::panel::Edit;
use crate::why::{Answer, ToldLine, with_rule};

/// How far from a line a click may be that means it, in points.
const REACH: f32 = 6.0;

/// Width of the card, in points.
const CARD_WIDTH: f32 = 330.0;

impl Studio {
    /// What is told of the line that was clicked last, if there is one.
    pub fn told_line(&self) -> Option<&ToldLine> {
        self.asked.answer.as_ref()?.line.as_ref()
    }

    /// Takes what the host tells, unless something else was asked since.
    pub(super) fn take_answer(&mut self, answer: Answer, ui: &Ui) {
        let asked = self.asked.open.map(|(change, _)| change);
        if asked != Some(answer.change) {
            return;
        }
        if self.asked.is_for_guide {
            self.asked.clear();
            return self.add_guide(answer.part.as_ref(), ui);
        }
        self.asked.answer = Some(answer);
    }

    /// Takes a click on the picture that covers `place`: it places guide points, or asks why a line is there.
    pub(super) fn click(&mut self, pointer: Pos2, place: Rect, ui: &Ui) {
        if self.places_guides && self.remove_guide(pointer, place, ui) {
            return;
        }
        self.asked.is_for_guide = self.places_guides;
        self.point_at(pointer, place);
    }

    /// Asks what is at a place of the window, where the full picture covers `place`.
    fn point_at(&mut self, pointer: Pos2, place: Rect) {
        self.asked.clear();
        if !place.contains(pointer) {
            return;
        }
        let order = self.order();
        let [width, height] = order.size.map(|side| side as f32);
        let share = (pointer - place.min) / place.size();
        self.asked.open = Some((order.change, pointer));
        self.asked.number += 1;
        self.host.point_at(Question {
            place: [share.x * width, share.y * height],
            reach_px: REACH * height / place.height().max(1.0),
            order,
        });
    }

    /// Marks the line that was clicked, and shows what is told of it within `room`.
    pub(super) fn show_why(&mut self, ui: &mut Ui, room: Rect, place: Rect) {
        // Forget what was told of another picture.
        let change = self.change;
        if self.asked.open.is_some_and(|(asked, _)| asked != change) {
            self.asked.clear();
        }
        let (Some((_, at)), Some(answer)) = (self.asked.open, self.asked.answer.clone()) else {
            return;
        };
        if let Some(line) = &answer.line {
            mark(ui, line, place);
        }
        if answer
            == (Answer {
                change,
                ..Answer::default()
            })
        {
            return;
        }

        // Show the card on the other side of the picture.
        let left = match at.x < room.center().x {
            true => (room.right() - CARD_WIDTH - 30.0).max(room.left()),
            false => room.left() + 10.0,
        };
        let mut is_open = !ui.input(|input| input.key_pressed(egui::Key::Escape));
        let mut edit = None;
        let title = match answer.line {
            Some(_) => "Why is this line here?",
            None => "What is here?",
        };
        egui::Window::new(title)
            .id(egui::Id::unique(("why", self.asked.number)))
            .open(&mut is_open)
            .default_pos(egui::pos2(left, room.top() + 10.0))
            .constrain_to(room)
            .collapsible(false)
            .resizable(false)
            .default_width(CARD_WIDTH)
            .show(ui.ctx(), |ui| {
                ui.set_max_width(CARD_WIDTH);
                edit = self.show_answer(ui, &answer);
            });
        if !is_open {
            self.asked.clear();
        }
        if let Some(edit) = edit {
            self.history.close();
            self.edit(&edit, ui);
            self.history.close();
        }
    }

    /// Shows what is told, and gives what the user changed by it.
    fn show_answer(&mut self, ui: &mut Ui, answer: &Answer) -> Option<Edit> {
        let mut edit = None;
        if let Some(line) = &answer.line {
            for fact in &line.facts {
                ui.horizontal_wrapped(|ui| {
                    ui.spacing_mut().item_spacing.x = 5.0;
                    if fact.name.is_empty() {
                        ui.add_space(14.0);
                    } else {
                        ui.label(RichText::new(&fact.name).strong());
                    }
                    ui.label(&fact.text);
                    if let Some(key) = &fact.key {
                        let link = ui.link(RichText::new(key).small());
                        if link.on_hover_text("show this key in the panel").clicked() {
                            searched(key).clone_into(&mut self.panel.search);
                        }
                    }
                });
            }
            ui.separator();
            if ui.button(line.removal.text()).clicked() {
                let (key, value) = line.removal.change(&self.sheet, &line.part);
                edit = Some(Edit::Set(key, value));
            }
        }
        if let Some(notice) = &answer.notice {
            ui.label(notice);
        }

        // Offer a rule for the part.
        let part = match &answer.line {
            Some(line) => Some(&line.part),
            None => answer.part.as_ref(),
        };
        if let Some(part) = part {
            if answer.line.is_none() {
                ui.label(format!(
                    "Object '{}', material '{}'",
                    part.object, part.material
                ));
            }
            let button = ui.button("A rule for this part");
            if button
                .on_hover_text(
                    "adds a rule that matches its object and material; state in it what changes",
                )
                .clicked()
            {
                let (key, rules) = with_rule(&self.sheet, part, Table::new());
                edit = Some(Edit::Set(key, Value::Array(rules)));
                self.panel.search = "rule".to_owned();
            }
        }
        edit
    }
}

/// What to search the panel for to find a key: rules are one list.
fn searched(key: &str) -> &str {
    match key.starts_with("rule.") {
        true => "rule",
        false => key,
    }
}

/// Draws a line over the picture that covers `place`.
fn mark(ui: &Ui, line: &ToldLine, place: Rect) {
    let at = |[x, y]: &[f32; 2]| place.min + egui::vec2(*x, *y) * place.size();
    let mut points: Vec<Pos2> = line.points.iter().map(at).collect();
    if line.closed {
        points.extend(points.first().copied());
    }
    let painter = ui.painter().with_clip_rect(place);
    let halo = Stroke::new(5.0, Color32::from_white_alpha(200));
    painter.line(points.clone(), halo);
    painter.line(
        points,
        Stroke::new(2.5, Color32::from_rgb(0x10, 0x80, 0xff)),
    );
}
