//! How long pictures take: a bar for every pass, and a graph of the last pictures.

use std::collections::VecDeque;

use egui::{Align, Color32, Label, Layout, Rect, RichText, Sense, StrokeKind, Ui, pos2, vec2};

use crate::host::{PassSeconds, Picture};
use crate::panel::name_it;

/// Pictures that the graph shows.
const FRAMES: usize = 60;

/// Passes with a bar of their own: those that take longest.
const ROWS: usize = 14;

/// Seconds of a frame where twenty are shown a second: the line in the graph.
const SMOOTH_S: f32 = 0.05;

/// Width of the names of passes, and of their bars, in points.
const WIDTHS: [f32; 2] = [132.0, 64.0];

/// Height of a bar of a picture, in points.
const BAR: f32 = 6.0;

/// Height of the graph, in points.
const GRAPH: f32 = 56.0;

/// What is told of a full picture, and of a draft.
const KINDS: [&str; 2] = ["last full picture", "last draft"];

/// Colours of both.
const COLORS: [Color32; 2] = [
    Color32::from_rgb(0x3d, 0x7e, 0xd6),
    Color32::from_rgb(0xe0, 0x8a, 0x1e),
];

/// How long the last pictures took.
#[derive(Default)]
pub(crate) struct Times {
    /// The last full picture, and the last draft.
    last: [Option<Taken>; 2],
    /// Seconds of the last pictures, the newest at the end, and whether each was a draft.
    frames: VecDeque<(f32, bool)>,
}

/// How long a picture took.
struct Taken {
    seconds: f32,
    /// Its passes; none where the engine cannot tell them apart.
    passes: Option<Vec<PassSeconds>>,
}

/// A line of the section: a name, and seconds in the full picture and in the draft.
type Row = (String, [f32; 2]);

impl Times {
    /// Notes a picture that was drawn.
    pub fn note(&mut self, picture: &Picture) {
        let is_draft = picture.order.is_draft;
        self.last[usize::from(is_draft)] = Some(Taken {
            seconds: picture.seconds,
            passes: picture.passes.clone(),
        });
        self.frames.push_back((picture.seconds, is_draft));
        if self.frames.len() > FRAMES {
            self.frames.pop_front();
        }
    }

    /// The lines: passes that take longest in the order in which they run, all others as one, and what is no pass.
    fn rows(&self) -> Vec<Row> {
        // Add up passes that run more than once.
        let mut rows: Vec<Row> = Vec::new();
        for (place, taken) in self.last.iter().enumerate() {
            let passes = taken.iter().flat_map(|taken| &taken.passes).flatten();
            for pass in passes {
                let found = rows.iter().position(|(name, _)| name == pass.name);
                let at = found.unwrap_or_else(|| {
                    rows.push((pass.name.to_owned(), [0.0; 2]));
                    rows.len() - 1
                });
                rows[at].1[place] += pass.seconds;
            }
        }

        // What is left of each picture is no pass.
        let mut rest = [0.0; 2];
        for (place, taken) in self.last.iter().enumerate() {
            let passes: f32 = rows.iter().map(|(_, seconds)| seconds[place]).sum();
            let whole = taken.as_ref().map_or(0.0, |taken| taken.seconds);
            rest[place] = (whole - passes).max(0.0);
        }

        // Keep those that take longest.
        let longest = |row: &Row| row.1[0].max(row.1[1]);
        let mut sorted: Vec<f32> = rows.iter().map(longest).collect();
        sorted.sort_by(|a, b| b.total_cmp(a));
        let least = sorted.get(ROWS).copied().unwrap_or(-1.0);
        let (mut kept, others): (Vec<Row>, Vec<Row>) =
            rows.into_iter().partition(|row| longest(row) > least);
        if others.len() == 1 {
            kept.extend(others);
        } else if !others.is_empty() {
            let sum = |place: usize| others.iter().map(|(_, seconds)| seconds[place]).sum();
            let name = format!("{} other passes", others.len());
            kept.push((name, [sum(0), sum(1)]));
        }
        let name = if kept.is_empty() {
            "everything"
        } else {
            "everything else"
        };
        kept.push((name.to_owned(), rest));
        kept
    }

    /// Whether a picture was drawn by an engine that cannot tell its passes apart.
    fn is_blind(&self) -> bool {
        let mut all = self.last.iter().flatten();
        all.any(|taken| taken.passes.is_none())
    }

    /// Shows all of it.
    pub fn show(&self, ui: &mut Ui) {
        if self.frames.is_empty() {
            ui.label("no picture is drawn yet");
            return;
        }

        // Say what the colours mean, and what cannot be told.
        for ((kind, color), taken) in KINDS.iter().zip(COLORS).zip(&self.last) {
            let text = match taken {
                Some(taken) => format!("{kind}: {}", milliseconds(taken.seconds)),
                None => format!("{kind}: none yet"),
            };
            ui.horizontal(|ui| {
                let side = vec2(10.0, 10.0);
                let (square, _) = ui.allocate_exact_size(side, Sense::hover());
                ui.painter().rect_filled(square, 2.0, color);
                ui.label(text);
            });
        }
        if self.is_blind() {
            ui.label(
                "This adapter has no time stamps that tell passes apart: npr render --timings runs each alone.",
            );
        }

        // Show a bar for every pass.
        let rows = self.rows();
        let longest = rows.iter().flat_map(|(_, seconds)| seconds);
        let longest = longest.fold(f32::MIN_POSITIVE, |most, seconds| most.max(*seconds));
        for row in &rows {
            show_row(ui, row, longest);
        }
        self.show_graph(ui);
    }

    /// Shows how long each of the last pictures took, the newest at the right.
    fn show_graph(&self, ui: &mut Ui) {
        // Make room, as high as the longest.
        let longest = self
            .frames
            .iter()
            .fold(0.0_f32, |most, (s, _)| most.max(*s));
        ui.add_space(4.0);
        let count = self.frames.len();
        let most = milliseconds(longest);
        ui.label(format!("the last {count} pictures, {most} at most"));
        let width = (ui.available_width() - 8.0).clamp(40.0, 280.0);
        let (room, response) = ui.allocate_exact_size(vec2(width, GRAPH), Sense::hover());
        name_it(&response, "Times of the last pictures");
        response.on_hover_text("the line is a twentieth of a second: below it, drags are smooth");

        // Paint it.
        let painter = ui.painter_at(room.expand(1.0));
        let top = (1.1 * longest).max(2.0 * SMOOTH_S);
        painter.rect_filled(room, 0.0, ui.visuals().extreme_bg_color);
        let wide = width / FRAMES as f32;
        let first = FRAMES - self.frames.len();
        for (i, (seconds, is_draft)) in self.frames.iter().enumerate() {
            let left = room.left() + (first + i) as f32 * wide;
            let height = (seconds / top).clamp(0.0, 1.0) * room.height();
            let bar = Rect::from_min_max(
                pos2(left, room.bottom() - height.max(1.0)),
                pos2(left + wide - 1.0, room.bottom()),
            );
            painter.rect_filled(bar, 0.0, COLORS[usize::from(*is_draft)]);
        }
        let faint = ui.visuals().widgets.noninteractive.fg_stroke;
        let smooth = room.bottom() - SMOOTH_S / top * room.height();
        painter.hline(room.x_range(), smooth, faint);
        let edge = ui.visuals().widgets.noninteractive.bg_stroke;
        painter.rect_stroke(room, 0.0, edge, StrokeKind::Outside);
    }
}

/// Shows a pass: its name, a bar for each picture, and their milliseconds.
fn show_row(ui: &mut Ui, (name, seconds): &Row, longest: f32) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 6.0;
        let [name_width, bar_width] = WIDTHS;
        let size = vec2(name_width, 2.0 * BAR + 2.0);
        let from_left = Layout::left_to_right(Align::Center);
        ui.allocate_ui_with_layout(size, from_left, |ui| {
            ui.set_min_width(name_width);
            ui.add(Label::new(RichText::new(name).small()).truncate());
        });
        let size = vec2(bar_width, 2.0 * BAR);
        let (room, _) = ui.allocate_exact_size(size, Sense::hover());
        for (place, color) in COLORS.into_iter().enumerate() {
            let share = (seconds[place] / longest).clamp(0.0, 1.0);
            let corner = room.min + vec2(0.0, BAR * place as f32);
            let bar = Rect::from_min_size(corner, vec2((share * bar_width).max(0.5), BAR - 1.0));
            ui.painter().rect_filled(bar, 0.0, color);
        }
        let [full, draft] = seconds.map(short);
        let text = RichText::new(format!("{full} / {draft} ms")).small();
        ui.add(Label::new(text).truncate());
    });
}

fn milliseconds(seconds: f32) -> String {
    format!("{} ms", short(seconds))
}

/// Milliseconds with a digit behind the point, where there are not many before it.
fn short(seconds: f32) -> String {
    match seconds < 0.1 {
        true => format!("{:.1}", 1e3 * seconds),
        false => format!("{:.0}", 1e3 * seconds),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(seconds: f32, passes: &[(&'static str, f32)]) -> Option<Taken> {
        let passes = passes
            .iter()
            .map(|&(name, seconds)| PassSeconds { name, seconds });
        Some(Taken {
            seconds,
            passes: Some(passes.collect()),
        })
    }

    #[test]
    fn passes_are_added_up_and_what_is_no_pass_is_left() {
        let times = Times {
            last: [
                taken(1.0, &[("a", 0.125), ("b", 0.25), ("a", 0.125)]),
                taken(0.5, &[("b", 0.125), ("c", 0.25)]),
            ],
            frames: VecDeque::new(),
        };
        let named = |name: &str, seconds| (name.to_owned(), seconds);
        assert_eq!(
            times.rows(),
            [
                named("a", [0.25, 0.0]),
                named("b", [0.25, 0.125]),
                named("c", [0.0, 0.25]),
                named("everything else", [0.5, 0.125]),
            ]
        );
    }

    #[test]
    fn passes_that_take_least_are_one_line() {
        let names: [&'static str; 20] = [
            "a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p", "q",
            "r", "s", "t",
        ];
        let passes: Vec<(&'static str, f32)> =
            (1..).zip(names).map(|(i, n)| (n, i as f32)).collect();
        let times = Times {
            last: [taken(300.0, &passes), None],
            frames: VecDeque::new(),
        };
        let rows = times.rows();
        assert_eq!(rows.len(), ROWS + 2);
        assert_eq!(rows[0], ("g".to_owned(), [7.0, 0.0]));
        assert_eq!(rows[ROWS], ("6 other passes".to_owned(), [21.0, 0.0]));
        assert_eq!(rows[ROWS + 1].1, [90.0, 0.0]);
    }
}
