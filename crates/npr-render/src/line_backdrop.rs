//! What lies behind line drawings: a picture of the scene without lines, for colours that follow it.

use crate::lines::{Behind, LineOptions, LineRenderer};
use crate::model::Model;
use crate::options::RendererOptions;
use crate::renderer::Renderer;
use npr_core::camera::Camera;
use npr_stylesheet::Style;
use std::borrow::Cow;

impl<'a> LineRenderer<'a> {
    /// The same with a backdrop: the scene and its pictures, where the style lets the colours of lines follow what lies
    /// behind them ([`npr_stylesheet::LineBackground`]).
    ///
    /// Each point of a stroke then looks at the colours on both of its sides in a picture of the scene without lines,
    /// before its background, of the drawing's size. What lies where is asked of the surface, so textures cut nothing
    /// out of it. Without a backdrop the colours of lines follow nothing.
    pub fn with_backdrop(mut self, model: &'a Model, options: &'a RendererOptions) -> Self {
        let (engine, smoke) = (self.engine, self.given.smoke());
        let draw = move |model: &Model, camera: &Camera, style: &Style, drawing: &LineOptions| {
            let of_frame = RendererOptions {
                size: drawing.size,
                dpi: drawing.dpi,
                smoke: smoke.cloned(),
                layers: false,
                ..options.clone()
            };
            Renderer::new(engine, model, &style.without_lines(), &of_frame)?.draw(camera)
        };
        self.behind = Some(Behind {
            model: Cow::Borrowed(model),
            draw: Box::new(draw),
        });
        self
    }
}
