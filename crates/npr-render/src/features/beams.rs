//! Beams of light: meshes that glow instead of being surfaces.

use crate::frame_graph::{FrameGraph, Grids, size_if};
use npr_core::geometry::Part;
use npr_gpu::graph::ResourceId;
use npr_gpu::pass::Format;
use npr_gpu::passes::raster;

/// Whether any part is a beam of light.
pub(crate) fn needs(parts: &[Part]) -> bool {
    parts.iter().any(|part| part.flags & Part::BEAM != 0)
}

/// Draws which beam each colour sample shows, and how deep, where there are any.
pub(crate) fn plan(
    frame: &mut FrameGraph,
    grids: &Grids,
    is_needed: bool,
) -> (ResourceId, Option<ResourceId>) {
    let size = size_if(is_needed, grids.color());
    let ids = frame.graph.image("beam ids", Format::U32, size);
    if !is_needed {
        return (ids, None);
    }
    let depths = frame.graph.image("beam depths", Format::Depth, size);
    let bound = [
        frame.color_window,
        frame.posed,
        frame.triangles,
        frame.parts,
    ];
    frame
        .graph
        .draw(&raster::DRAW_BEAMS, &bound, &[ids, depths], true);
    (ids, Some(depths))
}
