//! The keys of a style as a tree of fields, for panels and tables that show all of them.

use serde_json::Value as Json;
use toml::Value;

use crate::Style;
use crate::schema::Node;

/// One key of a table of a style.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// The key within its table, such as `width`.
    pub name: &'static str,
    /// What it says, as the schema has it.
    pub text: &'static str,
    /// What it takes.
    pub form: Form,
    /// Its value where a file does not state it; `None` where there is none, which is a value too.
    pub usual: Option<Value>,
    /// Whether an entry of a list has to state it.
    pub is_required: bool,
}

/// What a key takes.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// Keys of their own.
    Table(Vec<Field>),
    /// `true` or `false`.
    Switch,
    /// One of some values, texts or numbers, each with what it means.
    Choice(Vec<(Value, &'static str)>),
    /// A number within a range, ends included.
    Number {
        /// The smallest and the largest.
        range: (f64, f64),
        /// Whether it has no fraction.
        is_whole: bool,
    },
    /// A [`Length`](crate::Length), plain or with its unit.
    Length,
    /// A [`Color`](crate::Color).
    Color,
    /// A [`Background`](crate::Background).
    Background,
    /// Any text.
    Text,
    /// Entries of one form.
    List {
        /// The form of each.
        entry: Box<Form>,
        /// Fewest and most of them.
        count: (u64, u64),
    },
    /// A value of one form or another.
    Either(Vec<Form>),
}

impl Form {
    /// A value of the form to start an entry of a list with. Tables state what they have to and nothing else.
    pub fn first(&self) -> Value {
        match self {
            Self::Table(fields) => {
                let required = fields.iter().filter(|field| field.is_required);
                let stated = required.map(|field| (field.name.to_owned(), field.form.first()));
                Value::Table(stated.collect())
            }
            Self::Switch => Value::Boolean(true),
            Self::Choice(words) => words
                .first()
                .map_or(Value::Boolean(true), |(word, _)| word.clone()),
            Self::Number { range, is_whole } => {
                let number = 0.0_f64.clamp(range.0, range.1);
                match is_whole {
                    true => Value::Integer(number as i64),
                    false => Value::Float(number),
                }
            }
            Self::Length => Value::Float(1.0),
            Self::Color | Self::Background => Value::String("#000000".to_owned()),
            Self::Text => Value::String(String::new()),
            Self::List { entry, count } => {
                Value::Array((0..count.0).map(|_| entry.first()).collect())
            }
            Self::Either(forms) => forms.first().map_or(Value::Boolean(true), Self::first),
        }
    }

    /// Whether a value is of this form, by its type.
    pub fn is_of(&self, value: &Value) -> bool {
        match self {
            Self::Table(_) => value.is_table(),
            Self::Switch => value.is_bool(),
            Self::Choice(words) => words.iter().any(|(word, _)| word == value),
            Self::Number { .. } => value.is_float() || value.is_integer(),
            Self::Length => value.is_float() || value.is_integer() || value.is_str(),
            Self::Color | Self::Background | Self::Text => value.is_str(),
            Self::List { .. } => value.is_array(),
            Self::Either(forms) => forms.iter().any(|form| form.is_of(value)),
        }
    }
}

/// Every key of a style as a tree, from the schema; tables stand in the order of the style's structs, and plain keys
/// before the tables beside them.
///
/// ```
/// use npr_stylesheet::{Form, fields};
///
/// let fields = fields();
/// let line = fields.iter().find(|field| field.name == "line").unwrap();
/// assert!(matches!(&line.form, Form::Table(keys) if keys.iter().any(|key| key.name == "color")));
/// ```
pub fn fields() -> Vec<Field> {
    let order = written_order();
    Node::root().map_or(Vec::new(), |root| fields_of(root, "", &order))
}

/// The keys of a table at a path.
fn fields_of(table: Node, path: &str, order: &[String]) -> Vec<Field> {
    // Make a field of every key.
    let mut required = table.required().collect::<Vec<_>>();
    required.sort_unstable();
    let field = |name: &'static str| {
        let stated = table.0.get("properties")?.get(name)?;
        let node = table.property(name)?;
        let below = match path {
            "" => name.to_owned(),
            _ => format!("{path}.{name}"),
        };
        let usual = stated.get("default").or(node.0.get("default"));
        let own = stated.get("description").and_then(Json::as_str);
        let field = Field {
            name,
            text: own.or(node.text("description")).unwrap_or_default(),
            form: form_of(node, &below, order),
            usual: usual.and_then(|usual| Value::try_from(usual).ok()),
            is_required: required.binary_search(&name).is_ok(),
        };
        Some((below, field))
    };
    let mut fields: Vec<(String, Field)> = table.keys().filter_map(field).collect();

    // Order them as they are written; those that a default style does not write come last.
    let place = |path: &String| order.iter().position(|other| other == path);
    fields.sort_by_key(|(path, _)| place(path).unwrap_or(usize::MAX));
    fields.into_iter().map(|(_, field)| field).collect()
}

fn form_of(node: Node, path: &str, order: &[String]) -> Form {
    // Find the forms that say more than that there is no value.
    let forms = node.forms();
    let mut forms = forms.into_iter().filter(|form| !form.is_null_alone());
    let (Some(form), rest) = (forms.next(), forms.collect::<Vec<_>>()) else {
        return Form::Text;
    };
    if rest.iter().any(|form| form.format() == Some("length")) {
        return Form::Length;
    }
    if !rest.is_empty() {
        let all = [form].into_iter().chain(rest);
        return Form::Either(all.map(|form| form_of(form, path, order)).collect());
    }

    // Tell the one by what it says.
    let words = form.described_words();
    if !words.is_empty() {
        return Form::Choice(words);
    }
    match form.format() {
        Some("color") => return Form::Color,
        Some("background") => return Form::Background,
        Some("length") => return Form::Length,
        _ => {}
    }
    if form.keys().next().is_some() {
        return Form::Table(fields_of(form, path, order));
    }
    if let Some(items) = form.items() {
        return Form::List {
            entry: Box::new(form_of(items, path, order)),
            count: form.count(),
        };
    }
    let is_whole = form.is("integer");
    if is_whole || form.is("number") {
        let range = form.range();
        return Form::Number { range, is_whole };
    }
    match form.is("boolean") {
        true => Form::Switch,
        false => Form::Text,
    }
}

/// Paths of keys in the order in which a default style writes them, which is that of its structs.
fn written_order() -> Vec<String> {
    let text = Style::default().to_toml().unwrap_or_default();
    let mut order: Vec<String> = Vec::new();
    let mut table = String::new();
    for line in text.lines() {
        if let Some(header) = line.strip_prefix('[') {
            table = header
                .trim_matches(|letter| letter == '[' || letter == ']')
                .to_owned();
            for (end, _) in table.match_indices('.') {
                order.push(table[..end].to_owned());
            }
            order.push(table.clone());
        } else if let Some((name, _)) = line.split_once(" = ") {
            order.push(match table.as_str() {
                "" => name.to_owned(),
                _ => format!("{table}.{name}"),
            });
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every field with its path, those of entries of lists too.
    fn all(fields: &[Field], path: &str, found: &mut Vec<(String, Field)>) {
        for field in fields {
            let below = format!("{path}.{}", field.name);
            found.push((below.clone(), field.clone()));
            if let Form::Table(fields) = &field.form {
                all(fields, &below, found);
            }
            if let Form::List { entry, .. } = &field.form
                && let Form::Table(fields) = &**entry
            {
                all(fields, &below, found);
            }
        }
    }

    fn found() -> Vec<(String, Field)> {
        let mut found = Vec::new();
        all(&fields(), "", &mut found);
        found
    }

    fn form(path: &str) -> Form {
        let found = found();
        let field = found.into_iter().find(|(other, _)| other == path);
        field.unwrap_or_else(|| panic!("no {path}")).1.form
    }

    #[test]
    fn every_form_is_told_from_the_schema() {
        assert_eq!(form(".line.width.base"), Form::Length);
        assert_eq!(form(".line.color"), Form::Color);
        assert_eq!(form(".line.paint.kinds.crease"), Form::Color);
        assert_eq!(form(".background"), Form::Background);
        assert_eq!(form(".detect.depth.on"), Form::Switch);
        assert_eq!(form(".lettering.text"), Form::Text);
        let samples = form(".antialias.samples");
        assert!(matches!(samples, Form::Choice(words) if words[0].0 == Value::Integer(1)));
        let Form::Choice(words) = form(".highlight.model") else {
            panic!("no choice");
        };
        assert_eq!(words[0].0, Value::String("blinn".to_owned()));
        assert!(words[0].1.starts_with("The half vector"));
        let Form::List { entry, count } = form(".highlight.shift") else {
            panic!("no list");
        };
        assert_eq!(count, (2, 2));
        let range = (-1.0, 1.0);
        assert_eq!(
            *entry,
            Form::Number {
                range,
                is_whole: false
            }
        );
        assert!(matches!(form(".use_scene_hints"), Form::Either(forms) if forms.len() == 2));
        assert!(matches!(form(".rule.beam"), Form::Table(_)));
    }

    #[test]
    fn fields_have_a_text_and_defaults_are_of_their_form() {
        let found = found();
        assert!(found.len() > 300, "{}", found.len());
        for (path, field) in found {
            assert!(!field.text.is_empty(), "{path} has no text");
            if let Some(usual) = &field.usual {
                assert!(field.form.is_of(usual), "{path}: {usual}");
            }
            assert!(field.form.is_of(&field.form.first()), "{path}");
        }
    }

    #[test]
    fn tables_stand_as_the_structs_have_them() {
        let fields = fields();
        let place = |name| fields.iter().position(|field| field.name == name);
        assert!(place("shade") < place("ink") && place("ink") < place("line"));
        assert!(place("title") < place("shade") && place("line") < place("rule"));
    }
}
