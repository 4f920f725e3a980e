//! Whole frames of the bunny in plain tones and in comic styles, on the processor.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use npr_benches::subject::{Subject, bunny_path};
use npr_gpu::processor::Processor;
use npr_stylesheet::Style;
use std::time::Duration;

const SIZE: [u32; 2] = [1920, 1080];

fn comic(c: &mut Criterion) {
    let Some(path) = bunny_path() else { return };
    let subject = Subject::from_file(&path).expect("the bunny is sound");
    let mut group = c.benchmark_group("comic");
    for name in ["toon", "comic-silver", "crosshatch", "screentone"] {
        let style = Style::preset(name).expect("a preset");
        let mut renderer = subject
            .warm_renderer(&Processor, &style, SIZE)
            .expect("the processor draws");
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| renderer.draw(&subject.camera))
        });
    }
}

/// Few samples, so that all of it takes a minute.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
}

criterion_group!(name = benches; config = settings(); targets = comic);
criterion_main!(benches);
