//! Whole frames on the processor: looks of comics, smoke, bad geometry, and pictures that must stay as they are.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod ages;
mod bad_geometry;
mod blends;
mod comic;
mod comic_look;
mod determinism;
mod followed_motion;
mod smoke;
mod snapshots;
mod speed_lines;
mod stroke_directions;
mod tone_pictures;
mod toons;
