//! Names from files, made fit for one line of a message.

/// Longest name shown in full, in characters.
const SHOWN_LENGTH: usize = 60;

/// `name` with control and direction-changing characters escaped, cut to a readable length.
pub(crate) fn shown(name: &str) -> String {
    let mut text = String::new();
    for character in name.chars().take(SHOWN_LENGTH) {
        if character.is_control() || is_direction_mark(character) {
            text.extend(character.escape_unicode());
        } else {
            text.push(character);
        }
    }
    if name.chars().nth(SHOWN_LENGTH).is_some() {
        text.push('…');
    }
    text
}

/// Characters that reorder the text around them, or break the line.
fn is_direction_mark(character: char) -> bool {
    matches!(character, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_and_direction_characters_are_escaped() {
        assert_eq!(shown("a\nb\u{202e}c"), "a\\u{a}b\\u{202e}c");
    }

    #[test]
    fn a_long_name_is_cut() {
        assert_eq!(
            shown(&"x".repeat(100_000)).chars().count(),
            SHOWN_LENGTH + 1
        );
        assert_eq!(shown("絵"), "絵");
    }
}
