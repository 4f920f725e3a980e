//! What is drawn: a prepared model and the camera that looks at it.

use std::error::Error;
use std::path::{Path, PathBuf};

use npr_core::camera::{Camera, DEFAULT_FOV_DEG};
use npr_gpu::engine::Engine;
use npr_render::{Model, RenderError, Renderer, RendererOptions};
use npr_scene::{LoadOptions, load};
use npr_stylesheet::Style;

use crate::solid::bumpy_ball;

/// A prepared model and the camera that looks at it, filling a 16:9 frame.
#[derive(Debug, Clone)]
pub struct Subject {
    /// The model.
    pub model: Model,
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
        Model::new(&bumpy_ball(triangle_count)).map(Self::of)
    }

    /// A model from a file.
    ///
    /// # Errors
    ///
    /// Whatever loading or preparing it says.
    pub fn from_file(path: &Path) -> Result<Self, Box<dyn Error>> {
        let scene = load(path, &LoadOptions::default())?;
        Ok(Self::of(Model::new(&scene)?))
    }

    fn of(model: Model) -> Self {
        let camera = model.framing(16.0 / 9.0, DEFAULT_FOV_DEG.to_radians());
        Self { model, camera }
    }

    /// A stage for this subject, drawn once so that memory and shaders are warm.
    ///
    /// # Errors
    ///
    /// [`RenderError`] where the engine fails.
    pub fn warm_renderer(
        &self,
        engine: &dyn Engine,
        style: &Style,
        size: [u32; 2],
    ) -> Result<Renderer<'_>, RenderError> {
        let mut renderer = Renderer::new(engine, &self.model, style, &RendererOptions::new(size))?;
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
