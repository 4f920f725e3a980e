//! A triangulated picture: which triangles belong together, and the rings around them.

use super::error::FillError;
use super::snap::Point;
use npr_core::geometry::NONE;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Triangles over the whole picture; half-edge `3 t + i` runs from corner `i` of triangle `t` to the next.
pub(super) struct Map {
    pub(super) points: Vec<Point>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The half-edge on the other side, or [`NONE`] at the border of the picture.
    twins: Vec<u32>,
    /// Whether the half-edge lies on a line.
    walls: Vec<bool>,
}

impl Map {
    /// Triangulates segments that meet only at their ends, with triangles that keep clear of them.
    ///
    /// A segment that still crosses another is left out, so this neither fails nor panics where snapping missed a
    /// crossing.
    pub(super) fn new(segments: &[[Point; 2]]) -> Result<Self, FillError> {
        let mut points = segments.as_flattened().to_vec();
        points.sort_unstable();
        points.dedup();
        // Every end was just put into the list.
        let number = |p: &Point| points.binary_search(p).unwrap_or_default();
        let edges = segments
            .iter()
            .map(|ends| [number(&ends[0]), number(&ends[1])]);
        let places = points
            .iter()
            .map(|[x, y]| Point2::new(*x as f64, *y as f64));
        let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
            places.collect(),
            edges.collect(),
            |_| (),
        )?;
        let mut of_edge = vec![NONE; cdt.num_directed_edges()];
        let mut map = Self {
            points,
            triangles: Vec::with_capacity(cdt.num_inner_faces()),
            twins: Vec::new(),
            walls: Vec::new(),
        };
        for face in cdt.inner_faces() {
            for (i, edge) in (0..).zip(face.adjacent_edges()) {
                of_edge[edge.fix().index()] = 3 * map.triangles.len() as u32 + i;
                map.walls.push(edge.is_constraint_edge());
            }
            let corners = face.adjacent_edges().map(|edge| edge.from().index() as u32);
            map.triangles.push(corners);
        }
        let edges = cdt.inner_faces().flat_map(|face| face.adjacent_edges());
        map.twins = edges
            .map(|edge| of_edge[edge.rev().fix().index()])
            .collect();
        Ok(map)
    }

    /// Twice the area of a triangle.
    pub(super) fn area(&self, triangle: usize) -> i64 {
        let [a, b, c] = self.triangles[triangle].map(|p| self.points[p as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Numbers of the areas that lines enclose, one for every triangle.
    pub(super) fn areas(&self) -> Vec<u32> {
        self.flood(|half_edge, _| !self.walls[half_edge as usize])
    }

    /// Numbers of connected sets of triangles with equal labels.
    pub(super) fn groups(&self, labels: &[Option<u32>]) -> Vec<u32> {
        let label = |half_edge: u32| labels[half_edge as usize / 3];
        self.flood(|here, there| label(here) == label(there))
    }

    /// Numbers of the sets that triangles form when they are joined across half-edges.
    fn flood(&self, joins: impl Fn(u32, u32) -> bool) -> Vec<u32> {
        let mut numbers = vec![NONE; self.triangles.len()];
        let mut stack = Vec::new();
        let mut count = 0;
        for seed in 0..self.triangles.len() as u32 {
            if numbers[seed as usize] != NONE {
                continue;
            }

            // Begin a set at a triangle that has none.
            numbers[seed as usize] = count;
            stack.push(seed);

            // Let it grow across sides that join.
            while let Some(triangle) = stack.pop() {
                for half_edge in 3 * triangle..3 * triangle + 3 {
                    let twin = self.twins[half_edge as usize];
                    if twin == NONE || !joins(half_edge, twin) {
                        continue;
                    }
                    let number = &mut numbers[twin as usize / 3];
                    if *number == NONE {
                        *number = count;
                        stack.push(twin / 3);
                    }
                }
            }
            count += 1;
        }
        numbers
    }

    /// The rings around every group, as points; the area inside lies on the same side of all of them.
    pub(super) fn rings(&self, groups: &[u32]) -> Vec<(u32, Vec<u32>)> {
        let group = |half_edge: u32| groups[half_edge as usize / 3];
        let inner = |half_edge: u32| {
            let twin = self.twins[half_edge as usize];
            (twin != NONE && group(twin) == group(half_edge)).then_some(twin)
        };
        let mut seen = vec![false; self.twins.len()];
        let mut rings = Vec::new();
        for start in 0..self.twins.len() as u32 {
            if seen[start as usize] || inner(start).is_some() {
                continue;
            }
            let (mut ring, mut half_edge) = (Vec::new(), start);
            while !seen[half_edge as usize] {
                seen[half_edge as usize] = true;
                ring.push(self.triangles[half_edge as usize / 3][half_edge as usize % 3]);
                half_edge = following(half_edge);
                // Turn around the corner inside the group: two areas that touch in a point stay apart.
                while let Some(twin) = inner(half_edge) {
                    half_edge = following(twin);
                }
            }
            rings.push((group(start), ring));
        }
        rings
    }
}

fn following(half_edge: u32) -> u32 {
    if half_edge % 3 == 2 {
        half_edge - 2
    } else {
        half_edge + 1
    }
}
