//! Curves of factors: a graph with a handle at every stop.

use egui::{Color32, Rect, Sense, Stroke, Ui, pos2, vec2};
use npr_drawing::pressure::Curve;
use npr_stylesheet::Field;
use toml::Value;

use super::stops::{
    Done, HANDLE, bounds, clicked_twice, handle, number_of, place_among, put_number, range_of,
    square,
};

/// Size of the graph, in points.
const SIZE: [f32; 2] = [200.0, 90.0];

/// Least height that the graph shows: factors of pens are seldom greater.
const TOP: f32 = 2.0;

/// Pieces that the curve is drawn in.
const PIECES: usize = 80;

/// Shows stops as a curve, and gives the stops that the user made of them.
pub(super) fn edit(
    ui: &mut Ui,
    fields: &[Field],
    (fewest, most): (u64, u64),
    key: &str,
    stops: &[Value],
) -> Option<Vec<Value>> {
    // Make room for the graph: high enough for the greatest factor, and no lower than before while one is dragged.
    let width = SIZE[0].min(ui.available_width() - HANDLE).max(40.0);
    let room = vec2(width + HANDLE, SIZE[1] + HANDLE);
    let (whole, _) = ui.allocate_exact_size(room, Sense::hover());
    let graph = whole.shrink(0.5 * HANDLE);
    let (least, greatest) = range_of(fields, "factor");
    let top_id = ui.make_persistent_id((key, "top"));
    let is_held = ui.input(|input| input.pointer.any_down());
    let needed = stops.iter().map(|stop| number_of(stop, "factor") * 1.1);
    let mut top = needed.fold(TOP, f32::max).min(greatest as f32);
    if is_held {
        top = ui.data(|data| data.get_temp(top_id)).unwrap_or(top);
    }
    ui.data_mut(|data| data.insert_temp(top_id, top));

    // Draw the curve.
    let places: Vec<[f64; 2]> = stops
        .iter()
        .map(|stop| ["at", "factor"].map(|name| f64::from(number_of(stop, name))))
        .collect();
    let curve = Curve::new(&places);
    paint(ui, graph, &curve, top);

    // Add a stop where the graph is clicked twice.
    let count = stops.len() as u64;
    let mut changed = None;
    if let Some(pointer) = clicked_twice(ui, (key, "graph"), graph)
        && count < most
    {
        let at = ((pointer.x - graph.left()) / width).clamp(0.0, 1.0);
        let factor = (graph.bottom() - pointer.y) / graph.height() * top;
        let mut stop = Value::Table(toml::Table::new());
        put_number(&mut stop, "at", at);
        put_number(&mut stop, "factor", factor.clamp(least as f32, top));
        let stops = changed.get_or_insert_with(|| stops.to_vec());
        stops.insert(place_among(stops, at), stop);
    }

    // Show the handles, and follow what is done to them.
    for (i, stop) in stops.iter().enumerate() {
        let [at, factor] = ["at", "factor"].map(|name| number_of(stop, name));
        let place = graph.left_bottom() + vec2(at * width, -factor / top * graph.height());
        let place = square(place.x, place.y.max(graph.top()));
        let (response, done) = handle(ui, (key, i), place, graph.size());
        let is_active = response.hovered() || response.has_focus() || response.dragged();
        let color = match is_active {
            true => ui.visuals().selection.bg_fill,
            false => ui.visuals().widgets.inactive.fg_stroke.color,
        };
        ui.painter().circle(
            place.center(),
            0.4 * HANDLE,
            color,
            Stroke::new(1.0, Color32::WHITE),
        );
        match done {
            Some(Done::Removed) if count > fewest => {
                changed.get_or_insert_with(|| stops.to_vec()).remove(i);
            }
            Some(Done::Moved(by)) => {
                let (low, high) = bounds(stops, i);
                let stop = &mut changed.get_or_insert_with(|| stops.to_vec())[i];
                put_number(stop, "at", (at + by.x).clamp(low, high));
                let factor = (factor + by.y * top).clamp(least as f32, greatest as f32);
                put_number(stop, "factor", factor);
            }
            _ => {}
        }
    }
    changed
}

/// Draws a curve of factors from 0 at the bottom to `top`, with a line at 1.
fn paint(ui: &Ui, graph: Rect, curve: &Curve, top: f32) {
    let painter = ui.painter_at(graph.expand(1.0));
    let visuals = ui.visuals();
    painter.rect_filled(graph, 0.0, visuals.extreme_bg_color);
    let faint = visuals.widgets.noninteractive.bg_stroke;
    painter.rect_stroke(graph, 0.0, faint, egui::StrokeKind::Outside);
    painter.hline(
        graph.x_range(),
        graph.bottom() - graph.height() / top,
        faint,
    );
    let at = |i: usize| {
        let share = i as f32 / PIECES as f32;
        let height = curve.at(f64::from(share)) as f32 / top;
        pos2(
            graph.left() + share * graph.width(),
            graph.bottom() - height * graph.height(),
        )
    };
    let line = Stroke::new(1.5, visuals.widgets.inactive.fg_stroke.color);
    painter.line((0..=PIECES).map(at).collect(), line);
}
