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
use crate::pose;
use crate::progress::{Counter, Progress};
use crate::render;
use crate::source::{Loaded, Source};
use crate::timings::Timings;
use crate::viewpoint::unknown_camera;
use crate::volume::{self, Film, Order, Shots, VolumeSource};
use npr_core::camera::Camera;
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{Frame, RenderError, Renderer, RendererOptions, Shot, Smoke, Subject, facts_of};
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

/// The job of `npr smoke`: its arguments, resolved and checked.
struct Job<'a> {
    args: &'a SmokeArguments,
    source: Source,
    shots: Shots,
    look: Look,
    options: RendererOptions,
    target: Target,
}

/// The destination of the pictures.
enum Target {
    One(Output),
    /// One file for each picture, by its number.
    Many(Numbered),
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
                // Check the folder before the work is done.
                Output::of(&numbered.path(0))?;
                Ok(Self::Many(numbered))
            }
            None => Output::of(path).map(Self::One),
        }
    }

    /// The destination of the picture with a number.
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
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            return Ok(PathBuf::from(format!("{name}_####.png")));
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
    let mut nothing = npr_scene::Scene::default();
    let of_pose = pose::pose(&job.args.drawing.pose, &mut nothing)?;
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
    let outputs = outputs(job, &film)?;
    let mut of_options = idle::of_volumes(&order, Some(&source));
    of_options.extend(of_pose);
    tell_notices(job, &source, &film, &of_options, progress);
    let camera = camera(job, &prepared, &film)?;
    draw_film(
        (job, &engine),
        &prepared,
        &film,
        &outputs,
        &camera,
        progress,
    )
}

/// The volume that standard input holds.
fn volume_of(loaded: Loaded) -> Result<VolumeSource, Fault> {
    loaded.volume.ok_or_else(|| {
        let message = "standard input holds a scene, not a volume: draw it with npr render";
        Fault::new(Exit::Usage, message)
    })
}

/// The destinations of all pictures. Refuses to write over a file that the smoke or the look is made from.
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
    outputs: &[Output],
    camera: &Camera,
    progress: &mut Progress,
) -> Result<Drawn<Vec<PassTime>>, Fault> {
    let largest = film.frames.iter().max_by_key(|smoke| smoke.spheres.len());
    let options = RendererOptions {
        smoke: largest.cloned(),
        ..job.options.clone()
    };
    let keep_alpha = job.look.is_transparent();
    let screening = Screening::new(outputs, keep_alpha, progress.counter());
    // An engine that takes over continues where the other one failed.
    let pictures = |engine: &dyn Engine| {
        let renderer = prepared.renderer(engine, &job.look.style, &options)?;
        screening.show_all(renderer, &film.frames, camera)
    };
    let quiet = job.args.drawing.quiet;
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

/// The state of a film while its pictures are drawn and written.
struct Screening<'a> {
    outputs: &'a [Output],
    keep_alpha: bool,
    counter: Counter,
    /// Number of pictures that are written.
    done: Cell<usize>,
    failed: RefCell<Option<Fault>>,
    /// Notices about what was drawn in another way than the style asks, each once.
    notices: RefCell<std::collections::BTreeSet<String>>,
    times: RefCell<Vec<PassTime>>,
}

impl<'a> Screening<'a> {
    /// The state before the first picture is written.
    fn new(outputs: &'a [Output], keep_alpha: bool, counter: Counter) -> Self {
        Self {
            outputs,
            keep_alpha,
            counter,
            done: Cell::new(0),
            failed: RefCell::new(None),
            notices: RefCell::default(),
            times: RefCell::default(),
        }
    }

    /// Draws every picture that is not written yet, and writes each while the next is drawn. Ends early where one
    /// cannot be written.
    fn show_all(
        &self,
        mut renderer: Renderer<'_>,
        smoke: &[Smoke],
        camera: &Camera,
    ) -> Result<(), RenderError> {
        let shots = smoke.iter().skip(self.done.get()).map(|smoke| Shot {
            camera: *camera,
            smoke: Some(smoke.clone()),
        });
        for frame in renderer.frames(shots) {
            if !self.show(&frame?) {
                break;
            }
        }
        Ok(())
    }

    /// Writes the next picture, and returns whether that succeeded.
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
    use npr_gpu::engine::{EngineError, Readings, Session};
    use npr_gpu::graph::{Graph, ResourceId};
    use npr_gpu::processor::Processor;
    use npr_render::Sphere;
    use npr_stylesheet::Style;
    use std::rc::Rc;

    /// A device that is lost after some submissions, with all that it has in flight.
    struct Dying(Rc<Cell<usize>>);

    struct DyingSession(Box<dyn Session>, Rc<Cell<usize>>);

    impl Dying {
        fn after(submits: usize) -> Box<dyn Engine> {
            Box::new(Self(Rc::new(Cell::new(submits))))
        }
    }

    impl Engine for Dying {
        fn describe(&self) -> String {
            "dying".to_owned()
        }

        fn prepare(&self, graph: Graph) -> Result<Box<dyn Session>, EngineError> {
            let session = Processor.prepare(graph)?;
            Ok(Box::new(DyingSession(session, self.0.clone())))
        }
    }

    impl DyingSession {
        fn check(&self) -> Result<(), EngineError> {
            match self.1.get() {
                0 => Err(EngineError::Lost {
                    reason: "unplugged".to_owned(),
                }),
                _ => Ok(()),
            }
        }
    }

    impl Session for DyingSession {
        fn write(&mut self, id: ResourceId, words: &[u32]) -> Result<(), EngineError> {
            self.check()?;
            self.0.write(id, words)
        }

        fn grow(&mut self, id: ResourceId, count: usize) -> Result<(), EngineError> {
            self.check()?;
            self.0.grow(id, count)
        }

        fn submit(&mut self, ids: &[ResourceId]) -> Result<(), EngineError> {
            self.check()?;
            self.1.set(self.1.get() - 1);
            self.0.submit(ids)
        }

        fn collect(&mut self) -> Result<(Vec<PassTime>, Readings), EngineError> {
            let collected = self.0.collect();
            self.check()?;
            collected
        }

        fn in_flight(&self) -> usize {
            self.0.in_flight()
        }

        fn read_all(&mut self, ids: &[ResourceId]) -> Result<Readings, EngineError> {
            self.check()?;
            self.0.read_all(ids)
        }
    }

    /// The smoke of six pictures, which differs from picture to picture.
    fn puffs() -> Vec<Smoke> {
        let puff = |i| Smoke {
            spheres: vec![Sphere::new([i as f32 * 0.3 - 0.8, 0.0, 0.0], 0.4)],
            space: Some(([-2.0; 3], [2.0; 3])),
        };
        (0..6).map(puff).collect()
    }

    /// Runs `work` with a film of [`puffs`] that goes into six files of a folder, and gives the contents of the files.
    fn screened(
        work: impl FnOnce(&Screening<'_>, &dyn Fn(&dyn Engine) -> Result<(), RenderError>),
    ) -> Vec<Option<Vec<u8>>> {
        let (folder, smoke) = (tempfile::tempdir().expect("a folder"), puffs());
        let paths: Vec<PathBuf> = (0..6)
            .map(|i| folder.path().join(format!("{i}.png")))
            .collect();
        let outputs: Vec<Output> = paths
            .iter()
            .map(|path| Output::of(path).expect("a place"))
            .collect();
        let (scene, style) = (npr_scene::Scene::default(), Style::default());
        let mut progress = Progress::new(true);
        let prepared = render::prepared(
            &scene,
            &style,
            &npr_scene::Limits::default(),
            None,
            &mut progress,
        );
        let prepared = prepared.expect("an empty scene");
        let options = RendererOptions {
            smoke: smoke.first().cloned(),
            ..RendererOptions::new([48, 32])
        };
        let camera = Camera::framing([-1.0; 3], [1.0; 3]);
        let screening = Screening::new(&outputs, false, progress.counter());
        work(&screening, &|engine| {
            let renderer = prepared.renderer(engine, &style, &options)?;
            screening.show_all(renderer, &smoke, &camera)
        });
        paths.iter().map(|path| std::fs::read(path).ok()).collect()
    }

    #[test]
    fn a_film_goes_on_where_devices_were_lost_with_two_pictures_in_flight() {
        let wanted = screened(|_, pictures| pictures(&Processor).expect("drawn"));
        assert!(wanted.iter().all(Option::is_some));
        assert!(wanted.windows(2).all(|pair| pair[0] != pair[1]));
        for lives in [[1, 1], [2, 3], [3, 4], [5, 2], [5, 9], [6, 2]] {
            let mut left = lives
                .into_iter()
                .collect::<std::collections::VecDeque<usize>>();
            let opened = RefCell::new(&mut left);
            let open = || {
                let life = opened.borrow_mut().pop_front();
                Ok(Dying::after(life.expect("it is opened twice at most")))
            };
            let warnings = RefCell::new(Vec::new());
            let warn = |text: &str| warnings.borrow_mut().push(text.to_owned());
            let files = screened(|screening, pictures| {
                crate::engine::draw_somewhere(&open, &pictures, &warn)
                    .expect("the processor draws");
                assert_eq!(screening.done.get(), 6, "{lives:?}");
                assert!(screening.failed.borrow().is_none());
            });
            assert!(files == wanted, "{lives:?}");
            let is_lost_twice = lives[0].saturating_sub(2) + lives[1] <= 6;
            let said = "the graphics device was lost: unplugged; the processor draws instead";
            assert_eq!(
                warnings.into_inner(),
                [said][..usize::from(is_lost_twice)],
                "{lives:?}"
            );
        }
    }

    #[test]
    fn a_film_on_a_device_that_is_lost_twice_ends_with_one_sentence() {
        let wanted = screened(|_, pictures| pictures(&Processor).expect("drawn"));
        let open = || Ok(Dying::after(3));
        let files = screened(|screening, pictures| {
            let lost =
                crate::engine::draw_on_device(&open, &pictures).expect_err("it is lost twice");
            let fault = Fault::from(lost);
            assert_eq!(fault.exit, Exit::NoDevice);
            assert_eq!(fault.message, "the graphics device was lost: unplugged");
            assert_eq!(screening.done.get(), 2);
        });
        // Each device finished one picture, and nothing is left of the others.
        assert!(files[..2] == wanted[..2]);
        assert!(files[2..].iter().all(Option::is_none));
    }

    #[test]
    fn several_pictures_need_numbers() {
        let one = Target::One(Output::Standard);
        assert!(one.check_count(1).is_ok());
        let fault = one.check_count(96).expect_err("96 pictures");
        assert_eq!(fault.exit, Exit::Usage);
        assert!(fault.message.contains("####"), "{}", fault.message);
    }
}
