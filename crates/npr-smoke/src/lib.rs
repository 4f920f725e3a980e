//! Smoke as volumes, and the spheres that drawn smoke is made of [Hoshino 2004].
//!
//! A [`Volume`] is one moment of smoke: from a file, or from the built-in solver [`Smoke`]. [`Distances`] says how
//! large a sphere may be at every place in it. [`Particles`] with [`sphere::around_particles`] are the spheres of the
//! paper; [`Track`] covers the smoke with fewer, which live on from frame to frame without popping. [`Puffs`] are
//! either, as a user may choose. [`mod@file`] reads volumes from OpenVDB files and NumPy arrays; [`film`] follows a
//! whole series of them, or a simulation.
//!
//! ```
//! use npr_smoke::{Smoke, SmokeSettings, Source, Track, TrackSettings};
//!
//! let mut smoke = Smoke::new(SmokeSettings::of(Source::Plume))?;
//! smoke.step();
//! let mut track = Track::new(&smoke.volume(), TrackSettings::default());
//! for _ in 1..12 {
//!     smoke.step();
//!     track.step(&smoke.volume());
//! }
//! let spheres = track.spheres();
//! assert!(spheres.iter().all(|sphere| sphere.center.y > 0.0 && sphere.radius < 0.5));
//! # Ok::<(), npr_smoke::SmokeError>(())
//! ```
//!
//! Everything gives the same bits on every platform and for any number of threads.

pub mod cover;
pub mod distance;
pub mod file;
pub mod film;
pub mod footage;
mod lattice;
pub mod motion;
pub mod particle;
pub mod puffs;
mod random;
pub mod solver;
pub mod sphere;
#[cfg(test)]
mod testing;
pub mod track;
pub mod volume;

pub use distance::Distances;
pub use footage::Footage;
pub use particle::{Birthplace, Particle, ParticleSettings, Particles};
pub use puffs::{PuffSettings, Puffs};
pub use solver::{Smoke, SmokeError, SmokeSettings, Source};
pub use sphere::{Sphere, covered_share};
pub use track::{Placement, Track, TrackSettings};
pub use volume::{MAX_SIDE, Mended, Volume, VolumeError};

/// The examples of the README, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
