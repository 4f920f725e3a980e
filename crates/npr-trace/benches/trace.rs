//! The stages of bitmap tracing, in steps along pixel edges per second.

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use npr_trace::{
    Bitmap, Loops, PixelLoop, TraceFormat, TraceOptions, TurnPolicy, adjust_corners, bends,
    decompose, join_arcs, nest, optimal_polygon, straight_lengths, trace, trace_to_file,
    write_tracing,
};
use std::hint::black_box;
use std::io::sink;
use std::time::Duration;

/// Sides of the bitmaps, in pixels.
const SIDES: [u32; 3] = [64, 256, 1024];

/// Discs on a grid, of sizes that grow from left to right: many short paths that curve.
fn discs(side: u32) -> Bitmap {
    let mut bitmap = Bitmap::new(side, side).unwrap_or_else(|error| panic!("{error}"));
    for (x, y) in (0..side * side).map(|i| (i % side, i / side)) {
        let [dx, dy] = [x, y].map(|v| (v % 16) as i32 - 8);
        let reach = 2 + (6 * x / side) as i32;
        bitmap.set(x, y, dx * dx + dy * dy < reach * reach);
    }
    bitmap
}

/// A spiral line of three pixels: one long path.
fn spiral(side: u32) -> Bitmap {
    let mut bitmap = Bitmap::new(side, side).unwrap_or_else(|error| panic!("{error}"));
    let middle = f64::from(side) / 2.0;
    for (x, y) in (0..side * side).map(|i| (i % side, i / side)) {
        let [dx, dy] = [x, y].map(|v| f64::from(v) + 0.5 - middle);
        let turn = npr_core::math::atan2_f64(dy, dx) / std::f64::consts::TAU;
        let distance = (dx * dx + dy * dy).sqrt();
        let ring = distance / 12.0 - turn;
        bitmap.set(x, y, distance < middle - 2.0 && ring - ring.floor() < 0.25);
    }
    bitmap
}

/// A chequer of single pixels: as many edges as a picture can have.
fn chequer(side: u32) -> Bitmap {
    let mut bitmap = Bitmap::new(side, side).unwrap_or_else(|error| panic!("{error}"));
    for (x, y) in (0..side * side).map(|i| (i % side, i / side)) {
        bitmap.set(x, y, (x ^ y) & 1 == 0);
    }
    bitmap
}

/// Chequers as each turn policy sees them, from specks to loops within loops: in all and without curves.
fn chequers(c: &mut Criterion) {
    let mut group = short_group(c, "trace chequer");
    for side in SIDES {
        let bitmap = chequer(side);
        group.throughput(Throughput::Elements(2 * u64::from(side) * u64::from(side)));
        for turn_policy in TurnPolicy::ALL {
            let options = TraceOptions {
                turn_policy,
                turd_size: 0,
                ..TraceOptions::default()
            };
            let name = turn_policy.name();
            group.bench_function(BenchmarkId::new(format!("decompose {name}"), side), |b| {
                b.iter(|| black_box(decompose(&bitmap, turn_policy, 0)));
            });
            group.bench_function(BenchmarkId::new(format!("file {name}"), side), |b| {
                b.iter(|| trace_to_file(&bitmap, &options, TraceFormat::Svg, &mut sink()));
            });
        }
    }
    group.finish();
}

/// A group whose benchmarks take less than a second each.
fn short_group<'a>(c: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(700));
    group
}

/// Whole tracings in pools of one and two threads: many short paths, and one long one.
fn threads(c: &mut Criterion) {
    for (name, draw) in [("discs", discs as fn(u32) -> Bitmap), ("spiral", spiral)] {
        let mut group = short_group(c, &format!("trace threads {name}"));
        for side in SIDES {
            let bitmap = draw(side);
            let loops = decompose(&bitmap, TurnPolicy::Minority, 2);
            group.throughput(Throughput::Elements(steps(&loops)));
            for threads in [1, 2] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                let pool = pool.build().unwrap_or_else(|error| panic!("{error}"));
                let options = TraceOptions::default();
                let file = || trace_to_file(&bitmap, &options, TraceFormat::Svg, &mut sink());
                group.bench_function(BenchmarkId::new(format!("file {threads}"), side), |b| {
                    pool.install(|| b.iter(|| black_box(file()).is_ok()));
                });
            }
        }
        group.finish();
    }
}

fn steps(loops: &Loops) -> u64 {
    loops.step_count() as u64
}

fn renderers(c: &mut Criterion) {
    for (name, draw) in [("discs", discs as fn(u32) -> Bitmap), ("spiral", spiral)] {
        let mut group = short_group(c, &format!("trace {name}"));
        for side in SIDES {
            let bitmap = draw(side);
            let options = TraceOptions::default();
            let loops = decompose(&bitmap, TurnPolicy::Minority, 2);
            group.throughput(Throughput::Elements(steps(&loops)));
            let mut bench = |renderer: &str, run: &dyn Fn()| {
                group.bench_function(BenchmarkId::new(renderer, side), |b| b.iter(run));
            };
            bench("decompose", &|| {
                black_box(decompose(&bitmap, TurnPolicy::Minority, 2));
            });
            bench("nest", &|| {
                black_box(nest([side, side], loops.iter()));
            });
            let each = |run: &dyn Fn(PixelLoop<'_>)| loops.iter().for_each(run);
            bench("straight", &|| {
                each(&|pixels| drop(black_box(straight_lengths(pixels.steps))));
            });
            bench("polygon", &|| {
                each(&|pixels| drop(black_box(optimal_polygon(&pixels))));
            });
            let polygons: Vec<_> = loops
                .iter()
                .map(|pixels| optimal_polygon(&pixels))
                .collect();
            bench("adjust", &|| {
                for (pixels, polygon) in loops.iter().zip(&polygons) {
                    black_box(adjust_corners(&pixels, polygon));
                }
            });
            let bent: Vec<_> = loops
                .iter()
                .zip(&polygons)
                .map(|(pixels, polygon)| bends(&adjust_corners(&pixels, polygon), 1.0))
                .collect();
            bench("join", &|| {
                for bends in &bent {
                    black_box(join_arcs(bends, 0.2));
                }
            });
            let tracing = trace(&bitmap, &options);
            bench("svg", &|| {
                black_box(write_tracing(&tracing, TraceFormat::Svg, &mut sink())).ok();
            });
            bench("all", &|| {
                black_box(trace(&bitmap, &options));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, renderers, chequers, threads);
criterion_main!(benches);
