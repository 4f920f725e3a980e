//! The pressure that keeps air from piling up: conjugate gradients, preconditioned by multigrid [McAdams et al. 2010].

use super::flow::Flow;
use crate::lattice::{Lattice, greatest, rows, sum};

/// Divergence left over by [`Pressure::project`], as a share of the greatest before it.
pub(super) const TOLERANCE: f32 = 1e-4;

/// Most rounds of conjugate gradients. 6 to 12 reach the tolerance.
const MAX_ROUNDS: usize = 60;

/// Sweeps before and after each coarser level, equal in number so that the preconditioner is symmetric.
const SWEEPS: usize = 2;

/// Sweeps on the coarsest level, which has a few cells only.
const COARSEST_SWEEPS: usize = 12;

/// Damping of Jacobi that smooths best in three dimensions.
const DAMPING: f32 = 6.0 / 7.0;

/// Solver for the pressure on one grid, with its memory.
#[derive(Debug, Clone)]
pub(super) struct Pressure {
    levels: Vec<Level>,
    pressure: Vec<f32>,
    residual: Vec<f32>,
    direction: Vec<f32>,
    image: Vec<f32>,
}

impl Pressure {
    /// Memory for a grid and its coarser levels: about 9 numbers a cell.
    pub fn new(cells: Lattice) -> Self {
        let mut levels = vec![Level::finest(cells)];
        while let Some(coarser) = levels.last().and_then(Level::halved) {
            levels.push(coarser);
        }
        let zeros = vec![0.0; cells.len()];
        Self {
            levels,
            pressure: zeros.clone(),
            residual: zeros.clone(),
            direction: zeros.clone(),
            image: zeros,
        }
    }

    /// Changes the flow by the gradient of a pressure so that its divergence becomes what is `wanted`, per second,
    /// within [`TOLERANCE`] of the greatest difference before.
    pub fn project(&mut self, flow: &mut Flow, wanted: impl Fn([usize; 3]) -> f32 + Sync) {
        let cells = flow.cells;
        let shared = &*flow;
        cells.fill(&mut self.residual, |cell| {
            wanted(cell) - shared.divergence(cell)
        });
        self.solve();
        let pressure = &self.pressure;
        for (axis, field) in flow.faces.iter_mut().enumerate() {
            let lattice = field.lattice;
            let row = |(row, values): (usize, &mut [f32])| {
                for (x, value) in values.iter_mut().enumerate() {
                    let face = [x, row % lattice.size[1], row / lattice.size[1]];
                    *value -= rise(pressure, cells, face, axis);
                }
            };
            rows(&mut field.values, lattice.size[0], row);
        }
        flow.close_floor();
    }

    /// Conjugate gradients for `pressure`, starting from nothing, with the right side in `residual`.
    fn solve(&mut self) {
        // Stop at once where nothing diverges.
        let count = self.pressure.len();
        self.pressure.fill(0.0);
        let enough = TOLERANCE * largest(&self.residual);
        if enough.is_nan() || enough <= 0.0 {
            return;
        }

        // Begin along the steepest way down.
        self.precondition();
        self.direction.copy_from_slice(&self.levels[0].solution);
        let mut power = dot(&self.residual, &self.direction);
        for _ in 0..MAX_ROUNDS {
            // Go as far along the direction as the error shrinks.
            self.levels[0].apply(&self.direction, &mut self.image);
            let stretch = (power / dot(&self.direction, &self.image)) as f32;
            if !stretch.is_finite() {
                return;
            }
            add_scaled(&mut self.pressure, &self.direction, stretch);
            add_scaled(&mut self.residual, &self.image, -stretch);
            if largest(&self.residual) <= enough {
                return;
            }

            // Turn to the next direction, conjugate to those before.
            self.precondition();
            let next_power = dot(&self.residual, &self.levels[0].solution);
            let keep = (next_power / power) as f32;
            power = next_power;
            let (steepest, direction) = (&self.levels[0].solution, &mut self.direction);
            rows(direction, ROW, |(row, values)| {
                for (value, step) in values.iter_mut().zip(&steepest[row * ROW..count]) {
                    *value = step + keep * *value;
                }
            });
        }
    }

    /// Leaves a rough solution for the residual in the finest level.
    fn precondition(&mut self) {
        self.levels[0].right.copy_from_slice(&self.residual);
        cycle(&mut self.levels);
    }
}

/// Numbers that one task of a plain loop works on.
const ROW: usize = 4096;

/// Difference of pressure across a face: outside it is 0, behind the floor the same.
fn rise(pressure: &[f32], cells: Lattice, face: [usize; 3], axis: usize) -> f32 {
    let mut below = face;
    below[axis] = below[axis].wrapping_sub(1);
    let of = |cell: [usize; 3]| {
        let inside = cell[axis] < cells.size[axis];
        if inside {
            pressure[cells.index(cell)]
        } else {
            0.0
        }
    };
    of(face) - of(below)
}

/// The equations on one grid of the pyramid: cells are boxes that may differ in width along each axis.
#[derive(Debug, Clone)]
struct Level {
    cells: Lattice,
    /// Widths of the cells along each axis, in cells of the finest level.
    widths: [Vec<f32>; 3],
    /// For each face along each axis, one over the distance between the centres that it parts; 0 at the floor.
    links: [Vec<f32>; 3],
    solution: Vec<f32>,
    right: Vec<f32>,
    spare: Vec<f32>,
}

impl Level {
    /// The grid itself.
    fn finest(cells: Lattice) -> Self {
        Self::of_widths(cells.size.map(|side| vec![1.0; side]))
    }

    /// A grid whose cells each join up to eight of this one; nothing where that would save no work.
    fn halved(&self) -> Option<Self> {
        if self.cells.len() <= 64 {
            return None;
        }
        let join = |widths: &Vec<f32>| widths.chunks(2).map(|pair| pair.iter().sum()).collect();
        let [x, y, z] = &self.widths;
        Some(Self::of_widths([join(x), join(y), join(z)]))
    }

    fn of_widths(widths: [Vec<f32>; 3]) -> Self {
        let [x, y, z] = &widths;
        let cells = Lattice::new(x.len(), y.len(), z.len());
        let mut links = [links(x), links(y), links(z)];
        links[2][0] = 0.0;
        let zeros = vec![0.0; cells.len()];
        Self {
            cells,
            links,
            widths,
            solution: zeros.clone(),
            right: zeros.clone(),
            spare: zeros,
        }
    }

    /// Goes through a row of cells: hands out the place in the row, the weight of the cell itself, and the weighted sum
    /// of its neighbours.
    fn stencil(&self, values: &[f32], row: usize, mut each: impl FnMut(usize, f32, f32)) {
        let [width, height, _] = self.cells.size;
        let (y, z) = (row % height, row / height);
        let (wide, deep) = (self.widths[1][y], self.widths[2][z]);
        let (south, north) = (self.links[1][y] * deep, self.links[1][y + 1] * deep);
        let (below, above) = (self.links[2][z] * wide, self.links[2][z + 1] * wide);
        let sides = south + north + below + above;
        // Rows outside the grid count as any row with a weight of 0: the pressure there is 0.
        let beside = |inside: bool, weight: f32, row: usize| {
            let (weight, row) = if inside { (weight, row) } else { (0.0, 0) };
            (weight, &values[width * row..][..width])
        };
        let (south, to_south) = beside(y > 0, south, row.saturating_sub(1));
        let (north, to_north) = beside(y + 1 < height, north, row + 1);
        let (below, under) = beside(z > 0, below, row.saturating_sub(height));
        let (above, over) = beside(z + 1 < self.cells.size[2], above, row + height);
        let here = &values[width * row..][..width];
        let (across, along) = (&self.links[0], &self.widths[0]);
        for x in 0..width {
            let area = wide * deep;
            let west = if x > 0 { across[x] * here[x - 1] } else { 0.0 };
            let east = if x + 1 < width {
                across[x + 1] * here[x + 1]
            } else {
                0.0
            };
            let others =
                south * to_south[x] + north * to_north[x] + below * under[x] + above * over[x];
            let own = area * (across[x] + across[x + 1]) + along[x] * sides;
            each(x, own, area * (west + east) + along[x] * others);
        }
    }

    /// The equations' left side for `values`.
    fn apply(&self, values: &[f32], out: &mut [f32]) {
        let width = self.cells.size[0];
        rows(out, width, |(row, out)| {
            let here = &values[width * row..];
            self.stencil(values, row, |x, own, others| {
                out[x] = own * here[x] - others
            });
        });
    }

    /// Sweeps of damped Jacobi.
    fn smooth(&mut self, sweeps: usize) {
        let width = self.cells.size[0];
        for _ in 0..sweeps {
            let mut next = std::mem::take(&mut self.spare);
            rows(&mut next, width, |(row, out)| {
                let (here, right) = (&self.solution[width * row..], &self.right[width * row..]);
                self.stencil(&self.solution, row, |x, own, others| {
                    let wrong = right[x] + others - own * here[x];
                    out[x] = here[x] + DAMPING * wrong / own;
                });
            });
            self.spare = std::mem::replace(&mut self.solution, next);
        }
    }

    /// The first of [`SWEEPS`], which starts from nothing.
    fn start(&mut self) {
        let width = self.cells.size[0];
        let mut solution = std::mem::take(&mut self.solution);
        rows(&mut solution, width, |(row, out)| {
            let right = &self.right[width * row..];
            self.stencil(&self.right, row, |x, own, _| {
                out[x] = DAMPING * right[x] / own
            });
        });
        self.solution = solution;
    }

    /// What the solution leaves unsolved, in `spare`.
    fn leave(&mut self) {
        let width = self.cells.size[0];
        let mut left = std::mem::take(&mut self.spare);
        rows(&mut left, width, |(row, out)| {
            let (here, right) = (&self.solution[width * row..], &self.right[width * row..]);
            self.stencil(&self.solution, row, |x, own, others| {
                out[x] = right[x] + others - own * here[x];
            });
        });
        self.spare = left;
    }

    /// Takes over what a finer level left, summed over the cells that each cell joins.
    fn gather(&mut self, finer: &Self) {
        let size = finer.cells.size;
        self.cells.fill(&mut self.right, |cell| {
            let pair = |axis: usize| 2 * cell[axis]..(2 * cell[axis] + 2).min(size[axis]);
            let mut total = 0.0;
            for z in pair(2) {
                for y in pair(1) {
                    let row = finer.cells.index([0, y, z]);
                    total += finer.spare[row..][pair(0)].iter().sum::<f32>();
                }
            }
            total
        });
    }

    /// Adds a coarser level's solution to its own.
    fn spread(&mut self, coarser: &Self) {
        let [width, height, _] = self.cells.size;
        rows(&mut self.solution, width, |(row, values)| {
            let start = coarser.cells.index([0, row % height / 2, row / height / 2]);
            for (x, value) in values.iter_mut().enumerate() {
                *value += coarser.solution[start + x / 2];
            }
        });
    }
}

/// One over the distance between the centres on both sides of each face. The outside begins half a cell of the finest
/// level beyond the border: there the pressure is 0.
fn links(widths: &[f32]) -> Vec<f32> {
    let half = |at: Option<&f32>| at.map_or(0.5, |width| 0.5 * width);
    let link = |face: usize| {
        1.0 / (half(face.checked_sub(1).and_then(|at| widths.get(at))) + half(widths.get(face)))
    };
    (0..=widths.len()).map(link).collect()
}

/// One V-cycle for the first of the levels, from nothing.
fn cycle(levels: &mut [Level]) {
    let Some((fine, coarser)) = levels.split_first_mut() else {
        return;
    };
    fine.start();
    if coarser.is_empty() {
        fine.smooth(COARSEST_SWEEPS);
        return;
    }
    fine.smooth(SWEEPS - 1);
    fine.leave();
    coarser[0].gather(fine);
    cycle(coarser);
    fine.spread(&coarser[0]);
    fine.smooth(SWEEPS);
}

/// Scalar product, in blocks of fixed size.
fn dot(a: &[f32], b: &[f32]) -> f64 {
    sum(a.len(), |at| f64::from(a[at]) * f64::from(b[at]))
}

/// The greatest magnitude.
fn largest(values: &[f32]) -> f32 {
    greatest(values.len(), |at| values[at].abs())
}

/// Adds `factor` times `other`.
fn add_scaled(values: &mut [f32], other: &[f32], factor: f32) {
    rows(values, ROW, |(row, values)| {
        for (value, other) in values.iter_mut().zip(&other[row * ROW..]) {
            *value += factor * other;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::unit;
    use glam::Vec3;
    use proptest::prelude::*;

    fn stirred(cells: Lattice, seed: u32, speed: f32) -> Flow {
        let mut flow = Flow::uniform(cells, Vec3::ZERO);
        for (axis, field) in flow.faces.iter_mut().enumerate() {
            for (at, value) in field.values.iter_mut().enumerate() {
                *value = speed * (unit(seed, at as u32, axis as u32) - 0.5);
            }
        }
        flow.close_floor();
        flow
    }

    fn greatest_divergence(flow: &Flow) -> f32 {
        greatest(flow.cells.len(), |at| {
            flow.divergence(flow.cells.point(at)).abs()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn projected_flow_has_no_divergence(
            size in prop::array::uniform3(4usize..14), seed: u32,
            speed in prop_oneof![Just(1e-3f32), Just(1.0), Just(1e4)],
        ) {
            let cells = Lattice { size };
            let mut flow = stirred(cells, seed, speed);
            let before = greatest_divergence(&flow);
            Pressure::new(cells).project(&mut flow, |_| 0.0);
            let after = greatest_divergence(&flow);
            // The gradient is rounded once more than the residual.
            prop_assert!(after <= 3.0 * TOLERANCE * before, "{} of {}", after, before);
            prop_assert!(flow.faces[2].values[..size[0] * size[1]].iter().all(|&v| v == 0.0));
        }
    }

    #[test]
    fn flow_without_divergence_stays_as_it_is() {
        let cells = Lattice::new(8, 8, 8);
        let sideways = Flow::uniform(cells, Vec3::new(1.0, 2.0, 0.0));
        let mut flow = sideways.clone();
        Pressure::new(cells).project(&mut flow, |_| 0.0);
        assert_eq!(flow, sideways);
    }

    #[test]
    fn a_cell_that_expands_blows_to_all_sides() {
        let cells = Lattice::new(9, 9, 9);
        let mut flow = Flow::uniform(cells, Vec3::ZERO);
        let wanted = |cell: [usize; 3]| f32::from(u8::from(cell == [4, 4, 4]));
        Pressure::new(cells).project(&mut flow, wanted);
        assert!((flow.divergence([4, 4, 4]) - 1.0).abs() < 1e-3);
        let [right, left] = [6, 2].map(|x| flow.at_centre([x, 4, 4]).x);
        let [back, up] = [flow.at_centre([4, 6, 4]).y, flow.at_centre([4, 4, 6]).z];
        assert!(right > 0.0 && (right + left).abs() < 1e-3 * right);
        assert!(
            (right - back).abs() < 1e-3 * right && (right - up).abs() < 0.2 * right,
            "{right} {up}"
        );
    }

    #[test]
    fn few_rounds_are_enough_for_grids_of_any_size() {
        for size in [[15, 15, 20], [33, 17, 64], [50, 50, 50], [4, 4, 200]] {
            let cells = Lattice { size };
            let mut pressure = Pressure::new(cells);
            let flow = stirred(cells, 7, 1.0);
            cells.fill(&mut pressure.residual, |cell| -flow.divergence(cell));
            let first = largest(&pressure.residual);
            pressure.solve();
            assert!(largest(&pressure.residual) <= TOLERANCE * first);
        }
    }
}
