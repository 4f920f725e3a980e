//! `npr smoke`: pictures of smoke, one or a whole film.

use crate::arguments::{SmokeArguments, TimingsForm};
use crate::dump::dump_style;
use crate::encoder;
use crate::engine::{Drawn, EngineChoice};
use crate::fault::{Exit, Fault};
use crate::idle;
use crate::job;
use crate::look::Look;
use crate::message;
use crate::output::Output;
use crate::progress::{Counter, Progress};
use crate::render::{self, Prepared};
use crate::source::{Loaded, Source};
use crate::timings::Timings;
use crate::viewpoint::unknown_camera;
use crate::volume::{self, Film, Order, Shots, VolumeSource};
use npr_core::camera::Camera;
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{Frame, RenderError, RendererOptions, Smoke, facts_of};
use npr_smoke::film::{Moments, Numbered};
use std::cell::{Cell, RefCell};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Draws the smoke that the user asked for, or prints the style.
pub fn smoke(args: &SmokeArguments) -> Result<(), Fault> {
    let source = args.source.as_deref().map(VolumeSource::of);
    let style = source
        .as_ref()
        .map_or(volume::USUAL_STYLE, volume::usual_style);
    let look = args.drawing.look.or_style(style);
    if look.dump_style {
        return dump_style(&look, &args.drawing);
    }
    let mut progress = Progress::new(args.drawing.quiet);
    let drawn = draw(&Job::resolve(args, &look)?, &mut progress)?;
    let steps = progress.finish();
    if let Some(form) = args.drawing.timings {
        tell_times(&drawn, &steps, form);
    }
    Ok(())
}

fn tell_times(
    drawn: &Drawn<Vec<PassTime>>,
    steps: &[(&'static str, std::time::Duration)],
    form: TimingsForm,
) {
    let timings = Timings::new(drawn.engine.clone(), steps, &drawn.picture);
    let _ = std::io::stderr().write_all(timings.reported(form).as_bytes());
}

/// Pictures of smoke: what the user said, resolved.
struct Job<'a> {
    args: &'a SmokeArguments,
    source: Source,
    shots: Shots,
    look: Look,
    options: RendererOptions,
    target: Target,
}

/// Where pictures go.
enum Target {
    One(Output),
    /// By number.
    Many(Numbered),
}

impl<'a> Job<'a> {
    fn resolve(
        args: &'a SmokeArguments,
        look: &crate::arguments::LookArguments,
    ) -> Result<Self, Fault> {
        // Find what smokes, and which moments of it are drawn.
        let source = Source::of(args.source.as_deref().unwrap_or(Path::new("-")));
        let shots = Shots {
            frames: args.frames.map(|frames| (frames.first, frames.last)),
            step: args.step,
            fps: args.fps,
            grid: args.grid.map(|grid| grid.0),
        };
        check_grid(&source, &shots)?;

        // Find where pictures go, and how they look.
        let target = Target::of(&output_path(args, &source)?)?;
        let external = args.drawing.allow_external.as_deref();
        let look = Look::resolve(look, external)?.with_smoke(&args.drawing.volumes);
        let options = job::renderer_options(&args.drawing, &look)?;
        Ok(Self {
            args,
            source,
            shots,
            look,
            options,
            target,
        })
    }
}

impl Target {
    fn of(path: &Path) -> Result<Self, Fault> {
        job::check_ending(path)?;
        match Numbered::of(path) {
            Some(numbered) => {
                // The folder is known before the work is done.
                Output::of(&numbered.path(0))?;
                Ok(Self::Many(numbered))
            }
            None => Output::of(path).map(Self::One),
        }
    }

    /// Where the picture of a number goes.
    fn output(&self, number: u32) -> Result<Output, Fault> {
        match self {
            Self::One(output) => Ok(output.clone()),
            Self::Many(numbered) => Output::of(&numbered.path(number)),
        }
    }

    /// Refuses to write several pictures into one file.
    fn check_count(&self, count: usize) -> Result<(), Fault> {
        match self {
            Self::One(_) if count > 1 => {
                let message = format!(
                    "{count} frames do not fit into one file: name them, such as -o smoke_####.png"
                );
                Err(Fault::new(Exit::Usage, message))
            }
            _ => Ok(()),
        }
    }
}

/// A grid is of a simulation alone.
fn check_grid(source: &Source, shots: &Shots) -> Result<(), Fault> {
    let is_built_in = |path: &Path| matches!(VolumeSource::of(path), VolumeSource::BuiltIn(_));
    match source {
        Source::File(path) if is_built_in(path) => Ok(()),
        _ if shots.grid.is_none() => Ok(()),
        _ => {
            let message = "--grid is of the built-in simulation: a file has voxels of its own";
            Err(Fault::new(Exit::Usage, message))
        }
    }
}

/// The path asked for, or else the source's name: of a series, or a range of frames, with the number in it.
fn output_path(args: &SmokeArguments, source: &Source) -> Result<PathBuf, Fault> {
    if let (None, Source::File(path)) = (&args.output, source) {
        let is_range = args.frames.is_some_and(|frames| frames.first < frames.last);
        if is_range && Numbered::of(path).is_none() {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            return Ok(PathBuf::from(format!("{name}_####.png")));
        }
    }
    job::output_path(args.output.as_deref(), source, "png")
}

/// From the source to the pictures.
fn draw(job: &Job<'_>, progress: &mut Progress) -> Result<Drawn<Vec<PassTime>>, Fault> {
    if let Some(name) = &job.args.drawing.camera.camera {
        // Volumes have no cameras: nobody waits for smoke to hear that.
        return Err(unknown_camera(name, &[]));
    }
    let limits = job.args.drawing.limits.limits();
    let source = match &job.source {
        Source::File(path) => VolumeSource::of(path),
        Source::Standard => volume_of(job.source.load(&limits, None)?)?,
    };
    let is_still = matches!(source, VolumeSource::File(_) | VolumeSource::Read(..));
    if let (Some((first, last)), false) = (job.shots.frames, is_still) {
        job.target
            .check_count(Moments::new(first, last, job.shots.step, first).seen)?;
    }
    let order = Order {
        args: &job.args.drawing.volumes,
        style: &job.look.style.smoke,
        limits: &limits,
    };
    let counter = progress.counter();
    let mut film = progress.step("smoke", || {
        let mut tell = |done, of| counter.tell("smoke", done, of);
        volume::film(&source, &order, &job.shots, &mut tell)
    })?;
    job.target.check_count(film.frames.len())?;
    let more = progress.step("load", || volume::still(&order, None))?;
    if let Some((smoke, reported)) = more {
        film.join(&smoke, reported);
    }
    let prepared = render::prepared(
        &npr_scene::Scene::default(),
        &job.look.style,
        &limits,
        None,
        progress,
    )?;
    let outputs = outputs(job, &film)?;
    let of_volumes = idle::of_volumes(&order, Some(&source));
    tell_notices(job, &source, &film, &of_volumes, progress);
    let camera = camera(job, &prepared, &film)?;
    draw_film(job, &prepared, &film, &outputs, &camera, progress)
}

/// The volume that standard input holds.
fn volume_of(loaded: Loaded) -> Result<VolumeSource, Fault> {
    loaded.volume.ok_or_else(|| {
        let message = "standard input holds a scene, not a volume: draw it with npr render";
        Fault::new(Exit::Usage, message)
    })
}

/// Where every picture goes; none over a file that smoke or look are made from.
fn outputs(job: &Job<'_>, film: &Film) -> Result<Vec<Output>, Fault> {
    let mut inputs = film.inputs.clone();
    inputs.extend(job.look.inputs());
    let first = film.first;
    let output = |number: usize| {
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        let output = job.target.output(first.saturating_add(number))?;
        output.refuse_any_of(&inputs)?;
        Ok(output)
    };
    (0..film.frames.len()).map(output).collect()
}

fn tell_notices(
    job: &Job<'_>,
    source: &VolumeSource,
    film: &Film,
    of_volumes: &[String],
    progress: &Progress,
) {
    progress.suspend(|| {
        let quiet = job.args.drawing.quiet;
        message::warn_all(quiet, &film.notices);
        let facts = facts_of(&npr_scene::Scene::default(), true);
        render::warn_of_idle(&job.look, facts, quiet);
        let of_smoke = idle::of_smoke(job.args, source, film.frames.len());
        message::warn_all(quiet, of_volumes.iter().chain(&of_smoke));
    });
}

/// The camera asked for, or one that frames the smoke of all pictures.
fn camera(job: &Job<'_>, prepared: &Prepared, film: &Film) -> Result<Camera, Fault> {
    let spheres = film.frames.iter().flat_map(|smoke| &smoke.spheres);
    let all = Smoke::new(spheres.copied().collect());
    prepared.camera(&job.args.drawing, &all)
}

/// Draws and writes every picture; the times of their passes, added up.
fn draw_film(
    job: &Job<'_>,
    prepared: &Prepared,
    film: &Film,
    outputs: &[Output],
    camera: &Camera,
    progress: &mut Progress,
) -> Result<Drawn<Vec<PassTime>>, Fault> {
    let largest = film.frames.iter().max_by_key(|smoke| smoke.spheres.len());
    let options = RendererOptions {
        smoke: largest.cloned(),
        ..job.options.clone()
    };
    let screening = Screening {
        outputs,
        keep_alpha: job.look.is_transparent(),
        counter: progress.counter(),
        done: Cell::new(0),
        failed: RefCell::new(None),
        notices: RefCell::default(),
        times: RefCell::default(),
    };
    // An engine that takes over goes on where the other failed.
    let pictures = |engine: &dyn Engine| {
        let mut renderer = prepared.renderer(engine, &job.look.style, &options)?;
        while let Some(smoke) = film.frames.get(screening.done.get()) {
            renderer.set_smoke(smoke)?;
            if !screening.show(&renderer.draw(camera)?) {
                break;
            }
        }
        Ok::<(), RenderError>(())
    };
    let quiet = job.args.drawing.quiet;
    let engine = EngineChoice::begin(&job.args.drawing);
    let drawn = engine.draw_as_step(&pictures, progress)?;
    if let Some(fault) = screening.failed.into_inner() {
        return Err(fault);
    }
    progress.suspend(|| {
        message::warn_all(quiet, screening.notices.into_inner());
    });
    Ok(Drawn {
        picture: screening.times.into_inner(),
        engine: drawn.engine,
    })
}

/// Pictures on their way into files.
struct Screening<'a> {
    outputs: &'a [Output],
    keep_alpha: bool,
    counter: Counter,
    /// How many are written.
    done: Cell<usize>,
    failed: RefCell<Option<Fault>>,
    /// What was drawn in another way than the style asks, once each.
    notices: RefCell<std::collections::BTreeSet<String>>,
    times: RefCell<Vec<PassTime>>,
}

impl Screening<'_> {
    /// Writes the next picture; whether there was no fault.
    fn show(&self, frame: &Frame) -> bool {
        let number = self.done.get();
        let written = encoder::png(frame.size, &frame.rgba, self.keep_alpha).and_then(|bytes| {
            self.outputs
                .get(number)
                .map_or(Ok(()), |out| out.write(&bytes))
        });
        self.notices
            .borrow_mut()
            .extend(frame.notices.iter().cloned());
        self.add_times(&frame.times);
        self.done.set(number + 1);
        self.counter.tell("draw", number + 1, self.outputs.len());
        let is_written = written.is_ok();
        *self.failed.borrow_mut() = written.err();
        is_written
    }

    fn add_times(&self, more: &[PassTime]) {
        let mut times = self.times.borrow_mut();
        if times.len() != more.len() {
            *times = more.to_vec();
            return;
        }
        for (sum, more) in times.iter_mut().zip(more) {
            sum.time += more.time;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_pictures_need_numbers() {
        let one = Target::One(Output::Standard);
        assert!(one.check_count(1).is_ok());
        let fault = one.check_count(96).expect_err("96 pictures");
        assert_eq!(fault.exit, Exit::Usage);
        assert!(fault.message.contains("####"), "{}", fault.message);
    }
}
