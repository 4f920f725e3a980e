//! Where the values of a regular grid lie in memory, and how they blend between grid points.

use glam::Vec3;
use rayon::prelude::*;

/// Below this many values a loop runs on the calling thread: handing it out would cost more.
const SERIAL_BELOW: usize = 1 << 14;

/// The same where a value takes far more than a few additions.
const SERIAL_BELOW_IF_COSTLY: usize = 1 << 10;

/// The size of a grid whose values lie in one list, x fastest, then y, then z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Lattice {
    /// Grid points along x, y and z.
    pub size: [usize; 3],
}

impl Lattice {
    /// A grid of `x * y * z` points.
    pub fn new(x: usize, y: usize, z: usize) -> Self {
        Self { size: [x, y, z] }
    }

    /// Number of grid points.
    pub fn len(self) -> usize {
        self.size[0] * self.size[1] * self.size[2]
    }

    /// Place of a grid point in the list.
    pub fn index(self, [x, y, z]: [usize; 3]) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// Distance in the list between neighbours along each axis.
    pub fn strides(self) -> [usize; 3] {
        [1, self.size[0], self.size[0] * self.size[1]]
    }

    /// The grid point at a place in the list.
    pub fn point(self, index: usize) -> [usize; 3] {
        let row = index / self.size[0];
        [index % self.size[0], row % self.size[1], row / self.size[1]]
    }

    /// Whether `place`, in grid coordinates, lies within half a step of the grid's points. Never of NaN.
    pub fn holds(self, place: Vec3) -> bool {
        let inside = |at: f32, count: usize| at >= -0.5 && at <= count as f32 - 0.5;
        let [x, y, z] = self.size;
        inside(place.x, x) && inside(place.y, y) && inside(place.z, z)
    }

    /// The grid point nearest to `place`, if the grid [`holds`](Self::holds) it.
    pub fn nearest(self, place: Vec3) -> Option<[usize; 3]> {
        let round = |at: f32, count: usize| ((at + 0.5) as usize).min(count - 1);
        let [x, y, z] = self.size;
        (self.len() > 0 && self.holds(place))
            .then(|| [round(place.x, x), round(place.y, y), round(place.z, z)])
    }

    /// The eight grid points round `place`, which is moved onto the grid first. Of a grid that has points only.
    #[inline]
    pub fn cell(self, place: Vec3) -> Cell {
        let mut cell = Cell {
            base: 0,
            steps: self.strides(),
            t: [0.0; 3],
        };
        for axis in 0..3 {
            let last = self.size[axis] - 1;
            // `max` first: it turns NaN into 0.
            let at = place[axis].max(0.0).min(last as f32);
            let low = (at as usize).min(last);
            cell.base += low * cell.steps[axis];
            cell.t[axis] = at - low as f32;
            if low == last {
                cell.steps[axis] = 0;
            }
        }
        cell
    }

    /// Writes `value([x, y, z])` into every element of `out`, in parallel.
    pub fn fill<T: Send>(self, out: &mut [T], value: impl Fn([usize; 3]) -> T + Sync) {
        let [width, height, _] = self.size;
        let fill_row = |(row, out): (usize, &mut [T])| {
            for (x, out) in out.iter_mut().enumerate() {
                *out = value([x, row % height, row / height]);
            }
        };
        rows(out, width, fill_row);
    }

    /// The list of `value([x, y, z])` over all grid points, in parallel.
    pub fn map<T: Send + Clone + Default>(self, value: impl Fn([usize; 3]) -> T + Sync) -> Vec<T> {
        let mut out = vec![T::default(); self.len()];
        self.fill(&mut out, value);
        out
    }

    /// [`map`](Self::map) for values that take long: small grids are handed out too.
    pub fn map_costly<T: Send + Clone + Default>(
        self,
        value: impl Fn([usize; 3]) -> T + Sync,
    ) -> Vec<T> {
        if self.len() < SERIAL_BELOW_IF_COSTLY {
            return self.map(value);
        }
        let mut out = vec![T::default(); self.len()];
        let [width, height, _] = self.size;
        let fill_row = |(row, out): (usize, &mut [T])| {
            for (x, out) in out.iter_mut().enumerate() {
                *out = value([x, row % height, row / height]);
            }
        };
        out.par_chunks_mut(width).enumerate().for_each(fill_row);
        out
    }
}

/// Hands rows of `width` elements with their numbers to `each`, in parallel where it pays.
pub(crate) fn rows<T: Send>(
    values: &mut [T],
    width: usize,
    each: impl Fn((usize, &mut [T])) + Sync + Send,
) {
    let width = width.max(1);
    if values.len() < SERIAL_BELOW {
        values.chunks_mut(width).enumerate().for_each(each);
    } else {
        values.par_chunks_mut(width).enumerate().for_each(each);
    }
}

/// Sum of `term(i)` for `i` in `0..count`, in blocks of fixed size, so the same bits for any number of threads.
pub(crate) fn sum(count: usize, term: impl Fn(usize) -> f64 + Sync) -> f64 {
    let block_sum = |block: usize| {
        let end = (block + SERIAL_BELOW).min(count);
        (block..end).map(&term).sum::<f64>()
    };
    if count <= SERIAL_BELOW {
        return block_sum(0);
    }
    let blocks: Vec<usize> = (0..count).step_by(SERIAL_BELOW).collect();
    let sums: Vec<f64> = blocks.into_par_iter().map(block_sum).collect();
    sums.into_iter().sum()
}

/// The greatest of `term(i)` for `i` in `0..count`; 0 of none. NaN does not count.
pub(crate) fn greatest(count: usize, term: impl Fn(usize) -> f32 + Sync) -> f32 {
    if count < SERIAL_BELOW {
        return (0..count).map(term).fold(0.0, f32::max);
    }
    let term = &term;
    (0..count)
        .into_par_iter()
        .with_min_len(SERIAL_BELOW)
        .map(term)
        .reduce(|| 0.0, f32::max)
}

/// The grid points round a place, and how far the place lies between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cell {
    base: usize,
    steps: [usize; 3],
    t: [f32; 3],
}

impl Cell {
    /// Places of the eight corners in the list, x fastest.
    #[inline]
    pub fn corners(&self) -> [usize; 8] {
        std::array::from_fn(|corner| {
            let step = |axis: usize| ((corner >> axis) & 1) * self.steps[axis];
            self.base + step(0) + step(1) + step(2)
        })
    }

    /// Trilinear blend of the values at the corners.
    #[inline]
    pub fn blend<T>(&self, value: impl Fn(usize) -> T) -> T
    where
        T: Copy
            + std::ops::Add<Output = T>
            + std::ops::Sub<Output = T>
            + std::ops::Mul<f32, Output = T>,
    {
        self.blend_of(&self.corners().map(value))
    }

    /// Trilinear blend of values that the corners have.
    #[inline]
    pub fn blend_of<T>(&self, values: &[T; 8]) -> T
    where
        T: Copy
            + std::ops::Add<Output = T>
            + std::ops::Sub<Output = T>
            + std::ops::Mul<f32, Output = T>,
    {
        let [tx, ty, tz] = self.t;
        let mix = |a: T, b: T, t: f32| a + (b - a) * t;
        let along_x = |at: usize| mix(values[at], values[at + 1], tx);
        let along_y = |at: usize| mix(along_x(at), along_x(at + 2), ty);
        mix(along_y(0), along_y(4), tz)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn blending_a_linear_field_gives_that_field(
            size in [1usize..6, 1..6, 1..6],
            slope in prop::array::uniform3(-2.0f32..2.0),
            place in prop::array::uniform3(0.0f32..1.0),
        ) {
            let lattice = Lattice { size };
            let slope = Vec3::from(slope);
            let place = Vec3::from_array(std::array::from_fn(|i| place[i] * (size[i] - 1) as f32));
            let values = lattice.map(|[x, y, z]| slope.dot(Vec3::new(x as f32, y as f32, z as f32)));
            let blended = lattice.cell(place).blend(|i| values[i]);
            prop_assert!((blended - slope.dot(place)).abs() < 1e-4);
        }

        #[test]
        fn a_place_of_any_kind_has_corners_on_the_grid(
            size in [1usize..6, 1..6, 1..6],
            place in prop::array::uniform3(prop::num::f32::ANY),
        ) {
            let lattice = Lattice { size };
            let corners = lattice.cell(Vec3::from(place)).corners();
            prop_assert!(corners.iter().all(|&corner| corner < lattice.len()));
        }

        #[test]
        fn points_and_indices_agree(size in [1usize..6, 1..6, 1..6], pick in 0usize..1000) {
            let lattice = Lattice { size };
            let index = pick % lattice.len();
            prop_assert_eq!(lattice.index(lattice.point(index)), index);
        }
    }
}
