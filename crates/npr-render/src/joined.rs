//! The parts of a mesh as one.

use npr_core::geometry::NONE;
use npr_scene::Part;

/// All parts of a mesh in one list each of vertices, triangles and segments, part after part.
#[derive(Debug, Default)]
pub(crate) struct Joined {
    pub positions: Vec<[f32; 3]>,
    /// The file's normals, zero at the vertices of parts that have none; empty where no part has any.
    pub normals: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// Ends of each line segment.
    pub segments: Vec<[u32; 2]>,
    /// Part of each line segment.
    pub segment_parts: Vec<u32>,
    /// Part of each triangle.
    pub parts: Vec<u32>,
    /// Material of each triangle.
    pub materials: Vec<u32>,
    /// Whether every part has normals.
    pub has_normals: bool,
}

impl Joined {
    pub fn new(parts: &[&Part]) -> Self {
        let mut joined = Self {
            has_normals: parts.iter().all(|part| part.normals.is_some()),
            ..Self::default()
        };
        for (index, part) in parts.iter().enumerate() {
            // Append the vertices; where normals begin, earlier parts get zeros.
            let base = joined.positions.len() as u32;
            joined.positions.extend(&part.positions);
            if let Some(normals) = &part.normals {
                joined.normals.resize(base as usize, [0.0; 3]);
                joined.normals.extend(normals);
            }

            // Append triangles and segments with new numbers, and the part of each.
            joined.triangles.extend(
                part.triangles
                    .iter()
                    .map(|corners| corners.map(|corner| corner + base)),
            );
            joined
                .segments
                .extend(part.segments.iter().map(|ends| ends.map(|end| end + base)));
            joined
                .segment_parts
                .resize(joined.segments.len(), index as u32);
            joined.parts.resize(joined.triangles.len(), index as u32);
            joined
                .materials
                .resize(joined.triangles.len(), part.material.unwrap_or(NONE));
        }

        // Fill up the normals of the last parts with zeros.
        if !joined.normals.is_empty() {
            joined.normals.resize(joined.positions.len(), [0.0; 3]);
        }
        joined
    }
}
