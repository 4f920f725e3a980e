//! What is being done right now, on a terminal, and how long each step took.

use indicatif::{ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

/// How often the line on the terminal moves.
const TICK: Duration = Duration::from_millis(100);

/// Steps of a run: shown while they last, timed when they are over.
pub struct Progress {
    /// Where somebody may see it.
    bar: Option<ProgressBar>,
    done: Vec<(&'static str, Duration)>,
}

impl Progress {
    /// A line on standard error, where that is a terminal and `quiet` is not asked for.
    pub fn new(quiet: bool) -> Self {
        let bar = (!quiet && io::stderr().is_terminal()).then(ProgressBar::new_spinner);
        if let Some(bar) = &bar {
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
                bar.set_style(style);
            }
            bar.enable_steady_tick(TICK);
        }
        Self {
            bar,
            done: Vec::new(),
        }
    }

    /// Does one step of the work.
    pub fn step<R>(&mut self, name: &'static str, work: impl FnOnce() -> R) -> R {
        if let Some(bar) = &self.bar {
            bar.set_message(name);
        }
        let start = Instant::now();
        let result = work();
        self.done.push((name, start.elapsed()));
        result
    }

    /// Tells how far a step is that goes on in parts.
    pub fn counter(&self) -> Counter {
        Counter {
            bar: self.bar.clone(),
            start: Cell::new(None),
        }
    }

    /// Writes a line by `write`, with the progress out of its way.
    pub fn suspend(&self, write: impl FnOnce()) {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    /// Ends the show; the steps with the time each took.
    pub fn finish(mut self) -> Vec<(&'static str, Duration)> {
        std::mem::take(&mut self.done)
    }
}

/// How far one step is, with an estimate of what is left.
pub struct Counter {
    bar: Option<ProgressBar>,
    /// When the first part was reported, and how many were done then.
    start: Cell<Option<(Instant, usize)>>,
}

impl Counter {
    /// Shows that `done` parts of `of` are done.
    pub fn tell(&self, name: &str, done: usize, of: usize) {
        let Some(bar) = &self.bar else {
            return;
        };
        let (start, before) = self.start.get().unwrap_or((Instant::now(), done));
        self.start.set(Some((start, before)));
        let left = time_left(
            start.elapsed(),
            done - before.min(done),
            of.saturating_sub(done),
        );
        let left = left.map_or(String::new(), |left| format!(", {} s left", left.as_secs()));
        bar.set_message(format!("{name} {done} of {of}{left},"));
    }
}

/// Time for the parts that are left, at the pace so far; none before the first is done.
fn time_left(elapsed: Duration, done: usize, left: usize) -> Option<Duration> {
    let seconds = elapsed.as_secs_f64() / done as f64 * left as f64;
    Duration::try_from_secs_f64(seconds).ok()
}

impl Drop for Progress {
    /// Leaves a clean terminal to whatever is said next.
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_is_done() {
        let left = |done, left| time_left(Duration::from_secs(6), done, left);
        assert_eq!(left(3, 2), Some(Duration::from_secs(4)));
        assert_eq!(left(3, 0), Some(Duration::ZERO));
        assert_eq!(left(0, 5), None);
        assert_eq!(left(0, 0), None);
    }
}
