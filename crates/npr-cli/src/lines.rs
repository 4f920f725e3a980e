//! `npr lines`: draws the lines of a scene as curves.

use crate::arguments::{
    Backend, LineArguments, LineFormat, LinesArguments, PoseArguments, RenderArguments,
    SheetArguments,
};
use crate::dump::dump_style;
use crate::engine::{Drawn, EngineChoice};
use crate::fault::{Exit, Fault};
use crate::idle;
use crate::line_file::{self, Ink};
use crate::line_job::{LineJob, fills_by_textures};
use crate::look::Look;
use crate::message;
use crate::pose::{self, Posed};
use crate::progress::Progress;
use crate::reel::Shown;
use crate::source::Loaded;
use crate::timings::Timings;
use crate::viewpoint;
use crate::volume::{self, Order};
use npr_core::camera::Camera;
use npr_core::geometry::Part;
use npr_drawing::artwork::StrokeBrushes;
use npr_gpu::engine::{Engine, PassTime};
use npr_render::{
    Drawing, Kind, LineModel, LineModelOptions, LineRenderer, LineSource, Model, RenderError,
    Smoke, facts_of,
};
use npr_scene::{Limits, Scene};
use npr_stylesheet::{Background, Style};
use std::io::Write;

/// Draws the lines that the user asked for, or prints the style.
pub fn lines(args: &LinesArguments) -> Result<(), Fault> {
    if args.drawing.look.dump_style {
        return dump_style(&args.look(), &args.drawing);
    }
    let mut progress = Progress::new(args.drawing.quiet);
    let drawn = draw(&LineJob::resolve(args)?, &mut progress)?;
    let steps = progress.finish();
    if let Some(form) = args.drawing.timings {
        let timings = Timings::new(drawn.engine, &steps, &drawn.picture.times);
        let _ = std::io::stderr().write_all(timings.reported(form).as_bytes());
    }
    Ok(())
}

/// Draws a picture for `npr render` as curves. Its style must draw nothing but lines.
pub fn lines_of_picture(args: &RenderArguments) -> Result<(), Fault> {
    let look = Look::resolve(&args.drawing.look, args.drawing.allow_external.as_deref())?;
    let Some(paper) = look.paper_of_lines() else {
        let message = "this style fills surfaces with tones, which .svg pictures have none of: \
                       write .png, or draw the lines alone with npr lines";
        return Err(Fault::new(Exit::Usage, message));
    };
    if args.enlarge > 1 {
        message::warn(
            args.drawing.quiet,
            "--enlarge is ignored: .svg files have no pixels",
        );
    }
    let lines_said = LinesArguments {
        scene: args.scene.clone(),
        output: args.output.clone(),
        format: Some(LineFormat::Svg),
        lines: LineArguments {
            // Paper in the colour of the background would not show.
            fill: look.style.background != Background::Color(paper),
            ..LineArguments::default()
        },
        sheet: SheetArguments::default(),
        drawing: args.drawing.clone(),
        cache: args.cache.clone(),
    };
    lines(&lines_said)
}

/// Loads the scene, draws its lines and writes the file.
fn draw(job: &LineJob<'_>, progress: &mut Progress) -> Result<Drawn<LineFrame>, Fault> {
    line_file::check_memory(job)?;
    let engine = EngineChoice::begin(&job.args.drawing);
    let loaded = load(job, progress)?;
    let mut model = prepare(job, loaded, Some(&job.args.drawing.pose), progress)?;
    let args = &job.args.drawing;
    let camera = viewpoint::camera(&args.camera, &model.lines, args.size)?;
    if model
        .posed
        .face(&mut model.scene, &camera, &job.look.style)?
    {
        model.follow(progress)?;
    }
    let drawn = draw_lines((job, &engine), &model, &camera, progress)?;
    let drawing = &drawn.picture.drawing;
    progress.suspend(|| {
        message::warn_all(job.args.drawing.quiet, &drawing.notices);
    });
    let bytes = progress.step("encode", || {
        line_file::encode(job, drawing, model.ink(job, &camera))
    })?;
    progress.step("write", || job.target.output(0)?.write(&bytes))?;
    Ok(drawn)
}

/// A scene prepared for drawing lines.
pub struct Prepared {
    /// Its lines.
    pub lines: LineModel,
    /// The model that the background is drawn from, where lines adapt to it.
    behind: Option<Model>,
    /// What the strokes of the file are drawn with.
    brushes: StrokeBrushes,
    /// The smoke in the scene.
    pub smoke: Option<Smoke>,
    /// What all of it was made of, in the same pose.
    pub scene: Scene,
    /// How it came into that pose.
    posed: Posed,
}

impl Prepared {
    /// What the file has beside the lines that a camera sees: the brushes that draw them, and words.
    fn ink(&self, job: &LineJob<'_>, camera: &Camera) -> Ink {
        let view = camera.view(job.options.size, self.lines.bounds());
        Ink {
            brushes: self.brushes.clone(),
            lettering: job.lettering.placed(&view, job.options.dpi),
        }
    }

    /// A frame of a film: the drawing of what a camera sees, as pixels or as the bytes of a file.
    pub fn shown(
        &self,
        job: &LineJob<'_>,
        drawing: &Drawing,
        camera: &Camera,
    ) -> Result<Shown, Fault> {
        let ink = self.ink(job, camera);
        match job.format {
            LineFormat::Png => line_file::pixels(job, drawing, ink).map(Shown::Pixels),
            _ => line_file::encode(job, drawing, ink).map(Shown::File),
        }
    }

    /// Moves all of it into the pose that the user asked for, and gives what there is to warn of.
    fn pose(
        &mut self,
        args: &PoseArguments,
        (style, limits): (&Style, &Limits),
        progress: &mut Progress,
    ) -> Result<Vec<String>, Fault> {
        self.posed = pose::pose((args, false), &mut self.scene, style, limits)?;
        if self.posed.is_posed {
            self.follow(progress)?;
        }
        Ok(self.posed.warnings.clone())
    }

    /// Moves its lines, and what is behind them, to where the scene stands.
    fn follow(&mut self, progress: &mut Progress) -> Result<(), RenderError> {
        progress.step("pose", || {
            self.lines.set_pose(&self.scene)?;
            let behind = self.behind.as_mut();
            behind.map_or(Ok(()), |model| model.set_pose(&self.scene))
        })
    }

    /// A renderer of its lines.
    pub fn renderer<'a>(
        &'a self,
        engine: &'a dyn Engine,
        job: &'a LineJob<'_>,
    ) -> LineRenderer<'a> {
        let mut renderer = LineRenderer::new(engine, &self.lines);
        renderer.set_movement(self.posed.movement.clone());
        match (&self.behind, &job.backdrop) {
            (Some(model), Some(options)) => renderer.with_backdrop(model, options),
            _ => renderer,
        }
    }
}

/// A drawing, and the times of the passes on its engine.
struct LineFrame {
    drawing: Drawing,
    times: Vec<PassTime>,
}

fn draw_lines(
    (job, engine): (&LineJob<'_>, &EngineChoice<'_>),
    model: &Prepared,
    camera: &Camera,
    progress: &mut Progress,
) -> Result<Drawn<LineFrame>, Fault> {
    let picture = |engine: &dyn Engine| {
        let mut renderer = model.renderer(engine, job);
        Ok(LineFrame {
            drawing: renderer.draw(camera, &job.look.style, &job.options)?,
            times: renderer.times().to_vec(),
        })
    };
    let drawn = engine.draw_as_step(&picture, progress)?;
    tell_engine(job, &drawn.engine, progress);
    Ok(drawn)
}

/// Tells what of a job is the processor's, where a device was asked for.
pub fn tell_engine(job: &LineJob<'_>, engine: &str, progress: &Progress) {
    let reported = match job.options.method {
        LineSource::Edges | LineSource::Potrace => None,
        LineSource::Surface => {
            Some("finds contours along edges; smooth ones are made from them on the processor")
        }
        LineSource::Image => {
            Some("finds marked lines; those of pictures are found on the processor")
        }
    };
    if let Some(reported) = reported.filter(|_| job.args.drawing.backend == Backend::Gpu) {
        let text = format!("{engine} {reported}");
        progress.suspend(|| message::warn(job.args.drawing.quiet, &text));
    }
}

/// Loads the scene of a job, with the clips and expressions that the user gives it.
pub fn load(job: &LineJob<'_>, progress: &mut Progress) -> Result<Loaded, Fault> {
    let external = job.args.drawing.allow_external.as_deref();
    progress.step("load", || {
        let mut loaded = match job.args.built_in() {
            Some(source) => Loaded::of_smoke(source),
            None => job.source.load(&job.limits, external)?,
        };
        pose::dress(&job.args.drawing.pose, &mut loaded, &job.limits)?;
        Ok(loaded)
    })
}

/// Prepares the scene and the smoke in it, and warns about what is ignored. The scene takes the pose that is asked
/// for; without `pose` it rests.
pub fn prepare(
    job: &LineJob<'_>,
    mut loaded: Loaded,
    pose: Option<&PoseArguments>,
    progress: &mut Progress,
) -> Result<Prepared, Fault> {
    // Refuse to draw over its files, and add the smoke in it.
    let external = job.args.drawing.allow_external.as_deref();
    let mut inputs = loaded.inputs;
    inputs.extend(job.look.inputs());
    job.target.refuse_any_of(&inputs)?;
    let order = Order {
        args: &job.args.drawing.volumes,
        style: &job.look.style.smoke,
        limits: &job.limits,
    };
    let of_volumes = idle::of_volumes(&order, loaded.volume.as_ref());
    let (smoke, reported) = volume::step(progress, &order, loaded.volume)?;
    job.target.refuse_any_of(&reported.inputs)?;

    // Prepare the scene for the style.
    job.look
        .apply_id_maps(&mut loaded.scene, &job.limits, external)?;
    let facts = facts_of(&loaded.scene, smoke.is_some());
    let mut prepared = progress.step("prepare", || prepared(job, loaded.scene, smoke))?;

    // Pose it.
    let of_pose = match pose {
        Some(args) => prepared.pose(args, (&job.look.style, &job.limits), progress)?,
        None => Vec::new(),
    };

    // Warn about what was mended, and about keys and options that have no effect.
    progress.suspend(|| {
        warn_of(job, &prepared.lines, reported.notices.iter());
        let keys = job.look.notices(&job.occasion(facts));
        let options = idle::of_lines(job, facts, !prepared.brushes.all.is_empty());
        message::warn_all(
            job.args.drawing.quiet,
            keys.iter()
                .chain(&options)
                .chain(&of_pose)
                .chain(&of_volumes),
        );
    });
    Ok(prepared)
}

/// A scene with smoke in it, prepared for drawing its lines.
fn prepared(job: &LineJob<'_>, scene: Scene, smoke: Option<Smoke>) -> Result<Prepared, Fault> {
    // Prepare its lines.
    let options = LineModelOptions {
        weld: job.args.lines.weld,
        memory_limit: job.limits.memory_bytes,
        painted: job.options.painted.is_some(),
        fills: fills_by_textures(job.args, &job.look.style),
    };
    let (style, cache) = (&job.look.style, job.cache.as_deref());
    let mut model = LineModel::for_style(&scene, style, &options, cache)?;
    model.set_smoke(smoke.clone());
    let is_painted = style.line_paint_flags() & Part::LINE_TEXTURE != 0;
    if is_painted || style.line.width.picture().is_some() || job.lays_brushes() {
        let limits = job.args.drawing.limits.limits();
        let external = job.args.drawing.allow_external.as_deref();
        model.set_pictures(job.look.pictures(&limits, external)?);
    }

    // Prepare what draws them, and what is behind them.
    let brushes = match job.lays_brushes() {
        true => model.brushes(style, &job.options)?,
        false => StrokeBrushes::default(),
    };
    let behind = job.backdrop.as_ref().map(|_| Model::cached(&scene, cache));
    Ok(Prepared {
        lines: model,
        behind: behind.transpose()?,
        brushes,
        smoke,
        scene,
        posed: Posed::default(),
    })
}

fn is_intersection(kind: &Kind) -> bool {
    *kind == Kind::Intersection
}

fn warn_of<'a>(
    job: &LineJob<'_>,
    model: &'a LineModel,
    of_smoke: impl Iterator<Item = &'a String>,
) {
    let warn = |text: &str| message::warn(job.args.drawing.quiet, text);
    for notice in model.notices().iter().chain(of_smoke) {
        warn(notice);
    }
    for notice in job.lettering.notices() {
        warn(notice);
    }
    if job.look.style.lettering.iter().any(|words| words.hidden) {
        warn("lettering.hidden plays no part in line drawings: words lie over everything");
    }
    if job.format == LineFormat::Json && !job.lettering.is_empty() {
        warn("words are left out: .json files hold lines alone");
    }
    if matches!(job.look.style.background, Background::Image(_)) {
        warn(match job.backdrop {
            Some(_) => {
                "the picture behind is left out: lines mind it, but are drawn on a colour or on nothing"
            }
            None => "the picture behind is left out: lines are drawn on a colour or on nothing",
        });
    }
    if let Some(notice) = job.look.style.line_source_notice() {
        warn(notice);
    }
    let mut named = job.args.lines.kinds.iter().flatten();
    if job.options.method == LineSource::Potrace && named.any(is_intersection) {
        warn("lines of kind intersection are left out: --method potrace draws edges of meshes");
    }
}
