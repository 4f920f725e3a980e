//! The list of presets with pictures.

use super::{Studio, studio};
use egui::accesskit::Role;
use egui::{Key, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_stylesheet::presets;

/// Opens the list of presets, or closes it.
fn click_list(harness: &mut Harness<'static, Studio>) {
    let list = harness.get_by_role_and_label(Role::ComboBox, "Style");
    list.click();
    harness.run_steps(4);
}

#[test]
fn an_open_list_has_a_picture_of_the_view_in_every_preset_which_is_drawn_once() {
    let (mut harness, easel) = studio([1000.0, 640.0], &["line.color=#ff0000"]);
    harness.run_steps(40);
    assert_eq!(easel.0.borrow().asides.len(), 0);
    click_list(&mut harness);
    harness.run_steps(3 * presets().len());
    let asked = easel.0.borrow().asides.clone();
    let names: Vec<&str> = asked.iter().map(|order| order.style.as_str()).collect();
    let wanted: Vec<&str> = presets().iter().map(|preset| preset.name).collect();
    assert_eq!(names, wanted);
    let full = harness.state().order();
    for order in &asked {
        assert!(
            order.size.iter().all(|side| (1..=160).contains(side)),
            "{order:?}"
        );
        assert_eq!((order.viewpoint, &order.pose), (full.viewpoint, &full.pose));
        assert!(order.overrides.is_empty() && order.is_draft);
    }

    // Closed and opened again, it has them still; another view has others.
    click_list(&mut harness);
    click_list(&mut harness);
    harness.run_steps(20);
    assert_eq!(easel.0.borrow().asides.len(), wanted.len());
    click_list(&mut harness);
    harness.key_press(Key::Num7);
    harness.run_steps(20);
    assert_eq!(easel.0.borrow().asides.len(), wanted.len());
    click_list(&mut harness);
    harness.run_steps(3 * presets().len());
    let asked = easel.0.borrow().asides.clone();
    assert_eq!(asked.len(), 2 * wanted.len());
    assert!(asked[wanted.len()].viewpoint.is_some());

    // A preset is chosen by its name.
    harness.get_by_label("ink").click();
    harness.run_steps(8);
    assert_eq!(harness.state().sheet().name(), "ink");
}

#[test]
fn no_picture_of_the_list_is_drawn_while_something_is_dragged() {
    let (mut harness, easel) = studio([1000.0, 640.0], &[]);
    harness.run_steps(40);
    click_list(&mut harness);
    let first = easel.0.borrow().asides.len();
    assert!((1..presets().len()).contains(&first), "{first}");
    let at = pos2(200.0, 300.0);
    harness.drag_at(at);
    harness.run_steps(1);
    let before = easel.0.borrow().asides.len();
    for step in 0..20 {
        harness.hover_at(at + vec2(step as f32, 0.0));
        harness.run_steps(2);
    }
    assert_eq!(easel.0.borrow().asides.len(), before);
    assert!(easel.0.borrow().orders.last().unwrap().is_draft);
}
