//! Creases that go on along edges that fold less: ridges whose fold changes on the way.

use npr_core::crease::{CreaseFrom, Creases};
use npr_core::line_kind::KindSet;
use npr_mesh::Mesh;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::shape_of;
use npr_vector::mesh_lines::feature::features;
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Angles in degrees from which an edge is a crease, and from which a crease goes on.
const ANGLES_DEG: [f32; 2] = [40.0, 25.0];

/// Length of a piece of the ridge, in breadths of its sides: folds across it are slight.
const LONG: f32 = 12.0;

/// A ridge along x whose sides hang down by the depths at its stations.
fn ridge(depths: &[f32]) -> HalfEdgeMesh {
    let rows = depths.iter().enumerate().flat_map(|(i, depth)| {
        let x = LONG * i as f32;
        [[x, -1.0, -depth], [x, 0.0, 0.0], [x, 1.0, -depth]]
    });
    let pieces = 0..depths.len() as u32 - 1;
    let triangles = pieces.flat_map(|i| [3 * i, 3 * i + 1]).flat_map(|corner| {
        [
            [corner, corner + 3, corner + 1],
            [corner + 1, corner + 3, corner + 4],
        ]
    });
    shape_of(&Mesh::new(rows.collect(), triangles.collect()).expect("sound"))
}

/// The pieces of the ridge, from its start, as edges of the shape.
fn pieces(shape: &HalfEdgeMesh, count: usize) -> Vec<u32> {
    let place = |vertex: u32| shape.point(vertex);
    let is_piece = |edge: &u32, i: usize| {
        let mut xs = shape.ends(*edge).map(|vertex| place(vertex).x);
        xs.sort_by(f64::total_cmp);
        let on_ridge = shape
            .ends(*edge)
            .iter()
            .all(|vertex| place(*vertex).y == 0.0);
        on_ridge && xs[0] == f64::from(LONG) * i as f64
    };
    let edges = || 0..shape.edge_count() as u32;
    (0..count)
        .map(|i| edges().find(|edge| is_piece(edge, i)).expect("a piece"))
        .collect()
}

/// The creases among edges with their numbers of chains.
fn creases(shape: &HalfEdgeMesh, angles_deg: [f32; 2]) -> (BTreeSet<u32>, usize) {
    let [angle, weak] = angles_deg.map(f32::to_radians);
    let graph = features(
        shape,
        Creases::with_slack(angle, angle - weak, CreaseFrom::Faces),
    );
    graph.sanity_check();
    let is_crease = |node: &u32| graph.nodes[*node as usize].flags & KindSet::CREASE != 0;
    let chains = graph.chains();
    let chains = chains.iter().filter(|chain| chain.iter().any(&is_crease));
    let nodes = chains.clone().flatten().filter(|node| is_crease(node));
    (
        nodes.map(|node| graph.nodes[*node as usize].edge).collect(),
        chains.count(),
    )
}

/// The pieces that are drawn: those that fold enough, and rows of those that fold by the lower angle between two such,
/// or between one and an end of the ridge, where the border runs. Beside one such, rows of at most two are drawn too,
/// as all pieces are as long as each other.
fn expected(folds_deg: &[f64]) -> Vec<bool> {
    let [angle, weak] = ANGLES_DEG.map(f64::from);
    let is_strong = |i: usize| folds_deg[i] > angle;
    let is_drawn = |i: usize| {
        let before = (0..i)
            .rev()
            .find(|j| is_strong(*j) || folds_deg[*j] <= weak);
        let after = (i + 1..folds_deg.len()).find(|j| is_strong(*j) || folds_deg[*j] <= weak);
        let leads = |to: Option<usize>| to.is_none_or(is_strong);
        let starts = [before, after].into_iter().flatten().any(is_strong);
        let first = before.map_or(0, |j| j + 1);
        let is_short = after.unwrap_or(folds_deg.len()) - first <= 2;
        let is_row = starts && (is_short || leads(before) && leads(after));
        is_strong(i) || folds_deg[i] > weak && is_row
    };
    (0..folds_deg.len()).map(is_drawn).collect()
}

proptest! {
    /// A ridge is drawn where it folds enough, and between while it folds by the lower angle, in one line each.
    #[test]
    fn a_ridge_goes_on_while_it_folds_by_the_lower_angle(depths in prop::collection::vec(0.05..0.6f32, 2..24)) {
        let shape = ridge(&depths);
        let pieces = pieces(&shape, depths.len() - 1);
        let fold_deg = |edge: &u32| {
            f64::from(shape.fold_cos(*edge, CreaseFrom::Faces)).acos().to_degrees()
        };
        let folds: Vec<f64> = pieces.iter().map(fold_deg).collect();
        prop_assume!(ANGLES_DEG.iter().all(|angle| {
            folds.iter().all(|fold| (fold - f64::from(*angle)).abs() > 0.01)
        }));
        let drawn = expected(&folds);
        let (found, chain_count) = creases(&shape, ANGLES_DEG);
        let wanted = pieces.iter().zip(&drawn).filter(|(_, is_drawn)| **is_drawn);
        prop_assert_eq!(found, wanted.map(|(edge, _)| *edge).collect::<BTreeSet<u32>>());
        let starts = drawn.iter().enumerate().filter(|(i, is_drawn)| **is_drawn && (*i == 0 || !drawn[i - 1]));
        prop_assert_eq!(chain_count, starts.count());
    }

    /// Every crease of the higher angle alone is one, and every other one is a crease of the lower angle.
    #[test]
    fn creases_lie_between_those_of_both_angles(count in 1_usize..60, seed in any::<u64>()) {
        let shape = shape_of(&npr_mesh::testing::random_soup(count, seed));
        let [high, low] = ANGLES_DEG;
        let of = |angles| creases(&shape, angles).0;
        let between = of([high, low]);
        prop_assert!(of([high; 2]).is_subset(&between));
        prop_assert!(between.is_subset(&of([low; 2])));
    }
}
