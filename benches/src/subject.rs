//! What is drawn: a prepared model and the camera that looks at it.

use std::error::Error;
use std::path::{Path, PathBuf};

use npr_core::camera::{Camera, DEFAULT_FOV_DEG};
use npr_gpu::engine::Engine;
use npr_render::{RenderError, Renderer, RendererOptions};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::Style;

use crate::solid::bumpy_ball;

/// A prepared model and the camera that looks at it, filling a 16:9 frame.
#[derive(Debug)]
pub struct Subject {
    /// The model, with its lines.
    pub prepared: npr_render::Subject,
    /// The camera that the command would choose.
    pub camera: Camera,
}

impl Subject {
    /// The bumpy ball of exactly `triangle_count` triangles.
    ///
    /// # Errors
    ///
    /// [`RenderError`] where the ball cannot be numbered.
    pub fn ball(triangle_count: usize) -> Result<Self, RenderError> {
        Self::of(&bumpy_ball(triangle_count))
    }

    /// A model from a file.
    ///
    /// # Errors
    ///
    /// Whatever loading or preparing it says.
    pub fn from_file(path: &Path) -> Result<Self, Box<dyn Error>> {
        let scene = load(path, &LoadOptions::default())?;
        Ok(Self::of(&scene)?)
    }

    fn of(scene: &Scene) -> Result<Self, RenderError> {
        // The style of the defaults draws strokes, so that lines are prepared for any other.
        let prepared = npr_render::Subject::new(scene, &Style::default())?;
        let camera = prepared
            .model
            .framing(16.0 / 9.0, DEFAULT_FOV_DEG.to_radians());
        Ok(Self { prepared, camera })
    }

    /// Number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.prepared.model.triangle_count()
    }

    /// A stage for this subject, drawn once so that memory and shaders are warm.
    ///
    /// # Errors
    ///
    /// [`RenderError`] where the engine fails.
    pub fn warm_renderer<'a>(
        &'a self,
        engine: &'a dyn Engine,
        style: &Style,
        size: [u32; 2],
    ) -> Result<Renderer<'a>, RenderError> {
        let options = RendererOptions::new(size);
        let mut renderer = self.prepared.renderer(engine, style, &options)?;
        renderer.draw(&self.camera)?;
        Ok(renderer)
    }
}

/// The folder of shared volumes beside the project, whether it is there or not.
pub fn shared_volumes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/assets/volumes")
}

/// The scanned bunny of 69 k triangles, where the folder of shared models lies beside the project.
///
/// Says on standard error that it is left out, where not.
pub fn bunny_path() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/assets/models");
    let path = folder.join("stanford_bunny.glb");
    if path.is_file() {
        return Some(path);
    }
    eprintln!("bunny left out: there is no ../shared/assets/models/stanford_bunny.glb");
    None
}
