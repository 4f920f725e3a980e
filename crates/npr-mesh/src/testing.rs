//! Meshes made on the spot, for tests, fuzzing and benches.
//!
//! Closed shapes are wound counter-clockwise seen from outside and share their vertices.

use std::collections::BTreeMap;
use std::f32::consts::{PI, TAU};

use crate::half_edge::{HalfEdgeMesh, Surface};
use npr_core::math::{cos, sin};

use crate::mesh::Mesh;
use crate::shape::{PlacedMesh, add_mesh};

/// A small random generator with a fixed sequence for every seed [Steele et al. 2014, SplitMix64].
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// A generator started from `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A whole number below `bound`, which is at least 1.
    pub fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    /// A number from 0 up to, but not including, 1.
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1 << 24) as f32
    }

    /// Puts `items` into random order.
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}

/// The cube from -1 to 1: 8 vertices, 12 triangles.
pub fn cube() -> Mesh {
    let bit = |vertex: u32, axis: u32| if vertex >> axis & 1 == 1 { 1.0 } else { -1.0 };
    let positions = (0..8).map(|v| [bit(v, 0), bit(v, 1), bit(v, 2)]).collect();
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Mesh::of_sound_parts(positions, quads.into_iter().flat_map(halves).collect())
}

/// A unit sphere of meridians and parallels: single vertices at the poles on the z axis.
///
/// `meridians` at least 3, `parallels` (bands from pole to pole) at least 2.
pub fn uv_sphere(meridians: u32, parallels: u32) -> Mesh {
    let mut positions = Vec::new();
    for band in 1..parallels {
        let polar = PI * band as f32 / parallels as f32;
        positions
            .extend(circle(meridians).map(|[x, y]| [x * sin(polar), y * sin(polar), cos(polar)]));
    }
    let mut triangles = bands(meridians, parallels - 2);
    triangles.iter_mut().for_each(|triangle| triangle.reverse());
    close(&mut positions, &mut triangles, meridians, [1.0, -1.0]);
    Mesh::of_sound_parts(positions, triangles)
}

/// A cylinder of radius 1 from z = -1 to 1 with flat caps; `around` at least 3, `band_count` at least 1.
pub fn cylinder(around: u32, band_count: u32) -> Mesh {
    let mut positions = Vec::new();
    for ring in 0..=band_count {
        let z = 1.0 - 2.0 * ring as f32 / band_count as f32;
        positions.extend(circle(around).map(|[x, y]| [x, y, z]));
    }
    let mut triangles = bands(around, band_count);
    triangles.iter_mut().for_each(|triangle| triangle.reverse());
    close(&mut positions, &mut triangles, around, [1.0, -1.0]);
    Mesh::of_sound_parts(positions, triangles)
}

/// A torus about the z axis: `ring` steps at radius `ring_radius`, `tube` steps at `tube_radius`.
///
/// Vertex `i * tube + j` lies at ring angle `i` and tube angle `j`, the latter from the outside up.
pub fn torus(ring: u32, tube: u32, ring_radius: f32, tube_radius: f32) -> Mesh {
    let positions = circle(ring)
        .flat_map(|[x, y]| {
            circle(tube).map(move |[out, up]| {
                let radius = ring_radius + tube_radius * out;
                [radius * x, radius * y, tube_radius * up]
            })
        })
        .collect();
    let vertex = |i: u32, j: u32| (i % ring) * tube + j % tube;
    let quads = grid(ring, tube).map(|[i, j]| {
        [
            vertex(i, j),
            vertex(i + 1, j),
            vertex(i + 1, j + 1),
            vertex(i, j + 1),
        ]
    });
    Mesh::of_sound_parts(positions, quads.flat_map(halves).collect())
}

/// The unit square in z = 0, cut into `columns` by `rows` cells that face +z.
pub fn plane(columns: u32, rows: u32) -> Mesh {
    let position = |[i, j]: [u32; 2]| [i as f32 / columns as f32, j as f32 / rows as f32, 0.0];
    let vertex = |i: u32, j: u32| i * (rows + 1) + j;
    let quads = grid(columns, rows).map(|[i, j]| {
        [
            vertex(i, j),
            vertex(i + 1, j),
            vertex(i + 1, j + 1),
            vertex(i, j + 1),
        ]
    });
    let triangles = quads.flat_map(halves).collect();
    Mesh::of_sound_parts(
        grid(columns + 1, rows + 1).map(position).collect(),
        triangles,
    )
}

/// A unit sphere from an icosahedron whose faces are cut into four `level` times.
pub fn icosphere(level: u32) -> Mesh {
    let (mut positions, mut triangles) = icosahedron();
    for _ in 0..level {
        triangles = quarter(&mut positions, &triangles);
    }
    Mesh::of_sound_parts(positions, triangles)
}

/// A band with a half twist: `2 * steps` triangles, one boundary, and one edge where the winding flips.
pub fn moebius_strip(steps: u32) -> Mesh {
    let positions = (0..steps)
        .flat_map(|step| {
            let angle = TAU * step as f32 / steps as f32;
            [-0.3, 0.3].map(|across| {
                let radius = 1.0 + across * cos(angle / 2.0);
                [
                    radius * cos(angle),
                    radius * sin(angle),
                    across * sin(angle / 2.0),
                ]
            })
        })
        .collect();
    let quad = |step: u32| match step + 1 {
        next if next < steps => [2 * step, 2 * next, 2 * next + 1, 2 * step + 1],
        _ => [2 * step, 1, 0, 2 * step + 1],
    };
    Mesh::of_sound_parts(positions, (0..steps).map(quad).flat_map(halves).collect())
}

/// `blades` triangles around one common edge, like the pages of a book.
pub fn fan(blades: u32) -> Mesh {
    let mut positions = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    positions.extend(circle(blades).map(|[x, y]| [x, y, 0.0]));
    Mesh::of_sound_parts(
        positions,
        (0..blades).map(|blade| [0, 1, 2 + blade]).collect(),
    )
}

/// Random triangles over few vertices on a coarse grid: doubles, degenerate faces, pinches and everything else.
pub fn random_soup(faces: usize, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let vertices = faces / 3 + 4;
    let positions = (0..vertices)
        .map(|_| [0; 3].map(|_| random.below(5) as f32 - 2.0))
        .collect();
    let triangles = (0..faces)
        .map(|_| [0; 3].map(|_| random.below(vertices) as u32))
        .collect();
    Mesh::of_sound_parts(positions, triangles)
}

/// Random triangles with corners anywhere in the cube from -1 to 1: most cut each other.
pub fn crossing_soup(faces: usize, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let corners = (0..3 * faces).map(|_| [0; 3].map(|_| 2.0 * random.unit() - 1.0));
    of_corners(corners.collect())
}

/// Random triangles over each other in the plane z = 0.
pub fn coplanar_soup(faces: usize, seed: u64) -> Mesh {
    mapped(&crossing_soup(faces, seed), |[x, y, _]| [x, y, 0.0])
}

/// Triangles almost without width from the origin to places around it, each a little higher than the one before.
pub fn needles(count: usize) -> Mesh {
    let tip = |at: usize| {
        let (angle, height) = (at as f32, at as f32 * 1e-6);
        let [x, y] = [cos(angle), sin(angle)];
        [[0.0; 3], [x, y, height], [x, y, height + 1e-6]]
    };
    of_corners((0..count).flat_map(tip).collect())
}

/// Triangles of three corners each.
fn of_corners(corners: Vec<[f32; 3]>) -> Mesh {
    let faces = 0..corners.len() as u32 / 3;
    let triangles = faces.map(|face| [3 * face, 3 * face + 1, 3 * face + 2]);
    Mesh::of_sound_parts(corners, triangles.collect())
}

/// The same surface with three vertices of its own for every face, as STL files store it.
pub fn unindexed(mesh: &Mesh) -> Mesh {
    let corners = mesh.triangles().as_flattened();
    let positions = corners
        .iter()
        .map(|&vertex| mesh.positions()[vertex as usize])
        .collect();
    of_corners(positions)
}

/// The same faces over vertices in random order, and the new number of every old vertex.
pub fn shuffled_vertices(mesh: &Mesh, seed: u64) -> (Mesh, Vec<u32>) {
    let mut moved_to: Vec<u32> = (0..mesh.positions().len() as u32).collect();
    Random::new(seed).shuffle(&mut moved_to);
    let mut positions = vec![[0.0; 3]; moved_to.len()];
    for (position, &to) in mesh.positions().iter().zip(&moved_to) {
        positions[to as usize] = *position;
    }
    let moved = |triangle: &[u32; 3]| triangle.map(|vertex| moved_to[vertex as usize]);
    (
        Mesh::of_sound_parts(positions, mesh.triangles().iter().map(moved).collect()),
        moved_to,
    )
}

/// The same mesh with about half of its faces turned over.
pub fn random_winding(mesh: &Mesh, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let turned = |&[a, b, c]: &[u32; 3]| {
        if random.below(2) == 0 {
            [a, b, c]
        } else {
            [a, c, b]
        }
    };
    Mesh::of_sound_parts(
        mesh.positions().to_vec(),
        mesh.triangles().iter().map(turned).collect(),
    )
}

/// The mesh with a few of its faces stored once more at the end, in either winding.
pub fn with_doubles(mesh: &Mesh, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let copies: Vec<[u32; 3]> = mesh
        .triangles()
        .iter()
        .copied()
        .filter(|_| random.below(4) == 0)
        .collect();
    let copies = random_winding(
        &Mesh::of_sound_parts(mesh.positions().to_vec(), copies),
        seed,
    );
    let triangles = [mesh.triangles(), copies.triangles()].concat();
    Mesh::of_sound_parts(mesh.positions().to_vec(), triangles)
}

/// The mirror image in the plane x = 0, wound so that outside stays outside.
pub fn mirrored(mesh: &Mesh) -> Mesh {
    let positions = mesh
        .positions()
        .iter()
        .map(|&[x, y, z]| [-x, y, z])
        .collect();
    let triangles = mesh
        .triangles()
        .iter()
        .map(|&[a, b, c]| [a, c, b])
        .collect();
    Mesh::of_sound_parts(positions, triangles)
}

/// The mesh with every position replaced by `place` of it.
pub fn mapped(mesh: &Mesh, place: impl Fn([f32; 3]) -> [f32; 3]) -> Mesh {
    let positions = mesh
        .positions()
        .iter()
        .map(|&position| place(position))
        .collect();
    Mesh::of_sound_parts(positions, mesh.triangles().to_vec())
}

/// The shape of a mesh alone, all of it on one surface.
pub fn shape_of(mesh: &Mesh) -> HalfEdgeMesh {
    let mut shape = HalfEdgeMesh {
        surfaces: vec![Surface::default()],
        ..HalfEdgeMesh::default()
    };
    add_to(&mut shape, mesh, |_| 0);
    shape
}

/// Adds a mesh to a shape that has surfaces already; `surface_of` names that of a face by its number in the mesh.
///
/// # Panics
///
/// If the shape breaks a promise then.
pub fn add_to(shape: &mut HalfEdgeMesh, mesh: &Mesh, surface_of: impl Fn(usize) -> u32) {
    let surfaces: Vec<u32> = (0..mesh.triangles().len()).map(surface_of).collect();
    let placed = PlacedMesh {
        rest: mesh.positions(),
        world: mesh.positions(),
        triangles: mesh.triangles(),
        surfaces: &surfaces,
        ..PlacedMesh::default()
    };
    add_mesh(shape, &placed, 0.0);
    shape.sanity_check();
}

/// `count` points around the unit circle, counter-clockwise from +x.
fn circle(count: u32) -> impl Iterator<Item = [f32; 2]> {
    (0..count)
        .map(move |i| TAU * i as f32 / count as f32)
        .map(|angle| [cos(angle), sin(angle)])
}

fn grid(columns: u32, rows: u32) -> impl Iterator<Item = [u32; 2]> {
    (0..columns).flat_map(move |i| (0..rows).map(move |j| [i, j]))
}

/// A quad as two triangles.
fn halves([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

/// The triangles of closed bands between rings of `around` vertices, inside out.
fn bands(around: u32, count: u32) -> Vec<[u32; 3]> {
    grid(count, around)
        .flat_map(|[ring, i]| {
            let (here, below, next) = (ring * around, (ring + 1) * around, (i + 1) % around);
            halves([here + i, here + next, below + next, below + i])
        })
        .collect()
}

/// Closes the first and last ring with a vertex each on the z axis.
fn close(
    positions: &mut Vec<[f32; 3]>,
    triangles: &mut Vec<[u32; 3]>,
    around: u32,
    heights: [f32; 2],
) {
    let top = positions.len() as u32;
    let last_ring = top - around;
    positions.extend(heights.map(|z| [0.0, 0.0, z]));
    for i in 0..around {
        let next = (i + 1) % around;
        triangles.push([top, i, next]);
        triangles.push([top + 1, last_ring + next, last_ring + i]);
    }
}

fn icosahedron() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let golden = (1.0 + 5.0_f32.sqrt()) / 2.0;
    let mut positions = Vec::new();
    for axis in 0..3 {
        for signs in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
            let mut position = [0.0; 3];
            position[(axis + 1) % 3] = signs[0];
            position[(axis + 2) % 3] = signs[1] * golden;
            positions.push(normalized(position));
        }
    }
    let triangles = outward_triples(&positions);
    (positions, triangles)
}

/// The faces of an icosahedron: all triples of vertices at its edge length from each other.
fn outward_triples(positions: &[[f32; 3]]) -> Vec<[u32; 3]> {
    let at = |vertex: u32| glam::Vec3::from_array(positions[vertex as usize]);
    let near = |a: u32, b: u32| at(a).distance(at(b)) < 1.1;
    let count = positions.len() as u32;
    let mut triangles = Vec::new();
    for a in 0..count {
        for b in (a + 1..count).filter(|&b| near(a, b)) {
            for c in (b + 1..count).filter(|&c| near(a, c) && near(b, c)) {
                let outward = (at(b) - at(a)).cross(at(c) - at(a)).dot(at(a)) > 0.0;
                triangles.push(if outward { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    triangles
}

/// Cuts every triangle into four, with new vertices on the sphere over the middle of each edge.
fn quarter(positions: &mut Vec<[f32; 3]>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles = BTreeMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let [p, q] = [positions[a as usize], positions[b as usize]];
            positions.push(normalized([p[0] + q[0], p[1] + q[1], p[2] + q[2]]));
            positions.len() as u32 - 1
        })
    };
    let mut quarters = Vec::with_capacity(4 * triangles.len());
    for &[a, b, c] in triangles {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        quarters.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    quarters
}

fn normalized(v: [f32; 3]) -> [f32; 3] {
    glam::Vec3::from_array(v).normalize().to_array()
}

/// Normals of flat shading: each face's own at its three corners.
pub fn flat_normals(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[[f32; 3]; 3]> {
    crate::face_normals(positions, triangles)
        .into_iter()
        .map(|normal| [normal; 3])
        .collect()
}
