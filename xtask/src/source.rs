//! Rust source as lines of text.

use std::ops::Range;
use std::path::{Path, PathBuf};

use anyhow::Result;

/// A source file, of a crate or a shader.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Its path below the folder that was read.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
}

/// Every `.rs` file below `folder`, in order of path; build output is passed over.
pub fn rust_files(folder: &Path) -> Result<Vec<SourceFile>> {
    files_of(folder, "rs")
}

/// Every file below `folder` whose name ends in `extension`, in order of path; build output is passed over.
pub fn files_of(folder: &Path, extension: &str) -> Result<Vec<SourceFile>> {
    let mut waiting = vec![folder.to_path_buf()];
    let mut files = Vec::new();
    while let Some(place) = waiting.pop() {
        for entry in std::fs::read_dir(&place)? {
            let path = entry?.path();
            if path.is_dir() {
                waiting.extend((!path.ends_with("target")).then_some(path));
            } else if path.extension().is_some_and(|own| own == extension) {
                let text = std::fs::read_to_string(&path)?;
                files.push(SourceFile {
                    path: path.strip_prefix(folder)?.to_path_buf(),
                    text,
                });
            }
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

impl SourceFile {
    /// Whether the file holds a test function `name`, plain or inside `proptest!`.
    pub fn has_test(&self, name: &str) -> bool {
        let lines: Vec<&str> = self.text.lines().map(str::trim).collect();
        let declares = |line: &str| {
            let rest = line
                .strip_prefix("fn ")
                .and_then(|rest| rest.strip_prefix(name));
            rest.is_some_and(|rest| rest.trim_start().starts_with(['(', '<']))
        };
        (0..lines.len()).any(|i| declares(lines[i]) && is_marked_as_test(&lines[..i]))
    }

    /// Whether the file is, or declares, a module `name`.
    pub fn knows_module(&self, name: &str) -> bool {
        let stem = self.path.with_extension("");
        let in_path = stem.components().any(|part| part.as_os_str() == name);
        let declared = [format!("mod {name} {{"), format!("mod {name};")];
        in_path || declared.iter().any(|text| self.text.contains(text))
    }
}

/// A function with its attributes' verdict and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// From its name to its last brace.
    pub text: String,
    /// The same without comments and literals.
    pub code: String,
    /// Whether it is marked as a test.
    pub is_test: bool,
    /// Whether it draws its cases by chance, inside of `proptest!`.
    pub is_property: bool,
}

impl SourceFile {
    /// Every function with a body, in order.
    pub fn functions(&self) -> Vec<Function> {
        // Blank out comments and texts.
        let code = code_of(&self.text);
        let drawn = insides(&code, "proptest! {", ['{', '}']);
        let functions = starts(&code, "fn ").filter_map(|start| {
            // Find the name, and the body behind the arguments.
            let rest = &code[start + 3..];
            let name_length = rest.find(|c: char| !is_word(c))?;
            let arguments = start + 3 + rest.find('(')? + 1;
            let behind = inside(&code, arguments, ['(', ')']).end;
            let opening = behind + code[behind..].find(['{', ';'])?;
            if !code[opening..].starts_with('{') {
                return None;
            }
            let body = inside(&code, opening + 1, ['{', '}']);

            // Tell tests by the attributes above, and properties by the macro around.
            let line = self.text[..start].rfind('\n').map_or(0, |end| end + 1);
            let above: Vec<&str> = self.text[..line].lines().map(str::trim).collect();
            let is_test = is_marked_as_test(&above);
            Some(Function {
                name: rest[..name_length].to_owned(),
                text: self.text[start..body.end].to_owned(),
                code: code[start..body.end].to_owned(),
                is_test,
                is_property: is_test && drawn.iter().any(|inside| inside.contains(&start)),
            })
        });
        functions.collect()
    }
}

/// Source with blanks in place of comments and literals, as long as it was.
pub fn code_of(source: &str) -> String {
    let mut code = source.as_bytes().to_vec();
    let mut at = 0;
    while let Some(rest) = source.get(at..).filter(|rest| !rest.is_empty()) {
        let before = source[..at].chars().next_back();
        let (length, is_blank) = match text_length(rest, before) {
            Some(length) => (length, true),
            None => (rest.chars().next().map_or(1, char::len_utf8), false),
        };
        let end = (at + length).min(code.len());
        if is_blank {
            let bytes = code[at..end].iter_mut();
            bytes
                .filter(|byte| **byte != b'\n')
                .for_each(|byte| *byte = b' ');
        }
        at = end;
    }
    String::from_utf8_lossy(&code).into_owned()
}

/// Bytes of the comment or literal that `rest` opens with, if it does.
fn text_length(rest: &str, before: Option<char>) -> Option<usize> {
    let until = |opening: usize, closing: &str| {
        let end = rest[opening..].find(closing);
        end.map_or(rest.len(), |end| opening + end + closing.len())
    };
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    if rest.starts_with("/*") {
        return Some(until(2, "*/"));
    }
    let hashes = rest
        .strip_prefix('r')
        .map(|rest| rest.len() - rest.trim_start_matches('#').len());
    if let Some(hashes) = hashes
        && rest[1 + hashes..].starts_with('"')
        && !before.is_some_and(|c| is_word(c) && c != 'b')
    {
        return Some(until(2 + hashes, &format!("\"{}", "#".repeat(hashes))));
    }
    let mut letters = rest.char_indices();
    match letters.next()?.1 {
        '"' => {
            let mut is_escaped = false;
            let end = letters.find(|(_, c)| {
                let ends = *c == '"' && !is_escaped;
                is_escaped = *c == '\\' && !is_escaped;
                ends
            });
            Some(end.map_or(rest.len(), |(at, _)| at + 1))
        }
        // A quote opens a character where one closes behind it, else a lifetime.
        '\'' => match (letters.next()?.1, letters.next()) {
            ('\\', Some((at, _))) => Some(at + 1 + rest[at + 1..].find('\'')? + 1),
            (_, Some((at, '\''))) => Some(at + 1),
            _ => None,
        },
        _ => None,
    }
}

/// Where `name` begins in code as a word of its own.
pub fn starts<'a>(code: &'a str, name: &'a str) -> impl Iterator<Item = usize> + 'a {
    let places = code.match_indices(name).map(|(start, _)| start);
    places.filter(move |&start| !(name.starts_with(is_word) && code[..start].ends_with(is_word)))
}

/// What stands between the brackets of every place that `opening` begins, whose end is the opening bracket.
pub fn insides(code: &str, opening: &str, brackets: [char; 2]) -> Vec<Range<usize>> {
    let inside = |start: usize| inside(code, start + opening.len(), brackets);
    starts(code, opening).map(inside).collect()
}

/// From behind an opening bracket to the closing one.
fn inside(code: &str, from: usize, [open, close]: [char; 2]) -> Range<usize> {
    let mut depth = 1;
    let end = code[from..].find(|c| {
        depth += i32::from(c == open) - i32::from(c == close);
        depth == 0
    });
    from..end.map_or(code.len(), |end| from + end)
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether the attributes and comments right above a function, the end of `lines`, hold `#[test]`.
fn is_marked_as_test(lines: &[&str]) -> bool {
    let above = lines.iter().rev();
    above
        .take_while(|line| line.starts_with(['#', '/']))
        .any(|line| line.starts_with("#[test]"))
}

/// A file made up by tests, here and in the other checks.
#[cfg(test)]
pub fn file(path: &str, text: &str) -> SourceFile {
    SourceFile {
        path: path.into(),
        text: text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_marked_functions_are_tests() {
        let text =
            "fn helper() {}\n#[test]\n/// Why.\nfn works() {}\n#[test]\nfn works_too<T>() {}";
        let file = file("src/lib.rs", text);
        assert!(file.has_test("works") && file.has_test("works_too"));
        assert!(!file.has_test("helper") && !file.has_test("work"));
    }

    #[test]
    fn functions_are_told_from_words_about_them() {
        let text = "fn a(f: impl Fn(u8) -> u8) -> u8 { f(b'{') } // fn not_this() {}\n\
                    trait T { fn open(&self); }\n\
                    const S: &str = r#\"fn \"nor\" this() {\"#;\n\
                    proptest! {\n    #[test]\n    fn drawn(x in 0..4) { if x > 1 { b(\"}\"); } }\n}\n\
                    #[test]\nfn plain<'a>() { let _: &'a str = \"\\\"\"; }\n";
        let functions = file("src/lib.rs", text).functions();
        let told: Vec<_> = functions
            .iter()
            .map(|f| (f.name.as_str(), f.is_test, f.is_property))
            .collect();
        let wanted = [
            ("a", false, false),
            ("drawn", true, true),
            ("plain", true, false),
        ];
        assert_eq!(told, wanted);
        assert!(functions[1].text.contains("b(\"}\")") && functions[1].code.ends_with("} "));
        assert_eq!(code_of(text).len(), text.len());
    }

    #[test]
    fn modules_come_from_paths_and_declarations() {
        let file = file("src/passes/vector.rs", "mod tests {\n}");
        assert!(file.knows_module("passes") && file.knows_module("vector"));
        assert!(file.knows_module("tests") && !file.knows_module("rank"));
    }
}
