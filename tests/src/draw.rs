//! Drawing in one call.

use npr_core::camera::Camera;
use npr_core::window::View;
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_render::{Frame, Model, Renderer, RendererOptions, Subject};
use npr_scene::Scene;
use npr_stylesheet::Style;

/// Vertical field of view of cameras that frame a model, in radians.
const FOV_Y: f32 = 0.7;

/// A picture with what it was drawn from.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// The picture.
    pub frame: Frame,
    /// Its camera, as passes see it.
    pub view: View,
    /// The prepared scene.
    pub model: Model,
}

/// Black lines on white paper by a method, three pixels wide, hard steps, everything else as in the preset `toon`.
pub fn lines(method: &str) -> Style {
    let mut style = Style::preset("toon").expect("a preset");
    let line_method = format!("line.method={method}");
    let settings = [
        line_method.as_str(),
        "line.color=#000000",
        "line.width.base=3px",
        "line.width.source=constant",
        "line.width.min=1",
        "line.width.max=1",
        "shade.mode=paper",
        "shade.ramp=[{ at = 0.0, light = 1.0 }]",
        "antialias.samples=1",
    ];
    for setting in settings {
        style.set(setting).expect("a valid setting");
    }
    style
}

/// The camera of the file, or one that frames the model from three quarters above.
pub fn models_camera(model: &Model, size: [u32; 2]) -> Camera {
    match model.cameras() {
        [(_, camera), ..] => *camera,
        [] => model.framing(size[0] as f32 / size[1] as f32, FOV_Y),
    }
}

/// Draws a scene on the processor through [`models_camera`].
pub fn draw(scene: &Scene, style: &Style, size: [u32; 2]) -> Frame {
    let subject = Subject::new(scene, style).expect("a small scene");
    let camera = models_camera(&subject.model, size);
    draw_of(
        &Processor,
        &subject,
        style,
        &camera,
        &RendererOptions::new(size),
    )
}

/// Draws a scene on the processor as a camera sees it.
pub fn draw_from(scene: &Scene, style: &Style, camera: &Camera, size: [u32; 2]) -> Drawing {
    let subject = Subject::new(scene, style).expect("a small scene");
    let options = RendererOptions::new(size);
    Drawing {
        frame: draw_of(&Processor, &subject, style, camera, &options),
        view: camera.view(size, subject.model.bounds()),
        model: subject.model,
    }
}

/// Draws a subject on an engine, with the strokes that a style asks for.
///
/// # Panics
///
/// Where the engine fails.
pub fn draw_of(
    engine: &dyn Engine,
    subject: &Subject,
    style: &Style,
    camera: &Camera,
    options: &RendererOptions,
) -> Frame {
    let renderer = subject.renderer(engine, style, options);
    let mut renderer = renderer.expect("a small frame");
    renderer.draw(camera).expect("a picture")
}

/// Draws a model on an engine; without its lines, so that strokes are drawn by method `shape`.
///
/// # Panics
///
/// Where the engine fails: tests do not go on without a picture.
pub fn draw_on(
    engine: &dyn Engine,
    model: &Model,
    style: &Style,
    camera: &Camera,
    size: [u32; 2],
) -> Frame {
    draw_with(engine, model, style, camera, &RendererOptions::new(size))
}

/// Draws a model on an engine with options, without its lines.
///
/// # Panics
///
/// Where the engine fails.
pub fn draw_with(
    engine: &dyn Engine,
    model: &Model,
    style: &Style,
    camera: &Camera,
    options: &RendererOptions,
) -> Frame {
    let mut renderer = Renderer::new(engine, model, style, options).expect("a small frame");
    renderer.draw(camera).expect("a picture")
}
