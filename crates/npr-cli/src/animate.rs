//! `npr animate`: draws films of a scene.

use crate::arguments::{
    AnimateArguments, DrawingArguments, Frames, LineFormat, LinesArguments, LookArguments,
    PoseArguments, RenderArguments, Switch,
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
use crate::lines;
use crate::message::{self, quoted};
use crate::output::Output;
use crate::playing::{Playing, Stage};
use crate::progress::Progress;
use crate::reel::{Codec, Encoding, FilmFormat, Reel, Stills, Whole, check_frames, check_rate};
use crate::render;
use crate::screening::{Step, Take, screened, steps};
use crate::source::Source;
use crate::target::Target;
use crate::timings::Timings;
use crate::viewpoint::{self, Orbit, Viewed};
use npr_core::camera::Camera;
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{RendererOptions, Shot, Smoke, cameras_of};
use npr_scene::Scene;
use npr_stylesheet::Style;
use std::io::Write;
use std::path::Path;

/// Seconds of a film in which pictures on surfaces alone move, whose length nobody says.
const FLOW_SECONDS: f32 = 5.0;

/// Draws the film that the user asked for, or prints the style.
pub fn animate(args: &AnimateArguments) -> Result<(), Fault> {
    if args.drawing.look.dump_style {
        return dump_style(&args.look(), &args.drawing);
    }
    let mut progress = Progress::new(args.drawing.quiet);
    let Some(drawn) = draw(args, &mut progress)? else {
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

/// Draws the film of some arguments; gives nothing where all of its frames are there.
pub fn draw(
    args: &AnimateArguments,
    progress: &mut Progress,
) -> Result<Option<Drawn<Vec<PassTime>>>, Fault> {
    let film = FilmJob::resolve(args)?;
    match film.lines {
        Some(format) => draw_lines(&film, format, progress),
        None => draw_frames(&film, progress),
    }
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
    /// Whether pictures on surfaces move.
    flows: bool,
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
    /// The format of the files that a name stands for; `-` takes a .png.
    fn of(path: &Path) -> Result<Self, Fault> {
        if path.as_os_str() == "-" {
            return Ok(Self::Pictures(PictureFormat::Png));
        }
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

    /// The frames of a film of a scene that was loaded; `flows` is whether pictures on its surfaces move.
    fn frames(&self, scene: &Scene, flows: bool) -> Result<Frameset, Fault> {
        let film = &self.args.film;
        let limits = self.args.drawing.limits.limits();
        let playing = Playing::of(&self.args.drawing.pose, scene, film.fps, &limits)?;
        let clip_s = playing.as_ref().and_then(Playing::duration_s);
        let plan = FilmPlan::new(film, clip_s.or(flows.then_some(FLOW_SECONDS)))?;
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
            flows,
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

    /// The way of the camera. `seen` is the scene, with the smoke in it, as it is prepared; where a clip plays, the
    /// camera is placed by all of it.
    fn way<'b>(
        &'b self,
        frames: &'b Frameset,
        (scene, smoke): (&Scene, Option<&Smoke>),
        seen: &dyn Viewed,
    ) -> Result<Way<'b>, Fault> {
        let args = &self.args.drawing;
        let stage = frames.playing.as_ref();
        let stage = stage.and_then(|playing| playing.stage(scene, smoke));
        let orbit = |seen: &dyn Viewed| orbit_of(args, &frames.plan, seen);
        Ok(Way {
            args,
            plan: &frames.plan,
            orbit: match &stage {
                Some(stage) => orbit(&stage.with_cameras(&cameras_of(scene)))?,
                None => orbit(seen)?,
            },
            stage,
        })
    }

    /// Whether strokes hold to those of the frame before.
    fn holds(&self) -> bool {
        self.args.film.hold == Switch::On
    }

    /// Warns of options that have no effect in the frames of the film, drawn in a style.
    fn tell_idle(&self, frames: &Frameset, style: &Style, progress: &Progress) {
        let is_timed = matches!(self.format, Format::Whole(_)) || frames.plays() || frames.flows;
        let notices = idle::of_animate(self.args, self.lines.is_some(), style, is_timed);
        let playing = frames.playing.iter().filter(|_| frames.plays());
        let of_pose = playing.flat_map(Playing::warnings);
        progress.suspend(|| {
            message::warn_all(self.args.drawing.quiet, of_pose);
            message::warn_all(self.args.drawing.quiet, notices);
        });
    }
}

/// The way of the camera through a film.
struct Way<'a> {
    args: &'a DrawingArguments,
    plan: &'a FilmPlan,
    orbit: Orbit,
    /// What is seen of a clip that plays.
    stage: Option<Stage>,
}

impl Way<'_> {
    /// The camera of a frame of a scene that stands still.
    fn still(&self, number: u32) -> Camera {
        self.orbit.at(self.plan.angle(number))
    }

    /// The camera of a frame, where a clip may have moved those of the scene.
    fn at(&self, number: u32, scene: &Scene) -> Result<Camera, Fault> {
        let Some(stage) = self
            .stage
            .as_ref()
            .filter(|_| self.args.camera.camera.is_some())
        else {
            return Ok(self.still(number));
        };
        let cameras = cameras_of(scene);
        let orbit = orbit_of(self.args, self.plan, &stage.with_cameras(&cameras))?;
        Ok(orbit.at(self.plan.angle(number)))
    }
}

/// The camera before it turns, and what it turns about.
fn orbit_of(args: &DrawingArguments, plan: &FilmPlan, seen: &dyn Viewed) -> Result<Orbit, Fault> {
    match plan.turn {
        Some(_) => viewpoint::orbit(&args.camera, seen, args.size),
        None => viewpoint::camera(&args.camera, seen, args.size).map(Orbit::still),
    }
}

impl Frameset {
    /// Whether a clip plays.
    fn plays(&self) -> bool {
        let playing = self.playing.as_ref();
        playing.is_some_and(|playing| playing.duration_s().is_some())
    }

    /// The pose that the scene holds in all frames; none where a clip plays.
    fn held<'a>(&self, args: &'a DrawingArguments) -> Option<&'a PoseArguments> {
        (!self.plays()).then_some(&args.pose)
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
    let loaded = render::load(&job, progress)?;
    let is_held = args.drawing.pose.time.is_some();
    let flows = !is_held && render::moves_pictures(&job.look.style, &loaded.scene);
    let frames = film.frames(&loaded.scene, flows)?;
    if frames.numbers.is_empty() {
        return Ok(None);
    }
    job.target = frames.target.clone();

    // Prepare it, and place the camera.
    let staged = render::prepare(&job, loaded, frames.held(&args.drawing), progress)?;
    film.tell_idle(&frames, &job.look.style, progress);
    let smoke = staged.smoke.as_ref();
    let way = film.way(&frames, (&staged.scene, smoke), &staged.seen()?)?;
    let options = RendererOptions {
        smoke: smoke.cloned(),
        // A part of the film must be the same as in the whole.
        alone: true,
        ..job.options.clone()
    };

    // Draw all frames. Pictures on surfaces move with them, unless a time holds them.
    let encoding = match format {
        PictureFormat::Png => Encoding::Png { keep_alpha },
        PictureFormat::Exr => Encoding::Exr(staged.subject.model.object_names()),
    };
    let reel = film.reel(&frames, (options.size, keep_alpha), encoding);
    let drawn = screened(reel, args.drawing.quiet, progress, |screening, progress| {
        let pictures = |engine: &dyn Engine| {
            let mut renderer = staged.renderer(engine, (&job.look.style, &options))?;
            let holds = film.holds() && renderer.has_strokes();
            if holds {
                renderer.hold_strokes();
            }
            let seconds = |number: u32| number as f32 / film.args.film.fps;
            let Some(playing) = &frames.playing else {
                if frames.flows {
                    let steps = steps(&frames.numbers, screening.done(), holds);
                    return screening.show_each(steps, |Step { number, passed }| {
                        let camera = way.still(number);
                        if passed {
                            renderer.pass(&camera)?;
                            return Ok(None);
                        }
                        renderer.flow_textures(seconds(number))?;
                        Ok(Some(Take::from(renderer.draw(&camera)?)))
                    });
                }
                let shots = steps(&frames.numbers, 0, holds).map(|step| Shot {
                    passed: step.passed,
                    ..Shot::from(way.still(step.number))
                });
                return screening.show_all(renderer, shots, holds);
            };
            let mut scene = staged.scene.clone();
            let steps = steps(&frames.numbers, screening.done(), holds);
            screening.show_each(steps, |Step { number, passed }| {
                let seen = |scene: &Scene| way.at(number, scene);
                let (camera, warning) = playing.pose(&mut scene, number, seen)?;
                let movement = playing.movement(&mut scene, (number, &camera), &job.look.style)?;
                renderer.set_pose(&scene)?;
                renderer.set_movement(movement);
                if passed {
                    renderer.pass(&camera)?;
                    return Ok(None);
                }
                if frames.flows {
                    renderer.flow_textures(seconds(number))?;
                }
                let mut take = Take::from(renderer.draw(&camera)?);
                take.notices.extend(warning);
                Ok(Some(take))
            })
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
    let loaded = lines::load(&job, progress)?;
    let frames = film.frames(&loaded.scene, false)?;
    if frames.numbers.is_empty() {
        return Ok(None);
    }
    job.target = frames.target.clone();

    // Prepare it, and place the camera.
    let prepared = lines::prepare(&job, loaded, frames.held(&args.drawing), progress)?;
    film.tell_idle(&frames, &job.look.style, progress);
    let smoke = prepared.smoke.as_ref();
    let way = film.way(&frames, (&prepared.scene, smoke), &prepared.lines)?;

    // Draw all frames.
    let encoding = Encoding::Png { keep_alpha };
    let reel = film.reel(&frames, (job.options.size, keep_alpha), encoding);
    let drawn = screened(reel, args.drawing.quiet, progress, |screening, progress| {
        let drawings = |engine: &dyn Engine| {
            let mut renderer = prepared.renderer(engine, &job);
            if film.holds() {
                renderer.hold_strokes();
            }
            let mut scene = prepared.scene.clone();
            let steps = steps(&frames.numbers, screening.done(), film.holds());
            screening.show_each(steps, |Step { number, passed }| {
                let mut notices = Vec::new();
                let camera = match &frames.playing {
                    None => way.still(number),
                    Some(playing) => {
                        let seen = |scene: &Scene| way.at(number, scene);
                        let (camera, warning) = playing.pose(&mut scene, number, seen)?;
                        let moment = (number, &camera);
                        let movement = playing.movement(&mut scene, moment, &job.look.style)?;
                        renderer.set_pose(&scene)?;
                        renderer.set_movement(movement);
                        notices.extend(warning);
                        camera
                    }
                };
                if passed {
                    renderer.pass(&camera, &job.look.style, &job.options)?;
                    return Ok(None);
                }
                let mut drawing = renderer.draw(&camera, &job.look.style, &job.options)?;
                notices.append(&mut drawing.notices);
                Ok(Some(Take {
                    shown: prepared.shown(&job, &drawing, &camera)?,
                    notices,
                    times: renderer.times().to_vec(),
                }))
            })
        };
        engine.draw_as_step(&drawings, progress)
    })?;
    lines::tell_engine(&job, &drawn.engine, progress);
    Ok(Some(drawn))
}
