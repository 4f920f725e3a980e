//! Segments of the picture, sorted into cells, to find the nearest.

/// A place on a segment near a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// Which segment.
    pub segment: u32,
    /// Where along it, from 0 to 1.
    pub share: f64,
    /// The place, in pixels.
    pub place: [f64; 2],
    /// Distance from the point, in pixels.
    pub distance: f64,
}

/// Segments in a uniform grid over the part of the picture that they fill.
#[derive(Debug, Clone, Default)]
pub struct SegmentGrid {
    segments: Vec<[[f64; 2]; 2]>,
    origin: [f64; 2],
    cell_px: f64,
    size: [usize; 2],
    starts: Vec<u32>,
    entries: Vec<u32>,
}

/// Most cells a side; cells grow where a larger picture would need more.
const LARGEST_SIDE: f64 = 1024.0;

impl SegmentGrid {
    /// Sorts segments, in pixels, into cells of about `cell_px`; those that are not finite are never found.
    ///
    /// O(segments + cells they touch). Searches are fastest with radii up to the size of a cell.
    pub fn new(segments: Vec<[[f64; 2]; 2]>, cell_px: f64) -> Self {
        // Enclose the segments that are finite.
        let finite =
            |segment: &&[[f64; 2]; 2]| segment.as_flattened().iter().all(|v| v.is_finite());
        let (mut low, mut high) = ([f64::MAX; 2], [f64::MIN; 2]);
        for point in segments.iter().filter(finite).flatten() {
            low = [0, 1].map(|i| low[i].min(point[i]));
            high = [0, 1].map(|i| high[i].max(point[i]));
        }
        if low[0] > high[0] {
            return Self::default();
        }

        // Choose cells as asked, but not so many that they take too much memory.
        let extent = (high[0] - low[0]).max(high[1] - low[1]);
        let cell_px = cell_px.max(1e-6).max(extent / LARGEST_SIDE);
        let side =
            |i: usize| (((high[i] - low[i]) / cell_px) as usize).min(LARGEST_SIDE as usize) + 1;
        let mut grid = Self {
            segments,
            origin: low,
            cell_px,
            size: [side(0), side(1)],
            ..Self::default()
        };
        grid.fill();
        grid
    }

    /// The segments, in the order given.
    pub fn segments(&self) -> &[[[f64; 2]; 2]] {
        &self.segments
    }

    /// The nearest place within `radius_px` on a segment that `accept` takes; of equally near ones the first.
    ///
    /// `accept` sees the segment's number and the share along it.
    pub fn nearest(
        &self,
        point: [f64; 2],
        radius_px: f64,
        mut accept: impl FnMut(u32, f64) -> bool,
    ) -> Option<Nearest> {
        let mut best: Option<Nearest> = None;
        self.visit_near(point, radius_px, |near| {
            let nearer = best
                .is_none_or(|best| (near.distance, near.segment) < (best.distance, best.segment));
            if nearer && accept(near.segment, near.share) {
                best = Some(near);
            }
        });
        best
    }

    /// Calls `visit` with the nearest place of every segment that comes within `radius_px`; some come twice.
    pub fn visit_near(&self, point: [f64; 2], radius_px: f64, mut visit: impl FnMut(Nearest)) {
        if self.starts.is_empty() || !point.iter().all(|v| v.is_finite()) {
            return;
        }
        let reach = |i: usize, by: f64| self.index(i, point[i] + by);
        for row in reach(1, -radius_px)..=reach(1, radius_px) {
            for column in reach(0, -radius_px)..=reach(0, radius_px) {
                let cell = row * self.size[0] + column;
                let [from, to] = [cell, cell + 1].map(|c| self.starts[c] as usize);
                for segment in &self.entries[from..to] {
                    let near = self.nearest_on(*segment, point);
                    if near.distance <= radius_px {
                        visit(near);
                    }
                }
            }
        }
    }

    fn nearest_on(&self, segment: u32, point: [f64; 2]) -> Nearest {
        let [a, b] = self.segments[segment as usize];
        let along = [b[0] - a[0], b[1] - a[1]];
        let offset = [point[0] - a[0], point[1] - a[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let dot = offset[0] * along[0] + offset[1] * along[1];
        let share = if square > 0.0 {
            (dot / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let place = [0, 1].map(|i| a[i] + along[i] * share);
        let [dx, dy] = [0, 1].map(|i| point[i] - place[i]);
        Nearest {
            segment,
            share,
            place,
            distance: (dx * dx + dy * dy).sqrt(),
        }
    }

    fn index(&self, axis: usize, at: f64) -> usize {
        let cell = (at - self.origin[axis]) / self.cell_px;
        (cell.max(0.0) as usize).min(self.size[axis] - 1)
    }

    /// Lists the segments of every cell by counting sort.
    fn fill(&mut self) {
        let mut starts = vec![0_u32; self.size[0] * self.size[1] + 1];
        for segment in &self.segments {
            self.cells_of(segment, |cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut entries = vec![0; starts[starts.len() - 1] as usize];
        let mut cursor = starts.clone();
        for (number, segment) in self.segments.iter().enumerate() {
            self.cells_of(segment, |cell| {
                entries[cursor[cell] as usize] = number as u32;
                cursor[cell] += 1;
            });
        }
        (self.starts, self.entries) = (starts, entries);
    }

    /// Visits the cells that a segment passes, row by row, and now and then one beside.
    fn cells_of(&self, [a, b]: &[[f64; 2]; 2], mut visit: impl FnMut(usize)) {
        if !a.iter().chain(b).all(|v| v.is_finite()) {
            return;
        }
        let (top, bottom) = if a[1] <= b[1] { (a, b) } else { (b, a) };
        let slope = (bottom[0] - top[0]) / (bottom[1] - top[1]).max(1e-300);
        let [first, last] = [top, bottom].map(|p| self.index(1, p[1]));
        // Rounding must not lose a cell.
        let slack = 1e-6 * self.cell_px;
        for row in first..=last {
            let border = |row: usize| self.origin[1] + row as f64 * self.cell_px;
            let x_at = |y: f64| match first == last {
                true => None,
                false => Some(top[0] + slope * (y.clamp(top[1], bottom[1]) - top[1])),
            };
            let from = x_at(border(row)).unwrap_or(top[0]);
            let to = x_at(border(row + 1)).unwrap_or(bottom[0]);
            let columns = [from.min(to) - slack, from.max(to) + slack].map(|x| self.index(0, x));
            for column in columns[0]..=columns[1] {
                visit(row * self.size[0] + column);
            }
        }
    }
}

/// Pulls points of a line towards an outline nearby, and tells which of them lie by it.
///
/// A point keeps half of `radius_px` of freedom: nearer to the outline it stays where it is, so that a smooth line is
/// not bent onto the outline's corners; up to `radius_px` further away it moves to half of `radius_px` from it;
/// beyond, it stays and counts as off. A line sampled finely stays connected, since the shift grows with the distance
/// and nothing else.
///
/// O(points) for outlines that do not crowd in one place.
pub fn snap_to_outline(
    points: &mut [[f64; 2]],
    outline: &SegmentGrid,
    radius_px: f64,
) -> Vec<bool> {
    let keep_px = 0.5 * radius_px;
    let snap = |point: &mut [f64; 2]| {
        let Some(near) = outline.nearest(*point, radius_px + keep_px, |_, _| true) else {
            return false;
        };
        if near.distance > keep_px {
            let share = keep_px / near.distance;
            *point = [0, 1].map(|i| near.place[i] + (point[i] - near.place[i]) * share);
        }
        true
    };
    points.iter_mut().map(snap).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_place() -> impl Strategy<Value = [f64; 2]> {
        proptest::array::uniform2(-40.0f64..300.0)
    }

    /// Distance from a point to the nearest of many places along a segment.
    fn slow_distance([a, b]: [[f64; 2]; 2], p: [f64; 2]) -> f64 {
        (0..=2000)
            .map(|i| {
                let at = [0, 1].map(|k| a[k] + (b[k] - a[k]) * f64::from(i) / 2000.0);
                ((p[0] - at[0]).powi(2) + (p[1] - at[1]).powi(2)).sqrt()
            })
            .fold(f64::MAX, f64::min)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn the_nearest_of_all_is_found(
            segments in proptest::collection::vec(proptest::array::uniform2(any_place()), 0..12),
            point in any_place(), radius in 0.5f64..60.0, cell in 0.5f64..40.0,
        ) {
            let grid = SegmentGrid::new(segments.clone(), cell);
            let found = grid.nearest(point, radius, |_, _| true).map(|near| near.distance);
            let expected = segments.iter().map(|s| slow_distance(*s, point)).fold(f64::MAX, f64::min);
            match found {
                Some(distance) => prop_assert!((distance - expected).abs() < 0.2),
                None => prop_assert!(expected > radius - 0.2),
            }
        }

        #[test]
        fn snapped_points_lie_by_the_outline(point in any_place(), radius in 1.0f64..20.0) {
            let outline = SegmentGrid::new(vec![[[0.0, 100.0], [250.0, 100.0]]], radius);
            let mut points = [point];
            let by = snap_to_outline(&mut points, &outline, radius)[0];
            let distance = |p: [f64; 2]| slow_distance([[0.0, 100.0], [250.0, 100.0]], p);
            if by {
                prop_assert!(distance(points[0]) <= 0.5 * radius + 0.2);
            } else {
                prop_assert_eq!(points[0], point);
                prop_assert!(distance(point) > 1.5 * radius - 0.2);
            }
        }
    }

    #[test]
    fn odd_segments_are_survived() {
        let nan = [[f64::NAN, 0.0], [1.0, 1.0]];
        let grid = SegmentGrid::new(vec![nan, [[5.0, 5.0]; 2], [[-1e12, 0.0], [1e12, 3.0]]], 4.0);
        assert_eq!(
            grid.nearest([5.0, 6.0], 3.0, |_, _| true)
                .map(|n| n.segment),
            Some(1)
        );
        assert_eq!(grid.nearest([f64::NAN, 6.0], 3.0, |_, _| true), None);
        assert!(
            SegmentGrid::new(vec![nan], 0.0)
                .nearest([0.0; 2], 1e9, |_, _| true)
                .is_none()
        );
    }
}
