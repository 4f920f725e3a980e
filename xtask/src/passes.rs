//! `cargo xtask passes`: the list of passes, from their declarations and the heads of their shaders.

use std::path::Path;

use anyhow::{Context, Result, ensure};

use crate::file::write_whole;
use crate::source::{SourceFile, files_of, rust_files};

/// Where the list is written.
const LIST: &str = "docs/passes.md";

/// Where passes are declared.
const DECLARATIONS: &str = "crates/npr-gpu/src/passes";

/// Widest line of the list, in characters.
const MOST_COLUMNS: usize = 120;

/// What stands above the list.
const HEAD: &str = "\
# Passes

A pass is one shader, one declaration in `crates/npr-gpu/src/passes/`, one twin on the processor. The shader of
`line.detect` is `shaders/line/detect.wgsl`, and so on. `cargo xtask passes` writes this list from the declarations.
\"0.1 % of texels\" means: no more texels than that may differ by more than 2 of 255.
";

/// A pass as it is declared.
#[derive(Debug, PartialEq, Eq)]
struct Declaration {
    name: String,
    /// What it does, from its doc comment.
    purpose: String,
    reads: Vec<String>,
    writes: Vec<String>,
    /// What a device may differ by.
    agreement: String,
}

/// Writes the list of passes.
pub fn write(root: &Path) -> Result<()> {
    write_whole(&root.join(LIST), list(root)?.as_bytes())
}

/// Fails where the list is not that of the declarations.
pub fn check(root: &Path) -> Result<()> {
    let text = list(root)?;
    let written = std::fs::read_to_string(root.join(LIST)).unwrap_or_default();
    ensure!(
        written == text,
        "{LIST} is not that of the declarations; run cargo xtask passes"
    );
    println!("passes: {} are listed", text.matches("\n- ").count());
    Ok(())
}

/// The list of all passes.
fn list(root: &Path) -> Result<String> {
    let shaders = files_of(&root.join("shaders"), "wgsl")?;
    let mut text = HEAD.to_owned();
    for file in rust_files(&root.join(DECLARATIONS))? {
        let domain = file.path.with_extension("");
        text += &format!("\n## {}\n\n", domain.display());
        for declared in declarations(&file.text) {
            let twin = twin(&shaders, &declared.name)
                .with_context(|| format!("the shader of {} names no twin", declared.name))?;
            text += &entry(&declared, twin);
        }
    }
    Ok(text)
}

/// The passes that a source declares, in its order.
fn declarations(source: &str) -> Vec<Declaration> {
    let mut found = Vec::new();
    for (start, _) in source.match_indices(": Pass = Pass {") {
        // Cut out the declaration.
        let body = &source[start..];
        let body = &body[..body.find("\n};").unwrap_or(body.len())];
        let Some(name) = quoted_after(body, "name: ") else {
            continue;
        };

        // Read its name, its purpose and its bound.
        let mut declared = Declaration {
            name: name.to_owned(),
            purpose: doc_before(&source[..start]),
            reads: Vec::new(),
            writes: Vec::new(),
            agreement: agreement(body),
        };

        // Tell what it reads from what it writes.
        let slots = body.split_once("slots: &[").map_or("", |(_, rest)| rest);
        let slots = slots
            .split_once("\n    ],")
            .map_or(slots, |(slots, _)| slots);
        for slot in slots.lines().map(str::trim) {
            if let Some(name) = quoted_after(slot, "(") {
                match slot.starts_with("write") || slot.starts_with("update") {
                    true => declared.writes.push(name.to_owned()),
                    false => declared.reads.push(name.to_owned()),
                }
            }
        }
        found.push(declared);
    }
    found
}

/// The text in the first quotes after `before`.
fn quoted_after<'a>(text: &'a str, before: &str) -> Option<&'a str> {
    let rest = text.split_once(before)?.1.strip_prefix('"')?;
    rest.split_once('"').map(|(name, _)| name)
}

/// The doc comment right above the item whose declaration begins in the last line of `text`.
fn doc_before(text: &str) -> String {
    let above: Vec<&str> = text.lines().rev().skip(1).collect();
    let doc = above.iter().map_while(|line| line.strip_prefix("///"));
    let mut lines: Vec<&str> = doc.map(str::trim).collect();
    lines.reverse();
    lines
        .split(|line| line.is_empty())
        .next()
        .unwrap_or_default()
        .join(" ")
}

/// What a device may differ by, in words.
fn agreement(body: &str) -> String {
    // Read the bound and its numbers.
    let value = body.split_once("agreement: Agreement::");
    let value = value.map_or("", |(_, value)| value);
    let number = |name: &str| {
        let rest = value.split_once(name)?.1;
        let end = rest.find([',', ')', ' ', '\n', '}'])?;
        rest[..end].parse::<f64>().ok()
    };

    // Say it in words.
    let percent = |share: f64| format!("{} %", (share * 1e5).round() / 1e3);
    if value.starts_with("Relative") {
        format!("{:e} relative", number("Relative(").unwrap_or_default())
    } else if value.starts_with("Texels") {
        format!(
            "{} of texels",
            percent(number("Texels(").unwrap_or_default())
        )
    } else if value.starts_with("NearlyAll") {
        let bound = number("bound: ").unwrap_or_default();
        let share = percent(number("share: ").unwrap_or_default());
        format!("{bound:e} relative, but for {share} of elements")
    } else {
        "nothing".to_owned()
    }
}

/// The function that the shader of a pass names as its twin.
fn twin<'a>(shaders: &'a [SourceFile], name: &str) -> Option<&'a str> {
    let opening = format!("// {name}:");
    let shader = shaders
        .iter()
        .find(|file| file.text.starts_with(&opening))?;
    let named = shader
        .text
        .lines()
        .find_map(|line| line.strip_prefix("// Twin "));
    named.map(str::trim)
}

/// A pass as an item of the list.
fn entry(pass: &Declaration, twin: &str) -> String {
    // Say what the pass does in one sentence each.
    let text = format!(
        "`{}`: {} Reads {}; writes {}. Twin `{twin}`; a device may differ by {}.",
        pass.name,
        pass.purpose,
        pass.reads.join(", "),
        match pass.writes.is_empty() {
            true => "images".to_owned(),
            false => pass.writes.join(", "),
        },
        pass.agreement,
    );

    // Break the text before the last column.
    let mut lines = String::from("-");
    let mut width = 1;
    for word in text.split_whitespace() {
        let needed = word.chars().count() + 1;
        if width + needed > MOST_COLUMNS {
            lines += "\n ";
            width = 1;
        }
        lines.push(' ');
        lines += word;
        width += needed;
    }
    lines.push('\n');
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "\
/// Marks the pixels that differ from a neighbour.
///
/// More of it.
pub const DETECT: Pass = Pass {
    name: \"line.detect\",
    slots: &[
        uniform::<View>(\"view\"),
        texture(\"ids\", Format::U32),
        write::<u32>(\"mask\"),
    ],
    agreement: Agreement::Texels(0.002),
};
";

    #[test]
    fn a_declaration_is_read_as_it_stands() {
        let expected = Declaration {
            name: "line.detect".to_owned(),
            purpose: "Marks the pixels that differ from a neighbour.".to_owned(),
            reads: vec!["view".to_owned(), "ids".to_owned()],
            writes: vec!["mask".to_owned()],
            agreement: "0.2 % of texels".to_owned(),
        };
        assert_eq!(declarations(SOURCE), [expected]);
    }

    #[test]
    fn bounds_are_told_in_words() {
        let of = |value: &str| agreement(&format!("agreement: Agreement::{value},"));
        assert_eq!(of("Exact"), "nothing");
        assert_eq!(of("Relative(1e-4)"), "1e-4 relative");
        let nearly = of("NearlyAll { share: 0.001, bound: 1e-3, }");
        assert_eq!(nearly, "1e-3 relative, but for 0.1 % of elements");
    }

    #[test]
    fn entries_are_no_wider_than_the_page() {
        let [declared] = &declarations(SOURCE)[..] else {
            panic!("one pass");
        };
        let long = Declaration {
            purpose: "Many words of it. ".repeat(20),
            name: declared.name.clone(),
            reads: declared.reads.clone(),
            writes: declared.writes.clone(),
            agreement: declared.agreement.clone(),
        };
        let text = entry(&long, "npr_vector::screen::detect::detect");
        assert!(text.lines().count() > 2);
        assert!(
            text.lines()
                .all(|line| line.chars().count() <= MOST_COLUMNS)
        );
    }
}
