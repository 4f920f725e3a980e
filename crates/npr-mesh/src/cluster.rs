//! Groups of points joined by short steps.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::isolated::not_alone;
use crate::union_find::UnionFind;

/// A cube of the grid, and the points in it as a range of the sorted points.
struct Cell {
    place: [i64; 3],
    members: Range<usize>,
}

/// How much longer than the tolerance a step between crowded cells may be, as a fraction.
///
/// Smaller takes more comparisons between crowds: their number grows with the inverse fourth power.
const SLACK: f64 = 0.125;

/// Comparisons between the points of two cells up to which all are made.
const EXACT_COMPARISONS: usize = 1024;

/// The first point of each point's cluster: single linkage with steps up to `tolerance` diagonals.
///
/// Points that are not finite stay alone. Between cells that hold dozens of points, steps up to [`SLACK`]
/// longer may count; which do depends on positions alone, not on their order.
///
/// Most points of a mesh have no other within a step; [`not_alone`] puts them aside in O(n). The rest is
/// sorted into a grid, O(k log k), whose cells are so small that all points of one lie within a step,
/// which leaves whole cells to be joined with those at most two away.
pub(crate) fn clusters(points: &[[f32; 3]], tolerance: f32) -> Vec<u32> {
    // Leave points that are no numbers alone.
    let mut leaders: Vec<u32> = (0..points.len() as u32).collect();
    let finite: Vec<u32> = (0..points.len() as u32)
        .filter(|&i| points[i as usize].iter().all(|v| v.is_finite()))
        .collect();
    let boxed: Vec<[f32; 3]> = finite.iter().map(|&i| points[i as usize]).collect();

    // Measure the step as a share of the diagonal.
    let (low, high) = bounding_box(&boxed);
    let step = low.distance(high) * f64::from(tolerance);
    if step == 0.0 {
        return leaders;
    }

    // Put aside the many points that have no other near.
    let boxed: Vec<DVec3> = boxed
        .par_iter()
        .map(|p| DVec3::from_array(p.map(f64::from)) - low)
        .collect();
    let close = not_alone(&boxed, low.distance(high), step * (1.0 + SLACK));

    // Join the rest, and let each name its leader.
    let close_points: Vec<DVec3> = close.iter().map(|&i| boxed[i as usize]).collect();
    let number = |i: u32| finite[close[i as usize] as usize];
    for (member, leader) in (0..).zip(join_close(&close_points, step)) {
        leaders[number(member) as usize] = number(leader);
    }
    leaders
}

/// The first point of each point's cluster, for points from the lowest corner of their box.
fn join_close(points: &[DVec3], step: f64) -> Vec<u32> {
    let order = sorted_by_place(points, step / 3.0_f64.sqrt());
    let cells = cells(&order);
    let joined = join_cells(points, &order, &cells, step);
    leaders(points.len(), &order, &cells, joined)
}

/// Every point's cell and number, sorted.
fn sorted_by_place(points: &[DVec3], side: f64) -> Vec<([i64; 3], u32)> {
    let place = |point: DVec3| (point / side).floor().to_array().map(|v| v as i64);
    let mut order: Vec<_> = points
        .par_iter()
        .enumerate()
        .map(|(i, &point)| (place(point), i as u32))
        .collect();
    order.par_sort_unstable();
    order
}

fn cells(order: &[([i64; 3], u32)]) -> Vec<Cell> {
    let mut start = 0;
    order
        .chunk_by(|a, b| a.0 == b.0)
        .map(|run| {
            let members = start..start + run.len();
            start = members.end;
            Cell {
                place: run[0].0,
                members,
            }
        })
        .collect()
}

/// Unites cells that hold points within one step of each other.
fn join_cells(points: &[DVec3], order: &[([i64; 3], u32)], cells: &[Cell], step: f64) -> UnionFind {
    let mut sets = UnionFind::new(cells.len());
    let sorted: Vec<DVec3> = order
        .iter()
        .map(|&(_, point)| points[point as usize])
        .collect();
    for row in ROWS {
        for_neighbours(cells, row, |a, b| {
            if sets.find(a) != sets.find(b) {
                let pair = [a, b].map(|cell| &cells[cell as usize]);
                let members = pair.map(|cell| &sorted[cell.members.clone()]);
                if within_step(pair.map(|cell| cell.place), members, step) {
                    sets.unite(a, b);
                }
            }
        });
    }
    sets
}

/// Whether a point of one cell lies within a step of a point of the other, or little more between crowds.
fn within_step(places: [[i64; 3]; 2], [a, b]: [&[DVec3]; 2], step: f64) -> bool {
    if a.len().saturating_mul(b.len()) <= EXACT_COMPARISONS {
        return any_within(a, b, step);
    }
    let apart = |axis: &usize| places[0][*axis] != places[1][*axis];
    let axis = (0..3).find(apart).unwrap_or(0);
    let towards_b = if places[0][axis] < places[1][axis] {
        1.0
    } else {
        -1.0
    };
    let near_b = outermost(a, axis, towards_b, step);
    let near_a = outermost(b, axis, -towards_b, step);
    any_within(&near_b, &near_a, step * (1.0 + SLACK))
}

fn any_within(a: &[DVec3], b: &[DVec3], reach: f64) -> bool {
    let close = |p: &DVec3| b.iter().any(|q| p.distance_squared(*q) <= reach * reach);
    a.iter().any(close)
}

/// The point farthest towards `side` of every thin column along `axis`.
///
/// What lies beyond the cell is no farther from it than from any other point of the column, but for the
/// column's width. The diagonals of two columns make up [`SLACK`].
fn outermost(points: &[DVec3], axis: usize, side: f64, step: f64) -> Vec<DVec3> {
    let width = SLACK * step / 8.0_f64.sqrt();
    let across = [(axis + 1) % 3, (axis + 2) % 3];
    let mut columns: Vec<([i64; 2], DVec3)> = points
        .iter()
        .map(|&p| (across.map(|i| (p[i] / width).floor() as i64), p))
        .collect();
    columns.sort_unstable_by(|(a, p), (b, q)| {
        let inwards = (side * q[axis]).total_cmp(&(side * p[axis]));
        let ties = across.map(|i| p[i].total_cmp(&q[i]));
        a.cmp(b).then(inwards).then(ties[0]).then(ties[1])
    });
    columns.dedup_by_key(|(column, _)| *column);
    columns.into_iter().map(|(_, point)| point).collect()
}

/// Offsets in x and y of the rows up to two cells away, one of each opposite pair.
const ROWS: [[i64; 2]; 13] = [
    [0, 0],
    [0, 1],
    [0, 2],
    [1, -2],
    [1, -1],
    [1, 0],
    [1, 1],
    [1, 2],
    [2, -2],
    [2, -1],
    [2, 0],
    [2, 1],
    [2, 2],
];

/// Visits every cell with its neighbours in one row, up to two cells away.
///
/// Cells are sorted, so the neighbourhood only moves forward: one linear sweep.
fn for_neighbours(cells: &[Cell], row: [i64; 2], mut visit: impl FnMut(u32, u32)) {
    let mut start = 0;
    for (here, cell) in cells.iter().enumerate() {
        let [x, y, z] = [
            cell.place[0] + row[0],
            cell.place[1] + row[1],
            cell.place[2],
        ];
        while start < cells.len() && cells[start].place < [x, y, z - 2] {
            start += 1;
        }
        let near = cells[start..]
            .iter()
            .take_while(|other| other.place <= [x, y, z + 2]);
        (start..)
            .zip(near)
            .for_each(|(there, _)| visit(here as u32, there as u32));
    }
}

/// The smallest point number of every point's cluster.
fn leaders(
    count: usize,
    order: &[([i64; 3], u32)],
    cells: &[Cell],
    mut joined: UnionFind,
) -> Vec<u32> {
    let mut smallest = vec![u32::MAX; cells.len()];
    let mut set_of_point = vec![0; count];
    for (cell, Cell { members, .. }) in cells.iter().enumerate() {
        let set = joined.find(cell as u32);
        for &(_, point) in &order[members.clone()] {
            set_of_point[point as usize] = set;
            smallest[set as usize] = smallest[set as usize].min(point);
        }
    }
    set_of_point
        .iter()
        .map(|&set| smallest[set as usize])
        .collect()
}

/// Lowest and highest corner of the axis-aligned box around `positions`; zeros for none.
fn bounding_box(positions: &[[f32; 3]]) -> (DVec3, DVec3) {
    let mut points = positions
        .iter()
        .map(|position| DVec3::from_array(position.map(f64::from)));
    let Some(first) = points.next() else {
        return (DVec3::ZERO, DVec3::ZERO);
    };
    points.fold((first, first), |(low, high), point| {
        (low.min(point), high.max(point))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;
    use proptest::prelude::*;

    /// Joins every pair within a step.
    fn clusters_by_comparison(points: &[[f32; 3]], tolerance: f32) -> Vec<u32> {
        let (low, high) = bounding_box(points);
        let step = low.distance(high) * f64::from(tolerance);
        let point = |i: u32| DVec3::from_array(points[i as usize].map(f64::from)) - low;
        let count = points.len() as u32;
        let mut sets = UnionFind::new(points.len());
        for a in 0..count {
            (0..a)
                .filter(|&b| point(a).distance(point(b)) <= step)
                .for_each(|b| sets.unite(a, b));
        }
        (0..count).map(|member| sets.find(member)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn agrees_with_joining_all_pairs(
            points in prop::collection::vec(prop::array::uniform3(-1.0f32..1.0), 0..120),
            tolerance in 0.01f32..0.2,
        ) {
            prop_assert_eq!(clusters(&points, tolerance), clusters_by_comparison(&points, tolerance));
        }
    }

    /// A few crowds about a step apart, and a far point that sets the scale: the tolerance gives steps of 1.
    fn crowds(seed: u64, size: usize) -> (Vec<[f32; 3]>, f32) {
        let mut random = Random::new(seed);
        let mut points = vec![[0.0; 3], [1000.0, 0.0, 0.0]];
        for _ in 0..2 + random.below(4) {
            let centre = [0; 3].map(|_| 4.0 * random.unit());
            let width = 0.5 * random.unit();
            points.extend((0..size).map(|_| centre.map(|v| v + width * random.unit())));
        }
        let (low, high) = bounding_box(&points);
        (points, (1.0 / low.distance(high)) as f32)
    }

    /// Whether points of one cluster in `finer` are also of one in `coarser`.
    fn refines(finer: &[u32], coarser: &[u32]) -> bool {
        let joined = |(&leader, here): (&u32, &u32)| coarser[leader as usize] == *here;
        finer.iter().zip(coarser).all(joined)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn crowds_join_within_the_slack(seed: u64, size in 20usize..80) {
            let (points, tolerance) = crowds(seed, size);
            let found = clusters(&points, tolerance);
            let widest = tolerance * (1.0 + SLACK as f32);
            prop_assert!(refines(&clusters_by_comparison(&points, tolerance), &found));
            prop_assert!(refines(&found, &clusters_by_comparison(&points, widest)));
        }

        #[test]
        fn order_within_crowds_does_not_matter(seed: u64, size in 20usize..80) {
            let (points, tolerance) = crowds(seed, size);
            let mut order: Vec<usize> = (0..points.len()).collect();
            Random::new(seed).shuffle(&mut order);
            let mixed: Vec<[f32; 3]> = order.iter().map(|&i| points[i]).collect();
            let (before, after) = (clusters(&points, tolerance), clusters(&mixed, tolerance));
            for (moved, &leader) in after.iter().enumerate() {
                prop_assert_eq!(before[order[moved]], before[order[leader as usize]]);
            }
            let leaders = |of: &[u32]| of.iter().collect::<std::collections::BTreeSet<_>>().len();
            prop_assert_eq!(leaders(&before), leaders(&after));
        }
    }

    /// Comparing all pairs would take hours: neighbouring crowds that never touch.
    #[test]
    fn a_million_points_in_few_cells_do_not_take_forever() {
        let mut random = Random::new(7);
        let mut points = vec![[1000.0, 0.0, 0.0]];
        for crowd in 0..8u8 {
            let corner = [0, 1, 2].map(|axis| if crowd >> axis & 1 == 1 { 1.4 } else { 0.0 });
            points.extend((0..125_000).map(|_| corner.map(|v| v + 0.2 * random.unit())));
        }
        let (low, high) = bounding_box(&points);
        let found = clusters(&points, (1.0 / low.distance(high)) as f32);
        let leaders: std::collections::BTreeSet<u32> = found.into_iter().collect();
        assert_eq!(leaders.len(), 9);
    }

    #[test]
    fn points_that_are_not_finite_stay_alone() {
        let (nan, inf) = (f32::NAN, f32::INFINITY);
        let points = [
            [nan; 3],
            [0.0; 3],
            [inf, 0.0, 0.0],
            [1e-9, 0.0, 0.0],
            [1.0; 3],
            [nan; 3],
        ];
        assert_eq!(clusters(&points, 1e-6), [0, 1, 2, 1, 4, 5]);
    }

    #[test]
    fn a_chain_of_short_steps_is_one_cluster() {
        let chain: Vec<[f32; 3]> = (0..50).rev().map(|i| [i as f32, 0.0, 0.0]).collect();
        assert!(
            clusters(&chain, 1.01 / 49.0)
                .iter()
                .all(|&leader| leader == 0)
        );
        assert!(
            clusters(&chain, 0.99 / 49.0)
                .iter()
                .enumerate()
                .all(|(i, &leader)| leader == i as u32)
        );
    }

    #[test]
    fn the_finest_tolerance_stays_inside_the_grid() {
        let points = [[0.0; 3], [f32::MAX; 3], [1e-45, 0.0, 0.0]];
        assert_eq!(clusters(&points, 1e-12), [0, 1, 0]);
    }
}
