//! Which elements of a picture hold anything, so that the processor skips all others. Devices visit all of them: empty
//! elements add nothing there.

use npr_core::math;
use rayon::prelude::*;

/// The elements of a picture that hold anything, in order: row by row, each from the left.
pub(super) struct Occupied {
    /// The columns of the occupied elements of all rows, row after row.
    columns: Vec<u32>,
    /// Index into `columns` where each row starts, and its length at the end.
    starts: Vec<usize>,
}

/// An occupied element near a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Near {
    /// How many occupied elements come before it.
    pub ordinal: usize,
    /// Its column and row.
    pub place: [u32; 2],
    /// The square of its distance in elements.
    pub square: u32,
}

impl Occupied {
    /// Finds the elements that hold anything in a picture with rows of `width`. O(elements), parallel over rows.
    pub fn of<T: Sync>(elements: &[T], width: usize, holds: impl Fn(&T) -> bool + Sync) -> Self {
        let columns = |row: &[T]| -> Vec<u32> {
            let numbered = (0..).zip(row);
            numbered
                .filter_map(|(x, element)| holds(element).then_some(x))
                .collect()
        };
        let rows: Vec<Vec<u32>> = elements.par_chunks(width).map(columns).collect();
        let ends = rows.iter().scan(0, |end, row| {
            *end += row.len();
            Some(*end)
        });
        Self {
            starts: std::iter::once(0).chain(ends).collect(),
            columns: rows.concat(),
        }
    }

    fn row(&self, y: usize) -> &[u32] {
        &self.columns[self.starts[y]..self.starts[y + 1]]
    }

    /// Computes a value for each occupied element from its column and row, in order. Parallel over rows.
    pub fn each<T: Send>(&self, of: impl Fn([u32; 2]) -> T + Sync + Send) -> Vec<T> {
        let rows = (0..self.starts.len() - 1).into_par_iter();
        rows.flat_map_iter(|y| self.row(y).iter().map(move |x| [*x, y as u32]))
            .map(of)
            .collect()
    }

    /// Writes to every occupied element of `made` the value that `of` gives for its column and row, and leaves all
    /// others. Parallel over rows.
    pub fn make<T: Send>(&self, made: &mut [T], width: usize, of: impl Fn([u32; 2]) -> T + Sync) {
        made.par_chunks_mut(width)
            .enumerate()
            .for_each(|(y, made)| {
                for x in self.row(y) {
                    made[*x as usize] = of([*x, y as u32]);
                }
            });
    }

    /// The occupied elements up to `reach` columns and rows from a place, the place itself included, in order.
    pub fn around(&self, [x, y]: [u32; 2], reach: u32) -> impl Iterator<Item = Near> {
        let end = (y + reach + 1).min(self.starts.len() as u32 - 1);
        (y.saturating_sub(reach)..end).flat_map(move |row| {
            let columns = self.row(row as usize);
            let skipped = columns.partition_point(|column| column + reach < x);
            let first = self.starts[row as usize] + skipped;
            let near = columns[skipped..]
                .iter()
                .take_while(move |column| **column <= x + reach);
            near.zip(first..).map(move |(column, ordinal)| {
                let (dx, dy) = (column.abs_diff(x), row.abs_diff(y));
                Near {
                    ordinal,
                    place: [*column, row],
                    square: dx * dx + dy * dy,
                }
            })
        })
    }
}

/// The weights of a Gaussian by squared distance in whole steps.
pub(super) struct Gaussian {
    weights: Vec<f32>,
}

impl Gaussian {
    /// Tabulates exp(square * falloff) up to `reach` steps along each of two axes.
    pub fn new(falloff: f32, reach: u32) -> Self {
        let squares = 0..=2 * reach * reach;
        Self {
            weights: squares
                .map(|square| math::exp(square as f32 * falloff))
                .collect(),
        }
    }

    /// The weight at a squared distance.
    pub fn at(&self, square: u32) -> f32 {
        self.weights[square as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn those_around_are_those_of_a_walk_over_all(
            picture in prop::collection::vec(prop::bool::weighted(0.3), 7 * 9),
            x in 0u32..7,
            y in 0u32..9,
            reach in 0u32..5,
        ) {
            let mut want = Vec::new();
            for row in 0..9u32 {
                for column in 0..7u32 {
                    let (dx, dy) = (column.abs_diff(x), row.abs_diff(y));
                    let element = (row * 7 + column) as usize;
                    if picture[element] && dx.max(dy) <= reach {
                        let ordinal = picture[..element].iter().filter(|holds| **holds).count();
                        want.push(Near { ordinal, place: [column, row], square: dx * dx + dy * dy });
                    }
                }
            }
            let occupied = Occupied::of(&picture, 7, |holds| *holds);
            prop_assert_eq!(occupied.around([x, y], reach).collect::<Vec<_>>(), want);

            let places = (0..63u32).filter(|i| picture[*i as usize]).map(|i| [i % 7, i / 7]);
            prop_assert_eq!(occupied.each(|place| place), places.collect::<Vec<_>>());

            let mut made = vec![None; 7 * 9];
            occupied.make(&mut made, 7, Some);
            for (i, place) in made.iter().enumerate() {
                prop_assert_eq!(*place, picture[i].then_some([i as u32 % 7, i as u32 / 7]));
            }
        }
    }
}
