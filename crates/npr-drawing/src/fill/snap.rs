//! Line segments made into a planar graph on whole numbers.
//!
//! Every end and every crossing, rounded, becomes a point; every segment is led through the points whose unit square
//! it passes [Hobby 1999, hot pixels]. Segments so moved do not cross, so whatever reads the graph needs no
//! arithmetic that could fail.
//!
//! Differs: the step is repeated until nothing moves, so that no point is left on the inside of a segment.

use super::error::FillError;
use rayon::prelude::*;

/// A point in units of the grid.
pub(super) type Point = [i64; 2];

/// Most pairs of segments compared in one round: about a second.
const PAIRS: usize = 1 << 28;

/// Most points or pieces.
const PIECES: usize = 1 << 23;

/// Rounds of snapping; the second usually finds nothing to do.
const ROUNDS: usize = 16;

/// Segments that meet only at their ends, each with the lesser point first.
///
/// Exact for coordinates below 2^29. In practice O(n log n) plus crossings.
pub(super) fn snapped(mut segments: Vec<[Point; 2]>) -> Result<Vec<[Point; 2]>, FillError> {
    tidy(&mut segments);
    for _ in 0..ROUNDS {
        // Lead every segment through the points that it passes.
        let points = points(&segments)?;
        let grid = Grid::over(&segments);
        let cells = Cells::of(&grid, &points);
        let pieces = segments.par_iter().flat_map_iter(|segment| {
            let on_the_way = on_the_way(&grid, &cells, &points, *segment);
            (1..on_the_way.len()).map(move |i| [on_the_way[i - 1], on_the_way[i]])
        });

        // Stop when nothing moves any more.
        let mut pieces: Vec<[Point; 2]> = pieces.collect();
        tidy(&mut pieces);
        if pieces.len() > PIECES {
            return Err(FillError::TooManyCrossings);
        }
        if pieces == segments {
            break;
        }
        segments = pieces;
    }
    Ok(segments)
}

/// Orders ends, then segments, and drops points and doubles.
fn tidy(segments: &mut Vec<[Point; 2]>) {
    segments.iter_mut().for_each(|ends| ends.sort_unstable());
    segments.retain(|[a, b]| a != b);
    segments.par_sort_unstable();
    segments.dedup();
}

fn cross(a: Point, b: Point) -> i64 {
    a[0] * b[1] - a[1] * b[0]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// All ends and rounded crossings, in order.
fn points(segments: &[[Point; 2]]) -> Result<Vec<Point>, FillError> {
    // Sort segments into cells.
    let grid = Grid::over(segments);
    let mut entries: Vec<(u32, u32)> = Vec::new();
    for (index, segment) in (0..).zip(segments) {
        grid.visit(*segment, |cell| entries.push((cell, index)));
    }
    entries.par_sort_unstable();
    let groups = entries.chunk_by(|a, b| a.0 == b.0);

    // Refuse more pairs than take a second.
    let pairs: usize = groups.map(|group| group.len() * group.len() / 2).sum();
    if pairs > PAIRS {
        return Err(FillError::TooManyCrossings);
    }

    // Find where segments of a cell cross.
    let crossings = entries
        .par_chunk_by(|a, b| a.0 == b.0)
        .flat_map_iter(|group| {
            group.iter().enumerate().flat_map(move |(i, (_, first))| {
                let others = group[i + 1..].iter();
                others.filter_map(move |(_, second)| {
                    crossing(segments[*first as usize], segments[*second as usize])
                })
            })
        });

    // Add their ends, each point once.
    let mut points: Vec<Point> = crossings.collect();
    points.extend(segments.as_flattened());
    points.par_sort_unstable();
    points.dedup();
    if points.len() > PIECES {
        return Err(FillError::TooManyCrossings);
    }
    Ok(points)
}

/// Where the insides of two segments cross, rounded to the nearest point.
fn crossing([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<Point> {
    // Ends are ordered, so the first coordinates bound the segments as they are.
    if a[0] > d[0] || c[0] > b[0] {
        return None;
    }
    let (u, v) = (minus(b, a), minus(d, c));
    let apart = |p: i64, q: i64| p.signum() * q.signum() >= 0;
    if apart(cross(u, minus(c, a)), cross(u, minus(d, a))) {
        return None;
    }
    if apart(cross(v, minus(a, c)), cross(v, minus(b, c))) {
        return None;
    }
    let (part, whole) = (cross(minus(c, a), v), cross(u, v));
    let (part, whole) = (i128::from(part * whole.signum()), i128::from(whole.abs()));
    let rounded = |i: usize| {
        let doubled = 2 * i128::from(u[i]) * part + whole;
        a[i] + doubled.div_euclid(2 * whole) as i64
    };
    Some([rounded(0), rounded(1)])
}

/// Points whose unit square the segment meets, from its first end to its last.
fn on_the_way(grid: &Grid, cells: &Cells, points: &[Point], segment: [Point; 2]) -> Vec<Point> {
    let along = minus(segment[1], segment[0]);
    let mut found: Vec<(i64, Point)> = Vec::new();
    grid.visit(segment, |cell| {
        let inside = cells.of_cell(cell).iter().map(|i| points[*i as usize]);
        let hot = inside.filter(|point| meets_square(segment, *point));
        found.extend(hot.map(|p| (along[0] * p[0] + along[1] * p[1], p)));
    });
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|(_, point)| point).collect()
}

/// Whether a segment meets the square of side 1 around a point, whose right and upper sides are not part of it.
///
/// Half-open squares tile the plane: a segment through a corner belongs to one of four, and no two
/// segments change places.
fn meets_square([a, b]: [Point; 2], point: Point) -> bool {
    let beside = |i: usize| point[i] < a[i].min(b[i]) || point[i] > a[i].max(b[i]);
    if beside(0) || beside(1) {
        return false;
    }
    let along = minus(b, a);
    let distance = 2 * cross(along, minus(point, a));
    let reach = along[0].abs() + along[1].abs();
    // Through a corner only: the lower left one counts alone, but the line passes it on either side.
    let kept = || distance.signum() * (along[0] - along[1]) == reach;
    distance.abs() < reach || (distance.abs() == reach && kept())
}

/// Square cells over all segments, about as many as there are segments.
struct Grid {
    origin: Point,
    cell: i64,
    columns: i64,
    rows: i64,
}

impl Grid {
    fn over(segments: &[[Point; 2]]) -> Self {
        let all = || segments.as_flattened().iter();
        let bound = |i: usize| {
            let low = all().map(|p| p[i]).min().unwrap_or(0);
            let high = all().map(|p| p[i]).max().unwrap_or(0);
            [low, high - low + 1]
        };
        let [[x, width], [y, height]] = [bound(0), bound(1)];
        let area = width as f64 * height as f64;
        let side = (area / (segments.len().max(1) as f64)).sqrt();
        let longest = width.max(height);
        // No more than 4096 cells a side, or flat pictures would have millions.
        let cell = (side.ceil() as i64).max(longest / 4096 + 1);
        Self {
            origin: [x, y],
            cell,
            columns: width / cell + 1,
            rows: height / cell + 1,
        }
    }

    fn place(&self, value: i64, axis: usize) -> i64 {
        let count = [self.columns, self.rows][axis];
        ((value - self.origin[axis]) / self.cell).clamp(0, count - 1)
    }

    fn cell_of(&self, point: Point) -> u32 {
        (self.place(point[1], 1) * self.columns + self.place(point[0], 0)) as u32
    }

    /// Calls `visit` for every cell that the segment passes within one unit.
    fn visit(&self, [a, b]: [Point; 2], mut visit: impl FnMut(u32)) {
        let (low, high) = (a[1].min(b[1]), a[1].max(b[1]));
        for row in self.place(low - 1, 1)..=self.place(high + 1, 1) {
            let top = self.origin[1] + row * self.cell;
            let ends =
                [top - 1, top + self.cell + 1].map(|y| at_height([a, b], y.clamp(low, high)));
            let [from, to] = match a[1] == b[1] {
                true => [a[0], b[0]],
                false => [ends[0].min(ends[1]), ends[0].max(ends[1])],
            };
            for column in self.place(from - 2, 0)..=self.place(to + 2, 0) {
                visit((row * self.columns + column) as u32);
            }
        }
    }
}

/// First coordinate of a segment, which is not level, at a height; off by less than 1.
fn at_height([a, b]: [Point; 2], y: i64) -> i64 {
    let share = (y - a[1]) as f64 / (b[1] - a[1]) as f64;
    a[0] + ((b[0] - a[0]) as f64 * share) as i64
}

/// Points by cell.
struct Cells {
    starts: Vec<u32>,
    points: Vec<u32>,
}

impl Cells {
    fn of(grid: &Grid, points: &[Point]) -> Self {
        let mut starts = vec![0; (grid.columns * grid.rows) as usize + 1];
        for point in points {
            starts[grid.cell_of(*point) as usize + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut next = starts.clone();
        let mut sorted = vec![0; points.len()];
        for (index, point) in (0..).zip(points) {
            let slot = &mut next[grid.cell_of(*point) as usize];
            sorted[*slot as usize] = index;
            *slot += 1;
        }
        Self {
            starts,
            points: sorted,
        }
    }

    fn of_cell(&self, cell: u32) -> &[u32] {
        let [from, to] = [cell, cell + 1].map(|c| self.starts[c as usize] as usize);
        &self.points[from..to]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn segment(reach: i64) -> impl Strategy<Value = [Point; 2]> {
        prop::array::uniform2(prop::array::uniform2(0..reach))
    }

    /// Segments share more than an end.
    fn conflict(s: [Point; 2], t: [Point; 2]) -> bool {
        let on = |[a, b]: [Point; 2], p: Point| {
            let inside = (0..2).all(|i| (a[i].min(b[i])..=a[i].max(b[i])).contains(&p[i]));
            p != a && p != b && inside && cross(minus(b, a), minus(p, a)) == 0
        };
        crossing(s, t).is_some() || t.iter().any(|p| on(s, *p)) || s.iter().any(|p| on(t, *p))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]

        #[test]
        fn nothing_crosses_after_snapping(
            reach in 2..400_i64,
            segments in prop::collection::vec(segment(400), 0..24),
        ) {
            let folded = segments.iter().map(|s| s.map(|p| p.map(|v| v % reach)));
            let snapped = snapped(folded.collect()).unwrap();
            for i in 0..snapped.len() {
                for j in 0..i {
                    prop_assert!(!conflict(snapped[i], snapped[j]), "{:?} {:?}", snapped[i], snapped[j]);
                }
            }
        }

        #[test]
        fn crossings_round_to_the_nearest_point(s in segment(1000), t in segment(1000)) {
            let [s, t] = [s, t].map(|mut s| { s.sort_unstable(); s });
            if let Some(p) = crossing(s, t) {
                for [a, b] in [s, t] {
                    prop_assert!(meets_square([a, b], p));
                }
            }
        }
    }
}
