//! An order for pen plotters: which line next, and from which end, so that the lifted pen travels little.
//!
//! A greedy walk takes the nearest free end each time. It is then improved by turning round runs of lines (2-opt) and
//! by moving short runs elsewhere (Or-opt), among near neighbours only [Johnson, McGeoch 1997]. Effort is counted in
//! steps, never in time, so results are the same everywhere.

use crate::near::Grid;
use npr_core::geometry::NONE;
use npr_vector::mesh_lines::run::distance;
use std::collections::BTreeMap;

/// A line that the pen draws in one go.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// Its points; the last of a closed line runs on to the first.
    pub points: Vec<[f64; 2]>,
    /// Whether it may be drawn from any of its points.
    pub closed: bool,
}

/// One line in the order of drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Visit {
    /// Index of the route.
    pub route: usize,
    /// Whether it is drawn from its last point to its first.
    pub reversed: bool,
    /// The point at which a closed route starts.
    pub start: usize,
}

impl Visit {
    /// The points of the route, or values that belong to them, in the order of drawing.
    pub fn walk<T: Clone>(&self, points: &[T]) -> Vec<T> {
        let mut walk = points.to_vec();
        walk.rotate_left(self.start.min(points.len().saturating_sub(1)));
        if self.reversed {
            walk.reverse();
        }
        walk
    }
}

/// Number of neighbours of a line's end that are tried when the order is improved.
const NEIGHBOURS: usize = 10;

/// Most points of a closed line that the greedy walk may start from.
const STARTS: usize = 24;

/// Most lines that Or-opt moves together.
const RUN: usize = 3;

/// Most steps of improvement per line; a step tries or moves a line.
const EFFORT: usize = 4_000;

/// Travel of the lifted pen from line to line, in the unit of the points; the way to the first line is not counted.
pub fn travel(routes: &[Route], order: &[Visit]) -> f64 {
    order
        .windows(2)
        .map(|pair| distance(ends(routes, &pair[0])[1], ends(routes, &pair[1])[0]))
        .sum()
}

/// An order of drawing in which the lifted pen travels little; every route occurs once.
///
/// Never longer than the given order. Routes without points come last. O(n log n) in practice, bounded by a fixed
/// number of steps per route.
pub fn order(routes: &[Route]) -> Vec<Visit> {
    let plain = |route: usize| Visit {
        route,
        reversed: false,
        start: 0,
    };
    let (drawn, empty): (Vec<usize>, Vec<usize>) =
        (0..routes.len()).partition(|i| is_sound(&routes[*i]));
    let given: Vec<Visit> = drawn.iter().map(|i| plain(*i)).collect();
    let mut best = given.clone();
    if given.len() > 1 {
        let mut found = greedy(routes, &drawn);
        // Closed routes that begin elsewhere make room for further improvement.
        let turns = given.iter().any(|visit| routes[visit.route].closed);
        for _ in 0..if turns { 3 } else { 1 } {
            found = improve(routes, found);
            turn_closed(routes, &mut found);
            if travel(routes, &found) < travel(routes, &best) {
                best.clone_from(&found);
            } else {
                break;
            }
        }
    }
    best.extend(empty.into_iter().map(plain));
    best
}

fn is_sound(route: &Route) -> bool {
    !route.points.is_empty() && route.points.iter().flatten().all(|v| v.is_finite())
}

/// An order of drawing that keeps the routes of a group together: order within groups, then order of the groups.
///
/// `groups` names the group of every route. Groups may be drawn backwards.
pub fn order_in_groups(routes: &[Route], groups: &[u32]) -> Vec<Visit> {
    let mut members: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (route, group) in groups.iter().enumerate().take(routes.len()) {
        members.entry(*group).or_default().push(route);
    }
    let runs: Vec<Vec<Visit>> = members
        .values()
        .map(|members| {
            let own: Vec<Route> = members.iter().map(|i| routes[*i].clone()).collect();
            let to_all = |visit: Visit| Visit {
                route: members[visit.route],
                ..visit
            };
            order(&own).into_iter().map(to_all).collect()
        })
        .collect();
    // A whole group is to the pen what a line is: it comes down at one end and lifts at the other.
    let outlines: Vec<Route> = runs.iter().map(|run| as_route(routes, run)).collect();
    order(&outlines)
        .iter()
        .flat_map(|visit| {
            let mut run = runs[visit.route].clone();
            if visit.reversed {
                turn_round(routes, &mut run);
            }
            run
        })
        .collect()
}

/// A line from where the pen first comes down to where it lifts last.
fn as_route(routes: &[Route], run: &[Visit]) -> Route {
    let sound = || run.iter().filter(|visit| is_sound(&routes[visit.route]));
    let ends = |visit: &Visit| ends(routes, visit);
    let points = match (sound().next().map(ends), sound().next_back().map(ends)) {
        (Some([start, _]), Some([_, end])) => vec![start, end],
        _ => Vec::new(),
    };
    Route {
        points,
        closed: false,
    }
}

fn turn_round(routes: &[Route], run: &mut [Visit]) {
    run.reverse();
    for visit in run {
        visit.reversed ^= !routes[visit.route].closed;
    }
}

/// The places where the pen comes down and where it lifts.
fn ends(routes: &[Route], visit: &Visit) -> [[f64; 2]; 2] {
    let route = &routes[visit.route];
    if route.closed {
        return [route.points[visit.start]; 2];
    }
    let (first, last) = (route.points[0], route.points[route.points.len() - 1]);
    if visit.reversed {
        [last, first]
    } else {
        [first, last]
    }
}

/// Takes the nearest free end each time, from the first route's first point on.
fn greedy(routes: &[Route], drawn: &[usize]) -> Vec<Visit> {
    let mut doors: Vec<Visit> = drawn.iter().flat_map(|i| doors(routes, *i)).collect();
    let mut places: Vec<[f64; 2]> = doors.iter().map(|d| ends(routes, d)[0]).collect();
    let mut grid = Grid::new(&places);
    let mut used = vec![false; routes.len()];
    let mut order: Vec<Visit> = Vec::with_capacity(drawn.len());
    let mut pen = places[0];
    let mut since = 0;
    while order.len() < drawn.len() {
        // With half of the places gone the search would cross ever more empty cells.
        if since > 64 && 2 * since > drawn.len() - order.len() {
            doors.retain(|door| !used[door.route]);
            places = doors.iter().map(|d| ends(routes, d)[0]).collect();
            grid = Grid::new(&places);
            since = 0;
        }
        let free = |item: u32| !used[doors[item as usize].route];
        let Some(next) = grid.nearest(&places, pen, 1, free).first().copied() else {
            break;
        };
        let door = doors[next as usize];
        used[door.route] = true;
        pen = ends(routes, &door)[1];
        order.push(door);
        since += 1;
    }
    order
}

/// The possible starts of a route: both ends, or points spread over a closed one.
fn doors(routes: &[Route], route: usize) -> Vec<Visit> {
    let count = routes[route].points.len();
    if routes[route].closed {
        let step = count.div_ceil(STARTS);
        (0..count)
            .step_by(step)
            .map(|start| Visit {
                route,
                reversed: false,
                start,
            })
            .collect()
    } else {
        [false, true]
            .map(|reversed| Visit {
                route,
                reversed,
                start: 0,
            })
            .to_vec()
    }
}

/// Lets every closed route start where that costs least between its neighbours.
fn turn_closed(routes: &[Route], order: &mut [Visit]) {
    for k in 0..order.len() {
        let route = &routes[order[k].route];
        if !route.closed {
            continue;
        }

        // Measure the way from the line before and to the line after.
        let before = k.checked_sub(1).map(|i| ends(routes, &order[i])[1]);
        let after = order.get(k + 1).map(|visit| ends(routes, visit)[0]);
        let cost = |p: &[f64; 2]| {
            before.map_or(0.0, |q| distance(*p, q)) + after.map_or(0.0, |q| distance(*p, q))
        };

        // Start where that is shortest.
        let mut best = (cost(&route.points[order[k].start]), order[k].start);
        for (start, point) in route.points.iter().enumerate() {
            let cost = cost(point);
            if cost < best.0 {
                best = (cost, start);
            }
        }
        order[k].start = best.1;
        order[k].reversed = false;
    }
}

/// An order under improvement.
struct Tour<'a> {
    routes: &'a [Route],
    order: Vec<Visit>,
    /// Place of each route in the order.
    at: Vec<u32>,
    /// Steps left.
    effort: usize,
}

/// Improves an order by 2-opt and Or-opt until nothing helps, or the effort is spent.
fn improve(routes: &[Route], order: Vec<Visit>) -> Vec<Visit> {
    let mut at = vec![NONE; routes.len()];
    for (k, visit) in order.iter().enumerate() {
        at[visit.route] = k as u32;
    }
    // Both ends of every route; those of a closed one lie at its present start.
    let places: Vec<[f64; 2]> = order
        .iter()
        .flat_map(|visit| {
            let [a, b] = ends(routes, visit);
            if visit.reversed { [b, a] } else { [a, b] }
        })
        .collect();
    let grid = Grid::new(&places);
    let ids: Vec<usize> = order.iter().map(|visit| visit.route).collect();
    let near: Vec<Vec<u32>> = (0..places.len())
        .map(|end| {
            let others = |item: u32| item as usize / 2 != end / 2;
            grid.nearest(&places, places[end], NEIGHBOURS, others)
        })
        .collect();
    let mut tour = Tour {
        routes,
        effort: 1_000_000 + EFFORT * order.len(),
        order,
        at,
    };
    let mut improved = true;
    while improved && tour.effort > 0 {
        improved = false;
        for end in 0..places.len() {
            for other in &near[end] {
                let other = *other as usize;
                let pair = [(ids[end / 2], end % 2), (ids[other / 2], other % 2)];
                improved |= tour.turn(pair) || tour.shift(pair);
            }
        }
    }
    tour.order
}

impl Tour<'_> {
    /// The place where the pen comes down (0) or lifts (1) at a position in the order; `None` beyond its ends.
    fn end(&self, k: isize, which: usize) -> Option<[f64; 2]> {
        let visit = self.order.get(usize::try_from(k).ok()?)?;
        Some(ends(self.routes, visit)[which])
    }

    /// Travel between two ends; 0 if one is missing.
    fn gap(a: Option<[f64; 2]>, b: Option<[f64; 2]>) -> f64 {
        match (a, b) {
            (Some(a), Some(b)) => distance(a, b),
            _ => 0.0,
        }
    }

    /// Travel from the route at `k` to the next.
    fn link(&self, k: isize) -> f64 {
        Self::gap(self.end(k, 1), self.end(k + 1, 0))
    }

    /// Position of a route in the order, and whether the pen lifts at the given end.
    fn place(&self, (route, end): (usize, usize)) -> (isize, bool) {
        let k = self.at[route] as usize;
        (k as isize, (end == 1) != self.order[k].reversed)
    }

    /// 2-opt: reverses the run between two ends that would then be joined, if that shortens the way.
    fn turn(&mut self, pair: [(usize, usize); 2]) -> bool {
        self.effort = self.effort.saturating_sub(1);

        // Give up pairs of different sorts, and where the effort is used up.
        let [(i, lifts), (j, also_lifts)] = pair.map(|end| self.place(end));
        if lifts != also_lifts || self.effort == 0 {
            return false;
        }
        let (low, high) = (i.min(j), i.max(j));
        let (first, last) = if lifts {
            (low + 1, high)
        } else {
            (low, high - 1)
        };

        // Turn the stretch where that shortens the way.
        let before = self.link(first - 1) + self.link(last);
        let after = Self::gap(self.end(first - 1, 1), self.end(last, 1))
            + Self::gap(self.end(first, 0), self.end(last + 1, 0));
        if after >= before - 1e-9 {
            return false;
        }
        self.reverse(first as usize, last as usize);
        self.settle(first as usize, last as usize);
        true
    }

    /// Or-opt: moves a short run beside a near end, in either direction, if that shortens the way.
    fn shift(&mut self, pair: [(usize, usize); 2]) -> bool {
        let [(i, lifts), (j, other_lifts)] = pair.map(|end| self.place(end));
        // The run goes behind `i` or before it, and begins or ends at `j`.
        let gap = if lifts { i } else { i - 1 };
        for length in 1..=RUN as isize {
            self.effort = self.effort.saturating_sub(1);
            let (first, last) = if other_lifts {
                (j - length + 1, j)
            } else {
                (j, j + length - 1)
            };
            let outside = gap < first - 1 || gap > last;
            let inside = first < 0 || last >= self.order.len() as isize;
            if !outside || inside || (first..=last).contains(&i) || self.effort == 0 {
                continue;
            }
            let turned = lifts == other_lifts;
            let (head, tail) = (self.end(first, 0), self.end(last, 1));
            let (head, tail) = if turned { (tail, head) } else { (head, tail) };
            let before = self.link(first - 1) + self.link(last) + self.link(gap);
            let after = Self::gap(self.end(first - 1, 1), self.end(last + 1, 0))
                + Self::gap(self.end(gap, 1), head)
                + Self::gap(tail, self.end(gap + 1, 0));
            if after < before - 1e-9 {
                self.relocate(first as usize, last as usize, gap, turned);
                return true;
            }
        }
        false
    }

    fn relocate(&mut self, first: usize, last: usize, gap: isize, turned: bool) {
        if turned {
            self.reverse(first, last);
        }
        let length = last - first + 1;
        if gap >= last as isize {
            let gap = gap as usize;
            self.order[first..=gap].rotate_left(length);
            self.settle(first, gap);
        } else {
            let start = (gap + 1) as usize;
            self.order[start..=last].rotate_right(length);
            self.settle(start, last);
        }
    }

    fn reverse(&mut self, first: usize, last: usize) {
        let run = &mut self.order[first..=last];
        run.reverse();
        for visit in run {
            visit.reversed = !visit.reversed;
        }
    }

    /// Updates the positions of the routes of a changed run.
    fn settle(&mut self, first: usize, last: usize) {
        self.effort = self.effort.saturating_sub(last - first);
        for k in first..=last {
            self.at[self.order[k].route] = k as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn routes() -> impl Strategy<Value = Vec<Route>> {
        let point = [0.0..100.0f64, 0.0..100.0f64];
        let route = (prop::collection::vec(point, 0..6), any::<bool>());
        prop::collection::vec(
            route.prop_map(|(points, closed)| Route { points, closed }),
            0..40,
        )
    }

    fn given(routes: &[Route]) -> Vec<Visit> {
        (0..routes.len())
            .filter(|i| is_sound(&routes[*i]))
            .map(|route| Visit {
                route,
                reversed: false,
                start: 0,
            })
            .collect()
    }

    /// Short lines scattered by a fixed pattern.
    fn scattered(count: usize) -> Vec<Route> {
        let mut state = 12345u64;
        let mut next = move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1u64 << 31) as f64
        };
        (0..count)
            .map(|_| {
                let [x, y] = [next() * 1000.0, next() * 1000.0];
                Route {
                    points: vec![[x, y], [x + next() * 20.0 - 10.0, y + next() * 20.0 - 10.0]],
                    closed: false,
                }
            })
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn every_route_is_drawn_once_and_the_way_is_never_longer(routes in routes()) {
            let order = order(&routes);
            let mut seen: Vec<usize> = order.iter().map(|visit| visit.route).collect();
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..routes.len()).collect::<Vec<_>>());
            let drawn: Vec<Visit> = order.iter().filter(|v| is_sound(&routes[v.route])).copied().collect();
            prop_assert!(travel(&routes, &drawn) <= travel(&routes, &given(&routes)) + 1e-9);
            for visit in &drawn {
                let route = &routes[visit.route];
                let walk = visit.walk(&route.points);
                prop_assert_eq!(walk[0], ends(&routes, visit)[0]);
                prop_assert_eq!(walk.len(), route.points.len());
                prop_assert!(route.closed || walk[walk.len() - 1] == ends(&routes, visit)[1]);
            }
        }
    }

    proptest! {
        #[test]
        fn groups_stay_together(routes in routes(), pattern in prop::collection::vec(0u32..4, 40)) {
            let groups = &pattern[..routes.len()];
            let order = order_in_groups(&routes, groups);
            let mut seen: Vec<usize> = order.iter().map(|visit| visit.route).collect();
            let mut changes: Vec<u32> = seen.iter().map(|route| groups[*route]).collect();
            changes.dedup();
            let count = changes.len();
            changes.sort_unstable();
            changes.dedup();
            prop_assert_eq!(changes.len(), count);
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..routes.len()).collect::<Vec<_>>());
            for visit in order.iter().filter(|v| is_sound(&routes[v.route])) {
                let walk = visit.walk(&routes[visit.route].points);
                prop_assert_eq!(walk[0], ends(&routes, visit)[0]);
            }
        }
    }

    #[test]
    fn dashes_of_one_line_are_drawn_along_it() {
        let dash = |k: usize| Route {
            points: vec![[10.0 * k as f64, 0.0], [10.0 * k as f64 + 6.0, 0.0]],
            closed: false,
        };
        let routes: Vec<Route> = [3, 0, 4, 1, 2].map(dash).to_vec();
        assert!((travel(&routes, &order(&routes)) - 16.0).abs() < 1e-9);
    }

    #[test]
    fn closed_routes_begin_where_the_pen_passes() {
        let square = vec![[10.0, 0.0], [20.0, 0.0], [20.0, 10.0], [10.0, 10.0]];
        let line = |x: f64| Route {
            points: vec![[x, 10.0], [x + 5.0, 10.0]],
            closed: false,
        };
        let ring = Route {
            points: square,
            closed: true,
        };
        let routes = vec![line(4.0), ring, line(21.0)];
        let order = order(&routes);
        assert!(travel(&routes, &order) < 13.0, "{order:?}");
    }

    #[test]
    fn scattered_lines_come_near_the_shortest_way() {
        let routes = scattered(2000);
        let way = travel(&routes, &order(&routes));
        let only_greedy = travel(&routes, &greedy(&routes, &(0..2000).collect::<Vec<_>>()));
        assert!(way < 0.88 * only_greedy, "{way} of {only_greedy}");
    }

    #[test]
    fn hostile_routes_end() {
        let same = Route {
            points: vec![[5.0, 5.0]; 3],
            closed: true,
        };
        assert_eq!(order(&vec![same; 500]).len(), 500);
        let wild = |x: f64| Route {
            points: vec![[x, 0.0], [0.0, x]],
            closed: false,
        };
        let routes = [f64::NAN, 1e300, f64::INFINITY, -1e300, 1e-300, 0.0].map(wild);
        assert_eq!(order(&routes).len(), 6);
        assert!(order(&[]).is_empty());
    }
}
