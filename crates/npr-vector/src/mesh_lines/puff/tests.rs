//! Arcs and sights against rays asked of every sphere.

use super::*;
use crate::mesh_lines::puff::cover::Arc;
use crate::mesh_lines::puff::silhouette::Silhouette;
use npr_core::camera::{Camera, Projection};
use proptest::prelude::*;

const SIZE: [u32; 2] = [400, 300];

fn projector(parallel: bool) -> Projector {
    let projection = match parallel {
        true => Projection::Parallel { height: 5.0 },
        false => Projection::Perspective { fov_y: 0.8 },
    };
    let camera = Camera {
        eye: [1.0, 2.0, 6.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection,
    };
    Projector::new(&camera, SIZE, ([-3.0; 3], [3.0; 3]))
}

/// How far behind a point the sight through it meets a sphere, told from the definition: along unit steps of the sight.
fn meets(projector: &Projector, point: DVec3, center: DVec3, radius: f64) -> Option<f64> {
    let start = match projector.is_perspective() {
        true => DVec3::ZERO,
        false => DVec3::new(point.x, point.y, -10.0),
    };
    let way = point - start;
    let direction = way.normalize();
    let offset = center - start;
    let along = offset.dot(direction);
    let beside = offset.length_squared() - along * along;
    (beside < radius * radius).then(|| along - (radius * radius - beside).sqrt() - way.length())
}

fn spheres_of(list: &[([f32; 3], f32)]) -> Vec<Sphere> {
    let sphere = |(center, radius): &([f32; 3], f32)| Sphere::new(*center, *radius);
    list.iter().map(sphere).collect()
}

fn any_spheres(most: usize) -> impl Strategy<Value = Vec<([f32; 3], f32)>> {
    prop::collection::vec((prop::array::uniform3(-1.5f32..1.5), 0f32..1.0), 1..most)
}

fn holds(arcs: &[Arc], angle: f64) -> bool {
    let turn = std::f64::consts::TAU;
    let inside = |arc: &Arc| {
        [angle, angle + turn]
            .iter()
            .any(|a| arc.from < *a && *a < arc.to)
    };
    arcs.iter().any(|arc| arc.is_closed || inside(arc))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// A place of a silhouette is drawn where no sphere stands before it, nor within the jump behind it.
    #[test]
    fn free_arcs_are_what_rays_to_all_spheres_say(
        parallel: bool, list in any_spheres(10), jump in 0.01f64..1.5,
        angles in prop::collection::vec(0f64..std::f64::consts::TAU, 20),
    ) {
        let (projector, spheres) = (projector(parallel), spheres_of(&list));
        let puffs = Puffs::new(&projector, SIZE, &spheres);
        for (index, own) in puffs.puffs.iter().enumerate() {
            let (silhouette, arcs) = (Silhouette::new(own, !parallel), puffs.free_arcs(index, jump));
            for angle in &angles {
                let point = silhouette.at(*angle);
                let (out, sight) = (point - own.center, if parallel { DVec3::Z } else { point.normalize() });
                prop_assert!(
                    (out.length() - own.radius).abs() < 1e-9 && out.dot(sight).abs() < 1e-9,
                    "sights touch the sphere at its silhouette"
                );
                let (mut is_free, mut is_close) = (true, false);
                for (number, sphere) in spheres.iter().enumerate() {
                    if number as u32 == own.number || sphere.radius == 0.0 {
                        continue;
                    }
                    let center = projector.from_eye(DVec3::from(sphere.center.map(f64::from)));
                    let radius = f64::from(sphere.radius);
                    let at = |radius: f64| meets(&projector, point, center, radius);
                    is_free &= at(radius).is_none_or(|entry| entry >= jump * own.radius);
                    is_close |= at(radius + 1e-6).is_some() != at(radius - 1e-6).is_some();
                    is_close |= at(radius).is_some_and(|entry| (entry - jump * own.radius).abs() < 1e-6);
                }
                prop_assert!(is_close || holds(&arcs, *angle) == is_free);
            }
        }
    }

    /// What the smoke hides, and how deep it is, as every sphere says.
    #[test]
    fn sights_are_those_of_all_spheres(
        parallel: bool, list in any_spheres(20), point in prop::array::uniform3(-2f32..2.0),
        place in (0f64..400.0, 0f64..300.0),
    ) {
        let (projector, spheres) = (projector(parallel), spheres_of(&list));
        let puffs = Puffs::new(&projector, SIZE, &spheres);
        let world = DVec3::from(point.map(f64::from));
        let from_eye = projector.from_eye(world);
        let entries = |point: DVec3| {
            let of = |sphere: &Sphere| {
                let center = projector.from_eye(DVec3::from(sphere.center.map(f64::from)));
                let entry = meets(&projector, point, center, f64::from(sphere.radius))?;
                (sphere.radius > 0.0).then_some(entry)
            };
            spheres.iter().filter_map(of).fold(f64::INFINITY, f64::min)
        };
        let [x, y] = projector.project(world);
        if (0.0..400.0).contains(&x) && (0.0..300.0).contains(&y) {
            let nearest = entries(from_eye);
            prop_assert!(nearest.abs() < 1e-5 || puffs.hide(world) == (nearest < 0.0));
        }
        let place = [place.0, place.1];
        let end = projector.from_eye(projector.unproject(place, 20.0));
        let nearest = entries(end);
        match puffs.depth_at(place) {
            Some(depth) => {
                let stretch = if parallel { 1.0 } else { end.z / end.length() };
                prop_assert!((depth - (20.0 + nearest * stretch)).abs() < 1e-6);
            }
            None => prop_assert!(nearest.is_infinite() || nearest > -1e-6),
        }
    }

    /// Between two cuts of a piece nothing changes.
    #[test]
    fn pieces_are_hidden_or_seen_from_cut_to_cut(
        parallel: bool, list in any_spheres(8), ends in prop::array::uniform2(prop::array::uniform3(-2f32..2.0)),
        shares in prop::collection::vec(0f64..1.0, 20),
    ) {
        let projector = projector(parallel);
        let puffs = Puffs::new(&projector, SIZE, &spheres_of(&list));
        let [a, b] = ends.map(|end| DVec3::from(end.map(f64::from)));
        let Some(piece) = Piece::new(&projector, SIZE, a, b) else { return Ok(()) };
        let mut cuts = puffs.cuts(&piece);
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        for share in shares {
            let next = cuts.partition_point(|cut| *cut < share).clamp(1, cuts.len() - 1);
            let [from, to] = [cuts[next - 1], cuts[next]];
            if to - from < 1e-5 || share - from < 1e-6 || to - share < 1e-6 {
                continue;
            }
            let hidden = |share: f64| puffs.hide(piece.world_at(&projector, share));
            prop_assert_eq!(hidden(share), hidden((from + to) * 0.5), "{} between {} and {}", share, from, to);
        }
    }

    /// Whatever is given, nothing panics and numbers stay numbers.
    #[test]
    fn hostile_spheres_do_no_harm(
        parallel: bool,
        list in prop::collection::vec(
            (
                prop::array::uniform3(prop_oneof![any::<f32>(), -2f32..2.0, Just(0.0)]),
                prop_oneof![any::<f32>(), 0f32..2.0, Just(1.0)],
            ),
            0..9,
        ),
    ) {
        let projector = projector(parallel);
        let mut list = list;
        list.extend([
            ([1.0, 2.0, 6.0], 1.0), ([1.0, 2.0, 6.0], 0.0), ([0.0; 3], 1.0), ([-0.0; 3], 1.0),
            ([f32::NAN; 3], 1.0),
        ]);
        let puffs = Puffs::new(&projector, SIZE, &spheres_of(&list));
        for index in 0..puffs.puffs.len() {
            for arc in puffs.free_arcs(index, 0.4) {
                prop_assert!(arc.from >= 0.0 && arc.to > arc.from && arc.to - arc.from <= 6.3);
            }
        }
        prop_assert!(puffs.depth_at([200.0, 150.0]).is_none_or(|depth| depth >= projector.near() - 1e-9));
        let piece = Piece::new(&projector, SIZE, DVec3::NEG_ONE, DVec3::ONE);
        prop_assert!(piece.is_none_or(|piece| puffs.cuts(&piece).iter().all(|cut| (0.0..=1.0).contains(cut))));
    }
}

#[test]
fn of_equal_spheres_one_is_outlined_and_the_eye_inside_sees_none() {
    let projector = projector(false);
    let twins = spheres_of(&[([0.0; 3], 1.0), ([0.0; 3], 1.0)]);
    let puffs = Puffs::new(&projector, SIZE, &twins);
    assert_eq!(puffs.puffs.len(), 1);
    assert!(puffs.free_arcs(0, 0.4)[0].is_closed);
    let around = spheres_of(&[([1.0, 2.0, 6.0], 2.0)]);
    assert!(Puffs::new(&projector, SIZE, &around).is_empty());
}

#[test]
fn a_heap_of_puffs_in_one_place_takes_no_time() {
    let projector = projector(false);
    let puff = |i: u32| {
        let shift = |k: u32| ((i * 7 + k * 13) % 100) as f32 * 1e-3;
        Sphere::new([shift(0), shift(1), shift(2)], 0.5 + shift(3))
    };
    let heap: Vec<Sphere> = (0..20_000).map(puff).collect();
    let puffs = Puffs::new(&projector, SIZE, &heap);
    let arcs: usize = (0..puffs.puffs.len())
        .map(|i| puffs.free_arcs(i, 0.4).len())
        .sum();
    assert!(arcs > 0 && arcs < 2000, "{arcs} arcs");
}
