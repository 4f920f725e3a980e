//! Turns the volumes that a command line names into spheres that can be drawn.

mod fault;
mod shots;
mod source;

pub use fault::of_volume;
pub use shots::{DEFAULT_FPS, DEFAULT_STEP, Shots};
pub use source::{USUAL_STYLE, VolumeSource, usual_style};

use crate::arguments::{PlacedVolume, VolumeArguments, VolumeUp};
use crate::fault::{Exit, Fault};
use crate::input::read_file;
use crate::message::quoted;
use crate::progress::Progress;
use fault::{limit_of, of_series};
use npr_core::budget::Budget;
use npr_render::{Following, Smoke, Sphere};
use npr_scene::Limits;
use npr_smoke::file::{UpAxis, VolumeFile, VolumeOptions};
use npr_smoke::film::{self, Moments, Numbered, Series, Simulation};
use npr_smoke::solver::{self, SmokeSettings};
use npr_smoke::{Birthplace, PuffSettings, Puffs, Source, Volume, VolumeError};
use npr_stylesheet::SmokeStyle;
use std::path::PathBuf;

/// The arguments, style and limits that smoke is made by.
#[derive(Debug, Clone, Copy)]
pub struct Order<'a> {
    /// The arguments about volumes.
    pub args: &'a VolumeArguments,
    /// The style of the smoke, with the arguments in place of its own values.
    pub style: &'a SmokeStyle,
    /// The limits on files and memory.
    pub limits: &'a Limits,
}

/// Smoke for one picture or many.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Film {
    /// The smoke of every picture, at least of one. All lie in one space.
    pub frames: Vec<Smoke>,
    /// Number of the frame that the first picture shows.
    pub first: u32,
    /// The files that the smoke was made from.
    pub inputs: Vec<PathBuf>,
    /// Notices for the user about what was guessed, mended or found missing.
    pub notices: Vec<String>,
}

impl Film {
    /// Adds smoke that stands still to every picture.
    pub fn join(&mut self, still: &Smoke, reported: Self) {
        let frames = self.frames.drain(..).map(|smoke| Smoke {
            space: Some(still.clone().with(smoke.clone()).bounds()),
            ..smoke.with(still.clone())
        });
        self.frames = frames.collect();
        self.inputs.extend(reported.inputs);
        self.notices.extend(reported.notices);
    }
}

/// The smoke of a still picture, computed as a step of the work. Without smoke there is no step. See [`still`].
pub fn step(
    progress: &mut Progress,
    order: &Order<'_>,
    own: Option<VolumeSource>,
) -> Result<(Option<Smoke>, Film), Fault> {
    if order.args.volumes.is_empty() && own.is_none() {
        return Ok((None, Film::default()));
    }
    let smoke = progress.step("smoke", || still(order, own))?;
    Ok(smoke.map_or_else(Default::default, |(smoke, reported)| {
        (Some(smoke), reported)
    }))
}

/// The smoke of a still picture: that of `own`, the scene itself where it is a volume, and that of every `--volume`.
/// `None` where there is neither.
pub fn still(order: &Order<'_>, own: Option<VolumeSource>) -> Result<Option<(Smoke, Film)>, Fault> {
    let own = own.map(|source| (source, None));
    let placed = order.args.volumes.iter();
    let placed = placed.map(|volume| (VolumeSource::of(&volume.name), Some(volume)));
    let mut all: Option<(Smoke, Film)> = None;
    for (source, volume) in own.into_iter().chain(placed) {
        if let VolumeSource::Series(_) = source {
            let message = "names a series, but a picture shows one frame: name one of its files";
            return Err(Fault::new(Exit::Usage, format!("--volume: '#' {message}")));
        }
        let mut film = film(&source, order, &Shots::default(), &mut |_, _| {})?;
        let smoke = film.frames.pop().unwrap_or_default();
        let smoke = volume.map_or(smoke.clone(), |volume| placed_at(volume, smoke));
        let (joined, reported) = all.take().unwrap_or_default();
        film.inputs.extend(reported.inputs);
        film.notices.extend(reported.notices);
        all = Some((joined.with(smoke), film));
    }
    Ok(all)
}

/// The smoke, moved and scaled so that the middle of its lowest plane lies where the user placed it.
fn placed_at(volume: &PlacedVolume, smoke: Smoke) -> Smoke {
    let Some((place, scale)) = volume.place else {
        return smoke;
    };
    let (low, high) = smoke.bounds();
    let foot = [(low[0] + high[0]) * 0.5, low[1], (low[2] + high[2]) * 0.5];
    smoke.moved(foot, place.0, scale)
}

/// The smoke of a source at every moment asked for. Spheres follow the smoke from moment to moment. `tell` gets the
/// numbers of finished and of all parts of the work.
///
/// A simulation is always followed from its first frame on, so a frame looks the same alone and in a film.
pub fn film(
    source: &VolumeSource,
    order: &Order<'_>,
    shots: &Shots,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Film, Fault> {
    match source {
        VolumeSource::BuiltIn(source) => simulated(*source, order, shots, tell),
        VolumeSource::Series(series) => read_series(series, order, shots, tell),
        VolumeSource::File(path) => {
            let bytes = read_file(path, order.limits.file_bytes)?;
            let mut film = read_still(&quoted(path), &bytes, order, shots)?;
            film.inputs.push(path.clone());
            Ok(film)
        }
        VolumeSource::Read(name, bytes) => read_still(name, bytes, order, shots),
    }
}

/// The smoke of a simulation at every moment asked for. Without a request, it is that of one frame that shows the
/// smoke well.
fn simulated(
    source: Source,
    order: &Order<'_>,
    shots: &Shots,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Film, Fault> {
    let settings = SmokeSettings {
        size: shots.grid.unwrap_or(source.usual_size()),
        frame_seconds: 1.0 / shots.fps,
        seed: order.args.seed,
        ..SmokeSettings::of(source)
    };
    let mut budget = Budget::new(order.limits.memory_bytes);
    let mut simulation = Simulation::new(solver::Smoke::within(&mut budget, settings)?);
    let telling = source.telling_frame(shots.fps);
    let (first, last) = shots.frames.unwrap_or((telling, telling));

    // Follow the smoke from the simulation's first frame on, whatever frames are drawn.
    let moments = Moments::new(first, last, shots.step, 1);
    let puffs = order.puffs(moments.step, shots.fps, settings.birthplace());
    take_frames(&mut budget, &puffs, &moments)?;
    let read = |frame: u32| Ok::<_, VolumeError>(simulation.read(frame));
    let mut film = film::Film::new(read, u32::MAX, shots.fps, moments);
    let frames = played(&mut film, puffs, tell)?;
    Ok(finished(
        frames,
        first,
        source.hottest(settings.heat),
        Vec::new(),
    ))
}

/// The smoke of one file, which stands still.
fn read_still(name: &str, bytes: &[u8], order: &Order<'_>, shots: &Shots) -> Result<Film, Fault> {
    if shots.frames.is_some_and(|frames| frames != (1, 1)) {
        let message =
            format!("{name} is one frame: --frames needs a series such as smoke_####.vdb");
        return Err(Fault::new(Exit::Usage, message));
    }
    let options = order.options();
    let read = || {
        let file = VolumeFile::read(bytes, &options)?;
        Ok((file.volume(&file.extent())?, file.notices().to_vec()))
    };
    let (volume, mut notices) = read().map_err(|fault| of_volume(name, fault))?;

    // Say what was guessed or mended, and why nothing may be seen.
    notices.extend(volume.mended().notice());
    notices.extend(thin_notice(volume.peak(), order.style));
    let notices = notices
        .into_iter()
        .map(|notice| format!("{name}: {notice}"));
    let notices = notices.collect();

    // Cover the smoke of this one moment with spheres.
    let settings = order.puffs(1.0, shots.fps, Birthplace::Anywhere);
    let smoke = Smoke::of_puffs(&Puffs::new(&volume, settings));
    Ok(finished(vec![smoke], 1, volume.hottest(), notices))
}

/// The smoke of a series of files at every moment asked for. Without a request, it is that of all frames.
fn read_series(
    files: &Numbered,
    order: &Order<'_>,
    shots: &Shots,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Film, Fault> {
    let found = || {
        files.found().ok_or_else(|| {
            let first = quoted(&files.path(1));
            Fault::new(Exit::Failed, format!("there is no file such as {first}"))
        })
    };
    let (first, last) = shots.frames.map_or_else(found, Ok)?;
    let options = order.options();
    let open = |frame: u32| {
        let path = files.path(frame);
        let bytes = read_file(&path, order.limits.file_bytes)?;
        VolumeFile::read(&bytes, &options).map_err(|fault| of_volume(&quoted(&path), fault))
    };
    let mut series = Series::open(first, last, open).map_err(|error| of_series(files, error))?;

    // Follow the smoke from the first frame that is drawn.
    let moments = Moments::new(first, last, shots.step, first);
    let puffs = order.puffs(moments.step, shots.fps, Birthplace::Anywhere);
    take_frames(
        &mut Budget::new(order.limits.memory_bytes),
        &puffs,
        &moments,
    )?;
    let read = |frame: u32| series.read(frame);
    let mut film = film::Film::new(read, last, shots.fps, moments);
    let frames = played(&mut film, puffs, tell).map_err(|error| of_series(files, error))?;
    let estimates = film.has_estimates();
    drop(film);

    // Say what was guessed or mended, frame by frame, then what holds for the whole film.
    let own = series.notices().iter();
    let own = own.map(|(frame, notice)| format!("{}: {notice}", quoted(&files.path(*frame))));
    let mut notices: Vec<String> = own.collect();
    if estimates {
        notices.push("velocities are estimated from densities: the files bring none".to_owned());
    }
    notices.extend(thin_notice(series.peak(), order.style));
    let mut film = finished(frames, first, series.hottest(), notices);
    film.inputs = (first..=last).map(|frame| files.path(frame)).collect();
    Ok(film)
}

/// Takes memory for the smoke of all pictures from the budget.
fn take_frames(
    budget: &mut Budget,
    settings: &PuffSettings,
    moments: &Moments,
) -> Result<(), Fault> {
    let spheres = (settings.count() as usize).saturating_mul(moments.seen);
    budget
        .take("the smoke of all frames", spheres, size_of::<Sphere>())
        .map_err(|error| limit_of(&error))
}

/// The smoke of every moment that is drawn, its heat in the units of the volume.
fn played<R, E>(
    film: &mut film::Film<R>,
    settings: PuffSettings,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Vec<Smoke>, E>
where
    R: FnMut(u32) -> Result<Volume, E>,
    E: From<VolumeError>,
{
    let mut frames = Vec::new();
    film.play(settings, tell, &mut |puffs| {
        frames.push(Smoke::of_puffs(puffs));
    })?;
    Ok(frames)
}

/// A film of these frames: all in one space, with heats from 0 to 1, and every notice once.
fn finished(frames: Vec<Smoke>, first: u32, hottest: f32, mut notices: Vec<String>) -> Film {
    let mut told = std::collections::BTreeSet::new();
    notices.retain(|notice| told.insert(notice.clone()));
    Film {
        frames: Smoke::of_film(frames, hottest),
        first,
        inputs: Vec::new(),
        notices,
    }
}

impl Order<'_> {
    fn options(&self) -> VolumeOptions {
        let args = self.args;
        VolumeOptions {
            density: args.density.clone(),
            velocity: args.velocity.clone(),
            heat: args.heat.clone(),
            up: match args.volume_up {
                VolumeUp::Y => UpAxis::Y,
                VolumeUp::Z => UpAxis::Z,
            },
            memory_limit: self.limits.memory_bytes,
        }
    }

    /// The settings by which spheres follow smoke that advances by `step` frames a picture. `known` is the birthplace
    /// of particles where the user gives none.
    fn puffs(&self, step: f64, fps: f32, known: Birthplace) -> PuffSettings {
        let following = Following {
            step: step as f32,
            fps,
            birthplace: self.args.emitter.map_or(known, Into::into),
            seed: self.args.seed,
        };
        following.settings(self.style)
    }
}

/// The notice about smoke that is nowhere dense enough to be drawn.
fn thin_notice(peak: f32, style: &SmokeStyle) -> Option<String> {
    let threshold = style.puffs.threshold;
    let text = match peak {
        0.0 => "there is no smoke".to_owned(),
        _ => format!(
            "no density is above {threshold}: the greatest is {peak}; --threshold draws thinner smoke"
        ),
    };
    (peak <= threshold).then_some(text)
}
