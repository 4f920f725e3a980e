//! Why a line is there: what a studio asks its host, and what it is told.

use egui::Pos2;
use toml::{Table, Value};

use crate::sheet::Sheet;

/// What is at a place of a picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Answer {
    /// [`Order::change`](crate::Order::change) of the picture that was asked about.
    pub change: u64,
    /// The nearest line within reach.
    pub line: Option<ToldLine>,
    /// The part of the scene that the picture shows there.
    pub part: Option<ToldPart>,
    /// Why there may be lines of which nothing can be told; one sentence.
    pub notice: Option<String>,
}

/// A line, and what is told of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ToldLine {
    /// Its way through the picture, in shares of width and height.
    pub points: Vec<[f32; 2]>,
    /// Whether the last point runs on to the first.
    pub closed: bool,
    /// What is told, from the first to the last.
    pub facts: Vec<ToldFact>,
    /// The part that it lies on.
    pub part: ToldPart,
    /// What would remove it.
    pub removal: Remedy,
}

/// A fact of a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ToldFact {
    /// What it is about, one word; empty where it goes on with the fact before.
    pub name: String,
    /// What is so.
    pub text: String,
    /// The key that decides it, if one does.
    pub key: Option<String>,
}

/// A part of the scene at a place of the picture.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ToldPart {
    /// Name of its object.
    pub object: String,
    /// Name of its material; empty where it has none.
    pub material: String,
    /// The place on it, in the world of the scene at rest.
    pub at_rest: [f32; 3],
}

/// What would remove a line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Remedy {
    /// This key set to `false`.
    Key(String),
    /// A rule without lines for its part.
    Rule,
}

/// What was asked about the picture, and what was told.
#[derive(Default)]
pub(crate) struct Asked {
    /// The picture that was asked about, by its change, and where the click was.
    pub open: Option<(u64, Pos2)>,
    /// Counts questions.
    pub number: u32,
    /// Whether it was asked for the place of a guide point.
    pub is_for_guide: bool,
    pub answer: Option<Answer>,
}

impl Asked {
    /// Forgets it all.
    pub fn clear(&mut self) {
        (self.open, self.answer) = (None, None);
    }
}

impl Remedy {
    /// The key that it sets in a style, with the value.
    pub(crate) fn change(&self, sheet: &Sheet, part: &ToldPart) -> (String, Value) {
        match self {
            Self::Key(key) => (key.clone(), Value::Boolean(false)),
            Self::Rule => {
                let line = Table::from_iter([("on".to_owned(), Value::Boolean(false))]);
                let (key, rules) = with_rule(sheet, part, line);
                (key, Value::Array(rules))
            }
        }
    }

    /// What the button says that does it.
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Key(key) => format!("Remove: {key} = false"),
            Self::Rule => "Remove: a rule with line.on = false for this part".to_owned(),
        }
    }
}

/// The key of rules, and those of a style with another one at the end, for a part and with keys of `line`.
pub(crate) fn with_rule(sheet: &Sheet, part: &ToldPart, line: Table) -> (String, Vec<Value>) {
    // Say of the rules that are there what they state and nothing else.
    let rules = sheet.value("rule").and_then(Value::as_array);
    let mut rules: Vec<Value> = rules.into_iter().flatten().map(stated).collect();

    // Match the part by its names, of which every sign is meant as it stands.
    let mut matching = Table::new();
    for (key, name) in [("object", &part.object), ("material", &part.material)] {
        matching.insert(key.to_owned(), Value::String(literal(name)));
    }
    let mut rule = Table::new();
    rule.insert("match".to_owned(), Value::Table(matching));
    if !line.is_empty() {
        rule.insert("line".to_owned(), Value::Table(line));
    }
    rules.push(Value::Table(rule));
    ("rule".to_owned(), rules)
}

/// A pattern that matches a name: what patterns read more into stands for any letter.
fn literal(name: &str) -> String {
    name.replace(['*', '|'], "?")
}

/// A value without tables that state nothing.
fn stated(value: &Value) -> Value {
    let Some(table) = value.as_table() else {
        return value.clone();
    };
    let entries = table
        .iter()
        .map(|(key, value)| (key.clone(), stated(value)));
    let is_stated = |(_, value): &(String, Value)| value.as_table().is_none_or(|t| !t.is_empty());
    Value::Table(entries.filter(is_stated).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_stylesheet::Stated;

    #[test]
    fn a_rule_is_added_after_those_that_are_there_and_names_the_part() {
        let base = Stated::preset("toon").expect("a preset");
        let rules = [r##"rule=[{ match = { object = "A" }, line = { color = "#ff0000" } }]"##];
        let mut sheet = Sheet::new("toon", base, &rules.map(str::to_owned)).expect("fits");
        let part = ToldPart {
            object: "Head*".to_owned(),
            material: "Skin".to_owned(),
            ..ToldPart::default()
        };
        let (key, value) = Remedy::Rule.change(&sheet, &part);
        sheet.set(&key, &value).expect("fits");
        let has_lines = |material: &str, object: &str| {
            let look = sheet.style().resolve_for(material, object);
            look.line_on
        };
        assert!(!has_lines("Skin", "Head*") && has_lines("Cloth", "Head*"));
        assert!(has_lines("Skin", "Hand"));
        assert_eq!(sheet.style().rule.len(), 2);
        assert_eq!(
            sheet.style().resolve_for("", "A").line_color.to_string(),
            "#ff0000"
        );
        assert!(!sheet.overrides()[0].contains("{}") && !sheet.overrides()[0].contains("{  }"));
    }
}
