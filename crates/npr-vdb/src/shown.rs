//! Names of files in messages.

/// Names come from files: they are cut short, and control characters shown as escapes.
pub(crate) fn shown(name: &str) -> String {
    const CHARS: usize = 40;
    let mut text: String = name
        .chars()
        .take(CHARS)
        .flat_map(char::escape_debug)
        .collect();
    if name.chars().nth(CHARS).is_some() {
        text.push_str("...");
    }
    text
}
