//! Every pass of the drawing machine, by domain.

use crate::pass::Pass;

pub mod backdrop;
pub mod line;
pub mod mesh;
pub mod raster;
pub mod shade;
pub mod smoke;
pub mod vector;

/// All passes: each is checked against its shader and its twin.
pub const ALL: &[&Pass] = &[
    &mesh::POSE_VERTICES,
    &mesh::CLASSIFY_EDGES,
    &mesh::EXTRUDE_HULL,
    &mesh::PROJECT_SHADOW,
    &raster::DRAW_IDS,
    &raster::DRAW_SHADOW,
    &raster::DRAW_HULL,
    &raster::DRAW_BEAMS,
    &line::RESOLVE_GBUFFER,
    &line::DETECT,
    &line::LIGHT_WIDTHS,
    &line::COLOR_MASK,
    &line::DRAW_RIBBONS,
    &line::FIND_RESIDUAL,
    &line::SMOOTH_STAMPS,
    &line::FLAG_TILES,
    &line::STAMP_RESIDUAL,
    &line::DRAW_MASK,
    &vector::FACE_EYE,
    &vector::MARK_CONTOURS,
    &vector::LINK_CONTOURS,
    &vector::LIST_NODES,
    &vector::SCAN_BLOCKS,
    &vector::SCAN_ADD,
    &vector::COMPACT,
    &vector::START_NODES,
    &vector::BREAK_LOOPS,
    &vector::CUT_LOOPS,
    &vector::RANK_JUMP,
    &vector::FIND_SPLITTERS,
    &vector::WALK_TO_SPLITTER,
    &vector::START_SPLITTERS,
    &vector::RANK_SPLITTERS,
    &vector::SCATTER_RANKS,
    &vector::MEASURE_CHAINS,
    &vector::TURN_RANKS,
    &vector::ORDER_NODES,
    &vector::SAMPLE_VISIBILITY,
    &vector::WEIGH_SAMPLES,
    &vector::FILTER_VISIBILITY,
    &smoke::PROJECT_SPHERES,
    &smoke::DRAW_SPHERES,
    &smoke::SHADE_SPHERES,
    &smoke::GATHER_TONES,
    &smoke::BLUR_ROWS,
    &smoke::BLUR_COLUMNS,
    &smoke::SMOOTH_TONES,
    &smoke::RESOLVE_PICTURE,
    &backdrop::FLAG_TILES,
    &backdrop::FIND_RIMS,
    &backdrop::DRAW_RIMS,
    &backdrop::SMOOTH_RIMS,
    &backdrop::SPREAD_ROWS,
    &backdrop::SPREAD_RIMS,
    &shade::COMPOSE_FRAME,
];
