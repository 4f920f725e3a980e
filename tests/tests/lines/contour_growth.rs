//! How contours grow with the number of faces, which decides how much room they have at first.
//!
//! `cargo test -p npr-tests --test lines contour_growth -- --nocapture` prints what is measured.

use npr_core::math::{log2, powf};
use npr_mesh::Mesh;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{icosphere, mapped, shape_of, torus};
use npr_render::{LineModel, LineModelOptions};
use npr_scene::{LoadOptions, load};
use npr_tests::models;
use npr_vector::mesh_lines::contour::{EdgeContours, Eye, usual_room};

/// Directions of eyes, three radii away.
const DIRECTIONS: [[f64; 3]; 8] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.1],
    [0.0, 0.1, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 0.4, 0.7],
    [0.3, -1.0, 0.2],
    [-0.5, 0.3, -1.0],
    [0.7, 0.2, -0.4],
];

/// Nodes of a shape's contours in every view.
fn counts(shape: &HalfEdgeMesh) -> Vec<usize> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for position in &shape.positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(f64::from(position[axis]));
            high[axis] = high[axis].max(f64::from(position[axis]));
        }
    }
    let radius = (0..3)
        .map(|i| (high[i] - low[i]).powi(2))
        .sum::<f64>()
        .sqrt()
        * 0.5;
    let eye = |direction: &[f64; 3]| {
        let length = direction.iter().map(|v| v * v).sum::<f64>().sqrt();
        let at = |i: usize| (low[i] + high[i]) * 0.5 + direction[i] / length * 3.0 * radius;
        Eye::new([at(0), at(1), at(2), 1.0], (4.0 * radius) as f32)
    };
    let views = DIRECTIONS.iter().map(eye);
    views
        .map(|eye| EdgeContours::new(shape, &eye).graph.nodes.len())
        .collect()
}

/// The power with which counts grow, by least squares over logarithms.
fn power(samples: &[(usize, f64)]) -> f64 {
    let logs: Vec<[f64; 2]> = samples
        .iter()
        .map(|(n, count)| [f64::from(log2(*n as f32)), f64::from(log2(*count as f32))])
        .collect();
    let mean = [0, 1].map(|i| logs.iter().map(|log| log[i]).sum::<f64>() / logs.len() as f64);
    let product = |i: usize| {
        logs.iter()
            .map(|log| (log[0] - mean[0]) * (log[i] - mean[i]))
            .sum::<f64>()
    };
    product(1) / product(0)
}

/// An ellipsoid and a torus that is no circle anywhere, each at several resolutions.
fn smooth() -> [(&'static str, Vec<Mesh>); 2] {
    let egg = |level: u32| {
        mapped(&icosphere(level), |[x, y, z]| {
            [x, y * 1.4 + 0.2 * x * x, z * 0.8]
        })
    };
    let ring = |n: u32| {
        mapped(&torus(2 * n, n, 0.7, 0.3), |[x, y, z]| {
            [x * 1.3, y + 0.2 * x * z, z]
        })
    };
    [
        ("egg", (2..8).map(egg).collect()),
        ("ring", [8, 16, 32, 64, 128, 256].map(ring).to_vec()),
    ]
}

#[test]
fn contours_of_smooth_shapes_grow_with_the_root_of_their_faces() {
    for (name, meshes) in smooth() {
        let mut samples = Vec::new();
        for mesh in meshes {
            let (faces, counts) = (mesh.triangles().len(), counts(&shape_of(&mesh)));
            let mean = counts.iter().sum::<usize>() as f64 / counts.len() as f64;
            println!(
                "{name:5} {faces:7} faces, {mean:8.1} nodes, room {}",
                usual_room(faces)
            );
            assert!(
                counts.iter().all(|count| *count <= usual_room(faces)),
                "{name}, {faces}"
            );
            samples.push((faces, mean));
        }
        let power = power(&samples);
        println!("{name:5} grows with the power {power:.3}");
        assert!((0.47..0.56).contains(&power), "{name}: {power}");
    }
}

/// Models of all sorts: scans, figures, machines, architecture.
#[test]
fn models_have_room_at_the_first_go() {
    let mut samples = Vec::new();
    let mut full = Vec::new();
    let (mut view_count, mut over_count) = (0, 0);
    for path in models() {
        let scene = load(&path, &LoadOptions::default()).unwrap();
        let model = LineModel::new(&scene, &LineModelOptions::default()).unwrap();
        let shape = model.shape();
        let faces = shape.faces.len();
        if faces == 0 {
            continue;
        }
        let (counts, room) = (counts(shape), usual_room(faces));
        let most = counts.iter().copied().max().unwrap();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let law = powf(faces as f32, 0.8);
        println!(
            "{name:32} {faces:7} faces, at most {most:6} nodes, {:.2} of the law, room {room}",
            most as f32 / law
        );
        view_count += counts.len();
        let over = counts.iter().filter(|count| **count > room).count();
        over_count += over;
        if over > 0 {
            full.push(name);
        }
        if faces >= 1000 {
            samples.push((faces, most as f64));
        }
    }
    if view_count > 0 {
        println!(
            "models of 1000 faces and more grow with the power {:.2}",
            power(&samples)
        );
        println!("{over_count} of {view_count} views have no room: {full:?}");
        assert!(over_count * 20 <= view_count, "{full:?}");
    }
}
