//! Line drawings of procedural meshes from ten thousand to a million triangles: preparing, a view, and films.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use npr_benches::lines::subjects::{SIZE, benchmark_camera, knot, scene_of, shared_models};
use npr_benches::motion::film::Film;
use npr_benches::solid::bumpy_ball;
use npr_render::{HeldLines, LineModel, LineModelOptions, LineOptions, LineSource};
use npr_scene::{LoadOptions, Scene, load};
use npr_stylesheet::Style;
use std::time::Duration;

/// Frames of films.
const FILM_SIZE: [u32; 2] = [1920, 1080];

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

/// Frames of a film, each from a view half a degree on, by themselves and held to those before.
fn film(c: &mut Criterion) {
    // Take a model that is always there, and one of many strokes where there is one.
    let mut scenes = vec![("bumpy ball", bumpy_ball(100_000))];
    let helmet = shared_models().join("flight_helmet.glb");
    scenes.extend(
        load(&helmet, &LoadOptions::default())
            .ok()
            .map(|scene| ("flight helmet", scene)),
    );
    let mut style = Style::preset("toon").expect("a preset");
    style.set("line.method=strokes").expect("a method");
    let options = LineOptions::of_style(&style, FILM_SIZE);

    let mut group = c.benchmark_group("film");
    for (name, scene) in scenes {
        let model = LineModel::for_style(&scene, &style, &LineModelOptions::default(), None)
            .expect("the mesh can be numbered");
        let (low, high) = model.bounds();
        let [low, high] = [low, high].map(Vec3::from);
        let sphere = ((low + high) / 2.0, low.distance(high) / 2.0);
        for (hold, is_held) in [("off", false), ("on", true)] {
            let (mut frame, mut held) = (0, HeldLines::default());
            group.bench_function(BenchmarkId::new(format!("hold {hold}"), name), |b| {
                b.iter(|| {
                    let camera = Film::Turn.camera(frame, sphere, FILM_SIZE[1]);
                    frame += 1;
                    match is_held {
                        true => model.draw_held(&camera, &style, &options, &mut held),
                        false => model.draw(&camera, &style, &options),
                    }
                });
            });
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

criterion_group!(name = benches; config = settings(); targets = prepare, view, film);
criterion_main!(benches);
