//! Scene and style in, drawing out.
//!
//! [`Model::new`] prepares a scene once: welds it, finds its edges and curvature. A [`Renderer`] joins a model with a
//! style and a frame size on an engine, and [`Renderer::draw`] makes a picture for a camera, as often as wanted.
//! [`Smoke`] among its options is drawn with it, or alone with a model of an empty scene. [`LineModel`] draws the
//! same scene as curves instead; a [`LineRenderer`] lets a device do its part.
//!
//! ```
//! use npr_core::camera::Camera;
//! use npr_gpu::processor::Processor;
//! use npr_render::{Model, Renderer, RendererOptions};
//! use npr_scene::Scene;
//! use npr_stylesheet::Style;
//!
//! let model = Model::new(&Scene::default())?;
//! let mut stage = Renderer::new(&Processor, &model, &Style::default(), &RendererOptions::new([64, 36]))?;
//! let frame = stage.draw(&Camera::framing([-1.0; 3], [1.0; 3]))?;
//! assert_eq!(frame.rgba.len(), 64 * 36 * 4);
//! # Ok::<(), npr_render::RenderError>(())
//! ```

mod backdrop;
mod beam_light;
mod bend;
mod blending;
mod blueprint;
mod error;
mod facts;
mod film;
mod frame;
mod guides;
mod hatching;
mod id_map;
mod instance;
mod joined;
mod kept;
mod lettering;
mod light;
mod line_colors;
mod lines;
mod look;
mod model;
mod pictures;
mod placement;
mod puffs;
mod renderer;
mod sky;
mod smoke;
mod speed_lines;
mod surfaces;
mod textures;
mod tiles;

pub use error::RenderError;
pub use facts::facts_of;
pub use frame::Frame;
pub use id_map::apply_id_maps;
pub use lettering::Lettering;
pub use lines::{
    KindSet, LineMethod, LineModel, LineModelOptions, LineOptions, LineRenderer, PaintedLines,
};
pub use model::{Model, PartInfo};
pub use npr_core::smoke::Sphere;
pub use npr_drawing::lettering::Font;
pub use npr_vector::stroke::{Drawing, Kind};
pub use puffs::Following;
pub use renderer::{Picture, Renderer, RendererOptions};
pub use smoke::Smoke;
