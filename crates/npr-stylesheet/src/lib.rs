//! The look of a picture, as data.
//!
//! [`Style`] is the only description of a look: a tree of plain structs that style files, overrides, presets and the
//! JSON Schema ([`schema()`]) all come from. The arithmetic that draws by it is in `npr-style`.
//!
//! ```
//! use npr_stylesheet::{Length, Style, Unit};
//!
//! let file = r##"
//!     extends = "ink"
//!     line.color = "#402010"
//!
//!     [[rule]]
//!     match.material = "Glass*"
//!     line.on = false
//! "##;
//! let no_files = |parent: &str| Err(format!("there is no '{parent}' here"));
//! let mut style = Style::from_toml(file, &no_files)?;
//! style.set("line.width.base=2px")?;
//!
//! assert_eq!(style.line.width.base, Length { value: 2.0, unit: Unit::Px });
//! assert!(!style.resolve_for("Glass_front", "Lamp").line_on);
//!
//! let slip = Style::from_toml("line.widht.gain = 2", &no_files);
//! assert_eq!(
//!     slip.unwrap_err().to_string(),
//!     "unknown key 'line.widht' at line 1, column 6; did you mean 'line.width'?"
//! );
//! # Ok::<(), npr_stylesheet::StyleError>(())
//! ```

mod antialias;
mod background;
mod beam;
pub mod blend;
mod brush;
mod check;
mod color;
mod contradiction;
mod dash;
mod decided;
mod derived_style;
mod detect;
mod error;
mod field;
mod former;
mod glob;
mod hand;
mod highlight;
mod id_map;
mod id_region;
mod idle;
mod ink;
mod key;
mod layers;
mod lettering;
mod light;
mod line;
mod line_background;
mod line_kinds;
mod line_notice;
mod line_paint;
mod look;
pub mod motion;
mod named_picture;
mod nearest;
mod overlay;
mod parents;
mod place;
mod potrace;
mod preset;
mod ramp;
mod rule;
mod scene_hints;
mod schema;
mod set;
mod shade;
mod smoke;
mod stated;
mod style;
mod style_file;
mod taper;
mod width;

pub use antialias::Antialias;
pub use background::{Background, BackgroundError};
pub use beam::{Beam, BeamOverlap, BeamStop, RuleBeam};
pub use blend::Blend;
pub use brush::{BrushMapping, LineBrush, Paper, RuleLineBrush, RuleStamp, Stamp};
pub use color::{Color, ColorError};
pub use dash::{Dash, RuleDash};
pub use decided::Decided;
pub use detect::{DepthTest, Detect, IdTest, MASK_LINE_PX, NormalTest, WidthWarning, width_rule};
pub use error::{Problem, SourceLocation, StyleError};
pub use field::{Field, Form, fields};
pub use hand::{Hand, RuleHand};
pub use highlight::{
    Back, Edge, Highlight, HighlightModel, RuleBack, RuleHighlight, RuleStreak, Streak,
};
pub use id_map::{ID_MAPS_MAX, IDS_MAX, IdMap, NamedId};
pub use id_region::IdRegion;
pub use idle::{Facts, LineForm, LineOutput, Occasion, Output};
pub use ink::{Follow, Ink, Mapping, RuleHatch, RuleInk, StrokeSpace, Tone};
pub use layers::{PARENTS_MAX, TEXT_BYTES_MAX};
pub use lettering::{LETTERING_MAX, Lettering, LetteringOutline};
pub use light::{ExtraLight, Light, LightShape, LightSpace};
pub use line::{CREASE_ANGLE_DEG, CardLines, CreaseFrom, Line, LineVisibility, OutlineMethod};
pub use line_background::{
    BackgroundMethod, Direction, Likeness, LineBackground, LineScope, LineStart, Measure,
    RuleBackground, Subjects,
};
pub use line_kinds::{KindColors, Kinds};
pub use line_paint::{
    DepthSpace, HUE_STOPS_MAX, HueStop, LineColorSource, LineDepth, LineLight, LinePaint,
    RuleLineDepth, RuleLineLight, RulePaint, hue_row,
};
pub use look::Look;
pub use motion::{Motion, RuleMotion};
pub use parents::Parents;
pub use potrace::Potrace;
pub use preset::{DEFAULT_PRESET, Preset, find as find_preset, presets};
pub use ramp::Stop;
pub use rule::{Match, PartNames, Rule, RuleLine, RuleShade};
pub use scene_hints::{SceneHint, SceneHints};
pub use schema::schema;
pub use shade::{Shade, ShadeMode, levels};
pub use smoke::{
    SmokeInk, SmokeLine, SmokeLines, SmokeMethod, SmokeParticles, SmokePlacement, SmokePuffs,
    SmokeStop, SmokeStyle,
};
pub use stated::Stated;
pub use style::Style;
pub use taper::{RuleTaper, Taper, TaperEnds};
pub use width::{Channel, ControlPoint, RuleWidth, Width, WidthDepth, WidthSource, WidthStop};

pub use npr_core::line_source::LineSource;
pub use npr_style::brush::Tip;
pub use npr_style::hatch::{Hatch, Pattern};
pub use npr_style::{LONGEST, Length, LengthError, REFERENCE_HEIGHT_PX, Unit};
