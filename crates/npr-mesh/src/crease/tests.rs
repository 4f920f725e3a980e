use super::*;
use crate::half_edge::{HalfEdgeMesh, Surface};
use crate::mesh::Mesh;
use crate::shape::{PlacedMesh, add_mesh};
use crate::testing::{
    Random, cube, cylinder, flat_normals, icosphere, mapped, random_soup, unindexed,
};
use crate::{smooth_normals, unique_edges, weld};
use npr_core::crease::{CreaseFrom, Creases};
use npr_core::edge_flags::EdgeFlags;
use proptest::prelude::*;
use std::collections::BTreeSet;

type Place = [[u32; 3]; 2];

/// What the normals of a mesh are at each of its corners.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shading {
    Smooth,
    Flat,
    /// One of both, or none, as chance has it.
    Mixed(u64),
}

/// A mesh without the faces that have no area: frames know no edges of those.
fn with_area(mesh: &Mesh) -> Mesh {
    let triangles = mesh.triangles().iter().copied();
    let has_area =
        |corners: &[u32; 3]| Triangle::new(mesh.positions(), *corners).normal().is_some();
    Mesh::new(
        mesh.positions().to_vec(),
        triangles.filter(has_area).collect(),
    )
    .expect("as sound as it was")
}

/// A mesh that stores every corner for itself, and the file's normals there.
fn shaded(mesh: &Mesh, shading: Shading) -> (Mesh, Vec<[f32; 3]>) {
    let mesh = unindexed(mesh);
    let welded = weld(mesh.positions(), 0.0);
    let smooth = welded.spread(&smooth_normals(mesh.positions(), mesh.triangles(), &welded));
    let flat = flat_normals(mesh.positions(), mesh.triangles()).into_flattened();
    let normals = match shading {
        Shading::Smooth => smooth,
        Shading::Flat => flat,
        Shading::Mixed(seed) => {
            let mut random = Random::new(seed);
            let pick = |(smooth, flat): ([f32; 3], [f32; 3])| match random.below(5) {
                0 | 1 => smooth,
                2 | 3 => flat,
                _ => [0.0; 3],
            };
            smooth.into_iter().zip(flat).map(pick).collect()
        }
    };
    (mesh, normals)
}

fn place(positions: &[[f32; 3]], ends: [u32; 2]) -> Place {
    let mut place = ends.map(|end| positions[end as usize].map(|v| (v + 0.0).to_bits()));
    place.sort_unstable();
    place
}

/// The creases that drawings as curves have.
fn of_shape(mesh: &Mesh, normals: &[[f32; 3]], creases: Creases) -> BTreeSet<Place> {
    let mut shape = HalfEdgeMesh {
        surfaces: vec![Surface::default()],
        ..HalfEdgeMesh::default()
    };
    let placed = PlacedMesh {
        rest: mesh.positions(),
        world: mesh.positions(),
        normals,
        triangles: mesh.triangles(),
        surfaces: &vec![0; mesh.triangles().len()],
        ..PlacedMesh::default()
    };
    add_mesh(&mut shape, &placed, 0.0);
    shape.sanity_check();
    let is_crease = |edge: &u32| {
        let is_crowded = shape.edge_traits[*edge as usize].contains(EdgeFlags::NON_MANIFOLD);
        is_crowded || shape.fold_cos(*edge, creases.from) < creases.cos
    };
    let edges = (0..shape.edge_count() as u32).filter(is_crease);
    edges
        .map(|edge| place(&shape.positions, shape.ends(edge)))
        .collect()
}

/// The creases that frames have.
fn of_edges(mesh: &Mesh, normals: &[[f32; 3]], creases: Creases) -> BTreeSet<Place> {
    let welded = weld(mesh.positions(), 0.0);
    let edges = unique_edges(mesh.positions(), mesh.triangles(), &welded, &[]);
    let input = FoldInput {
        world: mesh.positions(),
        triangles: mesh.triangles(),
        weld: &welded,
        normals,
    };
    let folds = input.folds(&edges);
    let cosines = match creases.from {
        CreaseFrom::Normals => folds.normals,
        CreaseFrom::Faces => folds.faces,
    };
    let folded = edges
        .iter()
        .zip(cosines)
        .filter(|(_, cos)| *cos < creases.cos);
    folded
        .map(|(edge, _)| place(mesh.positions(), edge.ends))
        .collect()
}

fn creases(degrees: f32, from: CreaseFrom) -> Creases {
    Creases::over(degrees.to_radians(), from)
}

#[test]
fn smooth_shading_hides_the_folds_of_a_coarse_ball() {
    let (ball, normals) = shaded(&icosphere(0), Shading::Smooth);
    let by_normals = creases(40.0, CreaseFrom::Normals);
    assert!(of_shape(&ball, &normals, by_normals).is_empty());
    assert!(of_edges(&ball, &normals, by_normals).is_empty());
    let by_faces = creases(40.0, CreaseFrom::Faces);
    assert_eq!(of_shape(&ball, &normals, by_faces).len(), 30);
    assert_eq!(of_edges(&ball, &normals, by_faces).len(), 30);
}

#[test]
fn split_normals_make_the_twelve_creases_of_a_cube_and_smooth_ones_none() {
    for (shading, count) in [(Shading::Flat, 12), (Shading::Smooth, 0)] {
        let (cube, normals) = shaded(&cube(), shading);
        let by_normals = creases(40.0, CreaseFrom::Normals);
        assert_eq!(of_shape(&cube, &normals, by_normals).len(), count);
        assert_eq!(of_edges(&cube, &normals, by_normals).len(), count);
    }
}

#[test]
fn without_normals_faces_decide() {
    let cube = cube();
    for from in [CreaseFrom::Normals, CreaseFrom::Faces] {
        for normals in [vec![], vec![[0.0; 3]; 8], vec![[f32::NAN; 3]; 8]] {
            assert_eq!(of_shape(&cube, &normals, creases(40.0, from)).len(), 12);
            assert_eq!(of_edges(&cube, &normals, creases(40.0, from)).len(), 12);
        }
    }
}

/// Six sides, smooth around, and caps whose rims break: what an author means by such normals.
#[test]
fn a_coarse_cylinder_has_its_two_rims_alone() {
    let pillar = unindexed(&cylinder(6, 1));
    let around = |[x, y, _]: [f32; 3]| {
        let length = x.hypot(y);
        [x / length, y / length, 0.0]
    };
    let flat = flat_normals(pillar.positions(), pillar.triangles()).into_flattened();
    let normals: Vec<[f32; 3]> = pillar
        .positions()
        .iter()
        .zip(flat)
        .map(|(place, flat)| {
            if flat[2].abs() > 0.5 {
                flat
            } else {
                around(*place)
            }
        })
        .collect();
    let by_normals = creases(40.0, CreaseFrom::Normals);
    assert_eq!(of_shape(&pillar, &normals, by_normals).len(), 12);
    assert_eq!(of_edges(&pillar, &normals, by_normals).len(), 12);
    // By faces the six sides of 60 degrees show too.
    let by_faces = creases(40.0, CreaseFrom::Faces);
    assert_eq!(of_edges(&pillar, &normals, by_faces).len(), 18);
}

#[test]
fn a_break_at_the_tip_of_a_cone_alone_is_no_crease() {
    let one = [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
    let other = [[0.0, 0.0, 1.0], [-0.6, 0.0, 0.8]];
    let cos = cos_between([one, other], false).expect("normals");
    assert!(cos > creases(40.0, CreaseFrom::Normals).cos, "{cos}");
    let both = cos_between([[one[1]; 2], [other[1]; 2]], false).expect("normals");
    assert!((both - 0.28).abs() < 1e-6, "{both}");
}

proptest! {
    #[test]
    fn frames_and_drawings_have_the_same_creases(
        seed: u64, faces in 1usize..40, kind in 0u32..4, degrees in 5.0f32..120.0, stretch in 0.2f32..3.0,
    ) {
        let mesh = match kind {
            0 => random_soup(faces, seed),
            1 => icosphere(1),
            2 => cylinder(7, 2),
            _ => cube(),
        };
        let mesh = with_area(&mapped(&mesh, |[x, y, z]| [x, y * stretch, z]));
        for shading in [Shading::Smooth, Shading::Flat, Shading::Mixed(seed)] {
            let (mesh, normals) = shaded(&mesh, shading);
            for from in [CreaseFrom::Normals, CreaseFrom::Faces] {
                let creases = creases(degrees, from);
                prop_assert_eq!(of_shape(&mesh, &normals, creases), of_edges(&mesh, &normals, creases));
            }
        }
    }

    #[test]
    fn any_normals_give_cosines(bits: [[[u32; 3]; 2]; 2], is_flipped: bool) {
        let sides = bits.map(|side| side.map(|normal| normal.map(f32::from_bits)));
        if let Some(cos) = cos_between(sides, is_flipped) {
            prop_assert!((-1.0..=1.0).contains(&cos));
        }
    }
}

#[test]
fn normals_of_faces_wound_against_each_other_stand_for_both_their_directions() {
    let up = [[0.0, 0.0, 1.0]; 2];
    let down = [[0.0, 0.0, -1.0]; 2];
    assert_eq!(cos_between([up, down], true), Some(1.0));
    assert_eq!(cos_between([up, down], false), Some(-1.0));
}
