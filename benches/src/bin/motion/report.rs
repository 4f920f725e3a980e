//! What the tables say.

use std::collections::BTreeMap;

use npr_benches::machine;
use npr_benches::motion::causes::{Count, Counts};
use npr_benches::motion::film::Film;
use npr_benches::motion::tally::{Tally, share};
use npr_benches::table::Table;

use crate::measured::Measured;
use crate::subject::{PRESET, SIZE};
use crate::words;

/// A figure with a bar: its name, the sequences that it counts in, its value, and the most that it may be.
struct Bar {
    name: &'static str,
    films: &'static [Film],
    value: fn(&Tally) -> f64,
    most: f64,
    unit: &'static str,
}

/// The bars.
const BARS: [Bar; 7] = [
    Bar {
        name: "M4 drift, median",
        films: &[Film::Turn, Film::Dolly, Film::Pan, Film::Clip],
        value: Tally::drift,
        most: 1.0,
        unit: "px",
    },
    Bar {
        name: "M4 ends lost",
        films: &[Film::Turn, Film::Dolly, Film::Pan, Film::Clip],
        value: |tally| 100.0 * tally.lost(),
        most: 3.0,
        unit: "%",
    },
    Bar {
        name: "M5 pop",
        films: &[Film::Turn],
        value: |tally| 100.0 * tally.pop(),
        most: 1.0,
        unit: "%",
    },
    Bar {
        name: "M5 pop",
        films: &[Film::Clip],
        value: |tally| 100.0 * tally.pop(),
        most: 2.0,
        unit: "%",
    },
    Bar {
        name: "M6 flicker",
        films: &[Film::Turn, Film::Dolly, Film::Pan, Film::Clip],
        value: |tally| 100.0 * tally.flicker(),
        most: 0.1,
        unit: "%",
    },
    Bar {
        name: "M7 jitter",
        films: &[Film::Pan],
        value: Tally::jitter,
        most: 0.3,
        unit: "px",
    },
    Bar {
        name: "M7 bias",
        films: &[Film::Pan],
        value: |tally| tally.mean_bias().abs(),
        most: 0.5,
        unit: "px",
    },
];

/// Says what was measured, and where.
pub fn heading() {
    println!("# Lines that move\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!(
        "- preset {PRESET} at {}x{}, `line.method = \"strokes\"`: the strokes that frames ink, joined, smoothed, and \
         without doubles and stubs; raw, without anything carried from frame to frame",
        SIZE[0], SIZE[1]
    );
    println!(
        "- the eye stands three radii away, 15 degrees above, vertical field of view 45 degrees\n\
         - S1: it goes round by 0.5 degrees a frame, 120 frames. S2: it comes nearer by 1 % a frame, 40. S3: the camera \
         turns where it stands, so that the middle moves by half a pixel a frame, 40. S4: the figure plays a clip at 24 \
         frames a second. S5: nothing moves, 8\n"
    );
    println!(
        "A frame's strokes, sampled a pixel apart, are carried to the next frame by the surface, and compared with what \
         is drawn there. **drift**: how far an end lies from the nearest end, median (at most 40 px each); **lost**: \
         ends with none within 8 px; **born**: ends of the next frame that come from none. **slide**: how far the \
         texture coordinate of a sample moves, median; **pop**: samples where it moves by more than 8 px; **voted**: \
         the same if every stroke took over its texture from the frame before as a whole, by the median of its samples; \
         **same id**: samples whose stroke keeps its identity. **flicker**: samples with no ink within 6 px although a line is still \
         to be drawn there, that is, within 3 px of a raw line; **point**: the same where their point of the surface is \
         still seen, whether or not a line is there, as where a fold flattens; **blink**: samples without ink in one \
         frame that have some in the next. **jitter**: root of the mean squared offset across the line, without its \
         mean; **bias**: how far contours are drawn outside of the raw ones, mean.\n"
    );
}

/// A table for every sequence.
pub fn sequences(rows: &[Measured]) {
    for film in Film::ALL {
        let rows: Vec<&Measured> = rows.iter().filter(|row| row.film == film).collect();
        if rows.is_empty() {
            continue;
        }
        println!("## {}\n", film.name());
        let mut table = Table::new([
            "model",
            "strokes",
            "drift, px",
            "lost, %",
            "born, %",
            "slide, px",
            "pop, %",
            "voted, %",
            "same id, %",
            "flicker, %",
            "point, %",
            "blink, %",
            "jitter, px",
            "bias, px",
        ]);
        for Measured { model, tally, .. } in &rows {
            let [mean, deviation] = tally.stroke_counts();
            let percent = |share: f64| format!("{:.2}", 100.0 * share);
            let cells = [
                format!("{mean:.1}±{deviation:.1}"),
                format!("{:.2}", tally.drift()),
                percent(tally.lost()),
                percent(tally.born_share()),
                format!("{:.2}", tally.slide()),
                percent(tally.pop()),
                percent(tally.voted_pop()),
                percent(tally.held()),
                format!("{:.3}", 100.0 * tally.flicker()),
                format!("{:.3}", 100.0 * tally.gone_point_share()),
                format!("{:.3}", 100.0 * tally.blink()),
                format!("{:.3}", tally.jitter()),
                format!("{:+.3}", tally.mean_bias()),
            ];
            table.add(model, cells);
        }
        println!("{table}");
        if film == Film::Still {
            let still = rows.iter().filter(|row| row.tally.is_still()).count();
            println!("{still} of {} are still to the bit.\n", rows.len());
        }
    }
}

/// Every bar, and the model that is farthest beyond it.
pub fn verdict(rows: &[Measured]) {
    println!("## Bars\n");
    let mut table = Table::new(["figure", "sequences", "at most", "worst", "of", "met by"]);
    for bar in &BARS {
        let judged = rows.iter().filter(|row| bar.films.contains(&row.film));
        let judged: Vec<(f64, &Measured)> =
            judged.map(|row| ((bar.value)(&row.tally), row)).collect();
        let Some((value, worst)) = judged.iter().max_by(|a, b| a.0.total_cmp(&b.0)) else {
            continue;
        };
        let met = judged
            .iter()
            .filter(|(value, _)| *value <= bar.most)
            .count();
        let films = bar.films.iter().map(|film| &film.name()[..2]);
        let cells = [
            films.collect::<Vec<_>>().join(" "),
            format!("{} {}", bar.most, bar.unit),
            format!("{value:.2} {}", bar.unit),
            format!("{}, {}", worst.model, worst.film.name()),
            format!("{met} of {}", judged.len()),
        ];
        table.add(bar.name, cells);
    }
    println!("{table}");
}

/// Why ends are lost and textures pop, for each sequence of all models together.
pub fn causes(rows: &[Measured]) {
    println!("## Where it comes from\n");
    println!(
        "Raw lines are runs of one kind on one surface, cut where something hides them. Every event is looked up in \
         the raw lines of both frames, and in what is drawn with stubs. An event is a pair of strokes that are one, or \
         an end. The largest is told with its model, the number of the later frame, and its place in pixels.\n"
    );
    for film in Film::ALL.into_iter().filter(|film| *film != Film::Still) {
        let rows: Vec<&Measured> = rows.iter().filter(|row| row.film == film).collect();
        let matches = rows.iter().map(|row| row.tally.slides.len()).sum();
        let ends = rows.iter().map(|row| row.tally.drifts.len()).sum();
        let gone = rows.iter().map(|row| row.tally.carried).sum();
        println!("### {}\n", film.name());
        let pops = rows
            .iter()
            .map(|row| (row.model.as_str(), &row.causes.pops));
        table(
            "why textures pop",
            "samples",
            matches,
            merged(pops, words::of_pop),
        );
        let losses = rows
            .iter()
            .map(|row| (row.model.as_str(), &row.causes.losses));
        table(
            "why ends are lost",
            "ends",
            ends,
            merged(losses, words::of_loss),
        );
        let gone_of = rows
            .iter()
            .map(|row| (row.model.as_str(), &row.causes.gone));
        let word = |absence| words::of_absence(absence).to_owned();
        table("why ink goes", "samples", gone, merged(gone_of, word));
    }
}

/// What happened in all models, with the one that holds most of it.
struct Merged<'a> {
    words: String,
    count: usize,
    events: usize,
    most: (usize, &'a str),
    largest: (&'a str, Count),
}

fn merged<'a, T: Copy + Ord + 'a>(
    rows: impl Iterator<Item = (&'a str, &'a Counts<T>)>,
    words: impl Fn(T) -> String,
) -> Vec<Merged<'a>> {
    let mut all: BTreeMap<T, Merged<'a>> = BTreeMap::new();
    for (model, counts) in rows {
        for (cause, count) in counts {
            let entry = all.entry(*cause).or_insert_with(|| Merged {
                words: words(*cause),
                count: 0,
                events: 0,
                most: (0, model),
                largest: (model, *count),
            });
            entry.count += count.count;
            entry.events += count.events;
            entry.most = entry.most.max((count.count, model));
            if count.largest.0 > entry.largest.1.largest.0 {
                entry.largest = (model, *count);
            }
        }
    }
    let mut all: Vec<Merged<'a>> = all.into_values().collect();
    all.sort_by_key(|merged| std::cmp::Reverse(merged.count));
    all
}

fn table(title: &str, what: &str, whole: usize, causes: Vec<Merged<'_>>) {
    let mut table = Table::new([title, what, "of all, %", "events", "most of it", "largest"]);
    for cause in causes {
        let (model, count) = cause.largest;
        let (samples, pair, [x, y]) = count.largest;
        let cells = [
            cause.count.to_string(),
            format!("{:.3}", 100.0 * share(cause.count, whole)),
            cause.events.to_string(),
            format!(
                "{}, {:.0} %",
                cause.most.1,
                100.0 * share(cause.most.0, cause.count)
            ),
            format!("{samples}: {model}, frame {}, ({x:.0}, {y:.0})", pair + 1),
        ];
        table.add(cause.words, cells);
    }
    println!("{table}");
}
