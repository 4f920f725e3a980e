//! A line model on an engine.

use super::{LineModel, LineOptions};
use crate::error::RenderError;
use npr_core::camera::Camera;
use npr_gpu::curves::ResidentShape;
use npr_gpu::engine::{Engine, PassTime};
use npr_style::Style;
use npr_vector::stroke::Drawing;

/// A line model on an engine: what a device finds of its lines is found there, the rest on the processor.
///
/// A device decides which faces are turned to the eye, marks contours along edges and links them; their shape stays in its memory
/// from view to view. Visibility, smooth contours, features and strokes are the processor's. Every engine gives
/// the drawing of [`LineModel::draw`], bit for bit.
pub struct LineStage<'a> {
    model: &'a LineModel,
    /// The shape on a device; nothing on the processor, where the plain functions are faster than their passes.
    resident: Option<ResidentShape<'a>>,
}

impl<'a> LineStage<'a> {
    /// Hands the model's shape to an engine.
    ///
    /// # Errors
    ///
    /// [`RenderError::Engine`] where a device fails, or has no room for the shape: beyond 2.7 million triangles none has.
    pub fn new(engine: &'a dyn Engine, model: &'a LineModel) -> Result<Self, RenderError> {
        let on_device = !engine.runs_twins();
        let resident = on_device.then(|| ResidentShape::new(engine, model.shape()));
        let resident = resident.transpose()?;
        Ok(Self { model, resident })
    }

    /// The lines that a camera sees; see [`LineModel::draw`].
    ///
    /// # Errors
    ///
    /// Those of [`LineModel::draw`], and [`RenderError::Engine`] where the device fails.
    pub fn draw(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Drawing, RenderError> {
        match &mut self.resident {
            Some(shape) => self
                .model
                .draw_with(camera, style, options, |eye| shape.contours(eye)),
            None => self.model.draw(camera, style, options),
        }
    }

    /// How long each pass of the last view took; none on the processor.
    pub fn times(&self) -> &[PassTime] {
        self.resident.as_ref().map_or(&[], ResidentShape::times)
    }
}
