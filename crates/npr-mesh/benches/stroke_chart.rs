//! Stroke coordinates, in triangles per second.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::geometry::Triangle;
use npr_mesh::Mesh;
use npr_mesh::stroke_chart::{ChartInput, ChartSettings, stroke_chart};
use npr_mesh::testing::{shuffled_vertices, torus};

fn charts(criterion: &mut Criterion) {
    for faces in [1_000u32, 10_000, 100_000, 300_000] {
        let tube = f64::from(faces / 4).sqrt() as u32;
        let indexed = torus(2 * tube, tube, 1.0, 0.4);
        let shuffled = shuffled_vertices(&indexed, 1).0;
        let mut group = criterion.benchmark_group("stroke chart");
        group
            .sample_size(10)
            .throughput(Throughput::Elements(indexed.triangles().len() as u64));
        for (name, mesh) in [("indexed", &indexed), ("shuffled", &shuffled)] {
            group.bench_function(BenchmarkId::new(name, faces), |bencher| {
                let triangles = triangles_of(mesh);
                let surface = ChartInput {
                    positions: mesh.positions(),
                    triangles: &triangles,
                    directions: &[],
                };
                bencher.iter(|| drop(black_box(stroke_chart(&surface, &ChartSettings::default()))));
            });
        }
    }
}

fn triangles_of(mesh: &Mesh) -> Vec<Triangle> {
    let triangle = |&corners: &[u32; 3]| Triangle { corners, part: 0 };
    mesh.triangles().iter().map(triangle).collect()
}

criterion_group!(benches, charts);
criterion_main!(benches);
