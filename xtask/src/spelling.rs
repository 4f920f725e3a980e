//! A test that finds misspelt words in every text of the project: code, comments, shaders, documents, style files.

use std::path::Path;

use typos::tokens::{Case, Identifier, Tokenizer, Word};
use typos::{Dictionary, Status, check_str};

use crate::names::files;
use crate::root;

/// Words that the dictionary takes for misspelt others, and that are right here.
const RIGHT: &str = "caf heigh loca lod metalness mis shepperd tru";

/// Words that tests misspell on purpose.
const WRONG_ON_PURPOSE: &str = "patern puplished tecnical widht";

/// Endings of files whose text somebody wrote.
const WRITTEN: [&str; 6] = ["rs", "wgsl", "md", "toml", "html", "css"];

/// The common misspellings of English.
struct Misspellings;

impl Dictionary for Misspellings {
    fn correct_ident<'s>(&'s self, _: Identifier<'_>) -> Option<Status<'s>> {
        None
    }

    fn correct_word<'s>(&'s self, word: Word<'_>) -> Option<Status<'s>> {
        let lower = word.token().to_lowercase();
        let known =
            [RIGHT, WRONG_ON_PURPOSE].map(|words| words.split(' ').any(|word| word == lower));
        let is_name = word.case() == Case::None || known.contains(&true);
        let corrections = typos_dict::WORD
            .find(&lower.as_str().into())
            .filter(|_| !is_name)?;
        Some(Status::Corrections(
            corrections.iter().map(|word| (*word).into()).collect(),
        ))
    }
}

/// The misspelt words of a text, with their lines and what they may stand for.
fn misspelt(file: &Path, text: &str) -> Vec<String> {
    let tokenizer = Tokenizer::new();
    let lines = text.lines().enumerate();
    let faults = lines.flat_map(|(number, line)| {
        let typos: Vec<_> = check_str(line, &tokenizer, &Misspellings).collect();
        typos
            .into_iter()
            .map(move |typo| (number + 1, typo.typo.into_owned(), typo.corrections))
    });
    faults
        .map(|(number, word, corrections)| {
            format!("{}:{number}: {word}: {corrections:?}", file.display())
        })
        .collect()
}

#[test]
fn words_are_spelt_as_in_the_dictionary() {
    let root = root();
    let written = |file: &Path| {
        let ending = file.extension().and_then(|ending| ending.to_str());
        ending.is_some_and(|ending| WRITTEN.contains(&ending))
    };
    let mut faults = Vec::new();
    for file in files(&root).expect("git lists the files") {
        if written(&file) {
            let text = std::fs::read_to_string(root.join(&file)).expect("text");
            faults.extend(misspelt(&file, &text));
        }
    }
    assert!(
        faults.is_empty(),
        "misspelt words:\n  {}",
        faults.join("\n  ")
    );
}

#[test]
fn a_misspelt_word_is_found() {
    let (comment, name) = (
        ["/// Recie", "ve it."].concat(),
        ["let occu", "red_at = 1;"].concat(),
    );
    let file = Path::new("a.rs");
    assert_eq!(misspelt(file, &comment).len(), 1);
    assert_eq!(misspelt(file, &name).len(), 1);
    assert!(misspelt(file, "/// Receive its colour, color_of and grey.").is_empty());
}
