//! Layers in place of the picture.

use super::{Studio, studio};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_view::FilmForm;

/// Chooses an entry of the list of layers.
fn choose(harness: &mut Harness<'static, Studio>, name: &str) {
    let list = harness.get_by_role_and_label(Role::ComboBox, "Layer");
    list.click();
    harness.run_steps(4);
    harness.get_by_role_and_label(Role::Button, name).click();
    harness.run_steps(20);
}

#[test]
fn a_layer_that_is_chosen_is_ordered_in_place_of_the_picture_until_none_is() {
    let (mut harness, easel) = studio([1000.0, 640.0], &[]);
    harness.run_steps(20);
    let last = || easel.0.borrow().orders.last().cloned().unwrap();
    let whole = last();
    assert_eq!(whole.layer, None);
    choose(&mut harness, "found");
    assert_eq!(last().layer.as_deref(), Some("found"));
    assert_eq!(harness.state().picture().unwrap().order, last());
    assert_eq!(harness.state().sheet().overrides(), [""; 0]);

    // Drafts show it, films and the pictures of presets do not.
    harness.key_press(Key::Num7);
    harness.run_steps(20);
    let orders = easel.0.borrow().orders.clone();
    let after = orders.iter().skip_while(|order| order.layer.is_none());
    assert!(after.clone().any(|order| order.is_draft));
    assert!(after.clone().all(|order| order.layer.is_some()));
    assert!(harness.state().film(FilmForm::Apng).is_none());
    harness.get_by_label("Film").click();
    harness.run_steps(4);
    harness.get_by_label("the camera turns once").click();
    harness.run_steps(4);
    harness.get_by_label("APNG").click();
    harness.run_steps(4);
    assert_eq!(easel.0.borrow().films[0].1.layer, None);
    harness
        .get_by_role_and_label(Role::ComboBox, "Style")
        .click();
    harness.run_steps(6);
    let asides = easel.0.borrow().asides.clone();
    assert!(!asides.is_empty() && asides.iter().all(|order| order.layer.is_none()));
    harness
        .get_by_role_and_label(Role::ComboBox, "Style")
        .click();
    harness.run_steps(6);

    // The first of the list is the picture itself.
    choose(&mut harness, "none");
    assert_eq!(last().layer, None);
}

#[test]
fn arrow_keys_go_through_the_layers() {
    let (mut harness, _) = studio([1000.0, 640.0], &[]);
    harness.run_steps(20);
    harness
        .get_by_role_and_label(Role::ComboBox, "Layer")
        .focus();
    harness.run_steps(3);
    let mut seen = Vec::new();
    for key in [
        Key::ArrowDown,
        Key::ArrowDown,
        Key::ArrowDown,
        Key::ArrowUp,
        Key::ArrowUp,
    ] {
        harness.key_press(key);
        harness.run_steps(4);
        seen.push(harness.state().order().layer.unwrap_or_default());
    }
    assert_eq!(seen, ["depth", "found", "found", "depth", ""]);
}
