//! Shapes of generated, random and hostile meshes.

use npr_core::edge_flags::EdgeFlags;
use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use npr_core::geometry::NONE;
use npr_mesh::half_edge::{HalfEdgeMesh, Surface};
use npr_mesh::shape::{MeshPose, PlacedMesh, Preparation, add_mesh, add_posable_mesh, set_pose};
use npr_mesh::testing::{
    Random, cube, cylinder, fan, icosphere, moebius_strip, plane, random_soup, random_winding,
    shuffled_vertices, torus, unindexed, uv_sphere, with_doubles,
};
use npr_mesh::{Mesh, weld};
use proptest::prelude::*;

/// A shape without faces, with surfaces of materials `0..count`.
fn surfaces(count: u32) -> HalfEdgeMesh {
    let surface = |material| Surface {
        material,
        ..Surface::default()
    };
    HalfEdgeMesh {
        surfaces: (0..count).map(surface).collect(),
        ..HalfEdgeMesh::default()
    }
}

fn placed<'a>(mesh: &'a Mesh, surfaces: &'a [u32]) -> PlacedMesh<'a> {
    PlacedMesh {
        rest: mesh.positions(),
        world: mesh.positions(),
        triangles: mesh.triangles(),
        surfaces,
        ..PlacedMesh::default()
    }
}

fn prepare(mesh: &Mesh) -> (HalfEdgeMesh, Preparation) {
    let mut shape = surfaces(1);
    let of_face = vec![0; mesh.triangles().len()];
    let preparation = add_mesh(&mut shape, &placed(mesh, &of_face), 0.0);
    shape.sanity_check();
    (shape, preparation)
}

fn count(shape: &HalfEdgeMesh, flag: EdgeFlags) -> usize {
    let traits = shape.edge_traits.iter();
    traits.filter(|t| t.contains(flag)).count()
}

fn euler_characteristic(mesh: &Mesh) -> i64 {
    let (shape, _) = prepare(mesh);
    shape.positions.len() as i64 - shape.edge_count() as i64 + shape.faces.len() as i64
}

/// Sets of faces that hang together across twins.
fn bodies(shape: &HalfEdgeMesh) -> Vec<BTreeSet<u32>> {
    let mut bodies = Vec::new();
    let mut seen = BTreeSet::new();
    for start in 0..shape.faces.len() as u32 {
        let mut body = BTreeSet::new();
        let mut open = vec![start];
        while let Some(face) = open.pop() {
            if seen.insert(face) {
                body.insert(face);
                let beside = (3 * face..3 * face + 3).map(|h| shape.twins[h as usize]);
                open.extend(beside.filter(|&twin| twin != NONE).map(|twin| twin / 3));
            }
        }
        if !body.is_empty() {
            bodies.push(body);
        }
    }
    bodies
}

/// The cube moved by `offset` and appended to another mesh.
fn with_cube(mesh: &Mesh, offset: [f32; 3]) -> Mesh {
    let base = mesh.positions().len() as u32;
    let moved = cube()
        .positions()
        .iter()
        .map(|p| [0, 1, 2].map(|i| p[i] + offset[i]))
        .collect();
    let triangles = cube()
        .triangles()
        .iter()
        .map(|t| t.map(|v| v + base))
        .collect();
    Mesh::new(
        [mesh.positions().to_vec(), moved].concat(),
        [mesh.triangles().to_vec(), triangles].concat(),
    )
    .expect("two sound meshes together are sound")
}

fn cross(shape: &HalfEdgeMesh, face: usize) -> DVec3 {
    let at = |v: u32| DVec3::from_array(shape.positions[v as usize].map(f64::from));
    let [a, b, c] = shape.faces[face].map(at);
    (b - a).cross(c - a)
}

#[test]
fn nothing_gives_nothing() {
    assert_eq!(prepare(&Mesh::default()).1, Preparation::default());
    HalfEdgeMesh::default().sanity_check();
}

#[test]
fn closed_surfaces_have_the_right_euler_characteristic() {
    for (mesh, expected) in [
        (cube(), 2),
        (uv_sphere(16, 9), 2),
        (cylinder(12, 3), 2),
        (icosphere(3), 2),
        (torus(24, 12, 1.0, 0.4), 0),
        (unindexed(&torus(24, 12, 1.0, 0.4)), 0),
    ] {
        assert_eq!(euler_characteristic(&mesh), expected);
        let (shape, preparation) = prepare(&mesh);
        assert!(shape.twins.iter().all(|&twin| twin != NONE));
        assert_eq!(bodies(&shape).len(), 1);
        assert_eq!(preparation.removed_count(), 0);
        assert_eq!(
            preparation.boundary_count + preparation.non_manifold_count,
            0
        );
    }
}

#[test]
fn a_plane_has_a_border_all_round_and_no_bend() {
    let (shape, preparation) = prepare(&plane(5, 3));
    assert_eq!(preparation.boundary_count, 2 * (5 + 3));
    assert!(shape.dihedral_cos.iter().all(|&cos| cos == 1.0));
}

#[test]
fn a_moebius_strip_flips_once_and_has_one_border() {
    let (shape, preparation) = prepare(&moebius_strip(40));
    assert_eq!(preparation.boundary_count, 80);
    assert_eq!(preparation.flipped_count, 1);
    assert_eq!(preparation.removed_count(), 0);
    let sharpest = shape.dihedral_cos.iter().copied().fold(1.0, f32::min);
    assert!(sharpest > 0.85, "compared as if wound alike: {sharpest}");
}

#[test]
fn sheets_stored_once_per_side_count_once() {
    let sheet = plane(4, 4);
    let both: Vec<[u32; 3]> = sheet
        .triangles()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b, c], [c, b, a]])
        .collect();
    let doubled = Mesh::new(sheet.positions().to_vec(), both).unwrap();
    let (shape, preparation) = prepare(&doubled);
    assert_eq!(shape, prepare(&sheet).0);
    assert_eq!(preparation.double_count, 32);
}

#[test]
fn the_blades_of_a_fan_meet_in_one_edge() {
    let (shape, preparation) = prepare(&fan(5));
    assert_eq!(preparation.non_manifold_count, 1);
    assert_eq!(count(&shape, EdgeFlags::FLIPPED), 0);
    assert!(
        shape.twins.iter().all(|&twin| twin == NONE),
        "all blades run up"
    );
}

#[test]
fn boxes_that_touch_along_an_edge_stay_two_boxes() {
    for offset in [[2.0, 2.0, 0.0], [-2.0, 0.0, 2.0], [0.0, -2.0, 2.0]] {
        let (shape, preparation) = prepare(&with_cube(&cube(), offset));
        assert_eq!(preparation.non_manifold_count, 1);
        let bodies = bodies(&shape);
        assert_eq!(bodies.len(), 2, "offset {offset:?}");
        assert_eq!(bodies[0], (0..12).collect(), "offset {offset:?}");
        assert!(shape.twins.iter().all(|&twin| twin != NONE));
    }
}

#[test]
fn boxes_that_touch_along_a_side_stay_two_boxes() {
    // Cut the touching side along its other diagonal, else its faces would be doubles.
    let mut mesh = cube();
    let mut triangles = mesh.triangles().to_vec();
    let top: Vec<usize> = (0..12)
        .filter(|&f| {
            triangles[f]
                .iter()
                .all(|&v| mesh.positions()[v as usize][2] == 1.0)
        })
        .collect();
    let [a, b, c] = triangles[top[0]];
    let d = *triangles[top[1]]
        .iter()
        .find(|v| ![a, b, c].contains(v))
        .unwrap();
    assert_eq!(
        triangles[top[1]],
        [a, c, d],
        "halves share their first corner"
    );
    (triangles[top[0]], triangles[top[1]]) = ([a, b, d], [b, c, d]);
    mesh = Mesh::new(mesh.positions().to_vec(), triangles).unwrap();

    let (shape, preparation) = prepare(&with_cube(&mesh, [0.0, 0.0, 2.0]));
    assert_eq!(preparation.removed_count(), 0);
    assert_eq!(preparation.non_manifold_count, 4);
    assert_eq!(bodies(&shape).len(), 2);
}

#[test]
fn materials_mark_the_edges_between_them() {
    let sheet = plane(2, 1);
    let mut shape = surfaces(2);
    add_mesh(&mut shape, &placed(&sheet, &[0, 0, 1, 1]), 0.0);
    assert_eq!(count(&shape, EdgeFlags::MATERIAL), 1);
    let [a, b] = shape.sides(
        shape
            .edge_traits
            .iter()
            .position(|t| t.contains(EdgeFlags::MATERIAL))
            .unwrap() as u32,
    ) else {
        panic!("two faces");
    };
    assert_ne!(
        shape.face_surfaces[*a as usize / 3],
        shape.face_surfaces[*b as usize / 3]
    );
}

#[test]
fn marks_find_their_edges_through_seams() {
    let cube = cube();
    let soup = unindexed(&cube);
    let [a, b] = [soup.triangles()[3][0], soup.triangles()[3][1]];
    let marks = [[a, b], [b, a], [a, a], [a, 999]];
    let of_face = [0; 12];
    let mut shape = surfaces(1);
    let mesh = PlacedMesh {
        marks: &marks,
        ..placed(&soup, &of_face)
    };
    let preparation = add_mesh(&mut shape, &mesh, 0.0);
    assert_eq!(
        (preparation.marked_count, preparation.lost_mark_count),
        (1, 2)
    );
    let edge = shape
        .edge_traits
        .iter()
        .position(|t| t.contains(EdgeFlags::MARKED))
        .unwrap();
    let mut ends = shape.ends(edge as u32).map(|v| shape.positions[v as usize]);
    let mut expected = [a, b].map(|v| soup.positions()[v as usize]);
    ends.sort_by(|p, q| p.partial_cmp(q).unwrap());
    expected.sort_by(|p, q| p.partial_cmp(q).unwrap());
    assert_eq!(ends, expected);
}

#[test]
fn a_cap_takes_the_orientation_across_its_longest_edge() {
    // A quad with a point in the middle of its diagonal on one side only.
    let positions = vec![
        [0.0; 3],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [1.0, 1.0, 0.0],
    ];
    let triangles = vec![[0, 1, 4], [1, 2, 4], [0, 4, 2], [0, 2, 3]];
    let (shape, preparation) = prepare(&Mesh::new(positions, triangles).unwrap());
    assert_eq!(shape.degenerate_faces, [[2, 3]]);
    assert_eq!(preparation.degenerate_face_count, 1);
    assert_eq!(
        preparation.boundary_count, 4,
        "the degenerate_face holds the quad together"
    );
    assert!(shape.dihedral_cos.iter().all(|&cos| cos == 1.0));
}

#[test]
fn a_row_of_caps_is_crossed_to_the_end() {
    // Points 0 to n on a line, fanned from point 0: every face but the last lies on the line.
    for n in 3..14u32 {
        let mut positions: Vec<[f32; 3]> = (0..=n).map(|i| [i as f32, 0.0, 0.0]).collect();
        positions.push([0.0, 1.0, 0.0]);
        let mut triangles: Vec<[u32; 3]> = (1..n).map(|i| [0, i, i + 1]).collect();
        triangles.push([0, n, n + 1]);
        let (shape, preparation) = prepare(&Mesh::new(positions, triangles).unwrap());
        assert_eq!(preparation.degenerate_face_count as u32, n - 1);
        for &[degenerate_face, stand_in] in &shape.degenerate_faces {
            let hops = n - 1 - degenerate_face;
            assert_eq!(stand_in, if hops <= 8 { n - 1 } else { NONE });
        }
    }
}

#[test]
fn a_sheet_of_nothing_but_degenerate_faces_is_lost() {
    let flat = npr_mesh::testing::mapped(&plane(6, 6), |[x, y, _]| [x + 2.0 * y, 0.0, 0.0]);
    let mut shape = surfaces(1);
    let of_face = vec![0; 72];
    let rest = plane(6, 6);
    let mesh = PlacedMesh {
        rest: rest.positions(),
        ..placed(&flat, &of_face)
    };
    let preparation = add_mesh(&mut shape, &mesh, 0.0);
    shape.sanity_check();
    assert_eq!(preparation.lost_degenerate_face_count, 72);
    assert!(shape.dihedral_cos.iter().all(|&cos| cos == 1.0));
}

#[test]
fn mirrored_meshes_keep_their_outside_outside() {
    let inside_out = npr_mesh::testing::mapped(&icosphere(2), |[x, y, z]| [-x, y, z]);
    let of_face = vec![0; inside_out.triangles().len()];
    let mut shape = surfaces(1);
    let mesh = PlacedMesh {
        mirrored: true,
        ..placed(&inside_out, &of_face)
    };
    add_mesh(&mut shape, &mesh, 0.0);
    shape.sanity_check();
    for face in 0..shape.faces.len() {
        let corner =
            DVec3::from_array(shape.positions[shape.faces[face][0] as usize].map(f64::from));
        assert!(cross(&shape, face).dot(corner) > 0.0);
    }
}

#[test]
fn objects_that_touch_in_the_world_do_not_grow_together() {
    let of_face = [0; 12];
    let cube = cube();
    let mut shape = surfaces(1);
    let mut total = Preparation::default();
    for _ in 0..3 {
        total += add_mesh(&mut shape, &placed(&cube, &of_face), 0.0);
        shape.sanity_check();
    }
    assert_eq!(total, Preparation::of(&shape));
    assert_eq!(bodies(&shape).len(), 3);
    assert_eq!(shape.ends(18), [8, 9], "the second cube starts at vertex 8");
}

#[test]
fn welding_looks_at_rest_positions_and_keeps_the_first_of_the_world() {
    let sheet = unindexed(&plane(1, 1));
    let world: Vec<[f32; 3]> = (0..6).map(|i| [i as f32, (i * i) as f32, 0.0]).collect();
    let mut shape = surfaces(1);
    let mesh = PlacedMesh {
        world: &world,
        ..placed(&sheet, &[0, 0])
    };
    add_mesh(&mut shape, &mesh, 0.0);
    assert_eq!(shape.positions, [world[0], world[1], world[2], world[5]]);
}

#[test]
fn unsound_faces_are_removed_and_counted() {
    let positions = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [f32::NAN, 0.0, 0.0],
        [1.0, f32::INFINITY, 0.0],
    ];
    let triangles = [
        [0, 1, 2],
        [0, 1, 3],
        [4, 1, 2],
        [0, 1, 77],
        [0, 2, 1],
        [1, 0, 2],
        [0, 0, 1],
    ];
    for tolerance in [0.0, 1e-6, f32::NAN, f32::INFINITY, -1.0] {
        let mut shape = surfaces(1);
        let mesh = PlacedMesh {
            rest: &positions,
            world: &positions,
            triangles: &triangles,
            surfaces: &[0, 0, 0, 0, 9],
            ..PlacedMesh::default()
        };
        let preparation = add_mesh(&mut shape, &mesh, tolerance);
        shape.sanity_check();
        if tolerance == f32::INFINITY {
            assert!(shape.faces.is_empty());
            continue;
        }
        assert_eq!(shape.faces, [[0, 1, 2]]);
        assert_eq!(preparation.unsound_count, 6, "two faces lack a surface");
    }
}

#[test]
fn positions_of_any_size_are_taken() {
    for size in [1e-44f32, 1e-20, 1.0, 1e20, 3e38] {
        let mesh = npr_mesh::testing::mapped(&cube(), |p| p.map(|v| v * size));
        for tolerance in [0.0, 1e-6] {
            let mut shape = surfaces(1);
            add_mesh(&mut shape, &placed(&mesh, &[0; 12]), tolerance);
            shape.sanity_check();
            assert_eq!(shape.edge_count(), 18);
            let square = shape.dihedral_cos.iter().filter(|&&cos| cos == 0.0).count();
            assert_eq!(square, 12, "size {size}");
        }
    }
}

#[test]
fn a_hub_with_a_hundred_thousand_spokes_is_no_trouble() {
    let (shape, preparation) = prepare(&cylinder(50_000, 1));
    assert_eq!(preparation.boundary_count, 0);
    assert_eq!(shape.edge_count(), 300_000);
    let book = fan(100_000);
    assert_eq!(prepare(&book).1.non_manifold_count, 1);
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let (soup, materials) = jumble(5, 3_000);
    let smooth = unindexed(&torus(90, 60, 1.0, 0.3));
    let zeros = vec![0; smooth.triangles().len()];
    for mesh in [placed(&soup, &materials), placed(&smooth, &zeros)] {
        let with_threads = |threads: usize, tolerance: f32| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            let mut shape = surfaces(3);
            pool.install(|| add_mesh(&mut shape, &mesh, tolerance));
            shape
        };
        for tolerance in [0.0, 1e-5] {
            let alone = with_threads(1, tolerance);
            assert!(alone == with_threads(2, tolerance));
            assert!(alone == with_threads(8, tolerance));
        }
    }
}

/// Random faces over few vertices, wound at random, some stored again, and their materials.
fn jumble(seed: u64, faces: usize) -> (Mesh, Vec<u32>) {
    let mesh = random_winding(&with_doubles(&random_soup(faces, seed), seed), seed ^ 1);
    let mut random = Random::new(seed ^ 2);
    let materials = mesh
        .triangles()
        .iter()
        .map(|_| random.below(3) as u32)
        .collect();
    (mesh, materials)
}

/// Faces that stay, by comparing each with all earlier ones: their welded corners and stored numbers.
fn faces_by_comparison(mesh: &Mesh) -> Vec<([u32; 3], usize)> {
    let welded = weld(mesh.positions(), 0.0);
    let sorted = |mut corners: [u32; 3]| {
        corners.sort();
        corners
    };
    let mut kept: Vec<([u32; 3], usize)> = Vec::new();
    for (face, &triangle) in mesh.triangles().iter().enumerate() {
        let corners = welded.corners(triangle);
        let [a, b, c] = sorted(corners);
        if a < b && b < c && kept.iter().all(|(other, _)| sorted(*other) != [a, b, c]) {
            kept.push((corners, face));
        }
    }
    kept
}

/// Half-edges by edge, by comparing all with all.
fn edges_by_comparison(faces: &[([u32; 3], usize)]) -> BTreeMap<[u32; 2], [Vec<u32>; 2]> {
    let mut edges = BTreeMap::<_, [Vec<u32>; 2]>::new();
    for (face, (corners, _)) in faces.iter().enumerate() {
        for i in 0..3 {
            let [tail, head] = [corners[i], corners[(i + 1) % 3]];
            let ends = [tail.min(head), tail.max(head)];
            edges.entry(ends).or_default()[usize::from(tail > head)].push((3 * face + i) as u32);
        }
    }
    edges
}

fn prepare_jumble(mesh: &Mesh, materials: &[u32]) -> HalfEdgeMesh {
    let mut shape = surfaces(3);
    add_mesh(&mut shape, &placed(mesh, materials), 0.0);
    shape.sanity_check();
    shape
}

/// What a shape says of an edge, in terms of stored vertices and faces of an unshuffled mesh.
type EdgeStory = (BTreeSet<u32>, EdgeFlags, i64, usize);

fn stories(
    shape: &HalfEdgeMesh,
    vertex: impl Fn(u32) -> u32,
    face: impl Fn(u32) -> u32,
) -> BTreeMap<BTreeSet<u32>, EdgeStory> {
    (0..shape.edge_count() as u32)
        .map(|edge| {
            let sides = shape.sides(edge);
            let faces = sides.iter().map(|s| face(s / 3)).collect();
            let paired = sides
                .iter()
                .filter(|&&s| shape.twins[s as usize] != NONE)
                .count();
            let cos = (f64::from(shape.dihedral_cos[edge as usize]) * 1e6).round() as i64;
            let ends = shape.ends(edge).into_iter().map(&vertex).collect();
            (ends, (faces, shape.edge_traits[edge as usize], cos, paired))
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn faces_and_edges_agree_with_comparing_all_pairs(seed: u64, faces in 0usize..60) {
        let (mesh, materials) = jumble(seed, faces);
        let shape = prepare_jumble(&mesh, &materials);
        let expected = faces_by_comparison(&mesh);
        prop_assert_eq!(&shape.faces, &expected.iter().map(|f| f.0).collect::<Vec<_>>());
        let of_face: Vec<u32> = expected.iter().map(|f| materials[f.1]).collect();
        prop_assert_eq!(&shape.face_surfaces, &of_face);

        let edges = edges_by_comparison(&expected);
        prop_assert_eq!(edges.len(), shape.edge_count());
        for (edge, (ends, [up, down])) in edges.into_iter().enumerate() {
            let traits = shape.edge_traits[edge];
            let sides = shape.sides(edge as u32);
            prop_assert_eq!(shape.ends(edge as u32), ends, "edges are sorted");
            prop_assert_eq!(sides, [up.clone(), down.clone()].concat());
            let paired = sides.iter().filter(|&&s| shape.twins[s as usize] != NONE).count();
            prop_assert_eq!(paired, 2 * up.len().min(down.len()), "as many twins as can be");
            let mixed = sides.iter().any(|s| of_face[*s as usize / 3] != of_face[sides[0] as usize / 3]);
            prop_assert_eq!(traits.contains(EdgeFlags::MATERIAL), mixed);
            prop_assert_eq!(traits.contains(EdgeFlags::BOUNDARY), sides.len() == 1);
            prop_assert_eq!(traits.contains(EdgeFlags::NON_MANIFOLD), sides.len() > 2);
            prop_assert_eq!(traits.contains(EdgeFlags::FLIPPED), sides.len() == 2 && up.len() != 1);
        }
    }

    #[test]
    fn angles_are_those_between_normals(seed: u64, faces in 0usize..40) {
        let (mesh, materials) = jumble(seed, faces);
        let shape = prepare_jumble(&mesh, &materials);
        let degenerate_faces: BTreeMap<u32, u32> = shape.degenerate_faces.iter().map(|s| (s[0], s[1])).collect();
        for face in 0..shape.faces.len() {
            let has_area = cross(&shape, face) != DVec3::ZERO;
            prop_assert_eq!(has_area, !degenerate_faces.contains_key(&(face as u32)));
        }
        let normal = |side: u32| match degenerate_faces.get(&(side / 3)) {
            Some(&NONE) => None,
            Some(&stand_in) => Some(cross(&shape, stand_in as usize).normalize()),
            None => Some(cross(&shape, side as usize / 3).normalize()),
        };
        for edge in 0..shape.edge_count() as u32 {
            let expected = match *shape.sides(edge) {
                [a, b] => match (normal(a), normal(b)) {
                    (Some(p), Some(q)) if shape.runs_up(a) == shape.runs_up(b) => -p.dot(q),
                    (Some(p), Some(q)) => p.dot(q),
                    _ => 1.0,
                },
                _ => 1.0,
            };
            prop_assert!((f64::from(shape.dihedral_cos[edge as usize]) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn numbering_does_not_matter(seed: u64, level in 0u32..2) {
        // A solid with some faces turned and some missing: manifold edges, borders and flips.
        let whole = random_winding(&unindexed(&icosphere(level)), seed);
        let mut random = Random::new(seed);
        let kept: Vec<[u32; 3]> = whole.triangles().iter().copied().filter(|_| random.below(5) > 0).collect();
        let mesh = Mesh::new(whole.positions().to_vec(), kept).unwrap();
        let (mixed, moved_to) = shuffled_vertices(&mesh, seed);
        let mut order: Vec<u32> = (0..mesh.triangles().len() as u32).collect();
        random.shuffle(&mut order);
        let triangles: Vec<[u32; 3]> = order.iter().map(|&f| mixed.triangles()[f as usize]).collect();
        let mixed = Mesh::new(mixed.positions().to_vec(), triangles).unwrap();

        let (before, after) = (prepare(&mesh).0, prepare(&mixed).0);
        // Name welded vertices by the least stored vertex of the unshuffled mesh in the group.
        let (weld_before, weld_after) = (weld(mesh.positions(), 0.0), weld(mixed.positions(), 0.0));
        let mut name = vec![u32::MAX; weld_after.count()];
        for (vertex, &to) in moved_to.iter().enumerate() {
            let group = &mut name[weld_after.of_vertex[to as usize] as usize];
            *group = (*group).min(vertex as u32);
        }
        prop_assert_eq!(
            stories(&before, |v| weld_before.first[v as usize], |f| f),
            stories(&after, |v| name[v as usize], |f| order[f as usize])
        );
    }

    #[test]
    fn a_mesh_welds_from_soup_to_what_it_was(seed: u64) {
        let soup = random_winding(&unindexed(&torus(9, 7, 1.0, 0.3)), seed);
        let mesh = random_winding(&torus(9, 7, 1.0, 0.3), seed);
        let (of_soup, of_mesh) = (prepare(&soup).1, prepare(&mesh).1);
        prop_assert_eq!(of_soup, of_mesh);
    }
}

proptest! {
    #[test]
    fn a_posed_shape_is_the_one_that_is_made_of_the_posed_meshes(
        faces in prop::collection::vec(prop::array::uniform3(0u32..9), 1..24),
        poses in prop::collection::vec(prop::collection::vec(prop::array::uniform3(-2i8..3), 9), 1..4),
        normals in prop::collection::vec(prop::array::uniform3(-2i8..3), 9),
        has_normals in any::<bool>(),
    ) {
        // Few places make faces without area, and many faces on an edge make wedges.
        let real = |rows: &[[i8; 3]]| -> Vec<[f32; 3]> { rows.iter().map(|row| row.map(f32::from)).collect() };
        let rest: Vec<[f32; 3]> = (0..9).map(|i| [i as f32, (i * i) as f32, 0.5]).collect();
        let worlds: Vec<Vec<[f32; 3]>> = poses.iter().map(|pose| real(pose)).collect();
        let of_face = vec![0; faces.len()];
        let normals = if has_normals { real(&normals) } else { Vec::new() };
        let mesh = |world| PlacedMesh {
            rest: &rest, world, normals: &normals, triangles: &faces, surfaces: &of_face, ..PlacedMesh::default()
        };
        let plain = |world| PlacedMesh { normals: &[], ..mesh(world) };
        let mut shape = surfaces(1);
        let (_, first) = add_posable_mesh(&mut shape, &mesh(&rest), 0.0);
        let (_, second) = add_posable_mesh(&mut shape, &plain(&rest), 0.0);
        let meshes = [first, second];
        for world in &worlds {
            let moved = [normals.clone(), Vec::new()].map(|normals| MeshPose { world: world.clone(), normals });
            set_pose(&mut shape, &meshes, &moved);
            shape.sanity_check();
            let mut fresh = surfaces(1);
            add_mesh(&mut fresh, &mesh(world), 0.0);
            add_mesh(&mut fresh, &plain(world), 0.0);
            prop_assert_eq!(&shape, &fresh);
        }
    }
}
