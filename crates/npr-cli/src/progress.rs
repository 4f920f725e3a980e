//! What is being done right now, on a terminal, and how long each step took.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::{Duration, Instant};

/// How often the line on the terminal moves.
const TICK: Duration = Duration::from_millis(100);

/// Steps of a run: shown while they last, timed when they are over.
pub struct Progress {
    bar: ProgressBar,
    done: Vec<(&'static str, Duration)>,
}

impl Progress {
    /// A line on standard error, where that is a terminal and `quiet` is not asked for.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(None, target);
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
            bar.set_style(style);
        }
        bar.enable_steady_tick(TICK);
        Self {
            bar,
            done: Vec::new(),
        }
    }

    /// Does one step of the work.
    pub fn step<R>(&mut self, name: &'static str, work: impl FnOnce() -> R) -> R {
        self.bar.set_message(name);
        let start = Instant::now();
        let result = work();
        self.done.push((name, start.elapsed()));
        result
    }

    /// Writes a line by `write`, with the progress out of its way.
    pub fn suspend(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }

    /// Ends the show; the steps with the time each took.
    pub fn finish(mut self) -> Vec<(&'static str, Duration)> {
        std::mem::take(&mut self.done)
    }
}

impl Drop for Progress {
    /// Leaves a clean terminal to whatever is said next.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
