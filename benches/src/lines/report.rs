//! Measures as tables, with every fault listed.

use std::fmt::Write;

use super::measures::{Against, Fault, LISTED, Measures, TOLERANCES_PX};
use crate::table::Table;

/// Faults listed for one view, missing and spurious each; of the rest, number and length are told.
const LISTED_FAULTS: usize = 12;

/// What a way of drawing must reach in every view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// Index into [`TOLERANCES_PX`].
    pub tolerance: usize,
    /// Least recall.
    pub recall: f64,
    /// Least precision.
    pub precision: f64,
    /// What strokes are counted against.
    pub against: Against,
}

/// Most doubles beyond the reference's own, as a share of all ink.
pub const MOST_DOUBLES: f64 = 0.02;

/// Fewest and most strokes for each run that there is to draw.
pub const FRAGMENTATION: [f64; 2] = [0.8, 1.5];

/// One view of one model.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Name of the model.
    pub model: String,
    /// Number of the view, from 1.
    pub view: usize,
    /// What was measured.
    pub measures: Measures,
}

impl Row {
    fn name(&self) -> String {
        format!("{} {}", self.model, self.view)
    }

    /// What misses the bar, in words, each with whether it is a matter of agreement; nothing where all is well.
    fn shortcomings(&self, bar: &Bar) -> Vec<(bool, String)> {
        let m = &self.measures;
        let [recall, precision] = [m.recall, m.precision].map(|of| of[bar.tolerance]);
        let [fewest, most] = FRAGMENTATION;
        let per_run = m.fragmentation(bar.against);
        let mut fragments = format!("{per_run:.2} strokes a {}", bar.against.word());
        if bar.against == Against::Runs {
            // Fewer than the edges of a noisy mesh come apart into, and still no fewer than a picture takes?
            let _ = write!(
                fragments,
                ", {:.2} a {}",
                m.fragmentation(Against::Drawn),
                Against::Drawn.word()
            );
        }
        let faults = [
            (
                recall < bar.recall,
                true,
                format!("recall {}", floored(recall)),
            ),
            (
                precision < bar.precision,
                true,
                format!("precision {}", floored(precision)),
            ),
            (
                m.extra_doubles() > MOST_DOUBLES,
                true,
                format!("doubles {:+.4}", m.extra_doubles()),
            ),
            (!(fewest..=most).contains(&per_run), false, fragments),
        ];
        let there = faults.into_iter().filter(|(is_there, ..)| *is_there);
        there
            .map(|(_, of_agreement, words)| (of_agreement, words))
            .collect()
    }
}

/// Table, verdict, worst views and faults of one way of drawing.
pub fn section(name: &str, bar: &Bar, rows: &[Row]) -> String {
    let mut text = format!("## {name}\n\n{}\n", table(rows));
    let _ = writeln!(text, "{}", verdict(bar, rows));
    for row in rows {
        text += &faults(row);
    }
    text
}

fn table(rows: &[Row]) -> Table {
    let [low, middle, high] = TOLERANCES_PX;
    let mut table = Table::new([
        "model and view".to_owned(),
        "to draw, px".to_owned(),
        format!("recall at {low} px"),
        format!("{middle} px"),
        format!("{high} px"),
        format!("precision at {low} px"),
        format!("{middle} px"),
        format!("{high} px"),
        "doubles".to_owned(),
        "strokes".to_owned(),
        "of 8 px and more".to_owned(),
        "runs".to_owned(),
        "joined runs".to_owned(),
        "drawn runs".to_owned(),
        "strokes a run".to_owned(),
        "a joined run".to_owned(),
        "a drawn run".to_owned(),
        "mean stroke / frame height".to_owned(),
        "of runs".to_owned(),
        "of drawn runs".to_owned(),
        "short".to_owned(),
        "of runs".to_owned(),
        "bias, px".to_owned(),
    ]);
    for row in rows {
        table.add(row.name(), cells(&row.measures));
    }
    table
}

fn cells(m: &Measures) -> Vec<String> {
    let shares = m
        .recall
        .iter()
        .chain(&m.precision)
        .map(|share| floored(*share));
    let in_frames = |px: f64| format!("{:.3}", px / f64::from(super::subjects::SIZE[1]));
    let rest = [
        format!("{:+.4}", m.extra_doubles()),
        m.strokes.count.to_string(),
        m.strokes.long.to_string(),
        m.runs.count.to_string(),
        m.joined.count.to_string(),
        m.drawn.long.to_string(),
        format!("{:.2}", m.fragmentation(Against::Runs)),
        format!("{:.2}", m.fragmentation(Against::Joined)),
        format!("{:.2}", m.fragmentation(Against::Drawn)),
        in_frames(m.strokes.mean_px),
        in_frames(m.runs.mean_px),
        in_frames(m.drawn.mean_px),
        format!("{:.2}", m.strokes.short),
        format!("{:.2}", m.runs.short),
        format!("{:+.3}", m.bias_px),
    ];
    std::iter::once(format!("{:.0}", m.due_px))
        .chain(shares)
        .chain(rest)
        .collect()
}

/// A share to four digits that says 1 only of all.
fn floored(share: f64) -> String {
    format!("{:.4}", (share * 1e4).floor() / 1e4)
}

fn verdict(bar: &Bar, rows: &[Row]) -> String {
    // Say what the bar is.
    let mut text = format!(
        "Bar: recall {} and precision {} at {} px, doubles {MOST_DOUBLES}, {} to {} strokes a {}.",
        bar.recall,
        bar.precision,
        TOLERANCES_PX[bar.tolerance],
        FRAGMENTATION[0],
        FRAGMENTATION[1],
        bar.against.word()
    );

    // Count the views that reach it.
    let short: Vec<(&Row, Vec<(bool, String)>)> = rows
        .iter()
        .map(|row| (row, row.shortcomings(bar)))
        .filter(|(_, faults)| !faults.is_empty())
        .collect();
    let missed = |agreement: bool| {
        let is_such =
            |(_, faults): &&(&Row, Vec<(bool, String)>)| faults.iter().any(|f| f.0 == agreement);
        short.iter().filter(is_such).count()
    };
    let count = rows.len();
    let _ = write!(
        text,
        " {} of {count} views reach recall, precision and doubles; {} of {count} the number of strokes.",
        count - missed(true),
        count - missed(false)
    );

    // Name the worst views.
    let worst = |of: fn(&Measures) -> &[f64; 3]| {
        let share = |row: &&Row| of(&row.measures)[bar.tolerance];
        rows.iter()
            .min_by(|a, b| share(a).total_cmp(&share(b)))
            .map(|row| (row.name(), share(&row)))
    };
    for (what, found) in [
        ("recall", worst(|m| &m.recall)),
        ("precision", worst(|m| &m.precision)),
    ] {
        if let Some((name, share)) = found {
            let _ = write!(text, " Worst {what}: {name}, {}.", floored(share));
        }
    }
    text += "\n";

    // List the views that fall short.
    for (row, faults) in short {
        let _ = write!(
            text,
            "\n- below the bar: {}: {}",
            row.name(),
            words(&faults)
        );
    }
    text + "\n"
}

fn words(faults: &[(bool, String)]) -> String {
    let words: Vec<&str> = faults.iter().map(|(_, words)| words.as_str()).collect();
    words.join(", ")
}

/// Where lines are missing, and where there should be none.
fn faults(row: &Row) -> String {
    let m = &row.measures;
    let mut text = String::new();
    for (what, faults) in [("missing", &m.missing), ("spurious", &m.spurious)] {
        if faults.is_empty() {
            continue;
        }

        // List the longest faults.
        let listed: Vec<String> = faults.iter().take(LISTED_FAULTS).map(fault).collect();
        let _ = write!(
            text,
            "- {}, {what} at {} px: {}",
            row.name(),
            TOLERANCES_PX[LISTED],
            listed.join("; ")
        );

        // Sum up the others.
        let rest = faults.get(LISTED_FAULTS..).unwrap_or_default();
        if !rest.is_empty() {
            let px: f64 = rest.iter().map(|fault| fault.length).sum();
            let _ = write!(text, "; and {} more of {px:.1} px", rest.len());
        }
        text += "\n";
    }
    text
}

fn fault(fault: &Fault) -> String {
    let [x, y] = fault.at;
    format!(
        "{} {:.1} px at ({x:.0}, {y:.0})",
        fault.kind.name(),
        fault.length
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::Kind;

    fn row(model: &str, recall: f64) -> Row {
        Row {
            model: model.to_owned(),
            view: 1,
            measures: Measures {
                recall: [recall; 3],
                precision: [1.0; 3],
                missing: vec![
                    Fault {
                        at: [3.0, 4.0],
                        length: 2.5,
                        kind: Kind::Crease
                    };
                    14
                ],
                ..Measures::default()
            },
        }
    }

    #[test]
    fn misses_and_the_worst_view_are_named() {
        let bar = Bar {
            tolerance: 1,
            recall: 0.998,
            precision: 0.998,
            against: Against::Runs,
        };
        let text = section("edges", &bar, &[row("cube", 1.0), row("bunny", 0.97)]);
        assert!(text.contains(
            "1 of 2 views reach recall, precision and doubles; 2 of 2 the number of strokes"
        ));
        assert!(text.contains("Worst recall: bunny 1, 0.9700"));
        assert!(text.contains("below the bar: bunny 1: recall 0.9700\n"));
        assert!(text.contains("crease 2.5 px at (3, 4)") && text.contains("and 2 more of 5.0 px"));
    }

    #[test]
    fn one_is_said_only_of_all() {
        assert_eq!(
            (floored(1.0), floored(0.99999)),
            ("1.0000".to_owned(), "0.9999".to_owned())
        );
    }
}
