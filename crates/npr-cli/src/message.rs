//! Messages on standard error, and the escaping of names in them.

use crate::fault::Fault;
use clap::error::ErrorKind;
use std::io::Write;
use std::path::Path;

/// Longest line on standard error, in characters.
const LINE_LENGTH: usize = 299;

/// Longest name within a line, in characters.
const NAME_LENGTH: usize = 120;

/// Prints the error that ends a run.
pub fn fault(fault: &Fault) {
    write_line(&format!("npr: {}", fault.message));
}

/// Prints a warning, unless `quiet`.
pub fn warn(quiet: bool, text: &str) {
    if !quiet {
        write_line(&format!("npr: warning: {text}"));
    }
}

/// Prints a list of warnings in order, unless `quiet`.
pub fn warn_all<T: AsRef<str>>(quiet: bool, texts: impl IntoIterator<Item = T>) {
    for text in texts {
        warn(quiet, text.as_ref());
    }
}

/// Writes one line. A closed standard error is ignored.
fn write_line(text: &str) {
    let line = cut(&plain(text), LINE_LENGTH);
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// A path in quotes, for messages. Only the end of a long path is kept.
pub fn quoted(path: &Path) -> String {
    let text = plain(&path.to_string_lossy());
    let length = text.chars().count();
    if length <= NAME_LENGTH {
        return format!("'{text}'");
    }
    let end: String = text.chars().skip(length - NAME_LENGTH).collect();
    format!("'…{end}'")
}

/// `text` with control characters, and those that reorder the text around them, escaped.
pub fn plain(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() || reorders(character) {
            line.extend(character.escape_unicode());
        } else {
            line.push(character);
        }
    }
    line
}

/// A name from a file, escaped and shortened for a line of text.
pub fn name(text: &str) -> String {
    cut(&plain(text), NAME_LENGTH)
}

/// Whether a character is a direction mark or a line separator of Unicode.
fn reorders(character: char) -> bool {
    matches!(
        character,
        '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    )
}

fn cut(text: &str, length: usize) -> String {
    if text.chars().count() <= length {
        return text.to_owned();
    }
    let mut start: String = text.chars().take(length - 1).collect();
    start.push('…');
    start
}

/// The message about a wrong command line, in one line. clap spreads it over several and adds the usage.
pub fn of_usage(error: &clap::Error) -> String {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        return "no command is given; npr --help lists them".to_owned();
    }

    // Keep the lines that say what is wrong.
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let of_interest = lines.take_while(|line| {
        !line.starts_with("Usage:") && !line.starts_with("For more information")
    });

    // Join them into one.
    let mut joined = String::new();
    for line in of_interest {
        let between = match joined.chars().last() {
            None => "",
            Some(':') => " ",
            Some(_) => "; ",
        };
        joined.push_str(between);
        joined.push_str(
            line.trim_start_matches("error: ")
                .trim_start_matches("tip: "),
        );
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_and_direction_characters_are_escaped() {
        assert_eq!(
            plain("a\x1b[2J\nb\u{202e}c"),
            "a\\u{1b}[2J\\u{a}b\\u{202e}c"
        );
    }

    #[test]
    fn a_long_path_keeps_its_end() {
        let path = format!("{}/hero.glb", "x".repeat(5000));
        let shown = quoted(Path::new(&path));
        assert!(shown.ends_with("/hero.glb'"));
        assert_eq!(shown.chars().count(), NAME_LENGTH + 3);
    }

    #[test]
    fn a_usage_error_becomes_one_line_with_its_tip() {
        let error = crate::command()
            .try_get_matches_from(["npr", "render", "a.glb", "--stile", "ink"])
            .expect_err("no such option");
        let text = of_usage(&error);
        assert!(
            text.starts_with("unexpected argument '--stile' found; "),
            "{text}"
        );
        assert!(text.contains("'--style'") && !text.contains('\n'), "{text}");
    }

    #[test]
    fn a_missing_argument_is_named_in_the_same_line() {
        let error = crate::command()
            .try_get_matches_from(["npr", "info"])
            .expect_err("no file");
        let text = of_usage(&error);
        assert_eq!(
            text,
            "the following required arguments were not provided: <FILE>"
        );
    }
}
