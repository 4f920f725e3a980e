//! `npr lines`: the lines of a scene as curves.

use crate::arguments::{
    Backend, LineArguments, LineFormat, LinesArguments, RenderArguments, SheetArguments,
};
use crate::engine::Choice;
use crate::fault::{Exit, Fault};
use crate::hardware;
use crate::line_file;
use crate::line_job::LineJob;
use crate::look::Look;
use crate::message;
use crate::progress::Progress;
use crate::render;
use crate::timings::{DRAW, Timings};
use crate::viewpoint;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{LineModel, LineModelOptions};
use npr_style::{Background, WidthSource};
use std::io::Write;

/// Draws the lines that the user asked for, or prints the style.
pub fn lines(said: &LinesArguments) -> Result<(), Fault> {
    if said.drawing.look.dump_style {
        return render::dump_style(&said.drawing);
    }
    let mut progress = Progress::new(said.drawing.quiet);
    draw(&LineJob::resolve(said)?, &mut progress)?;
    let steps = progress.finish();
    if let Some(form) = said.drawing.timings {
        let timings = Timings::new(Processor.describe(), &steps, &[]);
        let _ = std::io::stderr().write_all(timings.told(form).as_bytes());
    }
    Ok(())
}

/// Draws a picture whose style is lines only as curves.
pub fn lines_of_picture(said: &RenderArguments) -> Result<(), Fault> {
    let look = Look::resolve(&said.drawing.look, said.drawing.allow_external.as_deref())?;
    let Some(paper) = look.paper_of_lines() else {
        let message = "this style fills surfaces with tones, which .svg pictures have none of: \
                       write .png, or draw the lines alone with npr lines";
        return Err(Fault::new(Exit::Usage, message));
    };
    let lines_said = LinesArguments {
        scene: said.scene.clone(),
        output: said.output.clone(),
        format: Some(LineFormat::Svg),
        lines: LineArguments {
            // Paper of the background's own colour shows nowhere.
            fill: look.style.background != Background::Color(paper),
            ..LineArguments::default()
        },
        sheet: SheetArguments::default(),
        drawing: said.drawing.clone(),
        cache: None,
    };
    lines(&lines_said)
}

/// From the scene's file to the drawing's.
fn draw(job: &LineJob<'_>, progress: &mut Progress) -> Result<(), Fault> {
    line_file::check_memory(job)?;
    check_backend(job, progress)?;
    let model = prepare(job, progress)?;
    let camera = viewpoint::camera(&job.said.drawing.camera, &model, job.said.drawing.size)?;
    let drawing = progress.step(DRAW, || model.draw(&camera, &job.look.style, &job.options))?;
    let bytes = progress.step("encode", || line_file::encode(job, &drawing))?;
    progress.step("write", || job.output.write(&bytes))
}

/// Sees to it that there is a device where one is demanded.
///
/// Lines are found on the processor so far, whichever engine is asked for.
fn check_backend(job: &LineJob<'_>, progress: &Progress) -> Result<(), Fault> {
    if job.said.drawing.backend != Backend::Gpu {
        return Ok(());
    }
    let device = hardware::open(Choice::Any).map_err(npr_render::RenderError::from)?;
    let text = format!(
        "{} stands by; lines are found on the processor",
        device.describe()
    );
    progress.suspend(|| message::warn(job.said.drawing.quiet, &text));
    Ok(())
}

/// Loads the scene and makes it ready; says what is ignored.
fn prepare(job: &LineJob<'_>, progress: &mut Progress) -> Result<LineModel, Fault> {
    let external = job.said.drawing.allow_external.as_deref();
    let loaded = progress.step("load", || job.source.load(&job.limits, external))?;
    let mut inputs = loaded.inputs;
    inputs.extend(job.look.inputs());
    job.output.refuse_any_of(&inputs)?;
    let options = LineModelOptions {
        weld: job.said.lines.weld,
        memory_limit: job.limits.memory_bytes,
    };
    let model = progress.step("prepare", || match &job.cache {
        Some(folder) => LineModel::cached(&loaded.scene, &options, folder),
        None => LineModel::new(&loaded.scene, &options),
    })?;
    progress.suspend(|| warn_of(job, &model));
    Ok(model)
}

fn warn_of(job: &LineJob<'_>, model: &LineModel) {
    let warn = |text: &str| message::warn(job.said.drawing.quiet, text);
    for notice in model.notices() {
        warn(notice);
    }
    if matches!(job.look.style.background, Background::Image(_)) {
        warn("the picture behind is left out: lines are drawn on a colour or on nothing");
    }
    if job.look.style.line.width.source == WidthSource::Texture {
        warn("line widths do not follow the texture: lines have the full width");
    }
}
