//! `npr doctor`: reports what this machine can do.

use crate::adapter_report::AdapterReport;
use crate::fault::{Exit, Fault};
use crate::hardware;
use crate::message::plain;
use crate::output;
use serde::Serialize;
use std::fmt::Write;

/// The report about this machine.
#[derive(Debug, Clone, Serialize)]
struct Diagnosis {
    version: &'static str,
    os: &'static str,
    arch: &'static str,
    threads: usize,
    adapters: Vec<AdapterReport>,
    /// The engine that `--backend auto` chooses.
    auto: String,
    /// The reason for that choice.
    because: &'static str,
}

/// Prints the report about this machine. A machine without graphics adapters is no error.
pub fn doctor(as_json: bool) -> Result<(), Fault> {
    let diagnosis = Diagnosis::of(hardware::adapters());
    let text = if as_json {
        let json = serde_json::to_string_pretty(&diagnosis)
            .map_err(|error| Fault::new(Exit::Failed, error))?;
        format!("{json}\n")
    } else {
        diagnosis.text()
    };
    output::print(text.as_bytes())
}

impl Diagnosis {
    fn of(adapters: Vec<AdapterReport>) -> Self {
        let threads = rayon::current_num_threads();
        let (auto, because) = choice(&adapters, threads);
        Self {
            version: env!("CARGO_PKG_VERSION"),
            os: std::env::consts::OS,
            arch: std::env::consts::ARCH,
            threads,
            adapters,
            auto,
            because,
        }
    }

    fn text(&self) -> String {
        let mut text = format!(
            "npr {} on {} {}, {} threads\n",
            self.version, self.os, self.arch, self.threads
        );
        for adapter in &self.adapters {
            let _ = writeln!(text, "adapter {}", adapter.text());
        }
        if self.adapters.is_empty() {
            text.push_str("no graphics adapters\n");
        }
        let _ = writeln!(
            text,
            "--backend auto draws on {}: {}",
            plain(&self.auto),
            self.because
        );
        text
    }
}

/// The engine that `--backend auto` chooses, and the reason. `adapters` are sorted, the best first.
fn choice(adapters: &[AdapterReport], threads: usize) -> (String, &'static str) {
    let processor = format!("the processor, {threads} threads");
    match adapters.first() {
        None => (processor, "there is no graphics adapter"),
        Some(adapter) if adapter.kind == "software" => {
            (processor, "all adapters are software, which is slower")
        }
        Some(adapter) => (adapter.name.clone(), "it is the best hardware adapter"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn adapter(kind: &'static str) -> AdapterReport {
        AdapterReport {
            name: "Test\x1b".to_owned(),
            kind,
            backend: "vulkan",
            driver: "driver 1".to_owned(),
            max_image_side: 8192,
            max_binding_bytes: 128 << 20,
            has_clock: true,
        }
    }

    #[test]
    fn only_hardware_is_chosen_by_itself() {
        assert!(choice(&[], 2).0.starts_with("the processor"));
        assert!(
            choice(&[adapter("software")], 2)
                .0
                .starts_with("the processor")
        );
        assert_eq!(
            choice(&[adapter("discrete"), adapter("software")], 2).0,
            "Test\x1b"
        );
    }

    #[test]
    fn the_report_is_plain_text() {
        let text = Diagnosis::of(vec![adapter("discrete")]).text();
        assert!(text.contains("bindings to 128 MiB, clock"), "{text}");
        assert!(!text.contains('\x1b'));
    }
}
