//! Every pass of the drawing machine, by domain.

use crate::pass::Pass;

pub mod line;
pub mod mesh;
pub mod raster;
pub mod shade;

/// All passes: each is checked against its shader and its twin.
pub const ALL: &[&Pass] = &[
    &mesh::POSE_VERTICES,
    &mesh::CLASSIFY_EDGES,
    &mesh::EXTRUDE_HULL,
    &raster::DRAW_IDS,
    &raster::DRAW_HULL,
    &line::RESOLVE_GBUFFER,
    &line::DETECT,
    &line::DRAW_RIBBONS,
    &line::FIND_RESIDUAL,
    &line::SMOOTH_STAMPS,
    &line::FLAG_TILES,
    &line::STAMP_RESIDUAL,
    &shade::COMPOSE_FRAME,
];
