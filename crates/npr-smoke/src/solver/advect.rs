//! Carrying values along the flow, without losing their edges to blur.

use glam::Vec3;

use super::flow::{Field, Flow};

/// What lies outside the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outside {
    /// Nothing: clear, cool air comes in.
    Nothing,
    /// The same as at the border.
    Same,
}

/// A value that came from elsewhere, and the range of the values round the place it came from.
#[derive(Debug, Clone, Copy, Default)]
struct Carried {
    value: f32,
    least: f32,
    most: f32,
}

/// Where the points of a field come from and where they go.
pub(super) struct Paths {
    /// Places `seconds` ago, and in `seconds`, point by point.
    ways: Vec<[Vec3; 2]>,
}

impl Paths {
    /// The ways of a field's points through `seconds` of flow, by the midpoint rule. Fields on the same points share
    /// them.
    pub fn new(field: &Field, flow: &Flow, seconds: f32) -> Self {
        let ways = field.lattice.map_costly(|point| {
            let place = field.place(point);
            let here = flow.at(place);
            let after = |seconds: f32| {
                let middle = place - here * (0.5 * seconds);
                place - flow.at(middle) * seconds
            };
            [after(seconds), after(-seconds)]
        });
        Self { ways }
    }

    /// The field after its points have gone their ways [Selle et al. 2008].
    ///
    /// A semi-Lagrangian step forth, one back to see its error, and half of that error taken off. Results stay within
    /// the range of the values that they came from, so nothing overshoots: the extremes of a field never grow.
    pub fn carry(&self, field: &Field, outside: Outside) -> Field {
        let lattice = field.lattice;
        let there =
            lattice.map_costly(|point| fetch(field, self.ways[lattice.index(point)][0], outside));
        let forth = Field {
            values: there.iter().map(|carried| carried.value).collect(),
            ..*field
        };
        let values = lattice.map_costly(|point| {
            let at = lattice.index(point);
            let Carried { value, least, most } = there[at];
            let back = fetch(&forth, self.ways[at][1], outside).value;
            (value + 0.5 * (field.values[at] - back)).clamp(least, most)
        });
        Field { values, ..*field }
    }
}

/// The field after `seconds` of flow.
pub(super) fn advect(field: &Field, flow: &Flow, seconds: f32, outside: Outside) -> Field {
    Paths::new(field, flow, seconds).carry(field, outside)
}

/// The value at a place with the range of its eight neighbours.
fn fetch(field: &Field, place: Vec3, outside: Outside) -> Carried {
    let place = place - field.origin;
    if outside == Outside::Nothing && !field.lattice.holds(place) {
        return Carried::default();
    }
    let cell = field.lattice.cell(place);
    let corners = cell.corners().map(|at| field.values[at]);
    let least = corners.into_iter().fold(f32::INFINITY, f32::min);
    let most = corners.into_iter().fold(f32::NEG_INFINITY, f32::max);
    Carried {
        // Rounding may carry a blend past its ends.
        value: cell.blend_of(&corners).clamp(least, most),
        least,
        most,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Lattice;

    #[test]
    fn a_uniform_flow_moves_a_field_by_whole_cells_exactly() {
        let cells = Lattice::new(12, 10, 9);
        let flow = Flow {
            cells,
            faces: Flow::uniform(cells, Vec3::new(2.0, -1.0, 3.0)).faces,
        };
        let mut field = Field::new(cells, Vec3::ZERO);
        field.values[cells.index([4, 6, 5])] = 1.0;
        let moved = advect(&field, &flow, 1.0, Outside::Nothing);
        let expected = cells.index([6, 5, 8]);
        for (at, value) in moved.values.iter().enumerate() {
            assert!((value - f32::from(u8::from(at == expected))).abs() < 1e-5);
        }
    }

    #[test]
    fn maccormack_keeps_more_of_a_peak_than_one_step_forth() {
        let cells = Lattice::new(40, 5, 5);
        let flow = Flow::uniform(cells, Vec3::X);
        let bump = |x: f32| (1.0 - ((x - 10.0) / 5.0).abs()).max(0.0);
        let mut sharp = Field::new(cells, Vec3::ZERO);
        sharp.values = cells.map(|[x, _, _]| bump(x as f32));
        let mut soft = sharp.clone();
        for _ in 0..40 {
            sharp = advect(&sharp, &flow, 0.4, Outside::Nothing);
            let paths = Paths::new(&soft, &flow, 0.4);
            let once = |point| fetch(&soft, paths.ways[cells.index(point)][0], Outside::Nothing);
            soft.values = cells.map(|point| once(point).value);
        }
        let peak = |field: &Field| field.values.iter().fold(0.0f32, |a, &b| a.max(b));
        assert!(
            peak(&sharp) > peak(&soft) + 0.1,
            "{} {}",
            peak(&sharp),
            peak(&soft)
        );
    }
}
