//! Shadows: what every light sees that throws shadows.

use crate::frame_graph::{FrameGraph, size_if, write};
use npr_core::window::Window;
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::ResourceId;
use npr_gpu::pass::Format;
use npr_gpu::passes::{mesh, raster};
use npr_mesh::pose::Matrix;
use npr_style::lighting::Lights;
use npr_style::shadow::{SHADOW_SIDE, SHADOWS_MAX};

/// The shadows of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Shadows {
    /// The grid of every picture.
    window: ResourceId,
    /// The views of the lights.
    views: Vec<ResourceId>,
    /// Triangle numbers that the lights see.
    pub pictures: [ResourceId; SHADOWS_MAX],
    /// Depths of the same pictures; all share one where no shadows fall on smoke.
    pub depths: [ResourceId; SHADOWS_MAX],
}

impl Shadows {
    /// Draws what `count` lights see; depths are kept where the shadows fall on smoke.
    pub fn plan(
        frame: &mut FrameGraph,
        count: usize,
        vertex_count: usize,
        fall_on_smoke: bool,
    ) -> Self {
        let graph = &mut frame.graph;
        let size = |i| size_if(i < count, [SHADOW_SIDE; 2]);

        // Draw all pictures with the same depths, unless smoke reads them later.
        let first = graph.image("shadow depths", Format::Depth, size(0));
        let mut depths = [first; SHADOWS_MAX];
        if fall_on_smoke {
            for (i, depths) in (1..).zip(&mut depths[1..]) {
                *depths = graph.image("shadow depths", Format::Depth, size(i));
            }
        }

        // Add a view and a picture for every light, and draw them.
        let views = (0..count).map(|_| graph.uniform::<Matrix>("light view"));
        let shadows = Self {
            views: views.collect(),
            window: graph.uniform::<Window>("shadow window"),
            pictures: std::array::from_fn(|i| graph.image("shadow", Format::U32, size(i))),
            depths,
        };
        if count > 0 {
            shadows.draw(frame, vertex_count);
        }
        shadows
    }

    /// Draws what every light sees; one list of projected vertices serves them all in turn.
    fn draw(&self, frame: &mut FrameGraph, vertex_count: usize) {
        let projected = frame.graph.buffer::<[f32; 4]>("projected", vertex_count);
        let targets = self.pictures.into_iter().zip(self.depths);
        for (view, (picture, depths)) in self.views.iter().zip(targets) {
            let project = [*view, frame.posed, projected];
            frame.graph.compute(&mesh::PROJECT_SHADOW, &project);
            let bound = [
                self.window,
                projected,
                frame.vertices,
                frame.triangles,
                frame.parts,
                frame.texels,
            ];
            frame
                .graph
                .draw(&raster::DRAW_SHADOW, &bound, &[picture, depths], true);
        }
    }

    /// Hands over the grid of the pictures.
    pub fn upload(&self, session: &mut dyn Session) -> Result<(), EngineError> {
        let side_px = [SHADOW_SIDE as f32; 2];
        let window = Window::over(side_px, [0.0; 2], side_px, [SHADOW_SIDE; 2]);
        write(session, self.window, &[window])
    }

    /// Hands over the views of the lights.
    pub fn upload_view(
        &self,
        session: &mut dyn Session,
        lights: &Lights,
    ) -> Result<(), EngineError> {
        for (id, matrix) in self.views.iter().zip(&lights.shadows) {
            write(session, *id, &[*matrix])?;
        }
        Ok(())
    }
}
