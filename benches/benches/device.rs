//! Whole frames on a graphics device, software ones included, when `NPR_BENCH_DEVICE=1` asks for it.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use npr_benches::subject::{Subject, bunny_path};
use npr_gpu::device::{AdapterChoice, Device};
use npr_stylesheet::Style;
use std::time::Duration;

/// The device to measure on, where one is asked for and there.
fn device() -> Option<Device> {
    if std::env::var_os("NPR_BENCH_DEVICE").is_none_or(|value| value != "1") {
        eprintln!("device left out: NPR_BENCH_DEVICE=1 is not set");
        return None;
    }
    Device::open(AdapterChoice::Any)
        .map_err(|error| eprintln!("device left out: {error}"))
        .ok()
}

fn frames(c: &mut Criterion) {
    let Some(device) = device() else { return };
    let mut group = c.benchmark_group(device.adapter().to_string());

    // Time balls of a few sizes in frames of a few sizes.
    for count in [960, 9_566, 66_400] {
        let subject = Subject::ball(count).expect("a ball can be numbered");
        for size in [[640, 360], [1280, 720], [1920, 1080]] {
            let id = BenchmarkId::new(
                format!("{count} triangles"),
                format!("{}x{}", size[0], size[1]),
            );
            let mut renderer = subject
                .warm_renderer(&device, &Style::default(), size)
                .expect("the device draws");
            group.bench_function(id, |b| b.iter(|| renderer.draw(&subject.camera)));
        }
    }

    // Time a scanned mesh, where it is there.
    if let Some(path) = bunny_path() {
        let subject = Subject::from_file(&path).expect("the bunny is sound");
        let mut renderer = subject
            .warm_renderer(&device, &Style::default(), [1920, 1080])
            .expect("the device draws");
        group.bench_function("bunny at 1920x1080", |b| {
            b.iter(|| renderer.draw(&subject.camera))
        });
    }
}

/// Few samples: software devices take a second a frame.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3))
}

criterion_group!(name = benches; config = settings(); targets = frames);
criterion_main!(benches);
