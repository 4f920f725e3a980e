//! Places of a picture, sorted so that near ones are found.

/// Side of a cell in pixels, and so the longest reach of a search.
pub const REACH_PX: f64 = 8.0;

/// Cells beyond each border of the picture, for places that a camera carried out of it.
const MARGIN: i64 = 8;

/// Places in cells.
#[derive(Debug, Clone, Default)]
pub struct Near {
    places: Vec<[f64; 2]>,
    columns: i64,
    rows: i64,
    /// Where the places of a cell begin in `members`; one more than there are cells.
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Near {
    /// Sorts places of a picture of `size` pixels; those far outside count as lying at the outermost cells. O(places +
    /// cells).
    pub fn new(places: Vec<[f64; 2]>, size: [u32; 2]) -> Self {
        // Count what lies in each cell.
        let [columns, rows] =
            size.map(|side| (f64::from(side) / REACH_PX).ceil() as i64 + 2 * MARGIN);
        let mut near = Self {
            starts: vec![0; (columns * rows) as usize + 1],
            members: vec![0; places.len()],
            places,
            columns,
            rows,
        };
        let cells: Vec<usize> = (near.places.iter())
            .map(|place| near.index(near.cell(*place)))
            .collect();
        cells.iter().for_each(|cell| near.starts[cell + 1] += 1);

        // Put them in rows.
        for cell in 1..near.starts.len() {
            near.starts[cell] += near.starts[cell - 1];
        }
        let mut next = near.starts.clone();
        for (number, cell) in cells.into_iter().enumerate() {
            near.members[next[cell] as usize] = number as u32;
            next[cell] += 1;
        }
        near
    }

    fn cell(&self, place: [f64; 2]) -> [i64; 2] {
        let [x, y] = place.map(|v| (v / REACH_PX).floor() as i64 + MARGIN);
        [x.clamp(0, self.columns - 1), y.clamp(0, self.rows - 1)]
    }

    fn index(&self, [x, y]: [i64; 2]) -> usize {
        (y * self.columns + x) as usize
    }

    /// The nearest place up to `reach_px` (at most [`REACH_PX`]) away that `fits`, with its distance; of two as near
    /// the one with the lower number.
    pub fn nearest(
        &self,
        place: [f64; 2],
        reach_px: f64,
        fits: impl Fn(usize) -> bool,
    ) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        self.visit(place, |number| {
            let away = distance(self.places[number], place);
            let is_nearer = best.is_none_or(|(other, least)| (away, number) < (least, other));
            if away <= reach_px && is_nearer && fits(number) {
                best = Some((number, away));
            }
        });
        best
    }

    /// Whether any place lies up to `reach_px` (at most [`REACH_PX`]) away.
    pub fn is_near(&self, place: [f64; 2], reach_px: f64) -> bool {
        self.nearest(place, reach_px, |_| true).is_some()
    }

    fn visit(&self, place: [f64; 2], mut found: impl FnMut(usize)) {
        if self.places.is_empty() {
            return;
        }
        let [x, y] = self.cell(place);
        for row in (y - 1).max(0)..(y + 2).min(self.rows) {
            for column in (x - 1).max(0)..(x + 2).min(self.columns) {
                let cell = self.index([column, row]);
                let members = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                self.members[members]
                    .iter()
                    .for_each(|number| found(*number as usize));
            }
        }
    }
}

/// Distance of two places of a picture.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_nearest_is_that_of_a_search_through_all(
            places in vec([-20.0..120.0, -20.0..80.0], 0..80), at in [-20.0..120.0, -20.0..80.0],
            reach in 0.0..REACH_PX, odd in any::<bool>(),
        ) {
            let fits = |number: usize| !odd || number % 2 == 1;
            let all = (0..places.len()).filter(|number| fits(*number));
            let all = all.map(|number| (number, distance(places[number], at)));
            let expected = all
                .filter(|(_, away)| *away <= reach)
                .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
            prop_assert_eq!(Near::new(places.clone(), [100, 60]).nearest(at, reach, fits), expected);
        }
    }
}
