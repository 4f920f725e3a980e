//! Lines found on images and drawn on shapes: detection on the mask's grid, then drawing on the output's
//! [Okuya et al. 2016, figure 9].

use super::line_features::LineFeatures;
use crate::frame_graph::{FrameGraph, Grids, pixel_count, size_if, write};
use npr_core::geometry::{Edge, EdgeRole, GPixel, Stamp};
use npr_core::line_color::LineTint;
use npr_core::window::Window;
use npr_gpu::engine::{EngineError, Session};
use npr_gpu::graph::ResourceId;
use npr_gpu::pass::Format;
use npr_gpu::passes::{line, mesh};

/// The lines of a frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ScreenLines {
    mask_window: ResourceId,
    edges: ResourceId,
    /// What found a line at every pixel of its grid, on the processor and devices alike.
    pub mask: ResourceId,
    /// What surface, light and depth decide about the colour of lines, at every pixel of the mask.
    tints: ResourceId,
    /// Mesh edges and strokes drawn with width.
    pub ribbons: ResourceId,
    /// The key of the line that each pixel of `ribbons` shows.
    pub keys: ResourceId,
}

impl ScreenLines {
    /// Adds the resources and passes with which the methods of a style find and draw lines.
    pub fn plan(
        frame: &mut FrameGraph,
        grids: &Grids,
        edge_count: usize,
        features: LineFeatures,
    ) -> Self {
        let graph = &mut frame.graph;

        // Size the pictures; one that no method needs has a single texel.
        let mask = size_if(features.mask, grids.mask);
        let tints = size_if(features.mask && features.paints, grids.mask);
        let ribbons = size_if(features.ribbons || features.strokes, grids.output);
        let lines = Self {
            mask_window: graph.uniform::<Window>("mask window"),
            edges: graph.buffer::<Edge>("edges", edge_count),
            mask: graph.buffer::<u32>("mask", pixel_count(mask)),
            tints: graph.buffer::<LineTint>("line tints", pixel_count(tints)),
            ribbons: graph.image("ribbons", Format::Rgba8, ribbons),
            keys: graph.image("ribbon keys", Format::Depth, ribbons),
        };

        // Find and draw lines, where a method looks for them on the mask.
        if features.mask {
            lines.find(frame, grids, features);
        }
        lines
    }

    fn find(&self, frame: &mut FrameGraph, grids: &Grids, features: LineFeatures) {
        // Resolve the surface under every pixel of the mask.
        let ids = self.mask_ids(frame, grids);
        let gbuffer = frame.graph.buffer::<GPixel>("gbuffer", grids.mask_pixels());
        let resolve = [
            frame.view,
            self.mask_window,
            ids,
            frame.posed,
            frame.triangles,
            frame.parts,
            gbuffer,
        ];
        frame.graph.compute(&line::RESOLVE_GBUFFER, &resolve);

        // Mark the pixels that differ from a neighbour.
        let room = grids.mask_pixels() + 1;
        let owners = frame.graph.buffer::<u32>("line owners", room);
        let detect = [
            frame.view,
            self.mask_window,
            frame.outline,
            frame.parts,
            gbuffer,
            self.mask,
            owners,
        ];
        frame.graph.compute(&line::DETECT, &detect);
        if features.paints {
            self.color_mask(frame, ids);
        }

        // Draw what was found, in the ways of the method.
        if features.ribbons {
            self.draw_ribbons(frame, gbuffer);
        }
        if features.residual {
            self.stamp_residual(frame, grids, gbuffer, owners);
        }
        if features.filter {
            self.draw_mask(frame);
        }
    }

    /// Adds the pass that decides the colours of lines at every pixel of the mask.
    fn color_mask(&self, frame: &mut FrameGraph, ids: ResourceId) {
        let bound = [
            frame.view,
            self.mask_window,
            frame.compose,
            frame.lights,
            ids,
            frame.posed,
            frame.vertices,
            frame.triangles,
            frame.parts,
            frame.texels,
            self.mask,
            self.tints,
        ];
        frame.graph.compute(&line::COLOR_MASK, &bound);
    }

    /// Triangle numbers on the mask's grid; the colour samples serve where both grids are the same.
    fn mask_ids(&self, frame: &mut FrameGraph, grids: &Grids) -> ResourceId {
        if grids.samples == 1 && grids.mask == grids.output {
            return frame.ids;
        }
        let ids = frame.graph.image("mask ids", Format::U32, grids.mask);
        let depths = frame.graph.image("mask depths", Format::Depth, grids.mask);
        frame.draw_ids(self.mask_window, ids, depths);
        ids
    }

    fn draw_ribbons(&self, frame: &mut FrameGraph, gbuffer: ResourceId) {
        // Find the role of every edge in the view.
        let edge_count = frame.graph.element_count(self.edges);
        let roles = frame.graph.buffer::<EdgeRole>("edge roles", edge_count);
        let classify = [
            frame.outline,
            frame.posed,
            frame.triangles,
            frame.parts,
            self.edges,
            roles,
        ];
        frame.graph.compute(&mesh::CLASSIFY_EDGES, &classify);

        // Draw edges with width where the mask shows them.
        let ribbons = [
            frame.view,
            frame.output_window,
            self.mask_window,
            frame.outline,
            frame.posed,
            frame.parts,
            self.edges,
            roles,
            gbuffer,
            self.mask,
            self.tints,
        ];
        let targets = [self.ribbons, self.keys];
        frame
            .graph
            .draw(&line::DRAW_RIBBONS, &ribbons, &targets, true);
    }

    fn stamp_residual(
        &self,
        frame: &mut FrameGraph,
        grids: &Grids,
        gbuffer: ResourceId,
        owners: ResourceId,
    ) {
        let graph = &mut frame.graph;
        let (pixels, mask_pixels) = (grids.output_pixels(), grids.mask_pixels());
        let stamps = graph.buffer::<Stamp>("stamps", mask_pixels);
        let smoothed = graph.buffer::<Stamp>("smoothed stamps", mask_pixels);
        let found = graph.buffer::<u32>("mask pixels with stamps", mask_pixels + 1);
        let covered = graph.buffer::<u32>("stamped pixels", pixels + 1);
        let (output, mask) = (frame.output_window, self.mask_window);

        // Find the line pixels that no edge explains.
        let find = [
            output,
            mask,
            frame.parts,
            gbuffer,
            self.mask,
            owners,
            self.ribbons,
            stamps,
            found,
        ];
        frame.compute_listed(&line::FIND_RESIDUAL, &find, owners);

        // Smooth their places along the line.
        let smooth = [mask, self.mask, found, stamps, smoothed];
        let sizes = frame.compute_listed(&line::SMOOTH_STAMPS, &smooth, found);

        // Ink a round stamp at each of them.
        let claim = [output, found, smoothed, frame.frame, covered];
        frame
            .graph
            .compute_sized(&line::CLAIM_PIXELS, &claim, sizes);
        let stamp = [
            output,
            mask,
            frame.parts,
            smoothed,
            self.tints,
            covered,
            frame.frame,
        ];
        frame.compute_listed(&line::STAMP_RESIDUAL, &stamp, covered);
    }

    /// Draws the mask itself.
    fn draw_mask(&self, frame: &mut FrameGraph) {
        let bound = [
            frame.output_window,
            self.mask_window,
            frame.compose,
            frame.parts,
            self.mask,
            self.tints,
            frame.frame,
        ];
        frame.graph.compute(&line::DRAW_MASK, &bound);
    }

    /// Hands over the edges of the model.
    pub fn upload(&self, session: &mut dyn Session, edges: &[Edge]) -> Result<(), EngineError> {
        write(session, self.edges, edges)
    }

    /// Hands over the mask's grid over a tile.
    pub fn upload_tile(
        &self,
        session: &mut dyn Session,
        window: Window,
    ) -> Result<(), EngineError> {
        write(session, self.mask_window, &[window])
    }
}
