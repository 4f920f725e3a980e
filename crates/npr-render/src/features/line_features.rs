//! Which passes find and draw the lines of a frame.

use npr_style::compose::Compose;
use npr_stylesheet::{OutlineMethod, Style};

/// How the last pass lays strokes over surfaces.
const STROKE_LAYERS: u32 = Compose::RIBBONS | Compose::LINES_IN_SRGB;

/// What the line methods of a style need, one flag for each group of passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LineFeatures {
    /// Lines are detected on the G-buffer.
    pub mask: bool,
    /// Edges are drawn as ribbons.
    pub ribbons: bool,
    /// What no ribbon explains is stamped.
    pub residual: bool,
    /// Strokes that were found before are drawn.
    pub strokes: bool,
    /// The mask itself is drawn.
    pub filter: bool,
    /// A hull is drawn behind.
    pub hull: bool,
    /// The colour of lines is decided at their place.
    pub paints: bool,
    /// Light changes the width of lines.
    pub light_widths: bool,
    /// Pixels around subjects are drawn.
    pub rim: bool,
    /// Borders between subjects are found, for lines whose colour follows what lies behind them.
    pub contrast: bool,
    /// Layers that the last pass lays over the surfaces.
    pub layers: u32,
}

impl LineFeatures {
    /// No lines at all.
    pub const NONE: Self = Self {
        mask: false,
        ribbons: false,
        residual: false,
        strokes: false,
        filter: false,
        hull: false,
        paints: false,
        light_widths: false,
        rim: false,
        contrast: false,
        layers: 0,
    };

    /// What a style's own method and those of its rules need together.
    pub fn needs(style: &Style) -> Self {
        let rules = style.rule.iter().filter_map(|rule| rule.line.method);
        let own = Self::of_one(style.line.method, style);
        rules.fold(own, |all, method| all.and(Self::of_one(method, style)))
    }

    /// What of it is left for a model without surfaces: strokes alone, which a file may have as geometry.
    pub fn without_surfaces(self) -> Self {
        let strokes = self.strokes;
        Self {
            strokes,
            layers: if strokes { STROKE_LAYERS } else { 0 },
            ..Self::NONE
        }
    }

    fn and(self, other: Self) -> Self {
        Self {
            mask: self.mask || other.mask,
            ribbons: self.ribbons || other.ribbons,
            residual: self.residual || other.residual && !self.filter && !self.rim,
            strokes: self.strokes || other.strokes,
            filter: self.filter || other.filter,
            hull: self.hull || other.hull,
            paints: self.paints || other.paints,
            light_widths: self.light_widths || other.light_widths,
            rim: self.rim || other.rim,
            contrast: self.contrast || other.contrast,
            layers: self.layers | other.layers,
        }
    }

    fn of_one(method: OutlineMethod, style: &Style) -> Self {
        let none = Self::NONE;
        let masked = Self { mask: true, ..none };
        let filter = Self {
            filter: true,
            layers: Compose::OVERLAY,
            ..masked
        };
        match method {
            OutlineMethod::Off | OutlineMethod::Angle => none,
            OutlineMethod::Strokes | OutlineMethod::Potrace => Self {
                strokes: true,
                layers: STROKE_LAYERS,
                ..none
            },
            OutlineMethod::Shape => {
                let residual = style.line.kinds.intersection;
                let stamps = if residual { Compose::OVERLAY } else { 0 };
                Self {
                    ribbons: true,
                    residual,
                    layers: Compose::RIBBONS | stamps,
                    ..masked
                }
            }
            OutlineMethod::Okuya | OutlineMethod::Edges => Self {
                ribbons: true,
                layers: Compose::RIBBONS,
                ..masked
            },
            OutlineMethod::Filter => filter,
            OutlineMethod::Hull => Self { hull: true, ..none },
            OutlineMethod::Rim => Self {
                rim: true,
                layers: Compose::OVERLAY,
                ..none
            },
            OutlineMethod::FilterHull => Self {
                hull: true,
                ..filter
            },
        }
    }
}
