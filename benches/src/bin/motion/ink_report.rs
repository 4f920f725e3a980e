//! What the tables of ink say.

use npr_benches::machine;
use npr_benches::motion::film::Film;
use npr_benches::motion::ink::{InkTally, NEAR_PX, STEP};
use npr_benches::motion::inked::{EDGE_PX, Medium};
use npr_benches::table::Table;
use npr_benches::timing::median;

use crate::ink::{FILMS, InkRow, LATER, LOOKS, SIZE};

/// Says what was measured, and where.
pub fn heading() {
    let [turned, panned, played, still] = FILMS.map(|(_, frames)| frames);
    println!("# Ink that moves\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!(
        "- presets at {}x{}, by the processor, with the light fixed to the scene; strokes hold from frame to frame",
        SIZE[0], SIZE[1]
    );
    println!(
        "- cameras and sequences are those of [lines that move](motion.md): S1 turn, {turned} frames half a degree \
         apart; S3 pan by half a pixel a frame, {panned}; S4 the fox runs, {played}; S5 nothing moves, {still}\n"
    );
    println!(
        "Every pixel is carried to the next frame by the surface, and every pixel of that one back. It is \
         **compared** where the other frame shows the same place, and the same ink is due there: of hatching the light \
         on the surface is the same within 3 of 255, and no edge of an object lies within {EDGE_PX} px; of brushes a \
         plain pen puts the same ink there, within a tenth. The rest has a cause: it comes into view, the light \
         explains it, or lines move ([how those hold](motion.md)). Of the ink that can be compared:\n\n\
         - **differs**: the tone at its own place is another by more than {STEP} of full ink, or half of its \
         own, softened by a pixel\n\
         - **gone**: nothing within {NEAR_PX} px of its place in the next frame has half as much ink; **new**: the \
         same backwards\n\
         - **slides**: how far squares of 24 px of ink have to move to match, median\n\
         - **moves**: how far the surface itself moves in the picture, median; ink that stays on the screen slides as \
         far\n\
         - **later differs**, **later gone**: the same of frames {LATER} apart, for what slides by less than a stroke \
         from one to the next\n\n\
         Rows with smooth paper have `grain = 0`: the hills of the paper lie still in the picture, whatever moves \
         behind it. Wide rows have strokes as many pixels apart as a frame twice as high.\n"
    );
}

/// Tables of hatching and of brushes for every sequence.
pub fn tables(rows: &[InkRow]) {
    for (film, _) in FILMS {
        let rows: Vec<&InkRow> = rows.iter().filter(|row| row.film == film).collect();
        if rows.is_empty() {
            continue;
        }
        println!("## {}\n", film.name());
        if film == Film::Still {
            let still = rows.iter().filter(|row| row.tally.is_still()).count();
            println!("{still} of {} are still to the bit.\n", rows.len());
            continue;
        }
        for (medium, what) in [(Medium::Hatching, "hatching"), (Medium::Brush, "brush")] {
            let mut table = Table::new(head(what));
            let of_medium: Vec<&InkRow> = rows
                .iter()
                .filter(|row| row.look.medium == medium)
                .copied()
                .collect();
            for look in LOOKS.iter().filter(|look| look.medium == medium) {
                let of_look = of_medium.iter().filter(|row| row.look.name == look.name);
                for row in of_look {
                    table.add(look.name, cells(&row.model, [&row.tally, &row.later]));
                }
            }
            if !of_medium.is_empty() {
                println!("{table}");
            }
        }
    }
}

fn head(what: &str) -> [&str; 11] {
    [
        what,
        "model",
        "compared, %",
        "ink, %",
        "differs, %",
        "gone, %",
        "new, %",
        "slides, px",
        "moves, px",
        "later differs, %",
        "later gone, %",
    ]
}

fn cells(model: &str, [tally, later]: [&InkTally; 2]) -> [String; 10] {
    let percent = |share: f64| format!("{:.2}", 100.0 * share);
    let [gone, new] = tally.jumping_shares();
    let slides = match tally.slides.is_empty() {
        true => String::new(),
        false => format!("{:.2}", median(tally.slides.clone())),
    };
    [
        model.to_owned(),
        format!("{:.1}", 100.0 * tally.compared_share()),
        format!("{:.1}", 100.0 * tally.inked_share()),
        percent(tally.differing_share()),
        percent(gone),
        percent(new),
        slides,
        format!("{:.2}", median(tally.moves.clone())),
        percent(later.differing_share()),
        percent(later.jumping_shares()[0]),
    ]
}
