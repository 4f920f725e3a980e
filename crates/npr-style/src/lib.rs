//! The arithmetic of a drawing's looks: tones, hatching, highlights, shadows, beams, the colours of lines, smoke.
//!
//! Pure functions of numbers, one module for each part of a frame. They are the twins of the shaders of the same
//! names: what a device draws is tested against them, and the engine of the CPU runs them. Style files and their keys
//! are in `npr-stylesheet`.
//!
//! ```
//! use npr_style::ramp::{Level, ramp_coordinate, ramp_light};
//!
//! let tone = |at, light| Level { at, light: [light; 3] };
//! let cel = [tone(0.0, 0.4), tone(0.5, 1.0)];
//! assert_eq!(ramp_light(&cel, 0.0, ramp_coordinate(-0.2)), [0.4; 3]);
//! assert_eq!(ramp_light(&cel, 0.0, ramp_coordinate(0.2)), [1.0; 3]);
//! ```
//!
//! With the feature `serde`, lengths and hatches are read from style files and described by their JSON Schema.

pub mod backdrop;
pub mod beam;
pub mod brush;
pub mod compose;
mod corners;
pub mod cut_tone;
mod dome;
pub mod draw_mask;
pub mod even_tones;
pub mod gloss;
pub mod hatch;
mod ink_step;
pub mod inking;
mod length;
pub mod lighting;
pub mod line_color;
mod luminance;
pub mod paint;
pub mod picture_depth;
pub mod ramp;
pub mod shadow;
pub mod sky;
pub mod smoke;
mod surface_color;
mod tone;
pub mod tone_row;
pub mod toon;
mod triangle_constants;

pub use length::{LONGEST, Length, LengthError, REFERENCE_HEIGHT_PX, Unit};
