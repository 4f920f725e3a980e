//! Face, vertex and corner normals, all of unit length.

use glam::DVec3;
use rayon::prelude::*;

use crate::edges::Edge;
use crate::triangle::Triangle;
use crate::union_find::UnionFind;
use crate::vertex_fans::VertexFans;
use crate::weld::Weld;

/// Stands in where a shape has no direction of its own; any unit vector would do.
const FALLBACK: DVec3 = DVec3::Z;

/// The unit normal of every face, on the side from which it is wound counter-clockwise.
///
/// Faces without area get +z.
pub fn face_normals(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<[f32; 3]> {
    triangles
        .par_iter()
        .map(|&indices| {
            to_f32(
                Triangle::new(positions, indices)
                    .normal()
                    .unwrap_or(FALLBACK),
            )
        })
        .collect()
}

/// One smooth unit normal per welded vertex.
///
/// Face normals are weighted by the angle they take up at the vertex, so that the result does not
/// depend on how flat regions are cut into triangles [Thürmer & Wüthrich 1998]. Where they cancel, or
/// no face with an area meets the vertex, the normal is +z. [`Weld::spread`] gives one per stored vertex.
pub fn smooth_normals(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    weld: &Weld,
) -> Vec<[f32; 3]> {
    let fans = VertexFans::new(triangles, weld);
    let weighted = weighted_normals(positions, triangles);
    (0..fans.count() as u32)
        .into_par_iter()
        .map(|welded| {
            let sum: DVec3 = fans
                .around(welded)
                .iter()
                .map(|&corner| weighted[corner as usize])
                .sum();
            to_f32(sum.try_normalize().unwrap_or(FALLBACK))
        })
        .collect()
}

/// One unit normal per corner, smooth across flat edges and split along creases.
///
/// An edge is a crease where its face normals differ by more than `crease_angle` radians, where its
/// faces are wound in opposite senses, or where it has not exactly two faces. Around each vertex, the
/// corners that are joined across other edges share an angle-weighted normal. 0.7 (40 degrees) suits
/// files that store no normals.
///
/// `edges` are those of [`unique_edges`](crate::unique_edges).
pub fn crease_normals(
    positions: &[[f32; 3]],
    triangles: &[[u32; 3]],
    weld: &Weld,
    edges: &[Edge],
    crease_angle: f32,
) -> Vec<[[f32; 3]; 3]> {
    // Join the corners that no crease parts.
    let mut joined = join_smooth_corners(triangles, weld, edges, crease_angle);

    // Sum the normals of every group of corners.
    let weighted = weighted_normals(positions, triangles);
    let mut sums = vec![DVec3::ZERO; weighted.len()];
    for (corner, &normal) in weighted.iter().enumerate() {
        sums[joined.find(corner as u32) as usize] += normal;
    }

    // Give every corner the normal of its group.
    (0..triangles.len() as u32)
        .map(|face| {
            [0, 1, 2].map(|i| {
                let sum = sums[joined.find(3 * face + i) as usize];
                to_f32(sum.try_normalize().unwrap_or(FALLBACK))
            })
        })
        .collect()
}

/// Unites the corners on both sides of every edge that is no crease.
fn join_smooth_corners(
    triangles: &[[u32; 3]],
    weld: &Weld,
    edges: &[Edge],
    crease_angle: f32,
) -> UnionFind {
    let crease_cos = npr_core::math::cos(crease_angle.clamp(0.0, std::f32::consts::PI));
    let mut sets = UnionFind::new(triangles.len() * 3);
    for edge in edges.iter().filter(|edge| edge.is_smooth(crease_cos)) {
        for end in edge.ends {
            let corner = |face: u32| corner_at(triangles, weld, face, end);
            if let [Some(one), Some(other)] = edge.faces.map(corner) {
                sets.unite(one, other);
            }
        }
    }
    sets
}

/// The corner of `face` that is welded to the stored vertex `end`.
fn corner_at(triangles: &[[u32; 3]], weld: &Weld, face: u32, end: u32) -> Option<u32> {
    let corners = weld.corners(triangles[face as usize]);
    let welded = weld.of_vertex[end as usize];
    corners
        .iter()
        .position(|&corner| corner == welded)
        .map(|i| 3 * face + i as u32)
}

/// Every corner's face normal times the angle at the corner; zero for faces without area.
fn weighted_normals(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let weighted: Vec<[DVec3; 3]> = triangles
        .par_iter()
        .map(|&indices| {
            let triangle = Triangle::new(positions, indices);
            let normal = triangle.normal().unwrap_or_default();
            [0, 1, 2].map(|corner| normal * triangle.angle(corner))
        })
        .collect();
    weighted.into_flattened()
}

fn to_f32(unit: DVec3) -> [f32; 3] {
    unit.as_vec3().to_array()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::unique_edges;
    use crate::mesh::Mesh;
    use crate::testing::{
        cube, cylinder, flat_normals, icosphere, random_soup, unindexed, with_doubles,
    };
    use crate::weld::weld;
    use glam::Vec3;
    use proptest::prelude::*;

    fn smooth(mesh: &Mesh) -> Vec<[f32; 3]> {
        let weld = weld(mesh.positions(), 0.0);
        weld.spread(&smooth_normals(mesh.positions(), mesh.triangles(), &weld))
    }

    fn creased(mesh: &Mesh, crease_angle: f32) -> Vec<[[f32; 3]; 3]> {
        let weld = weld(mesh.positions(), 0.0);
        let edges = unique_edges(mesh.positions(), mesh.triangles(), &weld, &[]);
        crease_normals(
            mesh.positions(),
            mesh.triangles(),
            &weld,
            &edges,
            crease_angle,
        )
    }

    fn is_unit(normal: [f32; 3]) -> bool {
        (Vec3::from_array(normal).length() - 1.0).abs() < 1e-6
    }

    #[test]
    fn normals_of_a_sphere_point_away_from_its_middle() {
        let sphere = icosphere(3);
        for (position, normal) in sphere.positions().iter().zip(smooth(&sphere)) {
            assert!(Vec3::from_array(*position).dot(Vec3::from_array(normal)) > 0.999);
        }
    }

    #[test]
    fn normals_of_a_cube_lie_on_its_diagonals_however_it_is_cut() {
        let cube = cube();
        for (position, normal) in cube.positions().iter().zip(smooth(&cube)) {
            let diagonal = Vec3::from_array(*position).normalize();
            assert!(diagonal.distance(Vec3::from_array(normal)) < 1e-6);
        }
    }

    #[test]
    fn a_cube_splits_at_forty_degrees_and_not_at_a_hundred() {
        let mesh = unindexed(&cube());
        assert_eq!(
            creased(&mesh, 0.7),
            flat_normals(mesh.positions(), mesh.triangles())
        );
        let together = creased(&mesh, 1.8);
        assert!(
            together
                .as_flattened()
                .iter()
                .all(|n| (n[0].abs() - n[1].abs()).abs() < 1e-6)
        );
    }

    #[test]
    fn a_cylinder_is_smooth_around_and_sharp_at_its_caps() {
        let mesh = cylinder(48, 4);
        for (&triangle, normals) in mesh.triangles().iter().zip(creased(&mesh, 0.7)) {
            let cap = Triangle::new(mesh.positions(), triangle)
                .cross()
                .normalize()
                .z
                .abs()
                > 0.5;
            for (vertex, normal) in triangle.into_iter().zip(normals) {
                let [x, y, z] = mesh.positions()[vertex as usize];
                let expected = if cap {
                    Vec3::Z * z.signum()
                } else {
                    Vec3::new(x, y, 0.0).normalize()
                };
                assert!(expected.distance(Vec3::from_array(normal)) < 1e-3);
            }
        }
    }

    #[test]
    fn shapes_without_area_still_get_unit_normals() {
        let line = Mesh::new(
            vec![[0.0; 3], [1.0; 3], [2.0; 3]],
            vec![[0, 1, 2], [0, 0, 0]],
        )
        .unwrap();
        assert!(smooth(&line).into_iter().all(is_unit));
        assert!(
            creased(&line, 0.7)
                .into_flattened()
                .into_iter()
                .all(is_unit)
        );
        assert_eq!(
            face_normals(line.positions(), line.triangles()),
            [[0.0, 0.0, 1.0]; 2]
        );
    }

    proptest! {
        #[test]
        fn every_normal_is_a_unit_vector(seed: u64, faces in 0usize..40, crease_angle in 0.0f32..4.0) {
            let mesh = with_doubles(&random_soup(faces, seed), seed);
            prop_assert!(smooth(&mesh).into_iter().all(is_unit));
            prop_assert!(creased(&mesh, crease_angle).into_flattened().into_iter().all(is_unit));
        }

        #[test]
        fn without_creases_corner_normals_are_the_smooth_ones(level in 0u32..3) {
            let mesh = icosphere(level);
            let smooth = smooth(&mesh);
            for (triangle, normals) in mesh.triangles().iter().zip(creased(&mesh, 3.2)) {
                for (&vertex, normal) in triangle.iter().zip(normals) {
                    prop_assert_eq!(smooth[vertex as usize], normal);
                }
            }
        }
    }
}
