//! Strokes as files and pixels: SVG, PDF, JSON, the order that a plotter draws in, filled regions, words.
//!
//! What comes in is a [`Drawing`](npr_vector::stroke::Drawing): points with widths and colours, in pixels, y down.
//! [`artwork`] decides what a file shows of it, in which layers, and on which page; [`svg`], [`pdf`] and [`drawing`]
//! write that, [`json`] the strokes themselves; [`ink`] gives points for the pass that inks a frame, and [`stamps`]
//! where the image of a brush lies. On the way [`fit`] makes cubic curves of points, [`outline`] the outline of a
//! stroke whose width varies, and [`plot`] an order with short ways in the air. [`stubs`] leaves out short lines that
//! end in the open, [`guides`] ends lines where somebody says so, [`overshoot`] lets strokes run on beyond their ends,
//! [`pressure`] makes them swell and thin out by curves, [`room`] thins those that lie side by side, [`taper`] all at
//! their ends, [`hand`] lets them sway and draws them more than once, and [`dash`] cuts them. [`fill`] makes closed
//! regions of what lines enclose, [`lettering`] outlines of words, and [`centreline`] files of centre lines.
//!
//! ```
//! use npr_drawing::svg::{SvgOptions, write_svg};
//! use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};
//!
//! let at = |x: f64, width: f64| StrokePoint { position: [x, 20.0], width, ..StrokePoint::default() };
//! let stroke = Stroke {
//!     id: 1,
//!     kind: Kind::Marked,
//!     occluders: 0,
//!     surface: 0,
//!     closed: false,
//!     part: None,
//!     points: vec![at(10.0, 1.0), at(50.0, 6.0), at(90.0, 1.0)],
//! };
//! let black = StrokeSurface { line_color: [0, 0, 0, 255], ..StrokeSurface::default() };
//! let drawing = Drawing { size: [100, 40], surfaces: vec![black], strokes: vec![stroke], ..Drawing::default() };
//! let svg = write_svg(&drawing, &SvgOptions::default());
//! assert!(svg.starts_with(b"<svg"));
//! ```

mod arc;
pub mod artwork;
pub mod centreline;
mod clip;
mod color_runs;
pub mod dash;
pub mod drawing;
mod ends;
pub mod fill;
pub mod fit;
pub mod guides;
pub mod hand;
pub mod ink;
pub mod json;
pub mod lengths;
pub mod lettering;
mod mark;
mod near;
pub mod outline;
pub mod overshoot;
mod page;
pub mod pdf;
pub mod plot;
pub mod pressure;
pub mod room;
pub mod sampled;
mod seed;
mod stamped;
pub mod stamps;
pub mod stubs;
pub mod svg;
pub mod taper;
#[cfg(test)]
mod test_strokes;
