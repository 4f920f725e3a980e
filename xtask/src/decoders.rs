//! `cargo xtask decoders`: decoders that others wrote are called behind one door, and a panic inside can be caught.

use std::ffi::OsStr;
use std::path::Path;

use anyhow::{Context, Result, bail};

use crate::packages::members;
use crate::source::{SourceFile, code_of, insides, rust_files, starts};

/// The door, `npr_core::decoding::guard`, as calls of it begin.
const DOOR: &str = "guard(";

/// How calls of decoders begin that others wrote: pictures, packed bytes, texts, fonts.
const CALLS: [&str; 24] = [
    "ImageReader::new(",
    "ImageReader::open(",
    ".into_decoder()",
    "from_decoder(",
    "image::load(",
    "image::load_from_memory(",
    "image::load_from_memory_with_format(",
    "image::open(",
    "png::Decoder::new(",
    "decompress_into(",
    "decompress_slice_iter_to_slice(",
    "decompress_to_vec",
    "StreamingDecoder::new(",
    "FrameDecoder::new(",
    "serde_json::from_",
    "toml::from_",
    ".parse::<Table>()",
    ".parse::<Value>()",
    "DeTable::parse(",
    "BASE64.decode(",
    "parse_color(",
    "harfrust::Font::new(",
    "shape(&shaper",
    "glyph.draw(",
];

/// Programs of the project's own, which read what the project wrote.
const SUITES: [&str; 3] = ["npr-benches", "npr-tests", "xtask"];

/// Fails with every call of a decoder outside of the door, and with profiles that cannot unwind.
pub fn check(root: &Path) -> Result<()> {
    // Look at the profiles.
    let mut faults = profile_faults(&std::fs::read_to_string(root.join("Cargo.toml"))?)?;

    // Look at the calls of every crate that is not a suite.
    let mut call_count = 0;
    let packages = members(root)?;
    for package in packages
        .iter()
        .filter(|p| !SUITES.contains(&p.name.as_str()))
    {
        for file in rust_files(&package.folder().join("src"))? {
            let (calls, outside) = calls(&file);
            call_count += calls;
            let place = |line| format!("{}: src/{}:{line}", package.name, file.path.display());
            faults.extend(outside.into_iter().map(place));
        }
    }

    // Tell what was found.
    if !faults.is_empty() {
        bail!(
            "decoders are called outside of npr_core::decoding::guard:\n  {}",
            faults.join("\n  ")
        );
    }
    println!("decoders: {call_count} calls stand behind the door");
    Ok(())
}

/// How many calls of decoders a file has outside of its tests, and the lines of those that stand outside of the door.
fn calls(file: &SourceFile) -> (usize, Vec<usize>) {
    // Leave tests out.
    let for_tests = |part: &OsStr| {
        ["testing", "tests"]
            .iter()
            .any(|name| part.to_string_lossy().starts_with(name))
    };
    if file.path.iter().any(for_tests) {
        return (0, Vec::new());
    }

    // Find the calls, and the insides of the door.
    let program = file.text.split("#[cfg(test)]\nmod tests").next();
    let code = code_of(program.unwrap_or_default());
    let doors = insides(&code, DOOR, ['(', ')']);
    let starts: Vec<usize> = CALLS
        .iter()
        .flat_map(|call| calls_of(&code, call))
        .collect();

    // Count the calls that stand outside.
    let outside = starts
        .iter()
        .filter(|start| !doors.iter().any(|door| door.contains(start)));
    let line = |start: &usize| code[..*start].matches('\n').count() + 1;
    (starts.len(), outside.map(line).collect())
}

/// Where calls begin that `call` opens, functions of that name left out.
fn calls_of<'a>(code: &'a str, call: &'a str) -> impl Iterator<Item = usize> + 'a {
    starts(code, call).filter(|&start| !code[..start].ends_with("fn "))
}

/// Profiles with which a panic ends the program, door or not.
fn profile_faults(manifest: &str) -> Result<Vec<String>> {
    let manifest: toml::Table = manifest.parse().context("Cargo.toml")?;
    let profiles = manifest.get("profile").and_then(toml::Value::as_table);
    let aborts = |(name, profile): (&String, &toml::Value)| {
        let how = profile.get("panic")?.as_str()?;
        (how != "unwind").then(|| format!("profile {name} has panic = \"{how}\""))
    };
    Ok(profiles.into_iter().flatten().filter_map(aborts).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::file;

    #[test]
    fn a_call_outside_of_the_door_is_found_by_its_line() {
        let text = "fn a() {\n    let r = guard(|| {\n        png::Decoder::new(f(x)) // )\n    });\n\
                    \n    image::open(path)\n}\n";
        assert_eq!(calls(&file("picture.rs", text)), (2, vec![6]));
        assert_eq!(calls(&file("testing.rs", text)).0, 0);
        let tested = format!("fn a() {{}}\n#[cfg(test)]\nmod tests {{\n{text}}}\n");
        assert_eq!(calls(&file("picture.rs", &tested)).0, 0);
    }

    #[test]
    fn words_about_calls_are_no_calls() {
        let text = concat!(
            "//! See image::open(x).\n",
            "fn from_str(s: &str) { say(\"DeTable::parse(x)\"); f('\"') } // image::open(x)\n",
        );
        assert_eq!(calls(&file("words.rs", text)), (0, vec![]));
        // A bracket in quotes does not close the door.
        let text = "let x = guard(|| f(\")\") + image::open(p));";
        assert_eq!(calls(&file("words.rs", text)), (1, vec![]));
    }

    #[test]
    fn profiles_must_unwind() {
        let faults = |text| profile_faults(text).unwrap().len();
        assert_eq!(faults("[profile.release]\nopt-level = 3\n"), 0);
        assert_eq!(faults("[profile.release]\npanic = \"abort\"\n"), 1);
        assert_eq!(faults("[profile.dev]\npanic = \"unwind\"\n"), 0);
    }
}
