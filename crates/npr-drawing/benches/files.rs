//! Drawings to files, in stroke points per second; the order for plotters in lines per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_drawing::artwork::{ArtworkOptions, Paths};
use npr_drawing::fit::{FitOptions, fit};
use npr_drawing::json::{read_json, write_json};
use npr_drawing::outline::outline;
use npr_drawing::plot::{Route, order, travel};
use npr_drawing::svg::write_svg;
use npr_drawing::{drawing::rasterise, pdf::write_pdf};
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};

/// Points of a drawing; every stroke has 200.
const COUNTS: [usize; 3] = [1_000, 10_000, 100_000];

/// A wavy stroke of points a pixel apart, with a swelling width.
fn stroke(id: u64, length: usize) -> Stroke {
    let (x, y) = ((id * 7919 % 1700) as f64, (id * 104_729 % 1000) as f64);
    let points = (0..length).map(|i| {
        let t = i as f32;
        let bend = npr_core::math::sin(t * 0.031 + id as f32);
        StrokePoint {
            position: [
                x + f64::from(t),
                y + f64::from(20.0 * bend + 0.05 * ((i * 7 % 5) as f32 - 2.0)),
            ],
            depth: 5.0,
            width: 2.0 + f64::from(npr_core::math::cos(t * 0.05)),
            u: f64::from(t),
            world: [t, bend, 0.0],
            ..StrokePoint::default()
        }
    });
    Stroke {
        id,
        kind: Kind::Contour,
        occluders: 0,
        surface: 0,
        closed: false,
        part: None,
        points: points.collect(),
    }
}

fn drawing(point_count: usize) -> Drawing {
    Drawing {
        size: [1920, 1080],
        surfaces: vec![StrokeSurface::default()],
        strokes: (0..point_count as u64 / 200)
            .map(|id| stroke(id, 200))
            .collect(),
        ..Drawing::default()
    }
}

fn curves(c: &mut Criterion) {
    let mut group = c.benchmark_group("curves");
    for count in COUNTS {
        group.throughput(Throughput::Elements(count as u64));
        let stroke = stroke(3, count);
        let positions: Vec<[f64; 2]> = stroke.points.iter().map(|p| p.position).collect();
        group.bench_with_input(BenchmarkId::new("fit", count), &positions, |b, points| {
            b.iter(|| fit(points, false, &FitOptions::default()));
        });
        group.bench_with_input(BenchmarkId::new("outline", count), &stroke, |b, stroke| {
            b.iter(|| outline(&stroke.points, false, 0.08));
        });
    }
}

fn files(c: &mut Criterion) {
    let mut group = c.benchmark_group("files");
    for count in COUNTS {
        group.throughput(Throughput::Elements(count as u64));
        let drawing = drawing(count);
        let ink = ArtworkOptions::default();
        let pen = ArtworkOptions {
            paths: Paths::Centreline,
            ..ArtworkOptions::default()
        };
        group.bench_with_input(BenchmarkId::new("svg_ink", count), &drawing, |b, d| {
            b.iter(|| write_svg(d, &ink))
        });
        group.bench_with_input(BenchmarkId::new("svg_pen", count), &drawing, |b, d| {
            b.iter(|| write_svg(d, &pen))
        });
        group.bench_with_input(BenchmarkId::new("pdf_ink", count), &drawing, |b, d| {
            b.iter(|| write_pdf(d, &ink))
        });
        group.bench_with_input(BenchmarkId::new("pixels", count), &drawing, |b, d| {
            b.iter(|| rasterise(d, &ink))
        });
        let json = write_json(&drawing);
        group.bench_with_input(BenchmarkId::new("json", count), &drawing, |b, d| {
            b.iter(|| write_json(d))
        });
        group.bench_with_input(BenchmarkId::new("read_json", count), &json, |b, j| {
            b.iter(|| read_json(j))
        });
    }
}

fn plotter(c: &mut Criterion) {
    let mut group = c.benchmark_group("plot");
    group.sample_size(10);
    for count in [100, 1_000, 10_000] {
        group.throughput(Throughput::Elements(count as u64));
        let routes: Vec<Route> = (0..count as u64)
            .map(|i| {
                let hash = (i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                let [x, y] = [hash >> 40, hash >> 16 & 0xff_ffff].map(|v| v as f64 / 1e4);
                Route {
                    points: vec![
                        [x, y],
                        [x + (hash % 41) as f64 - 20.0, y + (hash % 37) as f64 - 18.0],
                    ],
                    closed: false,
                }
            })
            .collect();
        eprintln!(
            "{count} lines: pen-up travel {:.0}",
            travel(&routes, &order(&routes))
        );
        group.bench_with_input(BenchmarkId::new("order", count), &routes, |b, routes| {
            b.iter(|| order(routes))
        });
    }
}

criterion_group!(benches, curves, files, plotter);
criterion_main!(benches);
