//! Renamed keys: styles may still use the former names.

use toml::{Table, Value};

use crate::key::without_rule;

/// Renamed keys: the full former key, and the current name in the same table.
const FORMER: [(&str, &str); 2] = [
    ("line.kinds.border", "boundary"),
    ("line.paint.kinds.border", "boundary"),
];

/// The current name of the key at `path`, where that is a former key of the style or of a rule; else `None`.
pub(crate) fn name_of_today(path: &[&str]) -> Option<&'static str> {
    let key = path.join(".");
    let key = without_rule(&key).unwrap_or(&key);
    FORMER
        .iter()
        .find(|(former, _)| *former == key)
        .map(|(_, name)| *name)
}

/// Renames the former keys of a style file to their current names, and returns the former keys that it had.
///
/// Where both names are present, the current one counts. O(keys).
pub(crate) fn rename(table: &mut Table) -> Vec<String> {
    let mut renamed = Vec::new();
    for (former, name) in FORMER {
        let path: Vec<&str> = former.split('.').collect();
        if rename_in(table, &path, name) {
            renamed.push(former.to_owned());
        }
        let rules = table.get_mut("rule").and_then(Value::as_array_mut);
        for (i, rule) in rules.into_iter().flatten().enumerate() {
            if rule
                .as_table_mut()
                .is_some_and(|rule| rename_in(rule, &path, name))
            {
                renamed.push(format!("rule.{i}.{former}"));
            }
        }
    }
    renamed
}

/// Renames the last key of a path, and returns whether it was there.
fn rename_in(table: &mut Table, path: &[&str], name: &str) -> bool {
    match path {
        [former] => match table.remove(*former) {
            Some(value) => {
                table.entry(name).or_insert(value);
                true
            }
            None => false,
        },
        [first, rest @ ..] => {
            let inner = table.get_mut(*first).and_then(Value::as_table_mut);
            inner.is_some_and(|inner| rename_in(inner, rest, name))
        }
        [] => false,
    }
}

/// The notice about a key that was given under its former name.
pub(crate) fn notice(former: &str) -> String {
    let path: Vec<&str> = former.split('.').collect();
    let name = name_of_today(&path).unwrap_or_default();
    let table = former.rsplit_once('.').map_or("", |(table, _)| table);
    format!("'{former}' is called '{table}.{name}' today")
}

#[cfg(test)]
mod tests {
    use crate::{Color, Occasion, Output, Stated, Style};

    /// The style of a file, with the notices about its keys.
    fn read(text: &str) -> (Style, Vec<String>) {
        let stated = Stated::from_toml(text, &|_| Err(String::new())).expect("a style");
        (stated.style().clone(), reported(&stated))
    }

    fn reported(stated: &Stated) -> Vec<String> {
        let occasion = Occasion {
            output: Output::Frame,
            scene: crate::Facts::ALL,
        };
        stated.notices(&occasion)
    }

    #[test]
    fn former_names_are_read_with_a_word_about_them() {
        let (style, reported) = read("line.kinds.border = false");
        assert!(!style.line.kinds.boundary);
        assert_eq!(
            reported,
            ["'line.kinds.border' is called 'line.kinds.boundary' today"]
        );
        let (style, reported) = read("line.kinds.boundary = false");
        assert!(
            !style.line.kinds.boundary && reported.is_empty(),
            "{reported:?}"
        );
    }

    #[test]
    fn rules_and_overrides_know_former_names() {
        let (style, reported) = read("[[rule]]\nline.paint.kinds.border = 'red'");
        let colors = style.rule[0].line.paint.kinds;
        assert_eq!(colors.boundary, Some(Color::rgb(255, 0, 0)));
        assert_eq!(
            reported,
            ["'rule.0.line.paint.kinds.border' is called 'rule.0.line.paint.kinds.boundary' today"]
        );
        let mut stated = Stated::default();
        stated.set_all(&["line.kinds.border=false"]).expect("a key");
        assert!(!stated.style().line.kinds.boundary);
        assert_eq!(self::reported(&stated).len(), 1);
    }

    #[test]
    fn of_both_names_the_one_of_today_counts() {
        let (style, _) = read("line.kinds = { border = false, boundary = true }");
        assert!(style.line.kinds.boundary);
    }
}
