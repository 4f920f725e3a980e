//! Draws stroke coordinates as stripes: `stroke_chart OUT_FOLDER [MODEL.obj [TILE]]`.
//!
//! Wide stripes run along the strokes, thin lines across them; each mesh is drawn from two sides. A tile is given as
//! a share of half the mesh's size.

use std::{env, fs, io, path::Path};

use glam::{Mat3, Vec2, Vec3};
use npr_core::geometry::Triangle;
use npr_mesh::Mesh;
use npr_mesh::stroke_chart::{ChartInput, ChartSettings, StrokeChart, stroke_chart};
use npr_mesh::testing::{cube, cylinder, icosphere, mapped, torus};

const SIZE: usize = 900;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let folder = arguments.first().map_or(".", String::as_str);
    if let Some(file) = arguments.get(1) {
        let tile = arguments.get(2).and_then(|tile| tile.parse().ok());
        return draw(folder, "model", &read_obj(file)?, tile.unwrap_or(0.05));
    }
    let bumpy = mapped(&icosphere(6), |[x, y, z]| {
        let height = 1.0 + 0.15 * npr_core::math::sin(5.0 * x) * npr_core::math::sin(4.0 * y + z);
        [x * height, y * height, z * height]
    });
    draw(folder, "sphere", &icosphere(5), 0.15)?;
    draw(folder, "torus", &torus(96, 48, 1.0, 0.4), 0.2 / 1.4)?;
    draw(folder, "bumpy", &bumpy, 0.15)?;
    draw(folder, "cube", &cube(), 0.25)?;
    draw(folder, "cylinder", &cylinder(48, 20), 0.15)
}

/// Draws a mesh from two sides; `tile` is a share of its size.
fn draw(folder: &str, name: &str, mesh: &Mesh, tile: f32) -> io::Result<()> {
    let part_of = |&corners: &[u32; 3]| Triangle { corners, part: 0 };
    let triangles: Vec<Triangle> = mesh.triangles().iter().map(part_of).collect();
    let points = mesh.positions().iter().map(|&p| Vec3::from_array(p));
    let (low, high) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| {
        (l.min(p), h.max(p))
    });
    let (middle, size) = ((low + high) / 2.0, (high - low).max_element() / 2.0);
    let surface = ChartInput {
        positions: mesh.positions(),
        triangles: &triangles,
        directions: &[],
    };
    let settings = ChartSettings {
        tile_world: tile * size,
        ..ChartSettings::default()
    };
    let start = std::time::Instant::now();
    let chart = stroke_chart(&surface, &settings);
    println!(
        "{name}: {} triangles, {} singular, {} turning, gradient off by {:.3}, {:.0} ms",
        triangles.len(),
        chart.singular_triangles,
        chart.turning_triangles,
        chart.gradient_error,
        start.elapsed().as_secs_f64() * 1e3,
    );
    for (view, turn) in [0.5f32, 3.4].into_iter().enumerate() {
        let turn = Mat3::from_rotation_x(0.35) * Mat3::from_rotation_y(turn);
        let place = |p: [f32; 3]| turn * (Vec3::from_array(p) - middle) / size;
        let grey = paint(mesh, &chart, place);
        let file = io::BufWriter::new(
            fs::OpenOptions::new()
                .write(true)
                .create(true)
                .truncate(true)
                .open(Path::new(folder).join(format!("{name}-{view}.png")))?,
        );
        let mut encoder = png::Encoder::new(file, SIZE as u32, SIZE as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header()?.write_image_data(&grey)?;
    }
    Ok(())
}

/// Grey values of the front faces, nearest first.
fn paint(mesh: &Mesh, chart: &StrokeChart, place: impl Fn([f32; 3]) -> Vec3) -> Vec<u8> {
    let (mut grey, mut depth) = (vec![255; SIZE * SIZE], vec![f32::NEG_INFINITY; SIZE * SIZE]);
    for (corners, chart) in mesh.triangles().iter().zip(&chart.corners) {
        let points = corners.map(|corner| place(mesh.positions()[corner as usize]));
        let to_pixel = |p: Vec3| Vec2::new(1.0 + p.x * 0.62, 1.0 - p.y * 0.62) * SIZE as f32 / 2.0;
        let [a, b, c] = points.map(to_pixel);
        let area = (b - a).perp_dot(c - a);
        if area >= 0.0 {
            continue;
        }
        let shade = 0.55
            + 0.45
                * (points[1] - points[0])
                    .cross(points[2] - points[0])
                    .normalize_or_zero()
                    .z;
        let (low, high) = (
            a.min(b).min(c).max(Vec2::ZERO),
            a.max(b).max(c).min(Vec2::splat(SIZE as f32 - 1.0)),
        );
        for y in low.y as usize..=high.y as usize {
            for x in low.x as usize..=high.x as usize {
                let p = Vec2::new(x as f32, y as f32) + 0.5;
                let weights = [
                    (c - b).perp_dot(p - b) / area,
                    (a - c).perp_dot(p - c) / area,
                ];
                let weights = [weights[0], weights[1], 1.0 - weights[0] - weights[1]];
                let z: f32 = (0..3).map(|k| weights[k] * points[k].z).sum();
                let pixel = y * SIZE + x;
                if weights.iter().any(|&w| w < -1e-4) || z <= depth[pixel] {
                    continue;
                }
                let uv: Vec2 = (0..3)
                    .map(|k| Vec2::from_array(chart[k]) * weights[k])
                    .sum();
                let ink =
                    ((uv.x - uv.x.round()).abs() < 0.2) || ((uv.y - uv.y.round()).abs() < 0.03);
                depth[pixel] = z;
                grey[pixel] = (shade * if ink { 60.0 } else { 255.0 }) as u8;
            }
        }
    }
    grey
}

/// The triangles of a Wavefront OBJ file without texture coordinates.
fn read_obj(file: &str) -> io::Result<Mesh> {
    let text = fs::read_to_string(file)?;
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => positions
                .push([0; 3].map(|_| words.next().and_then(|w| w.parse().ok()).unwrap_or(0.0))),
            Some("f") => triangles.push([0; 3].map(|_| {
                words
                    .next()
                    .and_then(|w| w.parse::<u32>().ok())
                    .unwrap_or(1)
                    - 1
            })),
            _ => {}
        }
    }
    Mesh::new(positions, triangles).map_err(io::Error::other)
}
