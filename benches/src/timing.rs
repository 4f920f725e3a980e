//! Medians of wall time.

use std::fmt;
use std::time::Instant;

/// What some runs of the same work took, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Times {
    /// The median: forgives the runs in which the machine did something else.
    pub median: f64,
    /// The least: what a machine with nothing else to do would come near.
    pub least: f64,
}

impl Times {
    /// The times of some runs; an infinite least of none.
    pub fn of(runs: Vec<f64>) -> Self {
        Self {
            least: runs.iter().copied().fold(f64::INFINITY, f64::min),
            median: median(runs),
        }
    }
}

impl fmt::Display for Times {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.1} ({:.1})", self.median, self.least)
    }
}

/// Milliseconds that `work` took.
pub fn elapsed_ms(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e3
}

/// Milliseconds that the threads of this process have worked so far, all together, without waiting for a processor;
/// `None` where the system does not tell.
///
/// On a machine that others use too, this says more than the clock.
pub fn worked_ms() -> Option<f64> {
    let mut sum = 0.0;
    for thread in std::fs::read_dir("/proc/self/task").ok()? {
        let reported = std::fs::read_to_string(thread.ok()?.path().join("schedstat")).ok()?;
        sum += reported.split(' ').next()?.parse::<f64>().ok()?;
    }
    Some(sum / 1e6)
}

/// The middle of some numbers, the mean of the two in the middle where their count is even; 0 of none.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (low, high) = (values.len().saturating_sub(1) / 2, values.len() / 2);
    match (values.get(low), values.get(high)) {
        (Some(low), Some(high)) => (low + high) / 2.0,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_minds_no_outlier() {
        assert_eq!(median(vec![3.0, 900.0, 1.0]), 3.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 900.0]), 3.0);
        assert_eq!(median(Vec::new()), 0.0);
    }
}
