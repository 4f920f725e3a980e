//! What the tables say.

use std::collections::BTreeMap;

use npr_benches::machine;
use npr_benches::motion::causes::{BACK_FRAMES, Counts};
use npr_benches::motion::film::Film;
use npr_benches::motion::tally::{OfKind, Tally, share};
use npr_benches::table::Table;
use npr_vector::stroke::Kind;

use crate::measured::Measured;
use crate::subject::{PRESET, SIZE};
use crate::words;

/// A figure with a bar: its name, the sequences that it counts in, its value, and the most that it may be.
struct Bar {
    name: &'static str,
    films: &'static [Film],
    /// Whether it is the mean over the sequences of a model that is judged, not each of them.
    is_mean: bool,
    value: fn(&Tally) -> f64,
    most: f64,
    unit: &'static str,
}

/// The bars.
const BARS: [Bar; 9] = [
    Bar {
        name: "M4 drift, median",
        films: &[Film::Turn, Film::Dolly, Film::Pan, Film::Clip],
        is_mean: false,
        value: Tally::drift,
        most: 1.0,
        unit: "px",
    },
    Bar {
        name: "M4 ends lost",
        films: &[Film::Turn, Film::Dolly, Film::Pan, Film::Clip],
        is_mean: false,
        value: |tally| 100.0 * tally.lost(),
        most: 3.0,
        unit: "%",
    },
    Bar {
        name: "M4 drift, mean of a model",
        films: &[Film::Turn, Film::Pan, Film::Clip],
        is_mean: true,
        value: Tally::drift,
        most: 1.0,
        unit: "px",
    },
    Bar {
        name: "M4 ends lost, mean of a model",
        films: &[Film::Turn, Film::Pan, Film::Clip],
        is_mean: true,
        value: |tally| 100.0 * tally.lost(),
        most: 3.0,
        unit: "%",
    },
    Bar {
        name: "M5 pop",
        films: &[Film::Turn],
        is_mean: false,
        value: |tally| 100.0 * tally.pop(),
        most: 1.0,
        unit: "%",
    },
    Bar {
        name: "M5 pop",
        films: &[Film::Clip],
        is_mean: false,
        value: |tally| 100.0 * tally.pop(),
        most: 2.0,
        unit: "%",
    },
    Bar {
        name: "M6 flicker",
        films: &[Film::Turn, Film::Dolly, Film::Pan, Film::Clip],
        is_mean: false,
        value: |tally| 100.0 * tally.flicker(),
        most: 0.1,
        unit: "%",
    },
    Bar {
        name: "M7 jitter",
        films: &[Film::Pan],
        is_mean: false,
        value: Tally::jitter,
        most: 0.3,
        unit: "px",
    },
    Bar {
        name: "M7 bias",
        films: &[Film::Pan],
        is_mean: false,
        value: |tally| tally.mean_bias().abs(),
        most: 0.5,
        unit: "px",
    },
];

impl Bar {
    /// Its values, and what they are of.
    fn judged<'a>(&self, rows: impl Iterator<Item = &'a Measured>) -> Vec<(f64, String)> {
        let value = |row: &Measured| (self.value)(&row.tally);
        if !self.is_mean {
            let of = |row: &Measured| format!("{}, {}", row.model, row.film.name());
            return rows.map(|row| (value(row), of(row))).collect();
        }
        let mut of_models: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        for row in rows {
            of_models.entry(&row.model).or_default().push(value(row));
        }
        let means = of_models.into_iter().map(|(model, values)| {
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            (mean, model.to_owned())
        });
        means.collect()
    }
}

/// Says what was measured, and where.
pub fn heading() {
    println!("# Lines that move\n");
    println!("- machine: {}", machine::description());
    println!("- code: {}", machine::code());
    println!(
        "- preset {PRESET} at {}x{}, `line.method = \"strokes\"`: the strokes that frames ink, joined, smoothed, and \
         without doubles and stubs; every frame by itself, and in rows `held` with what is held from frame to frame",
        SIZE[0], SIZE[1]
    );
    println!(
        "- the eye stands three radii away, 15 degrees above, vertical field of view 45 degrees\n\
         - S1: it goes round by 0.5 degrees a frame, 120 frames. S2: it comes nearer by 1 % a frame, 40. S3: the \
         camera turns where it stands, so that the middle moves by half a pixel a frame, 40. S4: the figure plays a \
         clip at 24 frames a second. S5: nothing moves, 8\n"
    );
    println!(
        "A frame's strokes, sampled a pixel apart, are carried to the next frame by the surface, and compared with \
         what is drawn there:\n\n\
         - **drift**: how far an end lies from the nearest end, median, at most 40 px each; **lost**: ends with none \
         within 8 px; **raw**: the same of raw lines of 16 px or more, before anything is joined or left out: \
         what surfaces and what hides them lose by themselves; **born**: ends of the next frame that come from none\n\
         - **slide**: how far the texture coordinate of a sample moves, median, to half a pixel, as samples are a \
         pixel apart; **pop**: samples where it moves by more than 8 px; **voted**: the same if every stroke took over \
         its texture from the frame before as a whole, by the median of its samples; **same id**: samples whose stroke \
         keeps its identity\n\
         - **flicker**: samples with no ink within 6 px although a line is still to be drawn there, that is, within \
         3 px of a raw line; **point**: the same where their point of the surface is still seen, whether or not a line \
         is there, as where a fold flattens; **blink**: samples without ink in one frame that have some in the next\n\
         - **jitter**: root of the mean squared offset across the line, without its mean; **bias**: how far contours \
         are drawn outside of the raw ones, mean\n"
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
            "raw: drift, px",
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
        for row in &rows {
            let tally = &row.tally;
            let [mean, deviation] = tally.stroke_counts();
            let percent = |share: f64| format!("{:.2}", 100.0 * share);
            let cells = [
                format!("{mean:.1}±{deviation:.1}"),
                format!("{:.2}", tally.drift()),
                percent(tally.lost()),
                format!("{:.2}", tally.raw_drift()),
                percent(tally.raw_lost()),
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
            table.add(row.name(), cells);
        }
        println!("{table}");
        for is_held in [false, true] {
            let rows: Vec<&Measured> = rows
                .iter()
                .copied()
                .filter(|row| row.is_held == is_held)
                .collect();
            if film != Film::Still && !rows.is_empty() {
                let (name, kinds) = (if is_held { "kind, held" } else { "kind" }, kinds(&rows));
                println!("{}", kinds.to_string().replacen("kind", name, 1));
            }
        }
        if film == Film::Still {
            let still = rows.iter().filter(|row| row.tally.is_still()).count();
            println!("{still} of {} are still to the bit.\n", rows.len());
        }
    }
}

/// A table of all models together by kinds of lines.
fn kinds(rows: &[&Measured]) -> Table {
    let mut sums: BTreeMap<Kind, OfKind> = BTreeMap::new();
    for (kind, of_kind) in rows.iter().flat_map(|row| &row.tally.kinds) {
        let sum = sums.entry(*kind).or_default();
        (0..3).for_each(|i| sum.matches[i] += of_kind.matches[i]);
        (0..2).for_each(|i| sum.ends[i] += of_kind.ends[i]);
    }
    let all: usize = sums.values().map(|sum| sum.matches[0]).sum();
    let mut table = Table::new(["kind", "of all ink, %", "pop, %", "voted, %", "lost, %"]);
    for (kind, OfKind { matches, ends }) in sums {
        let percent = |part: usize, whole: usize| format!("{:.2}", 100.0 * share(part, whole));
        let cells = [
            percent(matches[0], all),
            percent(matches[1], matches[0]),
            percent(matches[2], matches[0]),
            percent(ends[1], ends[0]),
        ];
        table.add(kind.name(), cells);
    }
    table
}

/// Every bar, and the model that is farthest beyond it.
pub fn verdict(rows: &[Measured]) {
    println!("## Bars\n");
    let mut table = Table::new(["figure", "sequences", "at most", "worst", "of", "met by"]);
    for (bar, is_held) in BARS.iter().flat_map(|bar| [(bar, false), (bar, true)]) {
        let judged = rows
            .iter()
            .filter(|row| row.is_held == is_held && bar.films.contains(&row.film));
        let judged = bar.judged(judged);
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
            worst.clone(),
            format!("{met} of {}", judged.len()),
        ];
        let name = format!("{}{}", bar.name, if is_held { ", held" } else { "" });
        table.add(name, cells);
    }
    println!("{table}");
}

/// Why ends are lost and textures pop, for each sequence.
pub fn causes(rows: &[Measured]) {
    println!("## Where it comes from\n");
    println!(
        "Raw lines are runs of one kind on one surface, cut where something hides them. Every event is looked up in \
         the raw lines of both frames, and in what is drawn with stubs. Where raw lines end at a place in both frames, \
         the strokes of the frame that parts them tell why they may not be joined there. Figures are shares of all \
         samples, or ends, of a model, in per cent. The example is the largest event: its samples, model, number of \
         the later frame, and place in pixels. Pops after a vote are those that stay where strokes take over their \
         textures as a whole: of the lesser ones of those that are joined.\n"
    );
    let films = Film::ALL.into_iter().filter(|film| *film != Film::Still);
    for (film, is_held) in films.flat_map(|film| [(film, false), (film, true)]) {
        let is_asked = |row: &&Measured| row.film == film && row.is_held == is_held;
        let rows: Vec<&Measured> = rows.iter().filter(is_asked).collect();
        if rows.is_empty() {
            continue;
        }
        println!(
            "### {}{}\n",
            film.name(),
            if is_held { ", held" } else { "" }
        );
        let matches = |row: &Measured| row.tally.slides.len();
        table(
            "pops",
            &rows,
            matches,
            |row| &row.causes.pops,
            words::of_pop,
        );
        if let Some(flips) = flips(&rows) {
            println!("{flips}\n");
        }
        table(
            "pops after a vote",
            &rows,
            matches,
            |row| &row.causes.voted_pops,
            words::of_pop,
        );
        let ends = |row: &Measured| row.tally.drifts.len();
        table(
            "ends lost",
            &rows,
            ends,
            |row| &row.causes.losses,
            words::of_loss,
        );
        let carried = |row: &Measured| row.tally.carried;
        let word = |absence| words::of_absence(absence).to_owned();
        table("ink gone", &rows, carried, |row| &row.causes.gone, word);
    }
}

/// How many of the joints that change change back, in words; none where none change.
fn flips(rows: &[&Measured]) -> Option<String> {
    let of = |row: &&&Measured| row.causes.flips;
    let all = rows.iter().map(|row| of(&row));
    let [at_joints, back] = all.fold([0; 2], |sum, flips| [0, 1].map(|i| sum[i] + flips[i]));
    let percent =
        |[at_joints, back]: [usize; 2]| format!("{:.0} %", 100.0 * share(back, at_joints));
    let by_model = rows.iter().filter(|row| of(row)[0] > 0);
    let by_model: Vec<String> = by_model
        .map(|row| format!("{} {}", row.model, percent(row.causes.flips)))
        .collect();
    (at_joints > 0).then(|| {
        format!(
            "Of what pops where ends that meet in both frames are joined in one, {} lies at joints that changed the \
             other way within {BACK_FRAMES} frames before: {}.",
            percent([at_joints, back]),
            by_model.join(", ")
        )
    })
}

/// A table of causes with a column for every model, unless nothing happened at all.
fn table<T: Copy + Ord>(
    title: &str,
    rows: &[&Measured],
    whole: impl Fn(&Measured) -> usize,
    counts: impl Fn(&Measured) -> &Counts<T>,
    words: impl Fn(T) -> String,
) {
    // Order causes by how much there is of them.
    let mut sums: BTreeMap<T, usize> = BTreeMap::new();
    for (cause, count) in rows.iter().flat_map(|row| counts(row)) {
        *sums.entry(*cause).or_default() += count.count;
    }
    let all: usize = rows.iter().map(|row| whole(row)).sum();
    let mut sums: Vec<(T, usize)> = sums.into_iter().collect();
    sums.sort_by_key(|(_, sum)| std::cmp::Reverse(*sum));
    if sums.is_empty() {
        return;
    }

    // Give every cause a row, with its largest event.
    let models = rows.iter().map(|row| row.model.as_str());
    let mut table = Table::new(
        [title, "all", "events"]
            .into_iter()
            .chain(models)
            .chain(["example"]),
    );
    let percent = |part: usize, whole: usize| format!("{:.3}", 100.0 * share(part, whole));
    for (cause, sum) in sums {
        let of = |row: &&&Measured| counts(row).get(&cause).copied();
        let events: usize = rows
            .iter()
            .filter_map(|row| of(&row))
            .map(|count| count.events)
            .sum();
        let mut cells = vec![percent(sum, all), events.to_string()];
        cells.extend(
            rows.iter()
                .map(|row| percent(of(&row).map_or(0, |count| count.count), whole(row))),
        );
        let largest = rows
            .iter()
            .filter_map(|row| Some((of(&row)?.largest, &row.model)));
        let largest = largest.max_by_key(|((samples, ..), _)| *samples);
        cells.extend(largest.map(|((samples, pair, [x, y]), model)| {
            format!("{samples}, {model}, frame {}, ({x:.0}, {y:.0})", pair + 1)
        }));
        table.add(words(cause), cells);
    }
    println!("{table}");
}
