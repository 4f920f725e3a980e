//! Ramps and curves: stops are dragged, added and taken out.

use super::{Studio, studio_in_steps};
use egui::{Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// Opens a list of stops alone, and gives the style that it starts from.
fn stops(key: &str, overrides: &[&str]) -> (Harness<'static, Studio>, String) {
    let (mut harness, _) = studio_in_steps([1000.0, 1400.0], overrides, 0.05);
    harness.state_mut().search(key);
    harness.run_steps(12);
    let toml = harness.state().sheet().style().to_toml().unwrap();
    (harness, toml)
}

fn drag(harness: &mut Harness<'static, Studio>, from: egui::Pos2, to: egui::Pos2) {
    harness.drag_at(from);
    harness.run_steps(2);
    for step in 1..=5 {
        harness.hover_at(from + (to - from) * (step as f32 / 5.0));
        harness.run_steps(2);
    }
    harness.drop_at(to);
    harness.run_steps(3);
}

fn double_click(harness: &mut Harness<'static, Studio>, at: egui::Pos2) {
    for _ in 0..2 {
        harness.drag_at(at);
        harness.run_steps(1);
        harness.drop_at(at);
        harness.run_steps(1);
    }
    harness.run_steps(3);
}

fn undone(harness: &mut Harness<'static, Studio>) -> String {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(4);
    harness.state().sheet().style().to_toml().unwrap()
}

#[test]
fn stops_of_a_ramp_are_dragged_added_and_taken_out() {
    let (mut harness, before) = stops("shade.ramp", &[]);
    let ramp = |harness: &Harness<'static, Studio>| {
        let ramp = &harness.state().sheet().style().shade.ramp;
        ramp.iter().map(|stop| stop.at).collect::<Vec<f32>>()
    };
    let first = ramp(&harness);
    let bar = harness.get_by_label("bar of shade.ramp").rect();

    // Drag the second stop to the right by a tenth of the bar: one step to undo.
    let handle = harness.get_by_label("stop 2 of shade.ramp").rect().center();
    drag(&mut harness, handle, handle + vec2(0.1 * bar.width(), 0.0));
    let moved = ramp(&harness);
    assert!(
        (moved[1] - first[1] - 0.1).abs() < 0.01,
        "{first:?} {moved:?}"
    );
    assert_eq!(undone(&mut harness), before);

    // It goes no further than the next.
    drag(&mut harness, handle, handle + vec2(2.0 * bar.width(), 0.0));
    let last = ramp(&harness);
    assert_eq!(last[1], last.get(2).copied().unwrap_or(1.0));
    assert_eq!(undone(&mut harness), before);

    // Add one, and take it out by a key.
    let place = egui::pos2(bar.left() + 0.75 * bar.width(), bar.center().y);
    double_click(&mut harness, place);
    let added = ramp(&harness);
    assert_eq!(added.len(), first.len() + 1);
    assert!((added[2] - 0.75).abs() < 0.01, "{added:?}");
    harness.get_by_label("stop 3 of shade.ramp").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(3);
    let nudged = ramp(&harness);
    assert!((nudged[2] - added[2] + 0.01).abs() < 0.002, "{nudged:?}");
    harness.key_press(Key::Delete);
    harness.run_steps(3);
    assert_eq!(ramp(&harness), first);
}

#[test]
fn colours_of_a_ramp_mix_where_a_stop_is_added() {
    let text =
        r##"line.paint.depth.ramp=[{ at = 0, color = "#000000" }, { at = 1, color = "#ffffff" }]"##;
    let (mut harness, before) = stops("line.paint.depth.ramp", &[text]);
    let bar = harness.get_by_label("bar of line.paint.depth.ramp").rect();
    double_click(&mut harness, bar.center());
    let ramp = harness
        .state()
        .sheet()
        .style()
        .line
        .paint
        .depth
        .ramp
        .clone();
    assert_eq!(ramp.len(), 3, "{ramp:?}");
    let middle = ramp[1].color;
    assert!(
        (80..120).contains(&middle.r) && middle.r == middle.g,
        "{middle}"
    );
    assert_eq!(undone(&mut harness), before);
}

#[test]
fn stops_of_a_curve_are_dragged_up_and_added() {
    let text = "line.width.pressure=[{ at = 0.2, factor = 1 }, { at = 0.8, factor = 0.5 }]";
    let (mut harness, before) = stops("line.width.pressure", &[text]);
    let curve = |harness: &Harness<'static, Studio>| {
        let curve = &harness.state().sheet().style().line.width.pressure;
        curve
            .iter()
            .map(|stop| [stop.at, stop.factor])
            .collect::<Vec<_>>()
    };
    let graph = harness.get_by_label("graph of line.width.pressure").rect();
    let handle = harness
        .get_by_label("stop 1 of line.width.pressure")
        .rect()
        .center();
    let by = vec2(0.1 * graph.width(), -0.25 * graph.height());
    drag(&mut harness, handle, handle + by);
    let [at, factor] = curve(&harness)[0];
    assert!(
        (at - 0.3).abs() < 0.01 && (factor - 1.5).abs() < 0.03,
        "{at} {factor}"
    );
    assert_eq!(undone(&mut harness), before);
    double_click(&mut harness, graph.center());
    let [at, factor] = curve(&harness)[1];
    assert!(
        (at - 0.5).abs() < 0.01 && (factor - 1.0).abs() < 0.03,
        "{at} {factor}"
    );
    assert_eq!(undone(&mut harness), before);

    // Without stops the graph is there too.
    let (mut harness, before) = stops("line.width.depth.curve", &[]);
    let graph = harness
        .get_by_label("graph of line.width.depth.curve")
        .rect();
    double_click(&mut harness, graph.center());
    let depth = &harness.state().sheet().style().line.width.depth;
    assert_eq!(depth.curve.len(), 1);
    assert_eq!(undone(&mut harness), before);
}
