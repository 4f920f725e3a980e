//! Whole frames on the processor; loading and preparing are left out.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_benches::subject::{Subject, bunny_path};
use npr_gpu::processor::Processor;
use npr_stylesheet::Style;
use std::time::Duration;

/// Triangles and sizes of Okuya 2016, table 1.
const TRIANGLE_COUNTS: [usize; 3] = [960, 9_566, 66_400];
const SIZES: [[u32; 2]; 3] = [[640, 360], [1280, 720], [1920, 1080]];

/// Frame pixels along a mask pixel [Okuya 2016, table 2].
const MASK_SCALES: [f32; 4] = [1.0, 1.5, 3.0, 6.0];

fn triangles_and_pixels(c: &mut Criterion) {
    let mut group = c.benchmark_group("frames");
    for count in TRIANGLE_COUNTS {
        let subject = Subject::ball(count).expect("a ball can be numbered");
        for size in SIZES {
            group.throughput(Throughput::Elements(u64::from(size[0] * size[1])));
            let id = BenchmarkId::new(
                format!("{count} triangles"),
                format!("{}x{}", size[0], size[1]),
            );
            let mut renderer = subject
                .warm_renderer(&Processor, &Style::default(), size)
                .expect("the processor draws");
            group.bench_function(id, |b| b.iter(|| renderer.draw(&subject.camera)));
        }
    }
}

fn mask_scales(c: &mut Criterion) {
    let mut group = c.benchmark_group("mask scale");
    let subject = Subject::ball(TRIANGLE_COUNTS[2]).expect("a ball can be numbered");
    for scale in MASK_SCALES {
        let mut style = Style::default();
        style.detect.scale = scale;
        let mut renderer = subject
            .warm_renderer(&Processor, &style, SIZES[2])
            .expect("the processor draws");
        group.bench_function(BenchmarkId::from_parameter(scale), |b| {
            b.iter(|| renderer.draw(&subject.camera))
        });
    }
}

fn bunny(c: &mut Criterion) {
    let Some(path) = bunny_path() else { return };
    let subject = Subject::from_file(&path).expect("the bunny is sound");
    let mut renderer = subject
        .warm_renderer(&Processor, &Style::default(), SIZES[2])
        .expect("the processor draws");
    c.bench_function("bunny at 1920x1080", |b| {
        b.iter(|| renderer.draw(&subject.camera))
    });
}

/// Few samples, so that all of it takes a minute.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
}

criterion_group!(name = benches; config = settings(); targets = triangles_and_pixels, mask_scales, bunny);
criterion_main!(benches);
