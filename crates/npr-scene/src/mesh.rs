//! Meshes: triangles and lines that share a node.

use crate::morph::{Morph, Unmorphed};

/// Largest magnitude of a position coordinate that counts as in range.
///
/// Squares and products with transforms of the same size stay finite in `f32`; anything larger in a
/// file is a fault rather than a shape.
pub const POSITION_LIMIT: f32 = 1e18;

/// Whether a position is finite and in range.
pub(crate) fn is_sound(position: &[f32; 3]) -> bool {
    position.iter().all(|v| v.abs() <= POSITION_LIMIT)
}

/// What one node draws.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Name as in the file; empty where it has none.
    pub name: String,
    /// One part per material, and per id where an id map cuts it up.
    pub parts: Vec<Part>,
}

/// Triangles and lines of one material.
///
/// All vertex lists are as long as `positions`. Triangles wind counter-clockwise seen from outside,
/// may be degenerate, and name existing vertices only, as line segments do.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Part {
    /// Vertex positions in mesh space, morphed by the weights of the pose.
    pub positions: Vec<[f32; 3]>,
    /// Vertex normals, finite and near unit length; none asks for flat shading.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Coordinates for the base colour texture, from the set that the material asks for; the origin
    /// is the upper left corner of the image.
    pub uvs: Option<Vec<[f32; 2]>>,
    /// Vertex colours in linear light with straight alpha, each 0..1.
    pub colors: Option<Vec<[f32; 4]>>,
    /// Indices into the joints of the node's skin.
    pub joints: Option<Vec<[u16; 4]>>,
    /// Shares of the four joints, none negative, summing to one.
    pub weights: Option<Vec<[f32; 4]>>,
    /// Whether the file marks each vertex: an edge between two marked vertices is a line the user asks for.
    ///
    /// From the attribute `_NPR_LINE` of a glTF primitive, one number per vertex, marked above one half.
    pub marks: Option<Vec<bool>>,
    /// Directions of pen strokes at the vertices, in mesh space; their lengths and signs mean nothing, and zero says
    /// nothing.
    ///
    /// From the attribute `_DIRECTION` of a glTF primitive, three numbers per vertex.
    pub directions: Option<Vec<[f32; 3]>>,
    /// Vertices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// Vertices of each segment of lines that the file has as geometry, in its order; both may be the same.
    pub segments: Vec<[u32; 2]>,
    /// Index into the scene's materials.
    pub material: Option<u32>,
    /// Morph targets in file order; all parts of a mesh are meant to have the same number.
    pub morphs: Vec<Morph>,
    /// The vertices before any morph; none where there are no morphs, or where they cannot take other weights.
    pub unmorphed: Option<Box<Unmorphed>>,
    /// What styles may call the region of an id map that it is; empty where it is none. Files have none.
    pub ids: Vec<String>,
}

impl Part {
    /// Asserts what the type promises.
    ///
    /// # Panics
    ///
    /// When a list has another length than `positions`, an index is out of range, or a number that
    /// reaches a picture is not finite.
    pub fn sanity_check(&self) {
        // Check triangles and lines.
        let count = self.positions.len();
        let corners = self.triangles.iter().flatten();
        let ends = self.segments.iter().flatten();
        assert!(
            corners.chain(ends).all(|&v| (v as usize) < count),
            "vertex in range"
        );
        assert!(
            self.positions
                .iter()
                .flatten()
                .all(|v| v.abs() <= POSITION_LIMIT),
            "sound position"
        );

        // Check that lists have a sound entry for each vertex.
        check_list(&self.normals, count);
        check_list(&self.uvs, count);
        check_list(&self.colors, count);
        check_list(&self.weights, count);
        check_list(&self.directions, count);
        assert!(
            self.joints
                .as_ref()
                .is_none_or(|joints| joints.len() == count),
            "list length"
        );
        assert!(
            self.marks.as_ref().is_none_or(|marks| marks.len() == count),
            "list length"
        );
        for morph in &self.morphs {
            check_list(&morph.positions, count);
            check_list(&morph.normals, count);
        }
        if let Some(unmorphed) = &self.unmorphed {
            assert_eq!(unmorphed.positions.len(), count, "list length");
            check_list(&unmorphed.normals, count);
            let both = (self.normals.is_some(), unmorphed.normals.is_some());
            assert_eq!(both.0, both.1, "normals before and after morphs");
        }
    }
}

fn check_list<const N: usize>(list: &Option<Vec<[f32; N]>>, count: usize) {
    let Some(list) = list else { return };
    assert_eq!(list.len(), count, "list length");
    assert!(
        list.iter().flatten().all(|v| v.is_finite()),
        "finite attribute"
    );
}
