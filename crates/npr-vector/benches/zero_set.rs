//! Smooth contours, in faces per second: corner normals once a shape, lines once a view.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_mesh::testing::{shape_of, torus};
use npr_vector::mesh_lines::zero_set::{CornerNormals, FlatFaces, zero_set};
use std::time::Duration;

/// Steps around the tube; a torus has `8 n * n` faces.
const STEPS: [u32; 4] = [11, 35, 112, 224];

/// Cosine of 40 degrees.
const CREASE_COS: f32 = 0.766;

fn smooth_contours(c: &mut Criterion) {
    let mut group = c.benchmark_group("zero set");
    for steps in STEPS {
        let shape = shape_of(&torus(4 * steps, steps, 1.0, 0.4));
        let faces = shape.faces.len();
        group.throughput(Throughput::Elements(faces as u64));
        group.bench_function(BenchmarkId::new("corner normals", faces), |b| {
            b.iter(|| CornerNormals::new(&shape, CREASE_COS))
        });
        let normals = CornerNormals::new(&shape, CREASE_COS);
        let eye = [3.0, 0.7, 1.9, 1.0];
        group.bench_function(BenchmarkId::new("lines", faces), |b| {
            b.iter(|| zero_set(&shape, &normals, eye, &FlatFaces::NONE))
        });
    }
}

/// Few samples, so that all of it takes half a minute.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1))
}

criterion_group!(name = benches; config = settings(); targets = smooth_contours);
criterion_main!(benches);
