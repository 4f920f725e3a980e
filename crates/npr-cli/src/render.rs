//! `npr render`: one picture of a scene.

use crate::arguments::{DrawingArguments, RenderArguments};
use crate::encoder;
use crate::engine::{self, Drawn};
use crate::fault::{Exit, Fault};
use crate::job::{Job, has_ending};
use crate::lines;
use crate::look::Look;
use crate::message;
use crate::output;
use crate::progress::Progress;
use crate::timings::Timings;
use crate::viewpoint;
use npr_core::camera::Camera;
use npr_gpu::engine::Engine;
use npr_render::{Frame, LineModel, LineModelOptions, Model, Stage};
use std::io::Write;

/// Draws what the user asked for, or prints its style.
pub fn render(said: &RenderArguments) -> Result<(), Fault> {
    if said.drawing.look.dump_style {
        return dump_style(&said.drawing);
    }
    if said
        .output
        .as_deref()
        .is_some_and(|path| has_ending(path, "svg"))
    {
        return lines::lines_of_picture(said);
    }
    let mut progress = Progress::new(said.drawing.quiet);
    let drawn = draw(&Job::resolve(said)?, &mut progress)?;
    let steps = progress.finish();
    if let Some(form) = said.drawing.timings {
        let timings = Timings::new(drawn.engine, &steps, &drawn.picture.times);
        let _ = std::io::stderr().write_all(timings.told(form).as_bytes());
    }
    Ok(())
}

/// Prints a style as it comes out.
pub fn dump_style(said: &DrawingArguments) -> Result<(), Fault> {
    let look = Look::resolve(&said.look, said.allow_external.as_deref())?;
    let text = look
        .style
        .to_toml()
        .map_err(|error| Fault::new(Exit::Failed, error))?;
    output::print(text.as_bytes())
}

/// From the scene's file to the picture's.
fn draw(job: &Job<'_>, progress: &mut Progress) -> Result<Drawn<Frame>, Fault> {
    let (model, lines) = prepare(job, progress)?;
    let camera = viewpoint::camera(&job.said.drawing.camera, &model, job.said.drawing.size)?;
    let drawn = draw_frame(job, &model, lines.as_ref(), &camera, progress)?;
    let frame = &drawn.picture;
    progress.suspend(|| {
        for notice in &frame.notices {
            message::warn(job.said.drawing.quiet, notice);
        }
    });
    let keep_alpha = job.look.is_transparent();
    let bytes = progress.step("encode", || {
        encoder::png(frame.size, &frame.rgba, keep_alpha)
    })?;
    progress.step("write", || job.output.write(&bytes))?;
    Ok(drawn)
}

/// Loads the scene and makes it ready, for lines as curves too where the style has any; says what is ignored.
fn prepare(job: &Job<'_>, progress: &mut Progress) -> Result<(Model, Option<LineModel>), Fault> {
    let (limits, external) = (
        job.said.drawing.limits.limits(),
        job.said.drawing.allow_external.as_deref(),
    );
    let loaded = progress.step("load", || job.source.load(&limits, external))?;
    let mut inputs = loaded.inputs;
    inputs.extend(job.look.inputs());
    job.output.refuse_any_of(&inputs)?;
    let model = progress.step("prepare", || Model::new(&loaded.scene))?;
    let style = &job.look.style;
    let lines = style.has_curves().then(|| {
        let options = LineModelOptions {
            memory_limit: limits.memory_bytes,
            ..LineModelOptions::default()
        };
        progress.step("prepare", || {
            LineModel::for_style(&loaded.scene, style, &options, None)
        })
    });
    let lines = lines.transpose()?;
    progress.suspend(|| warn_of(job, &model));
    Ok((model, lines))
}

fn warn_of(job: &Job<'_>, model: &Model) {
    let quiet = job.said.drawing.quiet;
    for notice in model.notices() {
        message::warn(quiet, notice);
    }
    if let Some(warning) = job.look.width_warning(job.said.drawing.size.height) {
        message::warn(quiet, &warning.to_string());
    }
}

fn draw_frame(
    job: &Job<'_>,
    model: &Model,
    lines: Option<&LineModel>,
    camera: &Camera,
    progress: &mut Progress,
) -> Result<Drawn<Frame>, Fault> {
    let picture = |engine: &dyn Engine| {
        let mut stage = Stage::new(engine, model, &job.look.style, &job.options)?;
        if let Some(lines) = lines {
            stage = stage.with_lines(lines);
        }
        stage.draw(camera)
    };
    engine::draw_as_step(
        job.said.drawing.backend,
        &picture,
        job.said.drawing.quiet,
        progress,
    )
}
