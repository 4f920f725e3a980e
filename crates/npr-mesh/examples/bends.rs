//! Prints how a torus bends from its outside to its hole, beside the closed form.

use npr_mesh::testing::torus;
use npr_mesh::{curvature, smooth_normals, weld};

fn main() {
    let (ring_radius, tube_radius) = (1.0, 0.4);
    let mesh = torus(64, 32, ring_radius, tube_radius);
    let (positions, triangles) = (mesh.positions(), mesh.triangles());
    let welded = weld(positions, 0.0);
    let normals = smooth_normals(positions, triangles, &welded);
    let bends = curvature(positions, triangles, &welded, &normals);

    println!("from axis      max      min  (closed form)");
    for (position, bend) in positions.iter().zip(&bends).take(17) {
        let from_axis = (position[0] * position[0] + position[1] * position[1]).sqrt();
        let expected = (from_axis - ring_radius) / tube_radius / from_axis;
        println!(
            "{from_axis:9.3} {:8.3} {:8.3}  ({:.3}, {expected:.3})",
            bend.max,
            bend.min,
            1.0 / tube_radius
        );
    }
}
