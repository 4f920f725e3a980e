//! Crossings of a shape with itself, in faces per second, with and without building the tree.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::budget::Budget;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::mesh::Mesh;
use npr_mesh::testing::{Random, uv_sphere};
use npr_vector::mesh_lines::bvh::FaceTree;
use npr_vector::mesh_lines::intersect::crossings;
use std::hint::black_box;
use std::time::Duration;

/// Meridians and parallels of spheres with about 1 000, 8 000, 63 000 and 400 000 faces.
const SPHERES: [[u32; 2]; 4] = [[32, 17], [90, 46], [256, 124], [640, 314]];

/// Edges by sorting; twins are not needed here.
fn shape_of(positions: Vec<[f32; 3]>, faces: Vec<[u32; 3]>) -> HalfEdgeMesh {
    let mut sides: Vec<([u32; 2], u32)> = (0..3 * faces.len() as u32)
        .map(|side| {
            let (corners, i) = (faces[side as usize / 3], side as usize % 3);
            let [a, b] = [corners[i], corners[(i + 1) % 3]];
            ([a.min(b), a.max(b)], side)
        })
        .collect();
    sides.sort_unstable();
    let mut shape = HalfEdgeMesh {
        positions,
        face_surfaces: vec![0; faces.len()],
        twins: vec![NONE; 3 * faces.len()],
        edge_of: vec![0; 3 * faces.len()],
        edge_starts: vec![0],
        surfaces: vec![Surface::default()],
        faces,
        ..HalfEdgeMesh::default()
    };
    for group in sides.chunk_by(|a, b| a.0 == b.0) {
        for (_, side) in group {
            shape.edge_of[*side as usize] = shape.edge_count() as u32;
            shape.edge_sides.push(*side);
        }
        shape.edge_starts.push(shape.edge_sides.len() as u32);
        shape.edge_ends.push(group[0].0);
        shape.edge_traits.push(EdgeFlags::NONE);
        shape.dihedral_cos.push(1.0);
    }
    shape
}

/// A sphere with dents and bumps, so that faces see each other's planes from both sides.
fn bumpy(mesh: &Mesh) -> impl Iterator<Item = [f32; 3]> {
    mesh.positions().iter().map(|[x, y, z]| {
        let bump =
            1.0 + 0.1 * npr_core::math::sin(9.0 * x) * npr_core::math::sin(7.0 * y + 5.0 * z);
        [x * bump, y * bump, z * bump]
    })
}

/// One bumpy sphere, or two halves of the faces each that cut each other.
fn spheres([meridians, parallels]: [u32; 2], two: bool) -> HalfEdgeMesh {
    let mesh = uv_sphere(meridians, parallels);
    let mut positions: Vec<[f32; 3]> = bumpy(&mesh).collect();
    let mut faces = mesh.triangles().to_vec();
    if two {
        let base = positions.len() as u32;
        positions.extend(bumpy(&mesh).map(|[x, y, z]| [x + 0.7, y + 0.1, z + 0.2]));
        faces.extend(mesh.triangles().iter().map(|t| t.map(|v| v + base)));
    }
    shape_of(positions, faces)
}

/// A flat grid: the neighbours of every face lie in its plane.
fn grid(side: u32) -> HalfEdgeMesh {
    let mesh = npr_mesh::testing::plane(side, side);
    let tilted = mesh.positions().iter().map(|[x, y, _]| [*x, *y, x + y]);
    shape_of(tilted.collect(), mesh.triangles().to_vec())
}

/// Faces of random corners in a cube: nearly all pairs overlap.
fn soup(count: u32) -> HalfEdgeMesh {
    let mut random = Random::new(7);
    let corner = |_| [random.unit(), random.unit(), random.unit()];
    let positions = (0..3 * count).map(corner).collect();
    shape_of(
        positions,
        (0..count).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect(),
    )
}

fn measure(c: &mut Criterion) {
    let mut group = c.benchmark_group("crossings");
    let mut run = |name: &str, shape: &HalfEdgeMesh| {
        let count = shape.faces.len();
        group.throughput(Throughput::Elements(count as u64));
        let tree = FaceTree::new(shape);
        group.bench_function(BenchmarkId::new(name, count), |b| {
            b.iter(|| black_box(crossings(shape, &tree, &mut Budget::new(u64::MAX))))
        });
    };
    for size in SPHERES {
        run("one sphere", &spheres(size, false));
        run("two spheres", &spheres(size, true));
    }
    run("flat grid", &grid(180));
    run("soup", &soup(1_000));
    run("soup beyond the limit", &soup(10_000));
    let mut trees = |shape: &HalfEdgeMesh| {
        group.throughput(Throughput::Elements(shape.faces.len() as u64));
        group.bench_function(BenchmarkId::new("tree", shape.faces.len()), |b| {
            b.iter(|| black_box(FaceTree::new(shape)))
        });
    };
    for size in SPHERES {
        trees(&spheres(size, false));
    }
}

/// Few samples: the largest take seconds.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1))
}

criterion_group!(name = benches; config = settings(); targets = measure);
criterion_main!(benches);
