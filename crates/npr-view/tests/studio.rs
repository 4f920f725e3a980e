//! The studio as a user meets it: every key has a control, changes are undone to the byte, search finds keys.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "tests fail by panicking"
)]

use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use npr_stylesheet::{Field, Form, Stated, fields};
use npr_view::{
    Answer, Host, News, Order, Picture, Question, Remedy, Sheet, Studio, Take, ToldFact, ToldLine,
    ToldPart, Viewpoint,
};
use std::cell::RefCell;
use std::rc::Rc;

/// What a host was asked for.
#[derive(Default)]
struct Asked {
    orders: Vec<Order>,
    opened: Vec<String>,
    saved: Vec<(Take, String)>,
    questions: Vec<Question>,
    news: Vec<News>,
}

/// A host that draws pictures of one colour.
#[derive(Clone, Default)]
struct Easel(Rc<RefCell<Asked>>);

impl Host for Easel {
    fn style(&mut self, name: &str) -> Result<Stated, String> {
        Stated::preset(name).map_err(|error| error.to_string())
    }

    fn open(&mut self, path: &str) {
        self.0.borrow_mut().opened.push(path.to_owned());
    }

    fn draw(&mut self, order: Order) {
        let mut asked = self.0.borrow_mut();
        let pixels = (order.size[0] * order.size[1]) as usize;
        asked.orders.push(order.clone());
        asked.news.push(News::Picture(Box::new(Picture {
            rgba: vec![255; pixels * 4],
            viewpoint: order.viewpoint.unwrap_or(FRONT),
            engine: "nobody".to_owned(),
            seconds: 0.01,
            notices: Vec::new(),
            order,
        })));
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
    let easel = Easel::default();
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let sheet = Sheet::new("toon", Stated::preset("toon").unwrap(), &overrides).unwrap();
    let studio = Studio::new(sheet, None, Box::new(easel.clone()));
    let harness = Harness::builder()
        .with_size(vec2(size[0], size[1]))
        .with_max_steps(64)
        .with_step_dt(step_s)
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

#[test]
fn every_key_of_the_schema_has_a_control_with_its_name() {
    let lists = [
        r#"lettering=[{ text = "POW", font = "a.ttf" }]"#,
        r#"id_map=[{ image = "a.png" }]"#,
        r##"rule=[{ match = { material = "A" } }]"##,
        r#"light.extra=[{}]"#,
    ];
    let (mut harness, _) = studio([1000.0, 24_000.0], &lists);
    unfold(&mut harness);
    let mut wanted = Vec::new();
    let open = [
        "lettering",
        "id_map",
        "rule",
        "light.extra",
        "shade.ramp",
        "smoke.ramp",
    ];
    keys(&fields(), "", &open, &mut wanted);
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
fn a_window_of_one_point_shows_and_asks_for_one_pixel() {
    let (mut harness, easel) = studio([1.0, 1.0], &[]);
    harness.run_steps(10);
    assert_eq!(easel.0.borrow().orders[0].size, [1, 1]);
    let role = harness.root().accesskit_node().role();
    assert_ne!(role, Role::Unknown);
}

/// What a host tells of a crease from the upper left to the lower right corner.
fn crease(change: u64) -> Answer {
    let fact = |name: &str, text: &str, key: Option<&str>| ToldFact {
        name: name.to_owned(),
        text: text.to_owned(),
        key: key.map(str::to_owned),
    };
    let part = ToldPart {
        object: "Head".to_owned(),
        material: "Skin".to_owned(),
        at_rest: [0.5, 1.0, 0.0],
    };
    Answer {
        change,
        line: Some(ToldLine {
            points: vec![[0.0, 0.0], [1.0, 1.0]],
            closed: false,
            facts: vec![
                fact(
                    "Kind",
                    "crease: the surface bends sharply",
                    Some("line.kinds.crease"),
                ),
                fact("Width", "1.80 px", None),
                fact("", "3.00 px: the base width", Some("line.width.base")),
            ],
            part: part.clone(),
            removal: Remedy::Key("line.kinds.crease".to_owned()),
        }),
        part: Some(part),
        notice: None,
    }
}

#[test]
fn a_click_asks_why_a_line_is_there_and_its_card_removes_it() {
    let (mut harness, easel) = studio([900.0, 700.0], &[]);
    harness.run_steps(30);
    let order = harness.state().order();
    let toml =
        |harness: &Harness<'static, Studio>| harness.state().sheet().style().to_toml().unwrap();
    let before = toml(&harness);

    // A drag asks nothing, a click does.
    let at = egui::pos2(100.0, 200.0);
    harness.drag_at(at);
    harness.run_steps(2);
    harness.hover_at(at + vec2(50.0, 0.0));
    harness.run_steps(2);
    harness.drop_at(at + vec2(50.0, 0.0));
    harness.run_steps(40);
    assert!(easel.0.borrow().questions.is_empty());
    harness.drag_at(at);
    harness.run_steps(1);
    harness.drop_at(at);
    harness.run_steps(2);
    let question = easel.0.borrow().questions[0].clone();
    assert_eq!(question.order.size, order.size);
    assert!(
        question.place[0] > 60.0 && question.place[0] < 140.0,
        "{question:?}"
    );
    assert!((4.0..9.0).contains(&question.reach_px), "{question:?}");

    // An answer to another picture is not shown, one to this is.
    let asked = question.order.change;
    easel
        .0
        .borrow_mut()
        .news
        .push(News::Pointed(Box::new(crease(asked + 1))));
    harness.run_steps(3);
    assert!(harness.state().told_line().is_none());
    easel
        .0
        .borrow_mut()
        .news
        .push(News::Pointed(Box::new(crease(asked))));
    harness.run_steps(3);
    assert!(harness.state().told_line().is_some());
    for text in ["1.80 px", "line.width.base", "3.00 px: the base width"] {
        assert!(harness.query_by_label(text).is_some(), "{text}");
    }

    // Its button removes it, as one step, and the card goes with the line.
    harness
        .get_by_label("Remove: line.kinds.crease = false")
        .click();
    harness.run_steps(4);
    assert!(!harness.state().sheet().style().line.kinds.crease);
    assert_eq!(
        harness.state().sheet().overrides(),
        ["line.kinds.crease=false"]
    );
    assert!(harness.state().told_line().is_none());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(4);
    assert_eq!(toml(&harness), before);
}

#[test]
fn a_click_on_a_part_offers_a_rule_and_one_on_nothing_clears_the_card() {
    let (mut harness, easel) = studio([900.0, 700.0], &[]);
    harness.run_steps(30);
    let click = |harness: &mut Harness<'static, Studio>| {
        harness.drag_at(egui::pos2(100.0, 200.0));
        harness.run_steps(1);
        harness.drop_at(egui::pos2(100.0, 200.0));
        harness.run_steps(2);
        easel.0.borrow().questions.last().unwrap().order.change
    };
    let change = click(&mut harness);
    let answer = Answer {
        line: None,
        ..crease(change)
    };
    easel
        .0
        .borrow_mut()
        .news
        .push(News::Pointed(Box::new(answer)));
    harness.run_steps(3);
    harness.get_by_label("A rule for this part").click();
    harness.run_steps(4);
    let rules = harness.state().sheet().style().rule.clone();
    let last = &rules.last().unwrap().matching;
    assert_eq!(
        (last.object.as_str(), last.material.as_str()),
        ("Head", "Skin")
    );

    // The next answer has nothing.
    let change = click(&mut harness);
    easel
        .0
        .borrow_mut()
        .news
        .push(News::Pointed(Box::new(crease(change))));
    harness.run_steps(3);
    assert!(harness.state().told_line().is_some());
    let change = click(&mut harness);
    let nothing = Answer {
        change,
        ..Answer::default()
    };
    easel
        .0
        .borrow_mut()
        .news
        .push(News::Pointed(Box::new(nothing)));
    harness.run_steps(3);
    assert!(harness.state().told_line().is_none());
    assert!(harness.query_by_label("1.80 px").is_none());
}

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
    let lists = [
        r#"lettering=[{ text = "POW", font = "a.ttf" }]"#,
        r#"id_map=[{ image = "a.png" }]"#,
        r##"rule=[{ match = { material = "A" } }]"##,
        r#"light.extra=[{}]"#,
    ];
    let open = [
        "lettering",
        "id_map",
        "rule",
        "light.extra",
        "shade.ramp",
        "smoke.ramp",
    ];
    let (mut harness, _) = studio([1000.0, 9000.0], &lists);
    unfold(&mut harness);
    let mut reached = std::collections::BTreeMap::new();
    for field in fields() {
        // Show the keys of a table alone, and go on by Tab until a control comes again.
        let is_table = matches!(field.form, Form::Table(_));
        let words = if is_table { "." } else { "" };
        harness
            .state_mut()
            .search(&format!("{}{words}", field.name));
        harness.run_steps(6);
        let mut of_table = std::collections::BTreeMap::new();
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
        keys(&[field], "", &open, &mut wanted);
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
