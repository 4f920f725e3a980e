//! The stages of centre lines, in pixels per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_trace::Bitmap;
use npr_trace::centreline::{
    CentrelineOptions, Network, centrelines, despeckle, distance2, link, thin,
};
use std::hint::black_box;
use std::time::Duration;

/// Sides of the bitmaps, in pixels.
const SIDES: [u32; 3] = [64, 256, 1024];

fn painted(side: u32, is_ink: impl Fn(u32, u32) -> bool) -> Bitmap {
    let mut bitmap = Bitmap::new(side, side).unwrap_or_else(|error| panic!("{error}"));
    for (x, y) in (0..side * side).map(|i| (i % side, i / side)) {
        bitmap.set(x, y, is_ink(x, y));
    }
    bitmap
}

/// Lines of three pixels in two directions: many crossings.
fn hatching(side: u32) -> Bitmap {
    painted(side, |x, y| {
        (x + 2 * y) % 24 < 5 || (3 * x + side * 3 - y) % 40 < 9
    })
}

/// Squares of two pixels that touch at their corners: as many junctions as there can be.
fn chequers(side: u32) -> Bitmap {
    painted(side, |x, y| (x / 2 + y / 2) % 2 == 0)
}

/// A pixel in two is ink.
fn noise(side: u32) -> Bitmap {
    painted(side, |x, y| npr_core::math::mix_bits(x << 16 | y) & 1 == 0)
}

fn renderers(c: &mut Criterion) {
    let subjects = [
        ("hatching", hatching as fn(u32) -> Bitmap),
        ("chequers", chequers),
        ("noise", noise),
    ];
    for (name, draw) in subjects {
        let mut group = c.benchmark_group(format!("centreline {name}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(200))
            .measurement_time(Duration::from_millis(700));
        for side in SIDES {
            let options = CentrelineOptions::default();
            let bitmap = draw(side);
            let ink = despeckle(&bitmap, options.turd_size);
            let thinned = thin(&ink);
            let network = Network::of(&thinned, &ink);
            let mut joined = network.clone();
            joined.cut_spurs(options.spur);
            joined.join_junctions();
            group.throughput(Throughput::Elements(u64::from(side * side)));
            let mut bench = |renderer: &str, run: &dyn Fn()| {
                group.bench_function(BenchmarkId::new(renderer, side), |b| b.iter(run));
            };
            bench("despeckle", &|| {
                black_box(despeckle(&bitmap, options.turd_size));
            });
            bench("thinning", &|| {
                black_box(thin(&ink));
            });
            bench("distance", &|| {
                for [x, y] in &network.pixels {
                    black_box(distance2(&ink, *x, *y));
                }
            });
            bench("network", &|| {
                black_box(Network::of(&thinned, &ink));
            });
            bench("junctions", &|| {
                let mut network = network.clone();
                network.cut_spurs(options.spur);
                network.join_junctions();
                black_box(network);
            });
            bench("links", &|| {
                black_box(link(&joined, options.link_turn));
            });
            bench("all", &|| {
                black_box(centrelines(&bitmap, &options));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, renderers);
criterion_main!(benches);
