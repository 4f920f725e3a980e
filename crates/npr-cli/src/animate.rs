//! `npr animate`: draws films of a scene.

use crate::arguments::{
    AnimateArguments, Frames, LineFormat, LinesArguments, LookArguments, RenderArguments,
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
use crate::progress::Progress;
use crate::reel::{Codec, Encoding, FilmFormat, Reel, Stills, Whole, check_rate};
use crate::render;
use crate::screening::{Screening, screened};
use crate::source::Source;
use crate::target::Target;
use crate::timings::Timings;
use crate::viewpoint::{self, Orbit, Seen, Viewed};
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{RenderError, RendererOptions, Shot, Smoke};
use std::cell::RefCell;
use std::io::Write;
use std::path::Path;

/// Draws the film that the user asked for, or prints the style.
pub fn animate(args: &AnimateArguments) -> Result<(), Fault> {
    if args.drawing.look.dump_style {
        return dump_style(&args.look(), &args.drawing);
    }
    let film = FilmJob::resolve(args)?;
    if film.numbers.is_empty() {
        // All frames are there.
        return Ok(());
    }
    let mut progress = Progress::new(args.drawing.quiet);
    let drawn = match film.lines {
        Some(format) => draw_lines(&film, format, &mut progress)?,
        None => draw_frames(&film, &mut progress)?,
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
    plan: FilmPlan,
    target: Target,
    format: Format,
    /// The format of its line drawings, PNG for those that become pixels; none where frames are pictures.
    lines: Option<LineFormat>,
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
        // Find the frames of the film, and the files that they go to.
        let source = Source::of(args.scene.as_deref().unwrap_or(Path::new("-")));
        let plan = FilmPlan::new(&args.film)?;
        let path = film_path(args.output.as_deref(), &source)?;
        let format = Format::of(&path)?;
        let Frames { first, last } = plan.frames;
        let target = match format {
            Format::Whole(_) if path.to_string_lossy().contains('#') => {
                let message = format!("{} holds all frames: its name takes no #", quoted(&path));
                return Err(Fault::new(Exit::Usage, message));
            }
            Format::Whole(_) => Target::One(Output::of(&path)?),
            _ => Target::of(&path)?.over(first, last)?,
        };

        // Leave out those that are there.
        let is_wanted = |number: &u32| !args.film.resume || !target.is_there(*number);
        if args.film.resume && matches!(target, Target::One(_)) {
            let message = format!(
                "--resume goes on with numbered files, such as frame_####.png, but {} is one",
                quoted(&path)
            );
            return Err(Fault::new(Exit::Usage, message));
        }
        Ok(Self {
            args,
            source,
            plan,
            format,
            lines: format.lines(args.lines_only)?,
            numbers: (first..=last).filter(is_wanted).collect(),
            target,
        })
    }

    /// The files of the film, of `size` pixels where they are pictures, with a name for every object of layers.
    fn reel<'b>(
        &'b self,
        size: [u32; 2],
        keep_alpha: bool,
        encoding: Encoding<'b>,
    ) -> Result<Reel<'b>, Fault> {
        let (Format::Whole(format), Target::One(output)) = (self.format, &self.target) else {
            return Ok(Reel::Stills(Stills {
                target: &self.target,
                numbers: self.numbers.clone(),
                encoding,
            }));
        };
        Ok(Reel::Whole(Whole {
            output,
            format,
            size,
            count: self.numbers.len() as u32,
            fps: self.args.film.fps,
            keep_alpha,
        }))
    }

    /// Refuses what the format of the film cannot hold, before there is any work.
    fn check(&self, size: [u32; 2], keep_alpha: bool) -> Result<(), Fault> {
        match self.format {
            Format::Whole(FilmFormat::Gif) => check_rate(self.args.film.fps),
            Format::Whole(FilmFormat::Video(codec)) => codec.check(size, keep_alpha),
            _ => Ok(()),
        }
    }

    /// The way of the camera, and the view of every frame.
    fn orbit(&self, seen: &dyn Viewed) -> Result<Orbit, Fault> {
        let (camera, size) = (&self.args.drawing.camera, self.args.drawing.size);
        match self.plan.turn {
            Some(_) => viewpoint::orbit(camera, seen, size),
            None => viewpoint::camera(camera, seen, size).map(Orbit::still),
        }
    }

    fn tell_idle(&self, progress: &Progress) {
        let is_timed = matches!(self.format, Format::Whole(_));
        let notices = idle::of_animate(self.args, self.lines.is_some(), is_timed);
        progress.suspend(|| message::warn_all(self.args.drawing.quiet, notices));
    }
}

/// Draws a film of pictures.
fn draw_frames(film: &FilmJob<'_>, progress: &mut Progress) -> Result<Drawn<Vec<PassTime>>, Fault> {
    // Load the scene, and place the camera.
    let args = film.args.of_picture();
    let format = match film.format {
        Format::Pictures(format) => format,
        _ => PictureFormat::Png,
    };
    let job = Job::drawn_into(&args, film.source.clone(), film.target.clone(), format)?;
    let keep_alpha = job.look.is_transparent();
    film.check(job.options.size, keep_alpha)?;
    let engine = EngineChoice::begin(&args.drawing);
    let (prepared, smoke) = render::prepare(&job, progress)?;
    film.tell_idle(progress);
    let none = Smoke::default();
    let orbit = film.orbit(&Seen {
        model: &prepared.model,
        smoke: smoke.as_ref().unwrap_or(&none),
    })?;
    let options = RendererOptions {
        smoke,
        ..job.options.clone()
    };

    // Draw all frames.
    let encoding = match format {
        PictureFormat::Png => Encoding::Png { keep_alpha },
        PictureFormat::Exr => Encoding::Exr(prepared.model.object_names()),
    };
    let reel = film.reel(options.size, keep_alpha, encoding)?;
    let cameras = film
        .numbers
        .iter()
        .map(|number| orbit.at(film.plan.angle(*number)));
    let quiet = args.drawing.quiet;
    screened(reel, quiet, progress, |screening, progress| {
        let pictures = |engine: &dyn Engine| {
            let renderer = prepared.renderer(engine, &job.look.style, &options)?;
            screening.show_all(renderer, cameras.clone().map(Shot::from))
        };
        engine.draw_as_step(&pictures, progress)
    })
}

/// Draws a film of line drawings.
fn draw_lines(
    film: &FilmJob<'_>,
    format: LineFormat,
    progress: &mut Progress,
) -> Result<Drawn<Vec<PassTime>>, Fault> {
    // Load the scene, and place the camera.
    let args = film.args.of_lines(format);
    let job = LineJob::drawn_into(&args, film.source.clone(), film.target.clone(), format)?;
    let keep_alpha = job.look.is_transparent();
    film.check(job.options.size, keep_alpha)?;
    line_file::check_memory(&job)?;
    let engine = EngineChoice::begin(&args.drawing);
    let model = lines::prepare(&job, progress)?;
    film.tell_idle(progress);
    let orbit = film.orbit(&model.lines)?;

    // Draw all frames.
    let reel = film.reel(job.options.size, keep_alpha, Encoding::Png { keep_alpha })?;
    let failed = RefCell::new(None);
    let show = |screening: &Screening, engine: &dyn Engine| -> Result<(), RenderError> {
        let mut renderer = model.renderer(engine, &job);
        for number in film.numbers.iter().skip(screening.done()) {
            let camera = orbit.at(film.plan.angle(*number));
            let mut drawing = renderer.draw(&camera, &job.look.style, &job.options)?;
            let notices = std::mem::take(&mut drawing.notices);
            let shown = match model.shown(&job, &drawing, &camera) {
                Ok(shown) => shown,
                Err(fault) => {
                    *failed.borrow_mut() = Some(fault);
                    break;
                }
            };
            if !screening.show(shown, notices, renderer.times()) {
                break;
            }
        }
        Ok(())
    };
    let quiet = args.drawing.quiet;
    let drawn = screened(reel, quiet, progress, |screening, progress| {
        let drawn = engine.draw_as_step(&|engine| show(screening, engine), progress)?;
        match failed.take() {
            Some(fault) => Err(fault),
            None => Ok(drawn),
        }
    })?;
    lines::tell_engine(&job, &drawn.engine, progress);
    Ok(drawn)
}
