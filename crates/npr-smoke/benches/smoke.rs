//! Every stage over voxels and spheres, in elements per second: what grows with what can be read off.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DAffine3, Vec3};
use npr_smoke::motion::{between, estimate_velocity};
use npr_smoke::sphere::around_particles;
use npr_smoke::{
    Distances, ParticleSettings, Particles, Smoke, SmokeSettings, Source, Track, TrackSettings,
    Volume, covered_share,
};

/// The paper's grid, then about ten times as many voxels each time.
const SIZES: [[u32; 3]; 4] = [[15, 15, 20], [32, 32, 44], [72, 72, 88], [100, 100, 100]];

/// Spheres and particles; the count of the other measurements is the last but one.
const COUNTS: [u32; 3] = [200, 2000, 20_000];

/// Lumpy smoke that fills most of the grid and turns about its axis.
fn lumps(size: [u32; 3]) -> Volume {
    let [width, height, depth] = size;
    let (mut density, mut velocity) = (Vec::new(), Vec::new());
    for at in 0..width * height * depth {
        let voxel = [at % width, at / width % height, at / (width * height)];
        let place = Vec3::from_array(std::array::from_fn(|axis| {
            (voxel[axis] as f32 + 0.5) / size[axis] as f32 - 0.5
        }));
        let wave = (place * 14.0).map(npr_core::math::sin);
        let lump = 0.2 * (wave.x * wave.y + wave.y * wave.z + wave.z * wave.x);
        density.push((1.0 - 1.8 * place.length() + lump).max(0.0));
        velocity.push(Vec3::new(-place.y, place.x, 0.1) * width as f32);
    }
    let volume = Volume::new(size, density, DAffine3::IDENTITY);
    let moving = volume.and_then(|volume| volume.with_velocity(velocity));
    moving.expect("one value per voxel")
}

fn count(size: [u32; 3]) -> u64 {
    size.iter().map(|&side| u64::from(side)).product()
}

fn volumes(c: &mut Criterion) {
    let mut group = c.benchmark_group("voxels");
    for size in SIZES {
        let (volume, voxels) = (lumps(size), count(size));
        group.throughput(Throughput::Elements(voxels));
        group.bench_function(BenchmarkId::new("distances", voxels), |b| {
            b.iter(|| Distances::new(&volume, 0.2))
        });
        group.bench_function(BenchmarkId::new("coarsen by 3", voxels), |b| {
            b.iter(|| volume.coarsened(3))
        });
        group.bench_function(BenchmarkId::new("frame of 2000 particles", voxels), |b| {
            let settings = ParticleSettings {
                count: 2000,
                ..Default::default()
            };
            let mut particles = Particles::new(&volume, settings);
            b.iter(|| {
                particles.step(&volume);
                let distances = Distances::new(&volume, settings.threshold);
                around_particles(particles.list(), &volume, &distances)
            })
        });
        for detail in [40, 1000] {
            let name = format!("frame of 2000 tracked spheres, detail {detail}");
            group.bench_function(BenchmarkId::new(name, voxels), |b| {
                let settings = TrackSettings {
                    count: 2000,
                    detail,
                    ..Default::default()
                };
                let mut track = Track::new(&volume, settings);
                b.iter(|| {
                    track.step(&volume);
                    track.spheres()
                })
            });
        }
        group.bench_function(BenchmarkId::new("between frames", voxels), |b| {
            b.iter(|| between(&volume, &volume, 0.5, 0.04))
        });
    }
}

fn slow(c: &mut Criterion) {
    let mut group = c.benchmark_group("solver");
    for size in SIZES {
        let voxels = count(size);
        group.throughput(Throughput::Elements(voxels));
        let settings = SmokeSettings {
            size,
            ..SmokeSettings::of(Source::Plume)
        };
        let mut smoke = Smoke::new(settings).expect("a grid of a usual size");
        (0..12).for_each(|_| smoke.step());
        group.bench_function(BenchmarkId::new("frame of the plume", voxels), |b| {
            b.iter(|| smoke.step())
        });
        let before = smoke.volume();
        smoke.step();
        let after = smoke.volume();
        group.bench_function(BenchmarkId::new("estimate velocity", voxels), |b| {
            b.iter(|| estimate_velocity(&before, &after, 0.04))
        });
    }
}

fn spheres(c: &mut Criterion) {
    let mut group = c.benchmark_group("spheres");
    let volume = lumps([72, 72, 88]);
    let distances = Distances::new(&volume, 0.2);
    for count in COUNTS {
        group.throughput(Throughput::Elements(u64::from(count)));
        let settings = ParticleSettings {
            count,
            ..Default::default()
        };
        let particles = Particles::new(&volume, settings);
        group.bench_function(BenchmarkId::new("around particles", count), |b| {
            b.iter(|| around_particles(particles.list(), &volume, &distances))
        });
        let spheres = around_particles(particles.list(), &volume, &distances);
        group.bench_function(BenchmarkId::new("covered share", count), |b| {
            b.iter(|| covered_share(&spheres, &volume, &distances))
        });
        group.bench_function(BenchmarkId::new("choose places", count), |b| {
            b.iter(|| npr_smoke::cover::cover(&distances, count as usize, 1))
        });
    }
}

/// Few samples, so that all of it takes two minutes.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(100))
        .measurement_time(Duration::from_millis(500))
}

criterion_group!(name = benches; config = settings(); targets = volumes, spheres, slow);
criterion_main!(benches);
