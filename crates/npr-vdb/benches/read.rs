//! How fast volumes are read and made dense, in voxels per second.

use std::hint::black_box;
use std::path::Path;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_vdb::testing::{Packing, Sample};
use npr_vdb::{Limits, read};

/// Radii of balls of about 10^3, 10^4, 10^5 and 10^6 voxels; the last is as large as a smoke column of a film.
const RADII: [i32; 4] = [6, 13, 29, 62];

fn packings() -> [(&'static str, Packing); 3] {
    [
        ("plain", Packing::Plain),
        ("zip", Packing::Zip),
        ("blosc", Packing::Blosc),
    ]
}

fn volume(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("read");
    group.sample_size(20);
    for radius in RADII {
        let mut sample = Sample::ball(radius);
        let count = sample.grids[0].voxels.len();
        group.throughput(Throughput::Elements(count as u64));
        for (name, packing) in packings() {
            sample.packing = packing;
            let file = sample.bytes();
            group.bench_with_input(BenchmarkId::new(name, count), &file, |bencher, file| {
                bencher.iter(|| read(black_box(file), &Limits::default())?.scalar("density"));
            });
        }
    }
    group.finish();
}

fn dense(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("dense");
    group.sample_size(20);
    for radius in RADII {
        let file = Sample::ball(radius).bytes();
        let grid = read(&file, &Limits::default()).and_then(|file| file.scalar("density"));
        let Some((grid, bounds)) = grid
            .ok()
            .and_then(|grid| grid.active_bounds().map(|bounds| (grid, bounds)))
        else {
            continue;
        };
        let count = bounds.size().iter().product::<usize>();
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
            bencher.iter(|| grid.dense(black_box(bounds.low), bounds.size()));
        });
    }
    group.finish();
}

/// The column of a million voxels from the shared volumes, where they lie beside the project.
fn column(criterion: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/assets/volumes/smoke_tall_houdini.vdb");
    let Ok(file) = std::fs::read(path) else {
        eprintln!("smoke_tall_houdini left out: the shared volumes are not beside this checkout");
        return;
    };
    criterion.bench_function("read/smoke_tall_houdini", |bencher| {
        bencher.iter(|| read(black_box(&file), &Limits::default())?.scalar("density"));
    });
}

criterion_group!(benches, volume, dense, column);
criterion_main!(benches);
