//! Every key of the schema acts, or a notice names it, in every way that drawings are made.
//!
//! Keys are those of the JSON Schema, so new ones are covered once they exist. Each gets other legal values, over a
//! base style that switches on what it works with (`enabling.rs`: one line there for a key that needs another). Then,
//! for every output: the bytes change, or `Stated::notices` names the key, or it stands in `EXCEPTIONS` with the
//! reason. And what is said to be idle changes no byte.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "tests fail by panicking"
)]

mod enabling;
mod keys;
mod outputs;
mod scene;

use enabling::{EXCEPTIONS, PLACES, WORDS, base_of, is_meant};
use keys::{Key, keys};
use npr_stylesheet::Stated;
use outputs::Output;
use rayon::prelude::*;
use scene::Studio;

/// What a style with a value of a key gives.
struct Tried {
    value: String,
    bytes: u64,
    /// Whether a notice names the key.
    is_told: bool,
}

/// What is wrong with a key in an output, if anything.
fn fault(studio: &Studio, output: Output, key: &Key) -> Option<String> {
    let base = base_of(&key.path, output);
    let (before, told_before) = tried_with(studio, output, key, &base, None);
    let excuse = EXCEPTIONS
        .iter()
        .find(|(pattern, _)| is_meant(pattern, &key.path));
    let mut seen: Vec<Tried> = Vec::new();
    for value in key.values(base.style()) {
        let mut stated = base.clone();
        if stated.set_all(&[format!("{}={value}", key.path)]).is_err() {
            continue;
        }
        let (bytes, is_told) = tried_with(studio, output, key, &stated, Some(&value));
        if told_before && is_told && bytes != before {
            return Some(format!("said to be idle, but {value} changes the drawing"));
        }
        let is_enough = bytes != before && !key.is_choice();
        seen.push(Tried {
            value,
            bytes,
            is_told,
        });
        if is_enough {
            break;
        }
    }
    let is_here = |(pattern, place, _): &&(&str, &str, &str)| {
        is_meant(pattern, &key.path) && output.name().contains(place)
    };
    if excuse.is_some() || PLACES.iter().any(|place| is_here(&place)) {
        return None;
    }
    if seen.is_empty() {
        return Some("no value of it was legal".to_owned());
    }
    let is_stated = key.is_in(base.style());
    let acts = |tried: &Tried| {
        let differs = tried.bytes != before;
        differs || !is_stated && seen.iter().any(|other| other.bytes != tried.bytes)
    };
    let silent: Vec<&str> = seen
        .iter()
        .filter(|tried| !acts(tried) && !tried.is_told && !is_excused(key, &tried.value))
        .map(|tried| tried.value.as_str())
        .collect();
    let is_fault = match key.is_choice() {
        true => !silent.is_empty(),
        false => silent.len() == seen.len(),
    };
    is_fault.then(|| format!("changes nothing and is not told: {}", silent.join(", ")))
}

/// Whether a word changes no drawing here for a known reason.
fn is_excused(key: &Key, value: &str) -> bool {
    let word = value.trim_matches(['"', '\'']);
    let excused = WORDS
        .iter()
        .find(|(name, excused, _)| *name == key.name() && *excused == word);
    excused.is_some()
}

/// The drawing in a style as a number, and whether a notice names the key.
fn tried_with(
    studio: &Studio,
    output: Output,
    key: &Key,
    stated: &Stated,
    value: Option<&str>,
) -> (u64, bool) {
    let (bytes, notices) = studio.drawn(output, stated);
    let is_named = |notice: &String| notice.contains(key.name());
    let is_told = stated.idle_reason(&key.path, &output.occasion()).is_some()
        || value.is_some() && notices.iter().any(is_named);
    (bytes, is_told)
}

#[test]
fn every_key_acts_or_is_told_in_every_output() {
    let studio = Studio::new();
    let keys = keys();
    assert!(keys.len() > 250, "{} keys", keys.len());
    let cases: Vec<(Output, &Key)> = Output::all()
        .into_iter()
        .flat_map(|output| keys.iter().map(move |key| (output, key)))
        .filter(|(output, key)| output.is_asked(&key.path))
        .collect();
    let mut faults: Vec<String> = cases
        .par_iter()
        .filter_map(|(output, key)| {
            let fault = fault(&studio, *output, key)?;
            Some(format!("{}: {} {fault}", key.path, output.name()))
        })
        .collect();
    faults.sort();
    assert!(
        faults.is_empty(),
        "{} faults in {} cases:\n{}",
        faults.len(),
        cases.len(),
        faults.join("\n")
    );
}
