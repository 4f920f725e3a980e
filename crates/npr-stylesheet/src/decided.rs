//! Which key decides a value of a part.

use toml::Value;

use crate::key::at;
use crate::{PartNames, Style};

/// The key that decides a value, and the value.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decided {
    /// The key from the top: the style's own, or that of a rule, as `rule.2.line.color`.
    pub key: String,
    /// Its value in one line, text without quotes; empty where there is none.
    pub value: String,
}

impl Style {
    /// The key that decides a value of a part: that of the last rule which applies to the part and states it, else the
    /// style's own. `key` is the key from the top without rules, such as `line.color`.
    ///
    /// ```
    /// use npr_stylesheet::{PartNames, Style};
    ///
    /// let text = "line.color = '#111'\n[[rule]]\nmatch.material = 'Skin'\nline.color = '#842'";
    /// let style = Style::from_toml(text, &|_| Err(String::new()))?;
    /// let skin = PartNames { material: "Skin", ..PartNames::default() };
    /// let decided = style.decided(skin, "line.color");
    /// assert_eq!((decided.key.as_str(), decided.value.as_str()), ("rule.0.line.color", "#884422"));
    /// assert_eq!(style.decided(PartNames::default(), "line.color").key, "line.color");
    /// # Ok::<(), npr_stylesheet::StyleError>(())
    /// ```
    pub fn decided(&self, part: PartNames<'_>, key: &str) -> Decided {
        // Look for the last rule that states it: rules are written without what they leave as it is.
        let rules = self.rule.iter().enumerate().rev();
        for (number, rule) in rules.filter(|(_, rule)| rule.applies_to(part)) {
            let stated = Value::try_from(rule).ok();
            if let Some(value) = stated.as_ref().and_then(|rule| at(rule, key)) {
                return Decided {
                    key: format!("rule.{number}.{key}"),
                    value: text_of(value),
                };
            }
        }

        // Else it is the style's own.
        let own = Value::try_from(self).ok();
        let value = own.as_ref().and_then(|own| at(own, key));
        Decided {
            key: key.to_owned(),
            value: value.map(text_of).unwrap_or_default(),
        }
    }
}

/// A value in one line, text without quotes.
fn text_of(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        // Numbers of a style are of single precision.
        Value::Float(number) => format!("{}", *number as f32),
        Value::Array(entries) => match entries.iter().any(|entry| entry.is_table()) {
            true => format!("{} stops", entries.len()),
            false => {
                let entries: Vec<String> = entries.iter().map(text_of).collect();
                format!("[{}]", entries.join(", "))
            }
        },
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn later_rules_decide_and_those_of_other_parts_do_not() {
        let text = "line.width.base = '2mm'\n\
                    [[rule]]\nmatch.object = 'A*'\nline.width_factor = 0.5\nline.width.taper.start = 3\n\
                    [[rule]]\nmatch.object = 'B'\nline.width_factor = 4\n\
                    [[rule]]\nmatch.object = '*a'\nline.width_factor = 0.3";
        let style = Style::from_toml(text, &|_| Err(String::new())).unwrap();
        let decided = |object, key| {
            let part = PartNames {
                object,
                ..PartNames::default()
            };
            let Decided { key, value } = style.decided(part, key);
            format!("{key}={value}")
        };
        assert_eq!(
            decided("A", "line.width_factor"),
            "rule.0.line.width_factor=0.5"
        );
        assert_eq!(
            decided("Aa", "line.width_factor"),
            "rule.2.line.width_factor=0.3"
        );
        assert_eq!(
            decided("A", "line.width.taper.start"),
            "rule.0.line.width.taper.start=3"
        );
        assert_eq!(decided("C", "line.width_factor"), "line.width_factor=");
        assert_eq!(decided("A", "line.width.base"), "line.width.base=2mm");
    }
}
