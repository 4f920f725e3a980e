//! The options of line models and of drawings.

use crate::look;
use npr_core::crease::{CreaseFrom, Creases};
use npr_core::line_kind::{Kind, KindSet};
use npr_core::line_source::LineSource;
use npr_stylesheet::Style;
use npr_vector::image_lines::{PaintedRule, PaintedTone};
use npr_vector::pixel_strokes::PublishedPath;

/// How a scene is prepared for line drawings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineModelOptions {
    /// Distance up to which vertices are one, as a fraction of each mesh's diagonal; default 0, equal positions only.
    ///
    /// 1e-6 closes the cracks of most exports, which would show as boundaries. See [`npr_mesh::weld()`].
    pub weld: f32,
    /// Most bytes that may be planned; default 4 GiB.
    pub memory_limit: u64,
    /// Whether textures are kept to find painted lines in ([`LineOptions::painted`]); default false.
    ///
    /// The scene's images have to be there, and [`LineModel::for_style`](super::LineModel::for_style) to make the
    /// model.
    pub painted: bool,
    /// Whether regions of drawings take the mean colours of textures; default false, and they have base colours alone.
    ///
    /// As for `painted`, the scene's images have to be there.
    pub fills: bool,
}

impl Default for LineModelOptions {
    fn default() -> Self {
        Self {
            weld: 0.0,
            memory_limit: 4 << 30,
            painted: false,
            fills: false,
        }
    }
}

/// The kinds that a style draws, and marked lines, which somebody asked for by hand.
fn kinds_of(style: &Style) -> KindSet {
    let wanted = style.line.kinds.set().kinds();
    wanted.chain([Kind::Marked]).collect()
}

/// Which lines a drawing has, and how they are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineOptions {
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// The kinds that are drawn; default all.
    pub kinds: KindSet,
    /// Angle in radians from which an edge is a crease; default that of styles, 40 degrees.
    pub crease: f32,
    /// What that angle lies between; default the file's normals.
    pub crease_from: CreaseFrom,
    /// By how much less an edge may fold where a crease goes on along it, in radians; default 0. Of lines on meshes.
    pub crease_slack: f32,
    /// Angle in radians between faces from which an edge is a crease however smooth the file's normals; default pi,
    /// none. Of lines on meshes.
    pub crease_hard: f32,
    /// Width of the widest rounding that is a crease all the same, as a share of the scene's radius; default 0, none.
    /// Of lines on meshes.
    pub crease_round: f32,
    /// How contours are found; default along mesh edges.
    pub method: LineSource,
    /// Whether strokes are smoothed, their ends joined, and what is too short to read left out; default true.
    pub smooth: bool,
    /// Whether hidden lines are given too, each with the number of surfaces in front; default false.
    pub hidden: bool,
    /// Turn, in radians, from which strokes are cut at a corner, both parts ending exactly there; default never.
    ///
    /// Brushes taper at the ends of strokes: 60 degrees gives a box strokes along its sides instead of one around it.
    pub split: Option<f32>,
    /// Whether visible surfaces are given as regions of flat colour; default false.
    pub fill: bool,
    /// Pixels per inch, for widths in millimetres; default 96.
    pub dpi: f32,
    /// The constants of [`LineSource::Potrace`], for which `smooth` is about places only.
    pub potrace: PublishedPath,
    /// Depth jump, as a share of the picture's height at that depth, from which [`LineSource::Image`] separates
    /// surfaces by a line.
    pub depth_threshold: f32,
    /// Which lines painted in textures are strokes of kind [`Kind::Marked`], whatever the method; default none.
    pub painted: Option<PaintedLines>,
}

/// Which lines painted in textures count, by their contrast with the paint beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PaintedLines {
    /// Dark lines on lighter paint.
    #[default]
    Dark,
    /// Light lines on darker paint.
    Light,
    /// Both, where they differ from the paint around them as a whole: a gap between two lines is no line.
    Both,
}

impl PaintedLines {
    /// The rules that find such lines in a texture, one for each tone.
    pub(crate) fn rules(self) -> Vec<PaintedRule> {
        let rule = |tone| PaintedRule {
            tone,
            on_ground: self == Self::Both,
            ..PaintedRule::default()
        };
        match self {
            Self::Dark => vec![rule(PaintedTone::Dark)],
            Self::Light => vec![rule(PaintedTone::Light)],
            Self::Both => vec![rule(PaintedTone::Dark), rule(PaintedTone::Light)],
        }
    }
}

impl LineOptions {
    /// All visible lines of a picture of `size` pixels, smoothed.
    pub fn new(size: [u32; 2]) -> Self {
        Self {
            size,
            kinds: KindSet::ALL,
            crease: npr_stylesheet::CREASE_ANGLE_DEG.to_radians(),
            crease_from: CreaseFrom::default(),
            crease_slack: 0.0,
            crease_hard: std::f32::consts::PI,
            crease_round: 0.0,
            method: LineSource::default(),
            smooth: true,
            hidden: false,
            split: None,
            fill: false,
            dpi: 96.0,
            potrace: PublishedPath::default(),
            depth_threshold: Style::default().detect.depth_threshold(),
            painted: None,
        }
    }

    /// The lines that a style asks for: its kinds, its angles of creases, and that of corners where strokes are cut.
    ///
    /// The style's own `line.method` is a matter of pictures and plays no part.
    pub fn of_style(style: &Style, size: [u32; 2]) -> Self {
        Self {
            kinds: kinds_of(style),
            crease: style.line.crease_angle_deg.to_radians(),
            crease_from: look::creases(style).from,
            crease_slack: style.line.crease_slack_deg.to_radians(),
            crease_hard: style.line.crease_hard_deg.to_radians(),
            crease_round: style.line.crease_round,
            split: Self::split_at(style.line.split_angle_deg),
            potrace: style.line.potrace.path(),
            depth_threshold: style.detect.depth_threshold(),
            ..Self::new(size)
        }
    }

    /// Which edges are creases for methods of pixels: by the angle alone.
    pub(crate) fn creases_of_pixels(&self) -> Creases {
        Creases::over(self.crease, self.crease_from)
    }

    /// Which edges of a scene of this radius are creases.
    pub(crate) fn creases(&self, radius: f32) -> Creases {
        Creases::with_slack(self.crease, self.crease_slack, self.crease_from)
            .with_hard_folds(self.crease_hard)
            .with_roundings(self.crease_round.max(0.0) * radius)
    }

    /// What [`LineOptions::split`] is for an angle in degrees: no line turns by more than 180, which stands for never.
    pub fn split_at(angle_deg: f32) -> Option<f32> {
        (angle_deg < 180.0).then(|| angle_deg.to_radians())
    }
}
