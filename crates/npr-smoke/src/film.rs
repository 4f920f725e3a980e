//! A film of smoke: spheres that follow it through time, from a series of files or a simulation.
//!
//! A [`Series`] opens numbered files ([`Numbered`]) and puts their volumes on one grid; a [`Simulation`] steps the
//! built-in solver. [`Moments`] say which points in time are followed and which of them are drawn. A [`Film`] joins
//! both: it plays the volumes, estimates the motion that files do not bring, and shows the spheres of every picture.
//!
//! ```no_run
//! use npr_smoke::file::{VolumeFile, VolumeOptions};
//! use npr_smoke::film::{Film, Moments, Numbered, Series};
//! use npr_smoke::{PuffSettings, TrackSettings};
//!
//! let files = Numbered::of("plume_####.vdb".as_ref()).ok_or("no # in the name")?;
//! let (first, last) = files.found().ok_or("no such files")?;
//! let mut series = Series::open(first, last, |frame| {
//!     let bytes = std::fs::read(files.path(frame))?;
//!     Ok::<_, Box<dyn std::error::Error>>(VolumeFile::read(&bytes, &VolumeOptions::default())?)
//! })?;
//! let moments = Moments::new(first, last, 1.0, first);
//! let mut film = Film::new(|frame| series.read(frame), last, 24.0, moments);
//! let settings = PuffSettings::Cover(TrackSettings::default());
//! film.play(settings, &mut |_, _| {}, &mut |puffs| println!("{} spheres", puffs.spheres().len()))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod moments;
mod numbered;
mod series;
mod simulation;

pub use moments::Moments;
pub use numbered::Numbered;
pub use series::{Series, SeriesError};
pub use simulation::Simulation;

use crate::{Footage, PuffSettings, Puffs, Volume, VolumeError};

/// Smoke in the order of time, and the moments of it that are drawn.
#[derive(Debug, Clone)]
pub struct Film<R> {
    footage: Footage<R>,
    moments: Moments,
}

impl<R, E> Film<R>
where
    R: FnMut(u32) -> Result<Volume, E>,
    E: From<VolumeError>,
{
    /// A film whose frames `read` gives by number, in rising order and each once; no frame follows `last`, and `fps`
    /// of them make a second.
    pub fn new(read: R, last: u32, fps: f32, moments: Moments) -> Self {
        Self {
            footage: Footage::new(read, last, 1.0 / fps),
            moments,
        }
    }

    /// Follows the smoke through all moments and shows the spheres of those that are drawn.
    ///
    /// `settings` are those of steps as long as the moments' own. `tell` learns before every moment how many are done,
    /// and of how many. Costs what [`Footage::at`] and [`Puffs::step`] do for every moment; one volume and one set of
    /// spheres are held at a time.
    ///
    /// # Errors
    ///
    /// What reading ends with, or [`VolumeError::DifferentGrids`].
    pub fn play(
        &mut self,
        settings: PuffSettings,
        tell: &mut dyn FnMut(usize, usize),
        show: &mut dyn FnMut(&Puffs),
    ) -> Result<(), E> {
        let mut puffs = None::<Puffs>;
        for number in 0..self.moments.count() {
            tell(number, self.moments.count());

            // Carry the spheres on to the smoke of this moment.
            let volume = self.footage.at(self.moments.at(number))?;
            let puffs = match &mut puffs {
                Some(puffs) => {
                    puffs.step(&volume);
                    puffs
                }
                none => none.insert(Puffs::new(&volume, settings)),
            };
            if self.moments.is_seen(number) {
                show(puffs);
            }
        }
        Ok(())
    }

    /// Whether any velocity that was used is an estimate, because a volume brought none.
    pub fn has_estimates(&self) -> bool {
        self.footage.has_estimates()
    }
}

#[cfg(test)]
mod tests;
