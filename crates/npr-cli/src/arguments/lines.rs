//! The arguments of `npr lines`.

use super::{CacheArguments, DrawingArguments};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use npr_core::crease::CreaseFrom;
use npr_drawing::artwork::Page;
use npr_render::{Kind, LineSource};
use std::path::PathBuf;

/// What the user said to `npr lines`.
#[derive(Debug, Args)]
pub struct LinesArguments {
    /// Scene: .glb, .gltf, .vrm, .obj, .stl or .ply; or smoke: .vdb, .npy, plume, puff, explosion or cloud; - reads
    /// standard input.
    #[arg(required_unless_present = "dump_style")]
    pub scene: Option<PathBuf>,
    /// File to write: .svg, .json, .pdf or .png; - writes to standard output [default: the scene's name
    /// with .svg, in the current folder].
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// Format of the output, whatever its name [default: by the name; svg on standard output].
    #[arg(long, value_enum)]
    pub format: Option<LineFormat>,
    /// Which lines.
    #[command(flatten)]
    pub lines: LineArguments,
    /// What is written of them.
    #[command(flatten)]
    pub sheet: SheetArguments,
    /// The drawing.
    #[command(flatten)]
    pub drawing: DrawingArguments,
    /// What is kept.
    #[command(flatten)]
    pub cache: CacheArguments,
}

/// What the user said about which lines are drawn.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Lines")]
pub struct LineArguments {
    /// Kinds of line, with commas between; marked lines are drawn in any case [default: those of the style].
    #[arg(
        long,
        value_name = "KIND,..",
        value_delimiter = ',',
        value_parser = one_of(&Kind::ALL, Kind::name, Kind::meaning)
    )]
    pub kinds: Option<Vec<Kind>>,
    /// Angle in degrees from which an edge is a crease, and no other edge is one [default: the style's, 40 unless it
    /// says otherwise, and creases go on along softer folds]
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = crease_angle)]
    pub crease: Option<f32>,
    /// What that angle lies between [default: the style's, normals unless it says otherwise].
    #[arg(long, value_enum, value_name = "WHAT")]
    pub crease_from: Option<CreaseFromName>,
    /// Angle, in degrees, from which a stroke is cut where it turns sharply; 180 never [default: the style's, 180
    /// unless it says otherwise].
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = split_angle)]
    pub split: Option<f32>,
    /// How contours are found.
    #[arg(
        long,
        default_value = LineSource::default().name(),
        value_parser = one_of(&LineSource::ALL, LineSource::name, LineSource::meaning)
    )]
    pub method: LineSource,
    /// What becomes of lines behind surfaces.
    #[arg(long, value_enum, default_value_t)]
    pub hidden: HiddenLines,
    /// Whether strokes are smoothed, their ends joined, and what is too short to read left out.
    #[arg(long, value_enum, default_value_t)]
    pub smooth: Switch,
    /// Fill visible surfaces with flat colour, one for each object and material: its base colour, with the mean of its
    /// texture where the style shows textures. Smoke alone is filled in any case, but for centrelines.
    #[arg(long)]
    pub fill: bool,
    /// Make strokes of lines painted in textures too, up to 8 pixels wide, as marked lines; alone it means dark ones.
    #[arg(
        long, value_enum, value_name = "TONE", num_args = 0..=1, require_equals = true, default_missing_value = "dark"
    )]
    pub painted: Option<PaintedName>,
    /// Distance up to which vertices are one, as a fraction of each mesh's diagonal: 1e-6 closes the cracks of
    /// most exports.
    #[arg(
        long, value_name = "FRACTION", default_value_t = 0.0, allow_hyphen_values = true, value_parser = weld_tolerance
    )]
    pub weld: f32,
}

/// What the user said about the sheet that lines are written on.
#[derive(Debug, Clone, Default, PartialEq, Args)]
#[command(next_help_heading = "Sheet")]
pub struct SheetArguments {
    /// Paths of .svg, .pdf and .png files.
    #[arg(long, value_enum, default_value_t)]
    pub svg: PathForm,
    /// Fit the drawing on a page, turned to suit it, with 10 mm free on all sides; for .svg and .pdf.
    #[arg(long, value_name = "A4|A3|A5|Letter|WxHmm", value_parser = page)]
    pub page: Option<Page>,
}

/// A file format of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LineFormat {
    /// Vector graphics with a layer for every kind.
    Svg,
    /// Points with depth, width and place in the world, for programs.
    Json,
    /// A page to print.
    Pdf,
    /// Pixels.
    Png,
}

/// What the angle of a crease lies between.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum CreaseFromName {
    /// The file's normals: none where shading runs on smoothly; the faces where the file has no normals.
    Normals,
    /// The faces, whatever the file's normals.
    Faces,
}

impl From<CreaseFromName> for CreaseFrom {
    fn from(name: CreaseFromName) -> Self {
        match name {
            CreaseFromName::Normals => Self::Normals,
            CreaseFromName::Faces => Self::Faces,
        }
    }
}

/// Which painted lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PaintedName {
    /// Dark lines on lighter paint.
    Dark,
    /// Light lines on darker paint.
    Light,
    /// Both, as far as they differ from what is around them on the whole.
    Both,
}

/// What becomes of hidden lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum HiddenLines {
    /// They are left out.
    #[default]
    None,
    /// They lie on a layer of their own.
    Layer,
    /// They are dashed.
    Dashed,
}

/// On or off.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Switch {
    /// It is done.
    #[default]
    On,
    /// It is not.
    Off,
}

/// How paths stand for lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum PathForm {
    /// The ink itself, with its width: filled shapes where widths vary.
    #[default]
    Outline,
    /// The middle of every line, in an order that keeps pen-up ways short: for pen plotters.
    Centreline,
    /// The same as outline, but the strokes of brushes (line.brush) are their image, set down again and again.
    Stamps,
}

/// A parser that chooses one of `all` by its name. The meaning of each becomes its help text.
fn one_of<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    name: fn(T) -> &'static str,
    meaning: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let help = move |one: T| meaning(one).trim_end_matches('.');
    let names = all
        .iter()
        .map(|one| PossibleValue::new(name(*one)).help(help(*one)));
    PossibleValuesParser::new(names).try_map(move |said| {
        let found = all.iter().find(|one| name(**one) == said);
        found.copied().ok_or("must be one of the names")
    })
}

/// Parses a page size.
fn page(text: &str) -> Result<Page, String> {
    Page::parse(text).ok_or_else(|| {
        "must be A3, A4, A5, Letter, or width and height up to 10000 mm such as 200x300mm"
            .to_owned()
    })
}

/// Parses the angle of a crease, 0 to 180 degrees.
fn crease_angle(text: &str) -> Result<f32, String> {
    degrees(text, 0.0)
}

/// Parses the angle from which strokes are cut, 10 to 180 degrees.
fn split_angle(text: &str) -> Result<f32, String> {
    degrees(text, 10.0)
}

/// Parses an angle from `least` to 180 degrees.
fn degrees(text: &str, least: f32) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(degrees) if (least..=180.0).contains(&degrees) => Ok(degrees),
        Ok(_) => Err(format!("must lie between {least} and 180 degrees")),
        Err(_) => Err("must be a number of degrees".to_owned()),
    }
}

/// Parses a weld tolerance: a fraction of a mesh's diagonal, 0 to 0.1.
fn weld_tolerance(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(fraction) if (0.0..=0.1).contains(&fraction) => Ok(fraction),
        Ok(_) => Err("must lie between 0 and 0.1".to_owned()),
        Err(_) => Err("must be a number, such as 1e-6".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_and_fractions_have_bounds() {
        assert_eq!(crease_angle("40"), Ok(40.0));
        assert_eq!(split_angle("180"), Ok(180.0));
        assert!(split_angle("9").is_err());
        assert_eq!(weld_tolerance("1e-6"), Ok(1e-6));
        for text in ["-1", "181", "nan", "inf", "sharp", ""] {
            assert!(crease_angle(text).is_err(), "{text}");
            assert!(split_angle(text).is_err(), "{text}");
            assert!(weld_tolerance(text).is_err(), "{text}");
        }
    }
}
