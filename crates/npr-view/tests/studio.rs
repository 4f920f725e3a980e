//! The studio as a user meets it: every key has a control, changes are undone to the byte, search finds keys.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "tests fail by panicking"
)]

#[path = "studio/dropped.rs"]
mod dropped;
#[path = "studio/gallery.rs"]
mod gallery;
#[path = "studio/joints.rs"]
mod joints;
#[path = "studio/keyboard.rs"]
mod keyboard;
#[path = "studio/layers.rs"]
mod layers;
#[path = "studio/lights.rs"]
mod lights;
#[path = "studio/pointing.rs"]
mod pointing;
#[path = "studio/samples.rs"]
mod samples;
#[path = "studio/split.rs"]
mod split;
#[path = "studio/stops.rs"]
mod stops;
#[path = "studio/timeline.rs"]
mod timeline;
#[path = "studio/times.rs"]
mod times;

use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use egui_kittest::{Harness, HarnessBuilder, TestRenderer};
use npr_stylesheet::{Field, Form, Stated, fields};
use npr_view::{
    FileKind, Film, Host, Layer, News, Order, PassSeconds, Picture, Pose, Question, Sheet, Studio,
    Take, Viewpoint,
};
use std::cell::RefCell;
use std::rc::Rc;

/// What a host was asked for.
#[derive(Default)]
struct Asked {
    orders: Vec<Order>,
    asides: Vec<Order>,
    opened: Vec<String>,
    saved: Vec<(Take, String)>,
    questions: Vec<Question>,
    poses: Vec<Pose>,
    films: Vec<(Film, Order)>,
    cancelled: usize,
    news: Vec<News>,
}

/// A picture of the colour that an order has lines of; white where it says none.
fn painted(order: Order) -> Box<Picture> {
    let color = order.overrides.iter().find_map(|text| {
        let color: npr_stylesheet::Color = text.strip_prefix("line.color=")?.parse().ok()?;
        Some([color.r, color.g, color.b, 255])
    });
    let pixels = (order.size[0] * order.size[1]) as usize;
    Box::new(Picture {
        rgba: color.unwrap_or([255; 4]).repeat(pixels),
        viewpoint: order.viewpoint.unwrap_or(FRONT),
        engine: "nobody".to_owned(),
        seconds: 0.01,
        passes: Some(vec![PassSeconds {
            name: "raster.draw_ids",
            seconds: 0.004,
        }]),
        notices: Vec::new(),
        order,
    })
}

/// A host that draws pictures of one colour.
#[derive(Clone, Default)]
struct Easel(Rc<RefCell<Asked>>);

impl Host for Easel {
    fn style(&mut self, name: &str) -> Result<Stated, String> {
        Stated::preset(name).map_err(|error| error.to_string())
    }

    fn kind(&self, path: &str) -> FileKind {
        match path.rsplit('.').next() {
            Some("toml") => FileKind::Style,
            Some("png") => FileKind::Picture,
            Some("vdb") => FileKind::Volume,
            _ => FileKind::Scene,
        }
    }

    fn smokes(&self) -> Vec<String> {
        ["plume", "cloud"].map(str::to_owned).to_vec()
    }

    fn layers(&self) -> Vec<Layer> {
        let named = |name: &str| Layer {
            name: name.to_owned(),
            text: format!("shows {name}"),
        };
        ["depth", "found"].map(named).to_vec()
    }

    fn open(&mut self, path: &str) {
        self.0.borrow_mut().opened.push(path.to_owned());
    }

    fn draw(&mut self, order: Order) {
        let mut asked = self.0.borrow_mut();
        asked.orders.push(order.clone());
        asked.news.push(News::Picture(painted(order)));
    }

    fn draw_aside(&mut self, order: Order) {
        let mut asked = self.0.borrow_mut();
        asked.asides.push(order.clone());
        let picture = painted(order.clone());
        asked.news.push(News::Aside(Box::new(order), Ok(picture)));
    }

    fn point_at(&mut self, question: Question) {
        self.0.borrow_mut().questions.push(question);
    }

    fn news(&mut self) -> Vec<News> {
        std::mem::take(&mut self.0.borrow_mut().news)
    }

    fn command(&self, order: &Order) -> String {
        order.options().join(" ")
    }

    fn save(&mut self, take: Take, sheet: &Sheet, _: &Order) {
        self.0.borrow_mut().saved.push((take, sheet.file()));
    }

    fn save_pose(&mut self, pose: &Pose) -> Result<String, String> {
        let mut asked = self.0.borrow_mut();
        asked.poses.push(pose.clone());
        Ok(format!("pose{}.json", asked.poses.len()))
    }

    fn film_command(&self, film: &Film, order: &Order) -> String {
        [order.options(), film.options()].concat().join(" ")
    }

    fn film(&mut self, film: &Film, order: &Order) {
        self.0.borrow_mut().films.push((*film, order.clone()));
    }

    fn cancel(&mut self) {
        self.0.borrow_mut().cancelled += 1;
    }
}

const FRONT: Viewpoint = Viewpoint {
    eye: [0.0, 0.0, 5.0],
    target: [0.0; 3],
    up: [0.0, 1.0, 0.0],
    fov_deg: 40.0,
    is_parallel: false,
};

/// A studio in a window of a size, and its host.
fn studio(size: [f32; 2], overrides: &[&str]) -> (Harness<'static, Studio>, Easel) {
    studio_in_steps(size, overrides, 0.25)
}

/// The same, where a step takes so many seconds.
fn studio_in_steps(
    size: [f32; 2],
    overrides: &[&str],
    step_s: f32,
) -> (Harness<'static, Studio>, Easel) {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let sheet = Sheet::new("toon", Stated::preset("toon").unwrap(), &overrides).unwrap();
    studio_of(sheet, size, step_s)
}

/// The same with a style.
fn studio_of(sheet: Sheet, size: [f32; 2], step_s: f32) -> (Harness<'static, Studio>, Easel) {
    built(sheet, size, Harness::builder().with_step_dt(step_s))
}

/// A studio whose textures go to a renderer, and its host.
fn studio_drawn_by(
    renderer: impl TestRenderer + 'static,
    overrides: &[&str],
) -> (Harness<'static, Studio>, Easel) {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let sheet = Sheet::new("toon", Stated::preset("toon").unwrap(), &overrides).unwrap();
    let builder = Harness::builder().with_step_dt(0.25).renderer(renderer);
    built(sheet, [1000.0, 640.0], builder)
}

fn built(
    sheet: Sheet,
    size: [f32; 2],
    builder: HarnessBuilder<Studio>,
) -> (Harness<'static, Studio>, Easel) {
    let easel = Easel::default();
    let studio = Studio::new(sheet, None, Box::new(easel.clone()));
    let harness = builder
        .with_size(vec2(size[0], size[1]))
        .with_max_steps(64)
        .build_ui_state(|ui, studio: &mut Studio| studio.show(ui), studio);
    (harness, easel)
}

/// Every key with a control of its own, entries of lists as number 0 where `lists` has them.
fn keys(fields: &[Field], path: &str, lists: &[&str], found: &mut Vec<String>) {
    let toon = Sheet::new("toon", Stated::preset("toon").unwrap(), &[]).unwrap();
    for field in fields {
        let key = match path {
            "" => field.name.to_owned(),
            _ => format!("{path}.{}", field.name),
        };
        match &field.form {
            Form::Table(_)
                if field.usual.is_none() && !field.is_required && toon.value(&key).is_none() =>
            {
                found.push(key);
            }
            Form::Table(inner) => keys(inner, &key, lists, found),
            Form::List { entry, .. } => {
                if let Form::Table(inner) = &**entry
                    && lists.contains(&key.as_str())
                {
                    keys(inner, &format!("{key}.0"), lists, found);
                }
                found.push(key);
            }
            _ => found.push(key),
        }
    }
}

/// Opens groups until no more appear.
fn unfold(harness: &mut Harness<'static, Studio>) {
    harness.get_by_label("Unfold all").click();
    for _ in 0..8 {
        harness.run_steps(4);
    }
}

/// An entry for each list of a style that may be empty.
const LISTS: [&str; 4] = [
    r#"lettering=[{ text = "POW", font = "a.ttf" }]"#,
    r#"id_map=[{ image = "a.png" }]"#,
    r##"rule=[{ match = { material = "A" } }]"##,
    r#"light.extra=[{}]"#,
];

/// Lists whose entries have controls then.
const OPEN: [&str; 6] = [
    "lettering",
    "id_map",
    "rule",
    "light.extra",
    "shade.ramp",
    "smoke.ramp",
];

#[test]
fn every_key_of_the_schema_has_a_control_with_its_name() {
    let (mut harness, _) = studio([1000.0, 24_000.0], &LISTS);
    unfold(&mut harness);
    let mut wanted = Vec::new();
    keys(&fields(), "", &OPEN, &mut wanted);
    assert!(wanted.len() > 280, "{}", wanted.len());
    let missing: Vec<&String> = wanted
        .iter()
        .filter(|key| harness.query_all_by_label(key).next().is_none())
        .collect();
    assert!(
        missing.is_empty(),
        "{} of {}: {missing:?}",
        missing.len(),
        wanted.len()
    );
}

#[test]
fn search_finds_every_key_by_its_name() {
    let mut wanted = Vec::new();
    keys(&fields(), "", &[], &mut wanted);
    let (mut harness, _) = studio([1000.0, 6000.0], &[]);
    for key in wanted.iter().step_by(7) {
        harness.state_mut().search(key);
        harness.run_steps(3);
        let found = harness.query_all_by_label(key).count();
        assert_eq!(found, 1, "{key}");
    }
    harness.state_mut().search("no such words anywhere");
    harness.run_steps(3);
    assert_eq!(harness.query_all_by_label("line.color").count(), 0);
}

#[test]
fn undo_restores_the_style_to_the_byte_and_redo_brings_it_back() {
    let (mut harness, _) = studio([1000.0, 24_000.0], &[]);
    let toml =
        |harness: &Harness<'static, Studio>| harness.state().sheet().style().to_toml().unwrap();
    unfold(&mut harness);
    let mut seen = vec![toml(&harness)];
    for key in ["detect.depth.on", "light.shadow", "smoke.shadow"] {
        harness.get_by_label(key).click();
        harness.run_steps(4);
        seen.push(toml(&harness));
    }
    for before in seen.iter().rev().skip(1) {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(4);
        assert_eq!(&toml(&harness), before);
    }
    for after in &seen[1..] {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
        harness.run_steps(4);
        assert_eq!(&toml(&harness), after);
    }
    let overrides = harness.state().sheet().overrides();
    assert_eq!(overrides.len(), 3, "{overrides:?}");

    // Take one of them back by its own button.
    harness.get_by_label("reset light.shadow").click();
    harness.run_steps(4);
    let overrides = harness.state().sheet().overrides();
    assert_eq!(overrides, ["detect.depth.on=false", "smoke.shadow=false"]);
}

#[test]
fn a_slider_that_is_dragged_is_one_step_to_undo() {
    let (mut harness, easel) = studio([1000.0, 700.0], &[]);
    harness.state_mut().search("line.opacity");
    harness.run_steps(10);
    let slider = harness.get_by_label("line.opacity").rect();
    let end = egui::pos2(slider.left() + 92.0, slider.center().y);
    harness.drag_at(end);
    harness.run_steps(2);
    for step in 1..6 {
        harness.hover_at(end - vec2(10.0 * step as f32, 0.0));
        harness.run_steps(2);
    }
    harness.drop_at(end - vec2(50.0, 0.0));
    harness.run_steps(40);
    let opacity = harness.state().sheet().style().line.opacity;
    let told = harness.state().told();
    assert!(
        (0.3..0.7).contains(&opacity),
        "{opacity} {slider:?} {told:?}"
    );
    let last = easel.0.borrow().orders.last().unwrap().overrides.clone();
    assert_eq!(last, harness.state().sheet().overrides());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(4);
    assert_eq!(harness.state().sheet().overrides(), [""; 0]);
}

#[test]
fn a_drag_turns_the_picture_and_a_full_picture_follows_a_draft() {
    let (mut harness, easel) = studio([900.0, 600.0], &[]);
    harness.run_steps(30);
    let size = easel.0.borrow().orders[0].size;
    assert!(size[0] > 500 && size[1] > 500, "{size:?}");
    let middle = egui::pos2(200.0, 300.0);
    harness.drag_at(middle);
    harness.run_steps(2);
    harness.hover_at(middle + vec2(60.0, 20.0));
    harness.run_steps(3);
    let last = easel.0.borrow().orders.last().unwrap().clone();
    assert!(last.is_draft && last.size[0] < size[0], "{last:?}");
    assert!(last.viewpoint.unwrap().eye[0] < -0.5, "{last:?}");
    harness.drop_at(middle + vec2(60.0, 20.0));
    harness.run_steps(60);
    let picture = harness.state().picture().unwrap();
    assert!(!picture.order.is_draft && picture.order.viewpoint.unwrap().eye[0] < -0.5);

    // Look from a side, and frame the scene again.
    harness.key_press(Key::Num7);
    harness.key_press(Key::Num5);
    harness.run_steps(40);
    let point = easel.0.borrow().orders.last().unwrap().viewpoint.unwrap();
    assert!(point.eye[1] > 4.9 && point.is_parallel, "{point:?}");
    harness.key_press(Key::Home);
    harness.run_steps(40);
    assert_eq!(easel.0.borrow().orders.last().unwrap().viewpoint, None);
}

#[test]
fn what_goes_wrong_is_told_and_the_picture_stays() {
    let (mut harness, easel) = studio([900.0, 600.0], &[]);
    harness.run_steps(30);
    let before = harness.state().picture().unwrap().clone();
    easel
        .0
        .borrow_mut()
        .news
        .push(News::Fault("cannot read 'a.glb'".to_owned()));
    harness.run_steps(3);
    assert_eq!(harness.state().told(), Some("cannot read 'a.glb'"));
    assert!(harness.query_by_label("cannot read 'a.glb'").is_some());
    assert_eq!(harness.state().picture(), Some(&before));
}

#[test]
fn the_style_is_saved_and_the_command_copied() {
    let (mut harness, easel) = studio([900.0, 600.0], &["line.color=#ff0000"]);
    harness.run_steps(20);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    harness.run_steps(3);
    let (take, text) = easel.0.borrow().saved[0].clone();
    assert_eq!(take, Take::Style);
    assert_eq!(text, "extends = \"toon\"\n[line]\ncolor = \"#ff0000\"\n");
    harness.get_by_label("Copy command").click();
    harness.run_steps(2);
    let told = harness.state().told().unwrap_or_default();
    assert!(told.contains("clipboard"), "{told}");

    // Every other file has a button.
    for (name, take) in [("PNG", Take::Png), ("SVG", Take::Svg), ("JSON", Take::Json)] {
        harness.get_by_label(name).click();
        harness.run_steps(2);
        assert_eq!(easel.0.borrow().saved.last().unwrap().0, take);
    }
}

#[test]
fn the_panel_keeps_its_width_whatever_is_unfolded_and_searched() {
    let changes = [r#"light.extra=[{}]"#, "line.color=#f00", "shade.paper=#f00"];
    let (mut harness, easel) = studio([1000.0, 800.0], &changes);
    harness.run_steps(20);
    let size = easel.0.borrow().orders[0].size;
    unfold(&mut harness);
    for words in [
        "line opacity",
        "smoke",
        "direction",
        "use_scene_hints",
        "",
        "ramp",
    ] {
        harness.state_mut().search(words);
        harness.run_steps(10);
        assert_eq!(harness.state().order().size, size, "{words}");
    }
}

#[test]
fn the_panel_keeps_its_width_whatever_the_style_is_called() {
    let mut sizes = Vec::new();
    for name in [
        "toon",
        "t.toml",
        "styles/of a hero who/draws on paper.toml",
        &"x".repeat(300),
    ] {
        let sheet = Sheet::new(name, Stated::preset("toon").unwrap(), &[]).unwrap();
        let (mut harness, easel) = studio_of(sheet, [1000.0, 800.0], 0.25);
        harness.run_steps(60);
        sizes.push(easel.0.borrow().orders[0].size);
        sizes.push(harness.state().order().size);
    }
    sizes.dedup();
    assert_eq!(sizes.len(), 1, "{sizes:?}");
}

#[test]
fn a_window_of_one_point_shows_and_asks_for_one_pixel() {
    let (mut harness, easel) = studio([1.0, 1.0], &[]);
    harness.run_steps(10);
    assert_eq!(easel.0.borrow().orders[0].size, [1, 1]);
    let role = harness.root().accesskit_node().role();
    assert_ne!(role, Role::Unknown);
}
