//! What the stages of a frame take, run after run.

use std::fmt;

use npr_render::Frame;

use crate::table::Table;
use crate::timing::{Times, elapsed_ms, worked_ms};

/// Times of stages, in the order in which they were first entered.
#[derive(Debug, Clone, Default)]
pub struct Ledger {
    rows: Vec<Row>,
}

/// A stage's runs: times of the clock, and work of all threads where the system tells it.
#[derive(Debug, Clone)]
struct Row {
    name: String,
    clock: Vec<f64>,
    work: Vec<f64>,
}

impl Ledger {
    /// What `stage` gives, its time entered under a name.
    pub fn time<T>(&mut self, name: &str, renderer: impl FnOnce() -> T) -> T {
        let before = worked_ms();
        let mut given = None;
        let clock = elapsed_ms(|| given = Some(renderer()));
        let worked = before.zip(worked_ms()).map(|(from, to)| to - from);
        self.enter(name, clock, worked);
        given.unwrap_or_else(|| unreachable!("a stage that ran has given something"))
    }

    /// Enters the passes of a frame, those of one name together.
    pub fn enter_passes(&mut self, frame: &Frame) {
        let mut sums: Vec<(&str, f64)> = Vec::new();
        for pass in &frame.times {
            let ms = pass.time.as_secs_f64() * 1e3;
            match sums.iter_mut().find(|(name, _)| *name == pass.name) {
                Some((_, sum)) => *sum += ms,
                None => sums.push((pass.name, ms)),
            }
        }
        for (name, ms) in sums {
            self.enter(&format!("`{name}`"), ms, None);
        }
    }

    /// Enters all that another ledger holds.
    pub fn take(&mut self, other: &Self) {
        for row in &other.rows {
            for (i, clock) in row.clock.iter().enumerate() {
                self.enter(&row.name, *clock, row.work.get(i).copied());
            }
        }
    }

    fn enter(&mut self, name: &str, clock: f64, work: Option<f64>) {
        let at = self.rows.iter().position(|row| row.name == name);
        let at = at.unwrap_or_else(|| {
            self.rows.push(Row {
                name: name.to_owned(),
                clock: Vec::new(),
                work: Vec::new(),
            });
            self.rows.len() - 1
        });
        self.rows[at].clock.push(clock);
        self.rows[at].work.extend(work);
    }

    /// Times of the clock and of all threads' work of the stage of a name; nothing of one that never ran.
    pub fn of(&self, name: &str) -> Option<(Times, Times)> {
        let row = self.rows.iter().find(|row| row.name == name)?;
        Some((Times::of(row.clock.clone()), Times::of(row.work.clone())))
    }
}

impl fmt::Display for Ledger {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut table = Table::new(["stage", "ms", "work of all threads, ms"]);
        for row in &self.rows {
            let times = |runs: &[f64]| match runs {
                [] => String::new(),
                _ => precise(Times::of(runs.to_vec())),
            };
            table.add(&*row.name, [times(&row.clock), times(&row.work)]);
        }
        table.fmt(f)
    }
}

/// A median and, in brackets, the least, to a hundredth.
pub fn precise(times: Times) -> String {
    format!("{:.2} ({:.2})", times.median, times.least)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_keep_their_order_and_their_medians() {
        let mut ledger = Ledger::default();
        for ms in [3.0, 1.0, 50.0] {
            ledger.enter("steps", ms, Some(2.0 * ms));
            ledger.enter("draws", 4.0, None);
        }
        assert_eq!(ledger.time("adds", || 1 + 1), 2);
        let text = ledger.to_string();
        let order = ["steps", "draws", "adds"].map(|name| text.find(name).unwrap());
        assert!(order.is_sorted());
        assert!(text.contains("| steps | 3.00 (1.00) | 6.00 (2.00) |"));
        assert!(text.contains("| draws | 4.00 (4.00) |  |"));
        assert!(ledger.of("sleeps").is_none());
    }
}
