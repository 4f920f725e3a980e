//! Samples of a brush and of hatching, beside the keys that say them.

use egui::{Color32, Rect, Sense, StrokeKind, Ui, pos2, vec2};

use super::name_it;
use crate::beside::Swatches;
use crate::host::Swatch;

/// Width of a sample, in points.
pub(crate) const SAMPLE_WIDTH: f32 = 236.0;

/// Its height.
const HEIGHT: f32 = 46.0;

/// A sample that stands at the head of a table of the style.
pub(crate) struct Sample {
    /// The table.
    pub table: &'static str,
    /// What is drawn.
    pub swatch: Swatch,
    /// The keys whose values it shows.
    pub values: [&'static str; 3],
}

/// All samples.
pub(crate) const SAMPLES: [Sample; 3] = [
    Sample {
        table: "line.brush",
        swatch: Swatch::Brush,
        values: ["line", "shade", "background"],
    },
    Sample {
        table: "ink.hatch",
        swatch: Swatch::Hatch,
        values: ["ink", "shade", "background"],
    },
    Sample {
        table: "smoke.ink.hatch",
        swatch: Swatch::Hatch,
        values: ["smoke.ink", "shade", "background"],
    },
];

/// Shows the sample of a table of the style, where it has one, and notes that it is in sight.
pub(super) fn show(ui: &mut Ui, table: &str, swatches: &mut Swatches) {
    let Some(sample) = SAMPLES.iter().find(|sample| sample.table == table) else {
        return;
    };
    swatches.scale = ui.ctx().pixels_per_point();
    let width = SAMPLE_WIDTH.min(ui.available_width() - 8.0).max(1.0);
    let (room, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
    name_it(&response, &format!("sample of {table}"));
    response.on_hover_text(match sample.swatch {
        Swatch::Brush => "a stroke in this style, with its brush, width and tapers, twice as large",
        Swatch::Hatch => "this hatching from the dark to the light, even where the style has none",
    });
    if ui.is_rect_visible(room) {
        swatches.in_sight.push(sample.table);
    }

    // Show the rows in the middle of its picture.
    let painter = ui.painter_at(room.expand(1.0));
    match swatches.picture(table) {
        None => {
            painter.rect_filled(room, 2.0, ui.visuals().faint_bg_color);
        }
        Some(picture) => {
            let [wide, tall] = picture.size().map(|side| side.max(1) as f32);
            let share = (HEIGHT / SAMPLE_WIDTH * wide / tall).min(1.0);
            let rows = Rect::from_min_max(
                pos2(0.0, 0.5 - 0.5 * share),
                pos2(width / SAMPLE_WIDTH, 0.5 + 0.5 * share),
            );
            painter.rect_filled(room, 0.0, Color32::from_gray(200));
            painter.image(picture.id(), room, rows, Color32::WHITE);
        }
    }
    let edge = ui.visuals().widgets.noninteractive.bg_stroke;
    painter.rect_stroke(room, 0.0, edge, StrokeKind::Outside);
}
