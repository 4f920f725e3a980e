//! A surface as line producers read it: welded, with half-edges and unique edges.

use crate::geometry::NONE;

/// Triangles in the world, with everything that does not depend on the camera.
///
/// Half-edge `3 f + i` runs from corner `i` of face `f` to corner `i + 1`, around the face counter-clockwise.
/// Faces with two equal corners, and faces with the corners of an earlier one, have been removed; faces
/// without area are kept, because they hold the surface together, and listed in `slivers`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Shape {
    /// Positions of the welded vertices, in the world.
    pub positions: Vec<[f32; 3]>,
    /// Welded corners of every face.
    pub faces: Vec<[u32; 3]>,
    /// Index of each face's [`Surface`].
    pub face_surfaces: Vec<u32>,
    /// The half-edge on the other side, running the opposite way, or [`NONE`]: an involution.
    ///
    /// Where more than two faces meet, or two run the same way, as many as can are paired.
    pub twins: Vec<u32>,
    /// The unique edge of every half-edge.
    pub edge_of: Vec<u32>,
    /// Where the half-edges of each edge start in `edge_sides`; one more than there are edges.
    pub edge_starts: Vec<u32>,
    /// Half-edges, grouped by edge: of a manifold edge first the one that runs from its lower vertex.
    pub edge_sides: Vec<u32>,
    /// Cosine of the angle between the normals of the two faces of an edge; 1 where it has not two.
    pub dihedral_cos: Vec<f32>,
    /// Bits of [`Shape::BORDER`] to [`Shape::MARKED`] for every edge.
    pub edge_traits: Vec<u32>,
    /// Faces without area, each with the face whose orientation it takes over: the nearest with area across its longest edges, or [`NONE`].
    pub slivers: Vec<[u32; 2]>,
    /// What faces belong to.
    pub surfaces: Vec<Surface>,
}

/// One object in one material.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surface {
    /// Number of the object, the same for all its surfaces.
    pub object: u32,
    /// Number of the material.
    pub material: u32,
    /// Name of the object; may be any text.
    pub object_name: String,
    /// Name of the material; may be any text.
    pub material_name: String,
    /// Base colour, linear light, straight alpha.
    pub base_color: [f32; 4],
    /// The file asks for both sides to be drawn.
    pub double_sided: bool,
}

impl Shape {
    /// The edge has a single face.
    pub const BORDER: u32 = 1;
    /// The two faces differ in material.
    pub const MATERIAL: u32 = 2;
    /// Three or more faces meet.
    pub const NON_MANIFOLD: u32 = 4;
    /// Two faces meet, but run the same way: one of them is inside out.
    pub const FLIPPED: u32 = 8;
    /// The user asks for a line here.
    pub const MARKED: u32 = 16;

    /// Number of unique edges.
    pub fn edge_count(&self) -> usize {
        self.edge_traits.len()
    }

    /// Half-edges of an edge.
    pub fn sides(&self, edge: u32) -> &[u32] {
        let [from, to] = [edge, edge + 1].map(|e| self.edge_starts[e as usize] as usize);
        &self.edge_sides[from..to]
    }

    /// The two vertices of an edge, the lower first.
    pub fn ends(&self, edge: u32) -> [u32; 2] {
        let [a, b] = self.ends_of_half_edge(self.sides(edge)[0]);
        [a.min(b), a.max(b)]
    }

    /// Tail and head of a half-edge.
    pub fn ends_of_half_edge(&self, half_edge: u32) -> [u32; 2] {
        let corners = self.faces[half_edge as usize / 3];
        let i = half_edge as usize % 3;
        [corners[i], corners[(i + 1) % 3]]
    }

    /// The half-edge that follows in the same face.
    pub fn following(half_edge: u32) -> u32 {
        if half_edge % 3 == 2 {
            half_edge - 2
        } else {
            half_edge + 1
        }
    }

    /// The corner of a half-edge's face that is not on the half-edge.
    pub fn opposite(&self, half_edge: u32) -> u32 {
        self.faces[half_edge as usize / 3][(half_edge as usize + 2) % 3]
    }

    /// Whether the half-edge runs from the lower vertex of its edge to the higher.
    pub fn runs_up(&self, half_edge: u32) -> bool {
        let [tail, head] = self.ends_of_half_edge(half_edge);
        tail < head
    }

    /// Asserts what the type promises.
    ///
    /// # Panics
    ///
    /// When a promise is broken, naming it.
    pub fn sanity_check(&self) {
        let half_edges = 3 * self.faces.len();
        assert_eq!(
            self.face_surfaces.len(),
            self.faces.len(),
            "a surface per face"
        );
        assert_eq!(self.twins.len(), half_edges, "a twin per half-edge");
        assert_eq!(self.edge_of.len(), half_edges, "an edge per half-edge");
        assert_eq!(
            self.edge_sides.len(),
            half_edges,
            "every half-edge in one edge"
        );
        assert_eq!(
            self.edge_starts.len(),
            self.edge_count() + 1,
            "starts of edges"
        );
        assert_eq!(
            self.dihedral_cos.len(),
            self.edge_count(),
            "an angle per edge"
        );
        for (face, corners) in self.faces.iter().enumerate() {
            let [a, b, c] = *corners;
            assert!(a != b && b != c && c != a, "face {face} has equal corners");
            let known = |v: u32| (v as usize) < self.positions.len();
            assert!(
                known(a) && known(b) && known(c),
                "face {face} misses a vertex"
            );
            assert!(
                (self.face_surfaces[face] as usize) < self.surfaces.len(),
                "surface of face {face}"
            );
        }
        for half_edge in 0..half_edges as u32 {
            let twin = self.twins[half_edge as usize];
            if twin == NONE {
                continue;
            }
            assert_eq!(self.twins[twin as usize], half_edge, "twins come in pairs");
            let [tail, head] = self.ends_of_half_edge(half_edge);
            assert_eq!(
                self.ends_of_half_edge(twin),
                [head, tail],
                "twins run opposite ways"
            );
        }
        for edge in 0..self.edge_count() as u32 {
            assert!(!self.sides(edge).is_empty(), "edge {edge} has no face");
            for side in self.sides(edge) {
                assert_eq!(self.edge_of[*side as usize], edge, "sides name their edge");
                let [a, b] = self.ends_of_half_edge(*side);
                assert_eq!(
                    [a.min(b), a.max(b)],
                    self.ends(edge),
                    "sides share their ends"
                );
            }
        }
        assert!(
            self.positions.iter().flatten().all(|v| v.is_finite()),
            "finite positions"
        );
    }
}
