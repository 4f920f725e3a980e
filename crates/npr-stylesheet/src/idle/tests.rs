use super::*;
use crate::LineSource;
use crate::Style;
use proptest::prelude::*;

const FRAME: Occasion = Occasion {
    output: Output::Frame,
    scene: Facts::ALL,
};

fn lines(source: LineSource) -> Occasion {
    let form = LineForm::Ink;
    Occasion {
        output: Output::Lines(LineOutput {
            source,
            form,
            fill: false,
        }),
        scene: Facts::ALL,
    }
}

fn stated(text: &str) -> Stated {
    Stated::from_toml(text, &|name| Err(format!("no '{name}'"))).unwrap()
}

#[test]
fn what_presets_say_is_nobodys_wish() {
    for preset in crate::presets() {
        let stated = Stated::preset(preset.name).unwrap();
        assert!(stated.notices(&lines(LineSource::Edges)).is_empty());
        let extended = stated_over(preset.name);
        let reported = extended.notices(&lines(LineSource::Edges));
        assert_eq!(reported.len(), 1, "{}: {reported:?}", preset.name);
    }
}

/// A style file that states one key of pictures over a preset.
fn stated_over(preset: &str) -> Stated {
    stated(&format!("extends = '{preset}'\nblend.amount = 0.5"))
}

#[test]
fn a_file_that_says_what_is_so_anyway_wishes_nothing() {
    let dumped = stated(&Style::default().to_toml().unwrap());
    assert!(dumped.notices(&FRAME).is_empty());
    assert!(dumped.notices(&lines(LineSource::Edges)).is_empty());
    let changed = stated("[motion]\nseed = 0\n[ink]\npaint = 0.25");
    assert_eq!(changed.keys().collect::<Vec<_>>(), ["ink.paint"]);
}

#[test]
fn rules_of_files_keep_their_numbers_behind_those_of_presets() {
    let preset = crate::presets()
        .iter()
        .find(|preset| !Style::preset(preset.name).unwrap().rule.is_empty());
    let preset = preset.expect("some preset has rules");
    let count = Style::preset(preset.name).unwrap().rule.len();
    let stated = stated(&format!(
        "extends = '{}'\n[[rule]]\nline.on = false",
        preset.name
    ));
    assert_eq!(
        stated.keys().collect::<Vec<_>>(),
        [format!("rule.{count}.line.on")]
    );
}

#[test]
fn keys_of_one_reason_are_named_together_and_once() {
    let stated = stated("[ink]\ntone = 'hatch'\npaint = 0.5\n[ink.hatch]\nspacing = '9px'");
    let reported = stated.notices(&lines(LineSource::Edges));
    let wanted = "'ink.hatch.spacing', 'ink.paint' and 'ink.tone' are ignored by npr lines: \
                  it draws no tones and no hatching";
    assert_eq!(reported, [wanted]);
    assert!(stated.notices(&FRAME).is_empty());
}

#[test]
fn an_override_is_stated_and_what_it_replaces_is_not() {
    let mut stated =
        stated("[[rule]]\nshade.color = '#f00'\nline.width_factor = 2\n[shade]\nsoftness = 0.1");
    stated
        .set_all(&["shade={ mode = 'flat' }", "line.width_factor=3"])
        .unwrap_err();
    stated.set_all(&["shade={ mode = 'flat' }"]).unwrap();
    assert_eq!(
        stated.keys().collect::<Vec<_>>(),
        ["rule.0.line.width_factor", "shade.mode"]
    );
}

#[test]
fn methods_of_parts_count() {
    let of_all = stated("line.method = 'strokes'\ndetect.scale = 2");
    assert_eq!(of_all.notices(&FRAME).len(), 1);
    let of_one =
        stated("line.method = 'strokes'\ndetect.scale = 2\n[[rule]]\nline.method = 'shape'");
    assert!(of_one.notices(&FRAME).is_empty());
    let of_rule = stated("[[rule]]\nline.method = 'strokes'\nline.angle_threshold_deg = 20");
    let reported = of_rule.notices(&FRAME);
    let wanted =
        "'rule.0.line.angle_threshold_deg' is ignored: lines of method strokes do not use it";
    assert_eq!(reported, [wanted]);
}

#[test]
fn overrides_that_need_each_other_come_in_any_order() {
    for overrides in [
        ["line.width.min=5", "line.width.max=9"],
        ["line.width.max=9", "line.width.min=5"],
    ] {
        let mut stated = Stated::default();
        stated.set_all(&overrides).unwrap();
        assert_eq!(stated.style().line.width.min, 5.0);
    }
    let mut stated = Stated::default();
    let error = stated.set_all(&["line.width.min=5"]).unwrap_err();
    assert!(error.to_string().contains("line.width.min"), "{error}");
    assert_eq!(stated, Stated::default());
}

#[test]
fn entries_that_are_not_there_are_told_with_the_valid_form() {
    let reported =
        |text: &str, assignment: &str| stated(text).set_all(&[assignment]).unwrap_err().to_string();
    let wanted = "'rule' has no entries, so there is no 'rule.0': write \
        rule=[{ match = { material = 'Skin*' }, line = { on = false } }]";
    assert_eq!(reported("", "rule.0.x="), wanted);
    assert_eq!(reported("", "rule.0.line.on=false"), wanted);
    let one = "[[rule]]\nline.on = false";
    let wanted = "'rule' has one entry, so there is no 'rule.1': write rule.0.key=value";
    assert_eq!(reported(one, "rule.1.line.on=true"), wanted);
    assert_eq!(
        reported(one, "rule.line.on=true"),
        wanted.replace("rule.1", "rule.line")
    );
    let unknown = reported(one, "rule.0.lime.on=true");
    assert_eq!(
        unknown,
        "unknown key 'rule.0.lime'; did you mean 'rule.0.line'?"
    );
    let three = reported("", "shade.ramp.3.light=1");
    assert_eq!(
        three,
        "'shade.ramp' has 3 entries, so there is no 'shade.ramp.3': write shade.ramp.N.key=value with N from 0 to 2"
    );
}

#[test]
fn patterns_cover_keys_and_what_is_in_them() {
    assert!(covers("ink", "ink.tone") && covers("ink.tone", "ink.tone"));
    assert!(!covers("ink", "inky") && !covers("ink.tone", "ink"));
    assert!(covers("smoke.l*", "smoke.layers"));
}

proptest! {
    /// Whatever keys there are, each is named once, and no notice is longer than a line.
    #[test]
    fn every_key_is_named_once(lengths in prop::collection::vec(1usize..60, 1..40)) {
        let numbered = lengths.iter().enumerate();
        let keys: Vec<String> = numbered.map(|(i, length)| format!("{i}.{}", "k".repeat(*length))).collect();
        let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
        let reported = sentences(&keys, "", "there is a reason");
        for key in &keys {
            let quoted = format!("'{key}'");
            prop_assert_eq!(reported.iter().filter(|text| text.contains(&quoted)).count(), 1);
        }
        prop_assert!(reported.iter().all(|text| text.chars().count() <= NOTICE_LENGTH));
        prop_assert!(reported.iter().all(|text| text.ends_with("ignored: there is a reason")));
    }
}
