//! Follows the smoke of a series of OpenVDB files or NumPy arrays, or of the built-in plume:
//! `cargo run -p npr-smoke --example film -- plume_####.vdb 0.5`.

use npr_smoke::file::{VolumeFile, VolumeOptions};
use npr_smoke::film::{Film, Moments, Numbered, Series, Simulation};
use npr_smoke::{PuffSettings, Puffs, Smoke, SmokeSettings, Source, TrackSettings, VolumeError};
use std::error::Error;
use std::path::Path;

/// Frames of the smoke per second.
const FPS: f32 = 24.0;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let files = words.next();
    let step: f64 = words.next().map_or(Ok(1.0), |word| word.parse())?;
    match files {
        Some(pattern) => of_files(Path::new(&pattern), step),
        None => of_simulation(step),
    }
}

/// Smoke of files, all that there are.
fn of_files(pattern: &Path, step: f64) -> Result<(), Box<dyn Error>> {
    let files = Numbered::of(pattern).ok_or("a series has a # where its numbers stand")?;
    let (first, last) = files.found().ok_or("there are no such files")?;
    let options = VolumeOptions::default();
    let mut series = Series::open(first, last, |frame| {
        let bytes = std::fs::read(files.path(frame))?;
        Ok::<_, Box<dyn Error>>(VolumeFile::read(&bytes, &options)?)
    })?;
    let moments = Moments::new(first, last, step, first);
    let mut film = Film::new(|frame| series.read(frame), last, FPS, moments);
    film.play(settings(&moments), &mut |_, _| {}, &mut describe)?;
    println!("the densest voxel holds {}", series.peak());
    Ok(())
}

/// Smoke of a simulation, two seconds of it.
fn of_simulation(step: f64) -> Result<(), Box<dyn Error>> {
    let smoke = Smoke::new(SmokeSettings::of(Source::Plume))?;
    let mut simulation = Simulation::new(smoke);
    let read = |frame| Ok::<_, VolumeError>(simulation.read(frame));
    let moments = Moments::new(1, 48, step, 1);
    let mut film = Film::new(read, u32::MAX, FPS, moments);
    Ok(film.play(settings(&moments), &mut |_, _| {}, &mut describe)?)
}

fn settings(moments: &Moments) -> PuffSettings {
    PuffSettings::Cover(TrackSettings {
        frame_seconds: moments.step as f32 / FPS,
        ..TrackSettings::default()
    })
}

fn describe(puffs: &Puffs) {
    println!("{} spheres", puffs.spheres().len());
}
