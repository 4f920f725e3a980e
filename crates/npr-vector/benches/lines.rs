//! The steps from triangle numbers to lines, in elements per second: pixels, or edges for the ribbons.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::camera::{Camera, Projection};
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::{Edge, EdgeRole, GPixel, NONE, Part, PosedVertex, Stamp, Triangle};
use npr_core::line_kind::KindSet;
use npr_core::outline::{MASK_OWNER, Outline};
use npr_core::window::{View, Window};
use npr_vector::screen::detect::{Detection, detect};
use npr_vector::screen::gbuffer::{Surfaces, resolve};
use npr_vector::screen::residual::{self, Inking, Search, Stamps};
use npr_vector::screen::ribbon::{self, Drawing};
use std::time::Duration;

/// Numbers of pixels or edges.
const COUNTS: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Half the width of all lines, in frame pixels.
const HALF_WIDTH: f32 = 1.5;

/// A square frame that looks at two triangles, a near one before a far one.
struct Picture {
    view: View,
    window: Window,
    outline: Outline,
    posed: Vec<PosedVertex>,
    triangles: [Triangle; 2],
    parts: [Part; 2],
    ids: Vec<u32>,
    gbuffer: Vec<GPixel>,
    mask: Vec<u32>,
    owners: Vec<u32>,
}

impl Picture {
    /// A frame of about `pixel_count` pixels; every eighth column shows the far triangle, so lines are everywhere.
    fn new(pixel_count: usize) -> Self {
        let side = (pixel_count as f64).sqrt() as u32;
        let camera = Camera {
            eye: [0.0, 0.0, 4.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 0.7 },
        };
        let view = camera.view([side; 2], ([-9.0; 3], [9.0; 3]));
        let corners = [0.0, -2.0].map(|z| [[-9.0, -9.0, z], [9.0, -9.0, z], [0.0, 9.0, z]]);
        let pixels = (side * side) as usize;
        let mut picture = Self {
            posed: corners
                .as_flattened()
                .iter()
                .map(|p| posed(&view, *p))
                .collect(),
            window: Window::over(view.frame_px, [0.0; 2], view.frame_px, [side; 2]),
            view,
            outline: outline(),
            triangles: [[0, 1, 2], [3, 4, 5]].map(|corners| Triangle {
                corners,
                part: corners[0] / 3,
            }),
            parts: [0, 1].map(|object| Part {
                object,
                flags: Part::LINES,
                ..Part::default()
            }),
            ids: (0..side * side)
                .map(|i| 1 + u32::from((i % side).is_multiple_of(8)))
                .collect(),
            gbuffer: vec![GPixel::EMPTY; pixels],
            mask: vec![0; pixels],
            owners: vec![0; pixels + 1],
        };
        picture.resolve();
        picture.detect();
        picture
    }

    fn resolve(&mut self) {
        let on = Surfaces {
            view: &self.view,
            window: &self.window,
            posed: &self.posed,
            triangles: &self.triangles,
            parts: &self.parts,
        };
        resolve(&on, &self.ids, &mut self.gbuffer);
    }

    fn detect(&mut self) {
        let with = Detection {
            view: &self.view,
            window: &self.window,
            outline: &self.outline,
            parts: &self.parts,
        };
        detect(&with, &self.gbuffer, &mut self.mask, &mut self.owners);
    }

    /// Ribbons from the near triangle's posed corners, looked up in the mask.
    fn ribbons(
        &self,
        posed: &[PosedVertex],
        edges: &[Edge],
        roles: &[EdgeRole],
        layer: &mut [u32],
        keys: &mut [u32],
    ) {
        let with = Drawing {
            view: &self.view,
            window: &self.window,
            mask_window: &self.window,
            outline: &self.outline,
            posed,
            parts: &self.parts,
            gbuffer: &self.gbuffer,
            mask: &self.mask,
            tints: &[],
        };
        keys.fill(0);
        ribbon::draw(&with, edges, roles, layer, keys);
    }

    /// Stamps for all line owners, where nothing is inked by ribbons.
    fn stamps(&self, ribbons: &[u32], stamps: &mut [Stamp], found: &mut [u32]) {
        let on = Search {
            window: &self.window,
            mask_window: &self.window,
            parts: &self.parts,
            gbuffer: &self.gbuffer,
            mask: &self.mask,
            ribbons,
        };
        residual::find(&on, &self.owners, stamps, found);
    }

    fn smooth(&self, found: &[u32], stamps: &[Stamp], smoothed: &mut [Stamp]) {
        let on = Stamps {
            mask_window: &self.window,
            mask: &self.mask,
            stamps,
        };
        residual::smooth(&on, found, smoothed);
    }

    fn ink(&self, found: &[u32], smoothed: &[Stamp], covered: &mut [u32], stamped: &mut [u32]) {
        stamped.fill(0);
        residual::claim(&self.window, found, smoothed, stamped, covered);
        let with = Inking {
            window: &self.window,
            mask_window: &self.window,
            parts: &self.parts,
            smoothed,
            tints: &[],
        };
        residual::stamp(&with, covered, stamped);
    }
}

/// Settings under which lines are found and drawn everywhere.
fn outline() -> Outline {
    Outline {
        depth_threshold: 0.012,
        normal_cos: 0.8,
        kinds: KindSet::CONTOUR,
        detects: Outline::DEPTH | Outline::NORMAL | Outline::OBJECT_ID | Outline::PLANE_DEPTH,
        ..Outline::default()
    }
}

/// A point of the world as the camera sees it.
fn posed(view: &View, world: [f32; 3]) -> PosedVertex {
    let m = view.clip_from_world;
    PosedVertex {
        clip: std::array::from_fn(|i| {
            m[0][i] * world[0] + m[1][i] * world[1] + m[2][i] * world[2] + m[3][i]
        }),
        world,
        depth: 4.0 - world[2],
        normal: [0.0, 0.0, 1.0],
        half_width: HALF_WIDTH,
    }
}

/// `count` short edges in rows over the picture, and their posed ends.
fn short_edges(view: &View, count: usize) -> (Vec<PosedVertex>, Vec<Edge>) {
    let across = (count as f64).sqrt().ceil() as usize;
    let place = |i: usize| 2.4 * (i as f32 / across as f32 - 0.5);
    let ends = (0..count).flat_map(|i| {
        let (x, y) = (place(i % across), place(i / across));
        [[x, y, 0.0], [x + 1.2 / across as f32, y + 0.01, 0.0]]
    });
    let edge = |i: u32| Edge {
        ends: [2 * i, 2 * i + 1],
        faces: [0, NONE],
        dihedral_cos: 1.0,
        traits: EdgeFlags::NONE,
    };
    (
        ends.map(|end| posed(view, end)).collect(),
        (0..count as u32).map(edge).collect(),
    )
}

fn pixels(c: &mut Criterion) {
    for count in COUNTS {
        let mut picture = Picture::new(count);
        let pixel_count = picture.ids.len();
        let mut group = c.benchmark_group("pixels");
        group.throughput(Throughput::Elements(pixel_count as u64));
        group.bench_function(BenchmarkId::new("resolve", count), |b| {
            b.iter(|| picture.resolve())
        });
        group.bench_function(BenchmarkId::new("detect", count), |b| {
            b.iter(|| picture.detect())
        });

        assert!(picture.mask.iter().any(|found| found & MASK_OWNER != 0));
        let (bare, mut stamps) = (vec![0; pixel_count], vec![Stamp::default(); pixel_count]);
        let (mut found, mut covered) = (picture.owners.clone(), picture.owners.clone());
        group.bench_function(BenchmarkId::new("find residual", count), |b| {
            b.iter(|| picture.stamps(&bare, &mut stamps, &mut found))
        });
        let mut smoothed = stamps.clone();
        group.bench_function(BenchmarkId::new("smooth stamps", count), |b| {
            b.iter(|| picture.smooth(&found, &stamps, &mut smoothed))
        });
        let mut stamped = vec![0; pixel_count];
        group.bench_function(BenchmarkId::new("ink stamps", count), |b| {
            b.iter(|| picture.ink(&found, &smoothed, &mut covered, &mut stamped))
        });
    }
}

fn edges(c: &mut Criterion) {
    let picture = Picture::new(1_000_000);
    let pixel_count = picture.ids.len();
    let (mut layer, mut keys) = (vec![0; pixel_count], vec![0; pixel_count]);
    let mut group = c.benchmark_group("edges");
    for count in COUNTS {
        let (posed, edges) = short_edges(&picture.view, count);
        let role = EdgeRole {
            kinds: KindSet::CONTOUR,
            part: 0,
        };
        let roles = vec![role; count];
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::new("draw ribbons", count), |b| {
            b.iter(|| picture.ribbons(&posed, &edges, &roles, &mut layer, &mut keys))
        });
    }
}

/// Few samples, so that all of it takes half a minute.
fn settings() -> Criterion {
    Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_secs(1))
}

criterion_group!(name = benches; config = settings(); targets = pixels, edges);
criterion_main!(benches);
