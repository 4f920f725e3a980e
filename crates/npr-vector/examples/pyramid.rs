//! Prints the lines of a pyramid that are seen from one side, each as a stroke with its places in the picture.

use npr_core::camera::{Camera, Projection};
use npr_core::line_kind::KindSet;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::shape::{PlacedMesh, add_mesh};
use npr_vector::mesh_lines::draw::{LineSettings, LineSource, Prepared, strokes};

use npr_vector::project::Projector;

/// A triangle on the ground and an apex.
const CORNERS: [[f32; 3]; 4] = [
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.0, 1.5, 0.0],
];
/// Counter-clockwise from outside.
const TRIANGLES: [[u32; 3]; 4] = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [0, 2, 1]];

fn main() {
    let mut shape = HalfEdgeMesh {
        surfaces: vec![Surface::default()],
        ..HalfEdgeMesh::default()
    };
    let pyramid = PlacedMesh {
        rest: &CORNERS,
        world: &CORNERS,
        triangles: &TRIANGLES,
        surfaces: &[0; 4],
        ..PlacedMesh::default()
    };
    add_mesh(&mut shape, &pyramid, 0.0);

    // Once for the shape: creases are edges whose faces turn by more than about 40 degrees.
    let prepared = Prepared::new(&shape, 0.77, false);

    // For each view: where the eye stands, and what is wanted.
    let camera = Camera {
        eye: [4.0, 3.0, 6.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective { fov_y: 0.6 },
    };
    let settings = LineSettings {
        size: [400, 300],
        kinds: KindSet::BITS,
        method: LineSource::Edges,
        smooth: false,
        hidden: false,
        split: None,
        memory_limit: u64::MAX,
    };
    let projector = Projector::new(&camera, settings.size, ([-1.0; 3], [1.5; 3]));
    for stroke in strokes(&shape, &prepared, &projector, &settings, &|_| 2.0) {
        let again = stroke.points.first().filter(|_| stroke.closed);
        let places = stroke.points.iter().chain(again).map(|p| p.position);
        let places: Vec<String> = places.map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        println!("{}: {}", stroke.kind.name(), places.join(" "));
    }
}
