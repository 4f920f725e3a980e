//! Strokes as brushes and hands draw them, in frames and in files.

mod line_parts;
mod stamps;
