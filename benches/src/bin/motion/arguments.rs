//! What the command line says.

use std::path::PathBuf;

use npr_benches::lines::subjects::shared_models;

use crate::Outcome;

/// How the program is called.
const USAGE: &str = "\
usage: motion [--ink] [--models DIR] [--only NAME] [--rows raw|held] [--quick] [--pictures DIR]

  --ink           the ink of hatching and brushes, in place of strokes
  --models DIR    folder of the shared models
  --only NAME     only models, sequences, or looks of ink, whose name holds NAME; may be given more than once
  --rows ROWS     only raw strokes, or only those that hold from frame to frame
  --quick         twelve frames of each sequence at most
  --pictures DIR  writes an SVG for the largest event of every cause: a frame, the next, and its raw lines;
                  of ink a PNG of the worst pair of frames of every row";

/// What the user asked for.
#[derive(Debug, Clone)]
pub struct Arguments {
    /// Whether ink is measured in place of strokes.
    pub is_of_ink: bool,
    /// Folder of the shared models.
    pub models: PathBuf,
    /// Parts of the names to measure.
    only: Vec<String>,
    /// The rows that are asked for: with strokes that hold, and without; all where nothing is said.
    held: Option<bool>,
    /// Most frames of a sequence.
    pub frames_most: usize,
    /// Folder for pictures of causes.
    pub pictures: Option<PathBuf>,
}

impl Arguments {
    /// Whether a sequence of a model is asked for.
    pub fn takes(&self, model: &str, film: &str) -> bool {
        let holds = |part: &String| model.contains(part.as_str()) || film.contains(part.as_str());
        self.only.iter().all(holds)
    }

    /// Whether rows are asked for whose strokes hold, or do not.
    pub fn takes_rows(&self, is_held: bool) -> bool {
        self.held.is_none_or(|held| held == is_held)
    }
}

/// Reads the arguments.
///
/// # Errors
///
/// How the program is called, where they are not understood.
pub fn parse(words: impl Iterator<Item = String>) -> Outcome<Arguments> {
    let mut arguments = Arguments {
        is_of_ink: false,
        models: shared_models(),
        only: Vec::new(),
        held: None,
        frames_most: usize::MAX,
        pictures: None,
    };
    let mut words = words;
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(USAGE);
        match word.as_str() {
            "--ink" => arguments.is_of_ink = true,
            "--models" => arguments.models = value()?.into(),
            "--only" => arguments.only.push(value()?),
            "--rows" => {
                arguments.held = match value()?.as_str() {
                    "raw" => Some(false),
                    "held" => Some(true),
                    _ => return Err(USAGE.into()),
                }
            }
            "--quick" => arguments.frames_most = 12,
            "--pictures" => arguments.pictures = Some(value()?.into()),
            _ => return Err(USAGE.into()),
        }
    }
    Ok(arguments)
}
