//! Measures how still strokes lie while cameras and figures move, or with `--ink` how still the ink of hatching and
//! brushes does, and prints tables in Markdown.
//!
//! Run by `cargo xtask measure motion`, once for each, and `cargo xtask measure ink`, which keep what is printed. A
//! measuring program, not a test: it fails only where loading or drawing fails.

mod arguments;
mod ink;
mod ink_report;
mod measured;
mod picture;
mod published;
mod report;
mod subject;
mod words;

use std::error::Error;

use npr_benches::motion::film::Film;

use measured::{Measured, measured};
use subject::Subject;

/// What may fail.
type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    // Measure ink, where that is asked for.
    let arguments = arguments::parse(std::env::args().skip(1))?;
    if arguments.is_of_ink {
        let rows = ink::measured(&arguments)?;
        ink_report::heading();
        ink_report::tables(&rows);
        return Ok(());
    }

    // Else measure the sequences that are asked for.
    let mut rows: Vec<Measured> = Vec::new();
    for file in subject::names() {
        let path = file.map(|(file, clip)| (arguments.models.join(file), clip));
        let name = file.map_or("bumpy_ball", |(file, _)| file);
        let films = Film::ALL.into_iter();
        let mut films = films
            .filter(|film| arguments.takes(name, film.name()))
            .peekable();
        if films.peek().is_none() {
            continue;
        }
        if let Some((path, _)) = &path
            && !path.is_file()
        {
            eprintln!("left out: there is no {}", path.display());
            continue;
        }
        let mut subject = Subject::new(path.as_ref().map(|(path, clip)| (path.as_path(), *clip)))?;
        for film in films
            .filter(|film| subject.plays(*film))
            .collect::<Vec<_>>()
        {
            eprintln!("{} {}", subject.name, film.name());
            let frames = subject.frame_count(film).min(arguments.frames_most);
            let pictures = arguments.pictures.as_deref();
            for is_held in [false, true] {
                if arguments.takes_rows(is_held) {
                    rows.push(measured(&mut subject, (film, is_held), frames, pictures)?);
                }
            }
        }
    }

    // Say what came of it.
    report::heading();
    report::sequences(&rows);
    report::verdict(&rows);
    published::table();
    report::causes(&rows);
    Ok(())
}
