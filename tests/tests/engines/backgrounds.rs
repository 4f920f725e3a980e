//! Outlines before backgrounds, in frames of both engines: held against geometry, against the publication's two
//! pictures, and against what a reader sees.

mod fixture;
mod parts;
mod reading;
mod samples;
mod widths;
