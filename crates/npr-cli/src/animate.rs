//! `npr animate`: draws films of a scene.

use crate::arguments::{
    AnimateArguments, DrawingArguments, Frames, LineFormat, LinesArguments, LookArguments,
    RenderArguments,
};
use crate::dump::dump_style;
use crate::ending::has_ending;
use crate::engine::{Drawn, EngineChoice};
use crate::fault::{Exit, Fault};
use crate::film_plan::FilmPlan;
use crate::idle;
use crate::job::{Job, PictureFormat, film_path};
use crate::line_file;
use crate::line_job::LineJob;
use crate::lines::{self, Prepared};
use crate::message::{self, quoted};
use crate::output::Output;
use crate::playing::{Playing, Stage};
use crate::pose;
use crate::progress::Progress;
use crate::reel::{Codec, Encoding, FilmFormat, Reel, Stills, Whole, check_frames, check_rate};
use crate::render;
use crate::screening::{Screening, Take, Unfit, screened};
use crate::source::Source;
use crate::target::Target;
use crate::timings::Timings;
use crate::viewpoint::{self, Orbit, Seen, Viewed};
use npr_core::camera::Camera;
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{LineRenderer, RendererOptions, Shot, Smoke};
use npr_scene::Scene;
use std::io::Write;
use std::path::Path;

/// Draws the film that the user asked for, or prints the style.
pub fn animate(args: &AnimateArguments) -> Result<(), Fault> {
    if args.drawing.look.dump_style {
        return dump_style(&args.look(), &args.drawing);
    }
    let film = FilmJob::resolve(args)?;
    let mut progress = Progress::new(args.drawing.quiet);
    let drawn = match film.lines {
        Some(format) => draw_lines(&film, format, &mut progress)?,
        None => draw_frames(&film, &mut progress)?,
    };
    let Some(drawn) = drawn else {
        // All frames are there.
        return Ok(());
    };
    let steps = progress.finish();
    if let Some(form) = args.drawing.timings {
        let timings = Timings::new(drawn.engine, &steps, &drawn.picture);
        let _ = std::io::stderr().write_all(timings.reported(form).as_bytes());
    }
    Ok(())
}

impl AnimateArguments {
    /// The same about one picture.
    fn of_picture(&self) -> RenderArguments {
        RenderArguments {
            scene: self.scene.clone(),
            output: None,
            enlarge: 1,
            debug_layer: None,
            drawing: self.drawing.clone(),
            cache: self.cache.clone(),
        }
    }

    /// The same about one line drawing.
    fn of_lines(&self, format: LineFormat) -> LinesArguments {
        LinesArguments {
            scene: self.scene.clone(),
            output: None,
            format: Some(format),
            lines: self.lines.clone(),
            sheet: self.sheet.clone(),
            drawing: self.drawing.clone(),
            cache: self.cache.clone(),
        }
    }

    fn look(&self) -> LookArguments {
        self.of_picture().look()
    }
}

/// A film to draw. Everything that can be checked without reading the scene is already checked.
struct FilmJob<'a> {
    args: &'a AnimateArguments,
    source: Source,
    /// Where it goes; the numbers of its frames are not known yet.
    target: Target,
    format: Format,
    /// The format of its line drawings, PNG for those that become pixels; none where frames are pictures.
    lines: Option<LineFormat>,
}

/// The frames of a film of a scene, and the clip that plays in it.
struct Frameset {
    plan: FilmPlan,
    playing: Option<Playing>,
    target: Target,
    /// The numbers of the frames that are drawn, in rising order.
    numbers: Vec<u32>,
}

/// The format of a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    /// A picture for every frame.
    Pictures(PictureFormat),
    /// A line drawing for every frame.
    Drawings(LineFormat),
    /// One file.
    Whole(FilmFormat),
}

impl Format {
    /// The format of the files that a name stands for.
    fn of(path: &Path) -> Result<Self, Fault> {
        let formats = [
            ("png", Self::Pictures(PictureFormat::Png)),
            ("exr", Self::Pictures(PictureFormat::Exr)),
            ("svg", Self::Drawings(LineFormat::Svg)),
            ("pdf", Self::Drawings(LineFormat::Pdf)),
            ("json", Self::Drawings(LineFormat::Json)),
            ("gif", Self::Whole(FilmFormat::Gif)),
            ("apng", Self::Whole(FilmFormat::Apng)),
            ("mp4", Self::Whole(FilmFormat::Video(Codec::Mp4))),
            ("webm", Self::Whole(FilmFormat::Video(Codec::WebM))),
        ];
        let found = formats.iter().find(|(ending, _)| has_ending(path, ending));
        found.map(|(_, format)| *format).ok_or_else(|| {
            let message = format!(
                "cannot write {}: films are written as .gif, .apng, .mp4 or .webm, or as frame_####.png, .exr, .svg, \
                 .pdf or .json",
                quoted(path)
            );
            Fault::new(Exit::Usage, message)
        })
    }

    /// The format of line drawings, where the film consists of such; `asked` is whether the user asked for them.
    fn lines(self, asked: bool) -> Result<Option<LineFormat>, Fault> {
        match self {
            Self::Drawings(format) => Ok(Some(format)),
            Self::Pictures(PictureFormat::Exr) if asked => {
                let message = "--lines: .exr files hold pictures with layers: write .png, .svg, .pdf or .json";
                Err(Fault::new(Exit::Usage, message))
            }
            _ => Ok(asked.then_some(LineFormat::Png)),
        }
    }
}

impl<'a> FilmJob<'a> {
    fn resolve(args: &'a AnimateArguments) -> Result<Self, Fault> {
        // Find the files that the film goes to.
        let source = Source::of(args.scene.as_deref().unwrap_or(Path::new("-")));
        let path = film_path(args.output.as_deref(), &source)?;
        let format = Format::of(&path)?;
        let target = match format {
            Format::Whole(_) if path.to_string_lossy().contains('#') => {
                let message = format!("{} holds all frames: its name takes no #", quoted(&path));
                return Err(Fault::new(Exit::Usage, message));
            }
            Format::Whole(_) => Target::One(Output::of(&path)?),
            _ => Target::of(&path)?,
        };
        if args.film.resume && matches!(target, Target::One(_)) {
            let message = format!(
                "--resume goes on with numbered files, such as frame_####.png, but {} is one",
                quoted(&path)
            );
            return Err(Fault::new(Exit::Usage, message));
        }
        if let Some(frames) = args.film.frames {
            check_frames(frames)?;
        }
        Ok(Self {
            args,
            source,
            format,
            lines: format.lines(args.lines_only)?,
            target,
        })
    }

    /// The frames of a film of a scene that was loaded.
    fn frames(&self, scene: &Scene) -> Result<Frameset, Fault> {
        let film = &self.args.film;
        let playing = Playing::of(&self.args.drawing, scene, film.fps)?;
        let plan = FilmPlan::new(film, playing.as_ref().map(Playing::duration_s))?;
        let Frames { first, last } = plan.frames;
        let target = match self.format {
            Format::Whole(_) => self.target.clone(),
            _ => self.target.clone().over(first, last)?,
        };
        // Leave out those that are there.
        let is_wanted = |number: &u32| !film.resume || !target.is_there(*number);
        Ok(Frameset {
            plan,
            playing,
            numbers: (first..=last).filter(is_wanted).collect(),
            target,
        })
    }

    /// The files of the film, of `size` pixels where they are pictures.
    fn reel<'b>(
        &self,
        frames: &'b Frameset,
        (size, keep_alpha): ([u32; 2], bool),
        encoding: Encoding<'b>,
    ) -> Reel<'b> {
        match (self.format, &frames.target) {
            (Format::Whole(format), Target::One(output)) => Reel::Whole(Whole {
                output,
                format,
                size,
                count: frames.numbers.len() as u32,
                fps: self.args.film.fps,
                keep_alpha,
            }),
            (_, target) => Reel::Stills(Stills {
                target,
                numbers: frames.numbers.clone(),
                encoding,
            }),
        }
    }

    /// Refuses what the format of the film cannot hold, before there is any work.
    fn check(&self, size: [u32; 2], keep_alpha: bool) -> Result<(), Fault> {
        match self.format {
            Format::Whole(FilmFormat::Gif) => check_rate(self.args.film.fps),
            Format::Whole(FilmFormat::Video(codec)) => codec.check(size, keep_alpha),
            _ => Ok(()),
        }
    }

    /// The way of the camera.
    fn orbit(&self, plan: &FilmPlan, seen: &dyn Viewed) -> Result<Orbit, Fault> {
        let (camera, size) = (&self.args.drawing.camera, self.args.drawing.size);
        match plan.turn {
            Some(_) => viewpoint::orbit(camera, seen, size),
            None => viewpoint::camera(camera, seen, size).map(Orbit::still),
        }
    }

    /// Whether the camera is one of the file, which a clip may move.
    fn has_moving_camera(&self) -> bool {
        self.args.drawing.camera.camera.is_some()
    }

    /// Warns of options that have no effect in the frames of the film.
    fn tell_idle(&self, frames: &Frameset, progress: &Progress) {
        let is_timed = matches!(self.format, Format::Whole(_)) || frames.playing.is_some();
        let notices = idle::of_animate(self.args, self.lines.is_some(), is_timed);
        progress.suspend(|| message::warn_all(self.args.drawing.quiet, notices));
    }
}

impl Frameset {
    /// Poses a scene that was loaded as its first frame that is drawn shows it, and gives what there is to warn of.
    fn pose(&self, args: &DrawingArguments, scene: &mut Scene) -> Result<Vec<String>, Fault> {
        let (Some(playing), Some(first)) = (&self.playing, self.numbers.first()) else {
            return pose::pose(&args.pose, scene);
        };
        let (posed, warning) = playing.loaded_at(*first);
        *scene = posed;
        Ok(warning.into_iter().collect())
    }
}

/// Draws a film of pictures; gives nothing where all of its frames are there.
fn draw_frames(
    film: &FilmJob<'_>,
    progress: &mut Progress,
) -> Result<Option<Drawn<Vec<PassTime>>>, Fault> {
    // Load the scene, and find out which frames it has.
    let args = film.args.of_picture();
    let format = match film.format {
        Format::Pictures(format) => format,
        _ => PictureFormat::Png,
    };
    let mut job = Job::drawn_into(&args, film.source.clone(), film.target.clone(), format)?;
    let keep_alpha = job.look.is_transparent();
    film.check(job.options.size, keep_alpha)?;
    let engine = EngineChoice::begin(&args.drawing);
    let mut loaded = render::load(&job, progress)?;
    let frames = film.frames(&loaded.scene)?;
    if frames.numbers.is_empty() {
        return Ok(None);
    }
    job.target = frames.target.clone();

    // Prepare it, and place the camera.
    let of_pose = frames.pose(&args.drawing, &mut loaded.scene)?;
    let (prepared, smoke) = render::prepare(&job, loaded, &of_pose, progress)?;
    film.tell_idle(&frames, progress);
    let stage = frames
        .playing
        .as_ref()
        .map(|playing| playing.stage(smoke.as_ref()));
    let none = Smoke::default();
    let seen = Seen {
        model: &prepared.model,
        smoke: smoke.as_ref().unwrap_or(&none),
    };
    let orbit = match &stage {
        Some(stage) => film.orbit(&frames.plan, &stage.with_cameras(prepared.model.cameras()))?,
        None => film.orbit(&frames.plan, &seen)?,
    };
    let options = RendererOptions {
        smoke: smoke.clone(),
        ..job.options.clone()
    };

    // Draw all frames.
    let encoding = match format {
        PictureFormat::Png => Encoding::Png { keep_alpha },
        PictureFormat::Exr => Encoding::Exr(prepared.model.object_names()),
    };
    let reel = film.reel(&frames, (options.size, keep_alpha), encoding);
    let style = &job.look.style;
    let still = |screening: &Screening, engine: &dyn Engine| {
        let angles = frames
            .numbers
            .iter()
            .map(|number| frames.plan.angle(*number));
        let shots = angles.map(|angle| Shot::from(orbit.at(angle)));
        screening.show_all(prepared.renderer(engine, style, &options)?, shots)
    };
    let limits = args.drawing.limits.limits();
    let external = args.drawing.allow_external.as_deref();
    let played = |(playing, stage): (&Playing, &Stage), number: u32, engine: &dyn Engine| {
        let (scene, _) = playing.scene_at(number, &job.look, (&limits, external))?;
        let subject = render::subject(&scene, style, &limits, job.cache.as_deref())?;
        let orbit = match film.has_moving_camera() {
            true => film.orbit(&frames.plan, &stage.with_cameras(subject.model.cameras()))?,
            false => orbit,
        };
        let mut renderer = subject.renderer(engine, style, &options)?;
        let frame = renderer.draw(&orbit.at(frames.plan.angle(number)))?;
        Ok(Take::from(frame))
    };
    let drawn = screened(reel, args.drawing.quiet, progress, |screening, progress| {
        let pictures = |engine: &dyn Engine| match frames.playing.as_ref().zip(stage.as_ref()) {
            Some(clip) => {
                screening.show_each(&frames.numbers, |number| played(clip, number, engine))
            }
            None => still(screening, engine),
        };
        engine.draw_as_step(&pictures, progress)
    })?;
    Ok(Some(drawn))
}

/// Draws a film of line drawings; gives nothing where all of its frames are there.
fn draw_lines(
    film: &FilmJob<'_>,
    format: LineFormat,
    progress: &mut Progress,
) -> Result<Option<Drawn<Vec<PassTime>>>, Fault> {
    // Load the scene, and find out which frames it has.
    let args = film.args.of_lines(format);
    let mut job = LineJob::drawn_into(&args, film.source.clone(), film.target.clone(), format)?;
    let keep_alpha = job.look.is_transparent();
    film.check(job.options.size, keep_alpha)?;
    line_file::check_memory(&job)?;
    let engine = EngineChoice::begin(&args.drawing);
    let mut loaded = lines::load(&job, progress)?;
    let frames = film.frames(&loaded.scene)?;
    if frames.numbers.is_empty() {
        return Ok(None);
    }
    job.target = frames.target.clone();

    // Prepare it, and place the camera.
    let of_pose = frames.pose(&args.drawing, &mut loaded.scene)?;
    let (prepared, smoke) = lines::prepare(&job, loaded, &of_pose, progress)?;
    film.tell_idle(&frames, progress);
    let stage = frames
        .playing
        .as_ref()
        .map(|playing| playing.stage(smoke.as_ref()));
    let orbit = match &stage {
        Some(stage) => film.orbit(&frames.plan, &stage.with_cameras(prepared.lines.cameras()))?,
        None => film.orbit(&frames.plan, &prepared.lines)?,
    };

    // Draw all frames.
    let encoding = Encoding::Png { keep_alpha };
    let reel = film.reel(&frames, (job.options.size, keep_alpha), encoding);
    let (limits, external) = (&job.limits, args.drawing.allow_external.as_deref());
    let drawn_by = |prepared: &Prepared, renderer: &mut LineRenderer<'_>, camera: &Camera| {
        let mut drawing = renderer.draw(camera, &job.look.style, &job.options)?;
        Ok::<_, Unfit>(Take {
            notices: std::mem::take(&mut drawing.notices),
            times: renderer.times().to_vec(),
            shown: prepared.shown(&job, &drawing, camera)?,
        })
    };
    let played = |(playing, stage): (&Playing, &Stage), number: u32, engine: &dyn Engine| {
        let (scene, _) = playing.scene_at(number, &job.look, (limits, external))?;
        let prepared = lines::prepared(&job, &scene, smoke.clone())?;
        let orbit = match film.has_moving_camera() {
            true => film.orbit(&frames.plan, &stage.with_cameras(prepared.lines.cameras()))?,
            false => orbit,
        };
        let camera = orbit.at(frames.plan.angle(number));
        drawn_by(&prepared, &mut prepared.renderer(engine, &job), &camera)
    };
    let drawn = screened(reel, args.drawing.quiet, progress, |screening, progress| {
        let drawings = |engine: &dyn Engine| match frames.playing.as_ref().zip(stage.as_ref()) {
            Some(clip) => {
                screening.show_each(&frames.numbers, |number| played(clip, number, engine))
            }
            None => {
                let mut renderer = prepared.renderer(engine, &job);
                screening.show_each(&frames.numbers, |number| {
                    let camera = orbit.at(frames.plan.angle(number));
                    drawn_by(&prepared, &mut renderer, &camera)
                })
            }
        };
        engine.draw_as_step(&drawings, progress)
    })?;
    lines::tell_engine(&job, &drawn.engine, progress);
    Ok(Some(drawn))
}
