//! Volumes that a command line names, turned into spheres that can be drawn.

use crate::arguments::{PlacedVolume, VolumeArguments, VolumeUp};
use crate::fault::{Exit, Fault};
use crate::input::read_file;
use crate::message::quoted;
use crate::moments::Moments;
use crate::numbered::Numbered;
use crate::progress::Progress;
use npr_core::budget::Budget;
use npr_render::volume::{Extent, mended_notice};
use npr_render::{Following, Smoke, Sphere, UpAxis, VolumeFault, VolumeFile, VolumeOptions};
use npr_scene::Limits;
use npr_smoke::solver::{self, SmokeError, SmokeSettings};
use npr_smoke::{Birthplace, Footage, PuffSettings, Puffs, Source, Volume};
use npr_stylesheet::SmokeStyle;
use std::path::{Path, PathBuf};

/// Frames from one picture to the next where nothing is said.
pub const DEFAULT_STEP: f64 = 1.0;

/// Frames per second where none are said.
pub const DEFAULT_FPS: f32 = 24.0;

/// The preset of smoke that has none of its own.
pub const USUAL_STYLE: &str = "smoke-cel-2";

/// The preset that suits a source.
pub fn usual_style(source: &VolumeSource) -> &'static str {
    match source {
        VolumeSource::BuiltIn(Source::Explosion) => "explosion",
        VolumeSource::BuiltIn(Source::Cloud) => "cloud",
        _ => USUAL_STYLE,
    }
}

/// Where a volume comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum VolumeSource {
    /// The solver.
    BuiltIn(Source),
    /// One file.
    File(PathBuf),
    /// Files with numbers.
    Series(Numbered),
    /// A file that was read already, and what it is called in messages.
    Read(String, Vec<u8>),
}

impl VolumeSource {
    /// The source that a name stands for: a built-in one, a series if there is a `#` in it, or a file.
    pub fn of(name: &Path) -> Self {
        let built_in = name.to_str().and_then(Source::of_name);
        let series = || Numbered::of(name).map(Self::Series);
        built_in
            .map(Self::BuiltIn)
            .or_else(series)
            .unwrap_or_else(|| Self::File(name.to_owned()))
    }
}

/// Which moments of a volume are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shots {
    /// First and last frame; a single telling one without.
    pub frames: Option<(u32, u32)>,
    /// Frames from one picture to the next.
    pub step: f64,
    /// Frames of the volume per second.
    pub fps: f32,
    /// Cells of the built-in simulation along x, y and z, which is up.
    pub grid: Option<[u32; 3]>,
}

impl Default for Shots {
    fn default() -> Self {
        Self {
            frames: None,
            step: DEFAULT_STEP,
            fps: DEFAULT_FPS,
            grid: None,
        }
    }
}

/// What smoke is made of, and how.
#[derive(Debug, Clone, Copy)]
pub struct Order<'a> {
    /// What the user said about volumes.
    pub args: &'a VolumeArguments,
    /// The style of the smoke, with what the user said in place of its own values.
    pub style: &'a SmokeStyle,
    /// What it may cost.
    pub limits: &'a Limits,
}

/// Smoke for one picture or many.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Film {
    /// One for every picture, all in one space. At least one.
    pub frames: Vec<Smoke>,
    /// The frame that the first picture shows.
    pub first: u32,
    /// The files that it was made from.
    pub inputs: Vec<PathBuf>,
    /// What was guessed, mended or found missing, for the user.
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

/// The smoke of a still picture as a step of the work, which is not told of where there is none; see [`still`].
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

/// The smoke of a still picture: that of the scene's own file, where it is a volume, and of every `--volume`; none
/// without any.
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

/// Smoke with the middle of its lowest plane where the user wants it.
fn placed_at(volume: &PlacedVolume, smoke: Smoke) -> Smoke {
    let Some((place, scale)) = volume.place else {
        return smoke;
    };
    let (low, high) = smoke.bounds();
    let foot = [(low[0] + high[0]) * 0.5, low[1], (low[2] + high[2]) * 0.5];
    smoke.moved(foot, place.0, scale)
}

/// The smoke of a source at every moment asked for, followed from moment to moment; `tell` learns how far the work is.
///
/// A simulation is followed from its first frame on, whatever frames are asked for: a frame looks the same alone and
/// in a film.
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

/// A grid on which a source looks good within seconds.
fn usual_grid(source: Source) -> [u32; 3] {
    match source {
        Source::Plume => [30, 30, 60],
        Source::Puff => [32, 32, 40],
        Source::Explosion => [40, 40, 40],
        Source::Cloud => [48, 30, 24],
    }
}

/// A frame, of 24 a second, that shows what the source is.
fn telling_frame(source: Source) -> u32 {
    match source {
        Source::Plume => 72,
        Source::Puff => 30,
        Source::Explosion => 16,
        Source::Cloud => 24,
    }
}

fn simulated(
    source: Source,
    order: &Order<'_>,
    shots: &Shots,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Film, Fault> {
    let settings = SmokeSettings {
        size: shots.grid.unwrap_or(usual_grid(source)),
        frame_seconds: 1.0 / shots.fps,
        seed: order.args.seed,
        ..SmokeSettings::of(source)
    };
    let mut budget = Budget::new(order.limits.memory_bytes);
    let mut smoke = solver::Smoke::within(&mut budget, settings)?;
    let telling = f64::from(telling_frame(source)) / f64::from(DEFAULT_FPS) * f64::from(shots.fps);
    let telling = (telling.round() as u32).max(1);
    let (first, last) = shots.frames.unwrap_or((telling, telling));
    let mut done = 0;
    let read = |frame: u32| {
        while done < frame {
            smoke.step();
            done += 1;
        }
        Ok(smoke.volume())
    };
    let footage = Footage::new(read, u32::MAX, 1.0 / shots.fps);
    let moments = Moments::new(first, last, shots.step, 1);
    let puffs = order.puffs(moments.step, shots.fps, settings.birthplace());
    let film = followed(footage, &moments, puffs, &mut budget, tell)?;
    Ok(finished(
        film,
        first,
        source.hottest(settings.heat),
        Vec::new(),
    ))
}

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
    let (volume, notices) = read().map_err(|fault| of_volume(name, fault))?;
    let (peak, hottest) = (peak(&volume), hottest(&volume));
    let mut notes: Vec<String> = notices;
    notes.extend(mended_notice(volume.mended()));
    notes.extend(thin_notice(peak, order.style));
    let notes = notes.into_iter().map(|notice| format!("{name}: {notice}"));
    let notes = notes.collect();
    let settings = order.puffs(1.0, shots.fps, Birthplace::Anywhere);
    let puffs = Puffs::new(&volume, settings);
    Ok(finished(vec![Smoke::of_puffs(&puffs)], 1, hottest, notes))
}

fn read_series(
    series: &Numbered,
    order: &Order<'_>,
    shots: &Shots,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Film, Fault> {
    let found = || {
        series.found().ok_or_else(|| {
            let first = quoted(&series.path(1));
            Fault::new(Exit::Failed, format!("there is no file such as {first}"))
        })
    };
    let (first, last) = shots.frames.map_or_else(found, Ok)?;
    let (options, mut notices) = (order.options(), Vec::new());
    let open = |frame: u32| {
        let path = series.path(frame);
        let bytes = read_file(&path, order.limits.file_bytes)?;
        VolumeFile::read(&bytes, &options).map_err(|fault| of_volume(&quoted(&path), fault))
    };
    let extent = shared_extent(series, first, last, &open)?;
    let (mut most, mut hot) = (0.0f32, 0.0f32);
    let read = |frame: u32| {
        let file = open(frame)?;
        let volume = file.volume(&extent);
        let volume = volume.map_err(|fault| of_volume(&quoted(&series.path(frame)), fault))?;
        (most, hot) = (most.max(peak(&volume)), hot.max(hottest(&volume)));
        let own = file
            .notices()
            .iter()
            .cloned()
            .chain(mended_notice(volume.mended()));
        notices.extend(own.map(|notice| format!("{}: {notice}", quoted(&series.path(frame)))));
        Ok(volume)
    };
    let mut footage = Footage::new(read, last, 1.0 / shots.fps);
    let moments = Moments::new(first, last, shots.step, first);
    let mut budget = Budget::new(order.limits.memory_bytes);
    let puffs = order.puffs(moments.step, shots.fps, Birthplace::Anywhere);
    let frames = followed(&mut footage, &moments, puffs, &mut budget, tell)?;
    let estimates = footage.has_estimates();
    drop(footage);
    if estimates {
        notices.push("velocities are estimated from densities: the files bring none".to_owned());
    }
    notices.extend(thin_notice(most, order.style));
    let mut film = finished(frames, first, hot, notices);
    film.inputs = (first..=last).map(|frame| series.path(frame)).collect();
    Ok(film)
}

/// The box of voxels that holds all frames of a series.
fn shared_extent(
    series: &Numbered,
    first: u32,
    last: u32,
    open: &dyn Fn(u32) -> Result<VolumeFile, Fault>,
) -> Result<Extent, Fault> {
    let mut all = open(first)?.extent();
    for frame in first.saturating_add(1)..=last {
        all = all.union(&open(frame)?.extent()).ok_or_else(|| {
            let (here, start) = (quoted(&series.path(frame)), quoted(&series.path(first)));
            let message =
                format!("cannot read {here}: its voxels do not lie on the grid of {start}");
            Fault::new(Exit::Input, message)
        })?;
    }
    Ok(all)
}

/// The smoke of every moment that is drawn, its heat in the units of the volume.
fn followed<R>(
    mut footage: impl std::borrow::BorrowMut<Footage<R>>,
    moments: &Moments,
    settings: PuffSettings,
    budget: &mut Budget,
    tell: &mut dyn FnMut(usize, usize),
) -> Result<Vec<Smoke>, Fault>
where
    R: FnMut(u32) -> Result<Volume, Fault>,
{
    let spheres = (settings.count() as usize).saturating_mul(moments.seen);
    budget
        .take("the smoke of all frames", spheres, size_of::<Sphere>())
        .map_err(|error| limit_of(&error))?;
    let (mut puffs, mut frames) = (None::<Puffs>, Vec::new());
    for number in 0..moments.count() {
        tell(number, moments.count());
        let volume = footage.borrow_mut().at(moments.at(number))?;
        let puffs = match &mut puffs {
            Some(puffs) => {
                puffs.step(&volume);
                puffs
            }
            none => none.insert(Puffs::new(&volume, settings)),
        };
        if moments.is_seen(number) {
            frames.push(Smoke::of_puffs(puffs));
        }
    }
    Ok(frames)
}

/// Frames in one space, with heats from 0 to 1.
fn finished(frames: Vec<Smoke>, first: u32, hottest: f32, mut notices: Vec<String>) -> Film {
    // What holds for every frame is said once.
    let mut args = std::collections::BTreeSet::new();
    notices.retain(|notice| args.insert(notice.clone()));
    let all = frames.iter().fold(Smoke::default(), |all, smoke| {
        all.with(Smoke::new(smoke.spheres.clone()))
    });
    let space = (!all.spheres.is_empty()).then(|| all.bounds());
    let finish = |smoke: Smoke| Smoke {
        space,
        ..smoke.with_hottest(hottest)
    };
    Film {
        frames: frames.into_iter().map(finish).collect(),
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

    /// How spheres follow smoke that goes on by `step` frames at a time; `known` is where it comes from, if the user
    /// does not say.
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

fn peak(volume: &Volume) -> f32 {
    volume
        .density()
        .iter()
        .fold(0.0, |most, density| most.max(*density))
}

fn hottest(volume: &Volume) -> f32 {
    let heats = volume.temperature().unwrap_or_default();
    heats.iter().fold(0.0, |most, heat| most.max(*heat))
}

/// What to say where nothing is dense enough to be drawn.
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

/// A fault of a volume called `name`, which is quoted.
pub fn of_volume(name: &str, fault: VolumeFault) -> Fault {
    let exit = match &fault {
        fault if fault.is_limit() => Exit::Limit,
        VolumeFault::Components { .. } | VolumeFault::Read(npr_vdb::Fault::NoGrid { .. }) => {
            Exit::Usage
        }
        _ => Exit::Input,
    };
    let remedy = match (fault.is_memory(), exit) {
        (true, _) => "; --memory-limit lifts that",
        (false, Exit::Limit) => ", and no option lifts that",
        (false, _) => "",
    };
    Fault::new(exit, format!("cannot read {name}: {fault}{remedy}"))
}

fn limit_of(error: &npr_core::budget::OverBudget) -> Fault {
    Fault::new(Exit::Limit, format!("{error}; --memory-limit lifts that"))
}

impl From<SmokeError> for Fault {
    fn from(error: SmokeError) -> Self {
        match &error {
            SmokeError::OverBudget(error) => limit_of(error),
            _ => Self::new(Exit::Usage, format!("--grid: {error}")),
        }
    }
}

impl From<npr_smoke::VolumeError> for Fault {
    fn from(error: npr_smoke::VolumeError) -> Self {
        Self::new(Exit::Input, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_where_smoke_comes_from() {
        let of = |name: &str| VolumeSource::of(Path::new(name));
        assert_eq!(of("cloud"), VolumeSource::BuiltIn(Source::Cloud));
        assert_eq!(of("./cloud"), VolumeSource::File("./cloud".into()));
        assert_eq!(of("a.vdb"), VolumeSource::File("a.vdb".into()));
        assert!(matches!(of("a_##.vdb"), VolumeSource::Series(_)));
    }
}
