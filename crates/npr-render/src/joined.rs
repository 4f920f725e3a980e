//! The parts of a mesh as one.

use npr_core::geometry::NONE;
use npr_scene::Part;

/// The vertices of all parts of a mesh behind one another.
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
            let base = joined.positions.len() as u32;
            joined.positions.extend(&part.positions);
            if let Some(normals) = &part.normals {
                joined.normals.resize(base as usize, [0.0; 3]);
                joined.normals.extend(normals);
            }
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
        if !joined.normals.is_empty() {
            joined.normals.resize(joined.positions.len(), [0.0; 3]);
        }
        joined
    }
}
