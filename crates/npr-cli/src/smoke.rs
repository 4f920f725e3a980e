//! `npr smoke`: pictures of smoke, one or a whole film.

use crate::arguments::{SmokeArguments, TimingsForm};
use crate::dump::dump_style;
use crate::engine::{Drawn, EngineChoice};
use crate::fault::{Exit, Fault};
use crate::idle;
use crate::job;
use crate::look::Look;
use crate::message;
use crate::pose;
use crate::progress::Progress;
use crate::reel::{Encoding, Reel, Stills};
use crate::render;
use crate::screening::screened;
use crate::source::{Loaded, Source};
use crate::target::Target;
use crate::timings::Timings;
use crate::viewpoint::unknown_camera;
use crate::volume::{self, Film, Order, Shots, VolumeSource};
use npr_core::camera::Camera;
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{RendererOptions, Shot, Smoke, Subject, facts_of};
use npr_smoke::film::{Moments, Numbered};
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

/// The job of `npr smoke`: its arguments, resolved and checked.
struct Job<'a> {
    args: &'a SmokeArguments,
    source: Source,
    shots: Shots,
    look: Look,
    options: RendererOptions,
    target: Target,
}

impl<'a> Job<'a> {
    fn resolve(
        args: &'a SmokeArguments,
        look: &crate::arguments::LookArguments,
    ) -> Result<Self, Fault> {
        // Find the source of the smoke, and the moments that are drawn.
        let source = Source::of(args.source.as_deref().unwrap_or(Path::new("-")));
        let shots = Shots {
            frames: args.frames.map(|frames| (frames.first, frames.last)),
            step: args.step,
            fps: args.fps,
            grid: args.grid.map(|grid| grid.0),
        };
        check_grid(&source, &shots)?;

        // Find the destination of the pictures, and their style.
        let path = output_path(args, &source)?;
        job::check_ending(&path)?;
        let target = Target::of(&path)?;
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

/// Refuses `--grid` where the source is not the built-in simulation.
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

/// The path that the user gave, or else one from the source's name, with `####` for the frame number where the source
/// is a series or a range of frames is drawn.
fn output_path(args: &SmokeArguments, source: &Source) -> Result<PathBuf, Fault> {
    if let (None, Source::File(path)) = (&args.output, source) {
        let is_range = args.frames.is_some_and(|frames| frames.first < frames.last);
        if is_range && Numbered::of(path).is_none() {
            return job::film_path(None, source);
        }
    }
    job::output_path(args.output.as_deref(), source, "png")
}

/// Computes the smoke, then draws and writes all pictures.
fn draw(job: &Job<'_>, progress: &mut Progress) -> Result<Drawn<Vec<PassTime>>, Fault> {
    if let Some(name) = &job.args.drawing.camera.camera {
        // Volumes have no cameras, so fail before the smoke is computed.
        return Err(unknown_camera(name, &[]));
    }
    let nothing = npr_scene::Scene::default();
    let of_pose = pose::pose_of_nothing(&job.args.drawing.pose)?;
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
    let engine = EngineChoice::begin(&job.args.drawing);
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
    let prepared = render::prepared(&nothing, &job.look.style, &limits, None, progress)?;
    let target = target(job, &film)?;
    let mut of_options = idle::of_volumes(&order, Some(&source));
    of_options.extend(of_pose);
    tell_notices(job, &source, &film, &of_options, progress);
    let camera = camera(job, &prepared, &film)?;
    draw_film((job, &engine), &prepared, &film, &target, &camera, progress)
}

/// The volume that standard input holds.
fn volume_of(loaded: Loaded) -> Result<VolumeSource, Fault> {
    loaded.volume.ok_or_else(|| {
        let message = "standard input holds a scene, not a volume: draw it with npr render";
        Fault::new(Exit::Usage, message)
    })
}

/// The destination of all pictures. Refuses to write over a file that the smoke or the look is made from.
fn target(job: &Job<'_>, film: &Film) -> Result<Target, Fault> {
    let mut inputs = film.inputs.clone();
    inputs.extend(job.look.inputs());
    let more = u32::try_from(film.frames.len() - 1).unwrap_or(u32::MAX);
    let last = film.first.saturating_add(more);
    let target = job.target.clone().over(film.first, last)?;
    target.refuse_any_of(&inputs)?;
    Ok(target)
}

fn tell_notices(
    job: &Job<'_>,
    source: &VolumeSource,
    film: &Film,
    of_options: &[String],
    progress: &Progress,
) {
    progress.suspend(|| {
        let quiet = job.args.drawing.quiet;
        message::warn_all(quiet, &film.notices);
        let facts = facts_of(&npr_scene::Scene::default(), true);
        render::warn_of_idle(&job.look, facts, quiet);
        let of_smoke = idle::of_smoke(job.args, source, film.frames.len());
        message::warn_all(quiet, of_options.iter().chain(&of_smoke));
    });
}

/// The camera asked for, or one that frames the smoke of all pictures.
fn camera(job: &Job<'_>, prepared: &Subject, film: &Film) -> Result<Camera, Fault> {
    let spheres = film.frames.iter().flat_map(|smoke| &smoke.spheres);
    let all = Smoke::new(spheres.copied().collect());
    render::camera_of(prepared, &job.args.drawing, &all)
}

/// Draws and writes every picture, and gives the times of their passes, added up.
fn draw_film(
    (job, engine): (&Job<'_>, &EngineChoice<'_>),
    prepared: &Subject,
    film: &Film,
    target: &Target,
    camera: &Camera,
    progress: &mut Progress,
) -> Result<Drawn<Vec<PassTime>>, Fault> {
    let largest = film.frames.iter().max_by_key(|smoke| smoke.spheres.len());
    let options = RendererOptions {
        smoke: largest.cloned(),
        ..job.options.clone()
    };
    let reel = Reel::Stills(Stills {
        target,
        numbers: (film.first..).take(film.frames.len()).collect(),
        encoding: Encoding::Png {
            keep_alpha: job.look.is_transparent(),
        },
    });
    let shots = film.frames.iter().map(|smoke| Shot {
        camera: *camera,
        smoke: Some(smoke.clone()),
        passed: false,
    });
    let quiet = job.args.drawing.quiet;
    screened(reel, quiet, progress, |screening, progress| {
        // An engine that takes over continues where the other one failed.
        let pictures = |engine: &dyn Engine| {
            let renderer = prepared.renderer(engine, &job.look.style, &options)?;
            screening.show_all(renderer, shots.clone(), false)
        };
        engine.draw_as_step(&pictures, progress)
    })
}
