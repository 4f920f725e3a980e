//! `npr render`: draws one picture of a scene.

use crate::arguments::{DrawingArguments, PoseArguments, RenderArguments};
use crate::bands::draw_into;
use crate::debug_layer::DebugLayer;
use crate::dump::dump_style;
use crate::encoder;
use crate::ending::has_ending;
use crate::engine::{Drawn, EngineChoice};
use crate::fault::{Exit, Fault};
use crate::idle;
use crate::job::{Job, PictureFormat};
use crate::layers;
use crate::lines;
use crate::look::Look;
use crate::message;
use crate::output::{Output, print};
use crate::pose::{self, Posed};
use crate::progress::Progress;
use crate::source::Loaded;
use crate::timings::{DRAW, Timings};
use crate::viewpoint::{self, Seen};
use crate::volume::{self, Order};
use npr_core::camera::Camera;
use npr_gpu::engine::Engine;
use npr_render::{
    Frame, LineModelOptions, Model, RenderError, Renderer, RendererOptions, Smoke, Subject,
    facts_of,
};
use npr_scene::{Limits, Scene};
use npr_stylesheet::{Facts, Occasion, SceneHint, Style};
use std::borrow::Cow;
use std::io::Write;
use std::path::Path;

/// Draws what the user asked for, or prints its style.
pub fn render(args: &RenderArguments) -> Result<(), Fault> {
    if args.drawing.look.dump_style {
        return dump_style(&args.look(), &args.drawing);
    }
    if args.debug_layer == Some(DebugLayer::List) {
        return print(DebugLayer::list().as_bytes());
    }
    if args.scene.is_none() {
        let message = "the scene is missing: --debug-layer shows a layer of one";
        return Err(Fault::new(Exit::Usage, message));
    }
    if args.debug_layer.is_none()
        && args
            .output
            .as_deref()
            .is_some_and(|path| has_ending(path, "svg"))
    {
        return lines::lines_of_picture(args);
    }
    let mut progress = Progress::new(args.drawing.quiet);
    let drawn = draw(&Job::resolve(args)?, &mut progress)?;
    let steps = progress.finish();
    if let Some(form) = args.drawing.timings {
        let timings = Timings::new(drawn.engine, &steps, &drawn.picture.times);
        let _ = std::io::stderr().write_all(timings.reported(form).as_bytes());
    }
    Ok(())
}

/// Loads the scene, draws it and writes the picture.
fn draw(job: &Job<'_>, progress: &mut Progress) -> Result<Drawn<Frame>, Fault> {
    // Load the scene and look at it, while a device opens.
    let engine = EngineChoice::begin(&job.args.drawing);
    let loaded = load(job, progress)?;
    let pose = &job.args.drawing.pose;
    let mut prepared = prepare(job, loaded, Some(pose), progress)?;
    let camera = viewpoint::camera(
        &job.args.drawing.camera,
        &prepared.seen()?,
        job.args.drawing.size,
    )?;
    let posed = &mut prepared.posed;
    posed.face(&mut prepared.scene, &camera, &job.look.style)?;
    let options = RendererOptions {
        smoke: prepared.smoke.clone(),
        in_bands: true,
        ..job.options.clone()
    };

    // Draw it, whole or band by band into its file.
    let output = job.target.output(0)?;
    let drawn = draw_frame(
        (job, &engine, &output),
        &prepared,
        &options,
        &camera,
        progress,
    )?;
    let (mut frame, is_written) = match drawn.picture {
        Picture::Whole(frame) => (frame, false),
        Picture::InBands(written) => (written?, true),
    };
    progress.suspend(|| {
        message::warn_all(job.args.drawing.quiet, &frame.notices);
    });

    // Write a whole picture.
    if !is_written {
        let bytes = progress.step("encode", || match job.format {
            PictureFormat::Png => encoder::png(frame.size, &frame.rgba, job.look.is_transparent()),
            PictureFormat::Exr => layers::exr(&mut frame, &prepared.subject.model.object_names()),
        })?;
        progress.step("write", || output.write(&bytes))?;
    }
    let engine = drawn.engine;
    Ok(Drawn {
        picture: frame,
        engine,
    })
}

/// A picture that was drawn.
enum Picture {
    /// A picture that is still to be written.
    Whole(Frame),
    /// A picture that was written band by band as it was drawn, or the fault of writing. The frame has no pixels.
    InBands(Result<Frame, Fault>),
}

/// The camera that the user asked for, or one that frames the scene and the smoke in it.
pub fn camera_of(
    subject: &Subject,
    args: &DrawingArguments,
    smoke: &Smoke,
) -> Result<Camera, Fault> {
    let seen = Seen {
        model: Cow::Borrowed(&subject.model),
        smoke: Cow::Borrowed(smoke),
    };
    viewpoint::camera(&args.camera, &seen, args.size)
}

/// Prepares a scene for drawing in a style.
pub fn prepared(
    scene: &Scene,
    style: &Style,
    limits: &Limits,
    cache: Option<&Path>,
    progress: &mut Progress,
) -> Result<Subject, Fault> {
    // Prepare surfaces.
    let model = progress.step("prepare", || Model::cached(scene, cache))?;

    // Prepare its lines, where the style draws strokes.
    let mut lines = None;
    if style.has_curves() {
        let options = LineModelOptions {
            memory_limit: limits.memory_bytes,
            ..LineModelOptions::default()
        };
        lines = progress.step("prepare", || Subject::lines(scene, style, &options, cache))?;
    }
    Ok(Subject { model, lines })
}

/// Loads the scene of a job, with the clips and expressions that the user gives it.
pub fn load(job: &Job<'_>, progress: &mut Progress) -> Result<Loaded, Fault> {
    let limits = job.args.drawing.limits.limits();
    let external = job.args.drawing.allow_external.as_deref();
    progress.step("load", || {
        let mut loaded = job.source.load(&limits, external)?;
        pose::dress(&job.args.drawing.pose, &mut loaded, &limits)?;
        Ok(loaded)
    })
}

/// A scene with smoke in it, ready to be drawn.
pub struct Prepared {
    /// The scene at rest, prepared for its style.
    pub subject: Subject,
    /// The smoke in it.
    pub smoke: Option<Smoke>,
    /// What the subject was made of, in the pose that is drawn.
    pub scene: Scene,
    /// How it came into that pose.
    posed: Posed,
    /// Seconds after which pictures on surfaces are drawn.
    seconds: f32,
}

impl Prepared {
    /// What a camera is placed by.
    pub fn seen(&self) -> Result<Seen<'_>, RenderError> {
        let mut model = Cow::Borrowed(&self.subject.model);
        if self.posed.is_posed {
            model.to_mut().set_pose(&self.scene)?;
        }
        let smoke = self.smoke.clone().unwrap_or_default();
        Ok(Seen {
            model,
            smoke: Cow::Owned(smoke),
        })
    }

    /// A renderer of the pose. What its style lays on surfaces is that of the scene at rest.
    pub fn renderer<'a>(
        &'a self,
        engine: &'a dyn Engine,
        (style, options): (&Style, &RendererOptions),
    ) -> Result<Renderer<'a>, RenderError> {
        let mut renderer = self.subject.renderer(engine, style, options)?;
        if self.posed.is_posed {
            renderer.set_pose(&self.scene)?;
        }
        renderer.set_movement(self.posed.movement.clone());
        if self.seconds != 0.0 {
            renderer.flow_textures(self.seconds)?;
        }
        Ok(renderer)
    }
}

/// Prepares the scene and the smoke in it, and warns about what is ignored. The scene takes the pose that is asked
/// for; without `pose` it rests.
pub fn prepare(
    job: &Job<'_>,
    mut loaded: Loaded,
    pose: Option<&PoseArguments>,
    progress: &mut Progress,
) -> Result<Prepared, Fault> {
    // Refuse to draw over its files.
    let (limits, external) = (
        job.args.drawing.limits.limits(),
        job.args.drawing.allow_external.as_deref(),
    );
    let mut inputs = loaded.inputs;
    inputs.extend(job.look.inputs());
    job.target.refuse_any_of(&inputs)?;

    // Add the smoke in it.
    let order = Order {
        args: &job.args.drawing.volumes,
        style: &job.look.style.smoke,
        limits: &limits,
    };
    let of_volumes = idle::of_volumes(&order, loaded.volume.as_ref());
    let (smoke, reported) = volume::step(progress, &order, loaded.volume)?;
    job.target.refuse_any_of(&reported.inputs)?;

    // Prepare the scene for the style.
    job.look
        .apply_id_maps(&mut loaded.scene, &limits, external)?;
    let (style, cache) = (&job.look.style, job.cache.as_deref());
    let mut scene = loaded.scene;
    let subject = prepared(&scene, style, &limits, cache, progress)?;

    // Pose the scene.
    let (mut posed, mut seconds) = (Posed::default(), 0.0);
    if let Some(args) = pose {
        let flows = moves_pictures(style, &scene);
        posed = pose::pose((args, flows), &mut scene, style, &limits)?;
        seconds = args.time.unwrap_or(0.0);
    }

    // Warn about what was mended, and about keys and options that have no effect.
    let facts = facts_of(&scene, smoke.is_some());
    progress.suspend(|| {
        warn_of(job, &subject.model, reported.notices.iter());
        warn_of_idle(&job.look, facts, job.args.drawing.quiet);
        message::warn_all(
            job.args.drawing.quiet,
            posed.warnings.iter().chain(&of_volumes),
        );
    });
    Ok(Prepared {
        subject,
        smoke,
        scene,
        posed,
        seconds,
    })
}

/// Whether pictures on surfaces of a scene move in time, in a style that lets them.
pub fn moves_pictures(style: &Style, scene: &Scene) -> bool {
    style.use_scene_hints.uses(SceneHint::Shade) && has_moving_pictures(scene)
}

/// Whether pictures on surfaces of a scene move in time where a style lets them.
pub fn has_moving_pictures(scene: &Scene) -> bool {
    let mut toons = scene.materials.iter().flat_map(|material| &material.toon);
    toons.any(|toon| !toon.flow.is_still())
}

/// Warns about stated keys of the style that have no effect in pictures of a scene.
pub fn warn_of_idle(look: &Look, scene: Facts, quiet: bool) {
    let output = npr_stylesheet::Output::Frame;
    message::warn_all(quiet, look.notices(&Occasion { output, scene }));
}

fn warn_of<'a>(job: &Job<'_>, model: &'a Model, of_smoke: impl Iterator<Item = &'a String>) {
    let quiet = job.args.drawing.quiet;
    message::warn_all(quiet, model.notices().iter().chain(of_smoke));
    if let Some(warning) = job.look.width_warning(job.options.size[1]) {
        message::warn(quiet, &warning.to_string());
    }
}

fn draw_frame(
    (job, engine, output): (&Job<'_>, &EngineChoice<'_>, &Output),
    prepared: &Prepared,
    options: &RendererOptions,
    camera: &Camera,
    progress: &mut Progress,
) -> Result<Drawn<Picture>, Fault> {
    // Draw band by band into the file, unless the renderer needs the whole frame at once.
    let counter = progress.counter();
    let tell = |done, of| counter.tell(DRAW, done, of);
    let picture = |engine: &dyn Engine| {
        let renderer = prepared.renderer(engine, (&job.look.style, options))?;
        let mut renderer = renderer.with_progress(&tell);
        if let Some(layer) = job.args.debug_layer {
            let frame = layer.draw(&mut renderer, camera, options.size);
            return frame.map(Picture::Whole);
        }
        if !renderer.draws_bands() {
            return renderer.draw(camera).map(Picture::Whole);
        }
        let keep_alpha = job.look.is_transparent();
        let written = draw_into(output, &mut renderer, camera, options.size, keep_alpha)?;
        Ok(Picture::InBands(written))
    };

    // Draw on the engine asked for.
    engine.draw_as_step(&picture, progress)
}
