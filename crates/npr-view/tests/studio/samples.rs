//! Samples of a brush and of hatching.

use super::{Easel, Studio, studio};
use egui::accesskit::Role;
use egui::{pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_view::{Order, Swatch};

/// The samples that were asked for.
fn asked(easel: &Easel) -> Vec<Order> {
    let asides = easel.0.borrow().asides.clone();
    let samples = asides.into_iter().filter(|order| order.swatch.is_some());
    samples.collect()
}

fn search(harness: &mut Harness<'static, Studio>, words: &str) {
    harness.state_mut().search(words);
    harness.run_steps(12);
}

#[test]
fn a_sample_in_sight_is_drawn_once_for_the_values_that_it_shows() {
    let (mut harness, easel) = studio([1000.0, 900.0], &[]);
    harness.run_steps(20);
    assert_eq!(asked(&easel), []);
    search(&mut harness, "line.brush");
    let first = asked(&easel);
    assert_eq!(first.len(), 1);
    let full = harness.state().order();
    assert_eq!(first[0].swatch, Some(Swatch::Brush));
    assert_eq!((first[0].size[1], first[0].is_draft), (full.size[1], false));
    assert!(harness.query_by_label("sample of line.brush").is_some());

    // Other values of the line make another one, the camera and the light do not.
    harness.key_press(egui::Key::Num7);
    harness.run_steps(20);
    search(&mut harness, "light.shadow");
    harness.get_by_label("light.shadow").click();
    harness.run_steps(20);
    search(&mut harness, "line.brush");
    assert_eq!(asked(&easel).len(), 1);
    let tip = harness.get_by_role_and_label(Role::ComboBox, "line.brush.tip");
    tip.focus();
    harness.run_steps(3);
    harness.key_press(egui::Key::ArrowDown);
    harness.run_steps(20);
    let second = asked(&easel);
    assert_eq!(second.len(), 2);
    assert!(
        second[1]
            .overrides
            .iter()
            .any(|text| text.starts_with("line.brush.tip="))
    );

    // Hatching has a sample of its own, on surfaces and on smoke.
    search(&mut harness, "ink.hatch.");
    let samples = asked(&easel);
    let swatches: Vec<_> = samples.iter().map(|order| order.swatch).collect();
    assert_eq!(swatches[2..], [Some(Swatch::Hatch); 2]);

    // A stroke is enlarged, and hatching is there where the style has none.
    let last = |i: usize| samples[i].overrides.last().cloned().unwrap_or_default();
    let wanted = ["line.scale=2", "ink.tone=hatch", "ink.tone=hatch"];
    assert_eq!([0, 2, 3].map(last), wanted);
    let [surface, smoke] = [2, 3].map(|i| samples[i].overrides.join("\n"));
    assert!(!surface.contains("shade.mode") && smoke.contains("shade.mode=paper"));
    assert!(smoke.contains("ink={ "), "{smoke}");
}

#[test]
fn no_sample_is_drawn_while_something_is_dragged() {
    let (mut harness, easel) = studio([1000.0, 900.0], &[]);
    harness.run_steps(20);
    search(&mut harness, "ink.hatch.");
    let before = asked(&easel).len();
    assert_eq!(before, 2);
    let slider = harness.get_by_role_and_label(Role::Slider, "ink.hatch.wobble");
    let slider = slider.rect();
    let start = pos2(slider.left() + 20.0, slider.center().y);
    harness.drag_at(start);
    harness.run_steps(2);
    for step in 1..8 {
        harness.hover_at(start + vec2(6.0 * step as f32, 0.0));
        harness.run_steps(3);
    }
    assert_eq!(asked(&easel).len(), before);
    assert!(!harness.state().sheet().overrides().is_empty());
    harness.drop_at(start + vec2(48.0, 0.0));
    harness.run_steps(20);
    let after = asked(&easel);
    assert_eq!(after.len(), before + 1);
    assert!(
        after[before]
            .overrides
            .iter()
            .any(|text| text.starts_with("ink.hatch.wobble="))
    );
}
