//! Pieces of a shape, and lines through them.

use crate::card_lines::CardPoint;
use crate::half_edge::HalfEdgeMesh;
use glam::DVec3;

/// Least length of a card, in its greatest widths. A leaf is about three times as long as wide, a blade of grass ten
/// to fifty times.
pub const LEAST_RATIO: f64 = 4.0;

/// Least distance of points that follow each other on a line, as a share of their mean distance.
const LEAST_STEP: f64 = 1e-3;

/// Faces that hang together by their edges, and how.
pub(super) struct Piece<'a> {
    pub shape: &'a HalfEdgeMesh,
    pub faces: &'a [u32],
    /// Loops of vertices around its openings; none where an edge or a corner has more neighbours than a plain surface.
    pub loops: Vec<Vec<u32>>,
    /// Vertices and faces less edges: 1 for what can be laid flat, 2 for a ball.
    pub euler: i64,
}

impl<'a> Piece<'a> {
    /// A piece whose faces `names` names alike; `None` where more than two of its faces meet in an edge.
    pub fn new(shape: &'a HalfEdgeMesh, faces: &'a [u32], names: &[u32]) -> Option<Self> {
        // Tell its border from the edges inside.
        let name = names[faces[0] as usize];
        let mut border: Vec<[u32; 2]> = Vec::new();
        for half_edge in faces.iter().flat_map(|face| 3 * face..3 * face + 3) {
            let sides = shape.sides(shape.edge_of[half_edge as usize]);
            match sides
                .iter()
                .filter(|side| names[**side as usize / 3] == name)
                .count()
            {
                1 => border.push(shape.ends_of_half_edge(half_edge)),
                2 => {}
                _ => return None,
            }
        }

        // Count what it is made of.
        let mut vertices: Vec<u32> = faces
            .iter()
            .flat_map(|face| shape.faces[*face as usize])
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let edge_count = (3 * faces.len() + border.len()) / 2;
        let euler = vertices.len() as i64 - edge_count as i64 + faces.len() as i64;
        Some(Self {
            shape,
            faces,
            loops: loops_of(&border)?,
            euler,
        })
    }

    pub fn point(&self, vertex: u32) -> DVec3 {
        self.shape.point(vertex)
    }

    /// Area of its faces.
    pub fn area(&self) -> f64 {
        let area = |face: &u32| {
            let [a, b, c] = self.shape.faces[*face as usize].map(|vertex| self.point(vertex));
            0.5 * (b - a).cross(c - a).length()
        };
        self.faces.iter().map(area).sum()
    }
}

/// The loops that undirected edges of a border make; `None` where they meet in other numbers than two.
fn loops_of(border: &[[u32; 2]]) -> Option<Vec<Vec<u32>>> {
    // Sort the ends of edges by vertex: two follow each other for every vertex.
    let mut ends: Vec<(u32, usize)> = border
        .iter()
        .enumerate()
        .flat_map(|(edge, ends)| ends.map(|vertex| (vertex, edge)))
        .collect();
    ends.sort_unstable();
    let is_plain = |pair: &[(u32, usize)]| pair.len() == 2;
    if !ends.chunk_by(|a, b| a.0 == b.0).all(is_plain) {
        return None;
    }

    // Walk from edge to edge.
    let mut is_used = vec![false; border.len()];
    let mut loops = Vec::new();
    for first in 0..border.len() {
        let (mut edge, mut vertex) = (first, border[first][0]);
        let mut found = Vec::new();
        while !is_used[edge] {
            is_used[edge] = true;
            found.push(vertex);
            let [a, b] = border[edge];
            vertex = if a == vertex { b } else { a };
            let at = ends.partition_point(|end| end.0 < vertex);
            edge = ends[at..at + 2]
                .iter()
                .map(|end| end.1)
                .find(|next| *next != edge)?;
        }
        if !found.is_empty() {
            loops.push(found);
        }
    }
    Some(loops)
}

/// Length of a line.
pub(super) fn length_of(points: &[CardPoint]) -> f64 {
    let steps = points.windows(2);
    steps
        .map(|pair| pair[0].place.distance(pair[1].place))
        .sum()
}

/// Leaves out points that hardly differ from those before them, and gives all their directions; `None` for a line
/// without a length, or one that is not long for its width.
pub(super) fn finished(mut points: Vec<CardPoint>) -> Option<Vec<CardPoint>> {
    // Keep both ends.
    let least = LEAST_STEP * length_of(&points) / points.len() as f64;
    let last = points.pop()?;
    let mut kept: Vec<CardPoint> = Vec::with_capacity(points.len() + 1);
    for point in points {
        let is_new = |before: &CardPoint| before.place.distance(point.place) > least;
        if kept.last().is_none_or(is_new) && point.place.distance(last.place) > least {
            kept.push(point);
        }
    }
    kept.push(last);
    if kept.len() < 2 {
        return None;
    }

    // Directions go from the point before to the one after; what lies along them is no width.
    let places: Vec<DVec3> = kept.iter().map(|point| point.place).collect();
    for (index, point) in kept.iter_mut().enumerate() {
        let after = places[(index + 1).min(places.len() - 1)];
        point.along = (after - places[index.saturating_sub(1)]).normalize_or_zero();
        if point.across != DVec3::ZERO {
            point.across -= point.along * point.across.dot(point.along);
            point.width = point.across.length();
        }
    }
    let widest = kept.iter().map(|point| point.width).fold(0.0, f64::max);
    let length = length_of(&kept);
    (length.is_finite() && length > 0.0 && length >= LEAST_RATIO * widest).then_some(kept)
}

/// Area that a line covers between two ways along it.
pub(super) fn area_within(points: &[CardPoint], [from, to]: [f64; 2]) -> f64 {
    let mut way = 0.0;
    let areas = points.windows(2).map(|pair| {
        let step = pair[0].place.distance(pair[1].place);
        let [low, high] = [from, to].map(|end| ((end - way) / step).clamp(0.0, 1.0));
        way += step;
        let at = |share: f64| pair[0].width + share * (pair[1].width - pair[0].width);
        (high - low) * step * at(0.5 * (low + high))
    });
    areas.sum()
}
