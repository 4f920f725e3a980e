//! Ramp evaluations per second, and how long a style takes to read.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use npr_style::ramp::ramp_light;
use npr_stylesheet::{Style, levels, presets};
use std::hint::black_box;

fn shade_pixels(c: &mut Criterion) {
    let style = Style::default();
    let levels = levels(&style.shade.ramp);
    let mut group = c.benchmark_group("ramp_light");
    for count in [1_000u32, 1_000_000] {
        group.throughput(Throughput::Elements(u64::from(count)));
        group.bench_function(count.to_string(), |b| {
            b.iter(|| {
                let x = |i| i as f32 / count as f32;
                (0..count)
                    .map(|i| ramp_light(black_box(&levels), 0.05, x(i))[0])
                    .sum::<f32>()
            });
        });
    }
    group.finish();
}

fn read_presets(c: &mut Criterion) {
    let mut group = c.benchmark_group("from_toml");
    for preset in presets() {
        group.bench_function(preset.name, |b| {
            b.iter(|| Style::preset(black_box(preset.name)))
        });
    }
    group.finish();
    c.bench_function("set", |b| {
        let mut style = Style::default();
        b.iter(|| style.set(black_box("line.width.base=5px")));
    });
}

criterion_group!(benches, shade_pixels, read_presets);
criterion_main!(benches);
