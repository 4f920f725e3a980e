//! Lines as points a pixel apart, and a grid to find them by.

use npr_vector::stroke::{Drawing, Kind, Stroke};

use super::chains::Run;

/// Distance between points along a line, in pixels, at most.
const STEP_PX: f64 = 1.0;

/// Longer segments are not followed: nothing that a frame shows has them.
const LONGEST_PX: f64 = 1e6;

/// A connected line.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// What it is.
    pub kind: Kind,
    /// It runs on from its end to its start.
    pub closed: bool,
    /// In pixels.
    pub points: Vec<[f64; 2]>,
}

impl Curve {
    /// A visible run of the reference.
    pub fn of_run(run: &Run) -> Self {
        Self {
            kind: run.layer.kind,
            closed: run.closed,
            points: run.points.clone(),
        }
    }

    /// The visible strokes of a drawing.
    pub fn of_drawing(drawing: &Drawing) -> Vec<Self> {
        let visible = drawing.strokes.iter().filter(|stroke| stroke.is_visible());
        visible.map(Self::of_stroke).collect()
    }

    fn of_stroke(stroke: &Stroke) -> Self {
        Self {
            kind: stroke.kind,
            closed: stroke.closed,
            points: stroke.points.iter().map(|point| point.position).collect(),
        }
    }

    /// Both ends of every segment that can be followed.
    pub(crate) fn segments(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let closing = match (self.closed, self.points.last(), self.points.first()) {
            (true, Some(last), Some(first)) => Some([*last, *first]),
            _ => None,
        };
        let pairs = self.points.windows(2).map(|pair| [pair[0], pair[1]]);
        pairs
            .chain(closing)
            .filter(|[a, b]| distance(*a, *b) <= LONGEST_PX)
    }

    /// In pixels.
    pub fn length(&self) -> f64 {
        self.segments().map(|[a, b]| distance(a, b)).sum()
    }
}

/// A point of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InkPoint {
    /// In pixels.
    pub at: [f64; 2],
    /// Unit vector along the line; zero where it has none.
    pub along: [f64; 2],
    /// Length of line that the point stands for, in pixels.
    pub length: f64,
    /// Distance from the start of its line, in pixels.
    pub travelled: f64,
    /// Number of its line.
    pub curve: u32,
}

/// Points a pixel apart on lines, line after line.
pub fn sample(curves: &[Curve]) -> Vec<InkPoint> {
    (0u32..)
        .zip(curves)
        .flat_map(|(number, curve)| sample_one(number, curve))
        .collect()
}

/// Points at equal distances on a line, each in the middle of what it stands for.
fn sample_one(number: u32, curve: &Curve) -> Vec<InkPoint> {
    // Cut the line into equal pieces of about a step.
    let whole = curve.length();
    let count = (whole / STEP_PX).ceil().max(1.0) as usize;
    let step = whole / count as f64;

    // Put a point into the middle of each.
    let mut points = Vec::with_capacity(count);
    let mut passed = 0.0;
    for [a, b] in curve.segments() {
        let length = distance(a, b);
        while points.len() < count {
            let travelled = (points.len() as f64 + 0.5) * step;
            if travelled > passed + length {
                break;
            }
            let share = if length > 0.0 {
                (travelled - passed) / length
            } else {
                0.0
            };
            points.push(InkPoint {
                at: [0, 1].map(|i| a[i] + share * (b[i] - a[i])),
                along: [0.0; 2],
                length: step,
                travelled,
                curve: number,
            });
        }
        passed += length;
    }
    give_directions(&mut points, curve.closed);
    points
}

/// The direction of a point is that from the one before to the one after, which forgives zigzags under a pixel.
fn give_directions(points: &mut [InkPoint], closed: bool) {
    let count = points.len();
    for i in 0..count {
        let [before, after] = if closed {
            [(i + count - 1) % count, (i + 1) % count]
        } else {
            [i.saturating_sub(1), (i + 1).min(count - 1)]
        };
        let [a, b] = [points[before].at, points[after].at];
        let length = distance(a, b);
        if length > 0.0 {
            points[i].along = [0, 1].map(|axis| (b[axis] - a[axis]) / length);
        }
    }
}

/// Points in square cells, to find those near a place.
#[derive(Debug, Clone)]
pub struct Bins {
    points: Vec<[f64; 2]>,
    /// Where the points of every cell start in `order`; one more than there are cells.
    starts: Vec<u32>,
    order: Vec<u32>,
    low: [f64; 2],
    cell: f64,
    counts: [usize; 2],
}

/// Most cells along a side: cells grow where points lie far apart.
const MOST_CELLS: f64 = 4096.0;

impl Bins {
    /// Cells of at least `radius` pixels, which is how far [`Bins::near`] looks. Points that are not finite are never
    /// found.
    pub fn new(points: Vec<[f64; 2]>, radius: f64) -> Self {
        // Lay a grid over the finite points.
        let finite = points.iter().filter(|p| p.iter().all(|v| v.is_finite()));
        let start = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let (low, high) = finite.fold(start, |(low, high), p| {
            (
                [0, 1].map(|i| low[i].min(p[i])),
                [0, 1].map(|i| high[i].max(p[i])),
            )
        });
        let extent = [0, 1].map(|i| (high[i] - low[i]).max(0.0));
        let cell = radius
            .max(extent[0] / MOST_CELLS)
            .max(extent[1] / MOST_CELLS);
        let mut bins = Self {
            starts: Vec::new(),
            order: Vec::new(),
            low,
            cell,
            counts: extent.map(|v| (v / cell) as usize + 1),
            points,
        };

        // Sort the points by cell.
        let mut placed: Vec<(u32, u32)> = (0u32..)
            .zip(&bins.points)
            .filter(|(_, p)| p.iter().all(|v| v.is_finite()))
            .map(|(number, p)| {
                let [x, y] = bins.cell_of(*p).map(|v| v as usize);
                ((y * bins.counts[0] + x) as u32, number)
            })
            .collect();
        placed.sort_unstable();

        // Note where each cell starts.
        let cells = bins.counts[0] * bins.counts[1];
        bins.starts = vec![0; cells + 1];
        placed
            .iter()
            .for_each(|(cell, _)| bins.starts[*cell as usize + 1] += 1);
        for cell in 0..cells {
            bins.starts[cell + 1] += bins.starts[cell];
        }
        bins.order = placed.into_iter().map(|(_, number)| number).collect();
        bins
    }

    /// The cell of a place, which may lie beside all cells.
    fn cell_of(&self, place: [f64; 2]) -> [i64; 2] {
        [0, 1].map(|i| ((place[i] - self.low[i]) / self.cell).floor() as i64)
    }

    /// Numbers and distances of the points within `radius`, which is at most the one of [`Bins::new`].
    pub fn near(&self, place: [f64; 2], radius: f64) -> impl Iterator<Item = (usize, f64)> {
        let [x, y] = self.cell_of(place);
        let [columns, rows] = self.counts.map(|count| count as i64);
        let cells =
            (y.saturating_sub(1).max(0)..=y.saturating_add(1).min(rows - 1)).flat_map(move |row| {
                (x.saturating_sub(1).max(0)..=x.saturating_add(1).min(columns - 1))
                    .map(move |column| (row * columns + column) as usize)
            });
        cells
            .flat_map(|cell| self.starts[cell]..self.starts[cell + 1])
            .map(move |slot| {
                let number = self.order[slot as usize] as usize;
                (number, distance(place, self.points[number]))
            })
            .filter(move |(_, distance)| *distance < radius)
    }

    /// The nearest point within `radius`, and its distance.
    pub fn nearest(&self, place: [f64; 2], radius: f64) -> Option<(usize, f64)> {
        self.near(place, radius)
            .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
    }
}

/// Distance between two places; infinite where one is not finite.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    let distance = (b[0] - a[0]).hypot(b[1] - a[1]);
    if distance.is_nan() {
        f64::INFINITY
    } else {
        distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    fn places() -> impl Strategy<Value = [f64; 2]> {
        prop_oneof![
            9 => (-30.0..30.0, -30.0..30.0f64).prop_map(|(x, y)| [x, y]),
            1 => any::<[f64; 2]>(),
        ]
    }

    proptest! {
        #[test]
        fn bins_find_what_a_search_finds(points in vec(places(), 0..60), place in places(), radius in 0.5..9.0f64) {
            let all = points.iter().enumerate().map(|(i, p)| (i, distance(place, *p)));
            let mut expected: Vec<usize> = all.filter(|(_, d)| *d < radius).map(|(i, _)| i).collect();
            let mut found: Vec<usize> = Bins::new(points.clone(), 9.0).near(place, radius).map(|(i, _)| i).collect();
            expected.sort_unstable();
            found.sort_unstable();
            prop_assert_eq!(found, expected);
        }

        #[test]
        fn points_lie_on_the_line_and_make_up_its_length(
            points in vec((-30.0..30.0, -30.0..30.0f64), 2..20), closed: bool,
        ) {
            let points: Vec<[f64; 2]> = points.into_iter().map(|(x, y)| [x, y]).collect();
            let curve = Curve { kind: Kind::Contour, closed, points };
            let ink = sample(std::slice::from_ref(&curve));
            let sum: f64 = ink.iter().map(|point| point.length).sum();
            prop_assert!((sum - curve.length()).abs() < 1e-6);
            for point in &ink {
                let off = curve.segments().map(|[a, b]| {
                    let [d, p] = [[b[0] - a[0], b[1] - a[1]], [point.at[0] - a[0], point.at[1] - a[1]]];
                    let share = ((p[0] * d[0] + p[1] * d[1]) / (d[0] * d[0] + d[1] * d[1]).max(1e-30)).clamp(0.0, 1.0);
                    distance(point.at, [0, 1].map(|i| a[i] + share * d[i]))
                });
                prop_assert!(off.fold(f64::INFINITY, f64::min) < 1e-6);
            }
        }

        #[test]
        fn whatever_the_points_are_sampling_ends(points in vec(any::<[f64; 2]>(), 0..9), closed: bool) {
            let ink = sample(&[Curve { kind: Kind::Crease, closed, points }]);
            prop_assert!(ink.len() < 10_000_000);
        }
    }
}
