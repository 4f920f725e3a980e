//! What whole-frame tests share: scenes, drawing, and measures on pictures.
//!
//! ```
//! use npr_tests::{Ink, Object, draw, lines, scene_of};
//!
//! let scene = scene_of(&[Object::new("Ball", npr_mesh::testing::icosphere(3))]);
//! let frame = draw(&scene, &lines("shape"), [64, 36]);
//! assert_eq!(Ink::of(&frame).components().len(), 1);
//! ```
#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "helpers of tests fail by panicking"
)]

mod agreement;
pub mod comic;
mod draw;
mod files;
mod ink;
mod montage;
mod object;
mod png;
mod smoke;
mod toon;
mod wanted;

pub use agreement::Agreement;
pub use draw::{Drawing, draw, draw_from, draw_of, draw_on, draw_with, lines, models_camera};
pub use files::{asset, models, samples};
pub use ink::Ink;
pub use montage::{beside, cropped, enlarged, reduced};
#[cfg(feature = "gpu")]
pub use npr_gpu::device::testing::device;
pub use object::{Object, boxed, crossing_boxes, placed, scene_of};
pub use png::{read_png, write_png};
pub use smoke::{SmokeFilm, draw_smoke, front_camera, orbit_camera};
pub use toon::{stripes, toon_ball};
pub use wanted::Wanted;
