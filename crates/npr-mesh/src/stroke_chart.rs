//! Coordinates for hatch strokes on any triangle mesh, without a layout of its texture.
//!
//! Strokes follow a smooth field of directions and stay on the surface, so they move with it under any camera.
//! A chart gives each triangle its own coordinates at its corners: `u` counts tiles across the strokes, `v` along
//! them. No closed surface but a torus has directions without a singular point, so coordinates of neighbours agree
//! only up to whole tiles and a half turn, `(u, v)` to `(-u, -v)`: a tile that repeats in both and looks the same
//! upside down shows no seam.
//!
//! Directions are smoothed as in [Knöppel et al. 2013], coordinates are angles spread over the mesh as in
//! [Knöppel et al. 2015], and both run from coarse to fine by local averages as in [Jakob et al. 2015].
//!
//! ```
//! use npr_core::geometry::Triangle;
//! use npr_mesh::stroke_chart::{ChartInput, ChartSettings, stroke_chart};
//!
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
//! let triangles = [Triangle { corners: [0, 1, 2], part: 0 }];
//! let surface = ChartInput { positions: &positions, triangles: &triangles, directions: &[] };
//! let chart = stroke_chart(&surface, &ChartSettings { tile_world: 0.5, ..Default::default() });
//!
//! // An edge of length 1 is two tiles long.
//! let [[a, b], [c, d], _] = chart.corners[0];
//! let tiles = ((c - a) * (c - a) + (d - b) * (d - b)).sqrt();
//! assert!((tiles - 2.0).abs() < 1e-3);
//! ```

mod corners;
mod phases;
#[cfg(test)]
mod tests;

use npr_core::geometry::Triangle;
use rayon::prelude::*;

use crate::direction_field::nodes::Nodes;
use crate::direction_field::{Painted, PartGuide, directions};
use corners::{Lifted, lift};
use phases::{Site, phases};

/// The surface to be hatched.
#[derive(Debug, Clone, Copy, Default)]
pub struct ChartInput<'a> {
    /// Stored vertices; equal ones are welded.
    pub positions: &'a [[f32; 3]],
    /// Triangles over them, counter-clockwise seen from the front. Strokes do not run on from part to part.
    pub triangles: &'a [Triangle],
    /// For parts guided by [`Guide::Painted`](crate::direction_field::Guide::Painted), a direction at every vertex;
    /// may be empty where there are none.
    pub directions: &'a [[f32; 3]],
}

/// How strokes lie on a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartSettings {
    /// Size of a tile in units of the positions, above 0. At 1/20 of a figure's height single limbs show a few tiles.
    pub tile_world: f32,
    /// Cosine of the angle between faces from which strokes end at an edge; 0.766 (40 degrees) by default.
    pub crease_cos: f32,
    /// What strokes follow on each part; parts beyond the end take the default.
    pub guides: Vec<PartGuide>,
    /// Distance, in tiles, over which directions even out; 1 by default. At 0.3 strokes follow every dent, at 4
    /// they sweep over the whole figure.
    pub smoothing_tiles: f32,
    /// Sweeps of averaging on each level; 4 by default. More even out spacing on rough scans only a little.
    ///
    /// Round a tube a whole number of tiles must fit: of 1500 tubes 4 sweeps left at most 0.55 of that stretch uneven.
    pub rounds: u32,
}

impl Default for ChartSettings {
    fn default() -> Self {
        Self {
            tile_world: 0.1,
            crease_cos: 0.766,
            guides: Vec::new(),
            smoothing_tiles: 1.0,
            rounds: 4,
        }
    }
}

/// Coordinates of every triangle's corners.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StrokeChart {
    /// For every triangle its corners' `[u, v]` in tiles, across and along the strokes.
    ///
    /// `u` grows to the right of `v` seen from the front. The middle of each triangle lies within half a tile of
    /// the origin. Triangles without area have zeros.
    pub corners: Vec<[[f32; 2]; 3]>,
    /// For every triangle the length by which the coordinates' gradients, in 1 / tile, miss unit vectors across and
    /// along the strokes; 1 where it is singular, 0 without an area.
    pub errors: Vec<f32>,
    /// Triangles in which a stroke ends or directions turn round: there neighbours do not agree.
    pub singular_triangles: u32,
    /// Those of them in which directions turn round: strokes bend about such a point, or fan out from it. A sphere
    /// has at least four, a torus needs none.
    pub turning_triangles: u32,
    /// Mean over the area of the length by which the coordinates' gradients, in 1 / tile, miss unit vectors across and
    /// along the strokes.
    pub gradient_error: f32,
}

/// Spreads stroke coordinates over a surface.
///
/// Neighbours across an edge agree at both ends, up to whole tiles and a half turn, unless the edge is a crease, a
/// border of parts, winds both faces alike, or one of the triangles is singular. A larger copy of a surface with
/// larger tiles has the same chart, and so has one with its triangles in any order, but for half turns, whole tiles
/// and rounding. The number of threads changes no bit. A tile size that is not above 0 gives zeros.
///
/// O(rounds * triangles), in parallel; about 3 microseconds of processor time a triangle.
///
/// # Panics
///
/// If a triangle names a vertex that does not exist.
pub fn stroke_chart(surface: &ChartInput, settings: &ChartSettings) -> StrokeChart {
    // On a thread of the pool from end to end: the many short steps would wait for one each time.
    let (nodes, lifted) = rayon::scope(|_| lift_faces(surface, settings));
    gather(&nodes.faces, &lifted, surface.triangles.len())
}

/// The nodes of a surface, and the coordinates of every triangle that has an area.
fn lift_faces(surface: &ChartInput, settings: &ChartSettings) -> (Nodes, Vec<Lifted>) {
    let scale = if settings.tile_world > 0.0 {
        1.0 / f64::from(settings.tile_world)
    } else {
        f64::NAN
    };
    // Positions in tiles, of which those too far to tell tiles apart count as no positions.
    let in_tiles = |p: &[f32; 3]| p.map(|v| (f64::from(v) * scale) as f32);
    let positions: Vec<[f32; 3]> = surface.positions.par_iter().map(in_tiles).collect();
    let nodes = Nodes::new(&positions, surface.triangles, settings.crease_cos);
    let guide_of_part = |part: u32| {
        let guide = settings.guides.get(part as usize);
        guide.copied().unwrap_or_default()
    };
    let painted = Painted {
        triangles: surface.triangles,
        directions: surface.directions,
    };
    let directions = directions(
        &nodes,
        guide_of_part,
        &painted,
        settings.smoothing_tiles,
        settings.rounds,
    );
    let phases = phases(&nodes, &directions, settings.rounds);
    let lifted = nodes
        .corners
        .par_iter()
        .map(|&corners| {
            let anchor = corners.iter().enumerate().min_by_key(|(_, node)| **node);
            let sites = corners.map(|node| Site::of(&nodes, &directions, node as usize));
            let phases = corners.map(|node| phases[node as usize]);
            lift(sites, phases, anchor.map_or(0, |(k, _)| k))
        })
        .collect();
    (nodes, lifted)
}

/// The chart of all triangles from that of those with an area.
fn gather(faces: &[u32], lifted: &[Lifted], triangle_count: usize) -> StrokeChart {
    // Start from charts without strokes.
    let mut corners = vec![[[0.0; 2]; 3]; triangle_count];
    let mut errors = vec![0.0; triangle_count];
    let (mut error, mut area) = (0.0, 0.0);
    let count = |of: fn(&Lifted) -> bool| lifted.iter().filter(|&one| of(one)).count() as u32;

    // Lay the charts of triangles with area into place, and sum their errors.
    for (&face, lifted) in faces.iter().zip(lifted) {
        corners[face as usize] = lifted.corners.map(|corner| corner.to_array());
        if lifted.gradient_error.is_finite() && lifted.area.is_finite() {
            errors[face as usize] = if lifted.singular {
                1.0
            } else {
                lifted.gradient_error
            };
            error += f64::from(lifted.gradient_error) * f64::from(lifted.area);
            area += f64::from(lifted.area);
        }
    }

    // Give the mean error over the area.
    StrokeChart {
        corners,
        errors,
        singular_triangles: count(|lifted| lifted.singular),
        turning_triangles: count(|lifted| lifted.turning),
        gradient_error: if area > 0.0 {
            (error / area) as f32
        } else {
            0.0
        },
    }
}
