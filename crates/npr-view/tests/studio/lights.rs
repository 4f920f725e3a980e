//! Lights that are dragged over the picture.

use super::{Studio, studio};
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_view::{Cast, News};

const MAIN: &str = "direction of main light";

fn middle_of(harness: &Harness<'static, Studio>, name: &str) -> Pos2 {
    harness.get_by_label(name).rect().center()
}

/// Drags a handle along a way.
fn drag(harness: &mut Harness<'static, Studio>, name: &str, way: [f32; 2]) {
    let start = middle_of(harness, name);
    harness.drag_at(start);
    harness.run_steps(2);
    for step in 1..=4 {
        harness.hover_at(start + vec2(way[0], way[1]) * (step as f32 / 4.0));
        harness.run_steps(2);
    }
    harness.drop_at(start + vec2(way[0], way[1]));
    harness.run_steps(20);
}

fn direction(harness: &Harness<'static, Studio>) -> [f32; 3] {
    harness.state().sheet().style().light.direction
}

#[test]
fn a_light_is_dragged_follows_arrow_keys_and_is_undone() {
    let (mut harness, easel) = studio([1000.0, 640.0], &["light.direction=[0, 0, 1]"]);
    harness.run_steps(20);
    assert!(harness.query_by_label(MAIN).is_none());
    harness.key_press(Key::L);
    harness.run_steps(4);

    // Drag it from the middle to the right, and the picture stays where it is.
    let start = middle_of(&harness, MAIN);
    drag(&mut harness, MAIN, [70.0, 0.0]);
    let [x, y, z] = direction(&harness);
    assert!(x > 0.3 && y.abs() < 0.01 && z > 0.3, "{x} {y} {z}");
    assert!((middle_of(&harness, MAIN).x - start.x - 70.0).abs() < 2.0);
    let last = easel.0.borrow().orders.last().unwrap().clone();
    assert_eq!(last.viewpoint, None);
    assert_eq!(last.overrides, harness.state().sheet().overrides());
    assert!(easel.0.borrow().orders.iter().any(|order| order.is_draft));

    // One drag is one step to undo.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(20);
    assert_eq!(direction(&harness), [0.0, 0.0, 1.0]);

    // Arrow keys move it, up too, and far from the middle it shines from behind.
    harness.get_by_label(MAIN).focus();
    harness.run_steps(3);
    for _ in 0..6 {
        harness.key_press(Key::ArrowUp);
        harness.run_steps(2);
    }
    let [x, y, z] = direction(&harness);
    assert!(x == 0.0 && (y - 0.3).abs() < 0.01 && z > 0.9, "{x} {y} {z}");
    drag(&mut harness, MAIN, [0.0, -190.0]);
    let [x, y, z] = direction(&harness);
    assert!(x.abs() < 0.01 && y > 0.3 && z < -0.3, "{x} {y} {z}");
    harness.get_by_label("Lights").click();
    harness.run_steps(4);
    assert!(harness.query_by_label(MAIN).is_none());
}

#[test]
fn a_light_of_the_scene_is_turned_in_the_axes_of_the_scene() {
    let overrides = [
        "light.space=world",
        "light.direction=[0, 0, 1]",
        r#"light.extra=[{ kind = "point" }, { kind = "distant", direction = [1, 0, 0] }]"#,
        "smoke.light=[0, 1, 0]",
    ];
    let (mut harness, _) = studio([1000.0, 640.0], &overrides);
    harness.run_steps(20);
    harness.get_by_label("Lights").click();
    harness.run_steps(4);

    // From the right, +z lies at the left and +x in the middle.
    let front = [MAIN, "direction of light.extra.1"].map(|name| middle_of(&harness, name));
    harness.key_press(Key::Num3);
    harness.run_steps(20);
    let [main, extra] = [MAIN, "direction of light.extra.1"].map(|name| middle_of(&harness, name));
    assert!((extra - front[0]).length() < 1.0, "{extra:?} {front:?}");
    assert!(main.x < extra.x - 50.0);
    drag(&mut harness, "direction of light.extra.1", [0.0, -60.0]);
    let style = harness.state().sheet().style().clone();
    let [x, y, z] = style.light.extra[1].direction;
    assert!(x > 0.3 && y > 0.3 && z.abs() < 0.01, "{x} {y} {z}");
    assert_eq!(style.light.direction, [0.0, 0.0, 1.0]);
    drag(&mut harness, "direction of light of the smoke", [0.0, 40.0]);
    let [_, y, _] = harness.state().sheet().style().smoke.light.unwrap();
    assert!(y < 0.95, "{y}");
    assert!(
        harness
            .query_by_label("direction of light.extra.0")
            .is_none()
    );
}

#[test]
fn lights_of_the_file_are_not_dragged() {
    let (mut harness, easel) = studio([1000.0, 640.0], &["light.file=true"]);
    harness.run_steps(20);
    harness.key_press(Key::L);
    harness.run_steps(4);
    assert!(harness.query_by_label(MAIN).is_some());
    harness.key_press(Key::L);
    let cast = Cast {
        has_lights: true,
        ..Cast::default()
    };
    let news = News::Scene("lamp.glb".to_owned(), Box::new(cast));
    easel.0.borrow_mut().news.push(news);
    harness.run_steps(20);
    harness.key_press(Key::L);
    harness.run_steps(4);
    assert!(harness.query_by_label(MAIN).is_none());
    let told = harness.state().told().unwrap_or_default();
    assert!(told.contains("light.file"), "{told}");
}
