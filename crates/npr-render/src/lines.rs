//! A scene as lines: strokes instead of pixels.

mod assembly;
mod cards;
mod colors;
mod expression;
mod film;
mod finder;
mod framing;
mod guides;
mod image;
mod laid;
mod model;
mod options;
mod paint;
mod pixels;
mod posing;
mod prepared;
mod recent;
mod renderer;
mod smear;
mod smoke;
mod stroke_contrast;
mod texture_map;
mod tones;
mod view;
mod welded;
mod why;
mod widths;

pub(crate) use expression::Expression;
pub use film::HeldLines;
pub use model::LineModel;
pub use npr_core::line_kind::KindSet;
pub use npr_core::line_source::LineSource;
pub use options::{LineModelOptions, LineOptions, PaintedLines};
pub(crate) use renderer::Behind;
pub use renderer::LineRenderer;
pub use why::{Fact, LineReason, Pointed, PointedPart, Removal, Spot};
