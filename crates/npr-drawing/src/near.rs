//! The nearest of many places in the plane, by a grid of cells.

use npr_vector::mesh_lines::run::distance;

/// Places by cells of a grid, for finding near ones.
pub(crate) struct Grid {
    low: [f64; 2],
    cell: f64,
    side: [usize; 2],
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Grid {
    /// A grid with about two places per cell.
    pub(crate) fn new(places: &[[f64; 2]]) -> Self {
        // Enclose the places.
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for place in places {
            for i in 0..2 {
                low[i] = low[i].min(place[i]);
                high[i] = high[i].max(place[i]);
            }
        }

        // Choose cells with some two places each.
        let extent = (high[0] - low[0]).max(high[1] - low[1]).max(1e-9);
        let cells = ((places.len() as f64 / 2.0).sqrt().ceil()).clamp(1.0, 2048.0);
        let cell = extent / cells;
        let side = [0, 1].map(|i| ((high[i] - low[i]) / cell).min(cells) as usize + 1);
        let mut grid = Self {
            low,
            cell,
            side,
            starts: vec![0; side[0] * side[1] + 1],
            items: vec![0; places.len()],
        };
        grid.fill(places);
        grid
    }

    fn fill(&mut self, places: &[[f64; 2]]) {
        let cells: Vec<usize> = places
            .iter()
            .map(|p| self.index(self.cell_of(*p)))
            .collect();
        for cell in &cells {
            self.starts[cell + 1] += 1;
        }
        for i in 1..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        let mut next = self.starts.clone();
        for (item, cell) in cells.iter().enumerate() {
            self.items[next[*cell] as usize] = item as u32;
            next[*cell] += 1;
        }
    }

    fn cell_of(&self, p: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|i| {
            let cell = (p[i] - self.low[i]) / self.cell;
            (cell.max(0.0) as usize).min(self.side[i] - 1)
        })
    }

    fn index(&self, cell: [usize; 2]) -> usize {
        cell[1] * self.side[0] + cell[0]
    }

    /// Calls `visit` with the places of the cells at distance `ring` from a cell; returns false if that ring lies
    /// outside.
    fn ring(&self, centre: [usize; 2], ring: usize, mut visit: impl FnMut(u32)) -> bool {
        let [x, y] = centre.map(|c| c as isize);
        let r = ring as isize;
        let mut any = false;

        // Visit a cell, if the grid has it.
        let mut cell = |cx: isize, cy: isize| {
            let inside = (0..self.side[0] as isize).contains(&cx)
                && (0..self.side[1] as isize).contains(&cy);
            if inside {
                any = true;
                let index = self.index([cx as usize, cy as usize]);
                let range = self.starts[index] as usize..self.starts[index + 1] as usize;
                self.items[range].iter().for_each(|item| visit(*item));
            }
        };

        // Go along the rows above and below, then along the columns at the sides.
        for dx in -r..=r {
            cell(x + dx, y - r);
            if r > 0 {
                cell(x + dx, y + r);
            }
        }
        for dy in 1 - r..r {
            cell(x - r, y + dy);
            cell(x + r, y + dy);
        }
        any
    }

    /// The `count` nearest places that `keep` accepts, nearest first; ties by index.
    pub(crate) fn nearest(
        &self,
        places: &[[f64; 2]],
        p: [f64; 2],
        count: usize,
        keep: impl Fn(u32) -> bool,
    ) -> Vec<u32> {
        let centre = self.cell_of(p);
        let mut found: Vec<(f64, u32)> = Vec::new();
        for ring in 0.. {
            let any = self.ring(centre, ring, |item| {
                if keep(item) {
                    found.push((distance(p, places[item as usize]), item));
                }
            });
            // Whatever lies in a further ring is further away than this.
            let reach = ring as f64 * self.cell;
            let near = found.iter().filter(|(d, _)| *d <= reach).count();
            if near >= count || !any {
                break;
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.truncate(count);
        found.into_iter().map(|(_, item)| item).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn grids_find_the_nearest(
            points in prop::collection::vec([0.0..9.0f64, 0.0..3.0f64], 1..60), x in 0.0..9.0f64, y in 0.0..3.0f64,
        ) {
            let grid = Grid::new(&points);
            let mut all: Vec<u32> = (0..points.len() as u32).filter(|i| i % 3 != 1).collect();
            all.sort_by(|a, b| {
                let [da, db] = [a, b].map(|i| distance([x, y], points[*i as usize]));
                da.total_cmp(&db).then(a.cmp(b))
            });
            all.truncate(5);
            prop_assert_eq!(grid.nearest(&points, [x, y], 5, |i| i % 3 != 1), all);
        }
    }
}
