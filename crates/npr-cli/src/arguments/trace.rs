//! The arguments of `npr trace`.

use super::LimitArguments;
use super::trace_form::TraceFormArguments;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use npr_drawing::fill::mesh::MeshFormat;
use npr_trace::{TraceFormat, TraceOptions, TurnPolicy};
use std::path::PathBuf;

/// What the user said to `npr trace`.
#[derive(Debug, Args)]
pub struct TraceArguments {
    /// Bitmaps: .png, .jpg, .webp, .pbm, .pgm, .ppm, .tif or .bmp, told by their content; - reads standard input.
    #[arg(required = true, value_name = "BITMAP")]
    pub bitmaps: Vec<PathBuf>,
    /// File to write: .svg, .pdf, .json, .geojson, or filled shapes as triangles in .obj or .glb; of several bitmaps
    /// the folder for their files; - writes to standard output [default: the bitmap's name with .svg, in the current
    /// folder].
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Format of the output, whatever its name [default: by the name; svg for folders and standard output].
    #[arg(long, value_enum)]
    pub format: Option<TracedFormat>,
    /// How paths are found.
    #[command(flatten)]
    pub method: TraceMethodArguments,
    /// What becomes of the ink.
    #[command(flatten)]
    pub form: TraceFormArguments,
    /// Show no progress and no warnings.
    #[arg(short, long)]
    pub quiet: bool,
    /// Safety limits.
    #[command(flatten)]
    pub limits: LimitArguments,
}

/// How paths are found; names and defaults are those of the program Potrace.
#[derive(Debug, Clone, PartialEq, Args)]
#[command(next_help_heading = "Tracing")]
pub struct TraceMethodArguments {
    /// Leave out shapes and holes of up to this many pixels.
    #[arg(short, long, value_name = "PIXELS", default_value_t = TraceOptions::default().turd_size)]
    pub turdsize: u64,
    /// Which colour hangs together where pixels meet at a corner only.
    #[arg(
        short = 'z', long, value_name = "POLICY", default_value = TurnPolicy::default().name(),
        value_parser = turn_policies()
    )]
    pub turnpolicy: TurnPolicy,
    /// Sharpness from which a bend is a corner: 0 makes polygons, 1.34 rounds everything.
    #[arg(short, long, value_name = "N", default_value_t = TraceOptions::default().alpha_max)]
    #[arg(allow_hyphen_values = true, value_parser = not_negative)]
    pub alphamax: f64,
    /// How far curves may stray where they are joined, in pixels.
    #[arg(short = 'O', long, value_name = "N", default_value_t = usual_tolerance())]
    #[arg(allow_hyphen_values = true, value_parser = not_negative)]
    pub opttolerance: f64,
    /// Do not join curves.
    #[arg(short = 'n', long)]
    pub longcurve: bool,
    /// Brightness up to which a pixel is ink, of 0 to 1; transparent pixels are laid over white.
    #[arg(short = 'k', long, value_name = "N", default_value_t = 0.5, allow_hyphen_values = true, value_parser = level)]
    pub blacklevel: f64,
    /// Trace what is white.
    #[arg(short, long)]
    pub invert: bool,
}

impl TraceMethodArguments {
    /// The options of the tracer that the arguments describe.
    pub fn options(&self) -> TraceOptions {
        TraceOptions {
            turd_size: self.turdsize,
            turn_policy: self.turnpolicy,
            alpha_max: self.alphamax,
            join_tolerance: (!self.longcurve).then_some(self.opttolerance),
        }
    }
}

/// Default of `--opttolerance`, in pixels.
fn usual_tolerance() -> f64 {
    let usual = TraceOptions::default().join_tolerance;
    usual.unwrap_or_default()
}

/// A file format of traced bitmaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TracedFormat {
    /// Vector graphics.
    Svg,
    /// A page to print.
    Pdf,
    /// Outlines with their segments, for programs.
    Json,
    /// Polygons, for maps and geometry libraries.
    Geojson,
    /// Triangles.
    Obj,
    /// Triangles, as binary glTF.
    Glb,
}

impl TracedFormat {
    /// All formats, with the extensions of their files.
    pub const ENDINGS: [(Self, &str); 6] = [
        (Self::Svg, "svg"),
        (Self::Pdf, "pdf"),
        (Self::Json, "json"),
        (Self::Geojson, "geojson"),
        (Self::Obj, "obj"),
        (Self::Glb, "glb"),
    ];

    /// The format as the writers of files take it.
    pub fn form(self) -> TracedForm {
        match self {
            Self::Svg => TracedForm::Curves(TraceFormat::Svg),
            Self::Pdf => TracedForm::Curves(TraceFormat::Pdf),
            Self::Json => TracedForm::Curves(TraceFormat::Json),
            Self::Geojson => TracedForm::Curves(TraceFormat::GeoJson),
            Self::Obj => TracedForm::Mesh(MeshFormat::Obj),
            Self::Glb => TracedForm::Mesh(MeshFormat::Glb),
        }
    }
}

/// The contents of a file of a traced bitmap: curves or triangles, in one of their formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TracedForm {
    /// Curves.
    Curves(TraceFormat),
    /// Filled shapes as triangles.
    Mesh(MeshFormat),
}

/// A parser of names of turn policies, which lists all of them in the help.
fn turn_policies() -> impl TypedValueParser<Value = TurnPolicy> {
    let names =
        TurnPolicy::ALL.map(|policy| PossibleValue::new(policy.name()).help(policy.meaning()));
    PossibleValuesParser::new(names).try_map(|name| {
        let mut policies = TurnPolicy::ALL.into_iter();
        policies
            .find(|policy| policy.name() == name)
            .ok_or("no such policy")
    })
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1e6).contains(&value) => Ok(value),
        _ => Err("must be a number from 0 to 1000000".to_owned()),
    }
}

fn level(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("must be a number from 0 to 1".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_bounds() {
        assert_eq!((not_negative("1.3"), level("0.5")), (Ok(1.3), Ok(0.5)));
        for text in ["-1", "nan", "inf", "much", ""] {
            assert!(
                not_negative(text).is_err() && level(text).is_err(),
                "{text}"
            );
        }
        assert!(level("1.01").is_err());
    }
}
