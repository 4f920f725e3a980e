//! The number of threads changes no bit of any result.

use npr_mesh::testing::{random_soup, torus, unindexed, with_doubles};
use npr_mesh::{Curvature, Edge, Mesh, Weld, curvature, smooth_normals, unique_edges, weld};

type Prepared = (Weld, Vec<Edge>, Vec<[f32; 3]>, Vec<Curvature>);

fn prepare(mesh: &Mesh, tolerance: f32) -> Prepared {
    let (positions, triangles) = (mesh.positions(), mesh.triangles());
    let welded = weld(positions, tolerance);
    let edges = unique_edges(positions, triangles, &welded, &[]);
    let normals = smooth_normals(positions, triangles, &welded);
    let bends = curvature(positions, triangles, &welded, &normals);
    (welded, edges, normals, bends)
}

fn with_threads(threads: usize, mesh: &Mesh, tolerance: f32) -> Prepared {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("threads start")
        .install(|| prepare(mesh, tolerance))
}

#[test]
fn results_are_the_same_with_one_two_and_eight_threads() {
    let soup = with_doubles(&random_soup(3_000, 1), 2);
    let smooth = unindexed(&torus(90, 60, 1.0, 0.3));
    for mesh in [soup, smooth] {
        for tolerance in [0.0, 1e-5] {
            let alone = with_threads(1, &mesh, tolerance);
            assert!(alone == with_threads(2, &mesh, tolerance));
            assert!(alone == with_threads(8, &mesh, tolerance));
        }
    }
}
