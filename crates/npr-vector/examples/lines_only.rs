//! Writes the lines of a vase as an SVG: `cargo run --example lines_only > vase.svg`. No device, no file formats, no
//! styles: `npr-mesh` and `npr-vector` alone.

use npr_core::camera::Camera;
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::shape::{PlacedMesh, add_mesh};
use npr_vector::mesh_lines::draw::{LineSettings, LineSource, Prepared, strokes};
use npr_vector::project::Projector;
use std::fmt::Write;

/// Radius and height of the rings, from the bottom up.
const PROFILE: [[f32; 2]; 9] = [
    [0.0, 0.0],
    [0.5, 0.0],
    [0.8, 0.3],
    [0.9, 0.8],
    [0.7, 1.3],
    [0.35, 1.7],
    [0.3, 2.0],
    [0.5, 2.2],
    [0.55, 2.25],
];
/// Corners of a ring.
const AROUND: u32 = 48;

fn main() -> Result<(), std::fmt::Error> {
    // Turn the profile about the vertical axis, and join the rings by triangles.
    let corner = |[radius, height]: [f32; 2], i: u32| {
        let angle = i as f32 / AROUND as f32 * std::f32::consts::TAU;
        let (sin, cos) = (npr_core::math::sin(angle), npr_core::math::cos(angle));
        [radius * sin, height, radius * cos]
    };
    let rings = PROFILE
        .iter()
        .flat_map(|at| (0..AROUND).map(|i| corner(*at, i)));
    let positions: Vec<[f32; 3]> = rings.collect();
    let quads = (0..PROFILE.len() as u32 - 1).flat_map(|ring| (0..AROUND).map(move |i| (ring, i)));
    let triangles = quads.flat_map(|(ring, i)| {
        let at = |up: u32, along: u32| (ring + up) * AROUND + (i + along) % AROUND;
        [
            [at(0, 0), at(0, 1), at(1, 1)],
            [at(0, 0), at(1, 1), at(1, 0)],
        ]
    });
    let triangles: Vec<[u32; 3]> = triangles.collect();

    // Prepare the shape once: creases are edges whose faces turn by more than about 60 degrees.
    let mut shape = HalfEdgeMesh {
        surfaces: vec![Surface::default()],
        ..HalfEdgeMesh::default()
    };
    let vase = PlacedMesh {
        rest: &positions,
        world: &positions,
        triangles: &triangles,
        surfaces: &vec![0; triangles.len()],
        ..PlacedMesh::default()
    };
    add_mesh(&mut shape, &vase, 1e-6);
    let prepared = Prepared::new(&shape, 0.5, false);

    // Find the strokes of a view, hidden ones too.
    let bounds = ([-0.9, 0.0, -0.9], [0.9, 2.25, 0.9]);
    let settings = LineSettings {
        size: [600, 800],
        kinds: KindSet::BITS,
        method: LineSource::Edges,
        smooth: false,
        hidden: true,
        split: None,
        memory_limit: u64::MAX,
    };
    let camera = Camera::framing_for(bounds.0, bounds.1, 0.75, 0.6);
    let projector = Projector::new(&camera, settings.size, bounds);
    let mut svg = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 600 800""#.to_owned();
    svg += r#" fill="none" stroke="black">"#;
    for stroke in strokes(&shape, &prepared, &projector, &settings, &|_| 2.0) {
        let again = stroke.points.first().filter(|_| stroke.closed);
        let places = stroke.points.iter().chain(again).map(|p| p.position);
        let points: Vec<String> = places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let dashes = if stroke.occluders > 0 {
            r#" stroke-dasharray="2 4""#
        } else {
            ""
        };
        write!(
            svg,
            "\n<polyline class=\"{}\"{dashes} points=\"{}\"/>",
            stroke.kind.name(),
            points.join(" ")
        )?;
    }
    println!("{svg}\n</svg>");
    Ok(())
}
