//! Preparing a mesh, stage by stage, in triangles per second.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::shape::{PlacedMesh, add_mesh};
use npr_mesh::testing::{shuffled_vertices, torus, unindexed};
use npr_mesh::{Mesh, curvature, smooth_normals, unique_edges, weld};

/// A torus of about `faces` triangles.
fn mesh(faces: u32) -> Mesh {
    let tube = f64::from(faces / 4).sqrt() as u32;
    torus(2 * tube, tube, 1.0, 0.4)
}

fn renderers(criterion: &mut Criterion) {
    for faces in [1_000, 10_000, 100_000, 400_000, 1_000_000] {
        let mesh = mesh(faces);
        let soup = unindexed(&mesh);
        let (positions, triangles) = (mesh.positions(), mesh.triangles());
        let welded = weld(positions, 0.0);
        let normals = smooth_normals(positions, triangles, &welded);

        let mut group = criterion.benchmark_group("mesh");
        group
            .sample_size(10)
            .throughput(Throughput::Elements(triangles.len() as u64));
        let mut renderer = |name: &str, run: &mut dyn FnMut()| {
            group.bench_function(BenchmarkId::new(name, faces), |bencher| {
                bencher.iter(&mut *run)
            });
        };
        renderer("weld", &mut || drop(black_box(weld(positions, 0.0))));
        renderer("weld soup", &mut || {
            drop(black_box(weld(soup.positions(), 0.0)))
        });
        renderer("weld soup within 1e-6", &mut || {
            drop(black_box(weld(soup.positions(), 1e-6)))
        });
        renderer("edges", &mut || {
            drop(black_box(unique_edges(positions, triangles, &welded, &[])))
        });
        renderer("normals", &mut || {
            drop(black_box(smooth_normals(positions, triangles, &welded)))
        });
        renderer("curvature", &mut || {
            drop(black_box(curvature(
                positions, triangles, &welded, &normals,
            )))
        });
        renderer("all", &mut || prepare(&mesh));
        renderer("all of soup", &mut || prepare(&soup));
    }
}

/// Everything a first frame needs.
fn prepare(mesh: &Mesh) {
    let (positions, triangles) = (mesh.positions(), mesh.triangles());
    let welded = weld(positions, 0.0);
    let normals = smooth_normals(positions, triangles, &welded);
    black_box(curvature(positions, triangles, &welded, &normals));
    black_box(unique_edges(positions, triangles, &welded, &[]));
}

/// What lines need, in one call, and what a cache saves of it.
fn shapes(criterion: &mut Criterion) {
    for faces in [10_000, 100_000, 328_000, 1_000_000] {
        let mesh = mesh(faces);
        let (shuffled, soup) = (shuffled_vertices(&mesh, 1).0, unindexed(&mesh));
        let surfaces = vec![0; mesh.triangles().len()];
        let mut group = criterion.benchmark_group("shape");
        group
            .sample_size(10)
            .throughput(Throughput::Elements(mesh.triangles().len() as u64));
        let mut renderer = |name: &str, run: &mut dyn FnMut()| {
            group.bench_function(BenchmarkId::new(name, faces), |bencher| {
                bencher.iter(&mut *run)
            });
        };
        for (name, mesh) in [("indexed", &mesh), ("shuffled", &shuffled), ("soup", &soup)] {
            renderer(name, &mut || drop(black_box(shape(mesh, &surfaces, 0.0))));
            renderer(&format!("{name} within 1e-6"), &mut || {
                drop(black_box(shape(mesh, &surfaces, 1e-6)))
            });
        }
    }
}

fn shape(mesh: &Mesh, surfaces: &[u32], weld_tolerance: f32) -> HalfEdgeMesh {
    let mut shape = HalfEdgeMesh {
        surfaces: vec![Surface::default()],
        ..HalfEdgeMesh::default()
    };
    add_mesh(&mut shape, &placed(mesh, surfaces), weld_tolerance);
    shape
}

fn placed<'a>(mesh: &'a Mesh, surfaces: &'a [u32]) -> PlacedMesh<'a> {
    PlacedMesh {
        rest: mesh.positions(),
        world: mesh.positions(),
        triangles: mesh.triangles(),
        surfaces,
        ..PlacedMesh::default()
    }
}

criterion_group!(benches, renderers, shapes);
criterion_main!(benches);
