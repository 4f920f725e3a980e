//! A line model on an engine.

use super::{LineModel, LineOptions};
use crate::error::RenderError;
use crate::frame::Frame;
use crate::model::Model;
use crate::stage::{Stage, StageOptions};
use npr_core::camera::Camera;
use npr_gpu::curves::ResidentShape;
use npr_gpu::engine::{Engine, PassTime};
use npr_style::Style;
use npr_vector::stroke::Drawing;

/// A line model on an engine: what a device finds of its lines is found there, the rest on the processor.
///
/// A device decides which faces are turned to the eye, marks contours along edges and links them; their shape stays in its memory
/// from view to view. Visibility, smooth contours, features and strokes are the processor's. Every engine gives
/// the drawing of [`LineModel::draw`], bit for bit; only colours that mind a backdrop may differ as far as pictures do.
pub struct LineStage<'a> {
    engine: &'a dyn Engine,
    model: &'a LineModel,
    backdrop: Option<Backdrop<'a>>,
    /// The shape on a device; nothing on the processor, where the plain functions are faster than their passes.
    resident: Option<ResidentShape<'a>>,
}

/// What the picture behind lines is made from.
struct Backdrop<'a> {
    model: &'a Model,
    options: &'a StageOptions,
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
        Ok(Self {
            engine,
            model,
            backdrop: None,
            resident,
        })
    }

    /// The same, with the scene and the pictures that lines are judged before, where the style lets them mind it
    /// ([`npr_style::LineBackground`]).
    ///
    /// Each point of a stroke then looks at the colours on both of its sides in a picture of the scene without lines, before its
    /// background, of the drawing's size. What lies where is asked of the surface, so textures cut nothing out of it.
    /// Without a backdrop lines mind nothing.
    pub fn with_backdrop(mut self, model: &'a Model, options: &'a StageOptions) -> Self {
        self.backdrop = Some(Backdrop { model, options });
        self
    }

    /// The lines that a camera sees; see [`LineModel::draw`].
    ///
    /// # Errors
    ///
    /// Those of [`LineModel::draw`], and [`RenderError::Engine`] where the device fails; those of [`Stage::new`] for a
    /// picture behind.
    pub fn draw(
        &mut self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Drawing, RenderError> {
        let behind = self.picture(camera, style, options)?;
        let (model, behind) = (self.model, behind.as_ref());
        match &mut self.resident {
            Some(shape) => {
                model.draw_with(camera, style, options, behind, |eye| shape.contours(eye))
            }
            None => model.draw_before(camera, style, options, behind),
        }
    }

    /// What lies behind the lines, where any mind it.
    fn picture(
        &self,
        camera: &Camera,
        style: &Style,
        options: &LineOptions,
    ) -> Result<Option<Frame>, RenderError> {
        let Some(backdrop) = self.backdrop.as_ref().filter(|_| style.minds_background()) else {
            return Ok(None);
        };
        let of_frame = StageOptions {
            size: options.size,
            dpi: options.dpi,
            smoke: self.model.smoke.clone(),
            ..backdrop.options.clone()
        };
        let mut stage = Stage::new(
            self.engine,
            backdrop.model,
            &style.without_lines(),
            &of_frame,
        )?;
        stage.draw(camera).map(Some)
    }

    /// How long each pass of the last view took; none on the processor.
    pub fn times(&self) -> &[PassTime] {
        self.resident.as_ref().map_or(&[], ResidentShape::times)
    }
}
