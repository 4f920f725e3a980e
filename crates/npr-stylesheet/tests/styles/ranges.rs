//! Every number of a style has a range: the schema states it, and reading refuses what lies outside.

use npr_stylesheet::{Style, StyleError, schema};
use serde_json::Value as Json;
use toml::{Table, Value};

/// A key within a value, dots before each name and number of an entry, and the value that says a number there.
type Stated = (String, Value);

#[test]
fn numbers_far_outside_their_range_are_refused_by_name() {
    let (mut count, mut accepted) = (0, Vec::new());
    for (key, style) in far_numbers(schema()) {
        let text = toml::to_string(&style).expect("a table");
        let found = Style::from_toml(&text, &|_| Err(String::new()));
        let named = match &found {
            Err(StyleError::Value { key: named, .. }) => format!(".{named}") == key,
            _ => false,
        };
        if !named {
            accepted.push(format!(
                "{key}: {:?}",
                found.err().map(|error| error.to_string())
            ));
        }
        count += 1;
    }
    assert!(count > 300, "{count} numbers are in the schema");
    assert!(accepted.is_empty(), "{accepted:#?}");
}

/// Every number that `node` lets a style say, once far below and once far above what any key takes.
fn far_numbers(node: &Json) -> Vec<Stated> {
    // Follow the node to what it points at, and to its forms.
    if let Some(place) = node["$ref"].as_str() {
        let place = place.strip_prefix('#').expect("a place in the schema");
        return far_numbers(schema().pointer(place).expect("a node"));
    }
    let forms = ["anyOf", "oneOf"]
        .map(|key| node[key].as_array())
        .into_iter()
        .flatten()
        .flatten();
    let mut found: Vec<Stated> = forms.flat_map(far_numbers).collect();

    // Take the numbers of the node itself.
    if is(node, "number") {
        found.extend([-1e300, 1e300].map(|far| (String::new(), Value::Float(far))));
    } else if is(node, "integer") {
        found.extend([i64::MIN, i64::MAX].map(|far| (String::new(), Value::Integer(far))));
    }

    // Take those of entries, of which a list has as many as it must.
    if is(node, "array") {
        let entry_count = node["minItems"].as_u64().unwrap_or(1).max(1) as usize;
        let entries = far_numbers(&node["items"]).into_iter();
        found.extend(
            entries
                .map(|(key, value)| (format!(".0{key}"), Value::Array(vec![value; entry_count]))),
        );
    }

    // Take those of the keys of a table.
    for (name, inner) in node["properties"].as_object().into_iter().flatten() {
        found.extend(far_numbers(inner).into_iter().map(|(key, value)| {
            (
                format!(".{name}{key}"),
                Value::Table(Table::from_iter([(name.clone(), value)])),
            )
        }));
    }
    found
}

/// Whether the values of a node are of a JSON type.
fn is(node: &Json, kind: &str) -> bool {
    let types = &node["type"];
    types == kind
        || types
            .as_array()
            .is_some_and(|many| many.iter().any(|one| one == kind))
}
