//! The picture as it was, beside the present one.

use super::{Easel, Studio, studio_drawn_by};
use egui::epaint::{ImageData, Primitive};
use egui::{Color32, Key, Modifiers, Pos2, Rect, TextureId, TexturesDelta, pos2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, TestRenderer};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

const RED: Color32 = Color32::from_rgb(255, 0, 0);
const WHITE: Color32 = Color32::WHITE;

/// The colours of textures that a window handed over.
#[derive(Clone, Default)]
struct Colors(Rc<RefCell<BTreeMap<TextureId, Color32>>>);

impl TestRenderer for Colors {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        let mut colors = self.0.borrow_mut();
        for (id, delta) in delta.set.drain() {
            let ImageData::Color(image) = &delta[delta.len() - 1].image;
            colors.insert(id, image.pixels[0]);
        }
        delta.clear();
    }
}

/// A window, and the colours of the textures that it handed over.
struct Seen {
    harness: Harness<'static, Studio>,
    easel: Easel,
    colors: Colors,
}

impl Seen {
    /// A window of a style with red lines, which the user has taken back: a style without is drawn white.
    fn new() -> Self {
        let colors = Colors::default();
        let (harness, easel) = studio_drawn_by(colors.clone(), &["line.color=#ff0000"]);
        let mut seen = Self {
            harness,
            easel,
            colors,
        };
        seen.steps(20);
        seen.harness.state_mut().search("line.color");
        seen.steps(6);
        seen.harness.get_by_label("reset line.color").click();
        seen.steps(20);
        seen
    }

    fn steps(&mut self, count: usize) {
        self.harness.run_steps(count);
    }

    /// The colour of the picture at a place of the window: of the last texture over it that is a picture.
    fn color_at(&self, at: Pos2) -> Option<Color32> {
        let shapes = self.harness.output().shapes.clone();
        let meshes = self.harness.ctx.tessellate(shapes, 1.0);
        let over = meshes.iter().filter_map(|part| {
            let Primitive::Mesh(mesh) = &part.primitive else {
                return None;
            };
            let room = mesh.vertices.iter().map(|vertex| vertex.pos);
            let room = Rect::from_points(&room.collect::<Vec<_>>());
            let is_picture = mesh.texture_id != TextureId::default();
            let is_over = is_picture && part.clip_rect.contains(at) && room.contains(at);
            is_over.then(|| self.colors.0.borrow().get(&mesh.texture_id).copied())
        });
        over.last().flatten()
    }

    fn handle(&self) -> Rect {
        self.harness.get_by_label("Before and after").rect()
    }

    /// The colours left and right of the handle.
    fn sides(&self) -> [Option<Color32>; 2] {
        let handle = self.handle();
        [handle.left() - 20.0, handle.right() + 20.0]
            .map(|x| self.color_at(pos2(x, handle.center().y + 90.0)))
    }

    fn asides(&self) -> usize {
        self.easel.0.borrow().asides.len()
    }
}

#[test]
fn the_style_as_it_was_is_left_of_a_handle_and_the_present_one_right_of_it() {
    let mut seen = Seen::new();
    seen.harness.get_by_label("Before").click();
    seen.steps(20);
    assert_eq!(seen.sides(), [Some(RED), Some(WHITE)]);
    assert_eq!(seen.asides(), 1);
    {
        let asked = seen.easel.0.borrow();
        let (first, now) = (&asked.asides[0], seen.harness.state().order());
        assert_eq!(first.overrides, ["line.color=#ff0000"]);
        assert_eq!(now.overrides, [""; 0]);
        assert_eq!((first.viewpoint, first.size), (now.viewpoint, now.size));
    }

    // Drag the handle, and move it by keys.
    let start = seen.handle().center();
    seen.harness.drag_at(start + vec2(0.0, 60.0));
    seen.steps(2);
    seen.harness.hover_at(start + vec2(-150.0, 60.0));
    seen.steps(2);
    seen.harness.drop_at(start + vec2(-150.0, 60.0));
    seen.steps(2);
    let moved = seen.handle().center();
    assert!(
        (moved.x - start.x + 150.0).abs() < 2.0,
        "{moved:?} {start:?}"
    );
    assert_eq!(seen.sides(), [Some(RED), Some(WHITE)]);
    assert_eq!(seen.color_at(start + vec2(-20.0, 90.0)), Some(WHITE));
    seen.harness.get_by_label("Before and after").focus();
    seen.steps(2);
    for _ in 0..5 {
        seen.harness.key_press(Key::ArrowRight);
        seen.steps(2);
    }
    let stepped = seen.handle().center().x - moved.x;
    let width = seen.harness.state().order().size[0] as f32;
    assert!(
        (stepped / width - 0.05).abs() < 0.005,
        "{stepped} of {width}"
    );
    assert_eq!(seen.asides(), 1);

    // The camera turns, and both do: the picture of before is drawn once more.
    seen.harness.get_by_label("Before and after").focus();
    let away = pos2(60.0, 300.0);
    seen.harness.drag_at(away);
    seen.steps(2);
    seen.harness.hover_at(away + vec2(30.0, 10.0));
    seen.steps(6);
    assert_eq!((seen.asides(), seen.sides()), (1, [Some(WHITE); 2]));
    seen.harness.drop_at(away + vec2(30.0, 10.0));
    seen.steps(20);
    assert_eq!((seen.asides(), seen.sides()), (2, [Some(RED), Some(WHITE)]));

    // What is copied is the present one, and B takes the other away.
    seen.harness.get_by_label("Copy command").click();
    seen.steps(2);
    assert_eq!(seen.harness.state().order().overrides, [""; 0]);
    seen.harness.key_press(Key::B);
    seen.steps(4);
    assert!(seen.harness.query_by_label("Before and after").is_none());
    assert_eq!(seen.color_at(away), Some(WHITE));
}

#[test]
fn a_slider_that_is_dragged_draws_no_picture_of_before() {
    let mut seen = Seen::new();
    seen.harness.key_press(Key::B);
    seen.steps(20);
    assert_eq!(seen.asides(), 1);
    seen.harness.state_mut().search("line.opacity");
    seen.steps(6);
    let slider = seen.harness.get_by_label("line.opacity").rect();
    let end = pos2(slider.left() + 92.0, slider.center().y);
    seen.harness.drag_at(end);
    seen.steps(2);
    let orders = seen.easel.0.borrow().orders.len();
    for step in 1..8 {
        seen.harness.hover_at(end - vec2(6.0 * step as f32, 0.0));
        seen.steps(2);
        assert_eq!(seen.sides(), [Some(RED), Some(WHITE)]);
    }
    assert!(seen.easel.0.borrow().orders.len() > orders + 3);
    seen.harness.drop_at(end - vec2(48.0, 0.0));
    seen.steps(20);
    assert_eq!((seen.asides(), seen.sides()), (1, [Some(RED), Some(WHITE)]));
}

#[test]
fn a_style_that_is_as_it_was_is_drawn_once() {
    let mut seen = Seen::new();
    seen.harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    seen.harness.key_press(Key::Num7);
    seen.steps(20);
    seen.harness.key_press(Key::B);
    seen.steps(20);
    assert_eq!((seen.asides(), seen.sides()), (0, [Some(RED); 2]));
}
