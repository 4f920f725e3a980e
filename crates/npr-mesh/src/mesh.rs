//! The door: a triangle list whose indices and positions are known to be sound.

/// Why a mesh was rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A face names a vertex that does not exist.
    #[error("face {face} uses vertex {vertex}, but the mesh has only {vertex_count}")]
    MissingVertex {
        /// Which triangle, counted from 0.
        face: u32,
        /// The vertex index as read.
        vertex: u32,
        /// How many vertices were supplied.
        vertex_count: u32,
    },
    /// A coordinate is infinite or not a number.
    #[error("vertex {vertex} is not finite: {position:?}")]
    NotFinite {
        /// Which vertex, counted from 0.
        vertex: u32,
        /// Its position as read.
        position: [f32; 3],
    },
    /// There are more corners than 32-bit numbers can name.
    #[error("{vertex_count} vertices and {face_count} faces are too many for 32-bit indices")]
    TooMany {
        /// How many vertices were supplied.
        vertex_count: usize,
        /// How many triangles were supplied.
        face_count: usize,
    },
}

/// Triangles over finite positions, all indices in range.
///
/// Degenerate triangles are allowed: they draw nothing, and keep the numbering of faces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A mesh of `triangles` over `positions`, once both have been checked.
    ///
    /// # Errors
    ///
    /// [`MeshError`] names the first vertex that is not finite, else the first face that names a missing one.
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_counts(positions.len(), triangles.len())?;
        check_positions(&positions)?;
        check_indices(positions.len() as u32, &triangles)?;
        Ok(Self {
            positions,
            triangles,
        })
    }

    /// Positions of the stored vertices.
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// Three stored vertices per face, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// A mesh that a generator built soundly.
    #[cfg(any(test, feature = "testing"))]
    pub(crate) fn of_sound_parts(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        debug_assert!(check_indices(positions.len() as u32, &triangles).is_ok());
        Self {
            positions,
            triangles,
        }
    }
}

fn check_counts(vertex_count: usize, face_count: usize) -> Result<(), MeshError> {
    // Corner numbers are three times the face number, and the last number of all means none.
    let fits = vertex_count < u32::MAX as usize && face_count < u32::MAX as usize / 3;
    if fits {
        Ok(())
    } else {
        Err(MeshError::TooMany {
            vertex_count,
            face_count,
        })
    }
}

fn check_positions(positions: &[[f32; 3]]) -> Result<(), MeshError> {
    match positions
        .iter()
        .position(|position| !position.iter().all(|v| v.is_finite()))
    {
        Some(vertex) => Err(MeshError::NotFinite {
            vertex: vertex as u32,
            position: positions[vertex],
        }),
        None => Ok(()),
    }
}

fn check_indices(vertex_count: u32, triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    for (face, triangle) in triangles.iter().enumerate() {
        if let Some(&vertex) = triangle.iter().find(|&&vertex| vertex >= vertex_count) {
            return Err(MeshError::MissingVertex {
                face: face as u32,
                vertex,
                vertex_count,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_mesh_is_sound() {
        assert_eq!(Mesh::new(vec![], vec![]), Ok(Mesh::default()));
    }

    #[test]
    fn a_missing_vertex_is_named() {
        let error = Mesh::new(vec![[0.0; 3]; 3], vec![[0, 1, 2], [2, 3, 9]]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "face 1 uses vertex 3, but the mesh has only 3"
        );
    }

    #[test]
    fn positions_that_are_not_finite_are_refused() {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let error = Mesh::new(vec![[0.0; 3], [0.0, bad, 0.0]], vec![]).unwrap_err();
            assert!(
                matches!(error, MeshError::NotFinite { vertex: 1, .. }),
                "{error}"
            );
        }
    }
}
