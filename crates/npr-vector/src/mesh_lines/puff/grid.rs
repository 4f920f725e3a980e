//! Puffs in a grid over the picture.

use super::sphere::Puff;
use crate::mesh_lines::visibility::MARGIN;

/// Which puffs each cell of the picture may show, from front to back.
#[derive(Debug, Clone)]
pub(super) struct PuffGrid {
    cell_px: f64,
    origin: f64,
    columns: usize,
    rows: usize,
    starts: Vec<u32>,
    entries: Vec<u32>,
}

/// How far beyond the picture lines and puffs are followed, in pixels.
fn margin([width, height]: [u32; 2]) -> f64 {
    MARGIN * f64::from(width.max(height)) + 2.0
}

/// Whether a puff's image touches the picture or the margin around it.
pub(super) fn touches(size: [u32; 2], puff: &Puff) -> bool {
    let margin = margin(size);
    (0..2).all(|axis| {
        puff.bounds[axis] <= f64::from(size[axis]) + margin && puff.bounds[axis + 2] >= -margin
    })
}

impl PuffGrid {
    /// Sorts puffs, given from front to back, into cells; O(puffs + cells they touch).
    pub fn new(size: [u32; 2], puffs: &[Puff]) -> Self {
        let margin = margin(size);
        let [width, height] = size.map(|side| f64::from(side) + 2.0 * margin);
        let area = |puff: &Puff| {
            let side = |axis: usize, most: f64| {
                (puff.bounds[axis + 2] - puff.bounds[axis]).clamp(0.0, most)
            };
            side(0, width) * side(1, height)
        };
        // About one entry per puff and cell for puffs of any size.
        let mean = puffs.iter().map(area).sum::<f64>() / (puffs.len() as f64).max(1.0);
        let cell_px = mean.sqrt().clamp(8.0, 256.0);
        let mut grid = Self {
            cell_px,
            origin: -margin,
            columns: (width / cell_px).ceil() as usize,
            rows: (height / cell_px).ceil() as usize,
            starts: Vec::new(),
            entries: Vec::new(),
        };
        grid.fill(puffs);
        grid
    }

    fn fill(&mut self, puffs: &[Puff]) {
        let mut starts = vec![0_u32; self.columns * self.rows + 1];
        for puff in puffs {
            self.cells_of(puff.bounds)
                .for_each(|cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut entries = vec![0; starts.last().map_or(0, |count| *count as usize)];
        let mut cursor = starts.clone();
        for (index, puff) in (0..).zip(puffs) {
            for cell in self.cells_of(puff.bounds) {
                entries[cursor[cell] as usize] = index;
                cursor[cell] += 1;
            }
        }
        self.starts = starts;
        self.entries = entries;
    }

    /// The cells that a box touches: left, top, right, bottom in pixels.
    fn cells_of(
        &self,
        [left, top, right, bottom]: [f64; 4],
    ) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns;
        let [from, last] = [left, right].map(|x| self.index(x, columns));
        let [above, below] = [top, bottom].map(|y| self.index(y, self.rows));
        (above..=below).flat_map(move |row| (from..=last).map(move |column| row * columns + column))
    }

    fn index(&self, px: f64, count: usize) -> usize {
        (((px - self.origin) / self.cell_px).max(0.0) as usize).min(count.saturating_sub(1))
    }

    /// The puffs whose image may hold a place.
    pub fn cell_at(&self, [x, y]: [f64; 2]) -> &[u32] {
        self.cell(self.index(y, self.rows) * self.columns + self.index(x, self.columns))
    }

    fn cell(&self, cell: usize) -> &[u32] {
        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        &self.entries[range]
    }

    /// Visits the puffs in the cells of a box, some of them several times, until `visit` returns false.
    pub fn visit(&self, bounds: [f64; 4], mut visit: impl FnMut(u32) -> bool) {
        for cell in self.cells_of(bounds) {
            for index in self.cell(cell) {
                if !visit(*index) {
                    return;
                }
            }
        }
    }
}
