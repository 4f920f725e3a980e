//! The points that carry a direction: one per smooth wedge of faces around each welded position.

use glam::{DVec3, Vec3};
use npr_core::geometry::Triangle;
use rayon::prelude::*;

use crate::half_edge_groups::Sides;
use crate::normals::smooth_normals;
use crate::union_find::UnionFind;
use crate::weld::{Weld, weld};

/// Faces around one edge above which all of them are left apart; pairing them takes the square of it.
const CROWD: usize = 64;

/// A surface cut open along creases, borders of parts and wherever its winding turns.
///
/// Nodes are numbered along a curve through space, not in the order of the file: neighbours lie close together in
/// memory, and the result does not depend on how the mesh was stored.
#[derive(Debug, Default)]
pub(crate) struct Nodes {
    pub(crate) positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub(crate) normals: Vec<Vec3>,
    /// The part of each node.
    pub(crate) parts: Vec<u32>,
    /// Numbers of the triangles that have an area.
    pub(crate) faces: Vec<u32>,
    /// The nodes of those.
    pub(crate) corners: Vec<[u32; 3]>,
    /// Where the neighbours of each node start; one more than there are nodes.
    pub(crate) starts: Vec<u32>,
    /// Neighbours along edges, ascending for each node.
    pub(crate) neighbours: Vec<u32>,
}

impl Nodes {
    /// Splits `triangles` where their planes differ by an angle with a cosine under `crease_cos`.
    ///
    /// Triangles without area, or with a position that is not finite, have no nodes.
    pub(crate) fn new(positions: &[[f32; 3]], triangles: &[Triangle], crease_cos: f32) -> Self {
        // Cut the surface along its folds.
        let sheet = Sheet::new(positions, triangles);
        let mut wedges = sheet.join_wedges(crease_cos);
        let (first_corner, node_of_corner) = sheet.number(&mut wedges);
        let corners = node_of_corner.as_chunks().0.to_vec();
        let position_of = |&corner: &u32| positions[sheet.vertex(corner) as usize];

        // Place a node where a corner of every piece lies.
        let mut nodes = Self {
            positions: first_corner.iter().map(position_of).collect(),
            parts: first_corner
                .iter()
                .map(|&corner| sheet.parts[corner as usize / 3])
                .collect(),
            faces: sheet.faces,
            corners,
            ..Self::default()
        };

        // Link neighbours, with a normal of each piece alone.
        let normals = smooth_normals(&nodes.positions, &nodes.corners, &nodes.apart());
        nodes.normals = normals.into_iter().map(Vec3::from_array).collect();
        nodes.link();
        nodes
    }

    /// Number of nodes.
    pub(crate) fn count(&self) -> usize {
        self.positions.len()
    }

    /// Says that every node is a point of its own, to functions that ask.
    pub(crate) fn apart(&self) -> Weld {
        let all: Vec<u32> = (0..self.count() as u32).collect();
        Weld {
            of_vertex: all.clone(),
            first: all,
        }
    }

    pub(crate) fn neighbours_of(&self, node: usize) -> &[u32] {
        &self.neighbours[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    /// Lists the neighbours along every edge, once each.
    fn link(&mut self) {
        let sides = Sides::of_faces(&self.corners, self.count());
        let ends = |half_edge: u32| {
            let [face, i] = [half_edge / 3, half_edge % 3].map(|v| v as usize);
            let [a, b] = [self.corners[face][i], self.corners[face][(i + 1) % 3]];
            [a.min(b), a.max(b)]
        };
        let edge_count = sides.starts.len() - 1;
        let edges: Vec<[u32; 2]> = (0..edge_count)
            .map(|edge| ends(sides.half_edges[sides.starts[edge] as usize]))
            .collect();
        let mut ends = vec![0u32; self.count() + 1];
        for &end in edges.as_flattened() {
            ends[end as usize + 1] += 1;
        }
        for node in 0..self.count() {
            ends[node + 1] += ends[node];
        }
        self.starts.clone_from(&ends);
        self.neighbours = vec![0; 2 * edge_count];
        // Edges ascend, so that first the lower, then the higher neighbours come in ascending order.
        for higher in [false, true] {
            for &[low, high] in &edges {
                let [node, other] = if higher { [low, high] } else { [high, low] };
                self.neighbours[ends[node as usize] as usize] = other;
                ends[node as usize] += 1;
            }
        }
    }
}

/// The faces that have an area, over welded positions.
struct Sheet {
    faces: Vec<u32>,
    parts: Vec<u32>,
    normals: Vec<DVec3>,
    /// Stored vertices of every face.
    stored: Vec<[u32; 3]>,
    /// Welded vertices of every face.
    welded: Vec<[u32; 3]>,
    weld: Weld,
    /// Where each welded vertex lies along a curve that fills the bounding box.
    keys: Vec<u64>,
}

impl Sheet {
    fn new(positions: &[[f32; 3]], triangles: &[Triangle]) -> Self {
        let weld = weld(positions, 0.0);
        let normal = |face: u32| {
            let indices = triangles[face as usize].corners;
            let normal = crate::triangle::Triangle::new(positions, indices).normal()?;
            Some((face, normal))
        };
        let (faces, normals): (Vec<u32>, Vec<DVec3>) = (0..triangles.len() as u32)
            .into_par_iter()
            .filter_map(normal)
            .unzip();
        let of_face = |face: &u32| triangles[*face as usize];
        let stored: Vec<[u32; 3]> = faces.iter().map(|f| of_face(f).corners).collect();
        let welded = stored
            .iter()
            .map(|&corners| weld.corners(corners))
            .collect();
        Self {
            parts: faces.iter().map(|face| of_face(face).part).collect(),
            keys: curve_keys(positions, &stored, &weld),
            faces,
            normals,
            stored,
            welded,
            weld,
        }
    }

    fn vertex(&self, corner: u32) -> u32 {
        self.stored[corner as usize / 3][corner as usize % 3]
    }

    /// Unites the corners on both sides of every edge across which the surface goes on smoothly.
    fn join_wedges(&self, crease_cos: f32) -> UnionFind {
        let sides = Sides::of_faces(&self.welded, self.weld.count());
        let mut wedges = UnionFind::new(3 * self.faces.len());
        let next = |h: u32| if h % 3 == 2 { h - 2 } else { h + 1 };
        for bounds in sides.starts.windows(2) {
            let around = &sides.half_edges[bounds[0] as usize..bounds[1] as usize];
            if around.len() > CROWD {
                continue;
            }
            for &side in around {
                if let Some(mate) = self.mate(side, around, crease_cos) {
                    wedges.unite(side, next(mate));
                    wedges.unite(next(side), mate);
                }
            }
        }
        wedges
    }

    /// Of the half-edges that run against `side`, the one whose face continues its plane best.
    fn mate(&self, side: u32, around: &[u32], crease_cos: f32) -> Option<u32> {
        let tail = |h: u32| self.welded[h as usize / 3][h as usize % 3];
        let face = |h: u32| h as usize / 3;
        let cos = |h: u32| self.normals[face(h)].dot(self.normals[face(side)]);
        let mut best = (f64::from(crease_cos), None);
        for &other in around.iter().filter(|&&h| tail(h) != tail(side)) {
            let same_part = self.parts[face(other)] == self.parts[face(side)];
            if same_part && cos(other) >= best.0 && (best.1.is_none() || cos(other) > best.0) {
                best = (cos(other), Some(other));
            }
        }
        best.1
    }

    /// A number that depends on where a face lies alone.
    fn code(&self, face: u32) -> u64 {
        let corners = self.welded[face as usize].iter();
        corners.fold(0, |sum: u64, &welded| {
            sum.wrapping_add(self.keys[welded as usize].wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 2)
        })
    }

    /// Numbers wedges along the curve: a corner of each node, and the node of every corner.
    fn number(&self, wedges: &mut UnionFind) -> (Vec<u32>, Vec<u32>) {
        let corner_count = 3 * self.faces.len() as u32;
        let root_of_corner: Vec<u32> = (0..corner_count).map(|c| wedges.find(c)).collect();
        // Sectors at one position are told apart by the least code of their faces.
        let mut least = vec![u64::MAX; corner_count as usize];
        for (&root, corner) in root_of_corner.iter().zip(0..) {
            let code = &mut least[root as usize];
            *code = self.code(corner / 3).min(*code);
        }
        let key = |corner: u32| {
            let welded = self.welded[corner as usize / 3][corner as usize % 3];
            let key = self.keys[welded as usize];
            (key, least[corner as usize], corner)
        };
        let mut order: Vec<(u64, u64, u32)> = (0..corner_count)
            .filter(|&corner| root_of_corner[corner as usize] == corner)
            .map(key)
            .collect();
        order.par_sort_unstable();
        let mut node_of_root = vec![0; corner_count as usize];
        for (&(_, _, root), node) in order.iter().zip(0u32..) {
            node_of_root[root as usize] = node;
        }
        let node_of_corner = root_of_corner
            .iter()
            .map(|&root| node_of_root[root as usize])
            .collect();
        (
            order.iter().map(|&(_, _, root)| root).collect(),
            node_of_corner,
        )
    }
}

/// Where the welded vertices of `faces` lie along Morton's curve through their bounding box.
fn curve_keys(positions: &[[f32; 3]], faces: &[[u32; 3]], weld: &Weld) -> Vec<u64> {
    let place = |&vertex: &u32| DVec3::from_array(positions[vertex as usize].map(f64::from));
    let used = faces.as_flattened().iter().map(place);
    let (low, high) = used.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
        (low.min(p), high.max(p))
    });
    let scale = f64::from((1u32 << 21) - 1) / (high - low).max_element().max(f64::MIN_POSITIVE);
    weld.first
        .par_iter()
        .map(|vertex| {
            let steps = (place(vertex) - low) * scale;
            spread(steps.x as u64) << 2 | spread(steps.y as u64) << 1 | spread(steps.z as u64)
        })
        .collect()
}

/// Two zero bits between any two of the lower 21 bits.
fn spread(bits: u64) -> u64 {
    let bits = bits & 0x1f_ffff;
    let bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
    let bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
    let bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
    let bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::testing::{cube, fan, icosphere, moebius_strip, random_soup, torus, with_doubles};
    use proptest::prelude::*;

    fn nodes_of(mesh: &Mesh, crease_cos: f32) -> Nodes {
        let triangle = |&corners: &[u32; 3]| Triangle { corners, part: 0 };
        let triangles: Vec<Triangle> = mesh.triangles().iter().map(triangle).collect();
        let nodes = Nodes::new(mesh.positions(), &triangles, crease_cos);
        sanity_check(&nodes);
        nodes
    }

    /// Checks what later steps rely on.
    fn sanity_check(nodes: &Nodes) {
        assert_eq!(nodes.starts.len(), nodes.count() + 1);
        for node in 0..nodes.count() {
            let neighbours = nodes.neighbours_of(node);
            assert!(neighbours.is_sorted_by(|a, b| a < b), "node {node}");
            for &other in neighbours {
                assert!(nodes.neighbours_of(other as usize).contains(&(node as u32)));
            }
        }
        for &[a, b, c] in &nodes.corners {
            assert!(nodes.neighbours_of(a as usize).contains(&b));
            assert!(nodes.neighbours_of(b as usize).contains(&c));
            assert!(nodes.neighbours_of(c as usize).contains(&a));
        }
    }

    #[test]
    fn a_cube_has_four_nodes_on_each_face() {
        let nodes = nodes_of(&cube(), 0.7);
        assert_eq!((nodes.count(), nodes.faces.len()), (24, 12));
        assert_eq!(nodes.neighbours.len(), 6 * 2 * 5);
    }

    #[test]
    fn smooth_surfaces_have_a_node_for_each_position() {
        for mesh in [icosphere(3), torus(20, 12, 1.0, 0.4)] {
            assert_eq!(nodes_of(&mesh, 0.7).count(), mesh.positions().len());
        }
    }

    #[test]
    fn a_turn_of_the_winding_and_pages_of_a_book_cut_the_surface() {
        let strip = moebius_strip(20);
        assert_eq!(nodes_of(&strip, 0.5).count(), strip.positions().len() + 2);
        let book = nodes_of(&fan(7), 0.99);
        assert_eq!(book.count(), 21);
    }

    #[test]
    fn both_sides_of_a_sheet_stored_twice_are_smooth() {
        let sphere = icosphere(2);
        let mut triangles = sphere.triangles().to_vec();
        triangles.extend(sphere.triangles().iter().map(|&[a, b, c]| [a, c, b]));
        let both = Mesh::new(sphere.positions().to_vec(), triangles).unwrap();
        assert_eq!(nodes_of(&both, 0.7).count(), 2 * sphere.positions().len());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn any_soup_gives_sound_nodes(seed: u64, faces in 0usize..40, crease_cos in -1.0f32..1.0) {
            nodes_of(&with_doubles(&random_soup(faces, seed), seed), crease_cos);
        }
    }
}
