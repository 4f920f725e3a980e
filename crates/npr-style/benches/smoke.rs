//! What drawing smoke costs: spheres to numbers, light, smoothing and lines, by spheres, pixels and deviation.

#![allow(missing_docs, reason = "criterion's macros make undocumented items")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::camera::{Camera, Projection};
use npr_core::math::mix_bits;
use npr_core::smoke::{SmokePixel, Sphere, SphereView, ViewSphere};
use npr_core::window::Window;
use npr_style::lighting::Lights;
use npr_style::ramp::Level;
use npr_style::smoke::resolve::{Resolving, resolve};
use npr_style::smoke::shade::{Shading, shade_spheres};
use npr_style::smoke::{SmokeLook, blur, draw};
use std::hint::black_box;

/// A scene of spheres and everything that a frame makes of it.
struct Frame {
    size: [u32; 2],
    lens: SphereView,
    window: Window,
    look: SmokeLook,
    lights: Lights,
    spheres: Vec<Sphere>,
    balls: Vec<ViewSphere>,
    ids: Vec<u32>,
    depths: Vec<u32>,
    pixels: Vec<SmokePixel>,
    tones: Vec<f32>,
    cells: [Vec<blur::Cell>; 2],
}

impl Frame {
    fn new(count: u32, size: [u32; 2], sigma: f32) -> Self {
        let camera = Camera {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.5 },
        };
        let frame_px = size.map(|side| side as f32);
        let pixel_count = (size[0] * size[1]) as usize;
        let mut look = SmokeLook {
            layers: 4,
            range_start: 4.0,
            range_size: 0.5,
            range_blend: 0.6,
            line_px: 3.0,
            line_inner: 0.6,
            line_from: 0.4,
            alpha: 1.0,
            samples: 2,
            ramp: tones(),
            ..SmokeLook::default()
        };
        look.smooth(size, sigma);
        let cells = vec![[0.0; 2]; look.cell_count()];
        let mut frame = Self {
            size,
            lens: SphereView::of_view(&camera.view(size, ([-1.0; 3], [1.0; 3]))),
            window: Window::over(frame_px, [0.0; 2], frame_px, size),
            look,
            lights: Lights::distant([0.6, 0.64, 0.48]),
            spheres: (0..count).map(puff).collect(),
            balls: vec![ViewSphere::default(); count as usize],
            ids: vec![0; pixel_count],
            depths: vec![0; pixel_count],
            pixels: vec![SmokePixel::default(); pixel_count],
            tones: vec![0.0; pixel_count],
            cells: [cells.clone(), cells],
        };
        frame.draw();
        frame.shade();
        frame.smooth();
        frame
    }

    fn draw(&mut self) {
        draw::project_spheres(&self.lens, &self.spheres, &mut self.balls);
        let (ids, depths) = (&mut self.ids, &mut self.depths);
        ids.fill(0);
        depths.fill(0);
        draw::draw_spheres(&self.lens, &self.window, &self.balls, ids, depths);
    }

    fn shade(&mut self) {
        let with = Shading {
            lens: &self.lens,
            window: &self.window,
            look: &self.look,
            lights: &self.lights,
            ids: &self.ids,
            shadows: [&[]; 4],
            surfaces: [&[]; 4],
            spheres: &self.spheres,
            balls: &self.balls,
        };
        shade_spheres(&with, &mut self.pixels);
    }

    fn smooth(&mut self) {
        let [cells, blurred] = &mut self.cells;
        blur::gather_tones(self.size, &self.look, &self.pixels, cells);
        blur::blur_rows(&self.look, cells, blurred);
        blur::blur_columns(&self.look, blurred, cells);
        blur::smooth_tones(self.size, &self.look, &self.pixels, cells, &mut self.tones);
    }

    fn resolve(&mut self, colors: &mut [u32]) {
        let with = Resolving {
            lens: &self.lens,
            window: &self.window,
            look: &self.look,
            ids: &self.ids,
            balls: &self.balls,
            pixels: &self.pixels,
            tones: &self.tones,
        };
        resolve(&with, colors, &mut self.depths);
    }
}

/// A puff somewhere in a ball of radius 1.
fn puff(i: u32) -> Sphere {
    let share = |k: u32| (mix_bits(mix_bits(i) ^ k) >> 8) as f32 / (1 << 24) as f32;
    let center = [1, 2, 3].map(|k| (share(k) - 0.5) * 1.2);
    Sphere::new(center, 0.05 + 0.2 * share(4))
}

const PAPER: [u32; 2] = [512, 512];
const FULL: [u32; 2] = [1920, 1080];

/// Two tones, those of the usual style: a bluish shade and nearly white.
fn tones() -> [[f32; 4]; 8] {
    let mut tones = [[1.0, 1.0, 1.0, Level::UNUSED]; 8];
    for (tone, [light, at]) in tones.iter_mut().zip([[0.39, 0.0], [0.95, 0.45]]) {
        *tone = [light, light, light, at];
    }
    tones
}

fn by_spheres(c: &mut Criterion) {
    let mut group = c.benchmark_group("smoke/draw_spheres");
    for count in [150, 2000, 20_000] {
        let mut frame = Frame::new(count, FULL, 14.0);
        group.throughput(Throughput::Elements(u64::from(count)));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter(|| frame.draw())
        });
    }
}

fn by_pixels(c: &mut Criterion) {
    let mut group = c.benchmark_group("smoke/pixels");
    for size in [PAPER, FULL] {
        let mut frame = Frame::new(2000, size, 14.0);
        let mut colors = vec![0; frame.ids.len()];
        group.throughput(Throughput::Elements(colors.len() as u64));
        let id = |name| BenchmarkId::new(name, format!("{}x{}", size[0], size[1]));
        group.bench_function(id("shade"), |b| b.iter(|| frame.shade()));
        group.bench_function(id("resolve"), |b| {
            b.iter(|| frame.resolve(black_box(&mut colors)))
        });
    }
}

fn by_deviation(c: &mut Criterion) {
    let mut group = c.benchmark_group("smoke/smooth_sigma_px");
    for sigma in [1.0, 2.9, 3.0, 12.0, 48.0, 200.0] {
        let mut frame = Frame::new(2000, FULL, sigma);
        group.bench_function(BenchmarkId::from_parameter(sigma), |b| {
            b.iter(|| frame.smooth())
        });
    }
}

criterion_group!(benches, by_spheres, by_pixels, by_deviation);
criterion_main!(benches);
