//! Filling triangles: how the time grows with their number and with the pixels they cover.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::geometry::{Part, Triangle};
use npr_core::raster::{Fill, Sides, fill_triangles};
use npr_core::window::Window;
use std::time::Duration;

/// A sheet of triangles over the whole picture, sloping away to the right.
struct Sheet {
    corners: Vec<[f32; 4]>,
    triangles: Vec<Triangle>,
}

impl Sheet {
    /// A sheet of about `triangle_count` triangles: two in every cell of a square grid.
    fn new(triangle_count: u32) -> Self {
        let side = (f64::from(triangle_count) / 2.0).sqrt() as u32;
        let place = |i: u32| 2.0 * i as f32 / side as f32 - 1.0;
        let corner = |i: u32| {
            let [x, y] = [i % (side + 1), i / (side + 1)].map(place);
            [x, y, 0.5 - 0.25 * x, 1.0]
        };
        Self {
            corners: (0..(side + 1) * (side + 1)).map(corner).collect(),
            triangles: (0..side * side)
                .flat_map(|cell| halves(cell % side, cell / side, side + 1))
                .collect(),
        }
    }

    fn fill(&self, window: &Window, ids: &mut [u32], depths: &mut [u32]) {
        let fill = Fill {
            window,
            triangles: &self.triangles,
            parts: &[Part::default()],
            sides: Sides::AsParts,
            id_bits: 0,
            clip_of: |v| self.corners[v as usize],
            keep: |_, _, _| true,
        };
        fill_triangles(&fill, ids, depths);
    }
}

/// The two triangles of a cell whose lower left corner is in column `x` and row `y`.
fn halves(x: u32, y: u32, stride: u32) -> [Triangle; 2] {
    let a = y * stride + x;
    let (b, c, d) = (a + 1, a + stride + 1, a + stride);
    [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, part: 0 })
}

fn fill(c: &mut Criterion) {
    let mut group = c.benchmark_group("fill_triangles");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1));
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        let sheet = Sheet::new(count);
        group.throughput(Throughput::Elements(sheet.triangles.len() as u64));
        for size in [[640, 360], [1280, 720], [1920, 1080]] {
            let extent = size.map(|side| side as f32);
            let window = Window::over(extent, [0.0; 2], extent, size);
            let pixel_count = (size[0] * size[1]) as usize;
            let (mut ids, mut depths) = (vec![0; pixel_count], vec![0; pixel_count]);
            let id = BenchmarkId::new(format!("{}x{}", size[0], size[1]), count);
            group.bench_function(id, |b| {
                b.iter(|| {
                    depths.fill(0);
                    sheet.fill(&window, &mut ids, &mut depths);
                })
            });
        }
    }
}

criterion_group!(benches, fill);
criterion_main!(benches);
