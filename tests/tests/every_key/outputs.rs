//! The ways in which drawings are made.

use npr_stylesheet::{Facts, LineForm, LineOutput, LineSource, Occasion, Output as Made};

/// A way in which a drawing is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Output {
    /// A frame of the scene, by a method of lines.
    Frame(&'static str),
    /// A frame of smoke alone.
    Smoke,
    /// Lines as curves.
    Lines {
        method: LineSource,
        form: LineForm,
        fill: bool,
    },
}

/// Methods of lines in frames.
pub const METHODS: [&str; 11] = [
    "shape",
    "okuya",
    "filter",
    "hull",
    "filter+hull",
    "edges",
    "rim",
    "angle",
    "strokes",
    "potrace",
    "none",
];

impl Output {
    pub fn all() -> Vec<Self> {
        let lines = |method, form, fill| Self::Lines { method, form, fill };
        let drawings = [
            lines(LineSource::Edges, LineForm::Ink, false),
            lines(LineSource::Edges, LineForm::Ink, true),
            lines(LineSource::Edges, LineForm::Data, false),
            lines(LineSource::Edges, LineForm::Centrelines, false),
            lines(LineSource::Edges, LineForm::Stamps, false),
            lines(LineSource::Surface, LineForm::Ink, false),
            lines(LineSource::Potrace, LineForm::Ink, false),
            lines(LineSource::Image, LineForm::Ink, false),
        ];
        let frames = METHODS.into_iter().map(Self::Frame);
        frames.chain(drawings).chain([Self::Smoke]).collect()
    }

    pub fn name(self) -> String {
        match self {
            Self::Frame(method) => format!("in frames by {method}"),
            Self::Smoke => "in smoke alone".to_owned(),
            Self::Lines { method, form, fill } => {
                let filled = if fill { ", filled" } else { "" };
                format!("in lines by {method:?} as {form:?}{filled}")
            }
        }
    }

    /// Whether a key can be another matter in this output than in frames by `shape`: what is not about lines is no
    /// matter of methods.
    pub fn is_asked(self, path: &str) -> bool {
        let name = path.strip_prefix("rule.0.").unwrap_or(path);
        let is_of_lines =
            name.starts_with("line.") || name.starts_with("detect.") || name == "subject";
        match self {
            Self::Frame("shape") | Self::Lines { .. } | Self::Smoke => true,
            Self::Frame(_) => is_of_lines,
        }
    }

    pub fn occasion(self) -> Occasion {
        let scene = match self {
            Self::Smoke => Facts {
                smoke: true,
                ..Facts::default()
            },
            _ => Facts::ALL,
        };
        let output = match self {
            Self::Frame(_) | Self::Smoke => Made::Frame,
            Self::Lines { method, form, fill } => Made::Lines(LineOutput {
                source: method,
                form,
                fill,
            }),
        };
        Occasion { output, scene }
    }
}
