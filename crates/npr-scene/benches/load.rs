//! How fast files become scenes, in triangles per second.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_scene::testing::Sheet;
use npr_scene::{Format, Limits, MemoryResources, load_bytes};

/// Cells along each side of the sheet: about 10^3, 10^4, 10^5 and 10^6 triangles.
const SIDES: [u32; 4] = [22, 71, 224, 707];

fn formats(sheet: &Sheet) -> [(&'static str, Format, Vec<u8>); 4] {
    [
        ("glb", Format::Glb, sheet.glb()),
        ("obj", Format::Obj, sheet.obj()),
        ("stl", Format::Stl, sheet.stl()),
        ("ply", Format::Ply, sheet.ply()),
    ]
}

fn load(criterion: &mut Criterion) {
    let (resources, limits) = (MemoryResources::default(), Limits::default());
    let mut group = criterion.benchmark_group("load");
    for side in SIDES {
        let sheet = Sheet::new(side);
        group.throughput(Throughput::Elements(sheet.triangles.len() as u64));
        for (name, format, file) in formats(&sheet) {
            let id = BenchmarkId::new(name, sheet.triangles.len());
            group.bench_with_input(id, &file, |bencher, file| {
                bencher.iter(|| {
                    load_bytes("sheet", black_box(file), Some(format), &resources, &limits)
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, load);
criterion_main!(benches);
