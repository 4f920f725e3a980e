//! A half-edge mesh: welded triangles of all objects, with the unique edges that lines run along.

use crate::card_lines::CardLines;
use glam::DVec3;
use npr_core::crease::CreaseFrom;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use rayon::prelude::*;

/// Triangles in the world, with everything that does not depend on the camera.
///
/// Half-edge `3 f + i` runs from corner `i` of face `f` to corner `i + 1`, around the face counter-clockwise.
/// Faces with two equal corners, and faces with the corners of an earlier one, have been removed; faces
/// without area are kept, because they hold the surface together, and listed in `degenerate_faces`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HalfEdgeMesh {
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
    /// The two vertices of every edge, the lower first: those of its half-edges, kept because views ask for them at
    /// random, and faces are further away in memory.
    pub edge_ends: Vec<[u32; 2]>,
    /// Cosine of the angle between the normals of the two faces of an edge; 1 where it has not two.
    pub dihedral_cos: Vec<f32>,
    /// The same between the file's normals in the middle of the edge; that of the faces where they have none. Empty
    /// where all are.
    pub normals_cos: Vec<f32>,
    /// How the faces of every edge meet, and whether it is marked.
    pub edge_traits: Vec<EdgeFlags>,
    /// Faces without area, ascending, each with the face whose orientation it takes over: the nearest with
    /// area across its longest edges, or [`NONE`].
    pub degenerate_faces: Vec<[u32; 2]>,
    /// Lines that are geometry themselves, without faces: the two vertices of each segment, which differ, in the
    /// direction of the file. Segment `k` has the edge number `edge_count() + k`.
    pub polylines: Vec<[u32; 2]>,
    /// Index of each polyline's [`Surface`].
    pub polyline_surfaces: Vec<u32>,
    /// Which of the polylines are centre lines of cards; of none unless
    /// [`draw_by_centre`](crate::card::draw_by_centre) made them.
    pub cards: CardLines,
    /// What faces and polylines belong to.
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
    /// Its faces hide lines and have none: they are cards, for which centre lines stand.
    pub is_lineless: bool,
    /// It is part of a mass, with all such surfaces of its material: only where the image of that ends it has lines.
    pub is_mass: bool,
}

impl HalfEdgeMesh {
    /// Number of unique edges; polylines are numbered behind them.
    #[inline]
    pub fn edge_count(&self) -> usize {
        self.edge_traits.len()
    }

    /// Edge numbers of all polylines.
    pub fn polyline_edges(&self) -> std::ops::Range<u32> {
        let first = self.edge_count() as u32;
        first..first + self.polylines.len() as u32
    }

    /// Cosine of the angle by which an edge folds: 1 where it has not two faces, or where they run on smoothly.
    #[inline]
    pub fn fold_cos(&self, edge: u32, from: CreaseFrom) -> f32 {
        let faces = self.dihedral_cos[edge as usize];
        match from {
            CreaseFrom::Faces => faces,
            CreaseFrom::Normals => self
                .normals_cos
                .get(edge as usize)
                .copied()
                .unwrap_or(faces),
        }
    }

    /// Whether a face belongs to a surface without lines.
    #[inline]
    pub fn is_lineless(&self, face: u32) -> bool {
        self.surfaces[self.face_surfaces[face as usize] as usize].is_lineless
    }

    /// Which polyline an edge number means; none for edges of faces.
    #[inline]
    pub fn polyline_of(&self, edge: u32) -> Option<usize> {
        (edge as usize).checked_sub(self.edge_count())
    }

    /// Half-edges of an edge; a polyline has none.
    #[inline]
    pub fn sides(&self, edge: u32) -> &[u32] {
        if self.polyline_of(edge).is_some() {
            return &[];
        }
        let [from, to] = [edge, edge + 1].map(|e| self.edge_starts[e as usize] as usize);
        &self.edge_sides[from..to]
    }

    /// The two vertices of an edge or a polyline, the lower first.
    #[inline]
    pub fn ends(&self, edge: u32) -> [u32; 2] {
        match self.polyline_of(edge) {
            Some(polyline) => {
                let [a, b] = self.polylines[polyline];
                [a.min(b), a.max(b)]
            }
            None => self.edge_ends[edge as usize],
        }
    }

    /// Position of a vertex in the world.
    #[inline]
    pub fn point(&self, vertex: u32) -> DVec3 {
        DVec3::from_array(self.positions[vertex as usize].map(f64::from))
    }

    /// Point of the world on an edge, `t` of the way from its lower to its higher vertex; exact at both.
    #[inline]
    pub fn point_on(&self, edge: u32, t: f32) -> DVec3 {
        let [low, high] = self.ends(edge).map(|vertex| self.point(vertex));
        low.lerp(high, f64::from(t))
    }

    /// Tail and head of a half-edge.
    #[inline]
    pub fn ends_of_half_edge(&self, half_edge: u32) -> [u32; 2] {
        let corners = self.faces[half_edge as usize / 3];
        let i = half_edge as usize % 3;
        [corners[i], corners[(i + 1) % 3]]
    }

    /// The half-edge that follows in the same face.
    #[inline]
    pub fn following(half_edge: u32) -> u32 {
        if half_edge % 3 == 2 {
            half_edge - 2
        } else {
            half_edge + 1
        }
    }

    /// The corner of a half-edge's face that is not on the half-edge.
    #[inline]
    pub fn opposite(&self, half_edge: u32) -> u32 {
        self.faces[half_edge as usize / 3][(half_edge as usize + 2) % 3]
    }

    /// Whether the half-edge runs from the lower vertex of its edge to the higher.
    #[inline]
    pub fn runs_up(&self, half_edge: u32) -> bool {
        let [tail, head] = self.ends_of_half_edge(half_edge);
        tail < head
    }

    /// Asserts what the type promises; see [`HalfEdgeMesh::check`].
    ///
    /// # Panics
    ///
    /// When a promise is broken, naming it.
    pub fn sanity_check(&self) {
        if let Err(broken) = self.check() {
            panic!("{broken}");
        }
    }

    /// Tests what the type promises, whatever the lists hold: a mesh read from a file may be damaged.
    ///
    /// O(n) over half-edges, in parallel.
    ///
    /// # Errors
    ///
    /// The first promise that is broken, and the first number for which it is.
    pub fn check(&self) -> Result<(), BrokenHalfEdges> {
        self.check_lengths()?;
        all("positions are finite", self.positions.len(), |vertex| {
            self.positions[vertex].iter().all(|v| v.is_finite())
        })?;
        self.check_faces()?;
        self.check_edges()?;
        self.check_twins()?;
        self.check_degenerate_faces()?;
        self.check_polylines()
    }

    fn check_lengths(&self) -> Result<(), BrokenHalfEdges> {
        let (half_edges, edges) = (3 * self.faces.len(), self.edge_count());
        let never_filled = edges == 0 && self.edge_starts.is_empty();

        // Compare every list with what it holds one each of.
        for (promise, found, expected) in [
            (
                "a surface per face",
                self.face_surfaces.len(),
                self.faces.len(),
            ),
            ("a twin per half-edge", self.twins.len(), half_edges),
            ("an edge per half-edge", self.edge_of.len(), half_edges),
            (
                "every half-edge in one edge",
                self.edge_sides.len(),
                half_edges,
            ),
            ("two ends per edge", self.edge_ends.len(), edges),
            ("an angle per edge", self.dihedral_cos.len(), edges),
            (
                "an angle of normals per edge, or none at all",
                self.normals_cos.len(),
                if self.normals_cos.is_empty() {
                    0
                } else {
                    edges
                },
            ),
            (
                "a surface per polyline",
                self.polyline_surfaces.len(),
                self.polylines.len(),
            ),
            (
                "starts of edges",
                self.edge_starts.len() + usize::from(never_filled),
                edges + 1,
            ),
        ] {
            if found != expected {
                return Err(BrokenHalfEdges {
                    promise,
                    index: found,
                });
            }
        }
        Ok(())
    }

    fn check_faces(&self) -> Result<(), BrokenHalfEdges> {
        all("corners of a face exist", self.faces.len(), |face| {
            self.faces[face]
                .iter()
                .all(|&v| (v as usize) < self.positions.len())
        })?;
        all("corners of a face differ", self.faces.len(), |face| {
            let [a, b, c] = self.faces[face];
            a != b && b != c && c != a
        })?;
        all("surfaces of faces exist", self.faces.len(), |face| {
            (self.face_surfaces[face] as usize) < self.surfaces.len()
        })
    }

    fn check_polylines(&self) -> Result<(), BrokenHalfEdges> {
        all(
            "ends of a polyline exist and differ",
            self.polylines.len(),
            |polyline| {
                let [a, b] = self.polylines[polyline];
                a != b && (a.max(b) as usize) < self.positions.len()
            },
        )?;
        all(
            "surfaces of polylines exist",
            self.polylines.len(),
            |polyline| (self.polyline_surfaces[polyline] as usize) < self.surfaces.len(),
        )?;
        let (vertices, polylines) = (self.cards.vertices(), self.cards.polylines());
        all("lines of cards are the last ones", 1, |_| {
            self.cards.is_empty()
                || vertices.end == self.positions.len() && polylines.end == self.polylines.len()
        })?;
        all(
            "lines of cards run along points of theirs, and stand for faces",
            self.cards.polylines().len(),
            |index| {
                let polyline = polylines.start + index;
                let is_point = |end: &u32| self.cards.point(*end).is_some();
                let faces = self.cards.faces(polyline);
                let exist = faces.iter().all(|face| (*face as usize) < self.faces.len());
                self.polylines[polyline].iter().all(is_point) && !faces.is_empty() && exist
            },
        )
    }

    fn check_edges(&self) -> Result<(), BrokenHalfEdges> {
        // Test that the groups of half-edges cover all, and none is empty.
        let bounds = [self.edge_starts.first(), self.edge_starts.last()].map(|v| *v.unwrap_or(&0));
        if bounds != [0, self.edge_sides.len() as u32] {
            return Err(BrokenHalfEdges {
                promise: "edges cover all sides",
                index: 0,
            });
        }
        all("edges have sides", self.edge_count(), |edge| {
            self.edge_starts[edge] < self.edge_starts[edge + 1]
        })?;

        // Test that half-edges and edges name each other.
        all("sides exist", self.edge_sides.len(), |side| {
            (self.edge_sides[side] as usize) < self.edge_of.len()
        })?;
        all(
            "sides name their edge and share its ends",
            self.edge_count(),
            |edge| {
                let ends = self.ends(edge as u32);
                self.sides(edge as u32).iter().all(|&side| {
                    let [a, b] = self.ends_of_half_edge(side);
                    self.edge_of[side as usize] as usize == edge && [a.min(b), a.max(b)] == ends
                })
            },
        )?;
        all("sides of an edge differ", self.edge_count(), |edge| {
            let sides = self.sides(edge as u32);
            if let [] | [_] | [_, _] = sides {
                return sides.first() != sides.get(1);
            }
            let mut sorted = sides.to_vec();
            sorted.sort_unstable();
            sorted.windows(2).all(|pair| pair[0] < pair[1])
        })?;

        // Test what is kept of every edge.
        all("angles are cosines", self.edge_count(), |edge| {
            (-1.0..=1.0).contains(&self.dihedral_cos[edge])
        })?;
        all(
            "angles of normals are cosines",
            self.normals_cos.len(),
            |edge| (-1.0..=1.0).contains(&self.normals_cos[edge]),
        )?;
        all("traits say how faces meet", self.edge_count(), |edge| {
            self.traits_match(edge as u32)
        })
    }

    fn traits_match(&self, edge: u32) -> bool {
        let expected = match *self.sides(edge) {
            [_] => EdgeFlags::BOUNDARY,
            [a, b] if self.runs_up(a) == self.runs_up(b) => EdgeFlags::FLIPPED,
            [a, _] if !self.runs_up(a) => return false,
            [_, _] => EdgeFlags::NONE,
            _ => EdgeFlags::NON_MANIFOLD,
        };
        let meeting = EdgeFlags::BOUNDARY | EdgeFlags::FLIPPED | EdgeFlags::NON_MANIFOLD;
        self.edge_traits[edge as usize].among(meeting) == expected
    }

    fn check_twins(&self) -> Result<(), BrokenHalfEdges> {
        all(
            "twins come in pairs that run opposite ways",
            self.twins.len(),
            |half_edge| {
                let twin = self.twins[half_edge];
                if twin == NONE {
                    return true;
                }
                let [tail, head] = self.ends_of_half_edge(half_edge as u32);
                self.twins.get(twin as usize) == Some(&(half_edge as u32))
                    && self.ends_of_half_edge(twin) == [head, tail]
            },
        )
    }

    fn check_degenerate_faces(&self) -> Result<(), BrokenHalfEdges> {
        let faces = self.faces.len() as u32;
        let listed = |face: u32| {
            self.degenerate_faces
                .binary_search_by_key(&face, |&[s, _]| s)
                .is_ok()
        };

        // Test that they can be looked up by number.
        let ascending = self
            .degenerate_faces
            .windows(2)
            .position(|pair| pair[0][0] >= pair[1][0]);
        if let Some(index) = ascending {
            return Err(BrokenHalfEdges {
                promise: "degenerate_faces are ascending",
                index,
            });
        }

        // Test that each names a face that has area.
        all(
            "degenerate_faces and their stand-ins are faces",
            self.degenerate_faces.len(),
            |degenerate_face| {
                let [face, stand_in] = self.degenerate_faces[degenerate_face];
                face < faces && (stand_in == NONE || stand_in < faces && !listed(stand_in))
            },
        )
    }
}

/// A promise of [`HalfEdgeMesh`] that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the shape breaks a promise: {promise} (number {index})")]
pub struct BrokenHalfEdges {
    /// What should hold.
    pub promise: &'static str,
    /// The first face, half-edge, edge or list for which it does not; of a list, its length.
    pub index: usize,
}

/// Tests a promise for every number below `count`.
fn all(
    promise: &'static str,
    count: usize,
    holds: impl Fn(usize) -> bool + Sync,
) -> Result<(), BrokenHalfEdges> {
    // Whole runs at a time: asking after every number whether an earlier one failed would cost more than the test.
    const RUN: usize = 4096;
    let first_of_run = |run: usize| {
        let mut numbers = run * RUN..((run + 1) * RUN).min(count);
        numbers.find(|&index| !holds(index))
    };
    let broken = (0..count.div_ceil(RUN))
        .into_par_iter()
        .find_map_first(first_of_run);
    match broken {
        Some(index) => Err(BrokenHalfEdges { promise, index }),
        None => Ok(()),
    }
}
