//! Triangles as the reference sees them: welded, and nothing else prepared.

use std::collections::{HashMap, HashSet};

use glam::DVec3;
use npr_scene::{Node, Scene};

use super::viewpoint::wide;

/// Twice the area of a face, as a share of its longest edge squared, under which it counts as having none.
const FLAT: f64 = 1e-12;

/// Faces without area that may lie between one and the face it takes its facing from.
const HOPS: usize = 8;

/// Triangles of a whole scene in the world.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Soup {
    /// Welded positions.
    pub positions: Vec<DVec3>,
    /// Corners, counter-clockwise seen from outside where the file keeps to that; no two equal, no face twice in an
    /// object.
    pub faces: Vec<[u32; 3]>,
    /// A number for the material of each face.
    pub materials: Vec<u32>,
    /// Number of the object of each face: no edge has faces of two.
    pub objects: Vec<u32>,
}

/// An edge and its faces.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SoupEdge {
    /// The two vertices, the lower first.
    pub ends: [u32; 2],
    /// Its half-edges: `3 face + corner`, running from that corner to the next.
    pub sides: Vec<u32>,
}

impl Soup {
    /// The triangles of a scene in the pose of its file.
    ///
    /// Corners of one node are one vertex where their positions at rest are equal; the first stored one stands for all.
    pub fn of_scene(scene: &Scene) -> Self {
        let mut soup = Self::default();
        for node in &scene.nodes {
            soup.add_node(scene, node);
        }
        soup
    }

    /// Triangles that share vertices already, all of one material.
    pub fn of_mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let mut soup = Self {
            positions: positions.iter().copied().map(wide).collect(),
            ..Self::default()
        };
        soup.add_faces(triangles.iter().map(|corners| (*corners, 0)));
        soup
    }

    fn add_node(&mut self, scene: &Scene, node: &Node) {
        let Some(mesh) = node.mesh.map(|mesh| &scene.meshes[mesh as usize]) else {
            return;
        };
        let mirrored = is_mirrored(scene, node);
        let mut welded: HashMap<[u32; 3], u32> = HashMap::new();
        let mut faces = Vec::new();
        for part in &mesh.parts {
            let placed = scene.positions_world(node, part);
            let numbers: Vec<u32> = part
                .positions
                .iter()
                .zip(placed)
                .map(|(rest, world)| {
                    // Adding zero turns -0 into 0.
                    *welded
                        .entry(rest.map(|v| (v + 0.0).to_bits()))
                        .or_insert_with(|| {
                            self.positions.push(wide(world));
                            self.positions.len() as u32 - 1
                        })
                })
                .collect();
            let material = part.material.map_or(0, |material| material + 1);
            faces.extend(part.triangles.iter().map(|corners| {
                let [a, b, c] = corners.map(|corner| numbers[corner as usize]);
                (if mirrored { [a, c, b] } else { [a, b, c] }, material)
            }));
        }
        self.add_faces(faces.into_iter());
    }

    /// Adds the faces of one object, without those that are a line or a point and without repetitions.
    fn add_faces(&mut self, faces: impl Iterator<Item = ([u32; 3], u32)>) {
        let object = self.objects.last().map_or(0, |last| last + 1);
        let mut known = HashSet::new();
        for (corners, material) in faces {
            let mut sorted = corners;
            sorted.sort_unstable();
            let [a, b, c] = sorted;
            if a != b && b != c && known.insert(sorted) {
                self.faces.push(corners);
                self.materials.push(material);
                self.objects.push(object);
            }
        }
    }

    /// Positions of the corners of a face.
    pub fn corners(&self, face: usize) -> [DVec3; 3] {
        self.faces[face].map(|vertex| self.positions[vertex as usize])
    }

    /// The middle of the box around everything, and the distance to the furthest vertex; a unit ball of nothing.
    pub fn ball(&self) -> (DVec3, f64) {
        let used = || {
            self.faces
                .iter()
                .flatten()
                .map(|v| self.positions[*v as usize])
        };
        let low = used().fold(DVec3::INFINITY, DVec3::min);
        let high = used().fold(DVec3::NEG_INFINITY, DVec3::max);
        if low.x > high.x {
            return (DVec3::ZERO, 1.0);
        }
        let middle = (low + high) / 2.0;
        (
            middle,
            used().map(|p| p.distance(middle)).fold(0.0, f64::max),
        )
    }

    /// All edges, ordered by their ends; the sides of each by number.
    pub fn edges(&self) -> Vec<SoupEdge> {
        let mut sides: Vec<([u32; 2], u32)> = (0..3 * self.faces.len() as u32)
            .map(|half_edge| {
                let [a, b] = self.ends_of(half_edge);
                ([a.min(b), a.max(b)], half_edge)
            })
            .collect();
        sides.sort_unstable();
        sides
            .chunk_by(|a, b| a.0 == b.0)
            .map(|group| SoupEdge {
                ends: group[0].0,
                sides: group.iter().map(|side| side.1).collect(),
            })
            .collect()
    }

    /// Tail and head of a half-edge.
    pub fn ends_of(&self, half_edge: u32) -> [u32; 2] {
        let corners = self.faces[half_edge as usize / 3];
        let corner = half_edge as usize % 3;
        [corners[corner], corners[(corner + 1) % 3]]
    }

    /// The corner of a half-edge's face that is not on it.
    pub fn opposite(&self, half_edge: u32) -> DVec3 {
        let corner = self.faces[half_edge as usize / 3][(half_edge as usize + 2) % 3];
        self.positions[corner as usize]
    }

    /// Whether two half-edges of one edge run opposite ways, as those of faces that are wound alike do.
    pub fn wound_alike(&self, [a, b]: [u32; 2]) -> bool {
        self.ends_of(a) != self.ends_of(b)
    }

    /// The unit normal of every face; a face without area takes that of the next face with area across its longest
    /// edge.
    pub fn normals(&self, edges: &[SoupEdge]) -> Vec<DVec3> {
        let mut edge_of = vec![0; 3 * self.faces.len()];
        for (number, edge) in edges.iter().enumerate() {
            edge.sides
                .iter()
                .for_each(|side| edge_of[*side as usize] = number);
        }
        (0..self.faces.len())
            .map(|face| self.normal_across(face, edges, &edge_of))
            .collect()
    }

    fn normal_across(&self, mut face: usize, edges: &[SoupEdge], edge_of: &[usize]) -> DVec3 {
        let mut turned = 1.0;
        for _ in 0..HOPS {
            // Take the normal of a face that has area.
            let [a, b, c] = self.corners(face);
            let normal = (b - a).cross(c - a);
            let lengths = [
                a.distance_squared(b),
                b.distance_squared(c),
                c.distance_squared(a),
            ];
            let longest = (0..3).fold(
                0,
                |best, i| if lengths[i] > lengths[best] { i } else { best },
            );
            if normal.length() > FLAT * lengths[longest] {
                return turned * normal.normalize_or_zero();
            }

            // Go on across the longest edge, and note where the winding changes.
            let here = (3 * face + longest) as u32;
            let across = edges[edge_of[here as usize]]
                .sides
                .iter()
                .find(|side| **side != here);
            let Some(there) = across else { break };
            if !self.wound_alike([here, *there]) {
                turned = -turned;
            }
            face = *there as usize / 3;
        }
        DVec3::ZERO
    }
}

/// Whether a node turns shapes inside out.
fn is_mirrored(scene: &Scene, node: &Node) -> bool {
    let bent = node
        .skin
        .map(|skin| scene.world_from_rest(&scene.skins[skin as usize]));
    let matrix = bent
        .and_then(|matrices| matrices.first().copied())
        .unwrap_or(node.world_from_node);
    glam::Mat4::from_cols_array_2d(&matrix).determinant() < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_mesh::testing::{cube, uv_sphere};

    #[test]
    fn edges_of_closed_surfaces_have_two_sides_and_euler_holds() {
        for mesh in [cube(), uv_sphere(12, 7)] {
            let soup = Soup::of_mesh(mesh.positions(), mesh.triangles());
            let edges = soup.edges();
            assert!(edges.iter().all(|edge| edge.sides.len() == 2));
            assert_eq!(soup.positions.len() + soup.faces.len(), edges.len() + 2);
        }
    }

    #[test]
    fn a_face_without_area_takes_the_normal_across_its_longest_edge() {
        let positions = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
        ];
        let soup = Soup::of_mesh(&positions, &[[0, 1, 3], [1, 0, 2]]);
        let normals = soup.normals(&soup.edges());
        assert_eq!(normals, [DVec3::Z, DVec3::Z]);
    }

    #[test]
    fn lines_points_and_repetitions_are_no_faces() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let soup = Soup::of_mesh(&positions, &[[0, 1, 2], [2, 1, 0], [0, 0, 1], [1, 2, 0]]);
        assert_eq!(soup.faces, [[0, 1, 2]]);
    }
}
