//! Narrow roundings between flat sides are drawn as one line, limbs of coarse figures are not.

use npr_core::crease::{CreaseFrom, Creases};
use npr_core::line_kind::KindSet;
use npr_core::math;
use npr_mesh::Mesh;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::shape_of;
use npr_vector::mesh_lines::feature::features;
use proptest::prelude::*;

/// Angle in degrees from which an edge is a crease.
const CREASE_DEG: f32 = 40.0;

/// Length of the profiles, in pieces of one unit.
const PIECES: u32 = 4;

/// A sheet that stands on a profile of points in y and z, along x; its normals run on over all edges.
fn sheet(profile: &[[f32; 2]]) -> HalfEdgeMesh {
    let rows = 0..=PIECES;
    let positions = rows.flat_map(|x| profile.iter().map(move |[y, z]| [x as f32, *y, *z]));
    let count = profile.len() as u32;
    let corners = (0..PIECES).flat_map(|x| (0..count - 1).map(move |i| x * count + i));
    let triangles = corners.flat_map(|a| {
        let [b, c, d] = [a + 1, a + count, a + count + 1];
        [[a, c, b], [b, c, d]]
    });
    let mesh = Mesh::new(positions.collect(), triangles.collect()).expect("sound");
    let mut shape = shape_of(&mesh);
    shape.normals_cos = vec![1.0; shape.edge_count()];
    shape
}

/// A flat side of length 1, an arc of a radius that turns by an angle in steps, and another flat side.
fn rounding(turn_deg: f32, radius: f32, steps: u32) -> Vec<[f32; 2]> {
    let turn = turn_deg.to_radians();
    let at = |angle: f32| [radius * math::sin(angle), radius * (math::cos(angle) - 1.0)];
    let arc = (0..=steps).map(|i| at(turn * i as f32 / steps as f32));
    let [y, z] = at(turn);
    let far = [y + math::cos(turn), z - math::sin(turn)];
    std::iter::once([-1.0, 0.0])
        .chain(arc)
        .chain([far])
        .collect()
}

/// The middles of the creases that run along x, in y and z, and the number of chains of creases.
fn creases(shape: &HalfEdgeMesh, of: Creases) -> (Vec<[f64; 2]>, usize) {
    let graph = features(shape, of);
    graph.sanity_check();
    let is_crease = |node: &u32| graph.nodes[*node as usize].flags & KindSet::CREASE != 0;
    let chains = graph.chains();
    let count = chains
        .iter()
        .filter(|chain| chain.iter().any(is_crease))
        .count();
    let edges = (0..graph.nodes.len() as u32).filter(is_crease);
    let middle = |node: u32| {
        let point = shape.point_on(graph.nodes[node as usize].edge, 0.5);
        [point.y, point.z]
    };
    (edges.map(middle).collect(), count)
}

fn rounded(width: f32) -> Creases {
    Creases::over(CREASE_DEG.to_radians(), CreaseFrom::Normals).with_roundings(width)
}

proptest! {
    #[test]
    fn a_narrow_rounding_is_one_line_along_its_middle(
        turn_deg in 50.0f32..100.0,
        steps in 2u32..7,
        width in 0.05f32..0.2,
        share in 0.1f32..0.6,
        bends_back: bool,
    ) {
        // The arc takes a share of the width, so that all of its turn lies within.
        let radius = share * width / turn_deg.to_radians();
        let mut profile = rounding(turn_deg, radius, steps);
        if bends_back {
            profile.iter_mut().for_each(|[_, z]| *z = -*z);
        }
        let (middles, chains) = creases(&sheet(&profile), rounded(width));
        prop_assert_eq!((middles.len() as u32, chains), (PIECES, 1));

        // All pieces lie on one edge of the arc, half a step from its middle at most.
        let half = 0.5 * turn_deg.to_radians();
        let side = if bends_back { -1.0 } else { 1.0 };
        let middle = [radius * math::sin(half), side * radius * (math::cos(half) - 1.0)].map(f64::from);
        let step = f64::from(radius * turn_deg.to_radians()) / f64::from(steps);
        for [y, z] in middles {
            let off = (y - middle[0]).hypot(z - middle[1]);
            prop_assert!(off <= 0.51 * step, "{off} of {step}");
        }
    }

    #[test]
    fn wide_and_slight_roundings_have_no_line(
        turn_deg in 10.0f32..100.0,
        steps in 3u32..9,
        width in 0.05f32..0.2,
        share in 0.1f32..8.0,
    ) {
        let is_slight = turn_deg < 0.9 * CREASE_DEG;
        // An edge stands for half of the turn of each face beside it.
        let within = turn_deg * (1.0 / share + 1.0 / steps as f32);
        prop_assume!(is_slight || within < 0.95 * CREASE_DEG);
        prop_assume!(turn_deg / (steps as f32) < CREASE_DEG);
        let radius = share * width / turn_deg.to_radians();
        let found = creases(&sheet(&rounding(turn_deg, radius, steps)), rounded(width));
        prop_assert_eq!(found, (vec![], 0));
    }

    #[test]
    fn limbs_that_shading_makes_round_have_no_line(sides in 5u32..12, width in 0.01f32..1.0) {
        // A tube of flat sides, each as wide as the widest rounding or wider, folds much and shades as round.
        let tube: Vec<[f32; 2]> = (0..=sides)
            .map(|i| {
                let angle = std::f32::consts::TAU * i as f32 / sides as f32;
                let radius = 0.5 * width / math::sin(std::f32::consts::PI / sides as f32);
                [radius * math::cos(angle), radius * math::sin(angle)]
            })
            .collect();
        prop_assert_eq!(creases(&sheet(&tube), rounded(width)), (vec![], 0));
    }
}

#[test]
fn faces_that_fold_hard_are_creases_however_smooth_their_normals() {
    let fold = |deg: f32| sheet(&[[-1.0, 0.0], [0.0, 0.0], rounding(deg, 0.0, 1)[3]]);
    let normals = Creases::over(CREASE_DEG.to_radians(), CreaseFrom::Normals);
    let hard = normals.with_hard_folds(75.0_f32.to_radians());
    for (deg, is_drawn) in [(60.0, false), (74.0, false), (76.0, true), (150.0, true)] {
        let (middles, _) = creases(&fold(deg), hard);
        assert_eq!(
            middles.len() as u32,
            if is_drawn { PIECES } else { 0 },
            "{deg}"
        );
        assert_eq!(creases(&fold(deg), normals).1, 0, "{deg}");
    }
    assert_eq!(
        creases(&fold(179.0), normals.with_hard_folds(std::f32::consts::PI)).1,
        0
    );
}

#[test]
fn short_rows_are_grain() {
    // A rounding as long as it may be wide, and one four times as long.
    let profile = rounding(90.0, 0.05, 3);
    let shape = sheet(&profile);
    let length = PIECES as f32;
    assert_eq!(creases(&shape, rounded(0.9 * length / 4.0)).1, 1);
    assert_eq!(creases(&shape, rounded(1.1 * length / 4.0)).1, 0);
}
