//! Line drawings of procedural meshes from ten thousand to a million triangles: preparing, and a view.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_benches::lines::subjects::{SIZE, benchmark_camera, knot, scene_of};
use npr_benches::solid::bumpy_ball;
use npr_render::{LineModel, LineModelOptions, LineOptions, LineSource};
use npr_scene::Scene;
use npr_stylesheet::Style;
use std::time::Duration;

const SIZES: [u32; 5] = [10_000, 31_622, 100_000, 316_226, 1_000_000];

/// A name, and scenes of about as many triangles as are asked for.
type Maker = (&'static str, fn(u32) -> Scene);

const MESHES: [Maker; 2] = [
    ("bumpy ball", |size| bumpy_ball(size as usize)),
    ("knot", |size| scene_of(knot(size))),
];

fn prepare(c: &mut Criterion) {
    let mut group = c.benchmark_group("prepare");
    for (name, scene_of_size) in MESHES {
        for size in SIZES {
            let scene = scene_of_size(size);
            group.throughput(Throughput::Elements(scene.triangle_count() as u64));
            group.bench_function(BenchmarkId::new(name, size), |b| {
                b.iter(|| LineModel::new(&scene, &LineModelOptions::default()));
            });
        }
    }
}

fn view(c: &mut Criterion) {
    let (camera, style) = (benchmark_camera(), Style::default());
    for method in [LineSource::Edges, LineSource::Surface] {
        let mut group = c.benchmark_group(format!("view, {method:?}"));
        let options = LineOptions {
            method,
            smooth: false,
            ..LineOptions::new(SIZE)
        };
        for (name, scene_of_size) in MESHES {
            for size in SIZES {
                // Draw once before the clock starts, so that what all views share is there.
                let scene = scene_of_size(size);
                let model = LineModel::new(&scene, &LineModelOptions::default())
                    .expect("the mesh can be numbered");
                model
                    .draw(&camera, &style, &options)
                    .expect("the frame has pixels");
                group.throughput(Throughput::Elements(scene.triangle_count() as u64));
                group.bench_function(BenchmarkId::new(name, size), |b| {
                    b.iter(|| model.draw(&camera, &style, &options));
                });
            }
        }
    }
}

/// Few samples, so that all of it takes some minutes.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(3))
}

criterion_group!(name = benches; config = settings(); targets = prepare, view);
criterion_main!(benches);
