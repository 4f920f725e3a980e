//! Preparing a mesh, stage by stage, in triangles per second.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_mesh::testing::{torus, unindexed};
use npr_mesh::{Mesh, curvature, smooth_normals, unique_edges, weld};

/// A torus of about `faces` triangles.
fn mesh(faces: u32) -> Mesh {
    let tube = f64::from(faces / 4).sqrt() as u32;
    torus(2 * tube, tube, 1.0, 0.4)
}

fn stages(criterion: &mut Criterion) {
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
        let mut stage = |name: &str, run: &mut dyn FnMut()| {
            group.bench_function(BenchmarkId::new(name, faces), |bencher| {
                bencher.iter(&mut *run)
            });
        };
        stage("weld", &mut || drop(black_box(weld(positions, 0.0))));
        stage("weld soup", &mut || {
            drop(black_box(weld(soup.positions(), 0.0)))
        });
        stage("weld soup within 1e-6", &mut || {
            drop(black_box(weld(soup.positions(), 1e-6)))
        });
        stage("edges", &mut || {
            drop(black_box(unique_edges(positions, triangles, &welded, &[])))
        });
        stage("normals", &mut || {
            drop(black_box(smooth_normals(positions, triangles, &welded)))
        });
        stage("curvature", &mut || {
            drop(black_box(curvature(
                positions, triangles, &welded, &normals,
            )))
        });
        stage("all", &mut || prepare(&mesh));
        stage("all of soup", &mut || prepare(&soup));
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

criterion_group!(benches, stages);
criterion_main!(benches);
