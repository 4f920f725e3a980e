//! Shadows: what every light sees that throws shadows.

use crate::frame_graph::{FrameGraph, size_if, write};
use npr_core::window::Window;
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::ResourceId;
use npr_gpu::pass::Format;
use npr_gpu::passes::{mesh, raster};
use npr_mesh::pose::Matrix;
use npr_style::lighting::Lights;
use npr_style::shadow::SHADOW_SIDE;

/// The shadows of a frame.
#[derive(Debug, Clone)]
pub(crate) struct Shadows {
    /// The grid of every picture.
    window: ResourceId,
    /// The views of the lights.
    views: Vec<ResourceId>,
    /// Triangle numbers that the lights see, a layer each.
    pub pictures: ResourceId,
    /// Depths of the same pictures; all share one layer where no shadows fall on smoke.
    pub depths: ResourceId,
}

impl Shadows {
    /// Draws what `count` lights see; depths are kept where the shadows fall on smoke.
    pub fn plan(
        frame: &mut FrameGraph,
        count: usize,
        vertex_count: usize,
        fall_on_smoke: bool,
    ) -> Self {
        // Add a view and a picture for every light; without lights, one of a single texel.
        let graph = &mut frame.graph;
        let size = size_if(count > 0, [SHADOW_SIDE; 2]);
        let layers = count.max(1) as u32;
        let depth_layers = if fall_on_smoke { layers } else { 1 };
        let views = (0..count).map(|_| graph.uniform::<Matrix>("light view"));
        let shadows = Self {
            views: views.collect(),
            window: graph.uniform::<Window>("shadow window"),
            pictures: graph.layered_image("shadows", Format::U32, size, layers),
            depths: graph.layered_image("shadow depths", Format::Depth, size, depth_layers),
        };

        // Draw them.
        if count > 0 {
            shadows.draw(frame, vertex_count, depth_layers);
        }
        shadows
    }

    /// Draws what every light sees; one list of projected vertices serves them all in turn, and so do the layers of
    /// depths where there are fewer.
    fn draw(&self, frame: &mut FrameGraph, vertex_count: usize, depth_layers: u32) {
        let projected = frame.graph.buffer::<[f32; 4]>("projected", vertex_count);
        for (layer, view) in (0..).zip(&self.views) {
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
            let targets = [
                self.pictures.layer(layer),
                self.depths.layer(layer % depth_layers),
            ];
            frame
                .graph
                .draw(&raster::DRAW_SHADOW, &bound, &targets, true);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame_graph::{Counts, Grids};
    use npr_gpu::graph::Kind;
    use npr_gpu::pass::Features;

    /// Sides and layers of the pictures and depths of some lights.
    fn planned(count: usize, fall_on_smoke: bool) -> [(u32, u32); 2] {
        let grids = Grids {
            output: [4, 4],
            mask: [4, 4],
            samples: 1,
        };
        let mut frame = FrameGraph::new(&Counts::default(), &grids, Features::ALL);
        let shadows = Shadows::plan(&mut frame, count, 0, fall_on_smoke);
        [shadows.pictures, shadows.depths].map(|id| match frame.graph.resource(id).kind {
            Kind::Image { size, layers, .. } => (size[0], layers),
            _ => (0, 0),
        })
    }

    #[test]
    fn lights_take_no_more_memory_than_they_need() {
        for fall_on_smoke in [false, true] {
            assert_eq!(planned(0, fall_on_smoke), [(1, 1), (1, 1)]);
            assert_eq!(planned(1, fall_on_smoke), [(SHADOW_SIDE, 1); 2]);
        }
        assert_eq!(planned(3, false), [(SHADOW_SIDE, 3), (SHADOW_SIDE, 1)]);
        assert_eq!(planned(3, true), [(SHADOW_SIDE, 3); 2]);
    }
}
