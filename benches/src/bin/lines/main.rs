//! Measures line drawings against the reference and prints tables in Markdown.
//!
//! Run by `cargo xtask measure lines`, which keeps what is printed. A measuring program, not a test: it fails only
//! where loading or drawing fails.

mod agreement;
mod arguments;
mod counts;
mod determinism;
mod growth;
mod known;
mod pilot;
mod preparation;
mod sights;
mod way;

use std::error::Error;

use npr_benches::lines::subjects::SIZE;
use npr_benches::machine;

use arguments::Arguments;

/// What may fail.
type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let arguments = arguments::parse(std::env::args().skip(1))?;
    match (&arguments.strokes, &arguments.model) {
        (None, None) if arguments.pilot => pilot::pilot(&arguments),
        (None, None) if arguments.sights => sights::sights(&arguments),
        (Some(strokes), Some(model)) => agreement::judge(&arguments, strokes, model),
        (None, None) => report(&arguments),
        _ => Err(arguments::USAGE.into()),
    }
}

fn report(arguments: &Arguments) -> Outcome<()> {
    // Say what was measured, and where.
    println!("# Line drawings\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!(
        "- frame {}x{}; contours, boundaries and creases over 45.57 degrees",
        SIZE[0], SIZE[1]
    );
    println!(
        "- reference: every half pixel of every candidate edge of the polygons, seen by a ray of its own in double \
         precision\n"
    );

    // Measure what is drawn.
    agreement::agreement(arguments)?;
    counts::edge_counts(arguments)?;
    known::known_outlines(arguments)?;

    // Measure what holds for all subjects.
    if arguments.only.is_none() {
        preparation::preparation(arguments)?;
        determinism::determinism(arguments)?;
        growth::scaling(arguments)?;
    }
    Ok(())
}
