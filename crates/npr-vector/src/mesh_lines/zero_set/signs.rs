//! Which parts of every face count as front.

use super::normals::CornerNormals;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;

/// Crossings keep this distance from the ends of their edge, as a fraction of it.
///
/// A crossing on a vertex would be shared by all its edges, and pieces between crossings would have no length.
pub const END_GAP: f32 = 1.0 / 4096.0;

/// Faces that are front or back as a whole, by their own plane, instead of by interpolated normals.
///
/// With no face in the set, lines are the smooth contours of interpolated normals; with all of them, the polygon's
/// contours. Any set in between gives closed lines too, that run along mesh edges on faces of the set.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FlatFaces {
    /// Whether each face is front, if it is in the set; empty if none is.
    label: Vec<Option<bool>>,
    faces: Vec<u32>,
}

impl FlatFaces {
    /// No face.
    pub const NONE: Self = Self {
        label: Vec::new(),
        faces: Vec::new(),
    };

    /// The faces that `choose` accepts; `front` holds for every face whether it is turned to the eye, from
    /// [`crate::mesh_lines::contour::facing`].
    pub fn new(front: &[u8], choose: impl Fn(u32) -> bool) -> Self {
        let faces: Vec<u32> = (0..front.len() as u32)
            .filter(|face| choose(*face))
            .collect();
        if faces.is_empty() {
            return Self::NONE;
        }
        let mut label = vec![None; front.len()];
        for face in &faces {
            label[*face as usize] = Some(front[*face as usize] != 0);
        }
        Self { label, faces }
    }

    /// The faces of the set, ascending.
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// Whether a face of the set is front; `None` for other faces.
    pub fn front(&self, face: u32) -> Option<bool> {
        self.label.get(face as usize).copied().flatten()
    }
}

/// A place on an edge, from 0 at its lower vertex to 1 at its higher.
///
/// Places of two sides never tie: of equal parameters, the one of the lower half-edge comes first.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct Crossing {
    pub t: f32,
    /// The half-edge on whose side this crossing lies; otherwise the place is an end of the edge.
    pub half_edge: u32,
}

impl Crossing {
    pub const LOW: Self = Self {
        t: 0.0,
        half_edge: NONE,
    };
    pub const HIGH: Self = Self {
        t: 1.0,
        half_edge: NONE,
    };
}

/// Signs of n.v at all corners, for one view.
pub(super) struct Signs<'a> {
    pub shape: &'a HalfEdgeMesh,
    pub normals: &'a CornerNormals,
    pub flat: &'a FlatFaces,
    pub eye: [f64; 4],
    /// n.v of every fan.
    pub values: Vec<f64>,
}

impl<'a> Signs<'a> {
    pub fn new(
        shape: &'a HalfEdgeMesh,
        normals: &'a CornerNormals,
        flat: &'a FlatFaces,
        eye: [f64; 4],
    ) -> Self {
        Self {
            shape,
            normals,
            flat,
            eye,
            values: normals.facing_values(shape, eye),
        }
    }

    /// n.v at a corner.
    pub fn value(&self, corner: u32) -> f64 {
        self.values[self.normals.fan(corner) as usize]
    }

    /// Whether the surface counts as front at a corner.
    pub fn front(&self, corner: u32) -> bool {
        self.flat
            .front(corner / 3)
            .unwrap_or_else(|| self.value(corner) >= 0.0)
    }

    /// Where the side of a half-edge changes between front and back.
    pub fn crossing(&self, half_edge: u32) -> Option<Crossing> {
        let ends = [half_edge, HalfEdgeMesh::following(half_edge)];
        if self.front(ends[0]) == self.front(ends[1]) {
            return None;
        }
        let [mut low, mut high] = ends.map(|corner| self.value(corner));
        if !self.shape.runs_up(half_edge) {
            (low, high) = (high, low);
        }
        let t = (low / (low - high)) as f32;
        let t = if t > END_GAP { t } else { END_GAP };
        Some(Crossing {
            t: t.min(1.0 - END_GAP),
            half_edge,
        })
    }

    /// Whether lines pass across a pair of twins without a step.
    pub fn joined(&self, half_edge: u32, twin: u32) -> bool {
        let flat = |side: u32| self.flat.front(side / 3).is_some();
        !flat(half_edge) && !flat(twin) && self.normals.joins(half_edge, twin)
    }

    /// The part of an edge, from low to high, where the side of a half-edge is front, or else back; it may be empty.
    fn part(&self, half_edge: u32, front: bool) -> [Crossing; 2] {
        let ends = [half_edge, HalfEdgeMesh::following(half_edge)];
        let [mut low, mut high] = ends.map(|corner| self.front(corner) == front);
        if !self.shape.runs_up(half_edge) {
            (low, high) = (high, low);
        }
        match (low, high, self.crossing(half_edge)) {
            (true, false, Some(crossing)) => [Crossing::LOW, crossing],
            (false, true, Some(crossing)) => [crossing, Crossing::HIGH],
            (true, ..) => [Crossing::LOW, Crossing::HIGH],
            _ => [Crossing::HIGH, Crossing::LOW],
        }
    }

    /// The part of an edge, in the direction of the half-edge, where its side is front and the other back.
    pub fn step(&self, half_edge: u32, twin: u32) -> Option<[Crossing; 2]> {
        let (front, back) = (self.part(half_edge, true), self.part(twin, false));
        let later = |a: Crossing, b: Crossing| if a > b { a } else { b };
        let from = later(front[0], back[0]);
        let to = if front[1] < back[1] {
            front[1]
        } else {
            back[1]
        };
        if from >= to {
            return None;
        }
        Some(if self.shape.runs_up(half_edge) {
            [from, to]
        } else {
            [to, from]
        })
    }

    /// Whether the side of a half-edge is front at a place.
    pub fn front_at(&self, half_edge: u32, place: Crossing) -> bool {
        let [from, to] = self.part(half_edge, true);
        from < place && place < to
    }
}
