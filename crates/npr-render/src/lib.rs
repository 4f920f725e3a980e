//! Scene and style in, drawing out.
//!
//! [`Subject::new`] prepares a scene once: a [`Model`], welded, with edges and curvature, and a [`LineModel`], which
//! strokes are found in. A [`Renderer`] joins it with a style and a frame size on an engine, and [`Renderer::draw`]
//! makes a picture for a camera, as often as wanted;
//! [`Renderer::frames`] draws sequences, the next frame on its way while the one before is used.
//! [`Smoke`] among its options is drawn with it, or alone with a model of an empty scene. A [`LineModel`] alone draws
//! the same scene as curves; a [`LineRenderer`] lets a device do its part.
//!
//! ```
//! use npr_core::camera::Camera;
//! use npr_gpu::processor::Processor;
//! use npr_render::{RendererOptions, Subject};
//! use npr_scene::Scene;
//! use npr_stylesheet::Style;
//!
//! let style = Style::default();
//! let subject = Subject::new(&Scene::default(), &style)?;
//! let mut renderer = subject.renderer(&Processor, &style, &RendererOptions::new([64, 36]))?;
//! let frame = renderer.draw(&Camera::framing([-1.0; 3], [1.0; 3]))?;
//! assert_eq!(frame.rgba.len(), 64 * 36 * 4);
//! # Ok::<(), npr_render::RenderError>(())
//! ```

mod beam_light;
mod bend;
mod bending;
mod brushes;
mod calm;
mod cutoffs;
#[cfg(feature = "wgpu")]
mod device;
mod error;
mod facts;
mod features;
mod file_light;
mod film;
mod frame;
mod frame_graph;
mod frame_renderer;
mod guides;
mod hatching;
mod id_map;
mod instance;
mod joined;
mod kept;
mod layer_pixel;
mod light;
mod limbs;
mod line_backdrop;
mod line_colors;
mod lines;
mod look;
mod manners;
mod model;
mod motion_lines;
mod movement;
mod options;
mod part_info;
mod part_toon;
mod pictures;
mod placement;
mod puffs;
mod renderer;
mod sequence;
mod sky;
mod smoke;
mod spots;
mod stage;
mod subject;
mod surfaces;
mod textures;
mod tiles;
mod toon;

#[cfg(feature = "wgpu")]
pub use device::{EmbeddedRenderer, HostView};
pub use error::RenderError;
pub use facts::facts_of;
pub use features::lettering::Lettering;
pub use frame::Frame;
pub use id_map::apply_id_maps;
pub use layer_pixel::LayerPixel;
pub use lines::{
    Fact, HeldLines, KindSet, LineModel, LineModelOptions, LineOptions, LineReason, LineRenderer,
    LineSource, PaintedLines, Pointed, PointedPart, Removal, Spot,
};
pub use model::Model;
pub use movement::Movement;
pub use npr_core::smoke::Sphere;
pub use npr_drawing::lettering::Font;
pub use npr_vector::stroke::{Drawing, Kind};
pub use options::{Picture, RendererOptions};
pub use part_info::PartInfo;
pub use placement::cameras_of;
pub use puffs::Following;
pub use renderer::Renderer;
pub use sequence::{Frames, Shot};
pub use smoke::Smoke;
pub use stage::{LineStage, StagePixel, SurfaceStage};
pub use subject::Subject;
