//! Style files as users write them: presets, parents, rules, overrides and slips.

use std::cell::Cell;

use npr_stylesheet::{
    Background, Color, Hatch, OutlineMethod, PARENTS_MAX, Pattern, Style, StyleError,
    TEXT_BYTES_MAX, presets,
};
use proptest::prelude::*;

fn no_files(name: &str) -> Result<String, String> {
    Err(format!("no file '{name}'"))
}

fn read(text: &str) -> Result<Style, StyleError> {
    Style::from_toml(text, &no_files)
}

fn message(text: &str) -> String {
    read(text).expect_err(text).to_string()
}

#[test]
fn every_preset_reads_and_survives_writing() {
    for preset in presets() {
        let style =
            Style::preset(preset.name).unwrap_or_else(|error| panic!("{}: {error}", preset.name));
        assert_eq!(
            (style.title.as_str(), style.version),
            (preset.title(), preset.version)
        );
        let text = style.to_toml().expect("a style that was read");
        assert_eq!(read(&text), Ok(style), "{}", preset.name);
        assert!(Style::preset(&format!("{}@{}", preset.name, preset.version)).is_ok());
    }
}

#[test]
fn the_defaults_are_the_preset_toon() {
    let toon = Style::preset("toon").expect("a preset");
    assert_eq!(
        Style {
            title: toon.title.clone(),
            version: toon.version,
            ..Style::default()
        },
        toon
    );
}

#[test]
fn every_value_of_a_preset_has_a_remark() {
    for preset in presets() {
        let values = preset
            .text
            .lines()
            .filter(|line| line.contains(" = ") && !line.starts_with(['#', ' ']));
        for line in values.filter(|line| !line.starts_with("title") && !line.starts_with("version"))
        {
            let above = preset
                .text
                .split(line)
                .next()
                .unwrap_or_default()
                .lines()
                .last()
                .unwrap_or_default();
            let switch = line == "on = true";
            assert!(
                line.contains("  #") || line.contains(" # ") || above.starts_with('#') || switch,
                "{}: {line}",
                preset.name
            );
        }
    }
}

/// Presets whose shade is ink, strokes or dots, and those they are weighed against.
const WITH_ADVICE: [&str; 11] = [
    "ink",
    "g-pen",
    "comic-silver",
    "comic-modern",
    "simple-comic",
    "crosshatch",
    "stipple",
    "pencil",
    "screentone",
    "cel-2",
    "cel-3",
];

#[test]
fn presets_of_ink_say_what_they_are_for_and_what_to_take_elsewhere() {
    for name in WITH_ADVICE {
        let preset = npr_stylesheet::find_preset(name).expect("a preset");
        let opening: Vec<&str> = preset
            .text
            .lines()
            .take_while(|line| line.starts_with('#'))
            .map(|line| line.trim_start_matches(['#', ' ']))
            .collect();
        let advice = opening[1..].join(" ");
        assert!(advice.starts_with("For "), "{name}: {advice}");
        assert!(advice.len() > 60, "{name} gives no reason: {advice}");
        let words = advice.split(|c: char| !(c.is_alphanumeric() || c == '-'));
        let others: Vec<&str> = words
            .filter(|word| *word != name && presets().iter().any(|preset| preset.name == *word))
            .collect();
        assert!(
            !others.is_empty(),
            "{name} names nothing to take elsewhere: {advice}"
        );
    }
    // Every situation that strokes, crossed strokes or ink are advised for is told apart.
    let text = |name| npr_stylesheet::find_preset(name).expect("a preset").text;
    for (name, situation) in [
        ("ink", "metal"),
        ("comic-silver", "machines"),
        ("crosshatch", "cloth"),
        ("stipple", "skin"),
    ] {
        assert!(text(name).contains(situation), "{name}: {situation}");
    }
}

#[test]
fn the_comparison_presets_differ_only_in_method() {
    let mut okuya = Style::preset("okuya").expect("a preset");
    for (name, method) in [
        ("filter", OutlineMethod::Filter),
        ("hull", OutlineMethod::Hull),
        ("filter-hull", OutlineMethod::FilterHull),
    ] {
        let style = Style::preset(name).expect("a preset");
        okuya.line.method = method;
        okuya.title = style.title.clone();
        assert_eq!(style, okuya);
    }
}

#[test]
fn slips_are_named_with_place_and_cure() {
    for (text, expected) in [
        (
            "title = 'x'\n\n[line]\nwidht = 2\n",
            "unknown key 'line.widht' at line 4, column 1; did you mean 'line.width'?",
        ),
        (
            "[line.width]\ngain = 40\n",
            "line.width.gain at line 2, column 1 is 40, but must lie in 0..10",
        ),
        (
            "light.direction = [0, 0, 0]",
            "light.direction at line 1, column 7 points nowhere",
        ),
        (
            "ink.direction = [0, 0, 0]",
            "ink.direction at line 1, column 5 points nowhere",
        ),
        (
            "light.direction = [0, 1e300, 1]",
            "light.direction.1 at line 1, column 23 is 1e300, but must lie in -1e9..1e9",
        ),
        (
            "line.opacity = nan",
            "line.opacity at line 1, column 6 is NaN, but must lie in 0..1",
        ),
        (
            "line.opacity = 'x'",
            "line.opacity at line 1, column 6 is text, but must be a number",
        ),
        (
            "line.color = 'rde'",
            "line.color at line 1, column 6 'rde' is not a CSS colour such as #1e1a18 or saddlebrown",
        ),
        (
            "line.width.base = '3em'",
            "line.width.base at line 1, column 12 '3em' is not a length such as 3, 3px, 0.5mm, 0.01world or 0.3%h",
        ),
        (
            "shade.mode = 'wet'",
            "shade.mode at line 1, column 7 is 'wet', but must be one of ramp, flat, paper",
        ),
        (
            "antialias.samples = 2",
            "antialias.samples at line 1, column 11 is 2, but must be one of 1, 4",
        ),
        (
            "shade.ramp = []",
            "shade.ramp at line 1, column 7 has 0 entries, but must have 1 to 8",
        ),
        (
            "shade.ramp = [{ at = 0 }]",
            "shade.ramp.0 at line 1, column 15 lacks 'light'",
        ),
        (
            "shade.ramp = [{ at = 1, light = 1 }, { at = 0, light = 1 }]",
            "shade.ramp.1.at at line 1, column 40 lies before the stop ahead of it",
        ),
        (
            "line.width.min = 9",
            "line.width.min at line 1, column 12 is 9, but must lie in 0..1.5",
        ),
        (
            "line.width.source = 'texture'",
            "line.width.source at line 1, column 12 is texture, but line.width.texture names no image",
        ),
        (
            "extends = 'inc'",
            "cannot read parent style 'inc': no file 'inc'",
        ),
        (
            "extends = 'ink@10'",
            "preset 'ink' has no version 10, only 9",
        ),
    ] {
        assert_eq!(message(text), expected);
    }
}

#[test]
fn what_is_no_toml_has_a_place() {
    let error = read("line = {\n  color = = 3\n").expect_err("no TOML");
    assert!(
        matches!(error, StyleError::Syntax { place: Some(place), .. } if place.line == 2),
        "{error}"
    );
}

#[test]
fn unknown_presets_get_a_suggestion() {
    let error = Style::preset("tecnical").expect_err("no preset");
    assert_eq!(
        error.to_string(),
        "no preset is called 'tecnical'; did you mean 'technical'?"
    );
}

#[test]
fn parents_lie_below_and_rules_add_up() {
    let load = |name: &str| match name {
        "house.toml" => Ok("extends = 'ink'\ntitle = 'house'\n\
                            line.color = 'navy'\n[[rule]]\nmatch.object = 'Eye*'\nline.on = false"
            .to_owned()),
        other => no_files(other),
    };
    let text = "extends = ['toon', 'house.toml']\nline.opacity = 0.5\n\
                [[rule]]\nmatch.material = 'Glass'\nline.on = false";
    let style = Style::from_toml(text, &load).expect("a style");
    assert_eq!(
        (style.line.color, style.line.opacity),
        (Color::rgb(0, 0, 128), 0.5)
    );
    assert_eq!(
        style.background,
        Background::Color(Color::rgb(0xfb, 0xf6, 0xea))
    );
    let inherited = Style::preset("ink").expect("a preset").rule.len();
    assert_eq!(
        (style.rule.len(), style.title.as_str()),
        (inherited + 2, "")
    );
    assert!(style.extends.is_empty());
}

/// A look with the strokes of another has all of its tones and none of its own lines, whatever either states.
#[test]
fn looks_share_the_strokes_of_another_style() {
    let load = |name: &str| {
        match name {
        "pen.toml" => Ok("title = 'pen'\nbackground = 'red'\nline.width.base = '7px'\n\
                          line.hand.wobble = '3px'\npaper.size = '33px'\n\
                          [[rule]]\nmatch.object = 'Eye*'\nline.width_factor = 0.5\nshade.color = '#f00'"
            .to_owned()),
        other => no_files(other),
    }
    };
    let pen = Style::from_toml("extends = 'pen.toml'", &load).expect("a style");
    for look in ["night", "comic-silver", "blueprint", "ink"] {
        let own = Style::preset(look).expect("a preset");
        let text = format!("extends = '{look}'\nstrokes = 'pen.toml'\nline.opacity = 0.5");
        let mut style = Style::from_toml(&text, &load).expect("a style");

        // Its lines are those of the pen, but for what the file itself states.
        assert_eq!(style.line.opacity, 0.5, "{look}");
        style.line.opacity = pen.line.opacity;
        assert_eq!(
            (&style.line, &style.paper),
            (&pen.line, &pen.paper),
            "{look}"
        );
        let rule = style.rule.pop().expect("the pen's rule");
        assert_eq!(rule.line, pen.rule[0].line, "{look}");
        assert_eq!(
            (rule.shade.color, &rule.matching),
            (None, &pen.rule[0].matching),
            "{look}"
        );

        // All else is the look's own.
        let (line, paper) = (own.line.clone(), own.paper.clone());
        let (title, version) = (own.title.clone(), own.version);
        assert_eq!(
            Style {
                line,
                paper,
                title,
                version,
                ..style
            },
            own,
            "{look}"
        );

        // An override takes strokes of presets likewise, and no files.
        let mut set = own.clone();
        set.set("strokes=sketch").expect("a preset");
        let sketch = Style::preset("sketch").expect("a preset");
        assert_eq!(
            (&set.line, &set.paper),
            (&sketch.line, &sketch.paper),
            "{look}"
        );
        assert_eq!(set.background, own.background, "{look}");
        assert!(set.set("strokes=pen.toml").is_err() && set.set("strokes=4").is_err());
        assert!(set.set("strokes=no-such").is_err());
    }
    let circle = Style::from_toml("strokes = 'a'", &|_| Ok("strokes = 'a'".to_owned()));
    assert!(
        matches!(circle, Err(StyleError::Cycle { .. })),
        "{circle:?}"
    );
}

#[test]
fn circles_and_crowds_of_parents_are_refused() {
    let circle = |name: &str| {
        Ok(format!(
            "extends = '{}'",
            if name == "a" { "b" } else { "a" }
        ))
    };
    assert_eq!(
        Style::from_toml("extends = 'a'", &circle),
        Err(StyleError::Cycle {
            parent: "a".to_owned()
        })
    );

    let count = Cell::new(0);
    let crowd = |_: &str| {
        count.set(count.get() + 1);
        Ok(format!("extends = ['x{0}', 'y{0}']", count.get()))
    };
    assert_eq!(
        Style::from_toml("extends = 'x'", &crowd),
        Err(StyleError::TooManyParents { limit: PARENTS_MAX })
    );
    assert_eq!(count.get(), PARENTS_MAX);
}

#[test]
fn a_fault_in_a_parent_names_the_parent() {
    let load = |_: &str| Ok("line.colour = 'red'".to_owned());
    let error = Style::from_toml("extends = 'mine.toml'", &load).expect_err("a fault");
    assert_eq!(
        error.to_string(),
        "in parent style 'mine.toml': unknown key 'line.colour' at line 1, column 6; did you mean 'line.color'?"
    );
}

#[test]
fn huge_and_deep_texts_are_refused() {
    let long = "#".repeat(TEXT_BYTES_MAX + 1);
    assert!(matches!(read(&long), Err(StyleError::TooLarge { .. })));
    for (open, close) in [("a.", "a = 1"), ("a = [", ""), ("[a.", "a]")] {
        assert!(read(&(open.repeat(200_000) + close)).is_err());
    }
    assert!(read(&("a=".to_owned() + &"[".repeat(500_000))).is_err());
    assert!(read(&("a=".to_owned() + &"{a=".repeat(300_000))).is_err());
    assert!(read(&("a.\n".repeat(300_000))).is_err());
    assert!(
        read(&("\"".to_owned() + &"k".repeat(100_000) + "\" = 1"))
            .expect_err("unknown")
            .to_string()
            .len()
            < 300
    );
}

#[test]
fn overrides_read_toml_or_bare_text() {
    let mut style = Style::default();
    for assignment in [
        "line.color=#f00",
        "line.width.base=5px",
        "line.opacity = 0.5",
        "line.kinds.crease=false",
        "background=transparent",
        "shade.ramp.1.light=0.9",
    ] {
        style
            .set(assignment)
            .unwrap_or_else(|error| panic!("{assignment}: {error}"));
    }
    assert_eq!(style.line.color, Color::rgb(255, 0, 0));
    assert_eq!(style.line.width.base.to_string(), "5px");
    assert_eq!((style.line.opacity, style.line.kinds.crease), (0.5, false));
    assert_eq!(
        (style.background.clone(), style.shade.ramp[1].light),
        (Background::Transparent, 0.9)
    );
}

#[test]
fn a_wrong_override_changes_nothing() {
    let mut style = Style::default();
    for assignment in [
        "",
        "=",
        "line",
        "line=3",
        "line.colour=red",
        "line.opacity=2",
        "rule.0.line.on=false",
        "a..b=1",
        "line.color.r=1",
    ] {
        assert!(style.set(assignment).is_err(), "{assignment}");
    }
    assert_eq!(style, Style::default());
}

#[test]
fn an_override_beats_every_rule() {
    let mut style = read("[[rule]]\nline.color = 'red'\nline.width_factor = 2").expect("a style");
    style.set("line.color=blue").expect("an override");
    let look = style.resolve_for("any", "any");
    assert_eq!(
        (look.line_color, look.width_factor),
        (Color::rgb(0, 0, 255), 2.0)
    );
}

#[test]
fn the_schema_describes_every_key() {
    fn missing(node: &serde_json::Value, path: &str, found: &mut Vec<String>) {
        for (key, inner) in node["properties"].as_object().into_iter().flatten() {
            if inner["description"].as_str().is_none() {
                found.push(format!("{path}.{key}"));
            }
        }
    }
    let schema = npr_stylesheet::schema();
    let mut found = Vec::new();
    missing(schema, "", &mut found);
    for (name, node) in schema["$defs"].as_object().expect("definitions") {
        missing(node, name, &mut found);
    }
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn hatches_read_and_refuse_like_the_rest_of_a_style() {
    let hatch: Hatch = toml::from_str("pattern = \"stipple\"\nspacing = \"2mm\"").unwrap();
    assert_eq!(hatch.pattern, Pattern::Stipple);
    assert_eq!(hatch.length, Hatch::default().length);
    assert!(toml::from_str::<Hatch>("patern = \"dots\"").is_err());
    let text = toml::to_string(&Hatch::default()).unwrap();
    assert_eq!(toml::from_str::<Hatch>(&text).unwrap(), Hatch::default());
}

fn toml_like() -> impl Strategy<Value = String> {
    let line = prop_oneof![
        "[a-z.]{0,12} = [-0-9.\"'\\[\\]{}a-z,= ]{0,12}",
        "\\[{1,2}(line|rule|shade.ramp|detect)\\]{1,2}",
        "(line|shade|light|detect)\\.[a-z_.]{1,10} = (true|1|nan|'x'|\\[1,2\\])",
        "extends = (\"ink\"|'x'|\\['toon', 'hull@2'\\])",
    ];
    prop::collection::vec(line, 0..8).prop_map(|lines| lines.join("\n"))
}

proptest! {
    #[test]
    fn no_text_panics(any in "\\PC{0,80}", like in toml_like(), assignment in "[a-z.0-9]{0,12}=?\\PC{0,12}") {
        for text in [&any, &like] {
            if let Err(error) = read(text) {
                prop_assert!(error.to_string().chars().count() < 300);
            }
        }
        let _ = Style::default().set(&assignment);
        let _ = Style::preset(&any);
    }

    #[test]
    fn the_later_layer_wins(
        parent in 0.0f32..1.0, child in prop::option::of(0.0f32..1.0), over in prop::option::of(0.0f32..1.0),
    ) {
        let line = |value: f32| format!("line.opacity = {value}");
        let load = |_: &str| Ok(line(parent));
        let text = format!("extends = 'p'\n{}", child.map(line).unwrap_or_default());
        let mut style = Style::from_toml(&text, &load).expect("a style");
        if let Some(value) = over {
            style.set(&line(value).replace(" = ", "=")).expect("an override");
        }
        prop_assert_eq!(style.line.opacity, over.or(child).unwrap_or(parent));
    }

    #[test]
    fn numbers_survive_writing(gain in 0.0f32..10.0, x in -1.0f32..1.0, factor in 0.0f32..10.0) {
        let mut style = Style::default();
        style.line.width.gain = gain;
        style.light.direction = [x, 1.0, 0.3];
        style.set("rule=[{ match = { material = 'A' }, line = { on = true } }]").expect("rules");
        style.rule[0].line.width_factor = Some(factor);
        prop_assert_eq!(read(&style.to_toml().expect("text")), Ok(style));
    }
}
