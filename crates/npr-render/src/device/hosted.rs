//! Frames that go on in the memory of another, with depths, as a host program wants them.

use crate::frame_renderer::{FramePlan, FrameRenderer};
use crate::look::StyledModel;
use crate::model::Model;
use crate::options::RendererOptions;
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::{Graph, ResourceId};
use npr_gpu::pass::Format;
use npr_gpu::passes::shade;
use npr_stylesheet::Style;

impl FramePlan {
    /// Plans a frame together with the depths of its pixels; gives the resources of both.
    pub fn with_depths(
        model: &Model,
        style: &Style,
        options: &RendererOptions,
        styled: StyledModel,
    ) -> (Self, [ResourceId; 2]) {
        let (mut plan, (beams, smoke)) = Self::with_layers(model, style, options, styled);
        let pixels = plan.needs.grids.output_pixels();
        let frame = &mut plan.passes.frame;
        let none = |graph: &mut Graph| graph.image("no beam depths", Format::Depth, [1, 1]);
        let beams = beams.unwrap_or_else(|| none(&mut frame.graph));
        let depths = frame.graph.buffer::<f32>("picture depths", pixels);
        let bound = [
            frame.view,
            frame.output_window,
            frame.compose,
            frame.outline,
            frame.depths,
            beams,
            smoke,
            frame.frame,
            depths,
        ];
        frame.graph.compute(&shade::FIND_DEPTHS, &bound);
        let picture = [frame.frame, depths];
        (plan, picture)
    }
}

impl<S: Session> FrameRenderer<S> {
    /// Draws by another plan from now on, of whose graph the session is.
    pub fn follow(&mut self, plan: FramePlan, model: &Model) -> Result<(), EngineError> {
        self.plan = plan;
        self.before = None;
        self.upload(model)
    }
}
