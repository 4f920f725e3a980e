//! The edges of the surface and the faces beside each.

use glam::DVec3;
use npr_core::edge_flags::EdgeFlags;
use rayon::prelude::*;

use crate::triangle::{Triangle, point};
use crate::weld::Weld;

/// Stands for the missing second face of a boundary edge.
pub const NO_FACE: u32 = u32::MAX;

/// An edge with a pair of faces that meet there.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Edge {
    /// Stored vertices at both ends, ascending; each is the first of its welded vertex.
    pub ends: [u32; 2],
    /// The faces beside the edge; the second is [`NO_FACE`] at a boundary.
    ///
    /// The first runs from `ends[0]` to `ends[1]` where either does; else the edge is
    /// [`BACKWARD`](EdgeFlags::BACKWARD). Faces that run the same way are in ascending order.
    pub faces: [u32; 2],
    /// Cosine of the angle between the face normals, 1 where the surface is flat and at boundaries.
    ///
    /// Faces wound in opposite senses are compared as if they were wound alike.
    pub dihedral_cos: f32,
    /// What is special about the edge.
    pub flags: EdgeFlags,
}

impl Edge {
    /// Whether the surface passes smoothly across: two faces, wound alike, whose normals differ by no
    /// more than the angle with the cosine `crease_cos`.
    pub fn is_smooth(&self, crease_cos: f32) -> bool {
        let split = EdgeFlags::BOUNDARY | EdgeFlags::NON_MANIFOLD | EdgeFlags::FLIPPED;
        !self.flags.intersects(split) && self.dihedral_cos >= crease_cos
    }
}

/// Lists every edge of the welded surface, sorted by its ends.
///
/// `materials` holds one material id per triangle; where it is empty, all are the same.
///
/// Faces without area, or with two corners that weld, have no edges; they keep their number. So has a
/// face with the same three welded corners as an earlier one, whatever its winding: sheets that are
/// stored twice, once per side, are drawn as one.
///
/// Where three or more faces meet, the edge is listed once per neighbouring pair in a ring through all
/// of them. If any two of them face the viewer differently, so do two neighbours in the ring, hence no
/// contour is lost, and `n` faces make `n` edges.
///
/// Sorting, O(n log n); 16 bytes of scratch per corner.
///
/// # Panics
///
/// If a triangle names a vertex that does not exist; [`Mesh::new`](crate::Mesh::new) refuses those.
pub fn unique_edges(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    weld: &Weld,
    materials: &[u32],
) -> Vec<Edge> {
    let surface = Surface {
        positions,
        triangles,
        weld,
        materials,
        normals: triangles
            .par_iter()
            .map(|&triangle| Triangle::new(positions, triangle).normal())
            .collect(),
    };
    let mut sides = surface.sides();
    sides.par_sort_unstable();
    // The same edge and opposite corner means the same triangle.
    sides.dedup_by_key(|side| (side.edge(), side.opposite()));
    sides
        .par_chunk_by(|a, b| a.edge() == b.edge())
        .flat_map_iter(|ring| surface.edges_of(ring))
        .collect()
}

/// A face seen from one of its edges.
///
/// From the top: the lower and the higher welded vertex of the edge, the corner opposite, and the face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side(u128);

impl Side {
    fn new([a, b, opposite]: [u32; 3], face: u32) -> Self {
        let [low, high, opposite, face] = [a.min(b), a.max(b), opposite, face].map(u128::from);
        Self(low << 96 | high << 64 | opposite << 32 | face)
    }

    fn edge(self) -> u64 {
        (self.0 >> 64) as u64
    }

    fn ends(self) -> [u32; 2] {
        [(self.0 >> 96) as u32, (self.0 >> 64) as u32]
    }

    fn opposite(self) -> u32 {
        (self.0 >> 32) as u32
    }

    fn face(self) -> u32 {
        self.0 as u32
    }
}

/// What [`unique_edges`] was given.
struct Surface<'a> {
    positions: &'a [[f32; 3]],
    triangles: &'a [[u32; 3]],
    weld: &'a Weld,
    materials: &'a [u32],
    /// Of every face; none for those without area.
    normals: Vec<Option<DVec3>>,
}

impl Surface<'_> {
    fn sides(&self) -> Vec<Side> {
        (0..self.triangles.len() as u32)
            .into_par_iter()
            .filter(|&face| self.has_edges(face))
            .flat_map_iter(|face| {
                let [a, b, c] = self.corners(face);
                [[a, b, c], [b, c, a], [c, a, b]].map(|corners| Side::new(corners, face))
            })
            .collect()
    }

    fn corners(&self, face: u32) -> [u32; 3] {
        self.weld.corners(self.triangles[face as usize])
    }

    fn has_edges(&self, face: u32) -> bool {
        let [a, b, c] = self.corners(face);
        a != b && b != c && c != a && self.normals[face as usize].is_some()
    }

    /// The edges between the faces around one pair of ends.
    fn edges_of<'a>(&'a self, ring: &'a [Side]) -> impl Iterator<Item = Edge> + 'a {
        let edge_count = if ring.len() < 3 { 1 } else { ring.len() };
        (0..edge_count).map(move |i| match *ring {
            [only] => self.boundary(only),
            [first, second] => self.shared(first, second, EdgeFlags::NONE),
            _ => self.shared(ring[i], ring[(i + 1) % ring.len()], EdgeFlags::NON_MANIFOLD),
        })
    }

    fn boundary(&self, side: Side) -> Edge {
        Edge {
            ends: self.stored_ends(side),
            faces: [side.face(), NO_FACE],
            dihedral_cos: 1.0,
            flags: EdgeFlags::BOUNDARY | EdgeFlags::BACKWARD.when(!self.runs_forward(side)),
        }
    }

    fn shared(&self, one: Side, other: Side, known: EdgeFlags) -> Edge {
        // Put the face that runs forward first; among equals, the lower number.
        let order = |side: Side| (!self.runs_forward(side), side.face());
        let (left, right) = if order(one) < order(other) {
            (one, other)
        } else {
            (other, one)
        };
        let flipped = self.runs_forward(left) == self.runs_forward(right);
        let material = |side: Side| self.materials.get(side.face() as usize);
        let manifold = known == EdgeFlags::NONE;
        Edge {
            ends: self.stored_ends(left),
            faces: [left.face(), right.face()],
            dihedral_cos: self.dihedral_cos(left.face(), right.face(), flipped),
            flags: known
                | EdgeFlags::MATERIAL.when(material(left) != material(right))
                | EdgeFlags::FLIPPED.when(flipped)
                | EdgeFlags::BACKWARD.when(!self.runs_forward(left))
                | EdgeFlags::CONCAVE.when(manifold && !flipped && self.rises(left, right)),
        }
    }

    fn stored_ends(&self, side: Side) -> [u32; 2] {
        side.ends().map(|welded| self.weld.first[welded as usize])
    }

    /// Whether the face passes the lower end of the edge right before the higher one.
    fn runs_forward(&self, side: Side) -> bool {
        let [low, high] = side.ends();
        let [a, b, c] = self.corners(side.face());
        [[a, b], [b, c], [c, a]].contains(&[low, high])
    }

    fn dihedral_cos(&self, left: u32, right: u32, flipped: bool) -> f32 {
        let normal = |face: u32| self.normals[face as usize].unwrap_or_default();
        let cos = normal(left).dot(normal(right)).clamp(-1.0, 1.0) as f32;
        if flipped { -cos } else { cos }
    }

    /// Whether the right face leaves the plane of the left one towards its front.
    fn rises(&self, left: Side, right: Side) -> bool {
        let triangle = Triangle::new(self.positions, self.triangles[left.face() as usize]);
        let tip = point(self.positions, self.weld.first[right.opposite() as usize]);
        triangle.cross().dot(tip - triangle.corners[0]) > 0.0
    }
}

/// Checks what [`unique_edges`] promises of its own result.
///
/// # Panics
///
/// If a promise is broken; the message names it and the edge.
pub fn sanity_check(edges: &[Edge], triangles: &[[u32; 3]], weld: &Weld) {
    for edge in edges {
        check_edge(edge, triangles, weld);
    }
    for pair in edges.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        assert!(
            a.ends <= b.ends,
            "edges are out of order: {a:?} before {b:?}"
        );
        let alone = a.ends != b.ends || a.flags.contains(EdgeFlags::NON_MANIFOLD);
        assert!(
            alone,
            "an edge is listed twice but counts as manifold: {a:?}"
        );
    }
}

fn check_edge(edge: &Edge, triangles: &[[u32; 3]], weld: &Weld) {
    // Test that its ends stand for welded vertices.
    let ends = edge.ends.map(|end| weld.of_vertex[end as usize]);
    assert!(
        edge.ends[0] < edge.ends[1],
        "ends are not ascending: {edge:?}"
    );
    assert!(
        (-1.0..=1.0).contains(&edge.dihedral_cos),
        "no such cosine: {edge:?}"
    );
    for (end, welded) in edge.ends.iter().zip(ends) {
        assert_eq!(
            *end, weld.first[welded as usize],
            "an end stands for no welded vertex: {edge:?}"
        );
    }

    // Test that its faces are there and meet it.
    let is_boundary = edge.flags.contains(EdgeFlags::BOUNDARY);
    assert_eq!(
        is_boundary,
        edge.faces[1] == NO_FACE,
        "only boundaries lack a face: {edge:?}"
    );
    for &face in edge.faces.iter().take(if is_boundary { 1 } else { 2 }) {
        let corners = weld.corners(triangles[face as usize]);
        assert!(
            ends.iter().all(|end| corners.contains(end)),
            "face {face} misses the edge: {edge:?}"
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::testing::{
        cube, fan, icosphere, moebius_strip, plane, random_soup, random_winding, shuffled_vertices,
        torus, unindexed, uv_sphere, with_doubles,
    };
    use crate::weld::weld;
    use proptest::prelude::*;
    use std::collections::{BTreeMap, BTreeSet};

    fn edges_of(mesh: &Mesh) -> (Vec<Edge>, Weld) {
        let weld = weld(mesh.positions(), 0.0);
        let edges = unique_edges(mesh.positions(), mesh.triangles(), &weld, &[]);
        sanity_check(&edges, mesh.triangles(), &weld);
        (edges, weld)
    }

    fn count(edges: &[Edge], flags: EdgeFlags) -> usize {
        edges
            .iter()
            .filter(|edge| edge.flags.contains(flags))
            .count()
    }

    /// Vertices - edges + faces.
    fn euler_characteristic(mesh: &Mesh) -> i64 {
        let (edges, weld) = edges_of(mesh);
        weld.count() as i64 - edges.len() as i64 + mesh.triangles().len() as i64
    }

    /// The distinct faces around every pair of welded vertices, by trying all pairs of corners.
    fn faces_by_ends(mesh: &Mesh, weld: &Weld) -> BTreeMap<[u32; 2], Vec<u32>> {
        let mut seen = BTreeSet::new();
        let mut faces = BTreeMap::<_, Vec<u32>>::new();
        for (face, &triangle) in mesh.triangles().iter().enumerate() {
            let mut corners = weld.corners(triangle);
            corners.sort();
            let area = Triangle::new(mesh.positions(), triangle).cross().length();
            if area == 0.0 || !seen.insert(corners) {
                continue;
            }
            for [a, b] in [[0, 1], [0, 2], [1, 2]] {
                let ends = [corners[a], corners[b]].map(|welded| weld.first[welded as usize]);
                faces.entry(ends).or_default().push(face as u32);
            }
        }
        faces
    }

    #[test]
    fn nothing_has_no_edges() {
        assert!(edges_of(&Mesh::default()).0.is_empty());
    }

    #[test]
    fn a_cube_has_twelve_square_edges_and_six_flat_ones() {
        let (edges, _) = edges_of(&cube());
        assert_eq!(edges.len(), 18);
        assert_eq!(
            edges.iter().filter(|edge| edge.dihedral_cos == 0.0).count(),
            12
        );
        assert_eq!(
            edges.iter().filter(|edge| edge.dihedral_cos == 1.0).count(),
            6
        );
        assert!(edges.iter().all(|edge| edge.flags == EdgeFlags::NONE));
    }

    #[test]
    fn closed_surfaces_have_the_right_euler_characteristic() {
        assert_eq!(euler_characteristic(&cube()), 2);
        assert_eq!(euler_characteristic(&uv_sphere(16, 9)), 2);
        assert_eq!(euler_characteristic(&icosphere(3)), 2);
        assert_eq!(euler_characteristic(&torus(24, 12, 1.0, 0.4)), 0);
        assert_eq!(
            euler_characteristic(&unindexed(&torus(24, 12, 1.0, 0.4))),
            0
        );
    }

    #[test]
    fn a_plane_has_a_border_all_round() {
        let (edges, _) = edges_of(&plane(5, 3));
        assert_eq!(count(&edges, EdgeFlags::BOUNDARY), 2 * (5 + 3));
    }

    #[test]
    fn a_moebius_strip_flips_once_and_has_one_border() {
        let (edges, _) = edges_of(&moebius_strip(40));
        assert_eq!(count(&edges, EdgeFlags::BOUNDARY), 80);
        assert_eq!(count(&edges, EdgeFlags::FLIPPED), 1);
        let sharpest = edges
            .iter()
            .map(|edge| edge.dihedral_cos)
            .fold(1.0, f32::min);
        assert!(sharpest > 0.85, "{sharpest}");
    }

    #[test]
    fn a_fan_lists_its_hub_once_per_face() {
        let (edges, _) = edges_of(&fan(5));
        assert_eq!(count(&edges, EdgeFlags::NON_MANIFOLD), 5);
        let mut faces: Vec<u32> = edges
            .iter()
            .filter(|e| e.flags.contains(EdgeFlags::NON_MANIFOLD))
            .flat_map(|e| e.faces)
            .collect();
        faces.sort();
        assert_eq!(
            faces,
            [0, 0, 1, 1, 2, 2, 3, 3, 4, 4],
            "every face has two neighbours in the ring"
        );
    }

    #[test]
    fn sheets_stored_once_per_side_count_once() {
        let sheet = plane(4, 4);
        let both: Vec<[u32; 3]> = sheet
            .triangles()
            .iter()
            .flat_map(|&[a, b, c]| [[a, b, c], [c, b, a]])
            .collect();
        let doubled = Mesh::new(sheet.positions().to_vec(), both).unwrap();
        let (once, twice) = (edges_of(&sheet).0, edges_of(&doubled).0);
        assert_eq!(once.len(), twice.len());
        assert_eq!(
            count(&twice, EdgeFlags::NON_MANIFOLD) + count(&twice, EdgeFlags::FLIPPED),
            0
        );
    }

    #[test]
    fn materials_mark_the_edges_between_them() {
        let sheet = plane(2, 1);
        let weld = weld(sheet.positions(), 0.0);
        let edges = unique_edges(sheet.positions(), sheet.triangles(), &weld, &[0, 0, 7, 7]);
        assert_eq!(count(&edges, EdgeFlags::MATERIAL), 1);
    }

    #[test]
    fn a_valley_is_concave_and_a_ridge_is_not() {
        let roof = |height: f32| {
            let positions = vec![
                [0.0, 0.0, height],
                [0.0, 1.0, height],
                [1.0, 0.5, 0.0],
                [-1.0, 0.5, 0.0],
            ];
            edges_of(&Mesh::new(positions, vec![[0, 2, 1], [0, 1, 3]]).unwrap()).0
        };
        assert_eq!(count(&roof(-1.0), EdgeFlags::CONCAVE), 1);
        assert_eq!(count(&roof(1.0), EdgeFlags::CONCAVE), 0);
        assert_eq!(count(&roof(0.0), EdgeFlags::CONCAVE), 0);
    }

    #[test]
    fn degenerate_faces_keep_the_numbering() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let mesh = Mesh::new(positions, vec![[0, 1, 2], [0, 0, 3], [0, 1, 3]]).unwrap();
        let (edges, _) = edges_of(&mesh);
        assert_eq!(edges.len(), 3);
        assert!(edges.iter().all(|edge| edge.faces == [2, NO_FACE]));
    }

    #[test]
    fn a_border_says_which_way_its_face_runs() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let (edges, _) = edges_of(&Mesh::new(positions, vec![[0, 1, 2]]).unwrap());
        let backward: Vec<[u32; 2]> = edges
            .iter()
            .filter(|e| e.flags.contains(EdgeFlags::BACKWARD))
            .map(|e| e.ends)
            .collect();
        assert_eq!(backward, [[0, 2]]);
    }

    proptest! {
        #[test]
        fn agrees_with_trying_all_pairs(seed: u64, faces in 0usize..60) {
            let mesh = with_doubles(&random_soup(faces, seed), seed);
            let (edges, weld) = edges_of(&mesh);
            let mut found = BTreeMap::<_, BTreeSet<u32>>::new();
            for edge in &edges {
                found.entry(edge.ends).or_default().extend(edge.faces.iter().filter(|&&f| f != NO_FACE));
            }
            let expected = faces_by_ends(&mesh, &weld);
            let listed = |ends: &[u32; 2]| edges.iter().filter(|edge| edge.ends == *ends).count();
            for (ends, faces) in &expected {
                let times = if faces.len() < 3 { 1 } else { faces.len() };
                prop_assert_eq!(listed(ends), times);
            }
            let found: BTreeMap<_, Vec<u32>> =
                found.into_iter().map(|(ends, faces)| (ends, faces.into_iter().collect())).collect();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn any_facing_keeps_its_contour(seed: u64, facing: u64) {
            let mesh = random_soup(40, seed);
            let (edges, weld) = edges_of(&mesh);
            let faces_front = |face: u32| facing >> (face % 64) & 1 == 1;
            let contour: BTreeSet<[u32; 2]> = edges
                .iter()
                .filter(|e| e.faces[1] != NO_FACE && faces_front(e.faces[0]) != faces_front(e.faces[1]))
                .map(|e| e.ends)
                .collect();
            for (ends, faces) in faces_by_ends(&mesh, &weld) {
                let mixed = faces.iter().any(|&face| faces_front(face) != faces_front(faces[0]));
                prop_assert_eq!(mixed, contour.contains(&ends));
            }
        }

        #[test]
        fn order_of_vertices_does_not_matter(seed: u64) {
            let mesh = random_soup(30, seed);
            let (mixed, moved_to) = shuffled_vertices(&mesh, seed);
            let ((before, weld), (after, mixed_weld)) = (edges_of(&mesh), edges_of(&mixed));
            let first = |weld: &Weld, vertex: u32| weld.first[weld.of_vertex[vertex as usize] as usize];
            let moved = |end: u32| first(&mixed_weld, moved_to[first(&weld, end) as usize]);
            let mut expected: Vec<[u32; 2]> = before.iter().map(|e| e.ends.map(moved)).collect();
            expected.iter_mut().for_each(|ends| ends.sort());
            expected.sort();
            prop_assert_eq!(expected, after.iter().map(|e| e.ends).collect::<Vec<_>>());
        }

        #[test]
        fn winding_changes_flags_but_not_angles(seed: u64) {
            let mesh = icosphere(1);
            let (before, after) = (edges_of(&mesh).0, edges_of(&random_winding(&mesh, seed)).0);
            prop_assert_eq!(before.len(), after.len());
            for (a, b) in before.iter().zip(&after) {
                prop_assert_eq!(a.ends, b.ends);
                prop_assert!((a.dihedral_cos - b.dihedral_cos).abs() < 1e-6);
            }
        }

        #[test]
        fn a_mirror_image_has_the_same_edges(seed: u64) {
            let mesh = random_soup(30, seed);
            let mirrored = crate::testing::mirrored(&mesh);
            let (before, after) = (edges_of(&mesh).0, edges_of(&mirrored).0);
            let of_edge = |e: &Edge| (e.ends, e.faces.iter().min().copied(), (e.dihedral_cos + 0.0).to_bits());
            let outline = |edges: &[Edge]| edges.iter().map(of_edge).collect::<BTreeSet<_>>();
            prop_assert_eq!(outline(&before), outline(&after));
        }
    }
}
