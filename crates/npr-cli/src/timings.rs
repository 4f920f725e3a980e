//! The report of `--timings`, for people or for programs.

use crate::arguments::TimingsForm;
use npr_gpu::engine::PassTime;
use serde::Serialize;
use std::time::Duration;

/// The times of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Timings {
    /// Description of the engine that drew.
    engine: String,
    /// Steps of the run, in order.
    steps: Vec<Time>,
    /// Passes within the step `draw`, in order.
    passes: Vec<Time>,
}

/// A piece of work and its duration.
#[derive(Debug, Clone, Serialize)]
struct Time {
    name: String,
    ms: f64,
}

impl Time {
    fn new(name: &str, time: Duration) -> Self {
        Self {
            name: name.to_owned(),
            ms: time.as_secs_f64() * 1e3,
        }
    }
}

impl Timings {
    /// The times of an engine's passes and of the steps around them.
    pub fn new(engine: String, steps: &[(&'static str, Duration)], passes: &[PassTime]) -> Self {
        let steps = steps
            .iter()
            .map(|(name, time)| Time::new(name, *time))
            .collect();
        let passes = passes
            .iter()
            .map(|pass| Time::new(pass.name, pass.time))
            .collect();
        Self {
            engine,
            steps,
            passes,
        }
    }

    /// The times as text that ends in a line break.
    pub fn reported(&self, form: TimingsForm) -> String {
        match form {
            TimingsForm::Table => self.table(),
            TimingsForm::Json => {
                let json = serde_json::to_string(self).unwrap_or_default();
                format!("{json}\n")
            }
        }
    }

    /// A line per step, passes indented under the step that ran them.
    fn table(&self) -> String {
        let line = |indent: &str, time: &Time| {
            let name = format!("{indent}{}", time.name);
            format!("{name:<28} {:>9.2} ms\n", time.ms)
        };
        let mut table = format!("{}\n", crate::message::plain(&self.engine));
        for step in &self.steps {
            table.push_str(&line("", step));
            if step.name == DRAW {
                table.extend(self.passes.iter().map(|pass| line("  ", pass)));
            }
        }
        table
    }
}

/// Name of the step that runs the passes.
pub const DRAW: &str = "draw";

#[cfg(test)]
mod tests {
    use super::*;

    fn timings() -> Timings {
        let steps = [
            ("load", Duration::from_millis(1)),
            (DRAW, Duration::from_millis(20)),
        ];
        let passes = [PassTime {
            name: "raster.draw_ids",
            time: Duration::from_micros(1500),
        }];
        Timings::new("processor, 2 threads".to_owned(), &steps, &passes)
    }

    #[test]
    fn passes_stand_under_the_step_that_ran_them() {
        let table = timings().reported(TimingsForm::Table);
        let names: Vec<_> = table
            .lines()
            .map(|line| line.split("  ").next().unwrap_or_default())
            .collect();
        assert_eq!(names, ["processor, 2 threads", "load", "draw", ""]);
        assert!(table.ends_with("1.50 ms\n"), "{table}");
    }

    #[test]
    fn json_is_one_line() {
        let json = timings().reported(TimingsForm::Json);
        let value: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        assert_eq!(value["passes"][0]["name"], "raster.draw_ids");
        assert_eq!(value["passes"][0]["ms"], 1.5);
        assert_eq!(json.lines().count(), 1);
    }
}
