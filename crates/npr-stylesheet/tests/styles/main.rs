//! Styles as they are read, and what they say of lines.

mod line_color;
mod ranges;
mod reading;
