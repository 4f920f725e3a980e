//! The window without a mouse.

use super::{LISTS, OPEN, Studio, keys, studio, unfold};
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use npr_stylesheet::{Form, fields};
use std::collections::BTreeMap;

/// The name of what has the keys, and what tells it from others.
fn focused(harness: &Harness<'static, Studio>) -> Option<(String, String)> {
    let mut all = harness.root().children_recursive();
    let node = all.find(|node| node.accesskit_node().is_focused())?;
    let node = node.accesskit_node();
    let id = format!("{:?} {:?} {:?}", node.id(), node.role(), node.value());
    Some((node.label().unwrap_or_default(), id))
}

#[test]
fn every_key_is_reached_by_tab_and_all_that_is_reached_has_a_name() {
    let (mut harness, _) = studio([1000.0, 9000.0], &LISTS);
    unfold(&mut harness);
    let mut reached = BTreeMap::new();
    for field in fields() {
        // Show the keys of a table alone, and go on by Tab until a control comes again.
        let is_table = matches!(field.form, Form::Table(_));
        let words = if is_table { "." } else { "" };
        harness
            .state_mut()
            .search(&format!("{}{words}", field.name));
        harness.run_steps(6);
        let mut of_table = BTreeMap::new();
        for _ in 0..2000 {
            harness.key_press(Key::Tab);
            harness.run_steps(1);
            if let Some((name, id)) = focused(&harness)
                && of_table.insert(id, name).is_some()
            {
                break;
            }
        }
        let mut wanted = Vec::new();
        keys(&[field], "", &OPEN, &mut wanted);
        wanted.retain(|key| !of_table.values().any(|name| name == key));
        assert!(wanted.is_empty(), "not reached: {wanted:?}");
        reached.extend(of_table);
    }
    let unnamed: Vec<&String> = reached
        .iter()
        .filter(|(_, name)| name.is_empty())
        .map(|(id, _)| id)
        .collect();
    assert!(unnamed.is_empty(), "of {}: {unnamed:?}", reached.len());
    for name in ["Style", "Search", "PNG", "Unfold all"] {
        assert!(reached.values().any(|other| other == name), "{name}");
    }
}

#[test]
fn keys_change_what_has_them_and_are_undone() {
    let (mut harness, _) = studio([1000.0, 24_000.0], &[]);
    unfold(&mut harness);
    let toml =
        |harness: &Harness<'static, Studio>| harness.state().sheet().style().to_toml().unwrap();
    let before = toml(&harness);
    for (key, presses, override_start) in [
        ("line.opacity", &[Key::ArrowLeft][..], "line.opacity="),
        ("number of line.opacity", &[Key::ArrowDown], "line.opacity="),
        ("detect.depth.on", &[Key::Space], "detect.depth.on=false"),
        ("light.shadow", &[Key::Enter], "light.shadow="),
        ("shade.mode", &[Key::ArrowDown], "shade.mode="),
        (
            "unit of line.width.base",
            &[Key::ArrowDown],
            "line.width.base=",
        ),
        ("stop 2 of shade.ramp", &[Key::ArrowRight], "shade.ramp="),
    ] {
        harness.get_by_label(key).focus();
        harness.run_steps(3);
        for press in presses {
            harness.key_press(*press);
            harness.run_steps(4);
        }
        let overrides = harness.state().sheet().overrides();
        assert!(
            overrides.len() == 1 && overrides[0].starts_with(override_start),
            "{key}: {overrides:?}"
        );
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(4);
        assert_eq!(toml(&harness), before, "{key}");
    }
}
