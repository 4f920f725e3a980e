//! Texels of hatch tiles made per second, and pixels shaded from them.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use npr_style::hatch::{Hatch, Pattern, levels, sample};
use std::hint::black_box;

const PATTERNS: [Pattern; 5] = [
    Pattern::Parallel,
    Pattern::Pencil,
    Pattern::Brush,
    Pattern::Stipple,
    Pattern::Dots,
];

fn make_tiles(c: &mut Criterion) {
    for side in [256u32, 512, 1024] {
        let mut group = c.benchmark_group(format!("hatch levels {side}"));
        group.sample_size(10);
        group.throughput(Throughput::Elements(u64::from(side * side)));
        for pattern in PATTERNS {
            let hatch = Hatch {
                pattern,
                ..Hatch::default()
            };
            group.bench_function(format!("{pattern:?}").to_lowercase(), |b| {
                b.iter(|| levels(black_box(&hatch), side))
            });
        }
        group.finish();
    }
}

fn shade_pixels(c: &mut Criterion) {
    let Ok(tile) = levels(&Hatch::default(), 256) else {
        return;
    };
    let mut group = c.benchmark_group("hatch sample");
    let count = 100_000u32;
    group.throughput(Throughput::Elements(u64::from(count)));
    group.bench_function("bilinear", |b| {
        b.iter(|| {
            let place = |i: u32| [i as f32 * 0.000_37, i as f32 * 0.000_11];
            (0..count)
                .map(|i| sample(&tile.levels[0], 256, place(i), black_box(0.4)).luminance)
                .sum::<f32>()
        });
    });
    group.finish();
}

criterion_group!(benches, make_tiles, shade_pixels);
criterion_main!(benches);
