//! A line model on an engine.

use super::finder::{Finder, OnDevice, OnProcessor};
use super::{LineModel, LineOptions};
use crate::error::RenderError;
use crate::frame::Frame;
use crate::model::Model;
use crate::renderer::{Picture, Renderer, RendererOptions};
use crate::smoke::Smoke;
use npr_core::camera::Camera;
use npr_gpu::engine::{Engine, PassTime};
use npr_stylesheet::Style;
use npr_vector::stroke::Drawing;
use std::collections::BTreeMap;

/// A line model on an engine: what a device finds of its lines is found there, the rest on the processor.
///
/// A device decides which faces are turned to the eye, marks contours along edges and links them; or draws surfaces
/// and lines into a picture, links the sides of its pixels, ranks and filters their loops and cuts them to strips.
/// The shape stays in its memory from view to view. Exact visibility, smooth contours, features and strokes are the
/// processor's.
///
/// Every engine gives the drawing of [`LineModel::draw`] bit for bit, but for
/// [`LineMethod::Potrace`](super::LineMethod): there a device draws the depths that hide lines, and smooths, within
/// rounding; and colours that mind a backdrop may differ as far as pictures do.
pub struct LineRenderer<'a> {
    engine: &'a dyn Engine,
    model: &'a LineModel,
    backdrop: Option<Backdrop<'a>>,
    /// The plain functions on the processor, where they are faster than their passes.
    finder: Box<dyn Finder + 'a>,
}

/// What the picture behind lines is made from.
struct Backdrop<'a> {
    model: &'a Model,
    options: &'a RendererOptions,
}

impl<'a> LineRenderer<'a> {
    /// Takes a model; its shape is handed to a device with the first view that needs it.
    pub fn new(engine: &'a dyn Engine, model: &'a LineModel) -> Self {
        let shape = model.shape();
        Self {
            engine,
            model,
            backdrop: None,
            finder: match engine.runs_twins() {
                true => Box::new(OnProcessor(shape)),
                false => Box::new(OnDevice::new(engine, shape)),
            },
        }
    }

    /// The same, with the scene and the pictures that lines are judged before, where the style lets them mind it
    /// ([`npr_stylesheet::LineBackground`]).
    ///
    /// Each point of a stroke then looks at the colours on both of its sides in a picture of the scene without lines,
    /// before its background, of the drawing's size. What lies where is asked of the surface, so textures cut nothing
    /// out of it. Without a backdrop lines mind nothing.
    pub fn with_backdrop(mut self, model: &'a Model, options: &'a RendererOptions) -> Self {
        self.backdrop = Some(Backdrop { model, options });
        self
    }

    /// The lines that a camera sees; see [`LineModel::draw`].
    ///
    /// # Errors
    ///
    /// Those of [`LineModel::draw`], and [`RenderError::Engine`] where the device fails or has no room for the shape:
    /// beyond 2.7 million triangles none has; those of [`Renderer::new`] for a picture behind.
    pub fn draw(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Drawing, RenderError> {
        let behind = self.picture(camera, style, options)?;
        self.finder.start_view();
        let find = self.finder.as_mut();
        self.model
            .draw_with(camera, style, options, behind.as_ref(), find)
    }

    /// The lines of the parts whose method of the style is `of_parts`, as far as `smoke` does not hide them.
    pub(crate) fn draw_curves(
        &mut self,
        camera: &Camera,
        of_style: (&Style, npr_stylesheet::LineMethod),
        options: &LineOptions,
        beside: (Option<&Smoke>, &BTreeMap<String, Picture>),
    ) -> Result<Drawing, RenderError> {
        self.finder.start_view();
        let find = self.finder.as_mut();
        self.model
            .draw_curves(camera, of_style, options, beside, find)
    }

    /// What lies behind the lines, where any mind it.
    fn picture(
        &self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Option<Frame>, RenderError> {
        let Some(backdrop) = self
            .backdrop
            .as_ref()
            .filter(|_| style.contrasts_with_background())
        else {
            return Ok(None);
        };
        let of_frame = RendererOptions {
            size: options.size,
            dpi: options.dpi,
            smoke: self.model.smoke.clone(),
            ..backdrop.options.clone()
        };
        let mut renderer = Renderer::new(
            self.engine,
            backdrop.model,
            &style.without_lines(),
            &of_frame,
        )?;
        renderer.draw(camera).map(Some)
    }

    /// How long each pass of the last view took; none on the processor.
    pub fn times(&self) -> &[PassTime] {
        self.finder.times()
    }
}
