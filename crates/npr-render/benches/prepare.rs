//! Preparing a model: welding, edges, normals and curvature, in triangles per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_mesh::testing::torus;
use npr_render::Model;
use npr_scene::{Mesh, Node, Part, Scene};
use std::hint::black_box;
use std::time::Duration;

/// A scene of one torus of about `triangle_count` triangles, without normals.
fn torus_scene(triangle_count: u32) -> Scene {
    let tube = f64::from(triangle_count / 4).sqrt() as u32;
    let torus = torus(2 * tube, tube, 1.0, 0.4);
    let part = Part {
        positions: torus.positions().to_vec(),
        triangles: torus.triangles().to_vec(),
        ..Part::default()
    };
    let mesh = Mesh {
        parts: vec![part],
        ..Mesh::default()
    };
    let node = Node {
        mesh: Some(0),
        ..Node::default()
    };
    Scene {
        nodes: vec![node],
        meshes: vec![mesh],
        ..Scene::default()
    }
}

fn prepare(c: &mut Criterion) {
    let mut group = c.benchmark_group("prepare");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(2));
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        let scene = torus_scene(count);
        group.throughput(Throughput::Elements(scene.triangle_count() as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter(|| black_box(Model::new(&scene)))
        });
    }
}

criterion_group!(benches, prepare);
criterion_main!(benches);
