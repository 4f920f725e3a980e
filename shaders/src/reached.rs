//! What of a linked text its entry points reach.

use std::collections::BTreeMap;

/// The parts of a text that its entry points and its bindings reach; most of what libraries hold is of no use to one
/// shader, and compiling it takes most of the time.
///
/// The text is WGSL without comments, and without template lists in declarations other than those of variables.
/// O(length).
pub(crate) fn reached(text: &str) -> String {
    // Know the declarations by their names.
    let items = items_of(text);
    let declared = items.iter().enumerate();
    let by_name: BTreeMap<&str, usize> = declared
        .filter_map(|(number, item)| Some((declared_name(item)?, number)))
        .collect();

    // Go from the roots to all that they name.
    let mut is_reached = vec![false; items.len()];
    let mut open: Vec<usize> = (0..items.len()).filter(|i| is_root(items[*i])).collect();
    while let Some(number) = open.pop() {
        if !std::mem::replace(&mut is_reached[number], true) {
            open.extend(names_in(items[number]).filter_map(|name| by_name.get(name)));
        }
    }

    // Put them together in their order.
    let mut out = String::with_capacity(text.len());
    for (item, _) in items.iter().zip(is_reached).filter(|(_, is)| *is) {
        out.push_str(item);
        out.push('\n');
    }
    out
}

/// The declarations of a text: each ends with a brace or a semicolon outside of all others.
fn items_of(text: &str) -> Vec<&str> {
    let mut items = Vec::new();
    let (mut start, mut depth) = (0, 0_usize);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'{' | b'(' => depth += 1,
            b'}' | b')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 && matches!(byte, b'}' | b';') {
            items.push(text[start..=at].trim_start());
            start = at + 1;
        }
    }
    items
}

/// The words of a text: names, keywords and numbers.
fn names_in(text: &str) -> impl Iterator<Item = &str> {
    let is_apart = |byte: &u8| !byte.is_ascii_alphanumeric() && *byte != b'_';
    let mut rest = text;
    std::iter::from_fn(move || {
        let start = rest.bytes().position(|byte| !is_apart(&byte))?;
        let after = &rest[start..];
        let end = after.bytes().position(|byte| is_apart(&byte));
        let (word, left) = after.split_at(end.unwrap_or(after.len()));
        rest = left;
        Some(word)
    })
}

/// The name that an item declares.
fn declared_name(item: &str) -> Option<&str> {
    let keyword = ["fn", "struct", "const", "override", "alias", "var"];
    let mut words = names_in(item).skip_while(|word| !keyword.contains(word));
    if words.next()? != "var" {
        return words.next();
    }
    names_in(skip_template(item.split_once("var")?.1)).next()
}

/// What follows the template list that a text starts with.
fn skip_template(text: &str) -> &str {
    match text.strip_prefix('<').and_then(|rest| rest.split_once('>')) {
        Some((_, after)) => after,
        None => text,
    }
}

/// Whether an item is there for the host: an entry point, a binding, or a directive.
fn is_root(item: &str) -> bool {
    let attributes = ["@compute", "@vertex", "@fragment", "@group"];
    attributes
        .iter()
        .any(|attribute| item.starts_with(attribute))
        || declared_name(item).is_none()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "enable f16;
struct Used { a: u32, }
struct Unused { b: Used, }
const SIDE: u32 = 4u;
const NOBODY: u32 = SIDE;
var<private> kept: array<Used, 4>;
var<workgroup> lost: array<u32, SIDE>;
@group(0) @binding(0) var<storage, read> bound: array<Bound>;
struct Bound { c: u32, }
fn inner(x: u32) -> u32 { if x > 0u { return x; } return SIDE; }
fn outer() -> u32 { return inner(kept[0].a); }
fn nobody() -> u32 { return outer(); }
@compute @workgroup_size(64)
fn main() { let y = outer(); }
";

    #[test]
    fn what_nobody_names_is_left_out() {
        let text = reached(TEXT);
        let kept = [
            "enable f16",
            "struct Used",
            "SIDE: u32",
            " kept:",
            " bound:",
            "struct Bound",
            "fn inner",
            "fn main",
        ];
        for name in kept {
            assert_eq!(text.matches(name).count(), 1, "{name} in {text}");
        }
        for name in ["Unused", "NOBODY", "lost", "nobody"] {
            assert!(!text.contains(name), "{name} in {text}");
        }
        assert_eq!(reached(&text), text, "all that is left is reached");
    }

    #[test]
    fn names_are_those_of_declarations() {
        let declared = [
            (
                "@group(0) @binding(3) var<storage, read_write> sums: array<u32>;",
                Some("sums"),
            ),
            (
                "@group(0) @binding(3) var ink: texture_2d<u32>;",
                Some("ink"),
            ),
            (
                "var<workgroup> shared_sums: array<u32, 64>;",
                Some("shared_sums"),
            ),
            (
                "@compute @workgroup_size(WG)\nfn main(@builtin(workgroup_id) wid: vec3<u32>) {}",
                Some("main"),
            ),
            ("const N: u32 = 3u;", Some("N")),
            ("diagnostic(off, derivative_uniformity);", None),
        ];
        for (item, name) in declared {
            assert_eq!(declared_name(item), name, "{item}");
        }
    }
}
