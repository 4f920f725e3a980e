//! Clicks on the picture: why a line is there, rules for parts, guide points.

use super::{Studio, studio};
use egui::{Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use npr_view::{Answer, News, Remedy, ToldFact, ToldLine, ToldPart};

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

#[test]
fn guide_points_are_placed_by_clicks_and_taken_away_by_clicks_on_them() {
    let (mut harness, easel) = studio([900.0, 700.0], &[]);
    harness.run_steps(30);
    let toml =
        |harness: &Harness<'static, Studio>| harness.state().sheet().style().to_toml().unwrap();
    let before = toml(&harness);
    let guides =
        |harness: &Harness<'static, Studio>| harness.state().sheet().style().line.guides.clone();
    let click = |harness: &mut Harness<'static, Studio>, at: egui::Pos2| {
        harness.drag_at(at);
        harness.run_steps(1);
        harness.drop_at(at);
        harness.run_steps(2);
    };

    // A click in the middle of the picture adds the point of the part that is told.
    harness.get_by_label("Guide points").click();
    harness.run_steps(4);
    let [width, _] = harness.state().order().size.map(|side| side as f32);
    let middle = egui::pos2(0.5 * width, 330.0);
    click(&mut harness, middle);
    let answer = |place: [f32; 3]| {
        let question = easel.0.borrow().questions.last().unwrap().clone();
        let told = crease(question.order.change);
        let part = told.part.map(|part| ToldPart {
            at_rest: place,
            ..part
        });
        News::Pointed(Box::new(Answer { part, ..told }))
    };
    let place = [0.0; 3];
    let told = answer(place);
    easel.0.borrow_mut().news.push(told);
    harness.run_steps(4);
    assert_eq!(guides(&harness), [place]);
    assert!(harness.state().told_line().is_none(), "no card");
    assert_eq!(
        harness.state().sheet().overrides(),
        ["line.guides=[[0, 0, 0]]"]
    );

    // Its dot lies in the middle of the picture, 8 points from the window's edges, where a click takes it away.
    let height = harness.state().order().size[1] as f32;
    let asked = easel.0.borrow().questions.len();
    click(
        &mut harness,
        egui::pos2(0.5 * width + 11.0, 0.5 * height + 8.0),
    );
    assert_eq!(guides(&harness).len(), 0);
    assert_eq!(easel.0.borrow().questions.len(), asked);

    // Each is a step of its own.
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(4);
    assert_eq!(guides(&harness), [place]);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(4);
    assert_eq!(toml(&harness), before);

    // Beside the model there is none to add.
    click(&mut harness, middle);
    let change = easel.0.borrow().questions.last().unwrap().order.change;
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
    assert!(harness.state().told().unwrap().contains("guide point"));
    assert_eq!(guides(&harness).len(), 0);
}
