//! How long pictures take.

use super::{Studio, studio};
use egui::Key;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_view::{News, PassSeconds};

/// The names of what the section shows that begin with some words.
fn shown(harness: &Harness<'static, Studio>, start: &str) -> usize {
    harness.query_all_by_label_contains(start).count()
}

#[test]
fn the_section_has_a_bar_for_every_pass_and_the_last_pictures() {
    let (mut harness, _) = studio([1000.0, 2000.0], &[]);
    harness.run_steps(20);
    assert_eq!(shown(&harness, "raster.draw_ids"), 0);
    harness.get_by_label("Times").click();
    harness.run_steps(10);
    assert!(shown(&harness, "last full picture: 10.0 ms") == 1);
    assert_eq!(shown(&harness, "last draft: none yet"), 1);
    assert_eq!(shown(&harness, "raster.draw_ids"), 1);
    assert_eq!(shown(&harness, "4.0 / 0.0 ms"), 1);
    assert_eq!(shown(&harness, "6.0 / 0.0 ms"), 1);

    // Every picture is one more of the graph, up to 60, and a draft has bars of its own.
    harness.key_press(Key::Num7);
    harness.run_steps(20);
    assert_eq!(shown(&harness, "last draft: 10.0 ms"), 1);
    assert_eq!(shown(&harness, "4.0 / 4.0 ms"), 1);
    assert_eq!(shown(&harness, "time stamps"), 0);
    for _ in 0..40 {
        harness.key_press(Key::Num1);
        harness.run_steps(3);
        harness.key_press(Key::Num7);
        harness.run_steps(3);
    }
    assert_eq!(shown(&harness, "the last 60 pictures, 10.0 ms at most"), 1);
    assert!(
        harness
            .query_by_label("Times of the last pictures")
            .is_some()
    );
}

#[test]
fn an_engine_without_time_stamps_says_so() {
    let (mut harness, easel) = studio([1000.0, 2000.0], &[]);
    harness.run_steps(20);
    let mut picture = harness.state().picture().unwrap().clone();
    picture.passes = None;
    let news = News::Picture(Box::new(picture));
    easel.0.borrow_mut().news.push(news);
    harness.state_mut().search("times passes");
    harness.run_steps(6);
    assert_eq!(shown(&harness, "time stamps"), 1);
    assert_eq!(shown(&harness, "raster.draw_ids"), 0);
    assert_eq!(shown(&harness, "10.0 / 0.0 ms"), 1);
    assert_eq!(shown(&harness, "everything else"), 0);
}

#[test]
fn the_panel_keeps_its_width_however_long_pictures_take() {
    let (mut harness, easel) = studio([1000.0, 900.0], &[]);
    harness.run_steps(20);
    let size = harness.state().order().size;
    for is_draft in [true, false] {
        let mut picture = harness.state().picture().unwrap().clone();
        picture.order.is_draft = is_draft;
        picture.seconds = 12_345.6;
        picture.passes = Some(vec![PassSeconds {
            name: "vector.a_pass_with_a_name_as_long_as_none_has_ever_been",
            seconds: 9_876.5,
        }]);
        let news = News::Picture(Box::new(picture));
        easel.0.borrow_mut().news.push(news);
    }
    harness.state_mut().search("times passes");
    harness.run_steps(20);
    assert_eq!(shown(&harness, "9876500 / 9876500 ms"), 1);
    assert_eq!(harness.state().order().size, size);
}
