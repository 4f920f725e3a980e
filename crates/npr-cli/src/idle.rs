//! Options that cannot act beside the others, each with the reason.

use crate::arguments::{
    HiddenLines, LineFormat, LinesArguments, MethodName, PathForm, SmokeArguments, Switch,
    TraceArguments, VolumeArguments, VolumeUp,
};
use crate::line_job::LineJob;
use crate::volume::{DEFAULT_FPS, VolumeSource};
use npr_style::Facts;

/// An option that cannot act where something is so.
struct Entry<T> {
    /// As it is written.
    option: &'static str,
    /// Whether the user asked for something by it.
    is_said: fn(&T) -> bool,
    /// Whether that changes nothing.
    is_idle: fn(&T) -> bool,
    /// What is said.
    why: &'static str,
}

/// What to tell the user of options that cannot act.
fn told<T>(entries: &[Entry<T>], case: &T) -> Vec<String> {
    let idle = entries
        .iter()
        .filter(|entry| (entry.is_said)(case) && (entry.is_idle)(case));
    let mut told: Vec<&str> = Vec::new();
    let first = idle.filter(|entry| {
        let is_new = !told.contains(&entry.option);
        told.push(entry.option);
        is_new
    });
    first
        .map(|entry| format!("{} is ignored: {}", entry.option, entry.why))
        .collect()
}

/// What volumes are drawn, with what was said about them.
struct Volumes<'a> {
    said: &'a VolumeArguments,
    /// Whether there are any.
    is_any: bool,
    /// Whether any comes from a file.
    is_of_file: bool,
}

/// Options of volumes that cannot act.
fn volume_entries<'a>() -> Vec<Entry<Volumes<'a>>> {
    vec![
        Entry {
            option: "--spheres",
            is_said: |c| c.said.spheres.is_some(),
            is_idle: |c| !c.is_any,
            why: NO_SMOKE,
        },
        Entry {
            option: "--threshold",
            is_said: |c| c.said.threshold.is_some(),
            is_idle: |c| !c.is_any,
            why: NO_SMOKE,
        },
        Entry {
            option: "--detail",
            is_said: |c| c.said.detail.is_some(),
            is_idle: |c| !c.is_any,
            why: NO_SMOKE,
        },
        Entry {
            option: "--seed",
            is_said: |c| c.said.seed != 0,
            is_idle: |c| !c.is_any,
            why: "it is about smoke, of which the scene has none",
        },
        Entry {
            option: "--density",
            is_said: |c| c.said.density.is_some(),
            is_idle: |c| !c.is_of_file,
            why: NO_FILE,
        },
        Entry {
            option: "--velocity",
            is_said: |c| !c.said.velocity.is_empty(),
            is_idle: |c| !c.is_of_file,
            why: NO_FILE,
        },
        Entry {
            option: "--heat",
            is_said: |c| c.said.heat.is_some(),
            is_idle: |c| !c.is_of_file,
            why: NO_FILE,
        },
        Entry {
            option: "--volume-up",
            is_said: |c| c.said.volume_up != VolumeUp::Y,
            is_idle: |c| !c.is_of_file,
            why: NO_FILE,
        },
    ]
}

const NO_SMOKE: &str = "the scene has no smoke";
const NO_FILE: &str = "no smoke comes from a volume file";

/// What to tell of options about volumes, where the scene itself is `own`, if it is a volume.
pub fn of_volumes(said: &VolumeArguments, own: Option<&VolumeSource>) -> Vec<String> {
    let named: Vec<VolumeSource> = said
        .volumes
        .iter()
        .map(|volume| VolumeSource::of(&volume.name))
        .collect();
    let mut all = named.iter().chain(own);
    let is_of_file = all
        .clone()
        .any(|source| !matches!(source, VolumeSource::BuiltIn(_)));
    let case = Volumes {
        said,
        is_any: all.next().is_some(),
        is_of_file,
    };
    told(&volume_entries(), &case)
}

/// A drawing of lines.
struct Lines<'a> {
    said: &'a LinesArguments,
    format: LineFormat,
    facts: Facts,
}

impl Lines<'_> {
    fn is_plotted(&self) -> bool {
        self.format == LineFormat::Svg && self.said.sheet.svg == PathForm::Centreline
    }
}

/// Options of drawings of lines that cannot act.
fn line_entries<'a>() -> Vec<Entry<Lines<'a>>> {
    vec![
        Entry {
            option: "--painted",
            is_said: |c| c.said.lines.painted.is_some(),
            is_idle: |c| !c.facts.textures,
            why: "the scene has no textures",
        },
        Entry {
            option: "--svg",
            is_said: |c| c.said.sheet.svg != PathForm::Outline,
            is_idle: |c| c.format != LineFormat::Svg,
            why: "the file is no .svg",
        },
        Entry {
            option: "--fill",
            is_said: |c| c.said.lines.fill,
            is_idle: |c| c.format == LineFormat::Json || c.is_plotted(),
            why: "the file holds lines alone",
        },
        Entry {
            option: "--background",
            is_said: |c| c.said.drawing.look.background.is_some(),
            is_idle: |c| c.format == LineFormat::Json || c.is_plotted(),
            why: "the file holds lines alone",
        },
        Entry {
            option: "--hidden",
            is_said: |c| c.said.lines.hidden == HiddenLines::Dashed,
            is_idle: |c| c.format == LineFormat::Json,
            why: "the file tells how many surfaces hide a line, and has no dashes",
        },
        Entry {
            option: "--smooth",
            is_said: |c| c.said.lines.smooth == Switch::Off,
            is_idle: |c| c.said.lines.method == MethodName::Image,
            why: "--method image follows pixels, which are smoothed in any case",
        },
    ]
}

/// What to tell of options of a drawing of lines.
pub fn of_lines(job: &LineJob<'_>, facts: Facts) -> Vec<String> {
    let case = Lines {
        said: job.said,
        format: job.format,
        facts,
    };
    told(&line_entries(), &case)
}

/// Pictures of smoke, and how many there are.
struct Smoke<'a> {
    said: &'a SmokeArguments,
    source: &'a VolumeSource,
    count: usize,
}

/// Options of pictures of smoke that cannot act.
fn smoke_entries<'a>() -> Vec<Entry<Smoke<'a>>> {
    vec![
        Entry {
            option: "--step",
            is_said: |c| c.said.step != 1.0,
            is_idle: |c| c.count < 2,
            why: "one frame is drawn",
        },
        Entry {
            option: "--fps",
            is_said: |c| c.said.fps != DEFAULT_FPS,
            is_idle: |c| matches!(c.source, VolumeSource::File(_) | VolumeSource::Read(..)),
            why: "a single volume file stands still",
        },
    ]
}

/// What to tell of options of `count` pictures of smoke.
pub fn of_smoke(said: &SmokeArguments, source: &VolumeSource, count: usize) -> Vec<String> {
    told(
        &smoke_entries(),
        &Smoke {
            said,
            source,
            count,
        },
    )
}

const TRACE: &[Entry<TraceArguments>] = &[
    Entry {
        option: "--turnpolicy",
        is_said: |c| c.method.turnpolicy != npr_vector::trace::TurnPolicy::default(),
        is_idle: |c| c.form.centreline,
        why: NO_OUTLINES,
    },
    Entry {
        option: "--alphamax",
        is_said: |c| c.method.alphamax != 1.0,
        is_idle: |c| c.form.centreline,
        why: NO_OUTLINES,
    },
    Entry {
        option: "--opttolerance",
        is_said: |c| c.method.opttolerance != 0.2,
        is_idle: |c| c.form.centreline,
        why: NO_OUTLINES,
    },
    Entry {
        option: "--longcurve",
        is_said: |c| c.method.longcurve,
        is_idle: |c| c.form.centreline,
        why: NO_OUTLINES,
    },
    Entry {
        option: "--opttolerance",
        is_said: |c| c.method.opttolerance != 0.2,
        is_idle: |c| c.method.longcurve,
        why: "--longcurve joins no curves",
    },
];

const NO_OUTLINES: &str = "it is about outlines, and --centreline traces the middle of lines";

/// What to tell of options of a tracing.
pub fn of_trace(said: &TraceArguments) -> Vec<String> {
    told(TRACE, said)
}
