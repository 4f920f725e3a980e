//! The progress display on a terminal, and the time that each step took.

use indicatif::{ProgressBar, ProgressStyle};
use std::cell::Cell;
use std::io::{self, IsTerminal};
use std::rc::Rc;
use std::time::{Duration, Instant};

/// Time between two updates of the line on the terminal.
const TICK: Duration = Duration::from_millis(100);

/// Is told how many parts of a step are done, and of how many; says whether the work goes on.
pub type Watch = Rc<dyn Fn(usize, usize) -> bool>;

/// The steps of a run. A step is shown while it lasts, and timed.
pub struct Progress {
    /// The line on the terminal; `None` where nobody would see it.
    bar: Option<ProgressBar>,
    /// Who else is told.
    watch: Option<Watch>,
    done: Vec<(&'static str, Duration)>,
}

impl Progress {
    /// A progress display on standard error. It shows nothing where that is no terminal, or with `quiet`.
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
            watch: None,
            done: Vec::new(),
        }
    }

    /// A progress that a part of this program is told, which may end the work.
    #[cfg(any(test, feature = "view"))]
    pub fn told_to(watch: Watch) -> Self {
        let mut progress = Self::new(true);
        progress.watch = Some(watch);
        progress
    }

    /// Runs one step of the work, and records its time under `name`.
    pub fn step<R>(&mut self, name: &'static str, work: impl FnOnce() -> R) -> R {
        if let Some(bar) = &self.bar {
            bar.set_message(name);
        }
        let start = Instant::now();
        let result = work();
        self.done.push((name, start.elapsed()));
        result
    }

    /// A counter for a step that consists of parts.
    pub fn counter(&self) -> Counter {
        Counter {
            bar: self.bar.clone(),
            watch: self.watch.clone(),
            start: Cell::new(None),
        }
    }

    /// Hides the progress display while `write` writes a line.
    pub fn suspend(&self, write: impl FnOnce()) {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    /// Ends the display, and gives the steps with the time each took.
    pub fn finish(mut self) -> Vec<(&'static str, Duration)> {
        std::mem::take(&mut self.done)
    }
}

/// Shows how far one step is, with an estimate of the time left.
pub struct Counter {
    bar: Option<ProgressBar>,
    watch: Option<Watch>,
    /// When the first part was reported, and how many were done then.
    start: Cell<Option<(Instant, usize)>>,
}

impl Counter {
    /// Shows that `done` parts of `of` are done.
    pub fn tell(&self, name: &str, done: usize, of: usize) {
        self.show(name, [done, of], false);
    }

    /// The same with how many are done a second; gives whether the work goes on.
    pub fn tell_pace(&self, name: &str, done: usize, of: usize) -> bool {
        self.show(name, [done, of], true);
        self.watch.as_ref().is_none_or(|watch| watch(done, of))
    }

    fn show(&self, name: &str, [done, of]: [usize; 2], with_pace: bool) {
        let Some(bar) = &self.bar else {
            return;
        };
        let (start, before) = self.start.get().unwrap_or((Instant::now(), done));
        self.start.set(Some((start, before)));
        let (elapsed, since) = (start.elapsed(), done - before.min(done));
        let left = time_left(elapsed, since, of.saturating_sub(done));
        let left = left.map_or(String::new(), |left| format!(", {} s left", left.as_secs()));
        let pace = match with_pace && since > 0 {
            true => format!(", {:.1} a second", since as f64 / elapsed.as_secs_f64()),
            false => String::new(),
        };
        bar.set_message(format!("{name} {done} of {of}{pace}{left},"));
    }
}

/// Time for the parts that are left, at the pace so far; none before the first is done.
fn time_left(elapsed: Duration, done: usize, left: usize) -> Option<Duration> {
    let seconds = elapsed.as_secs_f64() / done as f64 * left as f64;
    Duration::try_from_secs_f64(seconds).ok()
}

impl Drop for Progress {
    /// Clears the line, so that the next message starts on a clean terminal.
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
