//! Hulls: copies of meshes grown along their normals, whose back faces show as outlines.

use crate::frame_graph::FrameGraph;
use npr_gpu::passes::{mesh, raster};

/// Draws the hulls behind the surfaces that a frame shows.
pub(crate) fn plan(frame: &mut FrameGraph, vertex_count: usize) {
    // Grow every vertex along its normal.
    let hull = frame.graph.buffer::<[f32; 4]>("hull", vertex_count);
    let extrude = [
        frame.view,
        frame.vertices,
        frame.influences,
        frame.palette,
        frame.posed,
        hull,
    ];
    frame.graph.compute(&mesh::EXTRUDE_HULL, &extrude);

    // Add the back faces to the numbers and depths of the surfaces.
    let bound = [
        frame.view,
        frame.color_window,
        hull,
        frame.vertices,
        frame.triangles,
        frame.parts,
        frame.texels,
    ];
    let targets = [frame.ids, frame.depths];
    frame
        .graph
        .draw(&raster::DRAW_HULL, &bound, &targets, false);
}
